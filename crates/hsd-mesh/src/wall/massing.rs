//! Detail 0: a storey as one mesh of flat walls, in bands of the colours of its parts.
//!
//! Walls are open above and below, where roofs and the ground close them; there is no interior.

use crate::mesh::Soup;
use crate::mesh::panel::Rect;
use crate::part::DADO;
use crate::part::bay::{Bay, HALF_POST};
use crate::store::draft::MeshDraft;
use crate::store::from_afar::Stripe;
use crate::store::look::{Look, Share, Shown};
use crate::wall::member::{PLATE, SILL};
use crate::wall::{Line, PlacedUnit};
use crate::weather::Weather;
use crate::{Level, Walker, turn_of};
use glam::{DVec3, dvec2};
use hsd_base::geometry::FOUNDATION;
use hsd_base::geometry::SHAKU;
use hsd_ir::building::Ring;
use hsd_ir::catalog::body::{Element, Shape};
use hsd_ir::catalog::{Below, Catalog, PartId, Stance};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::{Content, PictureId, Unit};
use hsd_scene::{Detail, MeshId};
use smallvec::{SmallVec, smallvec};
use std::sync::LazyLock;

/// Corners sharper than this many faces are not mitred to their point.
const LONGEST: f64 = 4.0;

/// Room is made for so many faces of each colour of a storey; few have more.
const USUAL: usize = 8;

/// How much more of a post is seen because it stands before its wall and one looks along it, metres.
const PROUD: f64 = 0.04;

/// The surfaces of the frame (posts, plates, sills) and of the foundation under it.
static FRAME: LazyLock<[SurfaceId; 2]> = LazyLock::new(|| ["cedar", "stone"].map(SurfaceId::named));

/// A horizontal stripe of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Band {
    /// Foot and top above the storey's floor, metres.
    z: (f64, f64),
    shown: Shown,
    /// True if the material is an image that spans the band once.
    picture: bool,
}

/// A picture that hangs on a part.
struct Hung {
    picture: PictureId,
    /// From the unit's left end and above the floor, metres.
    area: Rect,
}

/// The visible stripes of a unit, and the pictures that hang on it.
#[derive(Default)]
struct Seen {
    /// From its foot to its top.
    bands: Vec<Band>,
    pictures: Vec<Hung>,
}

/// Adjacent units that look the same.
struct Stretch {
    /// Distance from the wall's right end, metres.
    from: f64,
    to: f64,
    face: f64,
    /// Heights at the right and left end, metres, and that at which the highest band is level.
    tops: (f64, f64),
    top: f64,
    bands: Vec<Band>,
}

