//! A `.gltf` with its buffer and its images in files of their own.

use super::Model;
use crate::OutFile;
use crate::spool::Section;
use hsd_base::source::reference;
use std::io::{self, Write};

/// A `.gltf` in several files, ready to be written.
pub struct Gltf<'a> {
    /// The buffer; none if there is nothing in it.
    pub buffer: Option<Buffer>,
    /// The images.
    pub images: Vec<OutFile<'a>>,
    /// The file that refers to the others.
    pub json: Json<'a>,
}

/// The buffer of a model.
pub struct Buffer {
    /// Its file name.
    pub name: String,
    sections: Vec<Section>,
    length: u64,
}

/// The lists of a model.
pub struct Json<'a>(Model<'a>);

impl<'a> Gltf<'a> {
    pub(super) fn of(mut model: Model<'a>, stem: &str) -> Gltf<'a> {
        let images = model.files(stem);
        let name = format!("{stem}.bin");
        model.add_buffer(Some(reference(&name)));
        let sections = std::mem::take(&mut model.sections);
        let length = model.length;
        Gltf {
            buffer: (length > 0).then_some(Buffer {
                name,
                sections,
                length,
            }),
            images,
            json: Json(model),
        }
    }

    /// Returns all files, the main one last.
    pub(super) fn into_files(self, stem: &str) -> Vec<OutFile<'a>> {
        let mut files = self.images;
        let written = |write: io::Result<u64>| write.expect("memory takes every byte");
        if let Some(buffer) = self.buffer {
            let (name, mut bytes) = (buffer.name.clone(), vec![]);
            written(buffer.write(&mut bytes));
            files.push(OutFile {
                name,
                bytes: bytes.into(),
            });
        }
        let mut bytes = vec![];
        written(self.json.write(&mut bytes));
        files.push(OutFile {
            name: format!("{stem}.gltf"),
            bytes: bytes.into(),
        });
        files
    }
}

impl Buffer {
    /// Writes the file; returns the number of bytes.
    ///
    /// # Errors Those of the spools and of `out`.
    pub fn write(mut self, mut out: &mut dyn Write) -> io::Result<u64> {
        for section in &mut self.sections {
            section.write(&mut out)?;
        }
        Ok(self.length)
    }
}

impl Json<'_> {
    /// Writes the file; returns the number of bytes.
    ///
    /// # Errors Those of the spools and of `out`.
    pub fn write(mut self, out: &mut dyn Write) -> io::Result<u64> {
        let mut out = Counted { out, length: 0 };
        self.0.json(&mut out)?;
        Ok(out.length)
    }
}

/// Counts the bytes that are written.
struct Counted<W> {
    out: W,
    length: u64,
}

impl<W: Write> Write for Counted<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.length += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
