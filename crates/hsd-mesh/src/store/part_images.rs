//! Images of joinery on parts: baked once for all parts of about one size, in any house.
//!
//! The images are made from a key of rounded sizes alone, never from the first part that needs them: a house is the same
//! in any company.

use crate::bake::{FAR, OLD, WALL, bake};
use crate::mesh::Bodies;
use crate::mesh::panel::{Panel, Rect, panes};
use crate::part;
use crate::part::bay::Bay;
use crate::store::draft::BakedImage;
use crate::store::look::Share;
use crate::store::{PartKey, Store};
use crate::weather::Weather;
use crate::weather::panel_look::{PanelAreas, PanelLook};
use hsd_ir::catalog::PartDef;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use std::sync::Arc;

impl PartKey {
    /// Returns the key of the images on this part: joinery is baked for sizes in steps and stretched to its own, by a
    /// thirty-second at most, so that walls of a hundred different heights need a few images only. Weathered joinery has
    /// many more images of each size; it is stretched by a sixteenth at most. In a town, where walls of any length are filled
    /// with parts of any width, by an eighth.
    fn of_images(self, steps: u32) -> PartKey {
        let in_steps = |length| in_steps(length, steps);
        PartKey {
            share: Share::default(),
            size: self.size.map(in_steps),
            post: in_steps(self.post),
            room: in_steps(self.room),
            picture: 0,
            ..self
        }
    }

    /// Builds the bodies of this key; they depend on nothing else.
    fn bodies(self, part: &PartDef, detail: Detail) -> Bodies {
        part::build(self.bay(part, detail))
    }

    fn bay(self, part: &PartDef, detail: Detail) -> Bay<'_> {
        let [width, height, z0, z1] = self.size.map(|n| f64::from(n) / 10_000.0);
        let post = (self.post > 0).then(|| f64::from(self.post) / 10_000.0);
        let mut bay = Bay::new(part, (width, height), (z0, z1), self.around, detail, post);
        bay.room = f64::from(self.room) / 10_000.0;
        bay.grounded = self.grounded;
        bay
    }
}

/// The number of sizes between a power of two and the next, as its own power of two.
const STEPS: u32 = 4;

/// The same for weathered joinery.
const FEW_STEPS: u32 = 3;

/// The same in a town.
const TOWN_STEPS: u32 = 2;

/// Rounds a length to one of `2^steps` steps between a power of two and the next.
fn in_steps(length: u32, steps: u32) -> u32 {
    let step = 1 << (u32::BITS - length.leading_zeros()).saturating_sub(steps + 1);
    (length + step / 2) / step * step
}

/// The image of a panel.
#[derive(Clone, Debug)]
pub(super) struct PanelImage {
    /// The image; `None` if nothing of the panel is visible.
    pub(super) baked: Option<Arc<BakedImage>>,
    /// The panes behind it, as shares of the panel's width and height.
    pub(super) panes: Vec<(SurfaceId, Rect)>,
}

/// A panel's image, and the shade in which the panel shows it.
pub(super) type ShadedImage = (Arc<PanelImage>, usize);

