//! XML of maps as a stream of elements. Entities are not expanded beyond those of XML itself, so no file can blow up.

pub(super) mod citygml;
pub(super) mod moj;

use super::fault::{Fault, Kind};
use super::feature::Feature;
use super::input::Input;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::sync::Arc;

/// A piece of XML. Names have no prefix.
pub(super) enum Token {
    /// The start of an element, and of an empty one too.
    Start(Element),
    /// The end of an element.
    End,
    /// Characters.
    Text(String),
}

/// The start of an element.
#[derive(Default)]
pub(super) struct Element {
    pub(super) name: Box<str>,
    attributes: Vec<(Box<str>, Box<str>)>,
}

impl Element {
    /// Returns the value of an attribute by its name without prefix.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        let mut found = self.attributes.iter().filter(|(n, _)| **n == *name);
        found.next().map(|(_, value)| &**value)
    }
}

/// A stream of XML.
pub(super) struct Xml {
    reader: Reader<Input>,
    buffer: Vec<u8>,
    file: Arc<str>,
    /// True once nothing more can be read.
    is_over: bool,
}

/// A reader that makes features of elements.
pub(super) trait Elements {
    /// Returns the stream.
    fn xml(&mut self) -> &mut Xml;

    /// An element begins at this byte.
    fn start(&mut self, element: &Element, at: u64);

    /// Characters follow.
    fn text(&mut self, text: &str);

    /// The element ends, and perhaps a feature with it.
    fn end(&mut self) -> Option<Result<Feature, Fault>>;

    /// Returns true while an element is open.
    fn is_inside(&self) -> bool;
}

/// Reads on until a feature is complete; `None` at the end of the file.
pub(super) fn next_feature(reader: &mut impl Elements) -> Option<Result<Feature, Fault>> {
    while !reader.xml().is_over {
        let at = reader.xml().at();
        match reader.xml().next() {
            Ok(Some(Token::Start(element))) => reader.start(&element, at),
            Ok(Some(Token::Text(text))) => reader.text(&text),
            Ok(Some(Token::End)) => {
                if let Some(found) = reader.end() {
                    return Some(found);
                }
            }
            Ok(None) => {
                reader.xml().is_over = true;
                let what = "the file ends in the middle";
                let fault = Fault::of_file(&reader.xml().file, Kind::Damaged { what }).at(at);
                return reader.is_inside().then_some(Err(fault));
            }
            Err(fault) => {
                reader.xml().is_over = true;
                return Some(Err(fault));
            }
        }
    }
    None
}

impl Xml {
    /// Begins to read.
    ///
    /// # Errors
    /// If the encoding that is named is not known, or nothing can be read.
    pub(super) fn open(input: Input, file: &Arc<str>, named: Option<&str>) -> Result<Xml, Fault> {
        let (input, _) = input.into_text(file, named)?;
        let mut reader = Reader::from_reader(input);
        reader.config_mut().expand_empty_elements = true;
        Ok(Xml {
            reader,
            buffer: vec![],
            file: file.clone(),
            is_over: false,
        })
    }

    /// Returns the place of the next piece.
    pub(super) fn at(&self) -> u64 {
        self.reader.buffer_position()
    }

    /// Returns the next piece; `None` at the end.
    ///
    /// # Errors
    /// If what follows is no XML; nothing more can be read then.
    pub(super) fn next(&mut self) -> Result<Option<Token>, Fault> {
        loop {
            self.buffer.clear();
            let at = self.reader.buffer_position();
            let damaged = |what| Fault::of_file(&self.file, Kind::Damaged { what }).at(at);
            let event = match self.reader.read_event_into(&mut self.buffer) {
                Ok(event) => event,
                Err(quick_xml::Error::Io(error)) => {
                    return Err(super::input::unreadable(&self.file, &error));
                }
                Err(_) => return Err(damaged("this is no well-formed XML")),
            };
            match event {
                Event::Start(start) => match element(&start) {
                    Some(element) => return Ok(Some(Token::Start(element))),
                    None => return Err(damaged("an attribute is not well-formed")),
                },
                Event::End(_) => return Ok(Some(Token::End)),
                Event::Text(text) => return Ok(Some(Token::Text(text.to_string()))),
                Event::CData(text) => return Ok(Some(Token::Text(text.to_string()))),
                Event::GeneralRef(name) => {
                    let quoted = format!("&{};", &*name);
                    let text = quick_xml::escape::unescape(&quoted).map(|t| t.into_owned());
                    return Ok(Some(Token::Text(text.unwrap_or(quoted))));
                }
                Event::Eof => return Ok(None),
                _ => {}
            }
        }
    }
}

fn element(start: &BytesStart<'_>) -> Option<Element> {
    let mut attributes = vec![];
    for attribute in start.attributes() {
        let attribute = attribute.ok()?;
        let value = quick_xml::escape::unescape(&attribute.value).ok()?;
        let name: Box<str> = attribute.key.local_name().as_ref().into();
        attributes.push((name, value.into()));
    }
    let name = start.local_name().as_ref().into();
    Some(Element { name, attributes })
}