impl Walker<'_> {
    /// Returns the mesh of a storey's walls; `None` if it has none.
    pub(crate) fn body(&mut self, level: Level<'_>) -> Option<MeshId> {
        let mut soups: Vec<(Look, Soup)> = vec![];
        for ring in &level.storey.rings {
            self.walls(level, ring, &mut soups);
        }
        soups.retain(|(_, soup)| !soup.indices.is_empty());
        if soups.is_empty() {
            return None;
        }
        let name = format!("walls {}", level.storey.number);
        Some(self.store.push(MeshDraft::part(name, soups)))
    }

    fn walls(&mut self, level: Level<'_>, ring: &Ring, soups: &mut Vec<(Look, Soup)>) {
        let lines = self.lines(level, ring);
        // Textures go on round corners, so that the walls have their vertices there in common.
        let mut along = 0.0;
        for (i, line) in lines.iter().enumerate() {
            let (before, after) = Line::beside(&lines, i);
            let first = before.map_or(0.0, |b| corner(b, line));
            let last = after.map_or(0.0, |a| corner(line, a));
            let from = along - first;
            along = from - line.length - last;
            self.air = self.air_before(level, line.wall);
            let mut stretches = self.stretches(level, line);
            let mut above = self.stretches_above(level, line);
            self.air = None;
            for list in [&mut stretches, &mut above] {
                if let Some(stretch) = list.first_mut().filter(|s| s.from < 1e-6) {
                    stretch.from -= first;
                }
                if let Some(stretch) = list.last_mut().filter(|s| s.to > line.length - 1e-6) {
                    stretch.to += last;
                }
                // In a reflex corner the other wall may hide all of it.
                list.retain(|s| s.to - s.from > 1e-6);
            }
            let at = level.house.place(line.wall.from, 0.0);
            let turn = turn_of(line.wall.direction);
            let place = |x: f64, face: f64, z: f64| {
                let flat = turn.rotate(dvec2(x, -face));
                at + flat.extend(z)
            };
            for stretch in stretches.into_iter().chain(above) {
                draw(&stretch, from, place, soups);
            }
        }
    }

    /// Returns the solid sections of a wall, adjacent units of equal look merged.
    fn stretches(&mut self, level: Level<'_>, line: &Line<'_>) -> Vec<Stretch> {
        let mut stretches: Vec<Stretch> = vec![];
        let catalog = self.catalog;
        let shown = |s: &PlacedUnit<'_>| s.solid() && !shows_through(catalog, level, s);
        for (i, placed) in line.units.iter().enumerate().filter(|(_, s)| shown(s)) {
            self.store.weather = self.weather_from_afar(level, placed, i + 1);
            let mut seen = Seen::default();
            let all = (0.0, placed.top());
            self.bands(placed.unit, (level, placed), all, &mut seen);
            let bands = &mut seen.bands;
            // Walls go down to the ground; no picture does, since it would be stretched.
            let lowest = bands.iter_mut().find(|b| b.z.0.abs() < 1e-3 && !b.picture);
            if let Some(band) = lowest.filter(|_| level.grounded()) {
                band.z.0 = -FOUNDATION;
            } else if level.grounded() {
                let stone = self.store.surface_at(SurfaceId::named("stone"), 0.0);
                bands.push(Band {
                    z: (-FOUNDATION, 0.0),
                    shown: Shown::of(stone),
                    picture: false,
                });
            }
            let at = |by: f64| {
                let (right, left) = placed.tops;
                right + (left - right) * by / placed.width
            };
            for (from, to, bands) in seen.sections(placed.width) {
                let stretch = Stretch {
                    from: placed.offset + from,
                    to: placed.offset + to,
                    face: placed.face,
                    tops: (at(from), at(to)),
                    top: placed.top(),
                    bands,
                };
                match stretches.last_mut().filter(|s| s.goes_on(&stretch)) {
                    Some(last) => last.to = stretch.to,
                    None => stretches.push(stretch),
                }
            }
        }
        stretches
    }

    /// Returns the weather of a unit as it is seen from afar: walls of one surface have that of the whole wall, so that
    /// neighbours stay one face, joinery has its own.
    fn weather_from_afar(
        &self,
        level: Level<'_>,
        placed: &PlacedUnit<'_>,
        number: usize,
    ) -> Weather {
        let is_joinery = |id: PartId| {
            let afar = self.store.afar(id, self.catalog.part(id));
            afar.is_some_and(|stripes| stripes.iter().any(|s| !s.textured))
        };
        match &placed.unit.content {
            content @ Content::Part(id) if is_joinery(*id) => {
                self.unit_weather(number, content, (0.0, placed.top()))
            }
            _ => self.frame((0.0, level.height)),
        }
    }

    /// Returns the wall above units of which a ceiling covers only a part.
    fn stretches_above(&mut self, level: Level<'_>, line: &Line<'_>) -> Vec<Stretch> {
        let mut found = vec![];
        for placed in line.units.iter().filter(|s| s.solid()) {
            let sections = placed.sections(level, line.wall);
            if sections.len() < 2 {
                continue;
            }
            let (base, unit) = (placed.top(), level.house.unit);
            for section in sections {
                let (right, left) = section.tops;
                if right.max(left) - base < 1e-3 {
                    continue;
                }
                let z = (base, right.min(left));
                let look = self
                    .store
                    .surface_at(placed.around, f64::midpoint(z.0, z.1));
                let [from, to] = [section.from, section.to].map(|u| placed.offset + u * unit);
                found.push(Stretch {
                    from,
                    to,
                    face: placed.face,
                    tops: section.tops,
                    top: right.min(left),
                    bands: vec![Band {
                        z,
                        shown: Shown::of(look),
                        picture: false,
                    }],
                });
            }
        }
        found
    }

    /// Returns a stripe in the mean colour of what is seen there; `height` is that of the part to which it belongs.
    fn band(
        &self,
        (level, placed): (Level<'_>, &PlacedUnit<'_>),
        (from, to): (f64, f64),
        (stripe, height): (&Stripe, f64),
    ) -> Band {
        let middle = f64::midpoint(from, to);
        let colour = |id: SurfaceId| self.store.colour_at(id, middle);
        let [wood, stone] = FRAME.map(colour);
        let mut mean = stripe.mean((placed.width, height), colour);
        if level.post().is_none() && placed.stance == Stance::Posts {
            mean = mixed(mean, wood, (2.0 * HALF_POST + PROUD) / placed.width);
            if (to - placed.top()).abs() < 1e-3 {
                mean = mixed(mean, wood, PLATE / (to - from));
            }
        }
        // The lowest stripe goes down to the ground, over the sill and the stones under it.
        if level.grounded() && from.abs() < 1e-3 {
            let below = |height: f64| height / (to + FOUNDATION);
            mean = mixed(mean, wood, below(SILL));
            mean = mixed(mean, stone, below(FOUNDATION - SILL));
        }
        Band {
            z: (from, to),
            shown: self.store.seen_at(stripe, mean, middle),
            picture: false,
        }
    }

    /// Returns the stripes of a unit from its foot to its top; the first unit of a half stands for all of it.
    fn bands(
        &mut self,
        unit: &Unit,
        (level, placed): (Level<'_>, &PlacedUnit<'_>),
        z: (f64, f64),
        out: &mut Seen,
    ) {
        let (z0, z1) = z;
        match &unit.content {
            Content::Void => {}
            Content::Picture(id) => out.bands.push(Band {
                z,
                shown: Shown::of(Look::Picture(id.0, Share::default())),
                picture: true,
            }),
            Content::Split(split) => {
                let middle = z1 - (z1 - z0) * split.ratio.clamp(0.0, 1.0);
                if let Some(unit) = split.lower.first() {
                    self.bands(unit, (level, placed), (z0, middle), out);
                }
                if let Some(unit) = split.upper.first() {
                    self.bands(unit, (level, placed), (middle, z1), out);
                }
            }
            Content::Part(id) => self.part_bands(*id, unit.picture, (level, placed), z, out),
        }
    }

    /// Returns the stripes of a part and of the wall above and below it.
    fn part_bands(
        &self,
        id: PartId,
        picture: Option<PictureId>,
        at: (Level<'_>, &PlacedUnit<'_>),
        z: (f64, f64),
        out: &mut Seen,
    ) {
        let ((z0, z1), placed) = (z, at.1);
        let mut band = |from: f64, to: f64, afar: &[Stripe]| {
            let height = to - from;
            for stripe in afar.iter().filter(|_| height > 1e-3) {
                let z = (from + height * stripe.z.0, from + height * stripe.z.1);
                out.bands.push(self.band(at, z, (stripe, height)));
            }
        };
        let definition = self.catalog.part(id);
        let around = [Stripe::of_surface(placed.around)];
        let main = self.store.afar(id, definition);
        let main = main.as_ref().map_or(&around[..], |stripes| &stripes[..]);
        let fills_half = definition.fills && z != (0.0, placed.top());
        let (foot, top) = match (definition.from, definition.to) {
            (Some(from), Some(to)) if !fills_half => {
                ((from * SHAKU).clamp(z0, z1), (to * SHAKU).clamp(z0, z1))
            }
            _ => z,
        };
        let boarded = match definition.below {
            Below::Dado => (z0 + DADO).min(foot),
            _ => z0,
        };
        if boarded > z0 {
            let boards = [Stripe::of_surface(SurfaceId::named("boards"))];
            band(z0, boarded, &boards);
        }
        band(boarded, foot, &around);
        // Beside a picture one sees the wall on which it hangs.
        band(foot, top, if picture.is_some() { &around } else { main });
        band(top, z1, &around);
        if let Some(picture) = picture {
            let size = (placed.width, z1 - z0);
            let (width, opening) = (placed.width, (foot - z0, top - z0));
            let bay = Bay::new(definition, size, opening, placed.around, Detail::Body, None);
            let shows = |e: &&Element| matches!(e.shape, Shape::Shown(_));
            let element = definition.body.iter().find(shows);
            let area = element.and_then(|e| bay.rect(&e.place, None));
            // Cloths and the like show theirs over the whole opening.
            let r = area.unwrap_or(bay.opening.across(0.0, width));
            let area = Rect {
                x0: r.x0.clamp(0.0, width),
                x1: r.x1.clamp(0.0, width),
                z0: (z0 + r.z0).clamp(z0, z1),
                z1: (z0 + r.z1).clamp(z0, z1),
            };
            if area.width() > 1e-3 && area.height() > 1e-3 {
                out.pictures.push(Hung { picture, area });
            }
        }
    }
}

