//! Tests on the fields of features: the `where` of a layer.

use super::expr::{self, Expr, Problem};
use hsd_base::diagnostic::{Noun, noun};
use hsd_ir::ast::Value;
use hsd_ir::ast::town::Known;
use std::ops::Range;

const TRUTH: Noun = noun(
    "a truth such as `levels > 2`",
    "`levels > 2` のような真偽値",
);
const VALUE: Noun = noun("an expression that has a value", "値のある式");

/// A test on the fields of features.
#[derive(Debug)]
pub struct FieldTest {
    expr: Expr,
}

/// Why a test cannot be read, or has no truth at a feature.
#[derive(Clone, Debug, PartialEq)]
pub enum NoTruth {
    /// Something else was expected at these bytes of the test.
    Wanted(Range<usize>, Noun),
    /// No feature of the layer has a field of this name.
    Unknown(Range<usize>, String),
}

impl FieldTest {
    /// Reads a test such as `building = 'house'`.
    ///
    /// # Errors
    /// If it is no expression.
    pub fn read(text: &str) -> Result<FieldTest, NoTruth> {
        let expr = expr::parse(text);
        expr.map(|expr| FieldTest { expr })
            .map_err(|fault| NoTruth::Wanted(fault.range, fault.wanted))
    }

    /// Returns true if a feature with these fields passes. One that lacks a field that is asked for does not.
    ///
    /// # Errors
    /// If the test asks for a name that no feature has, or has no truth.
    pub fn holds(&self, field: impl Fn(&str) -> Known) -> Result<bool, NoTruth> {
        let names = |name: &str| match field(name) {
            Known::Value(value) => Ok(value),
            Known::Missing => Err(Problem::Missing(name.to_owned())),
            Known::Unknown => Err(Problem::Unknown(name.to_owned())),
        };
        match expr::evaluate(&self.expr, &names) {
            Ok(Value::Truth(truth)) => Ok(truth),
            Ok(_) => Err(NoTruth::Wanted(self.expr.range.clone(), TRUTH)),
            Err(trouble) => match trouble.problem {
                Problem::Missing(_) => Ok(false),
                Problem::Unknown(name) => Err(NoTruth::Unknown(trouble.range, name)),
                Problem::Mismatch { wanted, .. } => Err(NoTruth::Wanted(trouble.range, wanted)),
                _ => Err(NoTruth::Wanted(trouble.range, VALUE)),
            },
        }
    }
}
