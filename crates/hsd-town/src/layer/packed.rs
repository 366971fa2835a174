//! A feature, and what a layer is without features, as bytes: for the time that they wait in a spool or a folder of work.

use super::{Lot, Lots, Shape};
use hsd_ir::ast::town::Layer;
use hsd_map::pack::{Packer, Unpacker};
use hsd_map::{Faults, Value};
use std::io;

impl Lot {
    /// Appends it to bytes, behind the number of its layer.
    pub(crate) fn pack(&self, layer: usize, out: &mut Vec<u8>) {
        let mut out = Packer::new(out);
        out.count(layer);
        out.bytes(&self.number.to_le_bytes());
        out.text(&self.key);
        out.float(self.z);
        match &self.shape {
            Shape::Area(ring, holes) => {
                out.bytes(&[0]);
                out.points(ring);
                out.lines(holes);
            }
            Shape::Lines(lines) => {
                out.bytes(&[1]);
                out.lines(lines);
            }
            Shape::Point(point) => {
                out.bytes(&[2]);
                out.point(*point);
            }
        }
        out.count(self.fields.len());
        for (column, value) in &self.fields {
            out.count(*column);
            match value {
                Value::Null => out.bytes(&[0]),
                Value::Bool(truth) => out.bytes(&[1, u8::from(*truth)]),
                Value::Integer(n) => {
                    out.bytes(&[2]);
                    out.bytes(&n.to_le_bytes());
                }
                Value::Number(n) => {
                    out.bytes(&[3]);
                    out.float(*n);
                }
                Value::Text(text) => {
                    out.bytes(&[4]);
                    out.text(text);
                }
            }
        }
    }

    /// Takes a feature from the start of bytes, with the number of its layer.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(bytes: &mut &[u8]) -> io::Result<(usize, Lot)> {
        let mut from = Unpacker::new(bytes);
        let layer = from.count()?;
        let number = u32::from_le_bytes(from.array()?);
        let (key, z) = (from.text()?, from.float()?);
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
        };
        Ok((layer, lot))
    }
}

impl Lots {
    /// Appends the layer without features and faults to bytes.
    pub(crate) fn pack_head(&self, out: &mut Packer<'_>) {
        out.text(&self.layer.name.value);
        out.text(&self.file);
        out.count(self.columns.len());
        for (name, column) in &self.columns {
            out.text(name);
            out.count(*column);
        }
    }

    /// Takes a layer without features from the start of bytes; `layers` are those of the town file.
    ///
    /// # Errors
    /// If the bytes are not those that were written, or the town has no such layer.
    pub(crate) fn unpack_head(from: &mut Unpacker<'_, '_>, layers: &[Layer]) -> io::Result<Lots> {
        let name = from.text()?;
        let file = from.text()?.into();
        let columns = (0..from.count()?).map(|_| Ok((from.text()?, from.count()?)));
        let columns = columns.collect::<io::Result<_>>()?;
        let layer = layers.iter().find(|layer| *layer.name.value == *name);
        let layer = layer.ok_or_else(|| io::Error::from(io::ErrorKind::InvalidData))?;
        Ok(Lots {
            layer: layer.clone(),
            lots: vec![],
            bounds: None,
            columns,
            faults: Faults::default(),
            unread: vec![],
            left: vec![],
            file,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

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
