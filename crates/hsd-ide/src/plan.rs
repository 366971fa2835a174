//! The plan of a source file for the plan editor: every wall with its place in the plan and in the file.
//!
//! Places are `[a, b]` in U in the author frame of their house; spans are bytes of the original file; houses, storeys,
//! rings, walls and units stand in the order of the [`Building`](hsd_ir::building::Building), by which strokes count
//! them. As JSON:
//!
//! ```json
//! {"reasons":{"repeat":"This is written once for several walls; change the file."},
//!  "houses":[{"name":"machiya","file":0,"span":[0,900],"origin":[0,0,0],"azimuth":180,"unit_m":0.909091,"street":false,
//!   "fixed":null,
//!   "storeys":[{"storey":1,"kind":"storey","z0":0,"z1":2.727273,"height":9,"file":0,"span":[300,420],"fixed":null,
//!    "rings":[{"hole":false,"inner":false,"closed":true,"walls":[
//!     {"facade":1,"from":[0,0],"to":[6,0],"file":0,"span":[300,329],"reflection":false,"fixed":null,"units":[
//!      {"code":"GSI","part":"lattice","from":[0,0],"to":[1,0],"file":0,"span":[300,305],"fixed":null}]}]}],
//!    "rooms":[{"name":"奥","at":[3,6],"floor":"tatami","mats":"festive","ceiling":"battens","height":null,"area":[[[0,4],[6,4],[6,8],[0,8]]],
//!     "laid":[[0,4,2,5]],"file":0,"span":[330,371],"fixed":null}],
//!    "fixtures":[{"kind":"tokonoma","at":[2,7],"size":[2,1],"faces":"F","built":true,"file":0,"span":[380,421],"fixed":null}],"regions":[]}],
//!   "roofs":[{"shape":"KIR","kind":"K","storey":2,"file":0,"span":[700,740],"rect":[0,0,6,8],"z":4.24,
//!     "ridge":[[6,4],[0,4]]}],
//!   "outdoors":[{"kind":"put","code":"OTO","outline":[[5,-2],[6,-2],[6,-3],[5,-3]],"file":0,"span":[750,780]}]}],
//!  "views":[{"name":"garden","from":[2,-5,1.6],"to":[-2,0,2],"fov":45,"date":null,"hour":null,"file":0,"span":[12,60]}],
//!  "places":[{"kind":"Group","origin":[0,0],"turn":0,"at":[2,3],"heading":5,"houses":[0],"fixed":null,"turn_fixed":null}],
//!  "outlines":[{"origin":[2,3],"turn":5,"corners":[[0,0],[6.2,-0.4],[6.8,8]],"fixed":null}],
//!  "doubts":[{"code":"KTU","at":[3,0],"unit":{"house":0,"storey":0,"ring":0,"wall":0,"unit":3},"file":0,"span":[310,320]}]}
//! ```
//!
//! `fixed` is null, or the key of the reason why no stroke can change an item (for a wall: move it); `reasons` has its
//! text in the requested language. `height` of a storey is in shaku, `z0`, `z1` and `z` are metres above the house's
//! origin. `places` are groups, placed houses and houses with the houses that move with them, and
//! `outlines` the surveyed ones: `origin` and `turn` are those of the frame in the world, metres and degrees clockwise;
//! `at`, `heading` (`turn` or `azimuth`) and `corners` count in it. The `part` of a unit is one of `wall`, `door`, `window`, `lattice`, `post`, `opening`, `modern`, `void`,
//! `picture`, `split`. `regions` are those of `hsd dump --stage regions`. The `rect` of a roof are its bounds with its
//! eaves, `ridge` the line of its highest points, null where that is a point, a surface or broken. `outdoors` is left out where
//! nothing stands there; its `kind` is `put` or `ground`, and `code` the part or the surface.

mod doubts;
mod outdoors;
mod roofs;
mod rooms;

pub use doubts::{DoubtfulUnit, PlanDoubt};
pub use outdoors::PlanOutdoor;
pub use rooms::{PlanFixture, PlanRoom};

