//! No bytes whatever disturb the reader of the legacy text, and every message points into the file.

#![no_main]

use hsd::diagnostic::Diagnostics;
use hsd::source::{FileId, Limits, Source};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let source = Source::new(FileId(0), "fuzz.hsd", bytes);
    let mut out = Diagnostics::new();
    hsd::parse::legacy::parse(&source, &Limits::default(), &mut out);
    for told in out.iter() {
        assert!(told.span().is_some_and(|s| s.start <= s.end && s.end as usize <= bytes.len()));
    }
});
