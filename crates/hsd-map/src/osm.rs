//! OpenStreetMap, as XML and as PBF: nodes, ways and multipolygons that have the tag of a theme become features.
//!
//! Ways name nodes and relations name ways, so what they name is kept until the end: 16 bytes a node and 8 a reference. It
//! is the one reader of which the memory grows with the file; towns come as extracts.

mod assemble;
mod pbf;
mod text;

use super::fault::{Fault, Kind};
use super::feature::{Feature, Layer, Place, Value};
use super::input::Input;
use super::{Crs, Options, Reader};
use glam::{DVec2, dvec2};
use hsd_base::budget::{Account, Exhausted, Resource};
use std::collections::HashMap;
use std::sync::Arc;

/// The tags by which things are picked where no theme is named.
const THEMES: [&str; 4] = ["building", "highway", "natural", "barrier"];

/// Degrees are kept as whole numbers of this many parts, as OpenStreetMap itself does.
const PARTS: f64 = 1e7;

/// A reader of OpenStreetMap data.
pub(super) struct Osm {
    data: Data,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    /// What is picked, in the order of the file.
    picked: std::vec::IntoIter<Picked>,
    number: u64,
    /// What ended the reading of the file.
    end: Option<Fault>,
}

/// A thing that has the tag of the theme.
struct Picked {
    of: Of,
    id: i64,
    tags: Tags,
    /// The number among the ways or relations.
    index: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    Node,
    Way,
    Relation,
}

type Tags = Vec<(Box<str>, Box<str>)>;

/// What was read of the file.
struct Data {
    account: Arc<Account>,
    themes: Vec<Box<str>>,
    /// Longitude and latitude of nodes in parts of a degree.
    nodes: HashMap<i64, [i32; 2]>,
    ways: HashMap<i64, Box<[i64]>>,
    /// Ways of the relations that were picked.
    members: Vec<Vec<i64>>,
    picked: Vec<Picked>,
}

impl Data {
    fn is_picked(&self, tags: &Tags) -> bool {
        let has = |theme: &str| tags.iter().any(|(k, v)| **k == *theme && **v != *"no");
        self.themes.iter().any(|theme| has(theme))
    }

    fn new(themes: Vec<Box<str>>, account: Arc<Account>) -> Data {
        Data {
            account,
            themes,
            nodes: HashMap::new(),
            ways: HashMap::new(),
            members: vec![],
            picked: vec![],
        }
    }

    fn add_node(&mut self, id: i64, lon_lat: [i32; 2], tags: Tags) -> Result<(), Exhausted> {
        self.account.charge(Resource::Points, 1)?;
        self.nodes.insert(id, lon_lat);
        self.pick(Of::Node, id, tags, 0)
    }

    fn add_way(&mut self, id: i64, nodes: Vec<i64>, tags: Tags) -> Result<(), Exhausted> {
        self.ways.insert(id, nodes.into());
        self.pick(Of::Way, id, tags, 0)
    }

    fn add_relation(&mut self, id: i64, ways: Vec<i64>, tags: Tags) -> Result<(), Exhausted> {
        let is_area = tags
            .iter()
            .any(|(k, v)| &**k == "type" && &**v == "multipolygon");
        if is_area && self.is_picked(&tags) {
            self.members.push(ways);
            self.pick(Of::Relation, id, tags, self.members.len() - 1)?;
        }
        Ok(())
    }

    fn pick(&mut self, of: Of, id: i64, tags: Tags, index: usize) -> Result<(), Exhausted> {
        if self.is_picked(&tags) {
            self.account.charge(Resource::Features, 1)?;
            self.picked.push(Picked {
                of,
                id,
                tags,
                index,
            });
        }
        Ok(())
    }

    fn place(&self, node: i64) -> Option<DVec2> {
        let [lon, lat] = self.nodes.get(&node)?;
        Some(dvec2(f64::from(*lon) / PARTS, f64::from(*lat) / PARTS))
    }
}

/// Returns degrees as parts, if they can be.
fn parts(degrees: f64) -> Option<i32> {
    (degrees.abs() <= 200.0).then(|| (degrees * PARTS).round() as i32)
}

impl Osm {
    /// Reads a file of XML or of PBF.
    ///
    /// # Errors
    /// If its head is damaged. Damage further on ends the file after what was read.
    pub(super) fn open(
        input: Input,
        file: &Arc<str>,
        options: &Options,
        is_pbf: bool,
    ) -> Result<Osm, Fault> {
        let themes = match &options.layer {
            Some(theme) => vec![theme.clone()],
            None => THEMES.iter().map(|theme| Box::from(*theme)).collect(),
        };
        let mut data = Data::new(themes, input.account());
        let mut remarks = vec![];
        let end = match is_pbf {
            true => pbf::read(input, file, &mut data),
            false => text::read(
                input,
                file,
                options.encoding.as_deref(),
                &mut data,
                &mut remarks,
            ),
        };
        let layer = Layer {
            name: options
                .layer
                .clone()
                .unwrap_or_else(|| super::stem(file).into()),
            crs: options.crs.clone().or_else(|| Some(Crs::wgs84())),
            count: Some(data.picked.len() as u64),
            ..Layer::default()
        };
        let picked = std::mem::take(&mut data.picked).into_iter();
        Ok(Osm {
            data,
            file: file.clone(),
            layer,
            remarks,
            picked,
            number: 0,
            end: end.err(),
        })
    }

    fn feature(&mut self, picked: Picked) -> Result<Feature, Fault> {
        let kind = match picked.of {
            Of::Node => "node",
            Of::Way => "way",
            Of::Relation => "relation",
        };
        let id: Box<str> = format!("{kind}/{}", picked.id).into();
        let number = self.number;
        self.number += 1;
        let fault =
            |kind: Kind| Fault::of_file(&self.file, kind).of_feature(number, Some(id.clone()));
        let mut missing = 0;
        let geometry = assemble::geometry(&self.data, &picked, &mut missing);
        if missing > 0 && geometry.is_ok() {
            self.remarks
                .push(fault(Kind::MissingMembers { count: missing }));
        }
        let geometry = geometry.map_err(fault)?;
        let mut fields = vec![];
        for (key, value) in picked.tags {
            if let Some(column) = self.layer.columns.number(&key) {
                let value = Value::Text(value);
                self.layer.columns.note(column, &value);
                fields.push((column, value));
            }
        }
        fields.sort_by_key(|field| field.0);
        fields.dedup_by_key(|field| field.0);
        Ok(Feature {
            number,
            id: Some(id.clone()),
            geometry,
            fields,
            place: Place::Record(number + 1),
        })
    }
}

impl Iterator for Osm {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        match self.picked.next() {
            Some(picked) => Some(self.feature(picked)),
            None => self.end.take().map(Err),
        }
    }
}

impl Reader for Osm {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
