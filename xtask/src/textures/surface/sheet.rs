//! Rolled and drawn materials of later fronts: aluminium, glass, painted steel.

use crate::textures::color::{Rgb, hex, line, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::row;
use crate::textures::surface::plaster::runs;
use crate::textures::{Maps, metres};

/// One metre.
const ALUMINIUM: f64 = metres("aluminium");
/// Two metres: a pane should not show its repeat.
const GLASS: f64 = metres("glass");
/// Twelve slats of 75 mm.
const STEEL: f64 = metres("steel");
/// One bay.
const SHEET: f64 = metres("sheet");
/// Two strips of 455 mm (1.5 shaku) between standing seams.
const SEAM_ROOF: f64 = metres("seam_roof");

const FLAT: Hollows = Hollows::new(0.01, 0.0);

/// Anodised aluminium, drawn along `v`: silver, bronze, silver with dirty runs.
pub(in crate::textures) fn aluminium(size: u32) -> Maps {
    paint(size, ALUMINIUM, FLAT, aluminium_at)
}

/// One spot of [`aluminium`].
fn aluminium_at(spot: Spot) -> Texel<3> {
    let drawn = fbm(spot.u, spot.v, (60, 1), 3, 601);
    let haze = fbm(spot.u, spot.v, (3, 3), 4, 602);
    let light = 0.97 + 0.035 * drawn + 0.03 * haze;
    let silver = scale(hex(0xC4_C6C8), light);
    Texel {
        height: 0.000_02 * drawn,
        colors: [
            silver,
            scale(hex(0x6E_5E4E), light),
            mix(silver, hex(0x74_726C), 0.25 + 0.45 * runs(spot, 603)),
        ],
        rough: 0.36 + 0.06 * drawn + 0.06 * haze,
        metal: 1.0,
    }
}

/// Float glass, faintly wavy: clear before a dark room, blue grey with a mirror coat, dusty.
pub(in crate::textures) fn glass(size: u32) -> Maps {
    paint(size, GLASS, FLAT, glass_at)
}

/// One spot of [`glass`].
fn glass_at(spot: Spot) -> Texel<3> {
    let wave = fbm(spot.u, spot.v, (3, 2), 2, 611);
    let dust = fbm(spot.u, spot.v, (6, 6), 4, 612);
    let light = 1.0 + 0.05 * dust;
    let clear = scale(mix(hex(0x2E_3C44), hex(0x3A_4A52), 0.5 + 0.5 * wave), light);
    Texel {
        height: 0.0012 * wave,
        colors: [
            clear,
            scale(mix(hex(0x7C_96A4), hex(0x8A_A2AC), 0.5 + 0.5 * wave), light),
            mix(
                clear,
                hex(0x8C_8A80),
                0.20 + 0.35 * runs(spot, 613) + 0.1 * dust,
            ),
        ],
        rough: 0.07 + 0.03 * dust.max(0.0),
        metal: 0.0,
    }
}

/// Returns how far rust has eaten paint (0..1) and its colour; `wet` is higher where water collects.
fn rust(spot: Spot, wet: f64, seed: u32) -> (f64, Rgb) {
    let flakes =
        fbm(spot.u, spot.v, (26, 26), 4, seed) + 0.35 * fbm(spot.u, spot.v, (34, 2), 3, seed + 4);
    let eaten = smooth(0.30, 0.56, flakes + wet);
    (
        eaten,
        ramp(
            &[hex(0x4E_2C1C), hex(0x7C_4626), hex(0x96_6038)],
            0.5 + flakes,
        ),
    )
}

/// Painted horizontal steel slats, as of a roller shutter: sound, and rusting from the grooves.
pub(in crate::textures) fn steel(size: u32) -> Maps {
    paint(size, STEEL, Hollows::new(0.008, 45.0), steel_at)
}

/// One spot of [`steel`].
fn steel_at(spot: Spot) -> Texel<2> {
    let slat = row(spot.v, 12);
    let y = 2.0 * slat.at - 1.0;
    let groove = smooth(0.80, 0.92, y.abs());
    let crown = 0.0035 * (1.0 - y * y) - 0.003 * groove;
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 621);
    let dirt = runs(spot, 622);
    let (eaten, oxide) = rust(spot, 0.20 * groove, 626);
    let paint_color = scale(hex(0xA8_AEAA), 0.99 + 0.05 * wide - 0.18 * groove);
    let dull = mix(paint_color, hex(0x7C_766A), 0.35 * dirt);
    Texel {
        height: crown + 0.000_03 * noise(spot.u, spot.v, (160, 160), 624),
        colors: [paint_color, mix(dull, oxide, 0.85 * eaten)],
        rough: 0.45 + 0.05 * wide,
        metal: 0.0,
    }
}

/// Flat painted sheet, as of a signboard, pale so that it can be tinted: sound, and rusting.
pub(in crate::textures) fn sheet(size: u32) -> Maps {
    paint(size, SHEET, Hollows::new(0.008, 10.0), sheet_at)
}

/// One spot of [`sheet`].
fn sheet_at(spot: Spot) -> Texel<2> {
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 631);
    let brush = fbm(spot.u, spot.v, (50, 2), 3, 632);
    let dirt = runs(spot, 633);
    let (eaten, oxide) = rust(spot, -0.12, 636);
    let face = scale(hex(0xE0_DED6), 0.98 + 0.03 * wide + 0.015 * brush);
    let dull = mix(face, hex(0x9A_9486), 0.15 + 0.45 * dirt);
    Texel {
        height: 0.0008 * wide + 0.000_03 * brush,
        colors: [face, mix(dull, oxide, 0.9 * eaten)],
        rough: 0.42 + 0.05 * wide,
        metal: 0.0,
    }
}

/// Sheet roof: strips up the slope, their edges folded into standing seams; `v` points up the slope.
pub(in crate::textures) fn seam_roof(size: u32) -> Maps {
    paint(size, SEAM_ROOF, Hollows::new(0.012, 25.0), seam_roof_at)
}

/// One spot of [`seam_roof`].
fn seam_roof_at(spot: Spot) -> Texel<2> {
    let strip = row(spot.u + 0.25, 2);
    let off = strip.edge() * SEAM_ROOF;
    let seam = 1.0 - smooth(0.006, 0.010, off);
    let shade = 1.0 - smooth(0.010, 0.030, off);
    // Sheets are hooked into each other every bay, never at one height with the neighbour.
    let lap = row(spot.v + 0.2 + 0.37 * strip.index as f64, 1);
    let fold = line(lap.edge() * SEAM_ROOF, 0.006, spot.pixel);
    let dent = fbm(spot.u, spot.v, (5, 4), 3, 641);
    let dirt = runs(spot, 642);
    let (eaten, oxide) = rust(spot, 0.22 * shade - 0.04, 646);
    let face = scale(
        hex(0x6E_7478),
        1.0 + 0.05 * dent + 0.10 * seam - 0.30 * shade * (1.0 - seam) - 0.35 * fold,
    );
    let dull = mix(face, hex(0x5C_564C), 0.3 + 0.3 * dirt);
    Texel {
        height: 0.024 * seam + 0.002 * dent - 0.003 * fold,
        colors: [face, mix(dull, oxide, 0.9 * eaten)],
        rough: 0.48 + 0.06 * dent,
        metal: 0.0,
    }
}
