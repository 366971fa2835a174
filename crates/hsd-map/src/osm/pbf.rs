//! OpenStreetMap PBF: blocks of protocol buffers, packed by zlib (wiki.openstreetmap.org/wiki/PBF_Format).

use super::{Data, Tags};
use crate::fault::{Fault, Kind};
use crate::input::{Input, unreadable};
use flate2::read::ZlibDecoder;
use std::io::Read;
use std::sync::Arc;

/// The most bytes of a block, packed and unpacked, and of its head (the format's own limits).
const MOST_BLOCK: usize = 32 << 20;
const MOST_HEAD: usize = 64 << 10;

/// A message that is not written as the format demands.
#[derive(Debug)]
struct Wrong;

/// Reads a file.
///
/// # Errors
/// If it is damaged from somewhere on.
pub(super) fn read(mut input: Input, file: &Arc<str>, data: &mut Data) -> Result<(), Fault> {
    loop {
        let at = input.at();
        let damaged = |what| Fault::of_file(file, Kind::Damaged { what }).at(at);
        let mut length = vec![];
        let taken = (&mut input).take(4).read_to_end(&mut length);
        taken.map_err(|e| unreadable(file, &e))?;
        let Ok(length) = <[u8; 4]>::try_from(&length[..]) else {
            return match length.is_empty() {
                true => Ok(()),
                false => Err(damaged("the file ends in the middle")),
            };
        };
        let head = u32::from_be_bytes(length) as usize;
        let head = exactly(&mut input, head, MOST_HEAD);
        let (of, size) = head
            .as_deref()
            .and_then(blob_head)
            .ok_or_else(|| damaged("the head of a block"))?;
        let blob = exactly(&mut input, size, MOST_BLOCK);
        let block = blob.as_deref().and_then(unpacked);
        let block = block.ok_or_else(|| damaged("a block cannot be unpacked"))?;
        if of == b"OSMData" {
            primitives(&block, data)
                .map_err(|Wrong| damaged("a block is not as its format demands"))?;
        }
    }
}

/// Reads so many bytes, if they are there and not too many.
fn exactly(input: &mut Input, count: usize, most: usize) -> Option<Vec<u8>> {
    let mut bytes = vec![];
    let taken = (count <= most).then(|| input.take(count as u64).read_to_end(&mut bytes))?;
    (taken.ok()? == count).then_some(bytes)
}

/// Returns the type of a block and the length of what follows.
fn blob_head(bytes: &[u8]) -> Option<(Vec<u8>, usize)> {
    let (mut of, mut size) = (vec![], None);
    for field in Fields(bytes) {
        match field.ok()? {
            (1, Wire::Bytes(name)) => of = name.to_vec(),
            (3, Wire::Number(length)) => size = usize::try_from(length).ok(),
            _ => {}
        }
    }
    Some((of, size?))
}

fn unpacked(blob: &[u8]) -> Option<Vec<u8>> {
    for field in Fields(blob) {
        match field.ok()? {
            (1, Wire::Bytes(raw)) => return Some(raw.to_vec()),
            (3, Wire::Bytes(packed)) => {
                let mut out = vec![];
                let mut decoder = ZlibDecoder::new(packed).take(MOST_BLOCK as u64 + 1);
                decoder.read_to_end(&mut out).ok()?;
                return (out.len() <= MOST_BLOCK).then_some(out);
            }
            _ => {}
        }
    }
    None
}

/// A block of things.
#[derive(Default)]
struct Block<'a> {
    strings: Vec<&'a [u8]>,
    groups: Vec<&'a [u8]>,
    granularity: i64,
    lat: i64,
    lon: i64,
}

