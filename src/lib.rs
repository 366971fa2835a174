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
//! roofs an outline. These and the types they take are the public interface. The modules below are public only to the
//! program, its tests, benchmarks and fuzz targets, which are crates of their own; they are hidden from this page and
//! follow no semantic versioning.
//!
//! | feature | adds |
//! |---|---|
//! | `maps` | readers of maps: features out of files |
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
//! verb modules. A noun uses no verb; a step uses its input, its output and the foundations. `tests/order.rs` holds
//! the sources to that. The core does no input or output: images and included files come through [`source::World`];
//! files are read by [`fs`] for the shells [`cli`], [`lsp`] and [`view`], and only [`cli`] prints.
//!
//! # Numbers
//!
//! Lengths are f64 until a back end writes f32. Plans are in U (3 shaku unless the house says otherwise) and exact on
//! quarter units; roofs are divided on integers. No platform sine, no iteration over hash maps: same input, same bytes.

#![cfg_attr(
    not(all(feature = "cli", feature = "lsp", feature = "view")),
    allow(dead_code)
)] // items that shells use

// Foundations.
#[doc(hidden)]
pub mod source;
#[doc(hidden)]
pub mod diagnostic;
#[doc(hidden)]
pub mod geometry;
#[cfg(any(feature = "drawings", feature = "maps"))]
#[doc(hidden)]
pub mod lettering;
#[doc(hidden)]
pub mod rng;
#[doc(hidden)]
pub mod catalog;
#[doc(hidden)]
pub mod material;
#[cfg(feature = "models")]
#[doc(hidden)]
pub mod texture;
#[doc(hidden)]
pub mod templates;
#[cfg(feature = "maps")]
#[doc(hidden)]
pub mod map;

// The chain.
#[doc(hidden)]
pub mod ast;
#[doc(hidden)]
pub mod parse;
#[doc(hidden)]
pub mod program;
#[doc(hidden)]
pub mod expand;
#[doc(hidden)]
pub mod building;
#[doc(hidden)]
pub mod lower;
#[doc(hidden)]
pub mod roof;
#[doc(hidden)]
pub mod fit;
#[cfg(feature = "models")]
#[doc(hidden)]
pub mod scene;
#[cfg(feature = "models")]
#[doc(hidden)]
pub mod tessellate;
#[doc(hidden)]
pub mod check;

// Around the chain.
#[cfg(feature = "models")]
#[doc(hidden)]
pub mod render;
#[doc(hidden)]
pub mod print;
#[cfg(feature = "models")]
#[doc(hidden)]
pub mod backend;
#[doc(hidden)]
pub mod driver;
#[cfg(all(feature = "maps", feature = "models"))]
#[doc(hidden)]
pub mod town;
#[cfg(all(feature = "maps", feature = "models"))]
#[doc(hidden)]
pub mod survey;
#[cfg(all(feature = "maps", feature = "models"))]
#[doc(hidden)]
pub mod tiles;
#[cfg(feature = "plans")]
#[doc(hidden)]
pub mod plan;
#[cfg(feature = "plans")]
#[doc(hidden)]
pub mod front;
#[cfg(any(feature = "plans", feature = "view"))]
#[doc(hidden)]
pub mod plan_file;
#[cfg(feature = "drawings")]
#[doc(hidden)]
pub mod drawing;
#[cfg(any(feature = "lsp", feature = "view"))]
#[doc(hidden)]
pub mod ide;

// Shells.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "models")]
#[doc(hidden)]
pub mod fs;
#[cfg(feature = "lsp")]
#[doc(hidden)]
pub mod lsp;
#[cfg(any(feature = "cli", feature = "view"))]
#[doc(hidden)]
pub mod report;
#[cfg(feature = "view")]
#[doc(hidden)]
pub mod view;

// The public interface.
mod facade;

pub use diagnostic::{Code, Diagnostic, Diagnostics, Language, Severity};
pub use driver::{Checked, Options, check};
#[cfg(feature = "models")]
pub use driver::{Compiled, compile};
pub use facade::*;
#[cfg(feature = "models")]
pub use fs::FolderWorld;
pub use glam;
#[cfg(feature = "models")]
pub use scene::Detail;
pub use source::{FileId, NoFiles, Source, Span, World};
