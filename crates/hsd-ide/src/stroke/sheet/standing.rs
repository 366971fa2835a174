//! What stands on the ground as a whole, as the file has it: groups, placed houses and houses, and the corners of surveyed
//! outlines. Strokes move them by their attributes; the plan shows them.
//!
//! Frames are those of the groups around an element. Only numbers count: what an expression computes, and what is repeated,
//! drawn or named, is changed in the text.

use crate::stroke::sheet::first_line::FirstLine;
use crate::stroke::sheet::{Reason, Sheet, name};
use hsd_base::source::FileId;
use hsd_ir::ast::Frame;
use hsd_syntax::parse::schema::lengths::{Measure, length};
use hsd_syntax::parse::syntax::Element;
use std::ops::Range;

/// A group, a placed house or a house.
#[derive(Debug)]
pub(crate) struct Standing {
    /// The text that places it.
    pub(crate) home: PlacedBy,
    /// The groups around it together.
    pub(crate) frame: Frame,
    /// Its place in that frame: metres east and north.
    pub(crate) at: [f64; 2],
    /// Its `turn` or azimuth as written, degrees.
    pub(crate) turn: f64,
    /// The houses that move with it.
    pub(crate) houses: Vec<usize>,
    /// The reason why it cannot be moved.
    pub(crate) fixed: Option<Reason>,
    /// The reason why it cannot be turned.
    pub(crate) turn_fixed: Option<Reason>,
}

/// The text that places something.
#[derive(Clone, Debug)]
pub(crate) enum PlacedBy {
    /// The attributes of an element.
    Element(usize),
    /// The first line of a house of the legacy form.
    Line(FirstLine),
}

impl Standing {
    /// Returns its kind: the name of its element.
    pub(crate) fn kind(&self, sheet: &Sheet<'_>) -> &'static str {
        match self.home {
            PlacedBy::Element(element) => name(&sheet.outline.elements[element]),
            PlacedBy::Line(_) => "House",
        }
    }
}

/// Returns the attribute that turns an element.
pub(crate) fn turned_by(element: &Element) -> &'static str {
    match name(element) {
        "Group" => "turn",
        _ => "azimuth",
    }
}

/// The outline of a house, or of one of its courtyards.
#[derive(Debug)]
pub(crate) struct SurveyedOutline {
    /// The frame of its corners.
    pub(crate) frame: Frame,
    /// Its corners as written.
    pub(crate) corners: Vec<WrittenCorner>,
    /// The reason why its corners cannot be moved.
    pub(crate) fixed: Option<Reason>,
}

/// A corner: its two numbers, metres, and their ranges in the file.
#[derive(Debug)]
pub(crate) struct WrittenCorner {
    /// East and north.
    pub(crate) at: [f64; 2],
    /// The ranges of both numbers.
    pub(crate) ranges: [Range<usize>; 2],
}

/// Returns what can stand somewhere else, in the order of the file: each element that puts at least one house, or each
/// house of the legacy form.
pub(crate) fn standing(sheet: &Sheet<'_>) -> Vec<Standing> {
    let houses: Vec<(usize, usize)> = starts(sheet);
    if sheet.outline.elements.is_empty() {
        let legacy = houses
            .into_iter()
            .filter_map(|(house, at)| on_line(sheet, house, at));
        return legacy.collect();
    }
    let elements = sheet.outline.elements.iter().enumerate();
    let whole = elements.filter(|(_, e)| matches!(name(e), "Group" | "Place" | "House"));
    whole
        .map(|(index, element)| {
            let own = houses.iter().filter(|h| element.range.contains(&h.1));
            of(sheet, index, own.map(|h| h.0).collect())
        })
        .filter(|s| !s.houses.is_empty())
        .collect()
}

/// Returns the houses with the starts of the elements that put them, of those in this file.
fn starts(sheet: &Sheet<'_>) -> Vec<(usize, usize)> {
    let houses = sheet.a.checked.building.houses.iter().enumerate();
    let spans = houses.map(|(n, b)| (n, b.house.placed.map_or(b.house.span, |by| by.span)));
    let here = spans.filter(|(_, span)| span.file == FileId(0));
    here.map(|(n, span)| (n, sheet.a.source.text_range(span).start))
        .collect()
}

/// Returns a house of the legacy form, which begins at a place in the text.
fn on_line(sheet: &Sheet<'_>, house: usize, at: usize) -> Option<Standing> {
    let line = FirstLine::of(sheet, at)?;
    let numbers = line.numbers(sheet.text);
    let fixed = numbers.is_none().then_some(Reason::Mistakes);
    let [x, y, azimuth] = numbers.unwrap_or_default();
    Some(Standing {
        home: PlacedBy::Line(line),
        frame: Frame::default(),
        at: [x, y],
        turn: azimuth,
        houses: vec![house],
        fixed,
        turn_fixed: fixed,
    })
}

