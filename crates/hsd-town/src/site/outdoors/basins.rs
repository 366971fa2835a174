//! Water and farmland (000-83): what lies level between banks. Both are convex pieces of the feature, of which what lies near a
//! border is bank and the rest is filled; the sides of banks go down to what they hold.

use super::bands::{Way, Ways};
use super::cutters::{Cutters, Meetings};
use super::lines::Segments;
use super::{Laid, LotSite, edges, segments, told};
use crate::layer::Shape;
use crate::plan::{BORDERS, RoadPiece};
use crate::shape::{Segment, area, sides};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::area2;
use hsd_base::geometry::clip::{inside, without};
use hsd_base::geometry::grid::{bounds, wider};
use hsd_base::geometry::triangulate::triangles;
use hsd_base::source::{Span, Spanned};
use hsd_base::text;
use hsd_ir::ast::land::{Bank, Crop, Farmland, Water};
use hsd_ir::ast::{Sheet, Value};

/// Heights over the ground: of water, of the top of its banks, metres.
const WATER: [f64; 2] = [0.02, 0.32];
/// The same of a field and its ridges.
const FIELD: [f64; 2] = [0.05, 0.25];
/// How deep the outer sides of banks go into uneven ground, metres.
const DEEP: f64 = 0.6;
/// One cho, the side of a square of the grid, metres: 360 shaku.
const CHO: f64 = 360.0 * hsd_base::geometry::SHAKU;
/// How far beyond a side one looks whether the water goes on, metres.
const BEYOND: f64 = 0.02;
/// The most fields of a feature.
const MOST: f64 = 20_000.0;

/// The border of a stream inside which there is water.
const WET: usize = 1;

/// Convex rings.
type Rings = Vec<Vec<DVec2>>;

/// What lies between banks, and the banks.
struct Basin {
    filled: Rings,
    banks: Rings,
    /// Water of others, into which it opens.
    beyond: Rings,
}

impl Basin {
    /// Divides convex pieces into what rings of banks cover and the rest.
    ///
    /// # Errors
    /// If they meet each other too often.
    fn new(pieces: Rings, banks: &[Vec<DVec2>], left: &mut Meetings) -> Result<Basin, Text> {
        let banks = Cutters::new(banks);
        left.take(&banks, &pieces)?;
        let filled: Vec<Rings> = pieces.iter().map(|piece| banks.cut(piece)).collect();
        // Pieces do not overlap, so what is filled of one takes nothing from another.
        let rest = pieces
            .into_iter()
            .zip(&filled)
            .flat_map(|(piece, filled)| without(vec![piece], filled));
        Ok(Basin {
            banks: rest.collect(),
            filled: filled.into_iter().flatten().collect(),
            beyond: vec![],
        })
    }

    /// Returns the sides of what is filled beyond which there is bank.
    fn shores(&self) -> Vec<[DVec2; 2]> {
        let (filled, beyond) = (Cutters::new(&self.filled), Cutters::new(&self.beyond));
        let is_filled = |at: DVec2| filled.cover(at) || beyond.cover(at);
        let all = self.filled.iter().flat_map(|ring| sides(ring));
        let beyond = all.filter(|side| {
            side.length() > 0.01 && !is_filled(side.middle() + side.normal() * BEYOND)
        });
        beyond.map(|side| [side.from, side.to]).collect()
    }
}

