//! The house types of `hsd new` and the definitions that they share.

/// Files of `library/`: names without the ending, and contents.
pub const FILES: &[(&str, &str)] = &[
    ("block", include_str!("block.hsd")),
    ("buke-bei", include_str!("buke-bei.hsd")),
    ("buke-nagaya", include_str!("buke-nagaya.hsd")),
    ("chu-nikai", include_str!("chu-nikai.hsd")),
    ("fronts", include_str!("fronts.hsd")),
    ("grounds", include_str!("grounds.hsd")),
    ("hei-tsuki", include_str!("hei-tsuki.hsd")),
    ("hiraya", include_str!("hiraya.hsd")),
    ("hondo", include_str!("hondo.hsd")),
    ("hospital", include_str!("hospital.hsd")),
    ("house", include_str!("house.hsd")),
    ("kanban", include_str!("kanban.hsd")),
    ("kura", include_str!("kura.hsd")),
    ("modern-house", include_str!("modern-house.hsd")),
    ("mon", include_str!("mon.hsd")),
    ("office", include_str!("office.hsd")),
    ("outlines", include_str!("outlines.hsd")),
    ("plans", include_str!("plans.hsd")),
    ("roji", include_str!("roji.hsd")),
    ("sangai", include_str!("sangai.hsd")),
    ("school", include_str!("school.hsd")),
    ("shimotaya", include_str!("shimotaya.hsd")),
    ("shop-row", include_str!("shop-row.hsd")),
    ("so-nikai", include_str!("so-nikai.hsd")),
    ("tahoto", include_str!("tahoto.hsd")),
    ("taka-bei", include_str!("taka-bei.hsd")),
    ("temple", include_str!("temple.hsd")),
    ("ura-nagaya", include_str!("ura-nagaya.hsd")),
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
    panic!("library/ has no such file")
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