fn of(sheet: &Sheet<'_>, index: usize, houses: Vec<usize>) -> Standing {
    let element = &sheet.outline.elements[index];
    let usual = if name(element) == "Group" { 0.0 } else { 180.0 };
    let (x, y) = (number(element, "x", 0.0), number(element, "y", 0.0));
    let turn = number(element, turned_by(element), usual);
    let around = frame(sheet, index);
    let written = sheet.around_fixed(index);
    let computed = |known: bool| (!known).then_some(Reason::Computed);
    let lost = written.or_else(|| computed(around.is_some()));
    let surveyed = outline_of(sheet, index).is_some() && element.attribute("azimuth").is_none();
    Standing {
        home: PlacedBy::Element(index),
        frame: around.unwrap_or_default(),
        at: [x.unwrap_or_default(), y.unwrap_or_default()],
        turn: turn.unwrap_or(usual),
        houses,
        fixed: lost.or_else(|| computed(x.is_some() && y.is_some())),
        turn_fixed: lost
            .or_else(|| surveyed.then_some(Reason::Outline))
            .or_else(|| computed(turn.is_some())),
    }
}

/// Returns the frame of the groups around an element; none where one of them is computed.
fn frame(sheet: &Sheet<'_>, element: usize) -> Option<Frame> {
    let elements = &sheet.outline.elements;
    let around: Vec<usize> = sheet.outline.around(element).skip(1).collect();
    let groups = around.iter().rev().map(|e| &elements[*e]);
    let groups = groups.filter(|e| name(e) == "Group");
    groups.into_iter().try_fold(Frame::default(), |outer, e| {
        let origin = [number(e, "x", 0.0)?, number(e, "y", 0.0)?, 0.0];
        let turn = number(e, "turn", 0.0)?;
        Some(outer.within(Frame { origin, turn }))
    })
}

/// Returns the number or the metres that an attribute states; none if they are computed or depend on the unit of a house.
fn number(element: &Element, attribute: &str, usual: f64) -> Option<f64> {
    match element.attribute(attribute) {
        None => Some(usual),
        Some(given) if !given.expressions.is_empty() => None,
        Some(given) => metres(given.value.trim()),
    }
}

fn metres(text: &str) -> Option<f64> {
    let plain = text.parse::<f64>().ok().filter(|n| n.is_finite());
    let [one, other] = [3.0, 4.0].map(|unit| length(text, Measure::Metres, unit));
    plain.or_else(|| one.filter(|_| one == other))
}

/// Returns the `Outline` of a house.
fn outline_of(sheet: &Sheet<'_>, house: usize) -> Option<usize> {
    let elements = &sheet.outline.elements;
    let mut children = sheet.children(house);
    children.find(|e| name(&elements[*e]) == "Outline")
}

/// Returns the outlines that stand as surveyed, each followed by its courtyards, in the order of the file.
pub(crate) fn outlines(sheet: &Sheet<'_>) -> Vec<SurveyedOutline> {
    let elements = &sheet.outline.elements;
    let rings = (0..elements.len()).filter(|e| matches!(name(&elements[*e]), "Outline" | "Hole"));
    rings.filter_map(|e| surveyed(sheet, e)).collect()
}

fn surveyed(sheet: &Sheet<'_>, ring: usize) -> Option<SurveyedOutline> {
    let elements = &sheet.outline.elements;
    let mut around = sheet.outline.around(ring);
    let house = around.find(|e| name(&elements[*e]) == "House")?;
    if elements[house].attribute("azimuth").is_some() {
        return None; // It faces there and does not stand as surveyed.
    }
    let origin = ["x", "y"].map(|word| number(&elements[house], word, 0.0));
    let place = frame(sheet, house).zip(origin[0].zip(origin[1]));
    let corners = corners(sheet, &elements[ring]);
    let computed = (place.is_none() || corners.is_none()).then_some(Reason::Computed);
    let (outer, (x, y)) = place?;
    Some(SurveyedOutline {
        frame: outer.within(Frame {
            origin: [x, y, 0.0],
            turn: 0.0,
        }),
        corners: corners.unwrap_or_default(),
        fixed: sheet.around_fixed(house).or(computed),
    })
}

/// Returns the corners of an outline; none if they are not pairs of plain numbers.
fn corners(sheet: &Sheet<'_>, ring: &Element) -> Option<Vec<WrittenCorner>> {
    let points = ring.attribute("points")?;
    let text = sheet.text.get(points.inner.clone())?;
    if !points.expressions.is_empty() || text.contains('&') {
        return None;
    }
    let divides = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '、');
    let words = text.split(divides).filter(|w| !w.is_empty());
    let start = |word: &str| points.inner.start + (word.as_ptr() as usize - text.as_ptr() as usize);
    let numbers: Option<Vec<(f64, Range<usize>)>> = words
        .map(|w| Some((w.parse().ok()?, start(w)..start(w) + w.len())))
        .collect();
    let numbers = numbers?;
    let (pairs, rest) = numbers.as_chunks::<2>();
    let corner = |[e, n]: &[(f64, Range<usize>); 2]| WrittenCorner {
        at: [e.0, n.0],
        ranges: [e.1.clone(), n.1.clone()],
    };
    rest.is_empty().then(|| pairs.iter().map(corner).collect())
}
