//! Well-known binary: geometries as GeoPackage and GeoParquet hold them. Points with heights and measures are read in the
//! numbering of ISO (1001 = point with a height) and in that of PostGIS (bits of the type).

#[cfg(feature = "geopackage")]
pub(super) mod geopackage;
#[cfg(feature = "geoparquet")]
pub(super) mod geoparquet;

use super::fault::{Fault, Kind};
use super::feature::{Area, Chain, Geometry};
use super::input::unreadable;
use glam::{DVec2, dvec2};
use hsd_base::source::World;
use std::io::Read;
use std::sync::Arc;

/// The nesting of geometries that is read; collections of collections are one deeper than any program writes.
const DEEPEST: usize = 4;

/// The bits of a type in the numbering of PostGIS: with a height, with a measure, with a reference system.
const HEIGHT: u32 = 0x8000_0000;
const MEASURE: u32 = 0x4000_0000;
const SYSTEM: u32 = 0x2000_0000;

/// The most bytes of a file that is not on the disk.
const IN_MEMORY: u64 = 1 << 30;

/// Reads a file that is not on the disk, for libraries that need the whole of it.
fn in_memory(world: &dyn World, file: &Arc<str>) -> Result<Vec<u8>, Fault> {
    let stream = world.open(file).map_err(|e| unreadable(file, &e))?;
    let mut bytes = vec![];
    let read = stream.take(IN_MEMORY + 1).read_to_end(&mut bytes);
    let length = read.map_err(|e| unreadable(file, &e))?;
    if length as u64 > IN_MEMORY {
        let (what, limit) = ("bytes of the file", IN_MEMORY);
        return Err(Fault::of_file(file, Kind::TooLarge { what, limit }));
    }
    Ok(bytes)
}

/// Decodes a geometry; one of more than `most` points is refused.
pub(super) fn geometry(bytes: &[u8], most: usize) -> Result<Geometry, Kind> {
    let mut reader = Bytes {
        rest: bytes,
        left: most,
        most,
    };
    reader.geometry(0)
}

/// Bytes that are still to be read.
struct Bytes<'b> {
    rest: &'b [u8],
    /// The number of points that may still come.
    left: usize,
    most: usize,
}

/// How the numbers of a geometry are written.
#[derive(Clone, Copy)]
struct Layout {
    is_little: bool,
    has_height: bool,
    has_measure: bool,
}

