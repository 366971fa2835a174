//! Points that are joined to outlines (000-25): the fields of a point become fields of the outline that it lies in, or whose key
//! it carries. Every point that belongs to none, or gives way to another, is counted.

use super::{Lot, Lots, Shape, as_text};
use crate::shape::{area, contains, distance};
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, wider};
use hsd_ir::ast::Value;
use hsd_ir::ast::town::{Join, Known};
use std::collections::{BTreeMap, BTreeSet};

/// What came of joining points to outlines.
#[derive(Debug, Default, PartialEq)]
pub struct Joined {
    /// The outlines with several points.
    pub several: usize,
    /// The points that give way to another one of their outline, by number.
    pub left: Vec<usize>,
    /// The points that belong to no outline, by number.
    pub without: Vec<usize>,
    /// The fields in which outlines have another value than their points.
    pub differing: BTreeSet<String>,
    /// The outlines that have.
    pub outlines_differ: usize,
}

/// A point whose fields no outline takes.
#[derive(Clone, Debug)]
pub struct Unjoined {
    /// Its layer.
    pub layer: String,
    /// Its key.
    pub key: Box<str>,
    /// The code of the diagnostic that counts it.
    pub code: &'static str,
    /// The reason.
    pub reason: &'static str,
}

/// Why points cannot be joined.
#[derive(Debug, PartialEq, Eq)]
pub enum NoJoin {
    /// The layer to be joined has features that are no points, or the other has no outlines.
    NoPoints,
    /// The points have no field of the name.
    NoField(Vec<String>),
}

impl Lots {
    /// Gives the outlines of this layer the fields of points.
    ///
    /// # Errors
    /// If the layers cannot be joined.
    pub fn join(&mut self, points: &Lots, how: &Join) -> Result<Joined, NoJoin> {
        let is_point = |lot: &Lot| matches!(lot.shape, Shape::Point(_));
        let has_outlines =
            self.lots.is_empty() || self.lots.iter().any(|l| l.shape.ring().is_some());
        if !points.lots.iter().all(is_point) || !has_outlines {
            return Err(NoJoin::NoPoints);
        }
        let owners: Vec<Vec<usize>> = match &how.by {
            Some(by) => self.by_key(points, &by.value)?,
            None => self.by_place(points, how.within),
        };
        let mut joined = Joined::default();
        let mut points_of: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (point, owners) in owners.into_iter().enumerate() {
            if owners.is_empty() {
                joined.without.push(point);
            }
            for owner in owners {
                points_of.entry(owner).or_default().push(point);
            }
        }
        let mut left = BTreeSet::new();
        let columns = self.columns_of(points);
        for (outline, mut its) in points_of {
            if how.by.is_none() {
                let middle = self.lots[outline].shape.centre();
                let far = |p: &usize| points.lots[*p].shape.centre().distance(middle);
                its.sort_by(|p, q| far(p).total_cmp(&far(q)).then(p.cmp(q)));
            }
            joined.several += usize::from(its.len() > 1);
            left.extend(its.drain(1..));
            self.take(outline, (points, its[0]), &columns, &mut joined);
        }
        joined.left = left.into_iter().collect();
        Ok(joined)
    }

    /// Returns the outlines of each point: those whose key it carries.
    fn by_key(&self, points: &Lots, by: &str) -> Result<Vec<Vec<usize>>, NoJoin> {
        if !points.lots.is_empty() && !points.columns.contains_key(by) && !points.has_rule(by) {
            return Err(NoJoin::NoField(points.names()));
        }
        let mut of: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (number, lot) in self.lots.iter().enumerate() {
            of.entry(&lot.key).or_default().push(number);
        }
        let owners = |point: &Lot| {
            let key = points.word(point, by).unwrap_or_default();
            of.get(key.trim()).cloned().unwrap_or_default()
        };
        Ok(points.lots.iter().map(owners).collect())
    }

