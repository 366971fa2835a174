//! A compiler for houses: a source file lists which doors, walls and windows stand side by side, where the wall turns
//! and where the next storey begins; the result is a textured 3D model with its roof worked out. The language is
//! described in `grammar/README.md`.
//!
//! ```
//! use hsd::{Diagnostics, FileId, NoFiles, Options, Source};
//! let source = Source::new(FileId(0), "shop.hsd", "0 0 180\n\nGSI  GSI  GDE 2KKS\n".as_bytes());
//! let mut out = Diagnostics::new();
//! hsd::check(&[&source], &NoFiles, &Options::default(), &mut out);
//! // One wall is an open facade: a note, not an error.
//! assert!(!out.has_errors());
//! ```
//!
//! [`compile`] makes the model, [`glb`] writes it, [`check`](check()) only reports, [`format`](format()) formats a file, [`roof_over`]
//! roofs an outline. These and the types they take are the public interface. Each step is a module of a crate `hsd-*`, which
//! `docs/architecture.md` lists. Those crates are re-exported here, hidden, for the program, its tests, benchmarks and fuzz
//! targets; they follow no semantic versioning.
//!
//! | feature | adds |
//! |---|---|
//! | `maps` | readers of maps, towns |
//! | `models` | scenes, textures, back ends; without it the chain ends with roofed buildings |
//! | `cli` | the program `hsd` |
//! | `view` | `hsd view`, `hsd render` |
//! | `drawings` | plans, elevations, sections to scale |
//! | `plans` | houses out of drawn floor plans, fronts out of photographs |
//! | `lsp` | `hsd lsp` |
//! | `compress` (off by default, needs C++) | models for the web |
//! | `geopackage` (off by default, needs C) | maps in GeoPackage |
//! | `geoparquet` (off by default) | maps in GeoParquet |
//!
//! # The chain
//!
//! Each step is a plain function from one typed tree to the next. It reports errors to
//! [`Diagnostics`] and continues; none panics. [`compile`] runs them all.
//!
//! From expansion to fittings the unit of work is a house: [`driver::house`] makes one from its syntax and an id, and a
//! run is a loop over houses. A house does not depend on the others, so it may be made again, or elsewhere.
//!
//! | step | makes | what no longer exists after it |
//! |---|---|---|
//! | [`Source::new`] | [`Source`] | encodings; spans count bytes of the original file ever after |
//! | [`parse::parse`] | [`ast::Document`] | syntax: the legacy form and the XML form give one tree; expressions, parameters, conditions, definitions, included files |
//! | [`expand::Expander::house`] | [`program::House`] | repeat, split lists, random, replace, unknown codes, defaults |
//! | [`lower::house`] | [`building::House`] | turns and rows: every wall has two ends |
//! | [`roof::house`] | [`building::HouseRoofs`] | open tops: regions cover every uncovered area once, solids lie over them |
//! | [`fit::house`] | [`building::Built`] | platforms, verandas, brackets and finials without a place |
//! | [`tessellate::tessellate`] | [`scene::Scene`] | part codes and plans: meshes, materials, a tree of nodes |
//! | [`backend`] | bytes | |
//!
//! [`mod@print`] goes the other way: it formats a source file, or converts it to the other form of the language.
//!
//! # Nouns and verbs
//!
//! The trees between the steps are noun modules: data, small accessors, invariants in their headers. The steps are
//! verb modules. A noun uses no verb; a step uses its input, its output and the foundations. Crates keep them
//! apart, and `tests/order.rs` where several share a crate. The core does no input or output: images and included files come
//! through [`source::World`]; [`fs`] reads files for the shells [`cli`], [`lsp`] and [`view`], and only [`cli`] prints.
//!
//! # Numbers
//!
//! Lengths are f64 until a back end writes f32. Plans are in U (3 shaku unless the house says otherwise) and exact on
//! quarter units; roofs are divided on integers. No platform sine, no iteration over hash maps: same input, same bytes.

// The crates under the names of their modules, in reading order, for the program, its tests, benchmarks and fuzz targets.

// Foundations, and the trees between the steps.
#[doc(hidden)]
pub use hsd_base::{diagnostic, geometry, lettering, rng, source, text};
#[doc(hidden)]
pub use hsd_ir::{ast, building, catalog, check, material, program};
#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_scene as scene;
#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_scene::texture;

// The chain: from a source file to a syntax tree,
#[doc(hidden)]
pub use hsd_syntax::{parse, print, templates};

// to fitted buildings,
#[doc(hidden)]
pub use hsd_passes::{expand, fit, lower};
#[doc(hidden)]
pub use hsd_roof as roof;

// to triangles and files,
#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_mesh as tessellate;

#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_export as backend;

#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_dump as dump;

// all together.
#[doc(hidden)]
pub use hsd_driver as driver;
#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_driver::{fs, plan_file};

// Around the chain.
#[cfg(feature = "drawings")]
#[doc(hidden)]
pub use hsd_drawing as drawing;
#[cfg(feature = "plans")]
#[doc(hidden)]
pub use hsd_front as front;
#[cfg(feature = "maps")]
#[doc(hidden)]
pub use hsd_map as map;
#[cfg(feature = "models")]
#[doc(hidden)]
pub use hsd_render as render;
#[cfg(feature = "maps")]
#[doc(hidden)]
pub use hsd_town as town;
#[cfg(feature = "maps")]
#[doc(hidden)]
pub use hsd_town::{survey, tiles};
#[cfg(feature = "plans")]
#[doc(hidden)]
pub use hsd_trace::plan;

// Shells.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub use hsd_cli as cli;
#[cfg(feature = "view")]
#[doc(hidden)]
pub use hsd_ide as ide;
#[cfg(feature = "lsp")]
#[doc(hidden)]
pub use hsd_lsp as lsp;
#[cfg(any(feature = "cli", feature = "view"))]
#[doc(hidden)]
pub use hsd_report as report;
#[cfg(feature = "view")]
#[doc(hidden)]
pub use hsd_view as view;

// The public interface.
mod facade;

pub use facade::*;
pub use glam;
pub use hsd_base::diagnostic::{Code, Diagnostic, Diagnostics, Language, Severity};
pub use hsd_base::source::{FileId, NoFiles, Source, Span, World};
pub use hsd_driver::{Checked, Options, check};
#[cfg(feature = "models")]
pub use hsd_driver::{Compiled, compile, fs::FolderWorld};
#[cfg(feature = "models")]
pub use hsd_scene::Detail;
