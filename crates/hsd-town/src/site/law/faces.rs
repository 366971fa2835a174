//! The faces of an envelope in the frame of the town, each with what binds it.

use super::{Envelope, Rule};
use glam::DVec3;
use hsd_base::geometry::envelope::{Bound, faces};

/// What binds a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ground {
    /// The ground of the lot.
    Lot,
    /// The border of the lot, or the line back to which houses stand.
    Border,
    /// The plane of a rule.
    Rule(Rule),
    /// The line up to which a rule counts.
    End(Rule),
}

/// A face.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// What binds it.
    pub ground: Ground,
    /// Its corners, counter-clockwise seen from outside; metres east and north in the town, up from the lot.
    pub ring: Vec<DVec3>,
}

impl Ground {
    /// Returns the name of what binds the face.
    pub fn name(&self) -> String {
        match self {
            Ground::Lot => "ground".to_owned(),
            Ground::Border => "border".to_owned(),
            Ground::Rule(rule) => rule.name(),
            Ground::End(rule) => format!("end of {}", rule.name()),
        }
    }
}

impl Envelope {
    /// Returns its faces.
    pub fn faces(&self) -> Vec<Facet> {
        let found = faces(&self.cells, &self.limits).into_iter();
        let facet = |face: hsd_base::geometry::envelope::Face| Facet {
            ground: match face.bound {
                Bound::Ground => Ground::Lot,
                Bound::Side => Ground::Border,
                Bound::Limit(number) => Ground::Rule(self.rules[number]),
                Bound::End(number) => Ground::End(self.rules[number]),
            },
            ring: face
                .ring
                .into_iter()
                .map(|p| p + self.at.extend(0.0))
                .collect(),
        };
        found.map(facet).collect()
    }
}