    /// Returns the outline of each point: the smallest that it lies in, else the nearest within a distance, metres.
    fn by_place(&self, points: &Lots, within: f64) -> Vec<Vec<usize>> {
        let outlines = self.lots.iter().enumerate();
        let outlines: Vec<usize> = outlines
            .filter(|(_, lot)| lot.shape.ring().is_some())
            .map(|(number, _)| number)
            .collect();
        let boxes: Vec<Bounds> = outlines
            .iter()
            .map(|n| self.lots[*n].shape.bounds())
            .collect();
        let index = Grid::new(boxes);
        let owner = |point: &Lot| {
            let p = point.shape.centre();
            let near = index.near(wider([p, p], within)).into_iter();
            let ranked = near.filter_map(|n| {
                let number = outlines[n as usize];
                Some((self.rank(number, p, within)?, number))
            });
            let best = ranked.min_by(|(a, m), (b, n)| {
                let one = a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
                one.then(m.cmp(n))
            });
            best.map(|(_, number)| number).into_iter().collect()
        };
        points.lots.iter().map(owner).collect()
    }

    /// Returns how little an outline is one for a point: the distance, then the area; `None` if it is too far.
    fn rank(&self, outline: usize, p: DVec2, within: f64) -> Option<(f64, f64)> {
        let Shape::Area(ring, holes) = &self.lots[outline].shape else {
            return None;
        };
        let is_in = contains(ring, p) && !holes.iter().any(|hole| contains(hole, p));
        let far = match is_in {
            true => 0.0,
            false => {
                let rings = std::iter::once(ring).chain(holes);
                rings
                    .map(|ring| distance(ring, p))
                    .fold(f64::INFINITY, f64::min)
            }
        };
        // A point on a wall lies in the outline.
        const ON: f64 = 1e-6;
        (is_in || far <= within.max(ON)).then(|| (far, area(ring, holes)))
    }

    fn has_rule(&self, name: &str) -> bool {
        self.layer
            .fields
            .iter()
            .any(|field| field.name.value == name)
    }

    /// Returns the columns of this layer for all fields of points, by name, adding those that it lacks.
    fn columns_of(&mut self, points: &Lots) -> Vec<(String, usize)> {
        let rules = points.layer.fields.iter();
        let renamed: BTreeSet<&str> = rules.clone().map(|field| &*field.from.value).collect();
        let own = points.columns.keys().map(|name| &**name);
        let own = own.filter(|name| !renamed.contains(name));
        let names: BTreeSet<&str> = rules.map(|f| &*f.name.value).chain(own).collect();
        let mut next = self.columns.values().max().map_or(0, |last| last + 1);
        let mut columns = vec![];
        for name in names {
            let column = *self.columns.entry(name.into()).or_insert_with(|| {
                next += 1;
                next - 1
            });
            columns.push((name.to_owned(), column));
        }
        columns
    }

    /// Gives an outline the fields of a point; those that it has stay.
    fn take(
        &mut self,
        outline: usize,
        (points, point): (&Lots, usize),
        columns: &[(String, usize)],
        joined: &mut Joined,
    ) {
        let key_of = self.layer.key.as_ref().map(|key| key.value.clone());
        let lot = &mut self.lots[outline];
        let mut differs = false;
        for (name, column) in columns {
            let Known::Value(value) = points.field(&points.lots[point], name) else {
                continue;
            };
            let value = as_field(value);
            match lot.fields.binary_search_by_key(column, |f| f.0) {
                Ok(at) => {
                    let own = as_text(&lot.fields[at].1).filter(|t| !t.trim().is_empty());
                    match own {
                        Some(own) if Some(&own) != as_text(&value).as_ref() => {
                            joined.differing.insert(name.clone());
                            differs = true;
                        }
                        Some(_) => {}
                        None => lot.fields[at].1 = value,
                    }
                }
                Err(at) => {
                    // A key of the layer that only its points have.
                    if key_of.as_ref() == Some(name)
                        && let Some(key) = as_text(&value)
                    {
                        lot.key = key.into_boxed_str();
                    }
                    lot.fields.insert(at, (*column, value));
                }
            }
        }
        joined.outlines_differ += usize::from(differs);
    }
}

/// Returns a value as a map has it.
fn as_field(value: Value) -> hsd_map::Value {
    match value {
        Value::Number(number) => hsd_map::Value::Number(number),
        Value::Truth(truth) => hsd_map::Value::Bool(truth),
        Value::Text(text) => hsd_map::Value::Text(text.into()),
    }
}