impl Store<'_> {
    /// Returns the bodies of a part: without what its panels show, if that is baked for a size close to its own.
    pub(super) fn part_bodies(&self, part: &PartDef, key: PartKey) -> Bodies {
        let mut bay = key.bay(part, self.detail);
        bay.measured = true;
        let bodies = part::build(bay);
        let shared = || self.shared_areas(part, self.image_key(key), &bodies);
        match bodies.panels.is_empty() || shared().is_some() {
            true => bodies,
            false => key.bodies(part, self.detail),
        }
    }

    /// Returns the looks of a part's panels.
    pub(super) fn part_looks(
        &self,
        part: &PartDef,
        key: PartKey,
        bodies: &Bodies,
    ) -> Vec<PanelLook> {
        match self.shared_areas(part, self.image_key(key), bodies) {
            Some(areas) => areas.iter().map(|a| a.look(self.weather)).collect(),
            None => self.own_looks(&bodies.panels),
        }
    }

    /// Returns the images of a part's panels with these looks, baked for a size close to that of the part.
    pub(super) fn part_images(
        &self,
        part: &PartDef,
        key: PartKey,
        bodies: &Bodies,
        looks: Vec<PanelLook>,
    ) -> Vec<ShadedImage> {
        let key = self.image_key(key);
        if self.shared_areas(part, key, bodies).is_none() {
            return self.panel_images(&bodies.panels, &looks);
        }
        let image = |(number, look): (usize, PanelLook)| {
            let shade = look.shade;
            let make = || {
                let made = key.bodies(part, self.detail);
                Arc::new(self.panel_image(&made.panels[number], &look))
            };
            let image = self.bank.image((key, number, look.surfaces.clone()), make);
            (image, shade)
        };
        looks.into_iter().enumerate().map(image).collect()
    }

    fn image_key(&self, key: PartKey) -> PartKey {
        key.of_images(match self.weather {
            _ if self.town => TOWN_STEPS,
            Weather::None => STEPS,
            _ => FEW_STEPS,
        })
    }

    /// Returns the areas of the panels of a key; `None` if there are no panels, or if one step of size makes the difference
    /// of a panel: then the images are the part's own.
    fn shared_areas(
        &self,
        part: &PartDef,
        key: PartKey,
        bodies: &Bodies,
    ) -> Option<Arc<[PanelAreas]>> {
        if bodies.panels.is_empty() {
            return None;
        }
        let areas = self.bank.areas(key, || {
            let made = key.bodies(part, self.detail);
            made.panels.iter().map(PanelAreas::of).collect()
        });
        (areas.len() == bodies.panels.len()).then_some(areas)
    }

    /// Returns the looks of panels that share no image.
    pub(super) fn own_looks(&self, panels: &[Panel]) -> Vec<PanelLook> {
        let look = |panel| PanelAreas::of(panel).look(self.weather);
        panels.iter().map(look).collect()
    }

    /// Bakes the images of panels.
    pub(super) fn panel_images(&self, panels: &[Panel], looks: &[PanelLook]) -> Vec<ShadedImage> {
        let image = |(panel, look): (&Panel, &PanelLook)| {
            let image = Arc::new(self.panel_image(panel, look));
            (image, look.shade)
        };
        panels.iter().zip(looks).map(image).collect()
    }

    fn panel_image(&self, panel: &Panel, look: &PanelLook) -> PanelImage {
        let lens = match (self.town, self.detail) {
            (true, Detail::Flat) => FAR,
            (true, _) => OLD,
            (false, _) if look.surfaces.is_empty() => WALL,
            (false, _) => OLD,
        };
        let picture = bake(&panel.soups, |id| look.shown(id), panel.rect, lens);
        PanelImage {
            baked: picture.map(|picture| Arc::new(BakedImage::new(picture, self.town))),
            panes: panes(panel)
                .map(|(glass, rect)| (glass, panel.rect.shares_of(rect)))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FEW_STEPS, STEPS, TOWN_STEPS};

    #[test]
    fn sizes_of_images_are_near_those_of_parts() {
        for (share, in_steps) in [(32, STEPS), (16, FEW_STEPS), (8, TOWN_STEPS)]
            .map(|(share, steps)| (share, move |length| super::in_steps(length, steps)))
        {
            let mut steps: Vec<u32> = (1..60_000).map(in_steps).collect();
            for (length, step) in (1..).zip(&steps) {
                assert!(step.abs_diff(length) * share <= length, "{length}: {step}");
            }
            assert!(steps.is_sorted());
            steps.dedup();
            assert!(steps.len() < 400, "{}", steps.len());
            assert_eq!(in_steps(0), 0);
        }
    }
}
