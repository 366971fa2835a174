//! The finishes of infill walls: that of an adjacent wall, otherwise the default of the period.

use hsd_ir::catalog::{Catalog, Era};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;

/// Returns the finish that a wall gives to adjacent infill walls.
pub(super) fn finish_of(catalog: &Catalog, content: &Content) -> Option<SurfaceId> {
    match content {
        Content::Part(id) => catalog.part(*id).finish,
        _ => None,
    }
}

/// Returns the default finish of infill walls by era.
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