use super::Analysis;
use super::stroke::{house_fixed, storey_fixed};
use crate::stroke::sheet::standing::{Standing, SurveyedOutline, outlines, standing};
use crate::stroke::sheet::{Reason, Sheet, SheetRow};
use glam::DVec2;
use hsd_base::diagnostic::Language;
use hsd_base::geometry::SHAKU;
use hsd_base::source::Span;
use hsd_dump::{Region, region};
use hsd_export::number::Number;
use hsd_ir::ast::{NamedView, StoreyKind};
use hsd_ir::building;
use hsd_ir::catalog::Catalog;
use hsd_ir::program::{self, Content};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// The plan of a source file.
#[derive(Debug, Default, Serialize)]
pub struct Plan {
    /// The texts of the reasons in it, by key.
    pub reasons: BTreeMap<&'static str, String>,
    /// In the order of the file.
    pub houses: Vec<House>,
    /// The named views, in the order of the file.
    pub views: Vec<View>,
    /// What can be moved as a whole, in the order of the file.
    pub places: Vec<PlanStanding>,
    /// Surveyed outlines, each before its courtyards.
    pub outlines: Vec<PlanOutline>,
    /// Walls in doubt, in the order of the file.
    pub doubts: Vec<PlanDoubt>,
}

/// A named view; places are metres east, north and up.
#[derive(Debug, Serialize)]
pub struct View {
    /// Its name.
    pub name: String,
    /// The place of the camera.
    pub from: [Number; 3],
    /// The middle of the picture.
    pub to: [Number; 3],
    /// Vertical angle of view, degrees.
    pub fov: Number,
    /// Year-month-day of the sun, or the usual afternoon.
    pub date: Option<String>,
    /// The hour of that day.
    pub hour: Option<Number>,
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
}

/// A group, a placed house or a house.
#[derive(Debug, Serialize)]
pub struct PlanStanding {
    /// Its element: `Group`, `Place` or `House`.
    pub kind: &'static str,
    /// The origin of its frame, metres east and north.
    pub origin: [Number; 2],
    /// The turn of its frame, degrees clockwise.
    pub turn: Number,
    /// Its place in the frame, metres.
    pub at: [Number; 2],
    /// Its `turn` or `azimuth`, degrees.
    pub heading: Number,
    /// The houses that move with it.
    pub houses: Vec<usize>,
    /// The reason why it cannot be moved.
    pub fixed: Option<&'static str>,
    /// The reason why it cannot be turned.
    pub turn_fixed: Option<&'static str>,
}

/// A surveyed outline.
#[derive(Debug, Serialize)]
pub struct PlanOutline {
    /// The origin of its frame, metres east and north.
    pub origin: [Number; 2],
    /// The turn of its frame, degrees clockwise.
    pub turn: Number,
    /// Its corners in the frame, metres, in the order of the file.
    pub corners: Vec<[Number; 2]>,
    /// The reason why its corners cannot be moved.
    pub fixed: Option<&'static str>,
}

/// A house.
#[derive(Debug, Serialize)]
pub struct House {
    /// Empty if it has none.
    pub name: String,
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
    /// East, north, up, metres.
    pub origin: [Number; 3],
    /// Direction of its front, degrees clockwise from north.
    pub azimuth: Number,
    /// Metres in one U.
    pub unit_m: Number,
    /// True if its first wall faces a street.
    pub street: bool,
    /// The reason why no storey can be added on it.
    pub fixed: Option<&'static str>,
    /// From the ground up.
    pub storeys: Vec<Storey>,
    /// Its roofs.
    pub roofs: Vec<Roof>,
    /// What stands outdoors beside it: ground, then parts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outdoors: Vec<PlanOutdoor>,
}

/// A place in the source files.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct PlanPlace {
    /// The file; 0 is the file itself.
    pub file: u32,
    /// Its range of bytes.
    pub span: Span,
}

/// A storey.
#[derive(Debug, Serialize)]
pub struct Storey {
    /// Counted from 1; a parapet has the number of the storey it crowns.
    pub storey: u32,
    /// `storey` or `parapet`.
    pub kind: &'static str,
    /// Its floor, metres above the house's origin.
    pub z0: Number,
    /// Its top, metres above the house's origin.
    pub z1: Number,
    /// Its height, shaku.
    pub height: Number,
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
    /// The reason why its height cannot be changed.
    pub fixed: Option<&'static str>,
    /// Outer walks, courtyards and walls inside.
    pub rings: Vec<Ring>,
    /// Its rooms, in the order of the file.
    pub rooms: Vec<PlanRoom>,
    /// Its fixtures, in the order of the file.
    pub fixtures: Vec<PlanFixture>,
    /// Its automatic roofs in plan.
    pub regions: Vec<Region>,
}

/// A walk.
#[derive(Debug, Serialize)]
pub struct Ring {
    /// True for a courtyard.
    pub hole: bool,
    /// True for a wall inside the storey.
    pub inner: bool,
    /// True if it ends at its start.
    pub closed: bool,
    /// In walk order.
    pub walls: Vec<Wall>,
}

