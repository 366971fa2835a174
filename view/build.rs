//! Embeds the page of `hsd view` if it was built: `dist/NAME.gz`, from `npm run build`.

use std::path::Path;
use std::{env, fs};

fn main() {
    let folder = Path::new("dist");
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
    let out = env::var_os("OUT_DIR").expect("cargo sets OUT_DIR for build scripts");
    fs::write(Path::new(&out).join("page.rs"), table).expect("the folder is writable");
}
