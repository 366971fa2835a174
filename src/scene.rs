//! The scene: meshes, materials and a tree of nodes that place them. It knows no catalogue and no plan;
//! codes are mere labels here.
//!
//! Frame: right-handed, metres, x east, y north, z up; back ends turn it into their own. A mesh of a part
//! lies in the part's frame: x to the RIGHT as seen from outside, y into the house, z up from the storey's
//! floor; origin at the left end of its wall's centre line, so that a south front needs no rotation.

mod label;
mod stats;

pub use label::Label;
pub use stats::Stats;

use crate::source::Span;
use compact_str::CompactString;
use glam::{DVec2, DVec3};
use serde::Serialize;

/// Everything a back end needs.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Scene {
    /// Materials in the order of first use.
    pub materials: Vec<Material>,
    /// Meshes in the order of first use; shared by the nodes that show them.
    pub meshes: Vec<Mesh>,
    /// The tree in preorder: a parent stands before its children.
    pub nodes: Vec<Node>,
    /// Part pictures: paths that the world finds.
    pub pictures: Vec<String>,
    /// Pictures of joinery, made where the detail asks for pictures in place of shapes.
    pub baked: Vec<Baked>,
    /// What walls mirror, a picture for each plane, where that was asked for.
    #[serde(skip)]
    pub mirrored: Vec<image::RgbImage>,
}

/// How much of the joinery is shape and how much is picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum Detail {
    /// 0: walls and roofs.
    Body,
    /// 1: a flat picture for each part, and what stands out far before the wall.
    Flat,
    /// 2: openings, leaves and heavy bars as shapes, the fine ones as pictures.
    Openings,
    /// 3: everything as shapes.
    #[default]
    Everything,
}

impl Detail {
    /// All of them by their numbers.
    pub const ALL: [Detail; 4] = [
        Detail::Body,
        Detail::Flat,
        Detail::Openings,
        Detail::Everything,
    ];
}

/// A page of baked pictures: square, side by side, upright as seen from outside.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Baked {
    /// Base colour, sRGB, and whether there is anything.
    #[serde(skip)]
    pub color: image::RgbaImage,
    /// Unit normals in the plane of the picture: red to the right, green up.
    #[serde(skip)]
    pub normal: image::RgbImage,
    /// Red: occlusion. Green: roughness. Blue: metalness.
    #[serde(skip)]
    pub orm: image::RgbImage,
    /// Whether its pictures have holes.
    pub holes: bool,
}

/// Index into [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct MaterialId(pub u32);

/// Index into [`Scene::meshes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct MeshId(pub u32);

/// Index into [`Scene::nodes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct NodeId(pub u32);

/// How a surface looks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    /// A readable name, unique in the scene.
    pub name: String,
    /// What is drawn on it.
    pub image: Image,
    /// Multiplies the colour, linear RGB and opacity.
    pub tint: [f32; 4],
    /// 0 mirror-smooth to 1 dull; multiplies the picture's roughness.
    pub roughness: f32,
    /// 0 or 1; multiplies the picture's metalness.
    pub metallic: f32,
    /// Whether both sides show (cloth, paper).
    pub double_sided: bool,
    /// Whether its picture has holes: what it leaves out is not there.
    pub cutout: bool,
    /// Share of the neighbourhood that glass mirrors, 0 to 1 (003-13, 003-14).
    pub reflection: Option<f32>,
    /// What it mirrors: index into [`Scene::mirrored`]; drawn by [`Primitive::mirror_uvs`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mirrored: Option<u32>,
}

impl Material {
    /// The tint, and how much light of the mirrored picture is added to it, so that blending both over what lies behind
    /// comes to so much of the picture as the share says, and for the rest to what was there without it.
    pub fn under_mirror(&self) -> ([f32; 4], f32) {
        let share = self.reflection.unwrap_or(0.0).clamp(0.0, 1.0);
        let [r, g, b, opacity] = self.tint;
        let whole = opacity + share - opacity * share;
        if whole <= 0.0 {
            return (self.tint, 0.0);
        }
        let left = (1.0 - share) * opacity / whole;
        ([r * left, g * left, b * left, whole], share / whole)
    }
}

