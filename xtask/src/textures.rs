//! Draws the files of `textures/`, each from a formula.
//!
//! A surface is a function from a point to a height, a colour and a roughness; [`draw`] samples it and derives the normal
//! map from the heights, so colour and relief always agree. Every random number comes from an integer hash of a lattice
//! that closes on itself, hence the textures are seamless and the same bytes on every machine.
//!
//! Colour: JPEG, quality 85, 512 px. Normals: JPEG, quality 84, 512 px; a PNG of the same relief is four times as large.
//! Occlusion, roughness, metalness: PNG, 256 px. glTF 2.0 permits both formats.

mod color;
mod noise;
mod paint;
mod surface;
#[cfg(test)]
mod tests;

use hsd_scene::texture::{COLOR_SIZE, Packing, SURFACES, Surface, halve, jpeg, png};
use image::RgbImage;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use surface::{
    bamboo, boards, cement, clay, ground, plants, plaster, roof_tiles, sheet, shingles, thatch,
    timber, wall_tiles, weave,
};

/// Folder of the textures.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../textures");

/// Quality of colour files.
const COLOR_QUALITY: u8 = 85;

/// Quality of normal files. Relief as fine as gravel takes a third of a megabyte at 88.
const NORMAL_QUALITY: u8 = 84;

/// Textures of a surface: seamless in both axes, square. Its looks share the relief.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Maps {
    /// Base colour, sRGB, of each look.
    pub(crate) colors: Vec<RgbImage>,
    /// Unit normals in tangent space, OpenGL convention: red to the right, green up.
    pub(crate) normal: RgbImage,
    /// Red: occlusion, always 255. Green: roughness. Blue: metalness. Linear.
    pub(crate) orm: RgbImage,
}

/// Writes the files of all surfaces.
pub(crate) fn run(arguments: &[String], out: &mut impl Write) -> io::Result<ExitCode> {
    if !arguments.is_empty() {
        return Err(io::Error::other("`textures` takes no arguments"));
    }
    for surface in SURFACES {
        for (name, bytes) in encode(surface) {
            std::fs::write(Path::new(FOLDER).join(&name), bytes)?;
            writeln!(out, "{name}")?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Encodes the files of one surface as (file name, bytes): one colour map per look, then the normal map and the gloss map
/// that they share.
fn encode(surface: &Surface) -> Vec<(String, Vec<u8>)> {
    let maps = draw(surface, COLOR_SIZE);
    let colors = maps.colors.iter().zip(surface.looks);
    let mut files: Vec<_> = colors
        .map(|(color, look)| (look.color_file(), jpeg(color, COLOR_QUALITY)))
        .collect();
    files.push((surface.normal_file(), jpeg(&maps.normal, NORMAL_QUALITY)));
    files.push((surface.orm_file(), png(&halve(&maps.orm), Packing::Tight)));
    files
}

/// Draws the textures of a surface with `size` px per side, a colour map for each look.
fn draw(surface: &Surface, size: u32) -> Maps {
    let mut maps = painter(surface)(size);
    assert_eq!(maps.colors.len(), surface.looks.len(), "{}", surface.name);
    for (color, look) in maps.colors.iter_mut().zip(surface.looks) {
        if let Some(mean) = look.mean {
            paint::tone(color, color::hex(mean));
        }
    }
    maps
}

/// Returns the formula of a surface. It computes the textures before their mean colours are adjusted.
fn painter(surface: &Surface) -> fn(size: u32) -> Maps {
    match surface.name {
        "cedar" => timber::cedar,
        "plank" => timber::plank,
        "keyaki" => timber::keyaki,
        "boarding" => boards::boarding,
        "clapboard" => boards::clapboard,
        "charred" => boards::charred,
        "bamboo" => bamboo::bamboo,
        "plaster" => plaster::plaster,
        "black_plaster" => plaster::black_plaster,
        "clay" => clay::clay,
        "juraku" => clay::juraku,
        "mortar" => cement::mortar,
        "concrete" => cement::concrete,
        "namako" => wall_tiles::namako,
        "tile" => wall_tiles::tile,
        "kawara" => roof_tiles::kawara,
        "hongawara" => roof_tiles::hongawara,
        "noshi" => roof_tiles::noshi,
        "ibushi" => roof_tiles::ibushi,
        "board_roof" => shingles::board_roof,
        "kokera" => shingles::kokera,
        "bark" => shingles::bark,
        "thatch" => thatch::thatch,
        "seam_roof" => sheet::seam_roof,
        "paper" => weave::paper,
        "cloth" => weave::cloth,
        "tatami" => weave::tatami,
        "aluminium" => sheet::aluminium,
        "glass" => sheet::glass,
        "steel" => sheet::steel,
        "sheet" => sheet::sheet,
        "stone" => ground::stone,
        "gravel" => ground::gravel,
        "earth" => ground::earth,
        "doma" => ground::doma,
        "foliage" => plants::foliage,
        "rows" => plants::rows,
        "water" => ground::water,
        name => panic!("`{name}` has no formula"),
    }
}

/// Returns the width of one repeat of a surface, metres.
const fn metres(name: &str) -> f64 {
    let mut i = 0;
    while i < SURFACES.len() {
        if is_same(SURFACES[i].name.as_bytes(), name.as_bytes()) {
            return SURFACES[i].metres;
        }
        i += 1;
    }
    panic!("the table of surfaces lacks a name")
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}
