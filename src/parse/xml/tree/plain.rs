//! Plain tags of the file as tokens.

use crate::parse::plain_tag::{PlainTag, TagKind};
use crate::parse::xml::tree::scan::Scanner;
use crate::parse::xml::tree::token::{EndTag, StartTag, Token};

impl<'a> Scanner<'a, '_> {
    /// Reads and skips the tag here if it is plain.
    pub(in crate::parse::xml) fn plain_tag(&mut self) -> Option<Token<'a>> {
        let tag = PlainTag::at(self.text.as_bytes(), self.at)?;
        let range = self.at..tag.end;
        let name = &self.text[tag.name.clone()];
        self.at = tag.end;
        if tag.kind == TagKind::End {
            return Some(Token::End(EndTag { name, range }));
        }
        let attributes = tag.attributes.into_iter();
        let attributes = attributes.map(|(name, value)| self.resolved(name, value.end + 1, value));
        Some(Token::Start(StartTag {
            name,
            name_range: tag.name,
            range,
            attributes: attributes.collect(),
            empty: tag.kind == TagKind::Empty,
            closed: true,
        }))
    }
}
