//! Passes the optimisation level to the tests; only cargo has it.

fn main() {
    let level = std::env::var("OPT_LEVEL").unwrap_or_default();
    println!("cargo::rustc-env=HSD_OPT_LEVEL={level}");
}
