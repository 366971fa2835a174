//! The finished houses among the examples that `hsd new` copies.

/// Files of `examples/` that are templates: names without the ending, and contents.
pub const FILES: &[(&str, &str)] = &[
    ("omotedana", include_str!("omotedana.hsd")),
    ("l-house", include_str!("l-house.hsd")),
    ("pagoda", include_str!("pagoda.hsd")),
    ("suzakumon", include_str!("suzakumon.hsd")),
    ("shrine", include_str!("shrine.hsd")),
    ("ninomaru", include_str!("ninomaru.hsd")),
];

/// Returns the contents of a file by its name without the ending.
///
/// # Panics
/// If there is no such file. Evaluate it in a constant, so that a missing file is a compile error.
pub const fn text(name: &str) -> &'static str {
    let mut i = 0;
    while i < FILES.len() {
        if is_same(FILES[i].0.as_bytes(), name.as_bytes()) {
            return FILES[i].1;
        }
        i += 1;
    }
    panic!("examples/ has no such file")
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}
