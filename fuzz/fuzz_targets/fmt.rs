//! No bytes whatever disturb `hsd fmt`: what it lays out or writes in the other form can be read again, and is laid out once
//! and for all.

#![no_main]

use hsd::diagnostic::{Code, Diagnostics};
use hsd::expand;
use hsd::print::{encode, format};
use hsd::source::{FileId, Limits, NoFiles, Source};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let (limits, mut out) = (
        Limits {
            parts: 20_000,
            ..Limits::default()
        },
        Diagnostics::new(),
    );
    let source = Source::new(FileId(0), "fuzz.hsd", bytes);
    if let Some(text) = format(&source, &limits, &mut out) {
        let again = Source::new(FileId(0), "fuzz.hsd", &encode(&text, &source));
        assert_eq!(format(&again, &limits, &mut out).as_deref(), Some(&*text));
    }
    assert!(out.iter().all(|d| d.code != Code(801)));
    let options = hsd::Options {
        expand: expand::Options {
            limits,
            ..expand::Options::default()
        },
        ..hsd::Options::default()
    };
    let _ = hsd::driver::convert(&source, &NoFiles, &options, &mut out);
});
