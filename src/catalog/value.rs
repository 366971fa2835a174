//! Values in the attributes of a part: lengths, places, shares, surfaces.

use crate::material::SurfaceId;

/// A value that an attribute holds.
pub(crate) trait Value: Sized {
    /// What it looks like, for messages.
    const FORM: &'static str;
    /// From the attribute's text.
    fn read(text: &str) -> Option<Self>;
}

/// A length; millimetres in the file, metres here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mm(pub(crate) f64);

/// A place along an axis of an area: `120` mm after its start, `t120` mm before its end, `33%` of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Level {
    /// Metres after the start.
    Start(f64),
    /// Metres before the end.
    End(f64),
    /// A share of the whole.
    Share(f64),
}

impl Level {
    /// The place between `lo` and `hi`.
    pub(crate) fn at(self, lo: f64, hi: f64) -> f64 {
        match self {
            Level::Start(m) => lo + m,
            Level::End(m) => hi - m,
            Level::Share(s) => lo + (hi - lo) * s,
        }
    }
}

/// What an element covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Area {
    /// The part's whole width and height.
    Bay,
    /// Between the posts, the whole height.
    Clear,
    /// Between the posts, `from` to `to` of the part.
    Opening,
    /// Between the posts, from the opening's top to the storey's.
    Above,
    /// Between the posts, from the floor to the opening's foot.
    Below,
}

/// Which way boards run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Run {
    /// Level.
    Level,
    /// Upright.
    Upright,
}

/// The joints of a namako wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Joints {
    /// Shihan: at 45 degrees.
    Diagonal,
    /// Umanori: level, half a tile offset.
    Running,
}

/// Which sides of a rectangle: any of the letters l, r, t, b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sides {
    pub(crate) left: bool,
    pub(crate) right: bool,
    pub(crate) top: bool,
    pub(crate) bottom: bool,
}

impl Sides {
    pub(crate) const ALL: Sides = Sides {
        left: true,
        right: true,
        top: true,
        bottom: true,
    };
}

/// A finite number.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|n: &f64| n.is_finite())
}

impl Value for Mm {
    const FORM: &'static str = "millimetres";
    fn read(text: &str) -> Option<Mm> {
        Some(Mm(number(text)? / 1000.0))
    }
}

impl Value for Level {
    const FORM: &'static str = "millimetres, `t` and millimetres, or per cent";
    fn read(text: &str) -> Option<Level> {
        if let Some(share) = text.strip_suffix('%') {
            return Some(Level::Share(number(share)? / 100.0));
        }
        match text.strip_prefix('t') {
            Some(end) => Some(Level::End(number(end)? / 1000.0)),
            None => Some(Level::Start(number(text)? / 1000.0)),
        }
    }
}

impl Value for f64 {
    const FORM: &'static str = "a number";
    fn read(text: &str) -> Option<f64> {
        number(text)
    }
}

impl Value for u32 {
    const FORM: &'static str = "a count up to 999";
    fn read(text: &str) -> Option<u32> {
        text.parse().ok().filter(|n| *n < 1000)
    }
}

impl Value for bool {
    const FORM: &'static str = "yes or no";
    fn read(text: &str) -> Option<bool> {
        match text {
            "yes" => Some(true),
            "no" => Some(false),
            _ => None,
        }
    }
}

impl Value for SurfaceId {
    const FORM: &'static str = "the name of a surface";
    fn read(text: &str) -> Option<SurfaceId> {
        SurfaceId::find(text)
    }
}

impl<T: Value> Value for Option<T> {
    const FORM: &'static str = T::FORM;
    fn read(text: &str) -> Option<Option<T>> {
        T::read(text).map(Some)
    }
}

impl Value for Area {
    const FORM: &'static str = "bay, clear, opening, above or below";
    fn read(text: &str) -> Option<Area> {
        match text {
            "bay" => Some(Area::Bay),
            "clear" => Some(Area::Clear),
            "opening" => Some(Area::Opening),
            "above" => Some(Area::Above),
            "below" => Some(Area::Below),
            _ => None,
        }
    }
}

impl Value for Run {
    const FORM: &'static str = "level or upright";
    fn read(text: &str) -> Option<Run> {
        match text {
            "level" => Some(Run::Level),
            "upright" => Some(Run::Upright),
            _ => None,
        }
    }
}

impl Value for Joints {
    const FORM: &'static str = "diagonal or running";
    fn read(text: &str) -> Option<Joints> {
        match text {
            "diagonal" => Some(Joints::Diagonal),
            "running" => Some(Joints::Running),
            _ => None,
        }
    }
}

impl Value for Sides {
    const FORM: &'static str = "some of the letters l, r, t, b";
    fn read(text: &str) -> Option<Sides> {
        let known = !text.is_empty() && text.chars().all(|c| "lrtb".contains(c));
        known.then(|| Sides {
            left: text.contains('l'),
            right: text.contains('r'),
            top: text.contains('t'),
            bottom: text.contains('b'),
        })
    }
}
