//! Builds one wall: its units from right to left, each in its place.

pub(crate) mod massing;
pub(crate) mod ceiling;
mod finish;
pub(crate) mod index;
pub(crate) mod corner;
mod door_step;
pub(crate) mod parapet;
pub(crate) mod room;
pub(crate) mod member;

use crate::part::bay::Layer;
use crate::store::draft::MeshDraft;
use crate::store::look::{Look, Share};
use crate::store::{Key, PartKey, tenths};
use crate::wall::ceiling::Section;
use crate::wall::finish::{default_finish, finish_of};
use crate::wall::member::LintelRoom;
use crate::{Level, Walker, part, turn_of};
use compact_str::{CompactString, ToCompactString, format_compact};
use glam::dvec3;
use hsd_base::geometry::{SAME, SHAKU};
use hsd_ir::building::Wall;
use hsd_ir::catalog::{Catalog, PartDef, PartId, Stance};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::{Content, PictureId, Split, Unit};
use hsd_scene::{Kind, MeshId, NodeId, PartNames};
use std::num::NonZeroU32;
use std::sync::Arc;

/// A wall with the properties that its units need of each other.
pub(super) struct Line<'a> {
    pub(super) wall: &'a Wall,
    pub(super) units: Vec<PlacedUnit<'a>>,
    /// Its length, metres.
    pub(super) length: f64,
    /// True if it is an outer wall round an area.
    pub(super) bounds: bool,
}

/// A unit in its place.
#[derive(Clone, Copy)]
pub(super) struct PlacedUnit<'a> {
    pub(super) unit: &'a Unit,
    /// Distance from the wall's right end to the unit's, metres.
    pub(super) offset: f64,
    /// Its width, metres.
    pub(super) width: f64,
    /// How it joins the wall; `Free` for voids and members without width.
    pub(super) stance: Stance,
    /// Distance of its outer plane from the centre line, metres.
    pub(super) face: f64,
    /// The finish of infill walls beside it.
    pub(super) around: SurfaceId,
    /// Height at its right and left end, metres.
    pub(super) tops: (f64, f64),
    /// The height that it would have without ceilings, metres.
    own_top: f64,
}

impl PlacedUnit<'_> {
    /// Returns true if it has a wall to join.
    pub(super) fn solid(&self) -> bool {
        self.width > 0.0 && self.stance != Stance::Free
    }

    /// Returns true if it is a post written in the source file.
    pub(super) fn is_post(&self) -> bool {
        self.width == 0.0
    }

    /// Returns the height of its horizontal top, metres.
    pub(super) fn top(&self) -> f64 {
        self.tops.0.min(self.tops.1)
    }

    /// Returns the sections of its top where they are not all level with it.
    pub(super) fn sections(&self, level: Level<'_>, wall: &Wall) -> Vec<Section> {
        if self.top() == self.own_top {
            return vec![];
        }
        let unit = level.house.unit;
        let at = |x: f64| wall.from + wall.direction * (x / unit);
        let (from, to) = (at(self.offset), at(self.offset + self.width));
        ceiling::sections(level, from, to, self.own_top)
    }
}

