//! OpenStreetMap PBF: blocks of protocol buffers, packed by zlib (wiki.openstreetmap.org/wiki/PBF_Format).

use super::{Data, Tags};
use crate::fault::{Fault, Kind};
use crate::input::{Input, unreadable};
use flate2::read::ZlibDecoder;
use hsd_base::budget::{Account, Exhausted, Resource};
use std::io::Read;
use std::sync::Arc;

/// The most bytes of a block, packed and unpacked, and of its head (the format's own limits).
const MOST_BLOCK: usize = 32 << 20;
const MOST_HEAD: usize = 64 << 10;

/// Bytes that a text takes beside its letters.
const SLICE: u64 = size_of::<&[u8]>() as u64;

/// The reason to stop reading a block.
#[derive(Debug)]
enum Wrong {
    /// It is not written as the format demands.
    Form,
    /// It expands to too much.
    Exhausted(Exhausted),
}

impl From<Exhausted> for Wrong {
    fn from(exhausted: Exhausted) -> Wrong {
        Wrong::Exhausted(exhausted)
    }
}

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
        let charged = data
            .account
            .charge(Resource::InflatedBytes, block.len() as u64);
        let read = charged.map_err(Wrong::from);
        let read = read.and_then(|()| match of == b"OSMData" {
            true => primitives(&block, data),
            false => Ok(()),
        });
        read.map_err(|wrong| match wrong {
            Wrong::Form => damaged("a block is not as its format demands"),
            Wrong::Exhausted(what) => Fault::of_file(file, what.into()).at(at),
        })?;
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
                        data.account.charge(Resource::TextBytes, SLICE)?;
                        block.strings.push(string);
                    }
                }
            }
            (2, Wire::Bytes(group)) => {
                data.account.charge(Resource::TextBytes, SLICE)?;
                block.groups.push(group);
            }
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
    /// Returns a copy of a string, which any number of things may name; an empty one takes memory too.
    fn string(&self, index: u64, account: &Account) -> Result<Box<str>, Wrong> {
        let index = usize::try_from(index).map_err(|_| Wrong::Form)?;
        let bytes = self.strings.get(index).ok_or(Wrong::Form)?;
        account.charge(Resource::TextBytes, SLICE + bytes.len() as u64)?;
        Ok(String::from_utf8_lossy(bytes).into())
    }

    fn tags(
        &self,
        keys: &Numbers<'_>,
        values: &Numbers<'_>,
        account: &Account,
    ) -> Result<Tags, Wrong> {
        let string = |index: Result<u64, Wrong>| self.string(index?, account);
        keys.iter()
            .zip(values.iter())
            .map(|(k, v)| Ok((string(k)?, string(v)?)))
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
            _ => Err(Wrong::Form),
        }
    }

    fn node(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let (mut id, mut lon, mut lat) = (0, 0, 0);
        let (mut keys, mut values) = (Numbers::default(), Numbers::default());
        for field in Fields(bytes) {
            match field? {
                (1, Wire::Number(n)) => id = zigzag(n),
                (2, wire) => keys.add(&wire, &data.account)?,
                (3, wire) => values.add(&wire, &data.account)?,
                (8, Wire::Number(n)) => lat = zigzag(n),
                (9, Wire::Number(n)) => lon = zigzag(n),
                _ => {}
            }
        }
        let tags = self.tags(&keys, &values, &data.account)?;
        Ok(data.add_node(id, self.place(lon, lat)?, tags)?)
    }

    fn dense(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let [mut ids, mut lons, mut lats, mut tags] = [const { Numbers(vec![]) }; 4];
        for field in Fields(bytes) {
            match field? {
                (1, wire) => ids.add(&wire, &data.account)?,
                (8, wire) => lats.add(&wire, &data.account)?,
                (9, wire) => lons.add(&wire, &data.account)?,
                (10, wire) => tags.add(&wire, &data.account)?,
                _ => {}
            }
        }
        if ids.count() != lons.count() || ids.count() != lats.count() {
            return Err(Wrong::Form);
        }
        // Keys and values of one node after another, each ended by 0.
        let mut tags = tags.iter();
        let places = lons.summed().zip(lats.summed());
        for (id, (lon, lat)) in ids.summed().zip(places) {
            let mut own = vec![];
            while let Some(key) = tags.next().transpose()?.filter(|key| *key != 0) {
                let value = tags.next().ok_or(Wrong::Form)??;
                let string = |index| self.string(index, &data.account);
                own.push((string(key)?, string(value)?));
            }
            data.add_node(id?, self.place(lon?, lat?)?, own)?;
        }
        Ok(())
    }

    fn way(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let mut id = 0;
        let [mut keys, mut values, mut nodes] = [const { Numbers(vec![]) }; 3];
        for field in Fields(bytes) {
            match field? {
                (1, Wire::Number(n)) => id = n as i64,
                (2, wire) => keys.add(&wire, &data.account)?,
                (3, wire) => values.add(&wire, &data.account)?,
                (8, wire) => nodes.add(&wire, &data.account)?,
                _ => {}
            }
        }
        let tags = self.tags(&keys, &values, &data.account)?;
        let count = nodes.count() as u64;
        data.account.charge(Resource::Points, count)?;
        let nodes = nodes.summed().collect::<Result<Vec<i64>, Wrong>>()?;
        Ok(data.add_way(id, nodes, tags)?)
    }

    fn relation(&self, bytes: &[u8], data: &mut Data) -> Result<(), Wrong> {
        let mut id = 0;
        let [mut keys, mut values, mut members, mut types] = [const { Numbers(vec![]) }; 4];
        for field in Fields(bytes) {
            match field? {
                (1, Wire::Number(n)) => id = n as i64,
                (2, wire) => keys.add(&wire, &data.account)?,
                (3, wire) => values.add(&wire, &data.account)?,
                (9, wire) => members.add(&wire, &data.account)?,
                (10, wire) => types.add(&wire, &data.account)?,
                _ => {}
            }
        }
        const WAY: u64 = 1;
        let count = members.count() as u64;
        data.account.charge(Resource::Points, count)?;
        let mut ways = vec![];
        for (member, of) in members.summed().zip(types.iter()) {
            if of? == WAY {
                ways.push(member?);
            }
        }
        let tags = self.tags(&keys, &values, &data.account)?;
        Ok(data.add_relation(id, ways, tags)?)
    }
}

