//! No image disturbs the reader of facades, whatever its camera wrote, and a front that it writes has no errors.

#![no_main]

use hsd::Diagnostics;
use hsd::front::{self, Given, Photo, exif};
use hsd::plan::Picture;
use hsd::source::{FileId, NoFiles, Source};
use libfuzzer_sys::fuzz_target;

/// Memory of a run, bytes.
const MEMORY: u64 = 64 << 20;
/// The most pixels that are read: larger images take too long to find anything.
const PIXELS: u32 = 400_000;

fuzz_target!(|bytes: &[u8]| {
    if Picture::decode_within(bytes, MEMORY).is_err() {
        return;
    }
    let Ok((picture, camera)) = Picture::whole(bytes) else {
        return;
    };
    let (width, height) = picture.pixels.dimensions();
    if width.saturating_mul(height) > PIXELS {
        return;
    }
    let focal = camera.and_then(|camera| exif::focal(&camera, (width, height)));
    let photo = Photo {
        name: "photo.jpg".to_owned(),
        pixels: picture.pixels,
        focal,
        mask: None,
        bend: None,
    };
    let Ok(front) = front::read(&[photo], &Given::default()) else {
        return;
    };
    let text = front::text::write(&front, &[]);
    let source = Source::new(FileId(0), "facade.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let parsed = hsd::driver::documents(&[&source], &NoFiles, &hsd::Options::default(), &mut out);
    assert!(!parsed.documents.is_empty(), "{text}");
});
