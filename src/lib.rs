//! A compiler for houses: a text says which doors, walls and windows stand side by side, where the wall turns and
//! where the next storey begins; out comes a textured model with its roof worked out. The language is described in
//! `grammar/README.md`.
//!
//! # The chain
//!
//! Each step is a plain function from one typed tree to the next. It takes what is wrong as it comes, says so to
//! [`Diagnostics`](diagnostic::Diagnostics), and goes on; none panics. [`compile`] runs them all.
//!
//! | step | makes | what no longer exists after it |
//! |---|---|---|
//! | [`Source::new`](source::Source::new) | [`Source`](source::Source) | encodings; spans count bytes of the original file ever after |
//! | [`parse::parse`] | [`ast::Document`] | syntax: the legacy text and XML give one tree; expressions, parameters, conditions, named pieces, included files |
//! | [`expand::expand`] | [`program::Program`] | repeat, split lists, random, replace, unknown codes, defaults |
//! | [`lower::lower`] | [`building::Shell`] | turns and rows: every wall has two ends |
//! | [`roof::roof`] | [`building::Building`] | open tops: regions cover every uncovered area once, solids lie over them |
//! | [`fit::fit`] | [`building::Building`] | platforms, verandas, brackets and finials without a place |
//! | [`tessellate::tessellate`] | [`scene::Scene`] | part codes and plans: meshes, materials, a tree of nodes |
//! | [`backend`] | bytes | |
//!
//! [`mod@print`] goes the other way: a text laid out anew, or in the other form of the language.
//!
//! # Nouns and verbs
//!
//! The trees between the steps are noun modules: data, small accessors, invariants in their headers. The steps are
//! verb modules. A noun uses no verb; a step uses its input, its output and the foundations. `tests/order.rs` holds
//! the sources to that. The core does no input or output: pictures and included texts come through [`source::World`];
//! files are read by [`fs`] for the shells [`cli`], [`lsp`] and [`view`], and only [`cli`] prints.
//!
//! # Numbers
//!
//! Lengths are f64 until a back end writes f32. Plans are in U (3 shaku unless the house says otherwise) and exact on
//! quarter units; roofs are divided on integers. No platform sine, no iteration over hash maps: same input, same bytes.

// Foundations.
pub mod source;
pub mod diagnostic;
pub mod geometry;
pub mod rng;
pub mod catalog;
pub mod material;
pub mod texture;
pub mod templates;

// The chain.
pub mod ast;
pub mod parse;
pub mod program;
pub mod expand;
pub mod building;
pub mod lower;
pub mod roof;
pub mod fit;
pub mod scene;
pub mod tessellate;
pub mod check;

// Around the chain.
pub mod render;
pub mod print;
pub mod backend;
pub mod driver;
pub mod ide;

// Shells.
pub mod cli;
pub mod fs;
pub mod lsp;
pub mod report;
pub mod view;

pub use driver::{Compiled, Options, compile, compile_bytes};