/// Returns a signed number that is written so that small ones are short.
fn zigzag(n: u64) -> i64 {
    (n >> 1) as i64 ^ -((n & 1) as i64)
}

/// A value of a protocol buffer.
enum Wire<'a> {
    Number(u64),
    Bytes(&'a [u8]),
    Other,
}

/// A list of numbers, read while it is gone through: a packed one takes a byte a number, or less.
#[derive(Default)]
struct Numbers<'a>(Vec<Run<'a>>);

enum Run<'a> {
    One(u64),
    Packed(&'a [u8]),
}

impl<'a> Numbers<'a> {
    /// Appends a number, or those of a packed list.
    fn add(&mut self, wire: &Wire<'a>, account: &Account) -> Result<(), Wrong> {
        account.charge(Resource::TextBytes, size_of::<Run<'_>>() as u64)?;
        match wire {
            Wire::Number(n) => self.0.push(Run::One(*n)),
            Wire::Bytes(packed) => self.0.push(Run::Packed(packed)),
            Wire::Other => {}
        }
        Ok(())
    }

    /// Returns how many there are; a last one that is cut off is not counted.
    fn count(&self) -> usize {
        let of = |run: &Run<'_>| match run {
            Run::One(_) => 1,
            Run::Packed(bytes) => bytes.iter().filter(|b| **b & 0x80 == 0).count(),
        };
        self.0.iter().map(of).sum()
    }

    fn iter(&self) -> impl Iterator<Item = Result<u64, Wrong>> {
        self.0.iter().flat_map(|run| {
            let (one, mut packed) = match run {
                Run::One(n) => (Some(Ok(*n)), &[][..]),
                Run::Packed(bytes) => (None, *bytes),
            };
            let rest = std::iter::from_fn(move || {
                let number = (!packed.is_empty()).then(|| varint(&mut packed))?;
                if number.is_none() {
                    packed = &[];
                }
                Some(number.ok_or(Wrong::Form))
            });
            one.into_iter().chain(rest)
        })
    }

    /// Returns numbers that are written as differences.
    fn summed(&self) -> impl Iterator<Item = Result<i64, Wrong>> {
        let mut sum = 0i64;
        self.iter().map(move |n| {
            sum = sum.wrapping_add(zigzag(n?));
            Ok(sum)
        })
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
        Some(field.ok_or(Wrong::Form))
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
