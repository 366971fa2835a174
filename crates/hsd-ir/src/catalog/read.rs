//! Reads a part: the head from its attributes, the bodies by the tables of [`body`](super::body).

use super::body::{Element, value};
use super::value::Value;
use super::{Below, Era, PartDef, Stance};
use crate::ast::{CodeText, WrittenAttribute, WrittenBody, WrittenPart, attribute_value};
use crate::messages::catalog as say;
use crate::messages::xml as elements;
use hsd_base::diagnostic::{Diagnostics, Noun, noun};
use hsd_base::source::Spanned;

/// The maximum width of a part, U.
const WIDEST: f64 = 100.0;

/// The maximum number of pieces in one part.
const PIECES: f64 = 20_000.0;

/// The smallest size of a repeated element, millimetres; anything smaller is invisible.
const SMALLEST: f64 = 10.0;

/// The longest length in a part, millimetres.
const LONGEST: f64 = 100_000.0;

/// Reads the part of a definition; errors are reported and the rest is read. `class` is that of its base.
pub(super) fn part(entry: &WrittenPart, class: Option<char>, out: &mut Diagnostics) -> PartDef {
    let head = Head {
        given: &entry.attributes,
    };
    let code = CodeText::new(head.text("code"));
    let width = head.width(&code, out).unwrap_or_else(|| {
        let says = |name: &str| attribute_value(head.given, name).is_some();
        if !says("width") && !says("base") {
            // The default width.
            let words = ["1"];
            out.push(elements::attribute_missing(
                entry.span, "PartDef", "width", &words,
            ));
        }
        1.0
    });
    let mut part = PartDef {
        class: class.unwrap_or_else(|| first_letter(&code)),
        ja: head.name("ja", &code),
        romaji: head.text("romaji").into(),
        en: head.name("en", &code),
        aliases: head.list("aliases"),
        width,
        from: head.height("from", out),
        to: head.height("to", out),
        made: head.text("made").into(),
        era: head.or("era", Era::All, out),
        weathering: head.text("weathering").into(),
        finish: head.or("finish", None, out),
        stance: head.or("stance", Stance::Posts, out),
        below: head.or("below", Below::Dado, out),
        above: head.or("above", true, out),
        clear: head.or("clear", None, out),
        reflection: head.reflection(out),
        fills: head.or("fills", false, out),
        floor: head.or("floor", None, out),
        parapet: head.height("parapet", out),
        texture: attribute_value(head.given, "texture").cloned(),
        body: vec![],
        written: WrittenPart::default(),
        code,
    };
    if count(&entry.body) > PIECES {
        let pieces = count(&entry.body);
        let code = part.code().trim_end().to_owned();
        out.push(say::too_fine(entry.span, &code, pieces, PIECES));
    } else {
        part.body = bodies(&entry.body, out);
    }
    part.written = entry.clone();
    part
}

/// Reads the elements of a body.
fn bodies(entries: &[WrittenBody], out: &mut Diagnostics) -> Vec<Element> {
    let mut made = vec![];
    for entry in entries {
        let sound = entry.attributes.iter().fold(true, |sound, a| {
            let fits = is_sound(&entry.word.value, a);
            if !fits {
                let (Spanned { value, span }, name) = (&a.value, &a.name.value);
                out.push(say::wrong_value(*span, name, value, LENGTHS, &[]));
            }
            sound && fits
        });
        let element = Element::read(entry, out).filter(|_| sound);
        let children = bodies(&entry.children, out);
        made.extend(element.map(|element| Element {
            children,
            ..element
        }));
    }
    made
}

const LENGTHS: Noun = noun(
    "a length within 100 m; sizes are no less than nothing, and of what is repeated at least 10 mm",
    "100 m 以内の長さ (大きさは 0 以上、並べるものの大きさは 10 mm 以上)",
);

/// Returns true if a length can be built: sizes are not negative, and repeated elements are not too small.
fn is_sound(word: &str, attribute: &WrittenAttribute) -> bool {
    let (name, text) = (
        attribute.name.value.as_str(),
        attribute.value.value.as_str(),
    );
    let bare = text.trim_start_matches('t').trim_end_matches('%');
    let Ok(number) = bare.parse::<f64>() else {
        return true; // reported as no number, or a word
    };
    let repeats = matches!(
        (word, name),
        ("boards" | "slats" | "dado", "size")
            | ("panels", "width" | "height")
            | ("namako", "tile")
            | ("coping" | "wing", "rolls")
    );
    let signed = matches!(
        name,
        "front" | "groove" | "from" | "to" | "left" | "right" | "pitch" | "batter"
    ) || matches!((word, name), ("turned", "out" | "turn"));
    let least = match (repeats, signed) {
        (true, _) if name != "rolls" || number != 0.0 => SMALLEST,
        (_, true) => -LONGEST,
        _ => 0.0,
    };
    (least..=LONGEST).contains(&number)
}

/// Estimates the number of pieces that elements make, nested ones multiplied.
fn count(entries: &[WrittenBody]) -> f64 {
    const COUNTS: [&str; 14] = [
        "count",
        "children",
        "leaves",
        "stack",
        "rails",
        "bars",
        "cols",
        "rows",
        "planks",
        "tracks",
        "side",
        "siderails",
        "arms",
        "loops",
    ];
    let one = |entry: &WrittenBody| {
        let counts = entry
            .attributes
            .iter()
            .filter(|a| COUNTS.contains(&a.name.value.as_str()));
        let numbers = counts.filter_map(|a| a.value.value.parse::<f64>().ok());
        let product = numbers.fold(1.0, |all, n| all * (n + 1.0));
        product * (1.0 + count(&entry.children))
    };
    entries.iter().map(one).sum()
}

