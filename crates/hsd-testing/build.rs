//! Tells tests how far they are optimised, which only cargo knows.

fn main() {
    let level = std::env::var("OPT_LEVEL").unwrap_or_default();
    println!("cargo::rustc-env=HSD_OPT_LEVEL={level}");
}
