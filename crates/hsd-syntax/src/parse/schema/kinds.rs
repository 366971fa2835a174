//! The kind of value of an attribute. The reader takes its bounds and words from here, and so do the schemas in `grammar/schema`
//! and the reference.

use super::lengths::Measure;

/// The value of an attribute, if it is not an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Any text that is not empty.
    Text,
    /// A number between two bounds.
    Number(f64, f64),
    /// A whole number between two bounds.
    Whole(u64, u64),
    /// Numbers separated by blanks or commas.
    Numbers(f64, f64),
    /// Two numbers, or one that stands for both.
    Pair(f64, f64),
    /// Two whole numbers, or one that stands for both.
    WholePair(f64, f64),
    /// Two coordinates.
    Point(f64, f64),
    /// Three coordinates.
    Spot(f64, f64),
    /// Corners of a ring: pairs of numbers.
    Points(f64, f64),
    /// `yes` or `no`; `true`, `false`, `1` and `0` are accepted for them.
    YesNo,
    /// One of several words.
    Choice(&'static [&'static str]),
    /// Several of some words, separated by blanks or commas.
    Choices(&'static [&'static str]),
    /// One of several words, or a number between two bounds.
    Either(&'static [&'static str], f64, f64),
    /// Positions from 1 such as `2,5-7`.
    Positions,
}

/// An attribute that an element may have.
#[derive(Clone, Copy, Debug)]
pub struct AttributeSchema {
    /// Its name; `code` stands for `texturecode` too.
    pub name: &'static str,
    /// The kind of its value.
    pub kind: Kind,
    /// True if the attribute is required.
    pub required: bool,
    /// The default; empty if it follows from other values.
    pub default: &'static str,
    /// The unit of a number without one, if it is a length or a list of lengths.
    pub measure: Option<Measure>,
    /// The description in English.
    pub en: &'static str,
    /// The description in Japanese.
    pub ja: &'static str,
}

/// Creates an optional attribute.
pub(super) const fn may(
    name: &'static str,
    kind: Kind,
    default: &'static str,
    en: &'static str,
    ja: &'static str,
) -> AttributeSchema {
    AttributeSchema {
        name,
        kind,
        required: false,
        default,
        measure: None,
        en,
        ja,
    }
}

impl AttributeSchema {
    /// Makes it a length in units of the house.
    pub(super) const fn units(self) -> AttributeSchema {
        self.measured(Measure::Units)
    }

    /// Makes it a length in shaku.
    pub(super) const fn shaku(self) -> AttributeSchema {
        self.measured(Measure::Shaku)
    }

    /// Makes it a length in metres.
    pub(super) const fn metres(self) -> AttributeSchema {
        self.measured(Measure::Metres)
    }

    const fn measured(self, measure: Measure) -> AttributeSchema {
        AttributeSchema {
            measure: Some(measure),
            ..self
        }
    }
}

/// Creates a required attribute.
pub(super) const fn must(
    name: &'static str,
    kind: Kind,
    en: &'static str,
    ja: &'static str,
) -> AttributeSchema {
    AttributeSchema {
        required: true,
        ..may(name, kind, "", en, ja)
    }
}

/// Returns the words of a list of words and meanings.
pub(super) const fn words<T, const N: usize>(list: &[(&'static str, T); N]) -> [&'static str; N] {
    let mut words = [""; N];
    let mut at = 0;
    while at < N {
        words[at] = list[at].0;
        at += 1;
    }
    words
}

/// Joins two lists of attributes.
pub(super) const fn join<const A: usize, const B: usize, const N: usize>(
    first: [AttributeSchema; A],
    then: [AttributeSchema; B],
) -> [AttributeSchema; N] {
    assert!(A + B == N);
    let mut all = [may("", Kind::Text, "", "", ""); N];
    let mut at = 0;
    while at < N {
        all[at] = if at < A { first[at] } else { then[at - A] };
        at += 1;
    }
    all
}
