//! Embeds the page of `hsd view` where it was built: `view/dist/NAME.gz`, made by `npm run build` in `view/`. Tells the
//! tests how far the program is optimised, and whether the data beside the repository is there.

use std::path::Path;
use std::{env, fs};

fn main() {
    let folder = Path::new("view/dist");
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<_> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "gz"))
        .filter_map(|path| path.canonicalize().ok())
        .collect();
    files.sort();
    let mut table = String::from("&[\n");
    for path in &files {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        table += &format!("    ({name:?}, include_bytes!({path:?})),\n");
        println!("cargo::rerun-if-changed={}", path.display());
    }
    table += "]\n";
    shared_data();
    // How far the program is optimised, which only cargo knows; tests are content with fewer inputs where it is not.
    let level = env::var("OPT_LEVEL").unwrap_or_default();
    println!("cargo::rustc-env=HSD_OPT_LEVEL={level}");
    let out = env::var_os("OUT_DIR").expect("cargo names a folder for what is made");
    fs::write(Path::new(&out).join("page.rs"), table).expect("the folder takes a file");
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
