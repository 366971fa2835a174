//! Images of joinery on parts: baked once for all parts of about one size, in any house.
//!
//! The images are made from a key of rounded sizes alone, never from the first part that needs them: a house is the same
//! in any company.

use crate::catalog::PartDef;
use crate::material::SurfaceId;
use crate::scene::Detail;
use crate::tessellate::bake::atlas::Spot;
use crate::tessellate::bake::{WALL, bake};
use crate::tessellate::mesh::Bodies;
use crate::tessellate::mesh::panel::{Panel, Rect, panes};
use crate::tessellate::part;
use crate::tessellate::part::bay::Bay;
use crate::tessellate::store::{PartKey, Share, Store};
use std::rc::Rc;

impl PartKey {
    /// Returns the key of the images on this part: joinery is baked for sizes in steps and stretched by a sixty-fourth
    /// at most, so that walls of a hundred different heights need a few images only.
    fn of_images(self) -> PartKey {
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
    pub(super) fn bodies(self, part: &PartDef, detail: Detail) -> Bodies {
        let [width, height, z0, z1] = self.size.map(|n| f64::from(n) / 10_000.0);
        let post = (self.post > 0).then(|| f64::from(self.post) / 10_000.0);
        let mut bay = Bay::new(part, (width, height), (z0, z1), self.around, detail, post);
        bay.room = f64::from(self.room) / 10_000.0;
        part::build(bay)
    }
}

/// Rounds a length to one of 32 steps between a power of two and the next.
fn in_steps(length: u32) -> u32 {
    let step = 1 << (u32::BITS - length.leading_zeros()).saturating_sub(6);
    (length + step / 2) / step * step
}

/// The image of a panel.
#[derive(Clone, Debug)]
pub(super) struct PanelImage {
    /// Its place in the atlas; `None` if nothing of the panel is visible.
    pub(super) spot: Option<Spot>,
    /// The panes behind it, as shares of the panel's width and height.
    pub(super) panes: Vec<(SurfaceId, Rect)>,
}

impl Store {
    /// Returns the images of a part's panels, baked for a size close to that of the part and for its own weather: what is
    /// renewed and what is old differs from part to part, and coarser weather shows old houses as new ones.
    pub(super) fn part_images(
        &mut self,
        part: &PartDef,
        key: PartKey,
        bodies: &Bodies,
    ) -> Rc<[PanelImage]> {
        if bodies.panels.is_empty() {
            return Rc::default();
        }
        let key = key.of_images();
        let fits = |images: &Rc<[PanelImage]>| images.len() == bodies.panels.len();
        if let Some(images) = self.images.get(&(key, self.weather)).filter(|i| fits(i)) {
            return images.clone();
        }
        let made = key.bodies(part, self.detail);
        if made.panels.len() != bodies.panels.len() {
            // One step of size makes the difference of a panel: these images are its own.
            return self.panel_images(&bodies.panels);
        }
        let aged = (key, self.weather.aged_surfaces(&made));
        let images = match self.worn_images.get(&aged) {
            Some(images) => images.clone(),
            None => {
                let images = self.panel_images(&made.panels);
                self.worn_images.insert(aged, images.clone());
                images
            }
        };
        self.images.insert((key, self.weather), images.clone());
        images
    }

    /// Bakes the images of panels.
    pub(super) fn panel_images(&mut self, panels: &[Panel]) -> Rc<[PanelImage]> {
        let image = |panel: &Panel| {
            let worn = self.weather.wear(panel.soups.clone());
            let picture = bake(&worn, panel.rect, WALL);
            PanelImage {
                spot: picture.map(|picture| self.atlas.place(&picture)),
                panes: panes(panel)
                    .map(|(glass, rect)| (glass, panel.rect.shares_of(rect)))
                    .collect(),
            }
        };
        panels.iter().map(image).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::in_steps;

    #[test]
    fn sizes_of_images_are_near_those_of_parts() {
        let mut steps: Vec<u32> = (1..60_000).map(in_steps).collect();
        for (length, step) in (1..).zip(&steps) {
            assert!(step.abs_diff(length) * 64 <= length, "{length}: {step}");
        }
        assert!(steps.is_sorted());
        steps.dedup();
        assert!(steps.len() < 400, "{}", steps.len());
        assert_eq!(in_steps(0), 0);
    }
}