impl Seen {
    /// Returns sections between two distances from the right end of a unit of a width, each with its bands.
    fn sections(self, width: f64) -> Vec<(f64, f64, Vec<Band>)> {
        let Some(Hung { area, .. }) = self.pictures.first() else {
            return vec![(0.0, width, self.bands)];
        };
        let (right, left) = (width - area.x1, width - area.x0);
        let mut middle = self.bands.clone();
        for Hung { picture, area } in &self.pictures {
            let (foot, top) = (area.z0, area.z1);
            let parts = |band: &Band| {
                let (z0, z1) = band.z;
                let below = Band {
                    z: (z0, z1.min(foot)),
                    ..*band
                };
                let above = Band {
                    z: (z0.max(top), z1),
                    ..*band
                };
                [below, above]
            };
            middle = middle.iter().flat_map(parts).collect();
            middle.retain(|band| band.z.1 - band.z.0 > 1e-3);
            middle.push(Band {
                z: (foot, top),
                shown: Shown::of(Look::Picture(picture.0, Share::default())),
                picture: true,
            });
        }
        let sections = [
            (0.0, right, self.bands.clone()),
            (right, left, middle),
            (left, width, self.bands),
        ];
        let wide = |(from, to, _): &(f64, f64, Vec<Band>)| to - from > 1e-3;
        sections.into_iter().filter(wide).collect()
    }
}

