//! Reads arbitrary bytes as the image of a part: it is shown or reported, and no image takes more memory than its limit
//! allows.

#![no_main]

use hsd::backend::images::Library;
use hsd::source::{PictureFile, World};
use libfuzzer_sys::fuzz_target;
use std::io;

const PIXELS: u64 = 1 << 20;

struct Image<'b>(&'b [u8]);

impl World for Image<'_> {
    fn picture(&self, _: &str) -> Option<PictureFile> {
        None
    }

    fn picture_bytes(&self, _: &str) -> io::Result<Vec<u8>> {
        Ok(self.0.to_vec())
    }
}

fuzz_target!(|bytes: &[u8]| {
    let mut told = 0;
    let library = Library::load(&["sign.png".into()], &Image(bytes), PIXELS, |_, _| told += 1);
    if let Some(pixels) = library.pixels(0) {
        let (width, height) = pixels.dimensions();
        assert!(u64::from(width) * u64::from(height) <= PIXELS);
        assert_eq!(told, 0);
    } else if !bytes.starts_with(b"\xff\xd8") {
        // Readers of JPEG forgive most damage, each some of its own.
        assert_eq!(told, 1);
    }
});
