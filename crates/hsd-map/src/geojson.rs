//! GeoJSON (RFC 7946): a collection, a single feature or bare geometry, features one a line, and text sequences (RFC 8142).
//!
//! A feature that is written wrongly does not end the file: reading goes on at the next one.

mod decode;
mod scan;

use super::fault::{Fault, Kind};
use super::feature::{Feature, Layer, Place};
use super::input::{Input, unreadable};
use super::{Crs, Options, Reader};
use decode::{Decoded, Flaw};
use scan::{Bad, Scanner};
use std::sync::Arc;

/// Broken features after which the rest of a file is given up, since each makes it be looked through again.
const ENOUGH_BROKEN: usize = 1000;

/// A reader of GeoJSON.
pub(super) struct GeoJson {
    scanner: Scanner,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    state: State,
    number: u64,
    broken: usize,
    feature_bytes: usize,
    /// True if the bytes of the stream are those of the file, so that places may be given.
    exact: bool,
    /// True if the reference system was given beside the file.
    crs_is_given: bool,
}

/// Where the reader stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// Between values of the file.
    Top,
    /// In the list of a collection's features.
    Features,
    /// After that list, in the same collection.
    Rest,
    /// At the end.
    Over,
}

/// What an object at the top of the file is.
enum Object {
    /// A collection, of which the list of features begins.
    Collection,
    /// A feature or geometry, as it is written, and its first byte.
    Feature(Vec<u8>, u64),
}

impl GeoJson {
    /// Begins to read.
    ///
    /// # Errors
    /// If the encoding that is named is not known, or nothing can be read.
    pub(super) fn open(input: Input, file: &Arc<str>, options: &Options) -> Result<GeoJson, Fault> {
        let (input, encoding) = input.into_text(file, options.encoding.as_deref())?;
        let layer = Layer {
            name: super::stem(file).into(),
            crs: options.crs.clone().or_else(|| Some(Crs::wgs84())),
            crs_is_usual: options.crs.is_none(),
            ..Layer::default()
        };
        Ok(GeoJson {
            scanner: Scanner::new(input),
            file: file.clone(),
            layer,
            remarks: vec![],
            state: State::Top,
            number: 0,
            broken: 0,
            feature_bytes: options.limits.feature_bytes,
            exact: encoding == encoding_rs::UTF_8,
            crs_is_given: options.crs.is_some(),
        })
    }

    fn fault(&self, byte: u64, kind: Kind) -> Fault {
        let fault = Fault::of_file(&self.file, kind);
        if self.exact { fault.at(byte) } else { fault }
    }

    /// Returns the fault of a feature, which counts as one.
    fn lost(&mut self, byte: u64, id: Option<Box<str>>, kind: Kind) -> Fault {
        let number = self.number;
        self.number += 1;
        self.fault(byte, kind).of_feature(number, id)
    }

    /// Ends the reading.
    fn give_up(&mut self, kind: Kind) -> Fault {
        self.state = State::Over;
        self.fault(self.scanner.at(), kind)
    }

    fn bad(&mut self, bad: Bad) -> Fault {
        let kind = match bad {
            Bad::Ends => Kind::Damaged {
                what: "the file ends in the middle",
            },
            Bad::TooLarge => Kind::TooLarge {
                what: "bytes of a feature",
                limit: self.feature_bytes as u64,
            },
            Bad::Unexpected => Kind::Damaged {
                what: "this is no GeoJSON",
            },
            Bad::Io(error) => unreadable(&self.file, &error).kind,
        };
        self.give_up(kind)
    }

    /// Reads an object at the top, from its brace on, up to its end or to the list of its features.
    fn object(&mut self) -> Result<Object, Bad> {
        let from = self.scanner.at();
        let mut raw = vec![];
        self.scanner.take(&mut raw)?;
        loop {
            match self.scanner.skip(b" \t\r\n,")? {
                Some(b'}') => {
                    self.scanner.take(&mut raw)?;
                    return Ok(Object::Feature(raw, from));
                }
                Some(b'"') => {}
                Some(_) => return Err(Bad::Unexpected),
                None => return Err(Bad::Ends),
            }
            if raw.len() > 1 {
                raw.push(b',');
            }
            let key = raw.len();
            self.scanner.value(&mut raw, self.feature_bytes)?;
            let key = key..raw.len();
            if self.scanner.skip(b" \t\r\n")? != Some(b':') {
                return Err(Bad::Unexpected);
            }
            self.scanner.take(&mut raw)?;
            let opens = self.scanner.skip(b" \t\r\n")?;
            if raw[key.clone()] == *b"\"features\"" && opens == Some(b'[') {
                self.scanner.drop_one()?;
                return Ok(Object::Collection);
            }
            let value = raw.len();
            self.scanner.value(&mut raw, self.feature_bytes)?;
            if raw[key.clone()] == *b"\"crs\"" {
                let value = raw[value..].to_vec();
                self.declare(&value);
            }
        }
    }

