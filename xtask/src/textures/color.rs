//! Colours as three sRGB fractions, and functions to mix them.

/// Red, green, blue in 0..1, sRGB encoded; mixed in the encoded space, which is closer to perception.
pub(super) type Rgb = [f64; 3];

/// Converts a colour from its hexadecimal number, such as 0xF2EFE6.
pub(super) const fn hex(number: u32) -> Rgb {
    [
        ((number >> 16) & 255) as f64 / 255.0,
        ((number >> 8) & 255) as f64 / 255.0,
        (number & 255) as f64 / 255.0,
    ]
}

/// Interpolates from `a` at `t` = 0 to `b` at `t` = 1; `t` is clamped.
pub(super) fn mix(a: Rgb, b: Rgb, t: f64) -> Rgb {
    let t = t.clamp(0.0, 1.0);
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t)
}

/// Multiplies a colour by a factor.
pub(super) fn scale(color: Rgb, factor: f64) -> Rgb {
    color.map(|channel| channel * factor)
}

/// Returns the colour at `t` in 0..1 of evenly spaced stops.
pub(super) fn ramp(stops: &[Rgb], t: f64) -> Rgb {
    let last = stops.len() - 1;
    let at = t.clamp(0.0, 1.0) * last as f64;
    let low = (at as usize).min(last - 1);
    mix(stops[low], stops[low + 1], at - low as f64)
}

/// Hermite step: 0 below `low`, 1 above `high`, smooth between.
pub(super) fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns the share of a pixel that a line covers: `distance` from its middle, `width` and `pixel` in one unit. A line
/// thinner than a pixel gets paler instead of broken.
pub(super) fn line(distance: f64, width: f64, pixel: f64) -> f64 {
    let half = width.max(pixel) / 2.0;
    let inside = 1.0 - smooth(half - pixel / 2.0, half + pixel / 2.0, distance.abs());
    inside * (width / pixel).min(1.0)
}

/// Returns the share of light at `at` on a course of this length, 0 at its foot, 1 where the next course overlaps it
/// and casts its shadow. The edge between the two is one pixel soft.
pub(super) fn lap_light(at: f64, length: f64, pixel: f64) -> f64 {
    let over = if at < 0.5 {
        at * length
    } else {
        (at - 1.0) * length
    };
    let below = (-over).max(0.0);
    let core = 1.0 - smooth(0.005, 0.014, below);
    let fringe = 1.0 - smooth(0.010, 0.060, below);
    let shadow = (1.0 - 0.80 * core) * (1.0 - 0.28 * fringe);
    shadow + (1.0 - shadow) * smooth(-0.7 * pixel, 0.7 * pixel, over)
}
