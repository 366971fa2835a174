//! Plans.
#![allow(missing_docs)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Cell {
    pub a0: i64,
    pub b0: i64,
    pub a1: i64,
    pub b1: i64,
}
