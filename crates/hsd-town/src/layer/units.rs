//! Numbers with units, as maps write them: `12 m`, `7,5`, `40 ft`, `12'6"`, `3階`.

/// Metres in a foot and in an inch.
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

/// Returns the number that a text begins with, `None` for one that does not or is too large for a number. A length in feet, inches, centimetres or kilometres becomes metres. Any
/// other word after the number is ignored, such as that for storeys.
pub(crate) fn measured(text: &str) -> Option<f64> {
    let (number, unit) = number(text)?;
    let (unit, rest) = word(unit);
    let is = |names: &[&str]| names.contains(&unit.to_ascii_lowercase().as_str());
    if is(&["'", "ft", "foot", "feet", "′"]) {
        let inches = self::number(rest).filter(|(_, unit)| is_inches(word(unit).0));
        return Some(number * FOOT + inches.map_or(0.0, |(inches, _)| inches * INCH));
    }
    Some(match () {
        () if is_inches(unit) => number * INCH,
        () if is(&["cm"]) => number / 100.0,
        () if is(&["km"]) => number * 1000.0,
        () => number,
    })
}

fn is_inches(unit: &str) -> bool {
    ["\"", "″", "in", "inch", "inches"].contains(&unit.to_ascii_lowercase().as_str())
}

/// Takes a number from the start of a text.
fn number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let is_part = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let end = text.find(|c: char| !is_part(c)).unwrap_or(text.len());
    let (whole, rest) = text.split_at(end);
    // A power of ten: other texts of this kind have been read as numbers, so it is too large.
    if rest.starts_with(['e', 'E'])
        && rest[1..].starts_with(|c: char| c.is_ascii_digit() || c == '+')
    {
        return None;
    }
    let Some((decimals, rest)) = decimals(rest).filter(|_| !whole.contains('.')) else {
        return Some((whole.parse().ok()?, rest.trim_start()));
    };
    let number = format!("{whole}.{decimals}").parse().ok()?;
    Some((number, rest.trim_start()))
}

/// Takes a comma with one or two digits behind it, as decimals are written in many countries. Three are thousands.
fn decimals(text: &str) -> Option<(&str, &str)> {
    let text = text.strip_prefix(',')?;
    let is_digit = |c: char| c.is_ascii_digit();
    let end = text.find(|c: char| !is_digit(c)).unwrap_or(text.len());
    (1..=2).contains(&end).then(|| text.split_at(end))
}

/// Takes letters, or a mark, from the start of a text.
fn word(text: &str) -> (&str, &str) {
    let letters = text
        .find(|c: char| !c.is_alphabetic())
        .unwrap_or(text.len());
    let mark = text.chars().next().map_or(0, char::len_utf8);
    text.split_at(letters.max(mark).min(text.len()))
}

#[cfg(test)]
mod tests {
    use super::measured;

    #[test]
    fn lengths_become_metres() {
        for (text, metres) in [
            ("12 m", 12.0),
            ("12.5m", 12.5),
            ("40 ft", 12.192),
            ("40ft", 12.192),
            ("12'6\"", 3.81),
            ("12' 6 in", 3.81),
            ("6\"", 0.1524),
            ("250 cm", 2.5),
            ("-3", -3.0),
            ("3階", 3.0),
            ("2;3", 2.0),
            ("7,5", 7.5),
            ("12,5 m", 12.5),
            ("9,", 9.0),
        ] {
            let found = measured(text).expect(text);
            assert!((found - metres).abs() < 1e-9, "{text}: {found}");
        }
        for text in ["", "unknown", "ft 40", "--", "~8", "NaN", "1e400"] {
            assert_eq!(measured(text), None, "{text}");
        }
    }
}