fn primitives(bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
    let mut block = Block {
        granularity: 100,
        ..Block::default()
    };
    for field in Fields(bytes) {
        match field? {
            (1, Wire::Bytes(table)) => {
                for string in Fields(table) {
                    if let (1, Wire::Bytes(string)) = string? {
                        block.strings.push(string);
                    }
                }
            }
            (2, Wire::Bytes(group)) => block.groups.push(group),
            (17, Wire::Number(n)) => block.granularity = n as i64,
            (19, Wire::Number(n)) => block.lat = n as i64,
            (20, Wire::Number(n)) => block.lon = n as i64,
            _ => {}
        }
    }
    for group in &block.groups {
        for thing in Fields(group) {
            match thing? {
                (1, Wire::Bytes(node)) => block.node(node, data)?,
                (2, Wire::Bytes(nodes)) => block.dense(nodes, data)?,
                (3, Wire::Bytes(way)) => block.way(way, data)?,
                (4, Wire::Bytes(relation)) => block.relation(relation, data)?,
                _ => {}
            }
        }
    }
    Ok(())
}

impl Block<'_> {
    fn string(&self, index: u64) -> Result<Box<str>, Wrong> {
        let index = usize::try_from(index).map_err(|_| Wrong)?;
        let bytes = self.strings.get(index).ok_or(Wrong)?;
        Ok(String::from_utf8_lossy(bytes).into())
    }

    fn tags(&self, keys: &[u64], values: &[u64]) -> Result<Tags, Wrong> {
        let pairs = keys.iter().zip(values);
        pairs
            .map(|(k, v)| Ok((self.string(*k)?, self.string(*v)?)))
            .collect()
    }

    /// Returns a place in parts of a degree; the block counts billionths.
    fn place(&self, lon: i64, lat: i64) -> Result<[i32; 2], Wrong> {
        let parts = |offset: i64, n: i64| {
            let billionths = n.checked_mul(self.granularity)?.checked_add(offset)?;
            let rounded = billionths.checked_add(if billionths < 0 { -50 } else { 50 })? / 100;
            i32::try_from(rounded).ok()
        };
        match (parts(self.lon, lon), parts(self.lat, lat)) {
            (Some(lon), Some(lat)) => Ok([lon, lat]),
            _ => Err(Wrong),
        }
    }

    fn node(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let (mut id, mut lon, mut lat) = (0, 0, 0);
        let (mut keys, mut values) = (vec![], vec![]);
        for field in Fields(bytes) {
            match field? {
                (1, Wire::Number(n)) => id = zigzag(n),
                (2, wire) => wire.numbers(&mut keys)?,
                (3, wire) => wire.numbers(&mut values)?,
                (8, Wire::Number(n)) => lat = zigzag(n),
                (9, Wire::Number(n)) => lon = zigzag(n),
                _ => {}
            }
        }
        data.add_node(id, self.place(lon, lat)?, self.tags(&keys, &values)?);
        Ok(())
    }

    fn dense(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let (mut ids, mut lons, mut lats, mut tags) = (vec![], vec![], vec![], vec![]);
        for field in Fields(bytes) {
            match field? {
                (1, wire) => wire.numbers(&mut ids)?,
                (8, wire) => wire.numbers(&mut lats)?,
                (9, wire) => wire.numbers(&mut lons)?,
                (10, wire) => wire.numbers(&mut tags)?,
                _ => {}
            }
        }
        if ids.len() != lons.len() || ids.len() != lats.len() {
            return Err(Wrong);
        }
        let (ids, lons, lats) = (summed(&ids), summed(&lons), summed(&lats));
        // Keys and values of one node after another, each ended by 0.
        let mut tags = tags.iter();
        for ((id, lon), lat) in ids.into_iter().zip(lons).zip(lats) {
            let mut own = vec![];
            while let Some(key) = tags.next().filter(|key| **key != 0) {
                let value = tags.next().ok_or(Wrong)?;
                own.push((self.string(*key)?, self.string(*value)?));
            }
            data.add_node(id, self.place(lon, lat)?, own);
        }
        Ok(())
    }

    fn way(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let (mut id, mut keys, mut values, mut nodes) = (0, vec![], vec![], vec![]);
        for field in Fields(bytes) {
            match field? {
                (1, Wire::Number(n)) => id = n as i64,
                (2, wire) => wire.numbers(&mut keys)?,
                (3, wire) => wire.numbers(&mut values)?,
                (8, wire) => wire.numbers(&mut nodes)?,
                _ => {}
            }
        }
        data.add_way(id, summed(&nodes), self.tags(&keys, &values)?);
        Ok(())
    }

    fn relation(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let (mut id, mut keys, mut values) = (0, vec![], vec![]);
        let (mut members, mut types) = (vec![], vec![]);
        for field in Fields(bytes) {
            match field? {
                (1, Wire::Number(n)) => id = n as i64,
                (2, wire) => wire.numbers(&mut keys)?,
                (3, wire) => wire.numbers(&mut values)?,
                (9, wire) => wire.numbers(&mut members)?,
                (10, wire) => wire.numbers(&mut types)?,
                _ => {}
            }
        }
        const WAY: u64 = 1;
        let members = summed(&members).into_iter().zip(types);
        let ways = members.filter(|(_, of)| *of == WAY).map(|(way, _)| way);
        data.add_relation(id, ways.collect(), self.tags(&keys, &values)?);
        Ok(())
    }
}