/// The picture of a material.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Image {
    /// Plain colour.
    None,
    /// A look of a drawn surface, by its name in `texture`; texture coordinates are metres.
    Surface(&'static str),
    /// Index into [`Scene::pictures`]; texture coordinates run from 0 to 1, v upwards.
    Picture(u32),
    /// Index into [`Scene::baked`]; texture coordinates run from 0 to 1, v upwards.
    Baked(u32),
}

/// A shape, in one or more materials.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Mesh {
    /// A readable name.
    pub name: String,
    /// A part each material.
    pub primitives: Vec<Primitive>,
}

/// Triangles in one material. Arrays of vertices have the same length; indices come in threes, counter-
/// clockwise seen from outside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Primitive {
    /// Their material.
    pub material: MaterialId,
    /// Metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit length.
    pub normals: Vec<[f32; 3]>,
    /// Metres along the surface, u to the right and v UP (back ends flip v where theirs runs down).
    pub uvs: Vec<[f32; 2]>,
    /// Places in the picture of what its material mirrors, 0 to 1, v upwards; empty where that is none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mirror_uvs: Vec<[f32; 2]>,
    /// Into the arrays.
    pub indices: Vec<u32>,
}

/// What a node stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Kind {
    /// A house.
    House,
    /// A storey of it.
    Storey,
    /// One wall of a storey.
    Facade,
    /// A part in a wall.
    Part,
    /// A post.
    Post,
    /// A beam, sill or foundation stone.
    Member,
    /// A roof.
    Roof,
    /// A stone platform.
    Platform,
    /// Boards round a storey, with their railing.
    Veranda,
    /// A bracket complex, or the beams on them.
    Bracket,
    /// What crowns a roof.
    Finial,
}

impl Kind {
    /// The word in `extras.kind`.
    pub fn word(self) -> &'static str {
        match self {
            Kind::House => "house",
            Kind::Storey => "storey",
            Kind::Facade => "facade",
            Kind::Part => "part",
            Kind::Post => "post",
            Kind::Member => "member",
            Kind::Roof => "roof",
            Kind::Platform => "platform",
            Kind::Veranda => "veranda",
            Kind::Bracket => "bracket",
            Kind::Finial => "finial",
        }
    }
}

/// A place in the tree, with or without something to see.
#[derive(Clone, Debug, Serialize)]
pub struct Node {
    /// The node above; `None` = a root.
    pub parent: Option<NodeId>,
    /// What it stands for.
    pub kind: Kind,
    /// A readable name; most are short enough to stand in place.
    pub name: CompactString,
    /// Where its origin lies in its parent's frame, metres.
    pub at: DVec3,
    /// Its rotation about the vertical: (cos, sin), counter-clockwise seen from above; (1, 0) = none.
    pub turn: DVec2,
    /// What it shows.
    pub mesh: Option<MeshId>,
    /// `extras.code` of a part.
    pub code: Option<Label>,
    /// `extras.storey`.
    pub storey: Option<u32>,
    /// `extras.span`: bytes of the source.
    pub span: Option<Span>,
    /// `extras.shape` of a roof.
    pub shape: Option<Label>,
}

impl Node {
    /// A node that is not turned, shows nothing and has no label.
    pub fn new(parent: Option<NodeId>, kind: Kind, name: CompactString, at: DVec3) -> Node {
        Node {
            parent,
            kind,
            name,
            at,
            turn: DVec2::X,
            mesh: None,
            code: None,
            storey: None,
            span: None,
            shape: None,
        }
    }

    /// Its name; where it has none, what it is.
    pub fn called(&self) -> &str {
        match self.name.as_str() {
            "" => self.kind.word(),
            name => name,
        }
    }
}
