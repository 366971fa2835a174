//! The scene: meshes, materials and a tree of nodes that place them. It is independent of catalogue and plan; codes are
//! plain labels here.
//!
//! Frame: right-handed, metres, x east, y north, z up; back ends convert it to their own. The mesh of a part is in the
//! part's frame: x to the RIGHT as seen from outside, y into the house, z up from the storey's floor; origin at the
//! left end of its wall's centre line, so that a south front needs no rotation.

pub mod texture;
mod label;
mod part;
mod provenance;
mod stats;

pub use label::Label;
pub use part::ScenePart;
pub use provenance::{PartNames, Place, Provenance};
pub use stats::{Counter, Stats};

use compact_str::CompactString;
use glam::{DVec2, DVec3};
use hsd_base::source::Span;
use serde::Serialize;
use std::num::NonZeroU32;
use std::sync::Arc;

/// The input of every back end.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Scene {
    /// The level of detail.
    #[serde(skip)]
    pub detail: Detail,
    /// Materials in the order of first use.
    pub materials: Vec<Material>,
    /// Meshes in the order of first use; shared by the nodes that show them.
    pub meshes: Vec<Mesh>,
    /// The tree in preorder: a parent precedes its children.
    pub nodes: Vec<Node>,
    /// Part textures: paths that the file system or its substitute resolves.
    pub pictures: Vec<String>,
    /// Images of joinery, made if the detail replaces geometry by images.
    pub baked: Vec<Baked>,
    /// The reflections in walls, one image per plane, if requested.
    #[serde(skip)]
    pub mirrored: Vec<image::RgbImage>,
    /// The places of houses left out, since they would show too many triangles.
    #[serde(skip)]
    pub oversized: Vec<Span>,
    /// What it was made from.
    #[serde(skip)]
    pub provenance: Provenance,
}

/// The level of detail: how joinery is divided into geometry and images.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum Detail {
    /// 0: walls and roofs, brackets and railings, in plain colours.
    Body,
    /// 1: a flat image for each part, and elements that project far from the wall.
    Flat,
    /// 2: openings, leaves and heavy bars as geometry, fine ones as images.
    Openings,
    /// 3: everything as geometry.
    #[default]
    Everything,
}

impl Detail {
    /// All levels, by number.
    pub const ALL: [Detail; 4] = [
        Detail::Body,
        Detail::Flat,
        Detail::Openings,
        Detail::Everything,
    ];
}

impl Detail {
    /// Returns how far the mesh of a town's ground may be from its heights, metres.
    pub fn ground_tolerance(self) -> f64 {
        match self {
            Detail::Body => 0.5,
            Detail::Flat => 0.25,
            Detail::Openings => 0.15,
            Detail::Everything => 0.05,
        }
    }
}

/// A page of baked images, side by side, upright as seen from outside; encoded, since a town has many.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Baked {
    /// Base colour, sRGB: a PNG with opacity if its images have holes, otherwise a JPEG.
    #[serde(skip)]
    pub color: Arc<[u8]>,
    /// Unit normals in the plane of the image, red to the right, green up: a JPEG.
    #[serde(skip)]
    pub normal: Arc<[u8]>,
    /// Red: occlusion. Green: roughness. Blue: metalness. A PNG.
    #[serde(skip)]
    pub orm: Arc<[u8]>,
    /// True if its images have holes.
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

/// The look of a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    /// A readable name, unique in the scene.
    pub name: String,
    /// The texture.
    pub image: Image,
    /// Multiplies the colour, linear RGB and opacity.
    pub tint: [f32; 4],
    /// From 0, mirror-smooth, to 1, matt; multiplies the texture's roughness.
    pub roughness: f32,
    /// 0 or 1; multiplies the texture's metalness.
    pub metallic: f32,
    /// True if both sides are visible (cloth, paper).
    pub double_sided: bool,
    /// True if its texture has holes, which are cut out.
    pub cutout: bool,
    /// Share of the surroundings that glass reflects, 0 to 1 (003-13, 003-14).
    pub reflection: Option<f32>,
    /// The reflection: an index into [`Scene::mirrored`]; mapped by [`Primitive::mirror_uvs`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mirrored: Option<u32>,
}

impl Material {
    /// Returns the tint, and how much light of the reflection is added to it. Blended over the background, the sum
    /// contains the given share of the reflection; the rest is the look without it.
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

/// The texture of a material.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Image {
    /// Plain colour.
    None,
    /// A look of a textured surface, by its name in `texture`; texture coordinates are metres.
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
    /// One primitive per material.
    pub primitives: Vec<Primitive>,
}

