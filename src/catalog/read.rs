//! Reads a catalogue: `<Catalog><PartDef ...>bodies</PartDef></Catalog>` (language.md 3).
//!
//! Messages have no spans yet: the built-in catalogue is read once, and a test finds it broken.

use super::body::{Attributes, Element};
use super::value::Value;
use super::{Below, Era, PartDef, Stance};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// The parts of a catalogue's text in its order.
pub(super) fn read(text: &str) -> Result<Vec<PartDef>, String> {
    let mut reader = Reader::from_str(text);
    let mut parts = Vec::new();
    // Open elements of the part being read, the outermost first.
    let mut open: Vec<Element> = Vec::new();
    loop {
        let event = reader.read_event().map_err(|e| e.to_string())?;
        let empty = matches!(event, Event::Empty(_));
        match event {
            Event::Start(tag) | Event::Empty(tag) => start(&tag, empty, &mut parts, &mut open)?,
            Event::End(_) => close(&mut parts, &mut open),
            Event::Text(text) if !text.trim().is_empty() => {
                return Err("text between the parts".into());
            }
            Event::Eof => return Ok(parts),
            _ => {}
        }
    }
}

/// A tag: the root, a part, or an element of the last part.
fn start(
    tag: &BytesStart<'_>,
    empty: bool,
    parts: &mut Vec<PartDef>,
    open: &mut Vec<Element>,
) -> Result<(), String> {
    let attributes = attributes(tag)?;
    let name = tag.name();
    let word: &str = name.as_ref();
    match word {
        "Catalog" => return Ok(()),
        "PartDef" => {
            parts.push(part(&attributes)?);
            return Ok(());
        }
        _ => {}
    }
    let part = parts
        .last_mut()
        .ok_or_else(|| format!("<{word}> outside a part"))?;
    let element =
        Element::read(word, &attributes).map_err(|why| format!("part {:?}: {why}", part.code()))?;
    if empty {
        match open.last_mut() {
            Some(parent) => parent.children.push(element),
            None => part.body.push(element),
        }
    } else {
        open.push(element);
    }
    Ok(())
}

/// An end tag.
fn close(parts: &mut [PartDef], open: &mut Vec<Element>) {
    let Some(element) = open.pop() else {
        return; // the end of a part or of the catalogue
    };
    match (open.last_mut(), parts.last_mut()) {
        (Some(parent), _) => parent.children.push(element),
        (None, Some(part)) => part.body.push(element),
        (None, None) => {}
    }
}

/// The attributes of a tag as owned text.
fn attributes(tag: &BytesStart<'_>) -> Result<Vec<(String, String)>, String> {
    tag.attributes()
        .map(|attribute| {
            let attribute = attribute.map_err(|e| e.to_string())?;
            let text = attribute
                .normalized_value(XmlVersion::Implicit1_0)
                .map_err(|e| e.to_string())?;
            let name: &str = attribute.key.as_ref();
            Ok((name.to_owned(), text.into_owned()))
        })
        .collect()
}

/// What a `PartDef` may say.
const KNOWN: [&str; 17] = [
    "code",
    "ja",
    "romaji",
    "en",
    "width",
    "from",
    "to",
    "made",
    "era",
    "weathering",
    "finish",
    "stance",
    "below",
    "above",
    "clear",
    "reflection",
    "fills",
];

/// The head of a part.
fn part(attributes: &Attributes) -> Result<PartDef, String> {
    let get = |name: &str| {
        let found = attributes.iter().find(|(n, _)| n == name);
        found.map(|(_, text)| text.as_str())
    };
    let must = |name: &str| get(name).ok_or_else(|| format!("a part without `{name}`"));
    let code = must("code")?;
    let wrong = |name: &str, text: &str| format!("part {code:?}: {name}=\"{text}\"");
    if let Some((name, text)) = attributes
        .iter()
        .find(|(n, _)| !KNOWN.contains(&n.as_str()))
    {
        return Err(wrong(name, text));
    }
    let five: [u8; 5] = code
        .as_bytes()
        .try_into()
        .map_err(|_| wrong("code", code))?;
    let width = must("width")?;
    let height = |name| match get(name) {
        Some(text) => shaku(text).map(Some).ok_or_else(|| wrong(name, text)),
        None => Ok(None),
    };
    Ok(PartDef {
        code: five,
        ja: must("ja")?.into(),
        romaji: must("romaji")?.into(),
        en: must("en")?.into(),
        width: f64::read(width).ok_or_else(|| wrong("width", width))?,
        from: height("from")?,
        to: height("to")?,
        made: get("made").unwrap_or_default().into(),
        era: optional(get("era"), Era::All, |t| wrong("era", t))?,
        weathering: get("weathering").unwrap_or_default().into(),
        finish: optional(get("finish"), None, |t| wrong("finish", t))?,
        stance: optional(get("stance"), Stance::Posts, |t| wrong("stance", t))?,
        below: optional(get("below"), Below::Dado, |t| wrong("below", t))?,
        above: optional(get("above"), true, |t| wrong("above", t))?,
        clear: optional(get("clear"), None, |t| wrong("clear", t))?,
        reflection: optional(get("reflection"), None, |t| wrong("reflection", t))?,
        fills: optional(get("fills"), false, |t| wrong("fills", t))?,
        body: Vec::new(),
    })
}

/// A value, or its default where nothing is written.
fn optional<T: Value>(
    text: Option<&str>,
    default: T,
    wrong: impl Fn(&str) -> String,
) -> Result<T, String> {
    match text {
        Some(text) => T::read(text).ok_or_else(|| wrong(text)),
        None => Ok(default),
    }
}

/// A height in shaku, or in metres where `m` follows.
fn shaku(text: &str) -> Option<f64> {
    match text.strip_suffix('m') {
        Some(metres) => Some(f64::read(metres)? / crate::geometry::SHAKU),
        None => f64::read(text),
    }
}

impl Value for Era {
    const FORM: &'static str = "E, M, N or all";
    fn read(text: &str) -> Option<Era> {
        Era::ALL.into_iter().find(|era| era.word() == text)
    }
}

impl Value for Stance {
    const FORM: &'static str = "posts, bare, fence or none";
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
    const FORM: &'static str = "dado, wall or open";
    fn read(text: &str) -> Option<Below> {
        match text {
            "dado" => Some(Below::Dado),
            "wall" => Some(Below::Wall),
            "open" => Some(Below::Open),
            _ => None,
        }
    }
}
