//! Units of lengths: what a number without a unit means, and the units that may be written after one.

use hsd_base::geometry::SHAKU;

/// The unit of a length that is written without one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Units of the house.
    Units,
    /// Shaku.
    Shaku,
    /// Metres.
    Metres,
}

/// The units that may be written, and their lengths: in metres, or in units of the house.
const UNITS: [(&str, f64, Measure); 14] = [
    ("m", 1.0, Measure::Metres),
    ("cm", 0.01, Measure::Metres),
    ("mm", 0.001, Measure::Metres),
    ("メートル", 1.0, Measure::Metres),
    ("shaku", 1.0, Measure::Shaku),
    ("尺", 1.0, Measure::Shaku),
    ("sun", 0.1, Measure::Shaku),
    ("寸", 0.1, Measure::Shaku),
    ("bu", 0.01, Measure::Shaku),
    ("分", 0.01, Measure::Shaku),
    ("ken", 2.0, Measure::Units),
    ("間", 2.0, Measure::Units),
    ("U", 1.0, Measure::Units),
    ("u", 1.0, Measure::Units),
];

/// The steps in one unit that a converted length keeps.
const EXACT: f64 = 1e9;

/// Returns the words that may follow a length.
pub fn units() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|(word, ..)| *word)
}

/// Reads a length with its unit, such as `5.4 m`, `9 shaku`, `3 ken`, as a number of the attribute's own unit. A ken is two
/// units of the house, of which one has this many shaku.
pub fn length(text: &str, of: Measure, unit: f64) -> Option<f64> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || matches!(c, '+' | '-' | '.')))?;
    let number: f64 = text[..end].parse().ok()?;
    let word = text[end..].trim_start();
    let (_, size, measure) = UNITS.iter().find(|(name, ..)| *name == word)?;
    let shaku = |measure| match measure {
        Measure::Units => unit,
        Measure::Shaku => 1.0,
        Measure::Metres => 1.0 / SHAKU,
    };
    let length = match *measure == of {
        true => number * size,
        false => number * size * shaku(*measure) / shaku(of),
    };
    // 2.7 m are 8.91 shaku, whatever the last digits.
    let length = (length * EXACT).round() / EXACT;
    length.is_finite().then_some(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_read_in_the_units_of_the_field() {
        let close = |text: &str, of, wanted: f64| {
            let found = length(text, of, 3.25).unwrap_or(f64::NAN);
            assert!((found - wanted).abs() < 1e-9, "{text}: {found}");
        };
        close("2.7 m", Measure::Shaku, 8.91);
        close("270cm", Measure::Shaku, 8.91);
        close("9 shaku", Measure::Metres, 9.0 / 3.3);
        close("9尺", Measure::Shaku, 9.0);
        close("3 ken", Measure::Units, 6.0);
        close("1間", Measure::Shaku, 6.5);
        close("-4 sun", Measure::Shaku, -0.4);
        close("2 U", Measure::Shaku, 6.5);
        for text in ["m", "9", "9 feet", "9 m m", "1e3 m", ""] {
            assert_eq!(length(text, Measure::Shaku, 3.0), None, "{text}");
        }
    }
}
