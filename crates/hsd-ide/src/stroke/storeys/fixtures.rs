//! Strokes that place, change and remove what is built into rooms.

use super::element::{added, fixed, one_of, own_element, removed, rewritten};
use crate::format::Edit;
use crate::stroke::StoreyAt;
use crate::stroke::find;
use crate::stroke::refuse;
use crate::stroke::sheet::{Reason, Sheet};
use crate::stroke::xml::plain;
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::source::Spanned;
use hsd_ir::ast::{Fixture, FixtureKind, Side};
use hsd_ir::building::{House, Storey};
use hsd_passes::fit::{Hindrance, hindrance};
use serde::Deserialize;

/// What a stroke writes about a fixture; what it leaves out stays as it is.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct FixtureWords {
    /// `tokonoma`, `stairs`, ...
    #[serde(default)]
    pub kind: Option<String>,
    /// Its least corner, U.
    #[serde(default)]
    pub at: Option<[f64; 2]>,
    /// Its extent along a and b, U.
    #[serde(default)]
    pub size: Option<[f64; 2]>,
    /// The side of its front: `F`, `B`, `L` or `R`.
    #[serde(default)]
    pub faces: Option<String>,
}

/// The least and the largest extent, U.
const LEAST: f64 = 0.25;
const MOST: f64 = 60.0;

/// Adds a fixture.
pub(in crate::stroke) fn add(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    words: &FixtureWords,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    let (Some(kind), Some(_)) = (&words.kind, words.at) else {
        return Err(refuse::no_such_place());
    };
    let new = Fixture {
        span: level.span,
        kind: kind_of(kind)?,
        at: Spanned::new((0.0, 0.0), level.span),
        size: None,
        faces: Side::Front,
    };
    let wanted = meant(&new, words)?;
    stands(sheet, at, &wanted, None)?;
    added(sheet, level, "Fixture", written(&wanted).into(), usual)
}

/// Changes a fixture. One that turns without a new place keeps a corner or its middle, whichever fits first.
pub(in crate::stroke) fn change(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    number: usize,
    words: &FixtureWords,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    let (own, element) = element(sheet, level, number)?;
    let mut wanted = meant(own, words)?;
    let slack = DVec2::from(extent(own)) - DVec2::from(extent(&wanted));
    let turns = words.at.is_none() && words.faces.is_some() && slack != DVec2::ZERO;
    let corner = DVec2::from(own.at.value);
    let shares: &[[f64; 2]] = match turns {
        true => &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5]],
        false => &[[0.0, 0.0]],
    };
    let mut why = None;
    let fits = shares.iter().any(|share| {
        if turns {
            wanted.at.value = (corner + slack * DVec2::from(*share)).into();
        }
        match stands(sheet, at, &wanted, Some(own)) {
            Ok(()) => true,
            Err(reason) => {
                why.get_or_insert(reason);
                false
            }
        }
    });
    match why.filter(|_| !fits) {
        Some(reason) => Err(reason),
        None => rewritten(sheet, element, changed(own, &wanted), usual),
    }
}

/// Removes a fixture.
pub(in crate::stroke) fn remove(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    number: usize,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    Ok(removed(sheet, element(sheet, level, number)?.1))
}

/// Returns the reason why no stroke can change a fixture.
pub(crate) fn fixture_fixed(sheet: &Sheet<'_>, fixture: &Fixture) -> Option<Reason> {
    fixed(sheet, fixture.span, "Fixture")
}

fn element<'a>(
    sheet: &Sheet<'_>,
    storey: &'a Storey,
    number: usize,
) -> Result<(&'a Fixture, usize), Text> {
    let fixture = storey.fixtures.get(number);
    let fixture = fixture.ok_or_else(refuse::no_such_place)?;
    Ok((fixture, own_element(sheet, fixture.span, "Fixture")?))
}

