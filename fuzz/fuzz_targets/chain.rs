//! No bytes whatever disturb the chain from a source to a model.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = hsd::driver::compile_bytes("fuzz.hsd", bytes);
});
