//! The meaning of a code: a part of the catalogue, otherwise an image, otherwise the nearest part and an error.

use super::Pass;
use crate::messages::meanings;
use hsd_base::source::{PictureFile, Span, World};
use hsd_ir::ast::CodeText;
use hsd_ir::catalog::{Catalog, PartDef, PartId, Query, ScopeId};
use hsd_ir::messages::parts as say;
use hsd_ir::program::{Content, House, Picture, PictureId, Unit};
use std::collections::BTreeMap;

/// The meaning of a code, small enough to compare and copy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Which {
    Void,
    Part(PartId),
    Picture(PictureId),
}

impl Which {
    /// Returns the meaning of a unit; `None` for a split, which has no code.
    pub(super) fn of(content: &Content) -> Option<Which> {
        match content {
            Content::Void => Some(Which::Void),
            Content::Part(id) => Some(Which::Part(*id)),
            Content::Picture(id) => Some(Which::Picture(*id)),
            Content::Split(_) => None,
        }
    }

    pub(super) fn content(self) -> Content {
        match self {
            Which::Void => Content::Void,
            Which::Part(id) => Content::Part(id),
            Which::Picture(id) => Content::Picture(id),
        }
    }
}

/// The default width of units.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mode {
    /// In a row of a house the grid counts: an image is 1 U wide.
    Row,
    /// In a floor of a facade of this height in U an image keeps its proportion, since the floor is scaled to its
    /// facade.
    Floor(f64),
}

impl Mode {
    /// Returns the mode of a piece that takes this share of the height.
    pub(super) fn share(self, share: f64) -> Mode {
        match self {
            Mode::Row => Mode::Row,
            Mode::Floor(height) => Mode::Floor(height * share),
        }
    }

    pub(super) fn is_row(self) -> bool {
        matches!(self, Mode::Row)
    }
}

/// The result of looking up a code.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) which: Which,
    /// Width in U by the catalogue; `None` for images.
    pub(super) width: Option<f64>,
}

const RECENT: usize = 256;

/// The maximum number of searches for near spellings in one house: they cost time, and 100,000 unknown codes need no
/// 100,000 suggestions.
const SEARCHES: u32 = 500;

/// The catalogue and the images, with a cache of lookups.
pub(super) struct Codes<'a> {
    pub(super) catalog: &'a Catalog,
    /// The scope of custom parts known in the house.
    scope: ScopeId,
    pub(super) world: &'a dyn World,
    pub(super) pictures: Vec<Picture>,
    names: BTreeMap<String, Option<PictureId>>,
    /// The images of a name and its variants, by the first of them.
    variants: BTreeMap<PictureId, Vec<PictureId>>,
    /// Images that the house assigns to codes.
    given: BTreeMap<String, PictureId>,
    /// A cache of recent codes: old files repeat a dozen codes hundreds of thousands of times.
    recent: Vec<Option<([u8; 5], Found)>>,
    /// The number of searches for near spellings left in the house.
    searches: u32,
}

impl<'a> Codes<'a> {
    pub(super) fn new(catalog: &'a Catalog, world: &'a dyn World) -> Self {
        Codes {
            catalog,
            scope: ScopeId::default(),
            world,
            pictures: vec![],
            names: BTreeMap::new(),
            variants: BTreeMap::new(),
            given: BTreeMap::new(),
            recent: vec![None; RECENT],
            searches: SEARCHES,
        }
    }

    /// Continues with a house that has this scope.
    pub(super) fn enter(&mut self, scope: ScopeId) {
        self.searches = SEARCHES;
        if scope != self.scope || !self.given.is_empty() {
            self.scope = scope;
            self.given.clear();
            self.recent.fill(None);
        }
    }

    /// Returns the part that the house means by the code of another one.
    pub(super) fn own_part(&self, id: PartId) -> PartId {
        let code = CodeText::new(self.catalog.part(id).code());
        self.catalog.find_in(self.scope, &code).unwrap_or(id)
    }

