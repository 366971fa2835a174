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
const KNOWN: [&str; 19] = [
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
    "floor",
    "parapet",
];

/// The head of a part: its code and all that is written.
struct Head<'a> {
    code: &'a str,
    attributes: &'a Attributes,
}

impl<'a> Head<'a> {
    /// An attribute's text.
    fn get(&self, name: &str) -> Option<&'a str> {
        let found = self.attributes.iter().find(|(n, _)| n == name);
        found.map(|(_, text)| text.as_str())
    }

    /// Text that a part cannot do without.
    fn must(&self, name: &str) -> Result<&'a str, String> {
        let missing = || format!("part {:?} has no `{name}`", self.code);
        self.get(name).ok_or_else(missing)
    }

    /// A value, or its default where nothing is written.
    fn or<T: Value>(&self, name: &str, default: T) -> Result<T, String> {
        match self.get(name) {
            Some(text) => T::read(text).ok_or_else(|| self.wrong(name, T::FORM)),
            None => Ok(default),
        }
    }

    /// A height in shaku.
    fn height(&self, name: &str) -> Result<Option<f64>, String> {
        let wrong = || self.wrong(name, "shaku, or metres with `m`");
        let read = |text| shaku(text).ok_or_else(wrong);
        self.get(name).map(read).transpose()
    }

    /// What is wrong with an attribute.
    fn wrong(&self, name: &str, form: &str) -> String {
        let text = self.get(name).unwrap_or_default();
        format!("part {:?}: {name}=\"{text}\" is not {form}", self.code)
    }
}

/// A part without its bodies.
fn part(attributes: &Attributes) -> Result<PartDef, String> {
    let mut head = Head {
        code: "",
        attributes,
    };
    head.code = head.must("code")?;
    let known = |name: &str| KNOWN.contains(&name);
    if let Some((name, _)) = attributes.iter().find(|(n, _)| !known(n)) {
        return Err(format!("part {:?} has no attribute `{name}`", head.code));
    }
    let five = head.code.as_bytes().try_into().ok();
    let five = five.filter(|_| head.code.is_ascii());
    head.must("width")?;
    Ok(PartDef {
        code: five.ok_or_else(|| head.wrong("code", "five columns of ASCII"))?,
        ja: head.must("ja")?.into(),
        romaji: head.must("romaji")?.into(),
        en: head.must("en")?.into(),
        width: head.or("width", 0.0)?,
        from: head.height("from")?,
        to: head.height("to")?,
        made: head.get("made").unwrap_or_default().into(),
        era: head.or("era", Era::All)?,
        weathering: head.get("weathering").unwrap_or_default().into(),
        finish: head.or("finish", None)?,
        stance: head.or("stance", Stance::Posts)?,
        below: head.or("below", Below::Dado)?,
        above: head.or("above", true)?,
        clear: head.or("clear", None)?,
        reflection: head.or("reflection", None)?,
        fills: head.or("fills", false)?,
        floor: head.or("floor", None)?,
        parapet: head.height("parapet")?,
        body: Vec::new(),
    })
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
    const FORM: &'static str = "posts, bare, modern, fence or none";
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
