//! The finishes of small walls: that of a wall beside them, else the default of the period.

use crate::catalog::{Catalog, Era};
use crate::material::SurfaceId;
use crate::program::Content;

/// The finish that a wall gives to small walls beside it.
pub(super) fn finish_of(catalog: &Catalog, content: &Content) -> Option<SurfaceId> {
    match content {
        Content::Part(id) => catalog.part(*id).finish,
        _ => None,
    }
}

/// The default of small walls by era.
pub(super) fn default_finish(catalog: &Catalog, content: &Content) -> SurfaceId {
    let era = match content {
        Content::Part(id) => catalog.part(*id).era,
        Content::Split(split) => match split.lower.first() {
            Some(unit) => return default_finish(catalog, &unit.content),
            None => Era::All,
        },
        _ => Era::All,
    };
    let name = if era == Era::Modern {
        "mortar"
    } else {
        "plaster"
    };
    SurfaceId::named(name)
}
