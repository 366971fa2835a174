//! Sets `cfg(shared_data)` if the data that is kept beside the repository exists. Tests that read it are ignored otherwise.

use std::path::Path;

fn main() {
    println!("cargo::rustc-check-cfg=cfg(shared_data)");
    // One file of it: cargo would build again each time for a path that is missing, and a folder takes long to look through.
    let marker = Path::new("../shared/data/README.md");
    if marker.is_file() {
        println!("cargo::rustc-cfg=shared_data");
        println!("cargo::rerun-if-changed={}", marker.display());
    }
}
