//! Maps of the registry offices of Japan (登記所備付地図, the Ministry of Justice's XML): lots out of points, curves and
//! surfaces that name each other. X is north and Y is east there.
//!
//! The spatial part comes first and is kept, as whatever follows names it; a file holds one map of an office.

use super::{Element, Elements, Xml, next_feature};
use crate::fault::{Fault, Kind};
use crate::feature::{Area, Chain, Feature, Geometry, Layer, Place, Value};
use crate::input::Input;
use crate::{Crs, Options, Reader};
use glam::{DVec2, dvec2};
use hsd_base::budget::{Account, Resource};
use std::collections::HashMap;
use std::sync::Arc;

/// The element of a lot; other things of the thematic part are read where `layer` names them.
const LOT: &str = "筆";

/// A reader of the registry's maps.
pub(crate) struct Moj {
    xml: Xml,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    space: Space,
    account: Arc<Account>,
    /// The names of the open elements.
    path: Vec<Box<str>>,
    number: u64,
    crs_is_given: bool,
    /// The thing that is being read.
    thing: Thing,
}

/// The spatial part.
#[derive(Default)]
struct Space {
    points: HashMap<Box<str>, DVec2>,
    curves: HashMap<Box<str>, Vec<DVec2>>,
    /// The curves of the rings of surfaces, the exterior first.
    surfaces: HashMap<Box<str>, Vec<Vec<Box<str>>>>,
    /// The object whose content is being read, and its coordinates so far.
    id: Box<str>,
    x: Option<f64>,
    chain: Vec<DVec2>,
    rings: Vec<Vec<Box<str>>>,
}

/// A thing of the thematic part.
#[derive(Default)]
struct Thing {
    at: u64,
    id: Option<Box<str>>,
    shape: Box<str>,
    fields: Vec<(usize, Value)>,
}

impl Moj {
    /// Begins to read, up to the first lot.
    ///
    /// # Errors
    /// If it is no XML.
    pub(crate) fn open(input: Input, file: &Arc<str>, options: &Options) -> Result<Moj, Fault> {
        let layer = Layer {
            name: options.layer.clone().unwrap_or_else(|| LOT.into()),
            crs: options.crs.clone(),
            ..Layer::default()
        };
        Ok(Moj {
            account: input.account(),
            xml: Xml::open(input, file, options.encoding.as_deref())?,
            file: file.clone(),
            layer,
            remarks: vec![],
            space: Space::default(),
            path: vec![],
            number: 0,
            crs_is_given: options.crs.is_some(),
            thing: Thing::default(),
        })
    }

    fn is_thing(&self) -> bool {
        self.path
            .last()
            .is_some_and(|name| *name == self.layer.name)
            && self.path.len() == 3
    }

    fn start(&mut self, element: &Element, at: u64) {
        self.path.push(element.name.clone());
        let reference = || element.attribute("idref").unwrap_or_default();
        match &*element.name {
            "GM_Point" | "GM_Curve" | "GM_Surface" => self.space.begin(element.attribute("id")),
            "GM_PointRef.point" => {
                let point = self.space.points.get(reference()).copied();
                self.space.chain.push(point.unwrap_or(DVec2::NAN));
            }
            "GM_SurfaceBoundary.exterior" | "GM_SurfaceBoundary.interior" => {
                self.space.rings.push(vec![]);
            }
            "GM_CompositeCurve.generator" | "GM_Ring.generator" => {
                if let Some(ring) = self.space.rings.last_mut() {
                    ring.push(reference().into());
                }
            }
            "形状" => self.thing.shape = reference().into(),
            _ if self.is_thing() => {
                let id = element.attribute("id").map(Box::from);
                self.thing = Thing {
                    at,
                    id,
                    ..Thing::default()
                };
            }
            _ => {}
        }
    }

    fn text(&mut self, text: &str) {
        let text = text.trim();
        let Some(name) = self.path.last().filter(|_| !text.is_empty()) else {
            return;
        };
        match (&**name, self.path.len()) {
            ("X", _) => self.space.x = text.parse().ok(),
            ("Y", _) => {
                let north = self.space.x.take().unwrap_or(f64::NAN);
                let east = text.parse().unwrap_or(f64::NAN);
                self.space.chain.push(dvec2(east, north));
            }
            ("座標系", 2) if !self.crs_is_given => self.layer.crs = self.system(text),
            (_, 4) if self.path[2] == self.layer.name => {
                if let Some(column) = self.layer.columns.number(name) {
                    let value = Value::Text(text.into());
                    self.layer.columns.note(column, &value);
                    self.thing.fields.push((column, value));
                }
            }
            _ => {}
        }
    }

