//! Messages about the legacy text (HSD01xx): 0101 to 0119 the header and the sections, 0120 to 0139 the
//! walls (and 0137 heights), 0140 and on the roof lines.

mod comments;
mod header;
mod roofs;
mod slips;
mod walls;

pub use comments::*;
pub use header::*;
pub use roofs::*;
pub use slips::*;
pub use walls::*;
