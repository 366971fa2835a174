//! Roofs as solids: closed, complete, where they belong.

mod boards;
mod common;
mod corridors;
mod dormers;
mod fixtures;
mod flat;
mod junctions;
mod halls;
mod massive;
mod messages;
mod plans;
mod random;
mod shapes;
mod skirts;
mod stacked;
mod surface;
mod whole;
mod worst;
