//! Variants of part images (000-22, 000-43): beside `CODE.png`, or instead of it, lie `CODE.1.png`, `CODE.2.png` and so
//! on. Each place chooses its own at random, after everything else is settled, by a key of the seed, the house, the
//! storey, the line and the position. So edits elsewhere change no choice, and an additional variant only takes some
//! places from the others.

use crate::expand::Pass;
use crate::expand::codes::Found;
use crate::expand::codes::Which;
use crate::messages::pictures as say;
use hsd_base::rng::Place;
use hsd_ir::program::{Content, PictureId, Storey, Unit};

/// Keys of the halves of a split.
const UPPER: u64 = 1;
const LOWER: u64 = 2;

impl Pass<'_, '_> {
    /// Chooses the images of a house.
    pub(super) fn pictures(&mut self, storeys: &mut [Storey], house: Place) {
        if !self.codes.has_pictures() {
            return;
        }
        let house = house.named("pictures");
        for (storey, place) in numbered(storeys, house) {
            for (walk, place) in numbered(&mut storey.loops, place) {
                for (line, place) in numbered(&mut walk.lines, place) {
                    self.picture_units(&mut line.units, place);
                }
            }
        }
    }

    fn picture_units(&mut self, units: &mut [Unit], place: Place) {
        for (unit, place) in numbered(units, place) {
            match &mut unit.content {
                Content::Void => {}
                Content::Picture(id) => *id = drawn(self.codes.variants(*id), place).unwrap_or(*id),
                Content::Part(id) => {
                    let Some(texture) = self.codes.catalog.part(*id).texture.as_ref() else {
                        continue;
                    };
                    let found = self.codes.picture(&texture.value);
                    let Some(Found {
                        which: Which::Picture(picture),
                        ..
                    }) = found
                    else {
                        let (span, name) = (texture.span, texture.value.clone());
                        self.once(604, span, || say::no_texture(span, &name));
                        continue;
                    };
                    unit.picture = drawn(self.codes.variants(picture), place);
                }
                Content::Split(split) => {
                    self.picture_units(&mut split.upper, place.at(UPPER));
                    self.picture_units(&mut split.lower, place.at(LOWER));
                }
            }
        }
    }
}

/// Pairs items with the places of their numbers.
fn numbered<T>(things: &mut [T], place: Place) -> impl Iterator<Item = (&mut T, Place)> {
    let places = (0..).map(move |n| place.at(n));
    things.iter_mut().zip(places)
}

/// Returns the variant that has the largest share at this place, each by a key of its own.
fn drawn(variants: &[PictureId], place: Place) -> Option<PictureId> {
    let shares = variants
        .iter()
        .zip(0..)
        .map(|(id, n)| (place.at(n).share(), *id));
    let most = shares.reduce(|most, next| if next.0 > most.0 { next } else { most });
    most.map(|(_, id)| id)
}
