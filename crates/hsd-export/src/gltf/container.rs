//! The container `.glb`: a header, the JSON, the buffer. Content is streamed to the output and the lengths in the
//! headers are filled in at the end, so that no second copy of the model is in memory.

use super::Model;
use crate::{Images, OutFile};
use hsd_scene::Scene;
use std::io::{self, BufWriter, Cursor, Seek, SeekFrom, Write};

/// Length of the file header and of the JSON chunk header, bytes.
const HEADERS: u64 = 12 + 8;

/// A `.glb`, ready to be written.
pub struct Glb<'a>(Model<'a>);

impl<'a> Glb<'a> {
    /// Creates one with embedded images.
    pub fn inside(scene: &'a Scene, images: &'a dyn Images) -> Glb<'a> {
        Glb::inside_of(Model::of(scene, images))
    }

    pub(super) fn inside_of(mut model: Model<'a>) -> Glb<'a> {
        model.embed();
        model.add_buffer(None);
        Glb(model)
    }

    /// Creates one named `stem.glb`, with its images in the folder `stem_textures`.
    pub fn beside(
        scene: &'a Scene,
        images: &'a dyn Images,
        stem: &str,
    ) -> (Glb<'a>, Vec<OutFile<'a>>) {
        Glb::beside_of(Model::of(scene, images), stem)
    }

    pub(super) fn beside_of(mut model: Model<'a>, stem: &str) -> (Glb<'a>, Vec<OutFile<'a>>) {
        let files = model.files(stem);
        model.add_buffer(None);
        (Glb(model), files)
    }

    /// Creates one for the web with embedded images: instances and packed arrays. Use it with the images of
    /// [`Ktx2`](super::Ktx2).
    #[cfg(feature = "compress")]
    pub fn compressed(scene: &'a Scene, images: &'a dyn Images) -> Glb<'a> {
        let mut model = super::compress::model(scene, images);
        model.embed();
        model.add_buffer(None);
        Glb(model)
    }

    /// Returns the bytes of its lists, of its arrays by kind and of its images.
    pub fn sizes(&self) -> Vec<(&'static str, u64)> {
        self.0.sizes()
    }

    /// Writes it at the current position of `out`; returns the number of bytes.
    ///
    /// # Errors
    /// Errors of `out`, and models above 4 GiB, the limit of `.glb`.
    pub fn write(mut self, out: impl Write + Seek) -> io::Result<u64> {
        let length = self.pour(out)?;
        if length > u64::from(u32::MAX) {
            let message = "more than 4 GiB do not fit a .glb; write a .gltf or several files";
            return Err(io::Error::other(message));
        }
        Ok(length)
    }

    /// Returns the whole file.
    pub fn bytes(mut self) -> Vec<u8> {
        let mut out = Cursor::new(Vec::with_capacity(self.0.length as usize + (16 << 10)));
        self.pour(&mut out).expect("memory takes every byte");
        out.into_inner()
    }

    fn pour(&mut self, out: impl Write + Seek) -> io::Result<u64> {
        let mut out = BufWriter::with_capacity(32 << 10, out);
        let start = out.stream_position()?;
        out.write_all(&[0; HEADERS as usize])?;
        self.0.json(&mut out)?;
        let json = out.stream_position()? - start - HEADERS;
        let gap = json.next_multiple_of(4) - json;
        out.write_all(&b"   "[..gap as usize])?;
        let json = json + gap;
        let mut length = HEADERS + json;
        if self.0.length > 0 {
            out.write_all(&(self.0.length as u32).to_le_bytes())?;
            out.write_all(b"BIN\0")?;
            self.0.buffer(&mut out)?;
            length += 8 + self.0.length;
        }
        out.seek(SeekFrom::Start(start))?;
        out.write_all(b"glTF")?;
        for number in [2, length as u32, json as u32] {
            out.write_all(&number.to_le_bytes())?;
        }
        out.write_all(b"JSON")?;
        out.seek(SeekFrom::Start(start + length))?;
        Ok(length)
    }
}
