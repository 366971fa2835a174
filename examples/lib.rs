//! The finished houses among the examples that `hsd new` copies.

/// Files of `examples/` that are templates: names without the ending, and contents.
pub static FILES: &[(&str, &str)] = &[
    ("omotedana", include_str!("omotedana.hsd")),
    ("l-house", include_str!("l-house.hsd")),
    ("pagoda", include_str!("pagoda.hsd")),
    ("suzakumon", include_str!("suzakumon.hsd")),
    ("shrine", include_str!("shrine.hsd")),
    ("ninomaru", include_str!("ninomaru.hsd")),
];
