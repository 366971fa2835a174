//! Faults of maps: what is wrong, in which file, feature and field. They become diagnostics in [`report`].

mod report;

pub use report::{Faults, diagnostic};

use super::crs::Outside;
use hsd_base::budget::Exhausted;
use std::sync::Arc;

/// A fault of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The file as named to [`open`](super::open).
    pub file: Arc<str>,
    /// The feature, if it concerns one.
    pub feature: Option<Which>,
    /// The field, if it concerns one.
    pub field: Option<Box<str>>,
    /// The byte in the file, if it is known.
    pub byte: Option<u64>,
    /// What is wrong.
    pub kind: Kind,
}

/// A feature in a fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Which {
    /// Its number in the layer, from 0.
    pub number: u64,
    /// Its id, if it has one.
    pub id: Option<Box<str>>,
}

impl Which {
    /// Returns its id, or its number if it has none.
    pub fn key(&self) -> Arc<str> {
        match &self.id {
            Some(id) => Arc::from(&**id),
            None => self.number.to_string().into(),
        }
    }
}

impl Fault {
    /// Creates a fault of a file as a whole.
    pub fn of_file(file: &Arc<str>, kind: Kind) -> Fault {
        Fault {
            file: file.clone(),
            feature: None,
            field: None,
            byte: None,
            kind,
        }
    }

    /// Returns true if the file expands to more than the run may take, so that it is not used at all.
    pub fn is_exhausted_file(&self) -> bool {
        self.feature.is_none() && matches!(self.kind, Kind::Exhausted(_))
    }

    /// Sets the feature.
    #[must_use]
    pub fn of_feature(mut self, number: u64, id: Option<Box<str>>) -> Fault {
        self.feature = Some(Which { number, id });
        self
    }

    /// Sets the field.
    #[must_use]
    pub fn in_field(mut self, field: impl Into<Box<str>>) -> Fault {
        self.field = Some(field.into());
        self
    }

    /// Sets the byte in the file.
    #[must_use]
    pub fn at(mut self, byte: u64) -> Fault {
        self.byte = Some(byte);
        self
    }
}

/// Why a grid is not read as heights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OtherGrid {
    /// It has several bands or colours: it is a picture.
    Colours,
    /// Its cells are bytes: it is a picture.
    Bytes,
    /// It does not say where it lies.
    NoPlace,
    /// Its rows do not run from west to east.
    Turned,
    /// Its compression, or the form of its numbers.
    Packing,
    /// Its heights are in a unit that is not known.
    Unit,
}

/// Why records of vertices make no outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VertexFault {
    /// A record names none.
    NoOutline,
    /// Records of it have no number for their order.
    NoOrder {
        /// How many.
        records: usize,
    },
    /// Two of them have the same one, and lie at different places.
    SameOrder {
        /// The number.
        at: f64,
    },
}

impl From<Exhausted> for Kind {
    fn from(exhausted: Exhausted) -> Kind {
        Kind::Exhausted(exhausted)
    }
}

/// The kinds of faults, with their values.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// The file is not there, or may not be read.
    Unreadable {
        /// What the system says.
        why: Box<str>,
    },
    /// The format is none that is read.
    UnknownFormat,
    /// The format needs a part of the program that was not built.
    NotBuilt {
        /// The feature of the crate.
        feature: &'static str,
    },
    /// The file is damaged; what follows this place is not read.
    Damaged {
        /// What was expected.
        what: &'static str,
    },
    /// The feature is not written as its format demands.
    Malformed {
        /// What is wrong.
        what: Box<str>,
    },
    /// The map has no features at all.
    NoFeatures,
    /// The feature has no geometry.
    NoGeometry,
    /// The geometry is of a kind, or a mixture of kinds, that is not read.
    OtherGeometry {
        /// The name of the kind.
        name: Box<str>,
    },
    /// The areas of the layer are divided, and the feature is none.
    NotDivided {
        /// What it is.
        shape: &'static str,
    },
    /// A line of fewer than two points, or a ring of fewer than three.
    TooFewPoints {
        /// The number of different points.
        points: usize,
    },
    /// A coordinate is no number.
    NotFinite,
    /// A coordinate lies outside what the reference system can hold.
    OutsideCrs {
        /// East.
        x: f64,
        /// North.
        y: f64,
        /// The name of the reference system.
        crs: Box<str>,
        /// What they seem to be.
        seems: Outside,
    },
    /// The feature lies far from all others.
    Outlier {
        /// The distance from the middle of the town, kilometres.
        kilometres: u64,
    },
    /// Heights that cannot be; they are taken as missing.
    NoHeights {
        /// The number of points.
        points: usize,
    },
    /// Records of vertices make no outline.
    Vertex(VertexFault),
    /// The ring is not closed; it was closed.
    Unclosed,
    /// The ring crosses or touches itself.
    Crossing,
    /// Points that stand on another one; they were removed.
    DoubledPoints {
        /// Their number.
        points: usize,
    },
    /// Parts of the geometry have too few points; the rest was kept.
    DroppedParts {
        /// Their number.
        parts: usize,
    },
    /// The reference system is not known.
    UnknownCrs {
        /// Its name in the file.
        name: Box<str>,
    },
    /// The grid is none of heights, or of a kind that is not read.
    OtherGrid {
        /// What it is.
        what: OtherGrid,
    },
    /// Two features have the same key.
    DuplicateKey,
    /// A field is written twice; the later value counts.
    DuplicateField,
    /// A collection has two lists of features; both are read.
    DuplicateList,
    /// The editor of the file has marked the feature as deleted; it is left out.
    Deleted,
    /// The reference system stands behind features and is not that of those; it is ignored.
    LateCrs {
        /// Its name in the file.
        name: Box<str>,
    },
    /// The text holds bytes that are not in the encoding of the file.
    Encoding,
    /// No encoding has the name that was given.
    UnknownEncoding {
        /// The name.
        name: Box<str>,
    },
    /// A text stands in a field of numbers.
    NotANumber {
        /// The text.
        text: Box<str>,
    },
    /// A file that belongs to this one is missing; it is read as far as that goes.
    MissingPart {
        /// Its extension with the dot.
        part: &'static str,
    },
    /// The file says another number of features than it holds.
    CountsDiffer {
        /// What is said.
        said: u64,
        /// What was found.
        found: u64,
    },
    /// The head of a grid says another number of cells than follow.
    CellsDiffer {
        /// The number in the head.
        said: u64,
        /// The number of cells that follow.
        found: u64,
    },
    /// The table has no row for the feature.
    NoRow,
    /// The file has no columns of coordinates.
    NoCoordinates,
    /// A column has a type that is read as text.
    ColumnType {
        /// The letter of the type.
        of: char,
    },
    /// Two columns have one name; the second was renamed.
    DuplicateColumn,
    /// Parts of the feature are not in the file.
    MissingMembers {
        /// Their number.
        count: usize,
    },
    /// The file has no such layer.
    NoLayer {
        /// The name.
        layer: Box<str>,
    },
    /// The file names or packs things that expand to more than the run may take.
    Exhausted(Exhausted),
    /// A limit is exceeded.
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// The limit.
        limit: u64,
    },
}