    /// Returns the meaning of a code, if it has one.
    #[inline]
    pub(super) fn known(&mut self, code: &CodeText) -> Option<Found> {
        let five = match code {
            CodeText::Five(five) => five,
            // Blanks at the ends of an attribute do not belong to a name.
            CodeText::Name(name) => return self.look_up(&CodeText::new(name.trim())),
        };
        let word = u32::from_le_bytes([five[0], five[1], five[2], five[4]]);
        let slot = (word ^ u32::from(five[3])).wrapping_mul(0x9E37_79B1) as usize >> 24;
        match &self.recent[slot] {
            Some((seen, found)) if seen == five => Some(*found),
            _ => {
                let found = self.look_up(code)?;
                self.recent[slot] = Some((*five, found));
                Some(found)
            }
        }
    }

    fn look_up(&mut self, code: &CodeText) -> Option<Found> {
        let exact = self.exact(code);
        if exact.is_some() || !code.as_str().contains('_') {
            return exact;
        }
        // A literal name takes precedence over `_` as a blank.
        self.exact(&CodeText::new(&code.as_str().replace('_', " ")))
    }

    /// Adds an image that is named by its file.
    pub(super) fn add_picture(&mut self, name: &str, file: PictureFile) -> PictureId {
        self.pictures.push(Picture {
            name: name.to_owned(),
            path: file.path,
            size: file.size,
        });
        let id = PictureId(self.pictures.len() as u32 - 1);
        // An image named by its file has no variants.
        self.variants.insert(id, vec![id]);
        id
    }

    /// Assigns an image to a code, for this house.
    pub(super) fn give(&mut self, code: &CodeText, id: PictureId) {
        let name = code.as_str().trim_end_matches(' ').to_owned();
        self.given.entry(name).or_insert(id);
        self.recent.fill(None);
    }

    fn exact(&mut self, code: &CodeText) -> Option<Found> {
        if let Some(id) = self.given.get(code.as_str().trim_end_matches(' ')) {
            return Some(Found {
                which: Which::Picture(*id),
                width: None,
            });
        }
        match self.catalog.find_in(self.scope, code) {
            Some(id) => Some(self.part(id)),
            None => self.picture(code.as_str().trim_end_matches(' ')),
        }
    }

    fn part(&self, id: PartId) -> Found {
        let void = self.catalog.is_void(id);
        Found {
            which: if void { Which::Void } else { Which::Part(id) },
            width: Some(self.catalog.part(id).width()),
        }
    }

    /// Returns a part image by its name.
    pub(super) fn picture(&mut self, name: &str) -> Option<Found> {
        let id = match self.names.get(name) {
            Some(id) => *id,
            None => {
                let id = self.open(name);
                self.names.insert(name.to_owned(), id);
                id
            }
        };
        id.map(|id| Found {
            which: Which::Picture(id),
            width: None,
        })
    }

    /// Returns true if there are any images, in the house or as textures of the catalogue.
    pub(super) fn has_pictures(&self) -> bool {
        let textured = || self.catalog.parts().iter().any(|p| p.texture.is_some());
        !self.pictures.is_empty() || textured()
    }

    /// Returns an image and its variants, which are numbered from 1 without a gap.
    pub(super) fn variants(&mut self, id: PictureId) -> &[PictureId] {
        if !self.variants.contains_key(&id) {
            let name = self.pictures[id.0 as usize].name.clone();
            let mut found = vec![id];
            for number in 1..=VARIANTS {
                match self.picture(&variant(&name, number)).map(|f| f.which) {
                    Some(Which::Picture(next)) => found.push(next),
                    _ => break,
                }
            }
            // Without a file of the bare name the first variant takes its place.
            found.dedup_by_key(|id| self.pictures[id.0 as usize].path.clone());
            self.variants.insert(id, found);
        }
        &self.variants[&id]
    }

    fn open(&mut self, name: &str) -> Option<PictureId> {
        let named = |name: &str| self.world.picture(name).filter(|_| !name.is_empty());
        let file = named(name).or_else(|| named(&variant(name, 1)))?;
        self.pictures.push(Picture {
            name: name.to_owned(),
            path: file.path,
            size: file.size,
        });
        Some(PictureId(self.pictures.len() as u32 - 1))
    }

