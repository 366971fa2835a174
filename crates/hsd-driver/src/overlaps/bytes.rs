//! Grounds as bytes, while they wait in a spool.

use super::super::gaps::WallEnd;
use super::{Ground, Outline};
use glam::{DVec2, dvec2};
use hsd_base::source::{FileId, Span};

impl Ground {
    /// Appends its number in the run and all it is made of, except its bounds.
    pub(super) fn write(&self, number: u32, out: &mut Vec<u8>) {
        for word in [number, self.span.file.0, self.span.start, self.span.end] {
            count(word as usize, out);
        }
        count(self.name.len(), out);
        out.extend(self.name.bytes());
        self.heights.iter().for_each(|z| float(*z, out));
        count(self.rings.len(), out);
        for (ring, hole) in &self.rings {
            out.push((*hole).into());
            points(ring.iter().copied(), out);
        }
        count(self.open.len(), out);
        for line in &self.open {
            points(line.iter().copied(), out);
        }
        points(self.ends.iter().flat_map(|end| [end.at, end.out]), out);
    }

    /// Reads one that was written, with its number.
    pub(super) fn read(bytes: &mut &[u8]) -> Option<(u32, Ground)> {
        let [number, file, start, end] = [(); 4].map(|()| read_count(bytes));
        let span = Span {
            file: FileId(file?),
            start: start?,
            end: end?,
        };
        let length = read_count(bytes)? as usize;
        let name = std::str::from_utf8(bytes.split_off(..length)?).ok()?;
        let heights = [read_float(bytes)?, read_float(bytes)?];
        let rings = (0..read_count(bytes)?).map(|_| {
            let hole = *bytes.split_off_first()? != 0;
            Some((read_points(bytes)?.into(), hole))
        });
        let rings: Option<Box<[Outline]>> = rings.collect();
        let open = (0..read_count(bytes)?).map(|_| Some(read_points(bytes)?.into()));
        let open: Option<Box<[Box<[DVec2]>]>> = open.collect();
        let ends = read_points(bytes)?;
        let ends = ends.as_chunks::<2>().0.iter();
        let ends = ends.map(|[at, out]| WallEnd { at: *at, out: *out });
        let ends = ends.collect();
        let ground = Ground::new((span, name.into()), heights, (rings?, open?), ends)?;
        Some((number?, ground))
    }
}

fn count(value: usize, out: &mut Vec<u8>) {
    out.extend((value as u32).to_le_bytes());
}

fn float(value: f64, out: &mut Vec<u8>) {
    out.extend(value.to_le_bytes());
}

fn points(list: impl Iterator<Item = DVec2>, out: &mut Vec<u8>) {
    let at = out.len();
    count(0, out);
    let mut number = 0;
    for p in list {
        number += 1;
        p.to_array().iter().for_each(|x| float(*x, out));
    }
    out[at..at + 4].copy_from_slice(&u32::to_le_bytes(number));
}

fn read_count(bytes: &mut &[u8]) -> Option<u32> {
    let own = bytes.split_off(..4)?;
    Some(u32::from_le_bytes(own.try_into().ok()?))
}

fn read_float(bytes: &mut &[u8]) -> Option<f64> {
    let own = bytes.split_off(..8)?;
    Some(f64::from_le_bytes(own.try_into().ok()?))
}

fn read_points(bytes: &mut &[u8]) -> Option<Vec<DVec2>> {
    let number = read_count(bytes)?;
    let point = |_| Some(dvec2(read_float(bytes)?, read_float(bytes)?));
    (0..number).map(point).collect()
}
