//! The poles of all networks of a town: each street knows those of the others before the first is made, so that a house is served
//! from its nearest pole and the wires of streets join.

use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, wider};
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// How far from the features of a part its poles are kept, metres: more than the longest span between streets.
const PACKED: f64 = 400.0;

/// The poles that are looked at round a place, at most. Of more the nearest count.
const MOST: usize = 512;

/// A pole of a network.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownPole {
    /// Its place.
    pub at: DVec2,
    /// The number of the line that it belongs to, in the town.
    pub line: u32,
    /// True for the first and the last pole of a line.
    pub is_end: bool,
}

/// All poles of networks.
#[derive(Debug, Default)]
pub struct KnownPoles {
    poles: Vec<KnownPole>,
    index: Grid,
}

impl KnownPoles {
    /// Collects the poles of lines.
    pub fn new(lines: Vec<Vec<DVec2>>) -> KnownPoles {
        let mut poles = vec![];
        for (line, places) in (0..).zip(lines) {
            let last = places.len().saturating_sub(1);
            let pole = |(n, at): (usize, DVec2)| KnownPole {
                at,
                line,
                is_end: n == 0 || n == last,
            };
            poles.extend(places.into_iter().enumerate().map(pole));
        }
        KnownPoles::of(poles)
    }

    fn of(poles: Vec<KnownPole>) -> KnownPoles {
        let boxes = poles.iter().map(|pole| [pole.at; 2]).collect();
        KnownPoles {
            index: Grid::new(boxes),
            poles,
        }
    }

    /// Returns the pole that stands at a place.
    pub fn at(&self, place: DVec2) -> Option<KnownPole> {
        self.near([place; 2], 0.0).next()
    }

    /// Returns the poles within `far` of a box; of very many the nearest.
    pub fn near(&self, bounds: Bounds, far: f64) -> impl Iterator<Item = KnownPole> + '_ {
        let found = self.index.nearest(bounds, far, MOST).into_iter();
        found.map(|n| self.poles[n as usize])
    }

    /// Returns the nearest pole to another, of another line, no farther than `far`.
    pub fn next_line(&self, from: KnownPole, far: f64) -> Option<KnownPole> {
        let others = self.near([from.at; 2], far);
        let others = others.filter(|pole| pole.line != from.line);
        let off = |pole: &KnownPole| pole.at.distance(from.at);
        let found = others.min_by(|p, q| off(p).total_cmp(&off(q)))?;
        (off(&found) <= far).then_some(found)
    }

    /// Adds the poles near a box.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        let poles = self.index.near(wider(bounds, PACKED));
        out.count(poles.len());
        for pole in poles.iter().map(|n| self.poles[*n as usize]) {
            out.point(pole.at);
            out.count(pole.line as usize);
            out.bytes(&[u8::from(pole.is_end)]);
        }
    }

    /// Takes poles from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<KnownPoles> {
        let poles = (0..from.count()?).map(|_| {
            Ok(KnownPole {
                at: from.point()?,
                line: from.count()? as u32,
                is_end: from.array::<1>()? != [0],
            })
        });
        Ok(KnownPoles::of(poles.collect::<io::Result<_>>()?))
    }
}
