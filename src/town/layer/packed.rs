//! A feature as bytes, for the time that it waits in a spool.

use super::{Lot, Shape};
use crate::map::Value;
use glam::DVec2;
use std::io;

impl Lot {
    /// Appends it to bytes, behind the number of its layer.
    pub(in crate::town) fn pack(&self, layer: usize, out: &mut Vec<u8>) {
        let mut out = Packer(out);
        out.count(layer);
        out.0.extend(self.number.to_le_bytes());
        out.text(&self.key);
        out.float(self.z);
        out.count(self.parts_left);
        match &self.shape {
            Shape::Area(ring, holes) => {
                out.0.push(0);
                out.points(ring);
                out.lines(holes);
            }
            Shape::Lines(lines) => {
                out.0.push(1);
                out.lines(lines);
            }
            Shape::Point(point) => {
                out.0.push(2);
                out.point(*point);
            }
        }
        out.count(self.fields.len());
        for (column, value) in &self.fields {
            out.count(*column);
            match value {
                Value::Null => out.0.push(0),
                Value::Bool(truth) => out.0.extend([1, u8::from(*truth)]),
                Value::Integer(n) => {
                    out.0.push(2);
                    out.0.extend(n.to_le_bytes());
                }
                Value::Number(n) => {
                    out.0.push(3);
                    out.float(*n);
                }
                Value::Text(text) => {
                    out.0.push(4);
                    out.text(text);
                }
            }
        }
    }

    /// Takes a feature from the start of bytes, with the number of its layer.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(in crate::town) fn unpack(bytes: &mut &[u8]) -> io::Result<(usize, Lot)> {
        let mut from = Unpacker(bytes);
        let layer = from.count()?;
        let number = u32::from_le_bytes(from.array()?);
        let (key, z, parts_left) = (from.text()?, from.float()?, from.count()?);
        let shape = match from.array::<1>()? {
            [0] => Shape::Area(from.points()?, from.lines()?),
            [1] => Shape::Lines(from.lines()?),
            _ => Shape::Point(from.point()?),
        };
        let fields = (0..from.count()?).map(|_| {
            let column = from.count()?;
            let value = match from.array::<1>()? {
                [0] => Value::Null,
                [1] => Value::Bool(from.array::<1>()? == [1]),
                [2] => Value::Integer(i64::from_le_bytes(from.array()?)),
                [3] => Value::Number(from.float()?),
                _ => Value::Text(from.text()?),
            };
            Ok((column, value))
        });
        let fields = fields.collect::<io::Result<_>>()?;
        let lot = Lot {
            number,
            key,
            shape,
            fields,
            z,
            parts_left,
        };
        Ok((layer, lot))
    }
}

struct Packer<'b>(&'b mut Vec<u8>);

impl Packer<'_> {
    fn count(&mut self, count: usize) {
        self.0.extend((count as u64).to_le_bytes());
    }

    fn float(&mut self, number: f64) {
        self.0.extend(number.to_bits().to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.count(text.len());
        self.0.extend(text.as_bytes());
    }

    fn point(&mut self, point: DVec2) {
        self.float(point.x);
        self.float(point.y);
    }

    fn points(&mut self, points: &[DVec2]) {
        self.count(points.len());
        points.iter().for_each(|point| self.point(*point));
    }

    fn lines(&mut self, lines: &[Vec<DVec2>]) {
        self.count(lines.len());
        lines.iter().for_each(|line| self.points(line));
    }
}

struct Unpacker<'r, 'b>(&'r mut &'b [u8]);

impl Unpacker<'_, '_> {
    fn bytes(&mut self, count: usize) -> io::Result<&[u8]> {
        let short = || io::Error::from(io::ErrorKind::UnexpectedEof);
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(short)?;
        *self.0 = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut array = [0; N];
        array.copy_from_slice(self.bytes(N)?);
        Ok(array)
    }

    fn count(&mut self) -> io::Result<usize> {
        Ok(u64::from_le_bytes(self.array()?) as usize)
    }

    fn float(&mut self) -> io::Result<f64> {
        Ok(f64::from_bits(u64::from_le_bytes(self.array()?)))
    }

    fn text(&mut self) -> io::Result<Box<str>> {
        let count = self.count()?;
        let text = str::from_utf8(self.bytes(count)?).map_err(io::Error::other)?;
        Ok(text.into())
    }

    fn point(&mut self) -> io::Result<DVec2> {
        Ok(DVec2::new(self.float()?, self.float()?))
    }

    fn points(&mut self) -> io::Result<Vec<DVec2>> {
        (0..self.count()?).map(|_| self.point()).collect()
    }

    fn lines(&mut self) -> io::Result<Vec<Vec<DVec2>>> {
        (0..self.count()?).map(|_| self.points()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_feature_comes_back_as_it_was() {
        let ring = vec![DVec2::ZERO, DVec2::new(0.1, f64::MIN_POSITIVE), DVec2::ONE];
        let shapes = [
            Shape::Area(ring.clone(), vec![ring.clone(), ring.clone()]),
            Shape::Lines(vec![ring.clone(), vec![]]),
            Shape::Point(DVec2::new(-1e300, 0.3)),
        ];
        let mut bytes = vec![];
        let mut written = vec![];
        for (n, shape) in shapes.into_iter().enumerate() {
            let lot = Lot {
                number: u32::MAX - n as u32,
                key: format!("京 {n}").into(),
                shape,
                fields: vec![
                    (0, Value::Null),
                    (3, Value::Bool(true)),
                    (4, Value::Integer(i64::MIN)),
                    (70_000, Value::Number(0.1 + 0.2)),
                    (70_001, Value::Text("".into())),
                ],
                z: -0.0,
                parts_left: n,
            };
            lot.pack(n, &mut bytes);
            written.push(format!("{lot:?}"));
        }
        let mut rest = &bytes[..];
        for (n, wanted) in written.iter().enumerate() {
            let (layer, lot) = Lot::unpack(&mut rest).expect("is whole");
            assert_eq!((layer, &format!("{lot:?}")), (n, wanted));
        }
        assert!(rest.is_empty());
        for cut in 0..bytes.len() {
            let mut short = &bytes[..cut];
            while !short.is_empty() && Lot::unpack(&mut short).is_ok() {}
        }
    }
}
