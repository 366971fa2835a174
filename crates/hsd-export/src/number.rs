//! Numbers in text outputs: short, and equal on every machine.

use serde::{Serialize, Serializer};
use std::fmt::{self, Display};

/// A number rounded to six decimals and written without redundant digits: `3`, `0.909091`, `-2.5`. Metres written this
/// way are exact to a micrometre. Non-finite values and those beyond 1e12 are written as 0; valid scenes have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

const MILLION: i64 = 1_000_000;

impl Number {
    /// Rounds to three decimals: a screen shows fewer shades, and no eye sees a normal turned by less.
    pub fn thousandths(x: f64) -> Number {
        Number((x * 1000.0).round() / 1000.0)
    }

    /// Returns the number in millionths, rounded half away from zero.
    pub fn millionths(self) -> i64 {
        if self.0.abs() < 1e12 {
            (self.0 * MILLION as f64).round() as i64
        } else {
            0
        }
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = self.millionths();
        let (whole, mut rest) = (all.abs() / MILLION, all.abs() % MILLION);
        let sign = if all < 0 { "-" } else { "" };
        if rest == 0 {
            return write!(f, "{sign}{whole}");
        }
        let mut digits = 6;
        while rest % 10 == 0 {
            rest /= 10;
            digits -= 1;
        }
        write!(f, "{sign}{whole}.{rest:0digits$}")
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let all = self.millionths();
        if all % MILLION == 0 {
            s.serialize_i64(all / MILLION)
        } else {
            s.serialize_f64(all as f64 / MILLION as f64)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let text = |x: f64| {
            (
                Number(x).to_string(),
                serde_json::json!(Number(x)).to_string(),
            )
        };
        for (x, expected) in [
            (3.0, "3"),
            (-0.0, "0"),
            (10.0 / 11.0, "0.909091"),
            (30.0 / 11.0, "2.727273"),
            (-2.5, "-2.5"),
            (1e-7, "0"),
            (100000.05, "100000.05"),
        ] {
            assert_eq!(text(x), (expected.to_owned(), expected.to_owned()));
        }
        assert_eq!(Number(f64::NAN).to_string(), "0");
    }
}
