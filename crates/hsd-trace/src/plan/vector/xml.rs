//! Walks through the elements of an XML file with their attributes and those of the groups round them.

use super::refused::Refused;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::ops::Range;

/// The most groups within groups.
const DEEPEST: usize = 200;

/// The attributes of an element.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Attributes(Vec<(String, String)>);

impl Attributes {
    fn of(tag: &BytesStart<'_>) -> Attributes {
        let pairs = tag.attributes().flatten().map(|a| {
            let value = a
                .normalized_value(XmlVersion::Explicit1_0)
                .unwrap_or_default();
            (a.key.as_ref().to_owned(), value.into_owned())
        });
        Attributes(pairs.collect())
    }

    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.0
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, value)| value.as_str())
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// An element as it is met, with what is open round it.
pub(super) struct Element<'o> {
    open: &'o [(String, Attributes)],
    /// The bytes of its tag.
    pub(super) at: Range<usize>,
    /// The characters in it, for a `<style>`.
    pub(super) text: &'o str,
}

impl Element<'_> {
    /// Its name without a prefix.
    pub(super) fn name(&self) -> &str {
        self.open.last().map_or("", |(name, _)| name)
    }

    /// 1 for the root.
    pub(super) fn depth(&self) -> usize {
        self.open.len()
    }

    pub(super) fn attributes(&self) -> &Attributes {
        &self.open[self.open.len() - 1].1
    }

    pub(super) fn own(&self, name: &str) -> Option<&str> {
        self.attributes().get(name)
    }

    pub(super) fn number(&self, name: &str) -> Option<u32> {
        self.own(name)?.parse().ok()
    }

    /// The attribute of the nearest element round it that has it, or its own.
    pub(super) fn above(&self, name: &str) -> Option<&str> {
        self.open
            .iter()
            .rev()
            .find_map(|(_, attributes)| attributes.get(name))
    }

    pub(super) fn is_transformed(&self) -> bool {
        self.above("transform").is_some()
    }
}

/// Calls `meet` for each element in the order of the file: at its start, a `<style>` at its end.
///
/// # Errors
/// If the file is no XML, or `meet` fails.
pub(super) fn walk(
    text: &str,
    meet: &mut dyn FnMut(&Element<'_>) -> Result<(), Refused>,
) -> Result<(), Refused> {
    let mut reader = Reader::from_str(text.trim_start_matches('\u{feff}'));
    let mut open: Vec<(String, Attributes)> = vec![];
    let mut style = None::<String>;
    loop {
        let at = reader.buffer_position();
        let wrong = |what: String| Refused::NotXml { at, what };
        let event = reader.read_event().map_err(|e| wrong(e.to_string()))?;
        let place = at as usize..reader.buffer_position() as usize;
        match event {
            Event::Eof if open.is_empty() => return Ok(()),
            Event::Eof => return Err(wrong(format!("<{}> is not closed", open[open.len() - 1].0))),
            Event::Start(tag) => {
                open.push((tag.local_name().as_ref().to_owned(), Attributes::of(&tag)));
                if open.len() > DEEPEST {
                    return Err(wrong(format!("more than {DEEPEST} groups in each other")));
                }
                match open[open.len() - 1].0 == "style" {
                    true => style = Some(String::new()),
                    false => meet(&Element {
                        at: place,
                        open: &open,
                        text: "",
                    })?,
                }
            }
            Event::Empty(tag) => {
                open.push((tag.local_name().as_ref().to_owned(), Attributes::of(&tag)));
                meet(&Element {
                    at: place,
                    open: &open,
                    text: "",
                })?;
                open.pop();
            }
            Event::End(_) => {
                if let Some(text) = style.take() {
                    meet(&Element {
                        at: place,
                        open: &open,
                        text: &text,
                    })?;
                }
                open.pop();
            }
            Event::Text(text) => style.iter_mut().for_each(|s| s.push_str(&text)),
            Event::CData(text) => style.iter_mut().for_each(|s| s.push_str(&text)),
            _ => {}
        }
    }
}
