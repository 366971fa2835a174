//! CityGML 2.0 as PLATEAU has it: buildings as outlines with height, storeys and usage. The outline is the footprint or
//! roof edge of level 0, else the lowest faces of the block of level 1; higher levels are left alone.

use super::{Element, Elements, Xml, next_feature};
use crate::fault::{Fault, Kind};
use crate::feature::{Area, Chain, Feature, Geometry, Layer, Place, Value};
use crate::input::Input;
use crate::{Crs, Options, Reader};
use glam::{DVec2, dvec2};
use std::sync::Arc;

/// The thing that is read where no layer is named.
const BUILDING: &str = "Building";

/// Elements of geometry that are used, the best first.
const OUTLINES: [&str; 5] = [
    "lod0FootPrint",
    "lod0RoofEdge",
    "lod1Solid",
    "lod1MultiSurface",
    "lod0MultiSurface",
];

/// Faces of a block whose corners differ less in height than this lie flat, in metres.
const FLAT: f64 = 0.01;

/// A reader of CityGML.
pub(crate) struct CityGml {
    xml: Xml,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    path: Vec<Box<str>>,
    number: u64,
    crs_is_given: bool,
    /// True if the file has north before east.
    north_first: bool,
    thing: Option<Thing>,
}

/// A building whose content is being read.
struct Thing {
    at: u64,
    id: Option<Box<str>>,
    fields: Vec<(usize, Value)>,
    /// The number of open elements where it began.
    depth: usize,
    /// Its faces, with the rank of the element in [`OUTLINES`].
    faces: Vec<(usize, Area)>,
    /// The rank of the element that is open.
    rank: Option<usize>,
    /// The name of the generic attribute that is open.
    generic: Option<Box<str>>,
    text: String,
}

impl CityGml {
    /// Begins to read.
    ///
    /// # Errors
    /// If it is no XML.
    pub(crate) fn open(input: Input, file: &Arc<str>, options: &Options) -> Result<CityGml, Fault> {
        let layer = Layer {
            name: options.layer.clone().unwrap_or_else(|| BUILDING.into()),
            crs: options.crs.clone(),
            ..Layer::default()
        };
        Ok(CityGml {
            xml: Xml::open(input, file, options.encoding.as_deref())?,
            file: file.clone(),
            layer,
            remarks: vec![],
            path: vec![],
            number: 0,
            crs_is_given: options.crs.is_some(),
            north_first: false,
            thing: None,
        })
    }

    fn start(&mut self, element: &Element, at: u64) {
        if let Some(name) = element.attribute("srsName") {
            self.declare(name);
        }
        let depth = self.path.len();
        self.path.push(element.name.clone());
        match &mut self.thing {
            None if element.name == self.layer.name => {
                self.thing = Some(Thing {
                    at,
                    id: element.attribute("id").map(Box::from),
                    fields: vec![],
                    depth,
                    faces: vec![],
                    rank: None,
                    generic: None,
                    text: String::new(),
                });
            }
            None => {}
            Some(thing) => thing.start(element),
        }
    }

    fn declare(&mut self, name: &str) {
        let found = Crs::from_name(name);
        // Short names are used by programs that write east first; the others follow the authority.
        let follows = !name.trim().to_ascii_lowercase().starts_with("epsg:");
        self.north_first = follows && found.as_ref().is_some_and(Crs::authority_has_north_first);
        if self.crs_is_given || found == self.layer.crs {
            return;
        }
        if found.is_none() || self.layer.crs.is_some() {
            let kind = match found {
                None => Kind::UnknownCrs { name: name.into() },
                Some(_) => Kind::LateCrs { name: name.into() },
            };
            self.remarks.push(Fault::of_file(&self.file, kind));
            return;
        }
        self.layer.crs = found;
    }

    /// Closes an element; returns the feature if it is one.
    fn end(&mut self) -> Option<Result<Feature, Fault>> {
        let name = self.path.pop()?;
        let thing = self.thing.as_mut()?;
        if self.path.len() > thing.depth {
            let field = thing.end(&name, self.north_first);
            if let Some((name, text)) = field
                && let Some(column) = self.layer.columns.number(&name)
                && thing.fields.iter().all(|f| f.0 != column)
            {
                let value = value(&text);
                self.layer.columns.note(column, &value);
                thing.fields.push((column, value));
            }
            return None;
        }
        let Thing {
            at,
            id,
            mut fields,
            faces,
            ..
        } = self.thing.take()?;
        let number = self.number;
        self.number += 1;
        fields.sort_by_key(|field| field.0);
        let Some(areas) = outlines(faces) else {
            let fault = Fault::of_file(&self.file, Kind::NoGeometry).at(at);
            return Some(Err(fault.of_feature(number, id)));
        };
        Some(Ok(Feature {
            number,
            id,
            geometry: Geometry::Areas(areas),
            fields,
            place: Place::Byte(at),
        }))
    }
}

