//! Records of vertices (000-25): points that carry the id of a house become its outline, in their order.

use super::{Lot, Lots, Shape, shape};
use glam::DVec2;
use hsd_base::source::Spanned;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::Known;
use hsd_map::{Area, Chain, Fault, Geometry, Kind, VertexFault};
use std::collections::BTreeMap;

/// Why no outlines can be made of a layer.
#[derive(Debug)]
pub enum NoOutlines {
    /// It has features that are no points.
    NoPoints,
    /// They have no field of this name; those that they have.
    NoField(Spanned<String>, Vec<String>),
}

/// The points of an outline: their places in the order, `None` where a record has none, and their numbers in the layer.
type Vertices = Vec<(Option<f64>, usize)>;

impl Lots {
    /// Joins points to outlines if the layer says by which field: what it says of features holds for outlines from then on.
    ///
    /// # Errors
    /// If its features cannot be joined.
    pub fn outline(&mut self) -> Result<(), NoOutlines> {
        let Some(by) = self.layer.outline.clone() else {
            return Ok(());
        };
        let order = self.layer.order.clone();
        let is_point = |lot: &Lot| matches!(lot.shape, Shape::Point(_));
        if !self.lots.iter().all(is_point) {
            return Err(NoOutlines::NoPoints);
        }
        for name in std::iter::once(&by).chain(&order) {
            let first = self.lots.first();
            if first.is_some_and(|lot| self.field(lot, &name.value) == Known::Unknown) {
                return Err(NoOutlines::NoField(name.clone(), self.names()));
            }
        }
        let points = std::mem::take(&mut self.lots);
        let mut outlines: Vec<(String, Vertices)> = vec![];
        let mut known: BTreeMap<String, usize> = BTreeMap::new();
        for (number, point) in points.iter().enumerate() {
            let id = self.word(point, &by.value).unwrap_or_default();
            let id = id.trim();
            if id.is_empty() {
                let kind = Kind::Vertex(VertexFault::NoOutline);
                self.refuse(number, &point.key, kind, &by.value);
                continue;
            }
            let at = match &order {
                None => Some(number as f64),
                Some(order) => match self.field(point, &order.value) {
                    Known::Value(Value::Number(at)) => Some(at).filter(|at| at.is_finite()),
                    _ => None,
                },
            };
            let own = *known.entry(id.to_owned()).or_insert_with(|| {
                outlines.push((id.to_owned(), vec![]));
                outlines.len() - 1
            });
            outlines[own].1.push((at, number));
        }
        let order = order.map_or_else(|| by.value.clone(), |order| order.value);
        for (id, vertices) in outlines {
            let first = vertices.first().map_or(0, |(_, number)| *number);
            match self.outline_of(&id, vertices, &points) {
                Ok(lot) => self.lots.push(lot),
                Err(kind) => self.refuse(first, &id, kind, &order),
            }
        }
        Ok(())
    }

    /// Returns the outline of an id.
    fn outline_of(
        &mut self,
        id: &str,
        mut vertices: Vertices,
        points: &[Lot],
    ) -> Result<Lot, Kind> {
        let lacking = vertices.iter().filter(|(at, _)| at.is_none()).count();
        if lacking > 0 {
            return Err(Kind::Vertex(VertexFault::NoOrder { records: lacking }));
        }
        let at = |vertex: &(Option<f64>, usize)| vertex.0.unwrap_or_default();
        vertices.sort_by(|v, w| at(v).total_cmp(&at(w)));
        let place = |(_, number): &(Option<f64>, usize)| points[*number].shape.centre();
        if let Some(two) = vertices
            .windows(2)
            .find(|two| at(&two[0]) == at(&two[1]) && place(&two[0]) != place(&two[1]))
        {
            let at = at(&two[0]);
            return Err(Kind::Vertex(VertexFault::SameOrder { at }));
        }
        let mut ring: Vec<DVec2> = vertices.iter().map(place).collect();
        // Maps close their rings; records need not repeat the first one.
        if ring.first() != ring.last() {
            ring.push(ring[0]);
        }
        let outline = Chain::flat(ring);
        let area = Area {
            outline,
            holes: vec![],
        };
        let (geometry, remarks) = hsd_map::tidied(Geometry::Areas(vec![area]))?;
        for kind in remarks {
            let fault = self.fault(vertices[0].1, id, kind);
            self.faults.push(fault);
        }
        let its = || vertices.iter().map(|(_, number)| &points[*number]);
        let first = &points[vertices[0].1];
        Ok(Lot {
            number: 0,
            key: match self.layer.key {
                Some(_) => first.key.clone(),
                None => id.into(),
            },
            shape: shape(geometry),
            z: its().map(|point| point.z).sum::<f64>() / vertices.len() as f64,
            fields: fields(its()),
        })
    }

    fn fault(&self, number: usize, id: &str, kind: Kind) -> Fault {
        let fault = Fault::of_file(&self.file, kind);
        fault.of_feature(number as u64, Some(id.into()))
    }

    fn refuse(&mut self, number: usize, id: &str, kind: Kind, field: &str) {
        let is_of_field = matches!(kind, Kind::Vertex(_));
        let mut fault = self.fault(number, id, kind);
        if is_of_field {
            fault = fault.in_field(field);
        }
        self.faults.push(fault.clone());
        self.unread.push(fault);
    }
}

/// Returns the fields of an outline: those of its first record, and what only later ones have.
fn fields<'l>(records: impl Iterator<Item = &'l Lot>) -> Vec<(usize, hsd_map::Value)> {
    let mut all: BTreeMap<usize, hsd_map::Value> = BTreeMap::new();
    for (column, value) in records.flat_map(|record| &record.fields) {
        let known = all.entry(*column).or_insert(hsd_map::Value::Null);
        if *known == hsd_map::Value::Null {
            *known = value.clone();
        }
    }
    all.into_iter().collect()
}