impl<'a> Line<'a> {
    /// Places the units of a wall.
    pub(super) fn new(catalog: &'a Catalog, level: Level<'_>, wall: &'a Wall) -> Line<'a> {
        let unit_m = level.house.unit;
        let mut offset = 0.0;
        let mut units = Vec::with_capacity(wall.units.len());
        let unset = SurfaceId::named("cedar");
        // A row mostly goes on with the part before.
        let mut known: Option<(PartId, (Stance, f64), f64)> = None;
        for unit in &wall.units {
            let to = offset + unit.width;
            let ((stance, face), own_top) = match (&unit.content, known) {
                (Content::Part(id), Some((before, stance, top))) if *id == before => (stance, top),
                (content, _) => (stance(catalog, content), own_top(catalog, content)),
            };
            if let Content::Part(id) = unit.content {
                known = Some((id, (stance, face), own_top));
            }
            let top = unit.height.map_or(level.height, |h| f64::from(h) * SHAKU);
            let top = top.min(own_top).min(level.storey.wall_height());
            let at = |u: f64| wall.from + wall.direction * u;
            units.push(PlacedUnit {
                unit,
                offset: offset * unit_m,
                width: unit.width * unit_m,
                stance,
                face,
                around: unset,
                own_top: top,
                tops: match level.ceilings.is_empty() {
                    true => (top, top),
                    false => ceiling::tops(level, at(offset), at(to), top),
                },
            });
            offset = to;
        }
        let finishes = |i: usize| finish_of(catalog, &wall.units[i].content);
        neighbours(catalog, &mut units, finishes);
        Line {
            wall,
            units,
            length: offset * unit_m,
            bounds: false,
        }
    }

    /// Returns the walls that meet the ends of one wall of a ring.
    pub(super) fn beside<'l>(
        lines: &'l [Line<'a>],
        i: usize,
    ) -> (Option<&'l Line<'a>>, Option<&'l Line<'a>>) {
        let n = lines.len();
        let (before, line, after) = (&lines[(i + n - 1) % n], &lines[i], &lines[(i + 1) % n]);
        let meets = |a: &Line<'_>, b: &Line<'_>| a.wall.to.distance(b.wall.from) < SAME;
        (
            meets(before, line).then_some(before),
            meets(line, after).then_some(after),
        )
    }

    /// Returns the first unit with a wall, seen from the right end, or from the left.
    pub(super) fn end(&self, left: bool) -> Option<&PlacedUnit<'a>> {
        let mut wide = self.units.iter().filter(|s| s.width > 0.0);
        let placed = if left { wide.next_back() } else { wide.next() };
        placed.filter(|s| s.solid())
    }

    /// Returns true if the source file places a post at the right end, or the left.
    pub(super) fn has_post(&self, left: bool) -> bool {
        let end = if left {
            self.units.last()
        } else {
            self.units.first()
        };
        end.is_some_and(|s| s.is_post())
    }
}

/// Returns the height of units lower than their storey, such as fences, metres.
fn own_top(catalog: &Catalog, content: &Content) -> f64 {
    let part = match content {
        Content::Part(id) => Some(catalog.part(*id)),
        _ => None,
    };
    let fence = part.filter(|p| p.stance == Stance::Fence);
    fence
        .and_then(|p| p.to)
        .map_or(f64::INFINITY, |to| to * SHAKU)
}

/// Returns how a unit joins its wall, and its outer plane.
fn stance(catalog: &Catalog, content: &Content) -> (Stance, f64) {
    match content {
        Content::Void => (Stance::Free, 0.0),
        Content::Picture(_) => (Stance::Modern, PICTURE.front),
        Content::Part(id) => {
            let part = catalog.part(*id);
            (part.stance, part::face(part))
        }
        Content::Split(split) => {
            let both = split.lower.iter().chain(&split.upper);
            let all = both.map(|u| stance(catalog, &u.content));
            // The half with posts needs them beside it.
            all.reduce(|a, b| if b.0 == Stance::Posts { b } else { a })
                .unwrap_or((Stance::Free, 0.0))
        }
    }
}