impl Stretch {
    /// Returns true if another one goes on with what this one shows.
    fn goes_on(&self, next: &Stretch) -> bool {
        let level = (self.tops.0 - self.tops.1).abs() < 1e-6 && next.tops == self.tops;
        let near = (self.to - next.from).abs() < 1e-6 && self.face == next.face;
        level && near && self.bands == next.bands && self.bands.iter().all(|b| !b.picture)
    }
}

/// Returns a colour of which another one covers a share, at most half.
fn mixed(colour: [f32; 3], other: [f32; 3], share: f64) -> [f32; 3] {
    let share = share.min(0.5) as f32;
    std::array::from_fn(|k| colour[k] + (other[k] - colour[k]) * share)
}

/// Returns true if a bay is open between posts that are drawn.
fn shows_through(catalog: &Catalog, level: Level<'_>, placed: &PlacedUnit<'_>) -> bool {
    match &placed.unit.content {
        Content::Part(id) => {
            level.post().is_some() && crate::wall::room::is_open(catalog.part(*id))
        }
        _ => false,
    }
}

/// Returns how far the outer faces of two walls extend beyond the corner between them, metres; negative in reflex
/// corners.
fn corner(before: &Line<'_>, line: &Line<'_>) -> f64 {
    let (Some(last), Some(first)) = (before.end(true), line.end(false)) else {
        return 0.0;
    };
    let (a, b) = (turn_of(before.wall.direction), turn_of(line.wall.direction));
    let (cos, sin) = (a.dot(b), b.perp_dot(a));
    if sin.abs() < 1e-4 {
        return 0.0;
    }
    // Both faces are taken as equally far out: corners of unlike walls differ by millimetres.
    let face = (last.face + first.face) / 2.0;
    (face * (1.0 - cos) / sin).clamp(-LONGEST * face, LONGEST * face)
}

/// Adds the quads of a section. `along` is the texture's place at the wall's right end, metres.
fn draw(
    stretch: &Stretch,
    along: f64,
    place: impl Fn(f64, f64, f64) -> DVec3,
    soups: &mut Vec<(Look, Soup)>,
) {
    let (left, right) = (-stretch.to, -stretch.from);
    for band in &stretch.bands {
        let look = band.shown.look;
        let at = soups.iter().position(|(id, _)| *id == look);
        let at = at.unwrap_or_else(|| {
            soups.push((look, Soup::with_room_for(USUAL)));
            soups.len() - 1
        });
        let (z0, z1) = band.z;
        // The highest one follows a sloping top.
        let (high_left, high_right) = match (z1 - stretch.top).abs() < 1e-6 {
            true => (stretch.tops.1, stretch.tops.0),
            false => (z1, z1),
        };
        let mut corners: SmallVec<[(f64, f64); 4]> = smallvec![(left, z0), (right, z0)];
        let high = [(right, high_right), (left, high_left)];
        corners.extend(high.into_iter().filter(|(_, z)| z - z0 > 1e-6));
        let points = corners.iter().map(|(x, z)| place(*x, stretch.face, *z));
        let points: SmallVec<[DVec3; 4]> = points.collect();
        let soup = &mut soups[at].1;
        let first = soup.positions.len();
        soup.face(&points, false);
        // Pictures of walls go on along the wall; those of parts fill the band.
        for (uv, (x, z)) in soup.uvs[first..].iter_mut().zip(corners) {
            let whole = dvec2((x - left) / (right - left), (z - z0) / (z1 - z0));
            let of_texture = match band.picture {
                true => whole,
                false => dvec2(x + along, z),
            };
            *uv = band.shown.place.unwrap_or(of_texture.as_vec2().to_array());
        }
    }
}
