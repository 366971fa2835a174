//! Views that the author has named: where a camera stands, where it looks, and when.

use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// A named view. Places are metres east, north and up in the world.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedView {
    /// The element.
    pub span: Span,
    /// Its name.
    pub name: Spanned<String>,
    /// The place of the camera.
    pub from: [f64; 3],
    /// The place in the middle of the picture.
    pub to: [f64; 3],
    /// Vertical angle of view, degrees.
    pub fov: f64,
    /// The date and hour of the sun; `None` is the usual afternoon.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<ViewTime>,
}

impl NamedView {
    /// The names of views that need no `View`: presets of the whole model, a courtyard and the street side of a house.
    pub const PRESETS: [&str; 14] = [
        "front",
        "eaves",
        "above",
        "back",
        "left",
        "right",
        "top",
        "elevation-front",
        "elevation-back",
        "elevation-left",
        "elevation-right",
        "plan",
        "court",
        "street",
    ];

    /// Returns true for the name of a view that every file has: one of the presets, or a numbered court or side.
    pub fn is_preset(name: &str) -> bool {
        let numbered = |kind: &str| {
            let number = name.strip_prefix(kind).and_then(|n| n.strip_prefix('-'));
            number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
        };
        Self::PRESETS.contains(&name) || numbered("court") || numbered("side")
    }
}

/// A time of day over Kyoto.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewTime {
    /// Year, month, day: `2026-12-21`.
    pub date: String,
    /// Hour as on a clock, 0 to 24.
    pub hour: f64,
}

impl ViewTime {
    /// Noon, if no hour is given.
    pub const USUAL_HOUR: f64 = 12.0;

    /// Returns a date such as `2026-12-21` as it is; `None` for another text.
    pub fn date(text: &str) -> Option<String> {
        let mut parts = text
            .split('-')
            .map(|t| match t.bytes().all(|b| b.is_ascii_digit()) {
                true => t.parse::<u32>().ok(),
                false => None,
            });
        let date = [parts.next()??, parts.next()??, parts.next()??];
        let leap = |year: u32| {
            year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
        };
        let days = |year: u32, month: u32| match month {
            4 | 6 | 9 | 11 => 30,
            2 if leap(year) => 29,
            2 => 28,
            _ => 31,
        };
        let [year, month, day] = date;
        let exists = (1..=9999).contains(&year)
            && (1..=12).contains(&month)
            && (1..=days(year, month)).contains(&day);
        (exists && parts.next().is_none()).then(|| format!("{year:04}-{month:02}-{day:02}"))
    }

    /// Returns an hour such as `9`, `9.5` or `9:30`; `None` for another text.
    pub fn hour(text: &str) -> Option<f64> {
        let hour = match text.split_once(':') {
            Some((hours, minutes)) => {
                let minutes: u8 = minutes.parse().ok().filter(|m| *m < 60)?;
                f64::from(hours.parse::<u8>().ok()?) + f64::from(minutes) / 60.0
            }
            None => text.parse().ok()?,
        };
        (0.0..=24.0).contains(&hour).then_some(hour)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_exist_and_hours_are_those_of_a_clock() {
        for (text, date) in [
            ("2026-12-21", Some("2026-12-21")),
            ("2024-2-29", Some("2024-02-29")),
            ("2026-02-29", None),
            ("2026-13-01", None),
            ("2026-12", None),
            ("2026-12-21-1", None),
            ("21.12.2026", None),
        ] {
            assert_eq!(ViewTime::date(text).as_deref(), date, "{text}");
        }
        for (text, hour) in [("9", Some(9.0)), ("9:30", Some(9.5)), ("16.5", Some(16.5))] {
            assert_eq!(ViewTime::hour(text), hour, "{text}");
        }
        for text in ["25", "-1", "9:60", "9:3.5", "noon", ""] {
            assert_eq!(ViewTime::hour(text), None, "{text}");
        }
    }
}
