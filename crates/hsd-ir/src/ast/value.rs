//! Values of names in expressions, and the parameters of a file.

use hsd_base::source::Span;
use serde::{Serialize, Serializer};
use std::fmt;

/// The value of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A finite number.
    Number(f64),
    /// A truth value, yes or no.
    Truth(bool),
    /// Any other string, such as a code.
    Text(String),
}

impl Value {
    /// Reads a string as a value: `2.5` is a number; `yes`, `no`, `true` and `false` are truth values; everything else,
    /// including `01`, is a string.
    pub fn read(text: &str) -> Value {
        match text.trim() {
            "yes" | "true" => Value::Truth(true),
            "no" | "false" => Value::Truth(false),
            word => match number(word) {
                Some(number) => Value::Number(number),
                None => Value::Text(text.to_owned()),
            },
        }
    }

    /// Returns true if both values are of the same kind: numbers, truth values or strings.
    pub fn is_like(&self, other: &Value) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

/// Returns the number in the usual form, if it is finite.
fn number(word: &str) -> Option<f64> {
    let form = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    let digits = word.trim_start_matches(['+', '-']).as_bytes();
    let coded = digits.len() > 1 && digits[0] == b'0' && digits[1].is_ascii_digit();
    let value: f64 = (!coded && word.chars().all(form)).then(|| word.parse().ok())??;
    value.is_finite().then_some(value)
}

/// Writes the value as attributes have it: a number in its shortest form that reads as the same one, a truth value as
/// `yes` or `no`.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Number(number) => write!(f, "{}", number + 0.0), // no negative zero
            Value::Truth(true) => f.write_str("yes"),
            Value::Truth(false) => f.write_str("no"),
            Value::Text(text) => f.write_str(text),
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        match self {
            Value::Number(number) => s.serialize_f64(*number),
            Value::Truth(truth) => s.serialize_bool(*truth),
            Value::Text(text) => s.serialize_str(text),
        }
    }
}

/// A `Param` of a house or a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// The element.
    #[serde(skip)]
    pub span: Span,
    /// The name.
    pub name: String,
    /// The default value.
    pub default: Option<Value>,
    /// The value in this run.
    pub value: Option<Value>,
    /// The minimum.
    pub min: Option<f64>,
    /// The maximum.
    pub max: Option<f64>,
    /// The distance between allowed values, counted from the minimum.
    pub step: Option<f64>,
    /// The allowed values, if they are listed.
    pub choices: Vec<Value>,
    /// True if a run with a seed chooses it at random by default.
    pub random: bool,
    /// The unit of measure, for people.
    pub unit: Option<String>,
    /// The purpose.
    pub doc: Option<String>,
    /// The description in Japanese.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doc_ja: Option<String>,
}

impl Parameter {
    /// Returns true if this value is allowed.
    pub fn admits(&self, value: &Value) -> bool {
        self.admits_by(self.step, value)
    }

    /// Returns true if a `Place` may give this value: a length of a map is no whole number of steps.
    pub fn admits_in_place(&self, value: &Value) -> bool {
        let metres = self.unit.as_deref() == Some("m");
        self.admits_by(self.step.filter(|_| !metres), value)
    }

    fn admits_by(&self, step: Option<f64>, value: &Value) -> bool {
        if !self.choices.is_empty() {
            return self.choices.contains(value);
        }
        let like_default = match &self.default {
            Some(default) => default.is_like(value),
            None => true,
        };
        let Value::Number(number) = *value else {
            return like_default && self.min.is_none() && self.max.is_none();
        };
        let on_step = step.is_none_or(|step| {
            let steps = (number - self.min.unwrap_or(0.0)) / step;
            (steps - steps.round()).abs() < 1e-9
        });
        like_default
            && on_step
            && self.min.is_none_or(|least| number >= least)
            && self.max.is_none_or(|most| number <= most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_texts_have_types() {
        assert_eq!(Value::read(" 2.50 "), Value::Number(2.5));
        assert_eq!(Value::read("no"), Value::Truth(false));
        assert_eq!(Value::read("01"), Value::Text("01".into()));
        assert_eq!(Value::read("GDE 2"), Value::Text("GDE 2".into()));
        assert_eq!(Value::read("1e999"), Value::Text("1e999".into()));
    }

    #[test]
    fn numbers_are_written_so_that_they_read_the_same() {
        for number in [0.1 + 0.2, -0.0, 1e21, 1.0 / 3.0, 5e-324, f64::MAX] {
            let text = Value::Number(number).to_string();
            assert_eq!(text.parse::<f64>(), Ok(number), "{text}");
            assert!(!text.starts_with("-0") || number < 0.0);
        }
    }
}