/// Triangles of one material. Vertex arrays have equal lengths; indices come in threes, counter-clockwise seen from
/// outside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Primitive {
    /// Their material.
    pub material: MaterialId,
    /// Positions, metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates: metres along the surface, u to the right and v UP (back ends flip v if theirs runs down).
    pub uvs: Vec<[f32; 2]>,
    /// Texture coordinates of the reflection, 0 to 1, v upwards; empty if the material has none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mirror_uvs: Vec<[f32; 2]>,
    /// Indices into the arrays.
    pub indices: Vec<u32>,
}

/// How much of each house a model shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shown {
    /// Everything.
    #[default]
    Whole,
    /// Everything but roofs, and the ceilings of the highest storey.
    Roofless,
    /// Storeys up to this one, counted from 1, without what hangs or stands on it.
    Storeys(u32),
}

impl Shown {
    /// Returns true if a storey is seen.
    pub fn has_storey(self, storey: u32) -> bool {
        match self {
            Shown::Whole | Shown::Roofless => true,
            Shown::Storeys(most) => storey <= most,
        }
    }

    /// Returns true if the roofs on a storey are seen.
    pub fn has_roof(self, storey: u32) -> bool {
        match self {
            Shown::Whole => true,
            Shown::Roofless => false,
            Shown::Storeys(most) => storey < most,
        }
    }

    /// Returns true if the ceilings of a storey of a house of so many are seen.
    pub fn has_ceiling(self, storey: u32, storeys: u32) -> bool {
        match self {
            Shown::Whole => true,
            Shown::Roofless => storey < storeys,
            Shown::Storeys(most) => storey < most.min(storeys),
        }
    }
}

/// The kind of thing that a node represents.
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
    /// The floor and ceiling of a room.
    Room,
    /// A fixture of a room: an alcove, stairs, a stove.
    Fixture,
    /// A roof.
    Roof,
    /// A stone platform.
    Platform,
    /// Boards round a storey, with their railing.
    Veranda,
    /// A bracket complex, or the beams on them.
    Bracket,
    /// An ornament on a roof's ridge or apex.
    Finial,
    /// The ground of a town.
    Ground,
    /// What lies on the ground outside houses: a piece of road or railway; what a rule made of a feature there.
    Outdoors,
    /// A tree.
    Tree,
}

impl Kind {
    /// Returns the word in `extras.kind`.
    pub fn word(self) -> &'static str {
        match self {
            Kind::House => "house",
            Kind::Storey => "storey",
            Kind::Facade => "facade",
            Kind::Part => "part",
            Kind::Post => "post",
            Kind::Member => "member",
            Kind::Room => "room",
            Kind::Fixture => "fixture",
            Kind::Roof => "roof",
            Kind::Platform => "platform",
            Kind::Veranda => "veranda",
            Kind::Bracket => "bracket",
            Kind::Finial => "finial",
            Kind::Ground => "ground",
            Kind::Outdoors => "outdoors",
            Kind::Tree => "tree",
        }
    }
}

/// A place in the tree, with or without a mesh.
#[derive(Clone, Debug, Serialize)]
pub struct Node {
    /// The parent node; `None` = a root.
    pub parent: Option<NodeId>,
    /// The thing it represents.
    pub kind: Kind,
    /// A readable name, usually short enough to be stored inline.
    pub name: CompactString,
    /// Position of its origin in its parent's frame, metres.
    pub at: DVec3,
    /// Its rotation about the vertical: (cos, sin), counter-clockwise seen from above; (1, 0) = none.
    pub turn: DVec2,
    /// Its mesh.
    pub mesh: Option<MeshId>,
    /// `extras.code` of a part.
    pub code: Option<Label>,
    /// `extras.storey`.
    pub storey: Option<u32>,
    /// `extras.facade`: the number of a wall in its storey.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facade: Option<NonZeroU32>,
    /// The names of a part.
    #[serde(skip)]
    pub names: Option<Arc<PartNames>>,
    /// `extras.span`: a byte range of the source.
    pub span: Option<Span>,
    /// The name of the file of the span, for a house and for what is written in another file than its house.
    #[serde(skip)]
    pub file: Option<Arc<String>>,
    /// Where the span begins, if the sources are at hand.
    #[serde(skip)]
    pub place: Option<Place>,
    /// `extras.shape` of a roof.
    pub shape: Option<Label>,
    /// Its mesh as one model of many sizes, for files that keep such a model once.
    #[serde(skip)]
    pub stretched: Option<Box<Stretched>>,
}

/// A mesh that is a model stretched to a size: other nodes of the model have the same mesh, stretched to theirs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretched {
    /// The model.
    pub model: &'static str,
    /// Width and height, metres.
    pub size: [f32; 2],
}

impl Node {
    /// Creates a node without rotation, mesh or labels.
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
            facade: None,
            names: None,
            span: None,
            file: None,
            place: None,
            shape: None,
            stretched: None,
        }
    }

    /// Returns its name; if it has none, its kind.
    pub fn called(&self) -> &str {
        match self.name.as_str() {
            "" => self.kind.word(),
            name => name,
        }
    }
}