    /// Returns the width in U of a code without a given width.
    pub(super) fn own_width(&self, which: Which, mode: Mode) -> f64 {
        match (which, mode) {
            (Which::Void, _) => 1.0,
            (Which::Part(id), _) => self.catalog.part(id).width(),
            (Which::Picture(_), Mode::Row) => 1.0,
            (Which::Picture(id), Mode::Floor(height)) => {
                let (w, h) = self.pictures[id.0 as usize].size;
                height * f64::from(w.max(1)) / f64::from(h.max(1))
            }
        }
    }

    /// Returns the width in U of a lookup without a given width.
    pub(super) fn own_width_of(&self, found: &Found, mode: Mode) -> f64 {
        found
            .width
            .unwrap_or_else(|| self.own_width(found.which, mode))
    }

    /// Returns the author's name for it.
    pub(super) fn name(&self, which: Which) -> &str {
        match which {
            Which::Void => ".....",
            Which::Part(id) => self.catalog.part(id).code(),
            Which::Picture(id) => &self.pictures[id.0 as usize].name,
        }
    }

    /// Returns the nearest spellings of the catalogue, until the limit of searches is reached.
    pub(super) fn nearest(&mut self, code: &str) -> Vec<String> {
        if self.searches == 0 {
            return vec![];
        }
        self.searches -= 1;
        let near = self.catalog.nearest(code).into_iter();
        near.map(|id| self.catalog.part(id).code().to_owned())
            .collect()
    }

    /// Returns the code of the part that has this Japanese or romanised name.
    fn called(&mut self, name: &str) -> Option<&'a str> {
        if self.searches == 0 {
            return None;
        }
        self.searches -= 1;
        let catalog: &'a Catalog = self.catalog;
        catalog.called(name.trim()).map(PartDef::code)
    }

    /// The first parts that a search for this word finds, if it can be no code: such words are in kana, kanji or small
    /// letters.
    fn meant(&mut self, word: &str) -> Vec<&'a PartDef> {
        let small = word.len() >= MEANING && word.bytes().all(|b| b.is_ascii_lowercase());
        if self.searches == 0 || (word.is_ascii() && !small) {
            return vec![];
        }
        self.searches -= 1;
        let query = Query::new(word);
        let catalog: &'a Catalog = self.catalog;
        let parts = catalog.parts().iter();
        parts
            .filter(|p| p.is_found_by(&query))
            .take(OFFERS)
            .collect()
    }

    /// A placeholder for an unknown unit.
    pub(super) fn plain_part(&self) -> Which {
        self.stand_in("").which
    }

    /// Returns a substitute for an unknown code: a plain part of its class, in the width that its fifth column
    /// determines, so that the outline stays right.
    fn stand_in(&self, text: &str) -> Found {
        let plain = match text.as_bytes().first() {
            Some(b'T') => "TIT  ",
            Some(b'M') => "MRE  ",
            Some(b'G') => "GSI  ",
            Some(b'H') => "HHA 0",
            Some(b'A') => "AKI  ",
            Some(b'N') => "NAP  ",
            _ => "KSK  ",
        };
        let coded = text.len() == 5 && text.starts_with(['K', 'T', 'M', 'G', 'H', 'A', 'N']);
        let width = match text.as_bytes().get(4).filter(|_| coded) {
            Some(digit @ b'0'..=b'9') => f64::from(digit - b'0'),
            Some(b'h') => 0.5,
            _ => 1.0,
        };
        let part = self.catalog.find(&CodeText::new(plain));
        Found {
            which: part.map_or(Which::Void, |id| self.part(id).which),
            width: Some(width),
        }
    }
}

impl Pass<'_, '_> {
    /// Returns the meaning of a code; reports an unknown one and returns the likeliest meaning.
    #[inline]
    pub(super) fn resolve(&mut self, code: &CodeText, span: Span) -> Found {
        match self.codes.known(code) {
            Some(found) => found,
            None => self.fix(code, span),
        }
    }

