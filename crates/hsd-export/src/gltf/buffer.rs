//! The single buffer, which geometry and images share.

use gltf::json::Index;
use gltf::json::buffer::View;

/// Returns a view of the single buffer.
pub(super) fn view(offset: usize, length: usize) -> View {
    View {
        buffer: Index::new(0),
        byte_length: length.into(),
        byte_offset: Some(offset.into()),
        byte_stride: None,
        name: None,
        target: None,
        extensions: None,
        extras: None,
    }
}
