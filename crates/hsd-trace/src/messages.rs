//! Messages about drawn floor plans.

pub mod drawn;
