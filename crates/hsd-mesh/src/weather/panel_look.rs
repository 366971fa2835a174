//! The looks of weathered panels: few, so that the panels of an old town share their images.
//!
//! What is reduced is the visible result of the exact weather, never the weather itself: materials that weather alike are at
//! the stage that most of their area has reached. All surfaces of a panel are darkened together, by its material, and those
//! that are clearly darker than the rest, such as wood under eaves, once more in the image.

use crate::mesh::Soup;
use crate::mesh::panel::{Panel, Rect};
use crate::weather::Weather;
use glam::DVec3;
use hsd_ir::material::{Class, State, SurfaceId};

/// Number of heights in a panel at which the weather is looked up.
const BANDS: usize = 16;

/// Shades by which the darker surfaces of an image differ from the others.
const DARKER: usize = 2;

/// The areas of a panel's surfaces that are seen, by height.
#[derive(Debug)]
pub(crate) struct PanelAreas {
    rect: Rect,
    surfaces: Vec<(SurfaceId, [f64; BANDS])>,
}

/// The look of a panel.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct PanelLook {
    /// The surfaces that weather, and those that stand for them in the image.
    pub(crate) surfaces: Vec<(SurfaceId, SurfaceId)>,
    /// The shade of the whole panel.
    pub(crate) shade: usize,
}

impl PanelLook {
    /// Returns what a surface of the panel shows in its image.
    pub(crate) fn shown(&self, id: SurfaceId) -> SurfaceId {
        let found = self.surfaces.iter().find(|(own, _)| *own == id);
        found.map_or(id, |(_, shown)| *shown)
    }
}

impl PanelAreas {
    /// Measures a panel.
    pub(crate) fn of(panel: &Panel) -> PanelAreas {
        let rect = panel.rect;
        let mut surfaces: Vec<(SurfaceId, [f64; BANDS])> = vec![];
        for (id, soup) in panel.soups.iter().filter(|(id, _)| !id.surface().glass) {
            let at = surfaces.iter().position(|(known, _)| known == id);
            let at = at.unwrap_or_else(|| {
                surfaces.push((*id, [0.0; BANDS]));
                surfaces.len() - 1
            });
            for triangle in soup.indices.chunks_exact(3) {
                let (z, area) = seen(soup, triangle);
                let band = (z - rect.z0) / rect.height() * BANDS as f64;
                surfaces[at].1[(band.max(0.0) as usize).min(BANDS - 1)] += area;
            }
        }
        PanelAreas { rect, surfaces }
    }

    /// Returns the look of the panel in some weather.
    pub(crate) fn look(&self, weather: Weather) -> PanelLook {
        if weather == Weather::None {
            return PanelLook::default();
        }
        let groups = self.groups(weather);
        // Surfaces are as dark as the brightest of them, or clearly darker.
        let base = groups.iter().map(|(_, votes)| votes.shade());
        let base = base.reduce(f64::min).unwrap_or(0.0);
        let mut surfaces = vec![];
        for (id, _) in &self.surfaces {
            let Some((_, votes)) = groups.iter().find(|(kind, _)| Some(*kind) == kind_of(*id))
            else {
                continue;
            };
            let state = State {
                stage: votes.stage(),
                shade: if votes.shade() - base < 1.0 {
                    0
                } else {
                    DARKER
                },
            };
            surfaces.push((*id, id.in_state(state)));
        }
        PanelLook {
            surfaces,
            shade: (base + 0.5) as usize,
        }
    }

    /// Returns the kinds of material with the areas in each state.
    fn groups(&self, weather: Weather) -> Vec<(Kind, Votes)> {
        let mut groups: Vec<(Kind, Votes)> = vec![];
        for (id, bands) in &self.surfaces {
            let Some(kind) = kind_of(*id) else {
                continue;
            };
            let at = groups.iter().position(|(known, _)| *known == kind);
            let at = at.unwrap_or_else(|| {
                groups.push((kind, Votes::default()));
                groups.len() - 1
            });
            let votes = &mut groups[at].1;
            for (area, band) in bands.iter().zip(0..).filter(|(area, _)| **area > 0.0) {
                let share = (f64::from(band) + 0.5) / BANDS as f64;
                let z = self.rect.z0 + self.rect.height() * share;
                let wear = weather.wear_at(z, [0.0, -1.0, 0.0]);
                if let Some(state) = wear.and_then(|wear| id.state(wear)) {
                    votes.add(state, *area);
                }
            }
        }
        groups.retain(|(_, votes)| votes.area > 0.0);
        groups
    }
}

/// What weathers alike: the class and the number of stages.
type Kind = (Class, usize);

fn kind_of(id: SurfaceId) -> Option<Kind> {
    let material = id.surface().material?;
    Some((material.class, material.stages.len()))
}

/// The areas of one kind of material by state.
#[derive(Debug, Default)]
struct Votes {
    area: f64,
    stages: [f64; 4],
    /// Sum of shade times area.
    shade: f64,
}

impl Votes {
    fn add(&mut self, state: State, area: f64) {
        self.area += area;
        self.shade += state.shade as f64 * area;
        if let Some(stage) = self.stages.get_mut(state.stage) {
            *stage += area;
        }
    }

    /// Returns the stage of the largest area.
    fn stage(&self) -> usize {
        let all = self.stages.iter().enumerate();
        let most = all.max_by(|a, b| a.1.total_cmp(b.1));
        most.map_or(0, |(stage, _)| stage)
    }

    /// Returns the mean shade.
    fn shade(&self) -> f64 {
        self.shade / self.area
    }
}

/// Returns the height of a triangle's middle and its area as seen from the front.
fn seen(soup: &Soup, triangle: &[u32]) -> (f64, f64) {
    let normal = soup.normals[triangle[0] as usize];
    let [a, b, c] = [0, 1, 2].map(|k| {
        let p = soup.positions[triangle[k] as usize];
        DVec3::from(p.map(f64::from))
    });
    let low = a.z.min(b.z).min(c.z);
    let high = a.z.max(b.z).max(c.z);
    let area = match normal[1] < 0.0 {
        true => (b - a).cross(c - a).y.abs() / 2.0,
        false => 0.0,
    };
    // Both triangles of an upright rectangle lie between the same heights.
    ((low + high) / 2.0, area)
}

#[cfg(test)]
mod tests;
