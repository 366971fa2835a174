//! Messages about the catalogue, parts and XML, which several passes report.

pub mod catalog;
pub mod parts;
pub mod xml;
