//! Messages about drawn floor plans and photographs.

pub mod drawn;
pub mod photographed;
