//! The text of an OBJ whose houses are all there.
//!
//! Texture coordinates on a page of baked images are known when the page is full, since its height is that of what it
//! holds. Until then they stand in lines of their own command, with the page and the height on a full page.

use crate::number::Number;
use crate::spool::Section;
use std::fmt::Write as _;
use std::io::{self, BufRead, BufReader, Write};

/// The command of a coordinate on a page: it is in no OBJ.
const ON_PAGE: &str = "vt~";

/// Adds the line of a coordinate on a page, 0 to 1, v upwards on a page of full height.
pub(super) fn on_page(page: u32, [u, v]: [f32; 2], out: &mut String) {
    let _ = writeln!(out, "{ON_PAGE}{page} {} {v}", Number(f64::from(u)));
}

/// An `.obj`, ready to be written.
pub struct Text {
    pub(super) head: String,
    pub(super) lines: Section,
    /// True if any coordinates are on pages.
    pub(super) on_pages: bool,
    /// The factors by which distances from the upper edge of each page have grown.
    pub(super) grown: Vec<f32>,
}

impl Text {
    /// Writes the file; returns the number of bytes.
    ///
    /// # Errors Those of the spool and of `out`.
    pub fn write(mut self, out: &mut dyn Write) -> io::Result<u64> {
        out.write_all(self.head.as_bytes())?;
        let mut length = self.head.len() as u64;
        if !self.on_pages {
            let mut out = out;
            self.lines.write(&mut out)?;
            return Ok(length + self.lines.length());
        }
        let mut lines = BufReader::new(self.lines.read()?);
        let mut line = String::new();
        while lines.read_line(&mut line)? > 0 {
            if let Some(place) = line.strip_prefix(ON_PAGE) {
                line = stretched(place.trim_end(), &self.grown).ok_or_else(broken)?;
            }
            out.write_all(line.as_bytes())?;
            length += line.len() as u64;
            line.clear();
        }
        Ok(length)
    }
}

/// Returns the line of a coordinate on a page.
fn stretched(place: &str, grown: &[f32]) -> Option<String> {
    let mut words = place.split(' ');
    let page: usize = words.next()?.parse().ok()?;
    let (u, v) = (words.next()?, words.next()?);
    let factor = grown.get(page).copied().unwrap_or(1.0);
    let v = 1.0 - (1.0 - v.parse::<f32>().ok()?) * factor;
    Some(format!("vt {u} {}\n", Number(f64::from(v))))
}

fn broken() -> io::Error {
    io::Error::other("a temporary file has changed")
}
