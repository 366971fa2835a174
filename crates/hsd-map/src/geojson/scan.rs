//! Cuts JSON into values by its brackets and strings, without reading them.

use crate::input::Input;
use std::io::{self, BufRead};

/// The reason why a value cannot be cut out.
#[derive(Debug)]
pub(super) enum Bad {
    /// The file ends within it.
    Ends,
    /// It is longer than allowed.
    TooLarge,
    /// Something else stands there.
    Unexpected,
    /// The file cannot be read.
    Io(io::Error),
}

impl From<io::Error> for Bad {
    fn from(error: io::Error) -> Bad {
        Bad::Io(error)
    }
}

/// A stream of JSON.
pub(super) struct Scanner {
    input: Input,
    /// Bytes that are read again before those of the input.
    back: Vec<u8>,
    back_at: usize,
}

impl Scanner {
    pub(super) fn new(input: Input) -> Scanner {
        Scanner {
            input,
            back: vec![],
            back_at: 0,
        }
    }

    /// Returns the place in the stream.
    pub(super) fn at(&self) -> u64 {
        let ahead = self.back.len() - self.back_at;
        self.input.at().saturating_sub(ahead as u64)
    }

    fn fill(&mut self) -> io::Result<&[u8]> {
        match self.back_at < self.back.len() {
            true => Ok(&self.back[self.back_at..]),
            false => self.input.fill_buf(),
        }
    }

    fn consume(&mut self, count: usize) {
        match self.back_at < self.back.len() {
            true => self.back_at += count,
            false => self.input.consume(count),
        }
    }

    /// Makes bytes be read again.
    pub(super) fn put_back(&mut self, bytes: &[u8]) {
        let mut back = bytes.to_vec();
        back.extend_from_slice(&self.back[self.back_at..]);
        (self.back, self.back_at) = (back, 0);
    }

    /// Skips these bytes; returns the next one, which is not taken.
    pub(super) fn skip(&mut self, blanks: &[u8]) -> io::Result<Option<u8>> {
        loop {
            let bytes = self.fill()?;
            if bytes.is_empty() {
                return Ok(None);
            }
            let found = bytes.iter().position(|b| !blanks.contains(b));
            let next = found.map(|at| bytes[at]);
            let skipped = found.unwrap_or(bytes.len());
            self.consume(skipped);
            if next.is_some() {
                return Ok(next);
            }
        }
    }

    /// Takes one byte.
    pub(super) fn take(&mut self, out: &mut Vec<u8>) -> Result<(), Bad> {
        let byte = *self.fill()?.first().ok_or(Bad::Ends)?;
        self.consume(1);
        out.push(byte);
        Ok(())
    }

    /// Drops one byte.
    pub(super) fn drop_one(&mut self) -> Result<(), Bad> {
        self.take(&mut vec![])
    }

    /// Takes a value: up to the bracket that closes it, the quote that ends it, or what delimits it.
    pub(super) fn value(&mut self, out: &mut Vec<u8>, limit: usize) -> Result<(), Bad> {
        let mut cut = Cut::default();
        loop {
            let bytes = self.fill()?;
            if bytes.is_empty() {
                return if cut.is_scalar {
                    Ok(())
                } else {
                    Err(Bad::Ends)
                };
            }
            let (count, is_over) = cut.advance(bytes);
            out.extend_from_slice(&bytes[..count]);
            self.consume(count);
            if is_over {
                return Ok(());
            }
            if out.len() > limit {
                return Err(Bad::TooLarge);
            }
        }
    }

    /// Skips to the next feature, or to the end.
    pub(super) fn seek_feature(&mut self) -> Result<(), Bad> {
        let mut window: Vec<u8> = vec![];
        loop {
            let bytes = self.fill()?;
            if bytes.is_empty() {
                return Ok(());
            }
            let count = bytes.len();
            window.extend_from_slice(bytes);
            self.consume(count);
            if let Some(at) = feature_in(&window) {
                self.put_back(&window[at..]);
                return Ok(());
            }
            let kept = window.len().saturating_sub(LONGEST_START);
            window.drain(..kept);
        }
    }
}

/// Where a value that is being cut out stands.
#[derive(Default)]
struct Cut {
    depth: usize,
    in_string: bool,
    is_escaped: bool,
    is_scalar: bool,
}

impl Cut {
    /// Returns how many of these bytes belong to the value, and whether it ends with them.
    fn advance(&mut self, bytes: &[u8]) -> (usize, bool) {
        for (at, byte) in bytes.iter().enumerate() {
            if self.is_escaped {
                self.is_escaped = false;
                continue;
            }
            if self.in_string {
                match byte {
                    b'\\' => self.is_escaped = true,
                    b'"' => {
                        self.in_string = false;
                        if self.depth == 0 {
                            return (at + 1, true);
                        }
                    }
                    _ => {}
                }
                continue;
            }
            match byte {
                b'"' if !self.is_scalar => self.in_string = true,
                b'{' | b'[' => self.depth += 1,
                b'}' | b']' if self.depth > 1 => self.depth -= 1,
                b'}' | b']' if self.depth == 1 => return (at + 1, true),
                b'}' | b']' | b',' | b' ' | b'\n' | b'\r' | b'\t' | b':' | b'"'
                    if self.depth == 0 =>
                {
                    return (at, true);
                }
                _ if self.depth == 0 => self.is_scalar = true,
                _ => {}
            }
        }
        (bytes.len(), false)
    }
}

/// The most bytes between the brace of a feature and the end of the word `"Feature"`.
const LONGEST_START: usize = 64;

/// Returns the place of the first feature in bytes: `{"type": "Feature"`.
pub(super) fn feature_in(bytes: &[u8]) -> Option<usize> {
    const WORD: &[u8] = b"\"Feature\"";
    let mut from = 0;
    while let Some(found) = bytes[from..].windows(WORD.len()).position(|w| w == WORD) {
        let word = from + found;
        let near = &bytes[word.saturating_sub(LONGEST_START)..word];
        let before = near.trim_ascii_end();
        let before = before.strip_suffix(b":").map(<[u8]>::trim_ascii_end);
        let before = before.and_then(|b| b.strip_suffix(b"\"type\""));
        if let Some(before) = before.map(<[u8]>::trim_ascii_end)
            && before.ends_with(b"{")
        {
            return Some(word - near.len() + before.len() - 1);
        }
        from = word + WORD.len();
    }
    None
}
