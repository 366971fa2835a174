//! All tests of the program as one, which is compiled and linked once: `cargo test --release roof_shapes` runs those of a file.

#![allow(missing_docs, unreachable_pub)] // modules of one program
#![allow(clippy::unwrap_used)] // a test that panics has failed
#![allow(clippy::print_stdout, clippy::print_stderr)] // for those who read along with `--nocapture`

mod support;

mod age;
mod backend;
mod bake;
mod catalog;
mod catalogs;
mod cityjson;
mod cli;
mod citations;
mod close_by;
mod company;
mod convert;
mod coplanar;
mod corpus;
mod data;
mod detail;
mod determinism;
mod diagnostics;
mod drawings;
mod divided;
mod draws;
mod examples;
mod expand;
mod figure4_pictures;
mod fixtures;
mod ide;
mod joined;
mod fronts;
mod ground;
mod heights;
mod joins;
mod language;
mod law;
mod legacy_grammar;
mod light;
mod lsp;
mod first_towns;
mod fixes;
mod many_monuments;
mod maps;
mod mistakes;
mod monuments;
mod order;
mod outdoors;
mod outlines;
mod outputs;
mod parts;
mod parts_fittings;
mod parts_windows;
mod pictures;
mod pieces;
mod places;
mod plan_drawings;
mod plan_round;
mod plain_roofs;
mod plan_vectors;
mod plans;
mod published;
mod random_towns;
mod readme;
mod real_outlines;
mod real_roofs;
mod real_tags;
mod real_towns;
mod rears;
mod robust;
mod rooms;
mod roof_gallery;
mod roof_partition;
mod roof_shapes;
mod schema;
mod sheets;
mod see_through;
mod seen;
mod sheet;
mod silhouettes;
mod stairs;
mod streams;
mod tea_shop_pictures;
mod tessellate;
mod tiles;
mod town_accounts;
mod town_types;
mod town_texts;
mod town_grounds;
mod town_land;
mod town_law;
mod town_streets;
mod town_works;
mod towns;
mod tutorial;
mod twins;
mod types;
mod variants;
mod vertices;
mod view;
mod w3c;
mod xml_bombs;

// As the program does.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;
