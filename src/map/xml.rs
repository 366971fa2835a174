//! XML of maps as a stream of elements. Entities are not expanded beyond those of XML itself, so no file can blow up.

use super::fault::{Fault, Kind};
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
