//! Processing instructions and the XML declaration. They do not affect a house, but a file with an invalid one is not
//! well-formed, and other programs would refuse it.

use crate::parse::xml::tree::chars::{is_blank, is_forbidden, is_name};
use crate::parse::xml::tree::scan::Scanner;
use hsd_base::diagnostic::Edit;
use hsd_base::diagnostic::messages::file;
use hsd_ir::messages::xml as say;
use std::ops::Range;

impl Scanner<'_, '_> {
    /// Reports errors in `<?...?>`.
    pub(in crate::parse::xml) fn check_instruction(&mut self, whole: Range<usize>) {
        self.check_characters(whole.clone());
        let inner = &self.text[whole.start + 2..whole.end - 2];
        let target = &inner[..inner.find(is_blank).unwrap_or(inner.len())];
        if target.eq_ignore_ascii_case("xml") {
            let rest = &inner[target.len()..];
            let sound = target == "xml" && is_declaration(rest);
            if whole.start > 0 || !sound {
                let start = self.declared(&whole, sound);
                self.reporter
                    .at(&whole, |s| say::bad_declaration(s, sound, start));
            }
        } else if !is_name(target) {
            let place = whole.start + 2..(whole.start + 2 + target.len());
            let place = if target.is_empty() { whole } else { place };
            self.reporter.at(&place, |s| say::bad_name(s, target));
        }
    }

    /// Returns the declaration to write at the start of the file, if there is none yet.
    fn declared(&self, whole: &Range<usize>, sound: bool) -> Option<Edit> {
        const PLAIN: &str = r#"<?xml version="1.0" encoding="UTF-8"?>"#;
        let declares = |text: &str| text.starts_with("<?xml") && !text.starts_with("<?xml-");
        if !sound && self.reporter.source.encoding() != "UTF-8" {
            return None;
        }
        if whole.start == 0 {
            return Some(Edit::new(self.reporter.span(whole), PLAIN));
        }
        let text = if sound {
            self.reporter.quote(whole)
        } else {
            PLAIN
        };
        let start = self.reporter.span(&(0..0));
        (!declares(self.text)).then(|| Edit::new(start, format!("{text}\n")))
    }

    /// Reports characters that XML does not allow, in markup that is not checked otherwise.
    pub(in crate::parse::xml) fn check_characters(&mut self, range: Range<usize>) {
        for (at, found) in self.text[range.clone()].match_indices(is_forbidden) {
            let here = range.start + at..range.start + at + found.len();
            let character = found.chars().next().unwrap_or_default();
            self.reporter
                .at(&here, |s| file::control_character(s, character));
        }
    }
}

/// Returns true for the content of `<?xml ...?>`: a version, then optionally an encoding and `standalone`.
fn is_declaration(text: &str) -> bool {
    let mut rest = text;
    let mut next = || {
        let inner = rest.trim_start_matches(is_blank);
        let (name, value) = inner.split_once('=')?;
        let value = value.trim_start_matches(is_blank);
        let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let (value, after) = value[1..].split_once(quote)?;
        (inner.len() < rest.len()).then_some(())?;
        rest = after;
        Some((name.trim_end_matches(is_blank), value))
    };
    if !next().is_some_and(|(name, value)| name == "version" && is_version(value)) {
        return false;
    }
    let mut item = next();
    if item.is_some_and(|(name, value)| name == "encoding" && is_encoding(value)) {
        item = next();
    }
    if item.is_some_and(|(name, value)| name == "standalone" && matches!(value, "yes" | "no")) {
        item = next();
    }
    item.is_none() && rest.chars().all(is_blank)
}

fn is_version(text: &str) -> bool {
    let minor = text.strip_prefix("1.").unwrap_or_default();
    !minor.is_empty() && minor.bytes().all(|b| b.is_ascii_digit())
}

fn is_encoding(text: &str) -> bool {
    let fits = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'_' | b'-');
    text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.bytes().all(fits)
}
