//! Roads: a carriageway with pavements or drains along lines, or the surface of an area.

use super::bands::{Way, Ways};
use super::lines::Segments;
use super::{Laid, LotSite, STEP, edges, lines, segments, told};
use crate::layer::Shape;
use crate::plan::{BORDERS, RoadPiece};
use crate::shape::{Segment, area};
use crate::street::class_width;
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::grid::{Grid, wider};
use hsd_base::geometry::triangulate::triangles;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::{Road, Sheet, Surface, Value};

/// Heights over the ground: of a carriageway, of a drain under its slabs, of a pavement, metres.
const HEIGHTS: [f64; BORDERS] = [0.15, 0.06, 0.03];
/// The least carriageway beside pavements and drains, metres.
const LEAST: [f64; 2] = [3.0, 2.0];
/// The least carriageway with lines on it, and the least of four lanes, metres.
const MARKED: [f64; 2] = [5.5, 11.0];
/// A dash of the middle line and the gap after it, metres.
const DASH: [f64; 2] = [5.0, 5.0];
/// The width of lines, metres.
const LINE: f64 = 0.15;
/// How far from a road others are looked at that go on from those that meet it, metres.
const BESIDE: f64 = 5.0;
/// How far lines end before a crossing, metres.
const BEFORE: f64 = 1.0;

