//! The catalogue of parts, read from `grammar/parts.xml`: what a code means, how wide it is, and which
//! simple bodies make its shape.

use serde::Serialize;

/// Index of a part in its [`Catalog`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct PartId(pub u16);
