//! Numbers, texts and places as bytes that give back the same bits: what waits in a spool or a folder of work.

use super::{Crs, Datum, Projection};
use crate::crs::Meridian;
use glam::DVec2;
use std::io;

/// Appends values to bytes.
pub struct Packer<'b>(&'b mut Vec<u8>);

impl<'b> Packer<'b> {
    /// Begins at the end of some bytes.
    pub fn new(out: &'b mut Vec<u8>) -> Packer<'b> {
        Packer(out)
    }

    /// Returns all bytes.
    pub fn all(&mut self) -> &mut Vec<u8> {
        self.0
    }

    /// Appends bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    /// Appends a whole number.
    pub fn count(&mut self, count: usize) {
        self.bytes(&(count as u64).to_le_bytes());
    }

    /// Appends a number.
    pub fn float(&mut self, number: f64) {
        self.bytes(&number.to_bits().to_le_bytes());
    }

    /// Appends a text.
    pub fn text(&mut self, text: &str) {
        self.count(text.len());
        self.bytes(text.as_bytes());
    }

    /// Appends a place.
    pub fn point(&mut self, point: DVec2) {
        self.float(point.x);
        self.float(point.y);
    }

    /// Appends a line.
    pub fn points(&mut self, points: &[DVec2]) {
        self.count(points.len());
        points.iter().for_each(|point| self.point(*point));
    }

    /// Appends lines.
    pub fn lines(&mut self, lines: &[Vec<DVec2>]) {
        self.count(lines.len());
        lines.iter().for_each(|line| self.points(line));
    }

    /// Appends a reference system.
    pub fn crs(&mut self, crs: &Crs) {
        self.text(&crs.name);
        match &crs.datum {
            Datum::Wgs84 => self.bytes(&[0]),
            Datum::Jgd2011 => self.bytes(&[1]),
            Datum::Jgd2000 => self.bytes(&[2]),
            Datum::Tokyo => self.bytes(&[3]),
            Datum::Local => self.bytes(&[4]),
            Datum::Other { name, definition } => {
                self.bytes(&[5]);
                self.text(name);
                self.text(definition);
            }
        }
        match &crs.projection {
            Projection::Degrees => self.bytes(&[0]),
            Projection::WebMercator => self.bytes(&[1]),
            Projection::Local => self.bytes(&[2]),
            Projection::TransverseMercator(m) => {
                self.bytes(&[3]);
                for number in [m.lon, m.lat, m.scale, m.east, m.north, m.unit] {
                    self.float(number);
                }
            }
            Projection::Defined(definition) => {
                self.bytes(&[4]);
                self.text(definition);
            }
        }
    }
}

/// Takes values from the start of bytes, each as it was appended. All fail if the bytes are not those that were written.
pub struct Unpacker<'r, 'b>(&'r mut &'b [u8]);

impl<'r, 'b> Unpacker<'r, 'b> {
    /// Begins at the start of some bytes.
    pub fn new(bytes: &'r mut &'b [u8]) -> Unpacker<'r, 'b> {
        Unpacker(bytes)
    }

    /// Returns what is left.
    pub fn rest(&mut self) -> &mut &'b [u8] {
        self.0
    }

    /// Takes bytes.
    ///
    /// # Errors
    /// If there are fewer.
    pub fn bytes(&mut self, count: usize) -> io::Result<&'b [u8]> {
        let short = || io::Error::from(io::ErrorKind::UnexpectedEof);
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(short)?;
        *self.0 = rest;
        Ok(taken)
    }

    /// Takes so many bytes.
    ///
    /// # Errors
    /// If there are fewer.
    pub fn array<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut array = [0; N];
        array.copy_from_slice(self.bytes(N)?);
        Ok(array)
    }

    /// Takes a whole number.
    ///
    /// # Errors
    /// If there is none.
    pub fn count(&mut self) -> io::Result<usize> {
        Ok(u64::from_le_bytes(self.array()?) as usize)
    }

    /// Takes a number.
    ///
    /// # Errors
    /// If there is none.
    pub fn float(&mut self) -> io::Result<f64> {
        Ok(f64::from_bits(u64::from_le_bytes(self.array()?)))
    }

    /// Takes a text.
    ///
    /// # Errors
    /// If there is none.
    pub fn text(&mut self) -> io::Result<Box<str>> {
        let count = self.count()?;
        let text = str::from_utf8(self.bytes(count)?).map_err(io::Error::other)?;
        Ok(text.into())
    }

    /// Takes a place.
    ///
    /// # Errors
    /// If there is none.
    pub fn point(&mut self) -> io::Result<DVec2> {
        Ok(DVec2::new(self.float()?, self.float()?))
    }

    /// Takes a line.
    ///
    /// # Errors
    /// If there is none.
    pub fn points(&mut self) -> io::Result<Vec<DVec2>> {
        (0..self.count()?).map(|_| self.point()).collect()
    }

    /// Takes lines.
    ///
    /// # Errors
    /// If there are none.
    pub fn lines(&mut self) -> io::Result<Vec<Vec<DVec2>>> {
        (0..self.count()?).map(|_| self.points()).collect()
    }

    /// Takes a reference system.
    ///
    /// # Errors
    /// If there is none.
    pub fn crs(&mut self) -> io::Result<Crs> {
        let wrong = || io::Error::from(io::ErrorKind::InvalidData);
        let name = self.text()?;
        let datum = match self.array::<1>()? {
            [0] => Datum::Wgs84,
            [1] => Datum::Jgd2011,
            [2] => Datum::Jgd2000,
            [3] => Datum::Tokyo,
            [4] => Datum::Local,
            [5] => Datum::Other {
                name: self.text()?,
                definition: self.text()?,
            },
            _ => return Err(wrong()),
        };
        let projection = match self.array::<1>()? {
            [0] => Projection::Degrees,
            [1] => Projection::WebMercator,
            [2] => Projection::Local,
            [3] => Projection::TransverseMercator(Meridian {
                lon: self.float()?,
                lat: self.float()?,
                scale: self.float()?,
                east: self.float()?,
                north: self.float()?,
                unit: self.float()?,
            }),
            [4] => Projection::Defined(self.text()?),
            _ => return Err(wrong()),
        };
        Ok(Crs {
            name,
            datum,
            projection,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_systems_come_back_as_they_were() {
        let names = [
            "EPSG:6674",
            "EPSG:4326",
            "EPSG:3857",
            "EPSG:30166",
            "EPSG:2263",
            "EPSG:27700",
            "local",
        ];
        let known = names.iter().filter_map(|name| Crs::from_name(name));
        let other = Crs {
            name: "京".into(),
            datum: Datum::Other {
                name: "d".into(),
                definition: "+a=6377397.155 +rf=299.15".into(),
            },
            projection: Projection::Degrees,
        };
        let all: Vec<Crs> = known.chain([other]).collect();
        assert!(all.len() > 6);
        let mut bytes = vec![];
        all.iter().for_each(|crs| Packer::new(&mut bytes).crs(crs));
        let mut rest = &bytes[..];
        for crs in &all {
            assert_eq!(Unpacker::new(&mut rest).crs().ok().as_ref(), Some(crs));
        }
        for cut in 0..bytes.len() {
            let mut short = &bytes[..cut];
            while Unpacker::new(&mut short).crs().is_ok() {}
        }
    }
}