/// Gives each unit the finish of the nearest wall part, the left one if two are equally near.
fn neighbours(
    catalog: &Catalog,
    units: &mut [PlacedUnit<'_>],
    finish: impl Fn(usize) -> Option<SurfaceId>,
) {
    let n = units.len();
    // Units run to the left: what follows in the list is on the left.
    let mut left: Option<(usize, SurfaceId)> = None;
    let mut lefts = vec![None; n];
    for i in (0..n).rev() {
        left = finish(i).map(|f| (i, f)).or(left);
        lefts[i] = left;
    }
    let mut right: Option<(usize, SurfaceId)> = None;
    for i in 0..n {
        right = finish(i).map(|f| (i, f)).or(right);
        units[i].around = match (lefts[i], right) {
            (Some((l, f)), Some((r, _))) if l - i <= i - r => f,
            (_, Some((_, f))) | (Some((_, f)), None) => f,
            (None, None) => default_finish(catalog, &units[i].unit.content),
        };
    }
}

/// The panel that carries a part texture, projecting as far as a wall.
const PICTURE: Layer = Layer {
    front: 0.060,
    thick: 0.070,
};

/// The place of one unit or sub-unit in a facade.
#[derive(Clone, Copy)]
struct Slot<'a> {
    facade: NodeId,
    /// Left end, metres from the facade's origin (negative).
    x: f64,
    width: f64,
    /// Foot and top above the storey's floor, metres.
    z: (f64, f64),
    around: SurfaceId,
    /// Depth available for a passage behind it, metres.
    room: f64,
    /// True if its foot stands on the foundation.
    grounded: bool,
    /// Half the width of a post written in the source file, metres.
    post: Option<f64>,
    /// True if the facade's glass reflects.
    mirrors: bool,
    /// True if it is half of a split unit.
    half: bool,
    /// Position in the facade and, in splits, the half.
    number: (usize, &'a str),
    /// Position in the half.
    within: usize,
}

impl Walker<'_> {
    /// Adds a facade with its corners, units and members.
    pub(super) fn facade(
        &mut self,
        level: Level<'_>,
        line: &Line<'_>,
        before: Option<&Line<'_>>,
        after: Option<&Line<'_>>,
    ) {
        self.air = self.air_before(level, line.wall);
        let facade = self.facade_node(level, line);
        for (i, placed) in line.units.iter().enumerate() {
            self.placed_unit(level, facade, line, placed, i + 1);
            if self.is_full() {
                return;
            }
        }
        self.posts(level, facade, line, before, after);
        self.store.weather = self.frame((0.0, level.height));
        self.corners(level, facade, line, before);
        self.members(level, facade, line, before, after);
        self.door_steps(level, facade, line);
        self.parapet(level, facade, line);
        self.air = None;
    }

    /// Adds the node of a facade.
    pub(super) fn facade_node(&mut self, level: Level<'_>, line: &Line<'_>) -> NodeId {
        let wall = line.wall;
        let name = format_compact!("facade {}", wall.facade);
        let at = level.house.place(wall.from, 0.0);
        let node = self.node(Some(level.node), Kind::Facade, name, at);
        node.turn = turn_of(wall.direction);
        node.storey = Some(level.storey.number);
        node.facade = NonZeroU32::new(wall.facade);
        node.span = Some(wall.span);
        self.last()
    }

    /// Adds one unit, and the wedge above it.
    fn placed_unit(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        placed: &PlacedUnit<'_>,
        number: usize,
    ) {
        let slot = Slot {
            facade,
            x: -(placed.offset + placed.width),
            width: placed.width,
            z: (0.0, placed.top()),
            around: placed.around,
            room: self.room(level, line, placed),
            grounded: level.grounded(),
            post: level.post(),
            mirrors: line.wall.reflection,
            half: false,
            number: (number, ""),
            within: 0,
        };
        self.unit(level, slot, placed.unit);
        if placed.solid() {
            for (n, section) in placed.sections(level, line.wall).into_iter().enumerate() {
                self.above(level, facade, placed, section, (number, n));
            }
        }
    }

    /// Returns the depth available for a passage in this unit, metres.
    fn room(&self, level: Level<'_>, line: &Line<'_>, placed: &PlacedUnit<'_>) -> f64 {
        if !part::has_passage(self.catalog, &placed.unit.content) {
            return part::DEEPEST;
        }
        let unit = level.house.unit;
        let offsets = (placed.offset / unit, (placed.offset + placed.width) / unit);
        let standing = level
            .standing
            .get_or_init(|| crate::wall::index::WallIndex::of(level.storey));
        standing.room(line.wall, offsets, unit, part::DEEPEST)
    }

    /// Adds the content of a slot.
    fn unit(&mut self, level: Level<'_>, slot: Slot<'_>, unit: &Unit) {
        let place = slot.number.0 + slot.within * 1000;
        self.store.weather = self.unit_weather(place, &unit.content, slot.z);
        let (mesh, code, names): (MeshId, &str, Option<Arc<PartNames>>) = match &unit.content {
            Content::Void => return,
            Content::Split(split) => return self.split(level, slot, split),
            Content::Part(id) => {
                let part = self.catalog.part(*id);
                if self.catalog.is_void(*id) {
                    return;
                }
                let names = self.names.entry(*id);
                let names = names
                    .or_insert_with(|| Arc::new(part::names_of(part)))
                    .clone();
                (self.part(slot, unit, *id, part), part.code(), Some(names))
            }
            Content::Picture(id) => (self.picture(slot, unit, *id), "picture", None),
        };
        let (number, half) = slot.number;
        let name = name(code.trim_end(), half, number);
        let at = dvec3(slot.x, 0.0, slot.z.0);
        let node = self.node(Some(slot.facade), Kind::Part, name, at);
        node.mesh = Some(mesh);
        node.code = names.as_ref().map(|_| code.into());
        node.names = names;
        node.storey = Some(level.storey.number);
        node.span = Some(unit.span);
    }

    /// Returns the mesh of a part in a slot.
    fn part(&mut self, slot: Slot<'_>, unit: &Unit, id: PartId, part: &PartDef) -> MeshId {
        let height = slot.z.1 - slot.z.0;
        let (z0, z1) = opening(part, slot, height);
        let share = match (slot.mirrors, unit.reflection) {
            (false, _) => 0.0,
            (true, Some(share)) => f64::from(share),
            (true, None) => part.reflection.unwrap_or(0.0),
        };
        // Whole walls look the same beside any neighbour.
        let around = match (part.finish, part.from) {
            (Some(own), _) => own,
            (None, None) => SurfaceId::named("cedar"),
            (None, Some(_)) => slot.around,
        };
        let key = PartKey {
            part: id.0,
            around,
            share: match part.reflection {
                Some(_) => Share::new(share),
                None => Share::default(),
            },
            size: [slot.width, height, z0, z1].map(tenths),
            post: slot.post.map_or(0, tenths),
            room: part::passage(part).map_or(0, |depth| tenths(slot.room.min(depth))),
            grounded: slot.grounded && slot.z.0 == 0.0 && part::is_wing(part),
            picture: unit.picture.map_or(0, |id| id.0 + 1),
        };
        self.store.part(id, part, key)
    }

    /// Adds a flat panel with the texture on its front.
    fn picture(&mut self, slot: Slot<'_>, unit: &Unit, id: PictureId) -> MeshId {
        let height = slot.z.1 - slot.z.0;
        let share = match (slot.mirrors, unit.reflection) {
            (true, Some(share)) => Share::new(f64::from(share)),
            _ => Share::default(),
        };
        let size = [tenths(slot.width), tenths(height)];
        let key = Key::Picture([id.0, size[0], size[1], u32::from(share.0)]);
        self.store.mesh(key, |_| {
            let name = format!("picture {}", id.0 + 1);
            let front = Look::Picture(id.0, share);
            let neutral = Look::surface(SurfaceId::named("mortar"), Share::default());
            let [width, height] = size.map(|n| f64::from(n) / 10_000.0);
            let soups = member::panel(width, height, PICTURE, front, neutral);
            MeshDraft::new(name, soups, vec![])
        })
    }

    /// Adds the halves of a split unit; sub-units share its width in proportion to their own widths.
    fn split(&mut self, level: Level<'_>, slot: Slot<'_>, split: &Split) {
        let (z0, z1) = slot.z;
        let middle = z1 - (z1 - z0) * split.ratio.clamp(0.0, 1.0);
        let halves = [
            (&split.lower, (z0, middle), " lower"),
            (&split.upper, (middle, z1), " upper"),
        ];
        for (units, z, half) in halves {
            let total: f64 = units.iter().map(|u| u.width).sum();
            if total <= 0.0 || z.1 - z.0 < 1e-3 {
                continue;
            }
            let own = units
                .iter()
                .find_map(|u| finish_of(self.catalog, &u.content));
            let mut right = slot.x + slot.width;
            for (i, unit) in units.iter().enumerate() {
                let width = slot.width * unit.width / total;
                let x = right - width;
                let sub = Slot {
                    x,
                    width,
                    z,
                    around: own.unwrap_or(slot.around),
                    half: true,
                    number: (slot.number.0, half),
                    within: i,
                    ..slot
                };
                self.unit(level, sub, unit);
                let next = units.get(i + 1);
                if next.is_some_and(|next| self.framed(unit) || self.framed(next)) {
                    self.post(level, slot.facade, x, z, member::POST, false);
                }
                right = x;
            }
        }
    }

    /// Returns true if a sub-unit is between posts.
    fn framed(&self, unit: &Unit) -> bool {
        stance(self.catalog, &unit.content).0 == Stance::Posts
    }
}