    /// Returns the system of a name such as `公共座標9系`; `任意座標系` is a survey of its own.
    fn system(&mut self, name: &str) -> Option<Crs> {
        let digits: String = name.chars().filter(char::is_ascii_digit).collect();
        let zone: Option<u32> = digits.parse().ok().filter(|zone| (1..=19).contains(zone));
        match zone {
            Some(zone) if name.contains("公共座標") => Crs::from_epsg(6668 + zone),
            _ if name.contains("任意") => Some(Crs::local()),
            _ => {
                let kind = Kind::UnknownCrs { name: name.into() };
                self.remarks.push(Fault::of_file(&self.file, kind));
                None
            }
        }
    }

    /// Closes an element; returns the feature if it is one.
    fn end(&mut self) -> Option<Result<Feature, Fault>> {
        let is_thing = self.is_thing() && &*self.path[1] == "主題属性";
        let name = self.path.pop()?;
        self.space.end(&name);
        is_thing.then(|| self.feature())
    }

    fn feature(&mut self) -> Result<Feature, Fault> {
        let Thing {
            at,
            id,
            shape,
            mut fields,
        } = std::mem::take(&mut self.thing);
        let number = self.number;
        self.number += 1;
        fields.sort_by_key(|field| field.0);
        fields.dedup_by_key(|field| field.0);
        let geometry = self.space.geometry(&shape, &self.account).map_err(|kind| {
            let fault = Fault::of_file(&self.file, kind).at(at);
            fault.of_feature(number, id.clone())
        })?;
        Ok(Feature {
            number,
            id,
            geometry,
            fields,
            place: Place::Byte(at),
        })
    }
}

impl Space {
    fn begin(&mut self, id: Option<&str>) {
        self.id = id.unwrap_or_default().into();
        self.chain.clear();
        self.rings.clear();
    }

    fn end(&mut self, name: &str) {
        let id = || self.id.clone();
        match name {
            "GM_Point" => {
                if let Some(point) = self.chain.pop() {
                    self.points.insert(id(), point);
                }
            }
            "GM_Curve" => {
                self.curves.insert(id(), std::mem::take(&mut self.chain));
            }
            "GM_Surface" => {
                self.surfaces.insert(id(), std::mem::take(&mut self.rings));
            }
            _ => {}
        }
    }

    /// Any number of things may name one surface, and surfaces one curve.
    fn geometry(&self, shape: &str, account: &Account) -> Result<Geometry, Kind> {
        if let Some(point) = self.points.get(shape) {
            return Ok(Geometry::Points(Chain::flat(vec![*point])));
        }
        if let Some(curve) = self.curves.get(shape) {
            account.charge(Resource::Points, curve.len() as u64)?;
            return Ok(Geometry::Lines(vec![Chain::flat(curve.clone())]));
        }
        let rings = self.surfaces.get(shape).ok_or(Kind::NoGeometry)?;
        let rings: Result<Vec<Chain>, Kind> =
            rings.iter().map(|ring| self.ring(ring, account)).collect();
        let mut rings = rings?.into_iter();
        let outline = rings.next().ok_or(Kind::NoGeometry)?;
        let holes = rings.collect();
        Ok(Geometry::Areas(vec![Area { outline, holes }]))
    }

    /// Joins the curves of a ring end to end, whichever way each runs.
    fn ring(&self, curves: &[Box<str>], account: &Account) -> Result<Chain, Kind> {
        let mut chain: Vec<DVec2> = vec![];
        let known = curves.iter().filter_map(|curve| self.curves.get(curve));
        let known: Vec<&Vec<DVec2>> = known.filter(|curve| !curve.is_empty()).collect();
        if known.len() < curves.len() {
            let count = curves.len() - known.len();
            return Err(Kind::MissingMembers { count });
        }
        let points: usize = known.iter().map(|curve| curve.len()).sum();
        account.charge(Resource::Points, points as u64)?;
        for (number, curve) in known.iter().enumerate() {
            let touches = |p: Option<&DVec2>| {
                let next = known.get(number + 1).filter(|_| chain.is_empty());
                match next {
                    // The first curve runs towards the second.
                    Some(next) => next.first() == p || next.last() == p,
                    None => chain.last().is_none_or(|last| Some(last) == p),
                }
            };
            let is_forward = match chain.is_empty() {
                true => touches(curve.last()),
                false => touches(curve.first()),
            };
            let skipped = usize::from(!chain.is_empty());
            match is_forward {
                true => chain.extend(curve.iter().skip(skipped)),
                false => chain.extend(curve.iter().rev().skip(skipped)),
            }
        }
        Ok(Chain::flat(chain))
    }
}

impl Elements for Moj {
    fn xml(&mut self) -> &mut Xml {
        &mut self.xml
    }

    fn start(&mut self, element: &Element, at: u64) {
        Moj::start(self, element, at);
    }

    fn text(&mut self, text: &str) {
        Moj::text(self, text);
    }

    fn end(&mut self) -> Option<Result<Feature, Fault>> {
        Moj::end(self)
    }

    fn is_inside(&self) -> bool {
        !self.path.is_empty()
    }
}

impl Iterator for Moj {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        next_feature(self)
    }
}

impl Reader for Moj {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
