//! What a house is for.

use serde::Serialize;

/// The purpose of a house, which decides what its roofs do not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Purpose {
    /// People live in it.
    Dwelling,
    /// A storehouse or a shop.
    Store,
    /// A Buddhist hall of its own.
    Hall,
    /// A temple.
    Temple,
    /// A Shinto shrine.
    Shrine,
    /// A gate.
    Gate,
    /// A shed under one slope.
    Shed,
    /// A block of flats or offices.
    Block,
}

impl Purpose {
    /// Every purpose with its word.
    pub const ALL: [(&'static str, Purpose); 8] = [
        ("dwelling", Purpose::Dwelling),
        ("store", Purpose::Store),
        ("hall", Purpose::Hall),
        ("temple", Purpose::Temple),
        ("shrine", Purpose::Shrine),
        ("gate", Purpose::Gate),
        ("shed", Purpose::Shed),
        ("block", Purpose::Block),
    ];
}