/// Returns the name of a unit: code, half, number. Built without a formatter, since a town has a million of them.
fn name(code: &str, half: &str, number: usize) -> CompactString {
    let mut name = CompactString::new(code);
    name.push_str(half);
    name.push(' ');
    name.push_str(&number.to_compact_string());
    name
}

/// Returns foot and top of a part's opening above its slot's foot, moved and clamped to fit.
fn opening(part: &PartDef, slot: Slot<'_>, height: f64) -> (f64, f64) {
    let (Some(from), Some(to)) = (part.from, part.to) else {
        return (0.0, height);
    };
    if part.fills && slot.half {
        return (0.0, height);
    }
    let (from, to) = (from * SHAKU - slot.z.0, to * SHAKU - slot.z.0);
    let wanted = to - from;
    // The wall plate runs above openings between posts.
    let room = match part.stance {
        Stance::Posts if part.above => height - LintelRoom::of(height),
        _ => height,
    };
    let (mut z0, mut z1) = (from.max(0.0), to.min(room));
    if z1 - z0 < wanted / 2.0 {
        // Most of it lies elsewhere: it keeps its size and moves to the end that is nearer.
        z1 = z1.max(wanted).min(room);
        z0 = (z1 - wanted).max(0.0);
    }
    (z0, z1)
}
