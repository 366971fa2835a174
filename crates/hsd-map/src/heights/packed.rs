//! A part of a grid of heights as bytes. It gives the heights that the whole grid gives, to the last bit, wherever the part has
//! them: places are counted from the first cell of the whole.

use super::{Heights, Part};
use crate::pack::{Packer, Unpacker};
use glam::DVec2;
use std::io;

impl Heights {
    /// Appends the part in a box of places, in the system of the grid, to bytes.
    pub fn pack(&self, window: [DVec2; 2], out: &mut Packer<'_>) {
        let [a, b] = window.map(|corner| (corner - self.first) / self.step);
        let (low, high) = (a.min(b), a.max(b));
        // Two cells more, as a grid itself is cut.
        let range = |low: f64, high: f64, count: usize| {
            let from = (low.floor() - 2.0).clamp(0.0, count as f64) as usize;
            let to = (high.ceil() + 3.0).clamp(0.0, count as f64) as usize;
            from..to.max(from)
        };
        let columns = range(low.x, high.x, self.columns);
        let rows = range(low.y, high.y, self.rows);
        let rows = rows.start..rows.end.min(self.end()).max(rows.start);
        out.bytes(&[u8::from(self.crs.is_some())]);
        if let Some(crs) = &self.crs {
            out.crs(crs);
        }
        out.point(self.first);
        out.point(self.step);
        let numbers = [self.columns, self.rows, columns.start, rows.start];
        numbers.iter().for_each(|n| out.count(*n));
        out.count(columns.len());
        out.count(columns.len() * rows.len());
        for row in rows {
            for column in columns.clone() {
                let height = self.cell_at(column, row).unwrap_or(f32::NAN);
                out.bytes(&height.to_bits().to_le_bytes());
            }
        }
    }

    /// Takes a part from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Heights> {
        let crs = match from.array::<1>()? {
            [0] => None,
            _ => Some(from.crs()?),
        };
        let (first, step) = (from.point()?, from.point()?);
        let (columns, rows) = (from.count()?, from.count()?);
        let part = Part {
            from: [from.count()?, from.count()?],
            width: from.count()?,
        };
        let count = from.count()?;
        let bytes = from.bytes(count.saturating_mul(size_of::<f32>()))?;
        let (cells, _) = bytes.as_chunks();
        Ok(Heights {
            crs,
            first,
            step,
            columns,
            rows,
            values: cells.iter().map(|cell| f32::from_le_bytes(*cell)).collect(),
            part: Some(part),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Crs;

    #[test]
    fn a_part_gives_the_heights_of_the_whole() {
        let whole = Heights {
            crs: Some(Crs::local()),
            first: DVec2::new(100.3, 900.7),
            step: DVec2::new(1.7, -2.3),
            columns: 40,
            rows: 30,
            values: (0..40 * 30).map(|n| (n as f32).sin()).collect(),
            part: None,
        };
        let window = [DVec2::new(120.0, 850.0), DVec2::new(140.0, 880.0)];
        let mut bytes = vec![];
        whole.pack(window, &mut Packer::new(&mut bytes));
        let part = Heights::unpack(&mut Unpacker::new(&mut &bytes[..])).expect("is whole");
        assert!(part.values.len() < whole.values.len() / 2);
        assert_eq!(part.bounds(), whole.bounds());
        for n in 0..=1000 {
            let share = DVec2::new(f64::from(n % 31) / 30.0, f64::from(n % 37) / 36.0);
            let place = window[0] + (window[1] - window[0]) * share;
            assert_eq!(part.at(place), whole.at(place), "{place}");
        }
        assert_eq!(part.at(DVec2::new(0.0, 0.0)), None);
        for cut in 0..bytes.len() {
            assert!(Heights::unpack(&mut Unpacker::new(&mut &bytes[..cut])).is_err());
        }
    }
}
