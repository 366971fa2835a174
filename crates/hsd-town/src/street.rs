//! Streets: lines with widths, or the sides of road and block polygons.

use super::shape::{Segment, angle, sides};
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, wider};
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// Streets farther away than this do not count, metres.
pub const FAR: f64 = 30.0;
/// The far sides of roads are looked for up to this distance, metres.
pub const WIDE: f64 = 60.0;
/// A ring turns by this at the end of a street, degrees.
const LEG: f64 = 30.0;
/// Distances below this count as touching, metres.
const TOUCH: f64 = 0.05;
/// Half the width of the widest street.
const WIDEST: f64 = 60.0;

/// A straight piece of a street.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// The line from which its side is measured.
    pub line: Segment,
    /// The distance of its side from that line, metres.
    pub half: f64,
    /// The number of the street.
    pub street: u32,
    /// The width of the street, metres; 0 if it is not known.
    pub width: f64,
}

/// All streets of a town.
#[derive(Debug, Default)]
pub struct Streets {
    pieces: Vec<Piece>,
    grid: Grid,
    reach: f64,
    /// The numbers of the pieces, in the order of their lines.
    by_line: Vec<u32>,
}

/// The pieces of streets that a feature looks at, at most. Of more the nearest count.
const MOST: usize = 1024;

/// The nearest point of a street.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The distance of its side, metres; 0 if the place lies in it.
    pub distance: f64,
    /// The same, below 0 if the place lies in it: of two places in a street the one nearer to its line is less.
    pub depth: f64,
    /// The point.
    pub point: DVec2,
    /// The direction of the street there.
    pub along: DVec2,
    /// The number of the street.
    pub street: u32,
    /// Its width; 0 if it is not known.
    pub width: f64,
}

/// Collects streets.
#[derive(Debug, Default)]
pub struct StreetsBuilder {
    pieces: Vec<Piece>,
    count: u32,
}

impl StreetsBuilder {
    /// Adds a line of this width, metres; `known` if that is its own, not that of its class.
    pub fn line(&mut self, points: &[DVec2], width: f64, known: bool) {
        let half = (width / 2.0).clamp(0.0, WIDEST);
        for ends in points.windows(2) {
            let own = if known { width } else { 0.0 };
            self.push(Segment::new(ends[0], ends[1]), half, own);
        }
        self.count += 1;
    }

    /// Adds the sides of a road or block polygon, a street for each of its legs.
    pub fn ring(&mut self, ring: &[DVec2]) {
        let all: Vec<Segment> = sides(ring).filter(|s| s.length() > 0.0).collect();
        let Some(last) = all.last() else {
            return;
        };
        let mut before = last.direction();
        for side in &all {
            if angle(before, side.direction()) > LEG {
                self.count += 1;
            }
            before = side.direction();
            self.push(*side, 0.0, 0.0);
        }
        self.count += 1;
    }

    fn push(&mut self, line: Segment, half: f64, width: f64) {
        self.pieces.push(Piece {
            line,
            half,
            street: self.count,
            width,
        });
    }

    /// Returns the streets.
    pub fn finish(self) -> Streets {
        let reach = self.pieces.iter().map(|p| p.half).fold(0.0, f64::max);
        Streets::of(self.pieces, reach)
    }
}

/// Returns what orders lines: the coordinates of their ends. Zero has one sign.
fn line_key(line: Segment) -> [u64; 4] {
    let ends = [line.from.x, line.from.y, line.to.x, line.to.y];
    ends.map(|x| (x + 0.0).to_bits())
}

impl Streets {
    /// Indexes pieces, of which the widest has a side this far from its line.
    fn of(pieces: Vec<Piece>, reach: f64) -> Streets {
        let boxes = pieces.iter().map(|p| p.line.bounds()).collect();
        let mut by_line: Vec<u32> = (0..pieces.len() as u32).collect();
        by_line.sort_by_key(|n| line_key(pieces[*n as usize].line));
        Streets {
            grid: Grid::new(boxes),
            pieces,
            reach,
            by_line,
        }
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Returns the first piece along a line.
    pub fn along(&self, line: Segment) -> Option<&Piece> {
        let key = |n: &u32| line_key(self.pieces[*n as usize].line);
        let wanted = line_key(line);
        let at = self.by_line.partition_point(|n| key(n) < wanted);
        let found = self.by_line.get(at).filter(|n| key(n) == wanted)?;
        Some(&self.pieces[*found as usize])
    }

    /// Returns the pieces whose sides may be within `far` of a box; of very many the nearest.
    pub fn near(&self, bounds: Bounds, far: f64) -> Vec<Piece> {
        let found = self.grid.nearest(bounds, far + self.reach, MOST);
        found.iter().map(|n| self.pieces[*n as usize]).collect()
    }
}

impl Streets {
    /// Appends the pieces whose sides may be within [`WIDE`] of something in a box to bytes.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        let pieces = self.grid.near(wider(bounds, WIDE + self.reach));
        // How far they reach is told by all streets, so that a part finds what the whole town does.
        out.float(self.reach);
        out.count(pieces.len());
        for piece in pieces.iter().map(|n| &self.pieces[*n as usize]) {
            out.point(piece.line.from);
            out.point(piece.line.to);
            out.float(piece.half);
            out.bytes(&piece.street.to_le_bytes());
            out.float(piece.width);
        }
    }

    /// Takes streets from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Streets> {
        let reach = from.float()?;
        let pieces = (0..from.count()?).map(|_| {
            Ok(Piece {
                line: Segment::new(from.point()?, from.point()?),
                half: from.float()?,
                street: u32::from_le_bytes(from.array()?),
                width: from.float()?,
            })
        });
        Ok(Streets::of(pieces.collect::<io::Result<_>>()?, reach))
    }
}

/// Returns the nearest point of some pieces to a place.
pub fn nearest<'p>(pieces: impl IntoIterator<Item = &'p Piece>, to: DVec2) -> Option<Nearest> {
    let found = pieces.into_iter().map(|piece| {
        let point = piece.line.nearest(to);
        let depth = point.distance(to) - piece.half;
        Nearest {
            distance: depth.max(0.0),
            depth,
            point,
            along: piece.line.direction(),
            street: piece.street,
            width: piece.width,
        }
    });
    found.reduce(|best, next| match next.depth < best.depth {
        true => next,
        false => best,
    })
}

impl Nearest {
    /// Returns the point of its side on the way from a place.
    pub fn side(&self, from: DVec2) -> DVec2 {
        from + (self.point - from).normalize_or_zero() * self.distance
    }

    /// Returns the angle between a normal at a place and the way from there to the street, degrees. Where the street
    /// touches or overlaps the place, its own normal takes the place of the way.
    pub fn faced(&self, normal: DVec2, from: DVec2) -> f64 {
        let way = self.point - from;
        if self.distance > TOUCH && way.length() > TOUCH {
            return angle(normal, way);
        }
        let off = angle(normal, self.along);
        (90.0 - off).abs()
    }
}

/// Returns the width of a street of a class of OpenStreetMap, metres; `None` for ways that are no streets.
pub fn class_width(class: &str) -> Option<f64> {
    Some(match class.strip_suffix("_link").unwrap_or(class) {
        "trunk" => 28.0,
        "primary" | "secondary" => 23.0,
        "tertiary" => 15.0,
        "unclassified" | "road" => 6.0,
        "residential" | "living_street" | "pedestrian" => 4.0,
        "service" => 2.5,
        _ => return None,
    })
}