/// Returns the faces that are the outline: those of the best element; of a block, the lowest flat ones.
fn outlines(faces: Vec<(usize, Area)>) -> Option<Vec<Area>> {
    let best = faces.iter().map(|(rank, _)| *rank).min()?;
    let faces: Vec<Area> = faces
        .into_iter()
        .filter(|f| f.0 == best)
        .map(|f| f.1)
        .collect();
    if OUTLINES[best] != "lod1Solid" {
        return Some(faces);
    }
    let heights = |area: &Area| {
        let of = area.outline.heights.iter();
        of.fold((f64::MAX, f64::MIN), |(low, high), z| {
            (low.min(*z), high.max(*z))
        })
    };
    let flat = |area: &&Area| heights(area).1 - heights(area).0 < FLAT;
    let lowest = faces
        .iter()
        .filter(flat)
        .map(|a| heights(a).0)
        .fold(f64::MAX, f64::min);
    let lowest = |area: &Area| flat(&area) && heights(area).0 < lowest + FLAT;
    let found: Vec<Area> = faces.into_iter().filter(lowest).collect();
    (!found.is_empty()).then_some(found)
}

fn value(text: &str) -> Value {
    if let Ok(whole) = text.parse() {
        // Codes with leading zeros are texts.
        if text == "0" || !text.starts_with('0') {
            return Value::Integer(whole);
        }
    }
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && !text.starts_with("00") && text.contains('.') => {
            Value::Number(number)
        }
        _ => Value::Text(text.into()),
    }
}

impl Thing {
    fn start(&mut self, element: &Element) {
        self.text.clear();
        match &*element.name {
            "exterior" => {
                if let Some(rank) = self.rank {
                    self.faces.push((rank, Area::default()));
                }
            }
            "interior" => {
                if let Some((_, face)) = self.faces.last_mut().filter(|_| self.rank.is_some()) {
                    face.holes.push(Chain::default());
                }
            }
            name if name.ends_with("Attribute") => {
                self.generic = element.attribute("name").map(Box::from);
            }
            name => {
                let rank = OUTLINES.iter().position(|o| *o == name);
                self.rank = self.rank.or(rank);
            }
        }
    }

    /// Closes an element; returns a field and its text if it is one.
    fn end(&mut self, name: &str, north_first: bool) -> Option<(Box<str>, String)> {
        let text = std::mem::take(&mut self.text);
        if OUTLINES.contains(&name) {
            self.rank = None;
            return None;
        }
        if self.rank.is_some() {
            let (_, face) = self.faces.last_mut()?;
            let ring = face.holes.last_mut().unwrap_or(&mut face.outline);
            match name {
                "posList" => positions(&text, 3, north_first, ring),
                "pos" => positions(&text, 3, north_first, ring),
                _ => {}
            }
            return None;
        }
        if name.ends_with("Attribute") {
            self.generic = None;
        }
        let is_coordinates = matches!(name, "posList" | "pos" | "lowerCorner" | "upperCorner");
        if text.trim().is_empty() || is_coordinates {
            return None;
        }
        let name = match &self.generic {
            Some(generic) if name == "value" => generic.clone(),
            _ => name.into(),
        };
        Some((name, text.trim().to_owned()))
    }
}

/// Appends the positions of a list; one that is no number becomes NaN.
fn positions(text: &str, size: usize, north_first: bool, ring: &mut Chain) {
    let numbers: Vec<f64> = text
        .split_ascii_whitespace()
        .map(|n| n.parse().unwrap_or(f64::NAN))
        .collect();
    let size = if numbers.len().is_multiple_of(size) {
        size
    } else {
        2
    };
    for position in numbers.chunks(size) {
        let (first, second) = (position[0], position.get(1).copied().unwrap_or(f64::NAN));
        let point: DVec2 = match north_first {
            true => dvec2(second, first),
            false => dvec2(first, second),
        };
        ring.points.push(point);
        ring.heights.extend(position.get(2));
    }
}

impl Elements for CityGml {
    fn xml(&mut self) -> &mut Xml {
        &mut self.xml
    }

    fn start(&mut self, element: &Element, at: u64) {
        CityGml::start(self, element, at);
    }

    fn text(&mut self, text: &str) {
        if let Some(thing) = &mut self.thing {
            thing.text.push_str(text);
        }
    }

    fn end(&mut self) -> Option<Result<Feature, Fault>> {
        CityGml::end(self)
    }

    fn is_inside(&self) -> bool {
        !self.path.is_empty()
    }
}

impl Iterator for CityGml {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        next_feature(self)
    }
}

impl Reader for CityGml {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
