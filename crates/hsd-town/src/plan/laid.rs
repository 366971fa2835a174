//! What is known of a whole town before the first of its features is made: roads, poles, zones and water, since each of them
//! depends on others.

use super::{KnownPoles, Roads, Waters, Zones};
use hsd_base::geometry::grid::Bounds;
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// What is laid before anything else.
#[derive(Debug, Default)]
pub struct LaidFirst {
    /// The roads that rules make; none if they make none, or by a definition that they use.
    pub roads: Roads,
    /// The poles of networks.
    pub poles: KnownPoles,
    /// The zones.
    pub zones: Zones,
    /// The water.
    pub waters: Waters,
}

impl LaidFirst {
    /// Adds what is near a box.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        self.roads.pack(bounds, out);
        self.poles.pack(bounds, out);
        self.zones.pack(bounds, out);
        self.waters.pack(bounds, out);
    }

    /// Takes it from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<LaidFirst> {
        Ok(LaidFirst {
            roads: Roads::unpack(from)?,
            poles: KnownPoles::unpack(from)?,
            zones: Zones::unpack(from)?,
            waters: Waters::unpack(from)?,
        })
    }
}