impl LotSite<'_> {
    /// Makes a piece of road.
    pub(super) fn road(&self, wish: &Road, span: Span) -> Result<Laid, Text> {
        if let Shape::Area(ring, holes) = &self.lot().shape {
            return self.square(wish, (ring, holes), span);
        }
        let ways = self.ways();
        if ways.is_empty() {
            return Err(text!(
                "a road needs a line or an area",
                "道には線か面が要ります"
            ));
        }
        let width = self.width(wish, &ways);
        let all = Ways::new(self.around_road(wish, width, &ways));
        let rings: Vec<Vec<Vec<DVec2>>> = (0..BORDERS).map(|border| all.band(border)).collect();
        let mut sheets = vec![];
        for (border, rings) in rings
            .iter()
            .enumerate()
            .filter(|(_, rings)| !rings.is_empty())
        {
            let faces = self.lie(rings, HEIGHTS[border]);
            let (top, side) = match border {
                0 => ("concrete", "stone"),
                1 => ("stone", "stone"),
                _ => (finish(wish.surface), finish(wish.surface)),
            };
            // On a plane a carriageway has no sides to see.
            let depth = match (self.has_ground(), border) {
                (true, _) => 1.0,
                (false, BORDERS_LAST) => 0.0,
                (false, _) => HEIGHTS[border],
            };
            if depth > 0.0 {
                sheets.push(self.sheet(side, u8::from(!self.has_ground()), edges(&faces, depth)));
            }
            sheets.push(self.sheet(top, 0, faces));
        }
        let half = borders(wish, width / 2.0)[BORDERS - 1];
        if wish.marks && 2.0 * half >= MARKED[0] {
            sheets.extend(self.marks(&ways, &all, half));
        }
        Ok(self.laid(wish, (width, span), sheets))
    }

    /// Returns the pieces of a road that is made of the lines of the feature.
    pub fn road_pieces(&self, wish: &Road) -> Vec<RoadPiece> {
        let ways = self.ways();
        if ways.is_empty() {
            return vec![];
        }
        let half = borders(wish, self.width(wish, &ways) / 2.0);
        let lines = ways.iter().flat_map(|way| segments(way));
        lines.map(|line| RoadPiece { line, half }).collect()
    }

    /// Returns the width of the road, metres.
    pub(super) fn width(&self, wish: &Road, ways: &[Vec<DVec2>]) -> f64 {
        wish.width.unwrap_or_else(|| self.usual_width(ways))
    }

    /// Returns the width of the road as the map has it, or that of its class, metres.
    pub(super) fn usual_width(&self, ways: &[Vec<DVec2>]) -> f64 {
        let mut own = ways.iter().flat_map(|way| segments(way));
        if let Some(piece) = own.find_map(|line| self.plan.street_along(line)) {
            return 2.0 * piece.half;
        }
        let layer = &self.plan.layers[self.id.0];
        let number = layer.number(self.lot(), "width").filter(|w| *w > 0.0);
        let class = layer
            .word(self.lot(), "highway")
            .or_else(|| layer.word(self.lot(), "class"));
        let class = class.unwrap_or_default();
        number
            .or_else(|| class_width(&class))
            .unwrap_or(match &*class {
                "motorway" | "motorway_link" => 20.0,
                "track" => 3.0,
                "footway" | "path" | "steps" | "cycleway" => 1.8,
                _ => 4.0,
            })
    }

    /// Returns the ways of the feature and the roads round them. Those that no rule makes visibly are like this one.
    fn around_road(&self, wish: &Road, width: f64, ways: &[Vec<DVec2>]) -> Vec<Way> {
        let half = borders(wish, width / 2.0);
        let own = ways.iter().flat_map(|way| segments(way));
        let mut all: Vec<Way> = own
            .map(|line| Way {
                line,
                half,
                own: true,
            })
            .collect();
        let mine: Vec<Segment> = all.iter().map(|way| way.line).collect();
        let others: Vec<RoadPiece> = match self.plan.laid.roads.is_empty() {
            false => self.plan.laid.roads.beside(&mine, width / 2.0 + BESIDE),
            true => {
                let streets = self
                    .street_pieces()
                    .into_iter()
                    .filter(|piece| piece.half > 0.0);
                let like = streets.map(|piece| RoadPiece {
                    line: piece.line,
                    half: borders(wish, piece.half),
                });
                like.collect()
            }
        };
        // A long road has a wide box, and few of the pieces in it beside itself.
        let own_boxes = Grid::new(mine.iter().map(|own| own.bounds()).collect());
        let own_lines = Segments::new(mine);
        let beside = others.into_iter().filter(|piece| {
            let far = piece.half[0] + width / 2.0 + BESIDE;
            let within = wider(piece.line.bounds(), far);
            let is_near = !own_boxes.nearest(within, 0.0, 1).is_empty();
            piece.line.length() > 0.01 && is_near && !own_lines.contain(&piece.line)
        });
        all.extend(beside.map(|RoadPiece { line, half }| Way {
            line,
            half,
            own: false,
        }));
        all
    }

    /// Paints lines on a carriageway of this half width.
    fn marks(&self, ways: &[Vec<DVec2>], all: &Ways, half: f64) -> Option<Sheet> {
        let mut rings = vec![];
        for way in ways {
            let course = lines::Course::new(way);
            let crossings: Vec<&Vec<DVec2>> = all.others(BORDERS - 1).collect();
            for stretch in lines::free(way, crossings.into_iter(), BEFORE) {
                let mut line = |stretch, off| {
                    rings.extend(course.strip(stretch, (off, LINE), STEP));
                };
                let edge = half - 0.4;
                line(stretch, edge);
                line(stretch, -edge);
                let dashes = lines::dashes(stretch, DASH[0], DASH[1]);
                match 2.0 * half >= MARKED[1] {
                    true => {
                        line(stretch, LINE);
                        line(stretch, -LINE);
                        for dash in dashes {
                            line(dash, half / 2.0);
                            line(dash, -half / 2.0);
                        }
                    }
                    false => dashes.into_iter().for_each(|dash| line(dash, 0.0)),
                }
            }
        }
        let over = if self.has_ground() { 0.05 } else { 0.015 };
        let faces = self.lie(&rings, HEIGHTS[BORDERS - 1] + over);
        (!faces.is_empty()).then(|| self.sheet("road_paint", 1, faces))
    }

    /// Makes the surface of an area.
    fn square(
        &self,
        wish: &Road,
        (ring, holes): (&[DVec2], &[Vec<DVec2>]),
        span: Span,
    ) -> Result<Laid, Text> {
        if ring.len() < 3 || area(ring, holes) < 0.5 {
            return Err(text!("its outline has no area", "輪郭に面積がありません"));
        }
        let holes: Vec<Vec<DVec2>> = holes
            .iter()
            .map(|hole| hole.iter().rev().copied().collect())
            .collect();
        let rings: Vec<Vec<DVec2>> = triangles(ring, &holes).into_iter().map(Vec::from).collect();
        let faces = self.lie(&rings, HEIGHTS[BORDERS - 1]);
        let top = finish(wish.surface);
        let mut sheets = vec![];
        if self.has_ground() {
            sheets.push(self.sheet(top, 0, edges(&faces, 1.0)));
        }
        sheets.push(self.sheet(top, 0, faces));
        Ok(self.laid(wish, (0.0, span), sheets))
    }

    fn laid(&self, wish: &Road, (width, span): (f64, Span), sheets: Vec<Sheet>) -> Laid {
        let mut parameters = vec![];
        if width > 0.0 {
            parameters.push(told("width", width));
        }
        parameters.push((
            "surface".to_owned(),
            Value::Text(wish.surface.word().to_owned()),
        ));
        // A road that others cover wholly is there all the same.
        Laid::new(vec![self.open(span, "road", sheets, vec![])], parameters)
    }
}

/// The innermost border.
const BORDERS_LAST: usize = BORDERS - 1;

/// Returns the borders of a street of this half width: its side, the inside of its pavement, that of its drain.
fn borders(wish: &Road, half: f64) -> [f64; BORDERS] {
    let inside = |half: f64, band: f64, least: f64| match 2.0 * (half - band) >= least {
        true => half - band,
        false => half,
    };
    let pavement = inside(half, wish.pavement, LEAST[0]);
    [half, pavement, inside(pavement, wish.drain, LEAST[1])]
}

/// Returns the surface of a carriageway.
fn finish(surface: Surface) -> &'static str {
    match surface {
        Surface::Earth => "doma",
        Surface::Gravel => "gravel",
        Surface::Asphalt => "asphalt",
        Surface::Stone => "stone",
        Surface::Concrete => "concrete",
    }
}