impl LotSite<'_> {
    /// Fills an area, or a strip along lines, with water.
    pub(super) fn water(&self, wish: &Water, span: Span) -> Result<Laid, Text> {
        let bank = bank_width(wish);
        let bounds = wider(self.lot().shape.bounds(), wish.width);
        let others = self.others_water(wish);
        let (basin, square) = match &self.lot().shape {
            Shape::Area(ring, holes) => {
                let around = std::iter::once(ring).chain(holes);
                let around = around.flat_map(|ring| sides(ring));
                let strips: Rings = match bank > 0.0 {
                    true => around.map(|side| strip(side.from, side.to, bank)).collect(),
                    false => vec![],
                };
                // A bank is open where a stream flows in.
                let mouths: Rings = others.others(WET).cloned().collect();
                let pieces = pieces(ring, holes);
                let mut left = Meetings::among(pieces.len());
                let strips = Cutters::new(&mouths).cut_all(&strips);
                let mut basin = Basin::new(pieces, &strips, &mut left)?;
                basin.beyond = mouths;
                (basin, area(ring, holes))
            }
            _ => {
                let ponds = self.plan.laid.waters.ponds_near(bounds, 0.0);
                let ponds: Rings = ponds.into_iter().cloned().collect();
                let cutters = Cutters::new(&ponds);
                let band = |border| cutters.cut_all(&others.band(border));
                let mut basin = Basin {
                    filled: band(WET),
                    banks: if bank > 0.0 { band(0) } else { vec![] },
                    beyond: ponds.clone(),
                };
                basin.beyond.extend(others.others(WET).cloned());
                (basin, 0.0)
            }
        };
        if basin.filled.is_empty() {
            return Err(text!(
                "water needs an area or a line that is wider than its banks",
                "水面には、岸より広い面か線が要ります"
            ));
        }
        let sheets = self.between_banks(wish, &basin);
        let mut parameters = vec![];
        if square > 0.0 {
            parameters.push(told("area", square));
        } else {
            parameters.push(told("width", wish.width));
        }
        Ok(Laid::new(
            vec![self.open(span, "water", sheets, vec![])],
            parameters,
        ))
    }

    /// Returns the pieces of the stream along the lines of the feature.
    pub fn stream(&self, wish: &Water) -> Vec<RoadPiece> {
        let half = wish.width / 2.0;
        let inner = (half - bank_width(wish)).max(half / 2.0);
        let ways = self.ways();
        let lines = ways.iter().flat_map(|way| segments(way));
        let half = [half, inner, 0.0];
        lines.map(|line| RoadPiece { line, half }).collect()
    }

    /// Returns the convex pieces of the pond that the feature is; none if it is no area.
    pub fn pond(&self) -> Option<Vec<Vec<DVec2>>> {
        match &self.lot().shape {
            Shape::Area(ring, holes) => Some(pieces(ring, holes)),
            Shape::Lines(_) | Shape::Point(_) => None,
        }
    }

    /// Returns the stream of the feature, if it is one, with the streams round it.
    fn others_water(&self, wish: &Water) -> Ways {
        let way = |piece: RoadPiece, own: bool| Way {
            line: piece.line,
            half: piece.half,
            own,
        };
        let own: Vec<Way> = match self.pond() {
            Some(_) => vec![],
            None => self
                .stream(wish)
                .into_iter()
                .map(|p| way(p, true))
                .collect(),
        };
        let lines: Vec<Segment> = own.iter().map(|way| way.line).collect();
        let streams = &self.plan.laid.waters.streams;
        let near = match lines.is_empty() {
            true => streams.near(self.lot().shape.bounds(), wish.width),
            false => streams.beside(&lines, wish.width),
        };
        let own_lines = Segments::new(lines);
        let others = near
            .into_iter()
            .filter(|piece| !own_lines.contain(&piece.line));
        let others: Vec<Way> = others.map(|piece| way(piece, false)).collect();
        Ways::new(own.into_iter().chain(others).collect())
    }

    /// Lays water and its banks on the ground.
    fn between_banks(&self, wish: &Water, basin: &Basin) -> Vec<Sheet> {
        let finish = match wish.bank {
            Bank::Earth => "grass",
            Bank::Stone | Bank::None => "stone",
        };
        // Roads cross over banks.
        let laid = &self.plan.laid.roads;
        let roads = match &self.lot().shape {
            Shape::Lines(_) => laid.beside(&self.lines().collect::<Vec<_>>(), wish.width),
            _ => laid.near(self.lot().shape.bounds(), 1.0),
        };
        let roads: Rings = roads
            .into_iter()
            .map(|road| road_ring(road.line.from, road.line.to, road.half[BORDERS - 1]))
            .collect();
        self.basin(basin, &roads, (["water", finish], WATER))
    }

    /// Returns how deep the outer sides of banks go into the ground, metres: on a plane one sees where they end.
    fn deep(&self) -> f64 {
        if self.has_ground() { DEEP } else { 0.0 }
    }

    /// Lays a basin on the ground.
    fn basin(
        &self,
        basin: &Basin,
        roads: &Rings,
        (finish, heights): ([&'static str; 2], [f64; 2]),
    ) -> Vec<Sheet> {
        let roads = Cutters::new(roads);
        let banks = roads.cut_all(&basin.banks);
        let tops = self.lie(&banks, heights[1]);
        let shores = basin.shores();
        let free = shores
            .iter()
            .filter(|[p, q]| !basin.banks.is_empty() && !roads.cover(p.midpoint(*q)));
        let base = self.base();
        let place = |p: DVec2, raised: f64| (p - base).extend(self.height(p) + raised);
        let inner: Vec<Vec<DVec3>> = free
            .map(|[p, q]| {
                vec![
                    place(*q, heights[0] - 0.05),
                    place(*p, heights[0] - 0.05),
                    place(*p, heights[1]),
                    place(*q, heights[1]),
                ]
            })
            .collect();
        let mut sheets = vec![self.sheet(finish[0], 0, self.lie(&basin.filled, heights[0]))];
        if !tops.is_empty() {
            sheets.push(self.sheet(finish[1], 1, edges(&tops, heights[1] + self.deep())));
            sheets.push(self.sheet(finish[1], 1, inner));
            sheets.push(self.sheet(finish[1], 0, tops));
        }
        sheets
    }

    /// Lays fields over an area: squares of one cho in a grid that is one for the whole town, each divided into a whole number of
    /// fields. On a slope each field is level, at the highest ground in it, and its ridge holds it.
    pub(super) fn farmland(&self, wish: &Farmland, span: Span) -> Result<Laid, Text> {
        let Shape::Area(ring, holes) = &self.lot().shape else {
            return Err(text!("fields need an area", "田畑には面が要ります"));
        };
        let turn = -wish.azimuth.to_radians();
        let east = dvec2(libm::cos(turn), libm::sin(turn));
        // In the frame of the grid: across it and along it.
        let flat = |p: DVec2| dvec2(p.dot(east), p.dot(east.perp()));
        let flatten = |ring: &Vec<DVec2>| ring.iter().map(|p| flat(*p)).collect::<Vec<DVec2>>();
        let (outline, holes): (Vec<DVec2>, Rings) =
            (flatten(ring), holes.iter().map(flatten).collect());
        let whole = |size: f64| (CHO / size).round().max(1.0);
        let counts = dvec2(whole(wish.width), whole(wish.depth));
        let size = DVec2::splat(CHO) / counts;
        let [low, high] = bounds(outline.iter().copied()).unwrap_or_default();
        let [from, to] = [(low / size).floor(), (high / size).floor()];
        let count = (to - from + 1.0).element_product();
        if count > MOST {
            let most = MOST;
            return Err(text!([count, most]
                "{count} fields would lie here, of which there may be {most}: make them larger",
                "{count} 枚の田畑になります。上限は {most} 枚です。広くしてください"
            ));
        }
        let all = pieces(&outline, &holes);
        let around: Rings = std::iter::once(&outline)
            .chain(&holes)
            .flat_map(|ring| sides(ring))
            .map(|side| strip(side.from, side.to, wish.ridge))
            .collect();
        let mut left = Meetings::among(all.len() + count as usize);
        let (all, around) = (Cutters::new(&all), Cutters::new(&around));
        let mut fields = Fields::new(wish, size, counts);
        for y in from.y as i64..=to.y as i64 {
            for x in from.x as i64..=to.x as i64 {
                fields.add(dvec2(x as f64, y as f64), [&all, &around], &mut left)?;
            }
        }
        if fields.found.is_empty() {
            return Err(text!(
                "its outline has no room for a field",
                "輪郭に田畑が収まりません"
            ));
        }
        let number = fields.found.len();
        let sheets = self.fields(wish, fields, east);
        let mut house = self.open(span, "farmland", sheets, vec![]);
        // The grid is that of the textures too.
        house.settings.azimuth = Some(Spanned::new(180.0 - turn.to_degrees(), span));
        Ok(Laid::new(
            vec![house],
            vec![
                ("crop".to_owned(), Value::Text(wish.crop.word().to_owned())),
                told("fields", number as f64),
                told("area", area(ring, &holes)),
            ],
        ))
    }

    /// Returns the surfaces of fields; places are turned into the frame of the grid.
    fn fields(&self, wish: &Farmland, fields: Fields, east: DVec2) -> Vec<Sheet> {
        let base = self.base();
        let world = |p: DVec2| east * p.x + east.perp() * p.y;
        // In the frame of the house, which is turned about its place.
        let local = |p: DVec2| p - dvec2(base.dot(east), base.dot(east.perp()));
        let [mut wet, mut grown, mut ridges, mut walls]: [Vec<Vec<DVec3>>; 4] = Default::default();
        for basin in &fields.found {
            let corners = basin.filled.iter().chain(&basin.banks).flatten();
            let heights: Vec<f64> = corners.map(|p| self.height(world(*p))).collect();
            let (low, high) = heights
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
                    (low.min(*z), high.max(*z))
                });
            let lay = |rings: &Rings, z: f64| -> Vec<Vec<DVec3>> {
                let face = |ring: &Vec<DVec2>| ring.iter().map(|p| local(*p).extend(z)).collect();
                rings.iter().map(face).collect()
            };
            let (floor, crest) = (high + FIELD[0], high + FIELD[1]);
            match wish.crop {
                Crop::Water => wet.extend(lay(&basin.filled, floor)),
                _ => grown.extend(lay(&basin.filled, floor)),
            }
            let tops = lay(&basin.banks, crest);
            walls.extend(edges(&tops, crest - low + self.deep()));
            ridges.extend(tops);
            for [p, q] in basin.shores() {
                let side = |p: DVec2, z: f64| local(p).extend(z);
                walls.push(vec![
                    side(q, floor - 0.05),
                    side(p, floor - 0.05),
                    side(p, crest),
                    side(q, crest),
                ]);
            }
        }
        let soil = if wish.crop.is_wet() { "grass" } else { "earth" };
        let mut sheets = vec![
            self.sheet("paddy", 0, wet),
            self.sheet(surface(wish.crop), 0, grown),
            self.sheet(soil, 1, walls),
            self.sheet(soil, 0, ridges),
        ];
        sheets.retain(|sheet| !sheet.faces.is_empty());
        sheets
    }
}

