//! Faults become diagnostics here, once for each kind and field, with the number of cases.

use super::{Fault, Kind};
use crate::messages as say;
use hsd_base::diagnostic::{Diagnostic, Diagnostics, Origin, Severity};
use hsd_base::source::Span;
use std::collections::BTreeMap;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;

/// A kind of fault and its place in a list.
type Known = (Discriminant<Kind>, usize);

/// The file and the field of a fault.
type Place = (Arc<str>, Option<Box<str>>);

/// The faults of a map, or of the maps of a layer, counted by file, kind and field. Memory does not grow with their number.
#[derive(Clone, Debug, Default)]
pub struct Faults {
    /// The first fault of each file, kind and field, and their number, in the order of their first appearance.
    kinds: Vec<(Fault, usize)>,
    /// Kinds with their places in `kinds`, by file and field.
    by_field: BTreeMap<Place, Vec<Known>>,
    /// The number of features that are used.
    used: usize,
}

impl Faults {
    /// Sets the number of features of the map that are used. A system in which most features cannot lie is the wrong one. If only
    /// a few cannot, these features are wrong.
    pub fn set_used(&mut self, features: usize) {
        self.used = features;
    }

    /// Adds a fault.
    pub fn push(&mut self, fault: Fault) {
        let kind = discriminant(&fault.kind);
        let of = (fault.file.clone(), fault.field.clone());
        let kinds = self.by_field.entry(of).or_default();
        match kinds.iter().find(|(of, _)| *of == kind) {
            Some((_, at)) => self.kinds[*at].1 += 1,
            None => {
                kinds.push((kind, self.kinds.len()));
                self.kinds.push((fault, 1));
            }
        }
    }

    /// Adds the faults of another map.
    pub fn append(&mut self, other: Faults) {
        self.used += other.used;
        for (fault, count) in other.kinds {
            let (file, field) = (fault.file.clone(), fault.field.clone());
            let kind = discriminant(&fault.kind);
            self.push(fault);
            // The first case has been counted.
            let kinds = self.by_field.get(&(file, field)).into_iter().flatten();
            for (_, at) in kinds.filter(|(of, _)| *of == kind) {
                self.kinds[*at].1 += count - 1;
            }
        }
    }

    /// Returns the first fault of each kind and field with the number of cases.
    pub fn iter(&self) -> impl Iterator<Item = (&Fault, usize)> {
        self.kinds.iter().map(|(fault, count)| (fault, *count))
    }

    /// Reports them, at the place where a town file names the map; without one, at the first feature of each kind in the
    /// layer of this name.
    pub fn report(&self, layer: &str, named: Option<Span>, out: &mut Diagnostics) {
        for (fault, count) in self.iter() {
            let key = fault.feature.as_ref().map(|feature| feature.key());
            let at_feature = || Origin::Feature {
                layer: Arc::from(layer),
                key: key.unwrap_or_else(|| "-".into()),
            };
            let origin = named.map_or_else(at_feature, Origin::Source);
            let mut said = diagnostic(fault, count, origin);
            if matches!(fault.kind, Kind::OutsideCrs { .. }) && count < self.used {
                said.severity = Severity::Warning;
            }
            out.push(said);
        }
    }
}

/// Returns the diagnostic of a fault of which there are so many cases.
pub fn diagnostic(fault: &Fault, cases: usize, origin: Origin) -> Diagnostic {
    let key = fault.feature.as_ref().map(|feature| feature.key());
    let at = say::place(
        &origin,
        &fault.file,
        key.as_deref(),
        fault.field.as_deref(),
        fault.byte,
        cases,
    );
    match &fault.kind {
        Kind::Unreadable { why } => say::unreadable(origin, at, why),
        Kind::UnknownFormat => say::unknown_format(origin, at, &fault.file),
        Kind::NotBuilt { feature } => say::not_built(origin, at, &fault.file, feature),
        Kind::NoCoordinates => say::no_coordinates(origin, at),
        Kind::NoLayer { layer } => say::no_layer(origin, at, layer),
        Kind::Damaged { what } => say::damaged(origin, at, what),
        Kind::Malformed { what } => say::malformed(origin, at, what),
        Kind::NoFeatures => say::no_features(origin, at),
        Kind::NoGeometry => say::no_geometry(origin, at),
        Kind::OtherGeometry { name } => say::other_geometry(origin, at, name),
        Kind::NotDivided { shape } => say::not_divided(origin, at, shape),
        Kind::TooFewPoints { points } => say::too_few_points(origin, at, *points),
        Kind::NotFinite => say::not_finite(origin, at),
        Kind::OutsideCrs { x, y, crs, seems } => say::outside_crs(origin, at, *x, *y, crs, *seems),
        Kind::Outlier { kilometres } => say::outlier(origin, at, *kilometres),
        Kind::NoHeights { points } => say::no_heights(origin, at, *points),
        Kind::Vertex(why) => say::vertex(origin, at, *why),
        Kind::Unclosed => say::unclosed(origin, at),
        Kind::Crossing => say::crossing(origin, at),
        Kind::DoubledPoints { points } => say::doubled_points(origin, at, *points),
        Kind::DroppedParts { parts } => say::dropped_parts(origin, at, *parts),
        Kind::UnknownCrs { name } => say::unknown_crs(origin, at, name),
        Kind::LateCrs { name } => say::late_crs(origin, at, name),
        Kind::OtherGrid { what } => say::other_grid(origin, at, *what),
        Kind::DuplicateKey => say::duplicate_key(origin, at),
        Kind::DuplicateField => say::duplicate_field(origin, at),
        Kind::DuplicateList => say::duplicate_list(origin, at),
        Kind::Deleted => say::deleted(origin, at),
        Kind::DuplicateColumn => say::duplicate_column(origin, at),
        Kind::NotANumber { text } => say::not_a_number(origin, at, text),
        Kind::ColumnType { of } => say::column_type(origin, at, *of),
        Kind::NoRow => say::no_row(origin, at),
        Kind::Encoding => say::encoding(origin, at),
        Kind::UnknownEncoding { name } => say::unknown_encoding(origin, at, name),
        Kind::MissingPart { part } => say::missing_part(origin, at, part),
        Kind::CountsDiffer { said, found } => say::counts_differ(origin, at, *said, *found),
        Kind::CellsDiffer { said, found } => say::cells_differ(origin, at, *said, *found),
        Kind::MissingMembers { count } => say::missing_members(origin, at, *count),
        Kind::Exhausted(what) => say::exhausted(origin, at, *what),
        Kind::TooLarge { what, limit } => say::too_large(origin, at, what, *limit),
    }
}