/// A wall.
#[derive(Debug, Serialize)]
pub struct Wall {
    /// Its number from 1, over the storey.
    pub facade: u32,
    /// Its right end as seen from outside.
    pub from: [Number; 2],
    /// Its left end.
    pub to: [Number; 2],
    /// The place of its line in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
    /// True if its glass is reflective.
    pub reflection: bool,
    /// The reason why it cannot be moved.
    pub fixed: Option<&'static str>,
    /// From its right end to its left end.
    pub units: Vec<Unit>,
}

/// A unit of a wall.
#[derive(Debug, Serialize)]
pub struct Unit {
    /// Its code, or the name of its part or image; empty for a void or a split.
    pub code: String,
    /// Its kind.
    pub part: &'static str,
    /// Its right end.
    pub from: [Number; 2],
    /// Its left end.
    pub to: [Number; 2],
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
    /// The reason why it cannot be replaced.
    pub fixed: Option<&'static str>,
}

/// A roof.
#[derive(Debug, Serialize)]
pub struct Roof {
    /// Letters of its form.
    pub shape: &'static str,
    /// Letter of its covering.
    pub kind: char,
    /// The storey it covers, from 1.
    pub storey: u32,
    /// Its line, if it has one.
    #[serde(flatten)]
    pub place: Option<PlanPlace>,
    /// a0, b0, a1, b1 of its bounds.
    pub rect: [Number; 4],
    /// Its top, metres above the house's origin.
    pub z: Number,
    /// The ends of its ridge.
    pub ridge: Option<[[Number; 2]; 2]>,
}

impl Plan {
    /// Returns the plan of a source file, with reasons in this language.
    pub fn of(a: &Analysis, language: Language) -> Plan {
        let sheet = Sheet::of(a);
        let (building, catalog) = (&a.checked.building, a.catalog());
        let pictures = &building.images;
        let mut writer = PlanWriter {
            sheet: &sheet,
            catalog,
            pictures,
            used: BTreeSet::new(),
        };
        let houses = building.houses.iter();
        let houses = houses.map(|b| writer.house(b)).collect();
        let places = standing(&sheet);
        let places = places.into_iter().map(|s| writer.standing(s)).collect();
        let outlines = outlines(&sheet);
        let outlines = outlines.into_iter().map(|o| writer.outline(o)).collect();
        let words = |r: &Reason| (r.key(), r.text().in_language(language).into_owned());
        Plan {
            reasons: writer.used.iter().map(words).collect(),
            houses,
            views: a.checked.views.iter().map(view).collect(),
            places,
            outlines,
            doubts: doubts::all(&sheet),
        }
    }
}

fn view(view: &NamedView) -> View {
    let time = view.time.as_ref();
    View {
        name: view.name.value.clone(),
        from: view.from.map(Number),
        to: view.to.map(Number),
        fov: Number(view.fov),
        date: time.map(|t| t.date.clone()),
        hour: time.map(|t| Number(t.hour)),
        place: place(view.span),
    }
}

/// Writes a plan and collects its reasons.
struct PlanWriter<'a> {
    sheet: &'a Sheet<'a>,
    catalog: &'a Catalog,
    pictures: &'a [program::Picture],
    /// The reasons in use.
    used: BTreeSet<Reason>,
}

fn place(span: Span) -> PlanPlace {
    PlanPlace {
        file: span.file.0,
        span,
    }
}

fn point(p: DVec2) -> [Number; 2] {
    [Number(p.x), Number(p.y)]
}