    #[cold]
    fn fix(&mut self, code: &CodeText, span: Span) -> Found {
        let text = code.as_str();
        let bare = text.trim_end_matches(' ');
        for upper in [bare.to_ascii_uppercase(), upper_but_width(text)] {
            if let Some(found) = self.codes.known(&CodeText::new(&upper)) {
                self.once(303, span, || say::lower_case(span, bare, &upper));
                return found;
            }
        }
        if let Some(control) = bare.chars().last().filter(|c| "LR^".contains(*c))
            && bare.len() <= 5
            && let Some(found) = self.codes.known(&CodeText::new(&bare[..bare.len() - 1]))
        {
            let code = bare[..bare.len() - 1].trim_end().to_owned();
            let ends = self.ends_line(span);
            self.once(302, span, || {
                say::lost_blanks(span, bare, &code, control, ends)
            });
            return found;
        }
        if self.is_news(301, span) {
            let called = self.codes.called(bare);
            let meant = self.codes.meant(bare);
            self.out.push(match (called, &meant[..]) {
                (Some(part), _) => say::part_name(span, bare, part, span),
                (None, []) => {
                    let near = match code {
                        CodeText::Name(_) => vec![],
                        CodeText::Five(_) => self.codes.nearest(bare),
                    };
                    say::unknown_code(span, bare, &near)
                }
                (None, meant) => meanings::part_meaning(span, bare, meant),
            });
        }
        self.codes.stand_in(bare)
    }
}

/// Parts that are offered for a word.
const OFFERS: usize = 3;

/// Fewer small letters are a code in small letters.
const MEANING: usize = 4;

/// The maximum number of variants of an image.
const VARIANTS: u32 = 999;

/// Returns the name of an image's variant: the number precedes the extension, if the name has one.
fn variant(name: &str, number: u32) -> String {
    let ending = |e: &&str| ["png", "jpg", "jpeg"].contains(&&*e.to_ascii_lowercase());
    match name.rsplit_once('.') {
        _ if name.is_empty() => String::new(),
        Some((stem, end)) if ending(&end) => format!("{stem}.{number}.{end}"),
        _ => format!("{name}.{number}"),
    }
}

/// Converts to upper case, except the `h` of half a unit in the fifth column.
fn upper_but_width(text: &str) -> String {
    let upper = text.to_ascii_uppercase();
    match upper.strip_suffix('H') {
        Some(head) if upper.len() == 5 => format!("{head}h"),
        _ => upper,
    }
}

/// The images that houses show, in the order of first use. More names are looked up than chosen, and images that are
/// not shown should not be loaded.
#[derive(Default)]
pub(super) struct UsedImages {
    /// New number of each image looked up.
    numbers: Vec<Option<PictureId>>,
    pub(super) images: Vec<Picture>,
}

impl UsedImages {
    /// Renumbers the images of a house. `known` are all that were looked up.
    pub(super) fn renumber(&mut self, house: &mut House, known: &[Picture]) {
        if known.is_empty() {
            return;
        }
        self.numbers.resize(known.len(), None);
        let loops = house.storeys.iter_mut().flat_map(|s| &mut s.loops);
        for line in loops.flat_map(|l| &mut l.lines) {
            self.units(&mut line.units, known);
        }
    }

    fn units(&mut self, units: &mut [Unit], known: &[Picture]) {
        for unit in units {
            if let Some(id) = &mut unit.picture {
                self.number(id, known);
            }
            match &mut unit.content {
                Content::Picture(id) => self.number(id, known),
                Content::Split(split) => {
                    self.units(&mut split.upper, known);
                    self.units(&mut split.lower, known);
                }
                Content::Void | Content::Part(_) => {}
            }
        }
    }

    fn number(&mut self, id: &mut PictureId, known: &[Picture]) {
        let old = id.0 as usize;
        *id = *self.numbers[old].get_or_insert_with(|| {
            self.images.push(known[old].clone());
            PictureId(self.images.len() as u32 - 1)
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_a_variant_stands_before_the_extension_of_an_image() {
        for (name, second) in [
            ("", ""),
            ("front", "front.2"),
            ("front.png", "front.2.png"),
            ("front.JPG", "front.2.JPG"),
            ("shop.front.jpeg", "shop.front.2.jpeg"),
            ("fig.4", "fig.4.2"),
        ] {
            assert_eq!(variant(name, 2), second);
        }
    }
}
