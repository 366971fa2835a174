//! The JSON of glTF 2.0, as far as houses need it. What has its default value is left out.

use crate::backend::number::Number;
use crate::source::Span;
use serde::Serialize;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document<'a> {
    pub(super) asset: Asset,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) extensions_used: &'a [&'static str],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scene: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scenes: Option<[Root<'a>; 1]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) nodes: Vec<Node<'a>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) meshes: &'a [Mesh<'a>],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) materials: &'a [Material<'a>],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) textures: &'a [Texture],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) images: Vec<Image<'a>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) samplers: &'a [Sampler],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) accessors: &'a [Accessor],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) buffer_views: &'a [BufferView],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) buffers: Option<[Buffer; 1]>,
}

#[derive(Serialize)]
pub(super) struct Asset {
    version: &'static str,
    generator: &'static str,
}

impl Default for Asset {
    fn default() -> Self {
        Asset {
            version: "2.0",
            generator: concat!("hsd ", env!("CARGO_PKG_VERSION")),
        }
    }
}

#[derive(Serialize)]
pub(super) struct Root<'a> {
    pub(super) nodes: &'a [u32],
}

#[derive(Serialize)]
pub(super) struct Node<'a> {
    pub(super) name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) translation: Option<[Number; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) rotation: Option<[f32; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh: Option<u32>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub(super) children: &'a [u32],
    pub(super) extras: Extras<'a>,
}

/// language.md 6.
#[derive(Serialize)]
pub(super) struct Extras<'a> {
    pub(super) kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) code: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) storey: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) span: Option<Span>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shape: Option<&'static str>,
}

#[derive(Serialize)]
pub(super) struct Mesh<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Serialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: u32,
    pub(super) material: u32,
}

#[derive(Serialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: u32,
    #[serde(rename = "NORMAL")]
    pub(super) normal: u32,
    #[serde(rename = "TANGENT", skip_serializing_if = "Option::is_none")]
    pub(super) tangent: Option<u32>,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    pub(super) uv: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: u32,
    #[serde(skip_serializing_if = "is_zero")]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max: Option<[f32; 3]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    buffer: u32,
    #[serde(skip_serializing_if = "is_zero")]
    byte_offset: usize,
    byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    byte_stride: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<u32>,
}

impl BufferView {
    /// Elements of vertices; many accessors share it, hence the stride.
    pub(super) fn vertices(byte_offset: usize, byte_length: usize, stride: u32) -> BufferView {
        BufferView {
            byte_stride: Some(stride),
            target: Some(34962),
            ..BufferView::plain(byte_offset, byte_length)
        }
    }

    pub(super) fn indices(byte_offset: usize, byte_length: usize) -> BufferView {
        BufferView {
            target: Some(34963),
            ..BufferView::plain(byte_offset, byte_length)
        }
    }

    /// A picture.
    pub(super) fn plain(byte_offset: usize, byte_length: usize) -> BufferView {
        BufferView {
            buffer: 0,
            byte_offset,
            byte_length,
            byte_stride: None,
            target: None,
        }
    }
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) uri: Option<String>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Material<'a> {
    pub(super) name: &'a str,
    pub(super) pbr_metallic_roughness: Pbr,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) normal_texture: Option<TextureRef>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) alpha_mode: Option<&'static str>,
    #[serde(skip_serializing_if = "is_false")]
    pub(super) double_sided: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<Glass>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extras: Option<Reflection>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Pbr {
    #[serde(skip_serializing_if = "is_white")]
    pub(super) base_color_factor: [f32; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_color_texture: Option<TextureRef>,
    #[serde(skip_serializing_if = "is_one")]
    pub(super) metallic_factor: f32,
    #[serde(skip_serializing_if = "is_one")]
    pub(super) roughness_factor: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) metallic_roughness_texture: Option<TextureRef>,
}

/// The extensions of a pane.
#[derive(Serialize)]
pub(super) struct Glass {
    #[serde(rename = "KHR_materials_ior")]
    pub(super) ior: Ior,
    #[serde(rename = "KHR_materials_specular")]
    pub(super) specular: Specular,
}

#[derive(Serialize)]
pub(super) struct Ior {
    pub(super) ior: f32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Specular {
    pub(super) specular_factor: f32,
}

#[derive(Serialize)]
pub(super) struct Reflection {
    pub(super) reflection: f32,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct TextureRef {
    pub(super) index: u32,
}

#[derive(Serialize)]
pub(super) struct Texture {
    pub(super) sampler: u32,
    pub(super) source: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Image<'a> {
    pub(super) name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) buffer_view: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mime_type: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) uri: Option<String>,
}

#[derive(PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Sampler {
    pub(super) mag_filter: u32,
    pub(super) min_filter: u32,
    pub(super) wrap_s: u32,
    pub(super) wrap_t: u32,
}

fn is_zero(x: &usize) -> bool {
    *x == 0
}

fn is_false(x: &bool) -> bool {
    !x
}

fn is_one(x: &f32) -> bool {
    *x == 1.0
}

fn is_white(x: &[f32; 4]) -> bool {
    *x == [1.0; 4]
}