impl Layout {
    /// Bytes of a point.
    fn point(self) -> usize {
        8 * (2 + usize::from(self.has_height) + usize::from(self.has_measure))
    }
}

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Kind> {
        let (taken, rest) = self.rest.split_first_chunk().ok_or_else(cut_off)?;
        self.rest = rest;
        Ok(*taken)
    }

    fn number(&mut self, layout: Layout) -> Result<u32, Kind> {
        let bytes = self.take()?;
        Ok(match layout.is_little {
            true => u32::from_le_bytes(bytes),
            false => u32::from_be_bytes(bytes),
        })
    }

    fn coordinate(&mut self, layout: Layout) -> Result<f64, Kind> {
        let bytes = self.take()?;
        Ok(match layout.is_little {
            true => f64::from_le_bytes(bytes),
            false => f64::from_be_bytes(bytes),
        })
    }

    /// Reads a count of items that take at least `bytes` each; fails if fewer bytes are left.
    fn count(&mut self, layout: Layout, bytes: usize) -> Result<usize, Kind> {
        let count = self.number(layout)? as usize;
        let fits = count
            .checked_mul(bytes)
            .is_some_and(|n| n <= self.rest.len());
        fits.then_some(count).ok_or_else(cut_off)
    }

    fn geometry(&mut self, depth: usize) -> Result<Geometry, Kind> {
        let [order] = self.take()?;
        let mut layout = Layout {
            is_little: order == 1,
            has_height: false,
            has_measure: false,
        };
        let of = self.number(layout)?;
        let plain = of & !(HEIGHT | MEASURE | SYSTEM);
        let dimensions = plain / 1000;
        layout.has_height = of & HEIGHT != 0 || matches!(dimensions, 1 | 3);
        layout.has_measure = of & MEASURE != 0 || matches!(dimensions, 2 | 3);
        if order > 1 || dimensions > 3 {
            return Err(malformed("the geometry begins with no byte order"));
        }
        if of & SYSTEM != 0 {
            self.number(layout)?;
        }
        match plain % 1000 {
            1 => {
                let mut point = Chain::default();
                self.point(layout, &mut point)?;
                // The way to write a point that is nowhere.
                match point.points[0].is_nan() {
                    true => Err(Kind::NoGeometry),
                    false => Ok(Geometry::Points(point)),
                }
            }
            2 => Ok(Geometry::Lines(vec![self.chain(layout)?])),
            3 => Ok(Geometry::Areas(vec![self.area(layout)?])),
            4..=7 if depth < DEEPEST => {
                // Byte order, type, and a count or a coordinate.
                let count = self.count(layout, 9)?;
                let parts: Result<_, _> = (0..count).map(|_| self.geometry(depth + 1)).collect();
                Geometry::joined(parts?)
            }
            other => Err(Kind::OtherGeometry {
                name: format!("curve or surface (type {other})").into(),
            }),
        }
    }

    fn area(&mut self, layout: Layout) -> Result<Area, Kind> {
        let count = self.count(layout, 4)?;
        let mut rings = vec![];
        for _ in 0..count {
            rings.push(self.chain(layout)?);
        }
        let mut rings = rings.into_iter();
        let outline = rings.next().ok_or(Kind::NoGeometry)?;
        let holes = rings.collect();
        Ok(Area { outline, holes })
    }

    fn chain(&mut self, layout: Layout) -> Result<Chain, Kind> {
        let count = self.count(layout, layout.point())?;
        let mut chain = Chain::flat(Vec::with_capacity(count.min(self.left)));
        for _ in 0..count {
            self.point(layout, &mut chain)?;
        }
        Ok(chain)
    }

    fn point(&mut self, layout: Layout, chain: &mut Chain) -> Result<(), Kind> {
        self.left = self.left.checked_sub(1).ok_or(Kind::TooLarge {
            what: "points of a feature",
            limit: self.most as u64,
        })?;
        let at: DVec2 = dvec2(self.coordinate(layout)?, self.coordinate(layout)?);
        chain.points.push(at);
        if layout.has_height {
            let height = self.coordinate(layout)?;
            chain.heights.push(height);
        }
        if layout.has_measure {
            self.coordinate(layout)?;
        }
        Ok(())
    }
}

fn cut_off() -> Kind {
    malformed("the geometry is cut off")
}

fn malformed(what: &str) -> Kind {
    Kind::Malformed { what: what.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(parts: &[&[u8]]) -> Vec<u8> {
        parts.concat()
    }

    fn doubles(of: &[f64], is_little: bool) -> Vec<u8> {
        let one = |x: &f64| match is_little {
            true => x.to_le_bytes(),
            false => x.to_be_bytes(),
        };
        of.iter().flat_map(one).collect()
    }

    #[test]
    fn points_have_heights_in_both_numberings_and_byte_orders() {
        let expected = |g: Geometry| match g {
            Geometry::Points(chain) => (chain.points[0], chain.heights),
            other => panic!("{other:?}"),
        };
        let iso = bytes(&[
            &[1],
            &1001_u32.to_le_bytes(),
            &doubles(&[1.0, 2.0, 3.0], true),
        ]);
        let postgis = 0xa000_0001_u32.to_be_bytes();
        let system = 6674_u32.to_be_bytes();
        let postgis = bytes(&[&[0], &postgis, &system, &doubles(&[1.0, 2.0, 3.0], false)]);
        for wkb in [iso, postgis] {
            let read = expected(geometry(&wkb, 10).expect("is a point"));
            assert_eq!(read, (dvec2(1.0, 2.0), vec![3.0]));
            for cut in 0..wkb.len() {
                assert!(geometry(&wkb[..cut], 10).is_err(), "{cut}");
            }
        }
    }

    #[test]
    fn more_points_than_bytes_are_refused_at_once() {
        let line = bytes(&[&[1], &2_u32.to_le_bytes(), &u32::MAX.to_le_bytes()]);
        assert!(matches!(geometry(&line, 10), Err(Kind::Malformed { .. })));
        let three = doubles(&[0.0; 6], true);
        let line = bytes(&[&[1], &2_u32.to_le_bytes(), &3_u32.to_le_bytes(), &three]);
        assert!(matches!(geometry(&line, 2), Err(Kind::TooLarge { .. })));
    }
}
