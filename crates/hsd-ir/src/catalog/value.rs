//! Values in the attributes of a part: lengths, positions, shares, surfaces.

use super::nearest::near;
use crate::material::SurfaceId;
use hsd_base::diagnostic::{Noun, noun};

/// The value of an attribute.
pub trait Value: Sized {
    /// Its form, for messages.
    const FORM: Noun;
    /// The allowed words, if there are few.
    const WORDS: &'static [&'static str] = &[];
    /// Parses the attribute's value.
    fn read(text: &str) -> Option<Self>;
    /// Returns the known words nearest to an unknown one.
    fn offers(text: &str) -> Vec<&'static str> {
        near(text, Self::WORDS).map_or(Self::WORDS.to_vec(), |word| vec![word])
    }
}

/// A length; millimetres in the file, metres here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mm(pub f64);

/// A position along an axis of an area: `120` mm after its start, `t120` mm before its end, `33%` of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// Metres after the start.
    Start(f64),
    /// Metres before the end.
    End(f64),
    /// A share of the whole.
    Share(f64),
}

impl Level {
    /// Returns the position between `lo` and `hi`.
    pub fn at(self, lo: f64, hi: f64) -> f64 {
        match self {
            Level::Start(m) => lo + m,
            Level::End(m) => hi - m,
            Level::Share(s) => lo + (hi - lo) * s,
        }
    }
}

/// The area in which an element is placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Area {
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

/// The direction of boards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// Level.
    Level,
    /// Upright.
    Upright,
}

/// The joints of a namako wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// Shihan: at 45 degrees.
    Diagonal,
    /// Umanori: level, half a tile offset.
    Running,
}

/// The sides of a rectangle: any of the letters l, r, t, b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sides {
    /// Left side.
    pub left: bool,
    /// Right side.
    pub right: bool,
    /// Top side.
    pub top: bool,
    /// Bottom side.
    pub bottom: bool,
}

impl Sides {
    /// All four sides.
    pub const ALL: Sides = Sides {
        left: true,
        right: true,
        top: true,
        bottom: true,
    };
}

/// The outline of a body of revolution: height and radius of each corner, from the foot up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile(pub Vec<(Level, Level)>);

impl Profile {
    /// The most corners that are built.
    const MOST: usize = 64;
}

impl Value for Profile {
    const FORM: Noun = noun(
        "2 to 64 heights with radii from the foot up, such as `0 150, 40% 90, 100% 0`",
        "下から順の高さと半径を 2 から 64 組。`0 150, 40% 90, 100% 0` など",
    );
    fn read(text: &str) -> Option<Profile> {
        let corner = |pair: &str| {
            let mut words = pair.split_whitespace();
            let corner = (Level::read(words.next()?)?, Level::read(words.next()?)?);
            words.next().is_none().then_some(corner)
        };
        let corners: Vec<_> = text.split(',').map(corner).collect::<Option<_>>()?;
        (2..=Profile::MOST)
            .contains(&corners.len())
            .then_some(Profile(corners))
    }
}

/// Parses a finite number.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|n: &f64| n.is_finite())
}

impl Value for Mm {
    const FORM: Noun = noun("millimetres", "ミリメートルの数値");
    fn read(text: &str) -> Option<Mm> {
        Some(Mm(number(text)? / 1000.0))
    }
}

impl Value for Level {
    const FORM: Noun = noun(
        "millimetres, `t` and millimetres, or per cent",
        "ミリメートル、`t` とミリメートル、または百分率",
    );
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
    const FORM: Noun = noun("a number", "数値");
    fn read(text: &str) -> Option<f64> {
        number(text)
    }
}

impl Value for u32 {
    const FORM: Noun = noun("a count up to 999", "999 までの個数");
    fn read(text: &str) -> Option<u32> {
        text.parse().ok().filter(|n| *n < 1000)
    }
}

impl Value for bool {
    const FORM: Noun = noun("yes or no", "yes か no");
    const WORDS: &'static [&'static str] = &["yes", "no"];
    fn read(text: &str) -> Option<bool> {
        match text {
            "yes" => Some(true),
            "no" => Some(false),
            _ => None,
        }
    }
}

impl Value for SurfaceId {
    const FORM: Noun = noun("the name of a surface", "表面の名前");
    fn read(text: &str) -> Option<SurfaceId> {
        SurfaceId::find(text)
    }
    fn offers(text: &str) -> Vec<&'static str> {
        let names: Vec<&str> = SurfaceId::names().collect();
        near(text, &names).into_iter().collect()
    }
}

impl<T: Value> Value for Option<T> {
    const FORM: Noun = T::FORM;
    fn read(text: &str) -> Option<Option<T>> {
        T::read(text).map(Some)
    }
    fn offers(text: &str) -> Vec<&'static str> {
        T::offers(text)
    }
}

impl Value for Area {
    const FORM: Noun = noun(
        "bay, clear, opening, above or below",
        "bay、clear、opening、above、below のどれか",
    );
    const WORDS: &'static [&'static str] = &["bay", "clear", "opening", "above", "below"];
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
    const FORM: Noun = noun("level or upright", "level か upright");
    const WORDS: &'static [&'static str] = &["level", "upright"];
    fn read(text: &str) -> Option<Run> {
        match text {
            "level" => Some(Run::Level),
            "upright" => Some(Run::Upright),
            _ => None,
        }
    }
}

impl Value for Joints {
    const FORM: Noun = noun("diagonal or running", "diagonal か running");
    const WORDS: &'static [&'static str] = &["diagonal", "running"];
    fn read(text: &str) -> Option<Joints> {
        match text {
            "diagonal" => Some(Joints::Diagonal),
            "running" => Some(Joints::Running),
            _ => None,
        }
    }
}

impl Value for Sides {
    const FORM: Noun = noun(
        "some of the letters l, r, t, b",
        "l、r、t、b のうちのいくつか",
    );
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