/// Fields in the frame of the grid.
struct Fields {
    found: Vec<Basin>,
    size: DVec2,
    counts: DVec2,
    ridge: f64,
    way: f64,
}

impl Fields {
    fn new(wish: &Farmland, size: DVec2, counts: DVec2) -> Fields {
        Fields {
            found: vec![],
            size,
            counts,
            ridge: wish.ridge,
            way: wish.way,
        }
    }

    /// Adds the field of a cell as far as it lies in the pieces of the feature, along whose sides the rings `around` lie.
    ///
    /// # Errors
    /// If both meet each other too often.
    fn add(
        &mut self,
        cell: DVec2,
        [pieces, around]: [&Cutters<'_>; 2],
        left: &mut Meetings,
    ) -> Result<(), Text> {
        let low = cell * self.size;
        let [from, to] = [low, low + self.size];
        let outer = rectangle(from, to);
        let near = pieces.near(&outer);
        let own: Rings = near.filter_map(|piece| inside(piece, &outer)).collect();
        if own.is_empty() {
            return Ok(());
        }
        // At the borders of its square a field has half a way, elsewhere half a ridge.
        let half = |place: f64, count: f64| match (place.rem_euclid(count))
            .min(count - place.rem_euclid(count))
            < 0.5
        {
            true => self.way.max(self.ridge) / 2.0,
            false => self.ridge / 2.0,
        };
        let before = dvec2(half(cell.x, self.counts.x), half(cell.y, self.counts.y));
        let after = dvec2(
            half(cell.x + 1.0, self.counts.x),
            half(cell.y + 1.0, self.counts.y),
        );
        let mut banks = vec![
            rectangle(from, dvec2(from.x + before.x, to.y)),
            rectangle(dvec2(to.x - after.x, from.y), to),
            rectangle(from, dvec2(to.x, from.y + before.y)),
            rectangle(dvec2(from.x, to.y - after.y), to),
        ];
        banks.extend(around.near(&outer).cloned());
        // Of a field that no border cuts, one piece is enough.
        let whole = own.iter().map(|ring| area2(ring) / 2.0).sum::<f64>();
        let own = match whole > self.size.element_product() - 1e-3 {
            true => vec![outer],
            false => own,
        };
        let basin = Basin::new(own, &banks, left)?;
        if !basin.filled.is_empty() {
            self.found.push(basin);
        }
        Ok(())
    }
}

/// Returns the width of its banks, metres.
fn bank_width(wish: &Water) -> f64 {
    match wish.bank {
        Bank::None => 0.0,
        Bank::Stone | Bank::Earth => wish.bank_width,
    }
}

/// Returns the surface that bears a crop.
fn surface(crop: Crop) -> &'static str {
    match crop {
        Crop::Rice => "crop_rice",
        Crop::Ripe => "crop_ripe",
        Crop::Vegetables => "crop_vegetables",
        Crop::Bare => "earth",
        Crop::Water => "paddy",
    }
}

/// Returns the triangles of an area.
fn pieces(ring: &[DVec2], holes: &[Vec<DVec2>]) -> Rings {
    let holes: Rings = holes
        .iter()
        .map(|hole| hole.iter().rev().copied().collect())
        .collect();
    triangles(ring, &holes).into_iter().map(Vec::from).collect()
}

/// Returns the ring that reaches this far to both sides of a line, and beyond its ends.
fn strip(from: DVec2, to: DVec2, reach: f64) -> Vec<DVec2> {
    let along = (to - from).normalize_or_zero() * reach;
    let (from, to) = (from - along, to + along);
    let left = along.perp();
    vec![from - left, to - left, to + left, from + left]
}

/// Returns the ring of a road of this half width.
fn road_ring(from: DVec2, to: DVec2, half: f64) -> Vec<DVec2> {
    let left = (to - from).normalize_or_zero().perp() * half;
    vec![from - left, to - left, to + left, from + left]
}

fn rectangle(from: DVec2, to: DVec2) -> Vec<DVec2> {
    vec![from, dvec2(to.x, from.y), to, dvec2(from.x, to.y)]
}
