//! The limits of a run, so that no input exhausts memory or time.

/// Bounds on the input of a build (docs/contract.md 7), each with a flag to raise it.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Bytes of one file.
    pub bytes: usize,
    /// Depth of nested elements.
    pub nesting: usize,
    /// Files that others include.
    pub includes: usize,
    /// Bytes of all files that others include.
    pub included_bytes: usize,
    /// Expanded parts of one house.
    pub parts: usize,
    /// Parts that the houses of a run have beyond one for each byte that they are written in.
    pub repeated_parts: usize,
    /// Triangles that one house shows.
    pub triangles: usize,
    /// Variants of sources of [`Limits::VARIANT_BYTES`]; larger sources have fewer.
    pub variants: u32,
    /// Pixels of one image.
    pub pixels: u64,
    /// Bytes of memory for what maps expand to ([`Budget`](crate::budget::Budget)).
    pub memory: u64,
}

impl Limits {
    /// The bytes of sources that [`Limits::variants`] is meant for.
    pub const VARIANT_BYTES: usize = 16 << 10;

    /// Room for the parts of one house of a type, as counted while a file is read; one of the largest has 1,600.
    const PLACED: usize = 2_500;
    /// The most by which places multiply the limit on the parts of a file.
    const PLACES: usize = 20;

    /// Returns the limit on the parts that a file's references, places and repeats expand to. Each `Place` that it writes raises
    /// the limit by the parts of one house of a type, up to a total of [`Limits::PLACES`] times the usual limit.
    pub fn copied(&self, places: usize) -> u64 {
        let placed = places.saturating_mul(Self::PLACED);
        let most = self.parts.saturating_mul(Self::PLACES);
        self.parts.max(most.min(self.parts.saturating_add(placed))) as u64
    }

    /// Returns the number of variants allowed for sources of so many bytes; at least 1.
    pub fn variants_of(&self, bytes: usize) -> u32 {
        let room = u64::from(self.variants) * Self::VARIANT_BYTES as u64;
        let many = room / bytes.max(Self::VARIANT_BYTES) as u64;
        u32::try_from(many).unwrap_or(u32::MAX).max(1)
    }
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            bytes: 16 << 20,
            nesting: 64,
            includes: 256,
            included_bytes: 64 << 20,
            parts: 2_000_000,
            repeated_parts: 2_000_000,
            triangles: 3_000_000,
            variants: 10_000,
            pixels: 64 << 20,
            memory: crate::budget::Budget::MEMORY,
        }
    }
}
