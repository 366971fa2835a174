//! The eras of parts and houses.

use serde::{Serialize, Serializer};

/// The era in which a part or a house was built (docs/evidence.md 5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Era {
    /// Any time.
    All,
    /// Edo.
    Edo,
    /// Meiji to early Showa.
    Meiji,
    /// Modern.
    Modern,
}

impl Era {
    /// Every era, the timeless one first.
    pub const ALL: [Era; 4] = [Era::All, Era::Edo, Era::Meiji, Era::Modern];

    /// Every era by its word.
    pub const WORDS: [(&'static str, Era); 4] = [
        ("all", Era::All),
        ("E", Era::Edo),
        ("M", Era::Meiji),
        ("N", Era::Modern),
    ];

    /// Returns `all`, `E`, `M` or `N`.
    pub fn word(self) -> &'static str {
        match self {
            Era::All => "all",
            Era::Edo => "E",
            Era::Meiji => "M",
            Era::Modern => "N",
        }
    }
}

impl Serialize for Era {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(self.word())
    }
}