/// Returns a fixture with what is said about it.
fn meant(own: &Fixture, words: &FixtureWords) -> Result<Fixture, Text> {
    let mut new = own.clone();
    if let Some(kind) = &words.kind {
        new.kind = kind_of(kind)?;
    }
    if let Some(at) = words.at {
        if !at.iter().all(|n| n.abs() <= 1e6) {
            return Err(refuse::too_far());
        }
        new.at.value = at.into();
    }
    if let Some(faces) = &words.faces {
        let mut all = Side::ALL.into_iter();
        let side = all.find(|(letter, _)| faces.chars().eq([*letter]));
        new.faces = side.ok_or_else(refuse::no_such_place)?.1;
        // What is written stays its width and depth.
        let turned = along_front(new.faces) != along_front(own.faces);
        if let Some(size) = new.size.as_mut().filter(|_| turned) {
            size.value = (size.value.1, size.value.0);
        }
    }
    if let Some(size) = words.size {
        if !size.iter().all(|n| (LEAST..=MOST).contains(n)) {
            return Err(refuse::odd_size(LEAST, MOST));
        }
        let usual = extent(&Fixture {
            size: None,
            ..new.clone()
        });
        let span = own.span;
        new.size = (usual != size.into()).then(|| Spanned::new(size.into(), span));
    }
    Ok(new)
}

fn kind_of(word: &str) -> Result<FixtureKind, Text> {
    let word = one_of(word, &FixtureKind::ALL.map(|(word, _)| word))?;
    let mut all = FixtureKind::ALL.iter();
    let kind = all.find(|(own, _)| *own == word);
    kind.map(|(_, kind)| *kind)
        .ok_or_else(refuse::no_such_place)
}

fn along_front(faces: Side) -> bool {
    matches!(faces, Side::Front | Side::Back)
}

/// Returns the extent of a fixture along a and b, U.
pub(crate) fn extent(fixture: &Fixture) -> (f64, f64) {
    let (width, depth) = fixture.kind.usual_size();
    let usual = match along_front(fixture.faces) {
        true => (width, depth),
        false => (depth, width),
    };
    fixture.size.as_ref().map_or(usual, |size| size.value)
}

/// Checks that a fixture fits where it is meant to stand.
fn stands(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    wanted: &Fixture,
    own: Option<&Fixture>,
) -> Result<(), Text> {
    let built = sheet.a.checked.building.houses.get(at.house);
    let built = built.ok_or_else(refuse::no_such_place)?;
    let house: &House = &built.house;
    let others = built.fixtures.iter();
    let others = others.filter(|f| own.is_none_or(|own| own.span != f.span));
    match hindrance(house, at.storey, wanted, others) {
        None => Ok(()),
        Some(Hindrance::Outside) => Err(refuse::fixture_outside()),
        Some(Hindrance::Wall) => Err(refuse::through_a_wall()),
        Some(Hindrance::Taken(other)) => Err(refuse::fixture_there(other.kind.word())),
        Some(Hindrance::NoStoreyAbove) => Err(refuse::no_storey_above()),
        Some(Hindrance::BlockedAbove) => Err(refuse::blocked_above()),
    }
}

/// Returns the attributes of a fixture as they are written.
fn written(fixture: &Fixture) -> [(&'static str, String); 4] {
    let pair = |(a, b): (f64, f64)| format!("{} {}", plain(a), plain(b));
    let faces = Side::ALL.iter().find(|(_, side)| *side == fixture.faces);
    [
        ("kind", fixture.kind.word().to_owned()),
        ("at", pair(fixture.at.value)),
        (
            "size",
            fixture
                .size
                .as_ref()
                .map_or(String::new(), |s| pair(s.value)),
        ),
        ("faces", faces.map_or(String::new(), |(l, _)| l.to_string())),
    ]
}

/// Returns the attributes that differ.
fn changed(before: &Fixture, after: &Fixture) -> Vec<(&'static str, String)> {
    let pairs = written(before).into_iter().zip(written(after));
    let other = pairs.filter(|(one, other)| one != other);
    other.map(|(_, own)| own).collect()
}

/// Returns the value that an attribute has without being written.
fn usual(word: &str) -> Option<&'static str> {
    (word == "faces").then_some("F")
}