impl PlanWriter<'_> {
    /// Records a reason and returns its key.
    fn told(&mut self, reason: Option<Reason>) -> Option<&'static str> {
        self.used.extend(reason);
        reason.map(Reason::key)
    }

    fn standing(&mut self, standing: Standing) -> PlanStanding {
        let [east, north, _] = standing.frame.origin;
        PlanStanding {
            kind: standing.kind(self.sheet),
            origin: [Number(east), Number(north)],
            turn: Number(standing.frame.turn),
            at: standing.at.map(Number),
            heading: Number(standing.turn),
            houses: standing.houses,
            fixed: self.told(standing.fixed),
            turn_fixed: self.told(standing.turn_fixed),
        }
    }

    fn outline(&mut self, outline: SurveyedOutline) -> PlanOutline {
        let [east, north, _] = outline.frame.origin;
        PlanOutline {
            origin: [Number(east), Number(north)],
            turn: Number(outline.frame.turn),
            corners: outline.corners.iter().map(|c| c.at.map(Number)).collect(),
            fixed: self.told(outline.fixed),
        }
    }

    fn house(&mut self, built: &building::Built) -> House {
        let (house, roofs) = (&built.house, &built.roofs);
        let storeys = house.storeys.iter().enumerate();
        let rooms = |level: usize| built.rooms.iter().filter(move |r| r.level == level);
        let storeys = storeys
            .map(|(level, s)| self.storey(s, rooms(level).collect(), built))
            .collect();
        let fixed = house_fixed(self.sheet, house);
        House {
            name: house.name.clone(),
            place: place(house.span),
            origin: house.origin.map(Number),
            azimuth: Number(house.azimuth),
            unit_m: Number(house.unit),
            street: house.street,
            fixed: self.told(fixed),
            storeys,
            roofs: roofs
                .roofs
                .iter()
                .zip(roofs.surfaces())
                .map(|(roof, surface)| roofs::roof(roof, surface, house.unit))
                .collect(),
            outdoors: outdoors::outdoors(built, self.catalog),
        }
    }

    fn storey(
        &mut self,
        storey: &building::Storey,
        rooms: Vec<&building::Room>,
        built: &building::Built,
    ) -> Storey {
        let is_storey = storey.kind == StoreyKind::Storey;
        let own = |p: &&building::StoreyPlan| is_storey && p.storey == storey.number;
        let plan = built.roofs.plans.iter().find(own);
        Storey {
            storey: storey.number,
            kind: if is_storey { "storey" } else { "parapet" },
            z0: Number(storey.z0),
            z1: Number(storey.z1),
            height: Number((storey.z1 - storey.z0) / SHAKU),
            place: place(storey.span),
            fixed: self.told(storey_fixed(self.sheet, storey)),
            rings: storey.rings.iter().map(|r| self.ring(r)).collect(),
            rooms: self.rooms(storey, &rooms),
            fixtures: self.fixtures(storey, &built.fixtures),
            regions: plan.map_or(vec![], |p| p.regions.iter().map(region).collect()),
        }
    }

    fn ring(&mut self, ring: &building::Ring) -> Ring {
        let rows = self.sheet.rows(ring);
        let walls = 0..ring.walls.len();
        Ring {
            hole: ring.hole,
            inner: ring.inner,
            closed: ring.closed,
            walls: walls.map(|w| self.wall(ring, &rows, w)).collect(),
        }
    }

    fn wall(&mut self, ring: &building::Ring, rows: &[SheetRow], number: usize) -> Wall {
        let (wall, row) = (&ring.walls[number], &rows[number]);
        let reasons = row.units_fixed(wall.units.len());
        let mut at = wall.from;
        let mut unit = |(unit, reason): (&program::Unit, Option<Reason>)| {
            let from = at;
            at += wall.direction * unit.width;
            Unit {
                code: self.code(unit),
                part: self.part(unit),
                from: point(from),
                to: point(at),
                place: place(unit.span),
                fixed: self.told(reason),
            }
        };
        let units = wall.units.iter().zip(reasons).map(&mut unit).collect();
        let fixed = self.sheet.ring_fixed(ring, rows, number);
        Wall {
            facade: wall.facade,
            from: point(wall.from),
            to: point(wall.to),
            place: place(wall.span),
            reflection: wall.reflection,
            fixed: self.told(fixed),
            units,
        }
    }

    /// Returns the code or name of a unit.
    fn code(&self, unit: &program::Unit) -> String {
        let picture = |id: program::PictureId| self.pictures.get(id.0 as usize);
        match &unit.content {
            Content::Void | Content::Split(_) => String::new(),
            Content::Part(id) => self.catalog.part(*id).code().trim_end().to_owned(),
            Content::Picture(id) => picture(*id).map_or(String::new(), |p| p.name.clone()),
        }
    }

    /// Returns the kind of a unit as one word.
    fn part(&self, unit: &program::Unit) -> &'static str {
        match &unit.content {
            Content::Void => "void",
            Content::Picture(_) => "picture",
            Content::Split(_) => "split",
            Content::Part(id) => {
                let part = self.catalog.part(*id);
                match part.class() {
                    'T' => "door",
                    'M' => "window",
                    'G' => "lattice",
                    'H' => "post",
                    'A' if part.is_open() => "opening",
                    'N' => "modern",
                    _ => "wall",
                }
            }
        }
    }
}
