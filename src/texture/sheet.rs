//! Rolled and drawn materials of later fronts: aluminium, painted steel, glass.

use super::Maps;
use super::cells::row;
use super::color::{hex, mix, ramp, scale, smooth};
use super::noise::{fbm, noise};
use super::paint::{Hollows, Spot, Texel, paint};

/// One metre.
pub(super) const ALUMINIUM: f64 = 1.0;
/// Two metres: a pane should not show its repeat.
pub(super) const GLASS: f64 = 2.0;
/// Twelve slats of 75 mm.
pub(super) const STEEL: f64 = 0.9;

const FLAT: Hollows = Hollows::new(0.01, 0.0);

/// Anodised aluminium, drawn along `v`.
pub(super) fn aluminium(size: u32) -> Maps {
    paint(size, ALUMINIUM, FLAT, aluminium_at)
}

/// One spot of [`aluminium`].
fn aluminium_at(spot: Spot) -> Texel {
    let drawn = fbm(spot.u, spot.v, (60, 1), 3, 601);
    let haze = fbm(spot.u, spot.v, (3, 3), 4, 602);
    Texel {
        height: 0.000_02 * drawn,
        color: scale(hex(0xC4_C6C8), 0.97 + 0.035 * drawn + 0.03 * haze),
        rough: 0.36 + 0.06 * drawn + 0.06 * haze,
        metal: 1.0,
    }
}

/// Float glass before a dark room: an almost even, deep blue grey, faintly wavy.
pub(super) fn glass(size: u32) -> Maps {
    paint(size, GLASS, FLAT, glass_at)
}

/// One spot of [`glass`].
fn glass_at(spot: Spot) -> Texel {
    let wave = fbm(spot.u, spot.v, (3, 2), 2, 611);
    let dust = fbm(spot.u, spot.v, (6, 6), 4, 612);
    Texel {
        height: 0.0012 * wave,
        color: scale(
            mix(hex(0x2E_3C44), hex(0x3A_4A52), 0.5 + 0.5 * wave),
            1.0 + 0.05 * dust,
        ),
        rough: 0.07 + 0.03 * dust.max(0.0),
        metal: 0.0,
    }
}

/// Painted steel sheet, ribbed level like a roller shutter; rust begins in the grooves.
pub(super) fn steel(size: u32) -> Maps {
    paint(size, STEEL, Hollows::new(0.008, 45.0), steel_at)
}

/// One spot of [`steel`].
fn steel_at(spot: Spot) -> Texel {
    let slat = row(spot.v, 12);
    let y = 2.0 * slat.at - 1.0;
    let groove = smooth(0.80, 0.92, y.abs());
    let crown = 0.0035 * (1.0 - y * y) - 0.003 * groove;
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 621);
    let runs = fbm(spot.u, spot.v, (34, 2), 3, 622);
    let flakes = fbm(spot.u, spot.v, (26, 26), 4, 623);
    let rust = smooth(0.46, 0.70, flakes + 0.20 * groove + 0.20 * runs);
    let paint_color = scale(
        hex(0xA3_ACA8),
        0.98 + 0.05 * wide - 0.06 * runs.max(0.0) - 0.18 * groove,
    );
    let oxide = ramp(&[hex(0x5A_3420), hex(0x8A_5230)], 0.5 + flakes);
    Texel {
        height: crown - 0.0002 * rust + 0.000_03 * noise(spot.u, spot.v, (160, 160), 624),
        color: mix(paint_color, oxide, 0.85 * rust),
        rough: 0.42 + 0.45 * rust + 0.05 * wide,
        metal: 0.0,
    }
}