/// Returns the class that a code determines.
fn first_letter(code: &CodeText) -> char {
    let letter = code.as_str().chars().next().unwrap_or(' ');
    match code {
        CodeText::Five(_) if "KTMGHANO ".contains(letter) => letter,
        _ => 'K',
    }
}

/// The start tag of a part.
struct Head<'a> {
    given: &'a [WrittenAttribute],
}

impl<'a> Head<'a> {
    /// Returns an attribute's value, or an empty string.
    fn text(&self, name: &str) -> &'a str {
        attribute_value(self.given, name).map_or("", |text| &text.value)
    }

    /// Returns a name; by default the code of the part.
    fn name(&self, name: &str, code: &CodeText) -> Box<str> {
        match self.text(name) {
            "" => code.as_str().trim_end().into(),
            text => text.into(),
        }
    }

    /// Returns the items of a list with commas.
    fn list(&self, name: &str) -> Box<[Box<str>]> {
        let words = self.text(name).split([',', '、']).map(str::trim);
        words.filter(|w| !w.is_empty()).map(Box::from).collect()
    }

    /// Returns a value, or its default if it is missing.
    fn or<T: Value>(&self, name: &str, default: T, out: &mut Diagnostics) -> T {
        value(self.given, name, default, out)
    }

    /// Returns a number within bounds.
    fn number(&self, name: &str, form: Noun, most: f64, out: &mut Diagnostics) -> Option<f64> {
        let text = attribute_value(self.given, name)?;
        let read = shaku(&text.value).filter(|n| (0.0..=most).contains(n));
        if read.is_none() {
            out.push(say::wrong_value(text.span, name, &text.value, form, &[]));
        }
        read
    }

    /// Returns a height in shaku.
    fn height(&self, name: &str, out: &mut Diagnostics) -> Option<f64> {
        let form = noun(
            "shaku, or metres with `m`",
            "尺、または `m` を付けたメートルの数値",
        );
        self.number(name, form, 1000.0, out)
    }

    /// Returns the width, as written or as determined by the fifth column of the code. Reports if the two differ.
    fn width(&self, code: &CodeText, out: &mut Diagnostics) -> Option<f64> {
        let form = noun(
            "a width in U from 0 to 100, such as 1, 2 or 0.5",
            "1、2、0.5 のような、0 から 100 までの幅 (U)",
        );
        let column = column(code);
        let Some(width) = self.number("width", form, WIDEST, out) else {
            return column;
        };
        if let (Some(column), Some(place)) = (column, attribute_value(self.given, "code"))
            && column != width
        {
            let code = code.as_str().trim_end();
            let own = attribute_value(self.given, "width").map(|width| width.span);
            out.push(say::width_column(place.span, code, width, column, own));
        }
        Some(width)
    }

    fn reflection(&self, out: &mut Diagnostics) -> Option<f64> {
        let form = noun("a share from 0 to 1", "0 から 1 までの割合");
        self.number("reflection", form, 1.0, out)
    }
}

/// Returns the width that the fifth column of a code determines.
pub(super) fn column(code: &CodeText) -> Option<f64> {
    let CodeText::Five(five) = code else {
        return None;
    };
    match five[4] {
        b' ' => Some(1.0),
        b'h' => Some(0.5),
        digit @ b'0'..=b'9' => Some(f64::from(digit - b'0')),
        _ => None,
    }
}

/// Parses a height in shaku, or in metres with the suffix `m`.
fn shaku(text: &str) -> Option<f64> {
    match text.strip_suffix('m') {
        Some(metres) => Some(f64::read(metres)? / hsd_base::geometry::SHAKU),
        None => f64::read(text),
    }
}

impl Value for Era {
    const FORM: Noun = noun("E, M, N or all", "E、M、N、all のどれか");
    const WORDS: &'static [&'static str] = &["E", "M", "N", "all"];
    fn read(text: &str) -> Option<Era> {
        Era::ALL.into_iter().find(|era| era.word() == text)
    }
}

impl Value for Stance {
    const FORM: Noun = noun(
        "posts, bare, modern, fence or none",
        "posts、bare、modern、fence、none のどれか",
    );
    const WORDS: &'static [&'static str] = &["posts", "bare", "modern", "fence", "none"];
    fn read(text: &str) -> Option<Stance> {
        match text {
            "posts" => Some(Stance::Posts),
            "bare" => Some(Stance::Bare),
            "modern" => Some(Stance::Modern),
            "fence" => Some(Stance::Fence),
            "none" => Some(Stance::Free),
            _ => None,
        }
    }
}

impl Value for Below {
    const FORM: Noun = noun("dado, wall or open", "dado、wall、open のどれか");
    const WORDS: &'static [&'static str] = &["dado", "wall", "open"];
    fn read(text: &str) -> Option<Below> {
        match text {
            "dado" => Some(Below::Dado),
            "wall" => Some(Below::Wall),
            "open" => Some(Below::Open),
            _ => None,
        }
    }
}
