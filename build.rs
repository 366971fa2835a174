//! Tells the tests how far the program is optimised, and whether the data beside the repository is there.

use std::env;
use std::path::Path;

fn main() {
    shared_data();
    // How far the program is optimised, which only cargo knows; tests use fewer inputs where it is not.
    let level = env::var("OPT_LEVEL").unwrap_or_default();
    println!("cargo::rustc-env=HSD_OPT_LEVEL={level}");
}

/// Sets `cfg(shared_data)` where the data that is kept beside the repository is there; tests that read it are reported as
/// ignored elsewhere.
fn shared_data() {
    println!("cargo::rustc-check-cfg=cfg(shared_data)");
    // One file of it: cargo would build again each time for a path that is missing, and a folder takes long to look through.
    let marker = Path::new("../shared/data/README.md");
    if marker.is_file() {
        println!("cargo::rustc-cfg=shared_data");
        println!("cargo::rerun-if-changed={}", marker.display());
    }
}
