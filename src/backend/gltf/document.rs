//! The JSON of a model: long lists are produced item by item during writing, the rest is in a root.

#[cfg(feature = "compress")]
use super::compress::Packed;
use super::geometry::Geometry;
use super::nodes::Tree;
use gltf::json::Root;
use serde::{Serialize, Serializer};
use std::io::{self, Write};

/// A glTF document. The lists given here are empty in the root.
#[derive(Serialize)]
struct Document<'a, A, M, N> {
    #[serde(skip_serializing_if = "Option::is_none")]
    accessors: Option<A>,
    #[serde(flatten)]
    root: &'a Root,
    #[serde(skip_serializing_if = "Option::is_none")]
    meshes: Option<M>,
    #[serde(skip_serializing_if = "Option::is_none")]
    nodes: Option<N>,
}

/// A list that is produced while it is written.
struct Listed<F>(F);

impl<F, I> Serialize for Listed<F>
where
    F: Fn() -> I,
    I: IntoIterator<Item: Serialize>,
{
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.collect_seq((self.0)())
    }
}

/// Writes the whole document.
pub(super) fn write(
    root: &Root,
    geometry: &Geometry<'_>,
    tree: &Tree<'_>,
    out: impl Write,
) -> io::Result<()> {
    let (shapes, places) = (!geometry.is_empty(), !tree.is_empty());
    let document = Document {
        root,
        accessors: shapes.then_some(Listed(|| geometry.accessors())),
        meshes: shapes.then_some(Listed(|| geometry.meshes())),
        nodes: places.then_some(Listed(|| tree.nodes(geometry))),
    };
    Ok(serde_json::to_writer(out, &document)?)
}

/// Writes the whole document of a packed model.
#[cfg(feature = "compress")]
pub(super) fn write_packed(
    root: &Root,
    geometry: &Geometry<'_>,
    packed: &Packed<'_>,
    out: impl Write,
) -> io::Result<()> {
    let document = Document {
        root,
        accessors: (!packed.accessors.is_empty()).then_some(&packed.accessors),
        meshes: (!geometry.is_empty()).then_some(Listed(|| geometry.meshes())),
        nodes: (!packed.nodes.is_empty()).then_some(&packed.nodes),
    };
    Ok(serde_json::to_writer(out, &document)?)
}