/// Returns a signed number that is written so that small ones are short.
fn zigzag(n: u64) -> i64 {
    (n >> 1) as i64 ^ -((n & 1) as i64)
}

/// Returns numbers that are written as differences.
fn summed(differences: &[u64]) -> Vec<i64> {
    let mut sum = 0i64;
    let add = |n: &u64| {
        sum = sum.wrapping_add(zigzag(*n));
        sum
    };
    differences.iter().map(add).collect()
}

/// A value of a protocol buffer.
enum Wire<'a> {
    Number(u64),
    Bytes(&'a [u8]),
    Other,
}

impl Wire<'_> {
    /// Appends a number, or those of a packed list.
    fn numbers(&self, out: &mut Vec<u64>) -> Result<(), Wrong> {
        match self {
            Wire::Number(n) => out.push(*n),
            Wire::Bytes(packed) => {
                let mut rest = *packed;
                while !rest.is_empty() {
                    out.push(varint(&mut rest).ok_or(Wrong)?);
                }
            }
            Wire::Other => {}
        }
        Ok(())
    }
}

/// The fields of a message with their numbers.
struct Fields<'a>(&'a [u8]);

impl<'a> Iterator for Fields<'a> {
    type Item = Result<(u64, Wire<'a>), Wrong>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let field = self.field();
        if field.is_none() {
            self.0 = &[];
        }
        Some(field.ok_or(Wrong))
    }
}

impl<'a> Fields<'a> {
    fn field(&mut self) -> Option<(u64, Wire<'a>)> {
        let key = varint(&mut self.0)?;
        let mut take = |count: usize| {
            let (taken, rest) = self.0.split_at_checked(count)?;
            self.0 = rest;
            Some(taken)
        };
        let wire = match key & 7 {
            0 => Wire::Number(varint(&mut self.0)?),
            1 => take(8).map(|_| Wire::Other)?,
            2 => {
                let count = usize::try_from(varint(&mut self.0)?).ok()?;
                let (taken, rest) = self.0.split_at_checked(count)?;
                self.0 = rest;
                Wire::Bytes(taken)
            }
            5 => take(4).map(|_| Wire::Other)?,
            _ => return None,
        };
        Some((key >> 3, wire))
    }
}

/// Takes a number of variable length.
fn varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for (at, byte) in bytes.iter().enumerate().take(10) {
        number |= u64::from(byte & 0x7f) << (7 * at);
        if byte & 0x80 == 0 {
            *bytes = &bytes[at + 1..];
            return Some(number);
        }
    }
    None
}