    /// Takes the reference system that a collection names, as files before RFC 7946 do.
    fn declare(&mut self, value: &[u8]) {
        let Some(name) = decode::crs_name(value) else {
            return;
        };
        match Crs::from_name(&name) {
            Some(crs)
                if !self.crs_is_given
                    && self.number > 0
                    && self.layer.crs.as_ref() != Some(&crs) =>
            {
                let kind = Kind::LateCrs { name: name.into() };
                self.remarks.push(self.fault(self.scanner.at(), kind));
            }
            _ if self.crs_is_given => {}
            Some(crs) => {
                self.layer.crs = Some(crs);
                self.layer.crs_is_usual = false;
            }
            None => {
                self.layer.crs = None;
                let kind = Kind::UnknownCrs { name: name.into() };
                self.remarks.push(self.fault(self.scanner.at(), kind));
            }
        }
    }

    fn at_top(&mut self) -> Result<Option<Result<Feature, Fault>>, Bad> {
        // Text sequences begin each text with a record separator.
        match self.scanner.skip(b" \t\r\n,\x1e")? {
            None => {
                self.state = State::Over;
                Ok(None)
            }
            Some(b'{') => match self.object()? {
                Object::Collection => {
                    self.state = State::Features;
                    Ok(None)
                }
                Object::Feature(raw, from) => Ok(Some(self.decode(&raw, from))),
            },
            Some(_) => Err(Bad::Unexpected),
        }
    }

    fn in_features(&mut self) -> Result<Option<Result<Feature, Fault>>, Bad> {
        match self.scanner.skip(b" \t\r\n,")? {
            Some(b']') => {
                self.scanner.drop_one()?;
                self.state = State::Rest;
                return Ok(None);
            }
            Some(b'}' | b':') => {
                let from = self.scanner.at();
                self.scanner.seek_feature()?;
                let what = "a bracket closes what was not opened".into();
                return Ok(Some(Err(self.lost(from, None, Kind::Malformed { what }))));
            }
            Some(_) => {}
            None => return Err(Bad::Ends),
        }
        let (mut raw, from) = (vec![], self.scanner.at());
        match self.scanner.value(&mut raw, self.feature_bytes) {
            Ok(()) => Ok(Some(self.decode(&raw, from))),
            Err(bad @ (Bad::Ends | Bad::TooLarge)) => match self.reread(&raw) {
                true => {
                    let what = "it has no end".into();
                    Ok(Some(Err(self.lost(from, None, Kind::Malformed { what }))))
                }
                false => Err(bad),
            },
            Err(bad) => Err(bad),
        }
    }

    /// Goes back to the next feature within what was taken for one; returns whether there is any.
    fn reread(&mut self, raw: &[u8]) -> bool {
        let Some(next) = scan::feature_in(&raw[1..]) else {
            return false;
        };
        self.broken += 1;
        self.scanner.put_back(&raw[1 + next..]);
        self.broken < ENOUGH_BROKEN
    }

    /// Reads what follows the list of features in the collection. A second such list is read too, and reported.
    fn in_rest(&mut self) -> Result<(), Bad> {
        match self.scanner.skip(b" \t\r\n,")? {
            Some(b'}') => {
                self.scanner.drop_one()?;
                self.state = State::Top;
                Ok(())
            }
            Some(b'"') => {
                let (mut key, mut value) = (vec![], vec![]);
                self.scanner.value(&mut key, self.feature_bytes)?;
                let opens = self.scanner.skip(b" \t\r\n:")?;
                if key == b"\"features\"" && opens == Some(b'[') {
                    let kind = Kind::DuplicateList;
                    self.remarks.push(self.fault(self.scanner.at(), kind));
                    self.scanner.drop_one()?;
                    self.state = State::Features;
                    return Ok(());
                }
                if opens.is_some() {
                    self.scanner.value(&mut value, self.feature_bytes)?;
                }
                if key == b"\"crs\"" {
                    self.declare(&value);
                }
                Ok(())
            }
            // A bracket too many has closed the list.
            Some(b'{') => {
                self.state = State::Features;
                Ok(())
            }
            Some(_) => Err(Bad::Unexpected),
            None => Err(Bad::Ends),
        }
    }

    /// Makes a feature of its text.
    fn decode(&mut self, raw: &[u8], from: u64) -> Result<Feature, Fault> {
        let mut flaws = vec![];
        let decoded = decode::feature(raw, &mut self.layer.columns, &mut flaws);
        let Decoded {
            id,
            fields,
            geometry,
        } = match decoded {
            Ok(decoded) => decoded,
            Err(what) => {
                if scan::feature_in(&raw[1..]).is_some() && !self.reread(raw) {
                    self.state = State::Over;
                }
                return Err(self.lost(from, None, Kind::Malformed { what }));
            }
        };
        for Flaw { field, kind } in flaws {
            let fault = self.fault(from, kind).of_feature(self.number, id.clone());
            self.remarks.push(fault.in_field(field));
        }
        let geometry = match geometry {
            Ok(geometry) => geometry,
            Err(kind) => return Err(self.lost(from, id, kind)),
        };
        let number = self.number;
        self.number += 1;
        Ok(Feature {
            number,
            id,
            geometry,
            fields,
            place: Place::Byte(from),
        })
    }
}

impl Iterator for GeoJson {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let found = match self.state {
                State::Over => return None,
                State::Top => self.at_top(),
                State::Features => self.in_features(),
                State::Rest => self.in_rest().map(|()| None),
            };
            match found {
                Ok(None) => {}
                Ok(found) => return found,
                Err(bad) => return Some(Err(self.bad(bad))),
            }
        }
    }
}

impl Reader for GeoJson {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
