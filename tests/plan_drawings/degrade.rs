//! What happens to a drawing on its way to a file: a scanner or a camera, with the map from old pixels to new ones.

use super::paint::Clouds;
use super::rng::Rng;
use image::codecs::jpeg::JpegEncoder;
use image::{Rgb, RgbImage};

/// A projective map of the plane, nine numbers by rows.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Homography(pub [f64; 9]);

impl Homography {
    /// The map that moves nothing.
    pub const SAME: Self = Self([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);

    /// Where a place goes.
    pub fn apply(&self, x: f64, y: f64) -> (f64, f64) {
        let m = &self.0;
        let w = m[6] * x + m[7] * y + m[8];
        (
            (m[0] * x + m[1] * y + m[2]) / w,
            (m[3] * x + m[4] * y + m[5]) / w,
        )
    }

    /// First this one, then the other.
    pub fn then(&self, other: &Self) -> Self {
        let (p, q) = (&other.0, &self.0);
        let mut out = [0.0; 9];
        for (k, cell) in out.iter_mut().enumerate() {
            let (row, column) = (k / 3 * 3, k % 3);
            *cell = (0..3).map(|i| p[row + i] * q[i * 3 + column]).sum();
        }
        Self(out)
    }

    /// The way back.
    pub fn inverse(&self) -> Self {
        let m = &self.0;
        let minor = |a: usize, b: usize, c: usize, d: usize| m[a] * m[d] - m[b] * m[c];
        let adjugate = [
            minor(4, 5, 7, 8),
            -minor(1, 2, 7, 8),
            minor(1, 2, 4, 5),
            -minor(3, 5, 6, 8),
            minor(0, 2, 6, 8),
            -minor(0, 2, 3, 5),
            minor(3, 4, 6, 7),
            -minor(0, 1, 6, 7),
            minor(0, 1, 3, 4),
        ];
        let scale = if adjugate[8].abs() > 1e-12 {
            adjugate[8]
        } else {
            1.0
        };
        Self(adjugate.map(|v| v / scale))
    }

    /// The map that takes the corners of `w` x `h` (clockwise from the upper left) to four places.
    pub fn to_corners(w: f64, h: f64, c: [(f64, f64); 4]) -> Self {
        let (dx1, dy1) = (c[1].0 - c[2].0, c[1].1 - c[2].1);
        let (dx2, dy2) = (c[3].0 - c[2].0, c[3].1 - c[2].1);
        let (sx, sy) = (
            c[0].0 - c[1].0 + c[2].0 - c[3].0,
            c[0].1 - c[1].1 + c[2].1 - c[3].1,
        );
        let det = dx1 * dy2 - dx2 * dy1;
        let (g, k) = ((sx * dy2 - dx2 * sy) / det, (dx1 * sy - sx * dy1) / det);
        let square = Self([
            c[1].0 - c[0].0 + g * c[1].0,
            c[3].0 - c[0].0 + k * c[3].0,
            c[0].0,
            c[1].1 - c[0].1 + g * c[1].1,
            c[3].1 - c[0].1 + k * c[3].1,
            c[0].1,
            g,
            k,
            1.0,
        ]);
        Self([1.0 / w, 0.0, 0.0, 0.0, 1.0 / h, 0.0, 0.0, 0.0, 1.0]).then(&square)
    }
}

/// How a drawing came to its file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Degradation {
    /// As drawn.
    Clean,
    /// On a scanner: skew, uneven tone, blur, noise, ghost, stains, JPEG.
    Scanned,
    /// With a camera on a table: perspective, falling light, blur, noise, JPEG.
    Photographed,
}

/// The worn picture, and where its old pixels went.
pub fn degrade(picture: RgbImage, degradation: Degradation, seed: u64) -> (RgbImage, Homography) {
    let mut rng = Rng::new(seed, 31);
    match degradation {
        Degradation::Clean => (picture, Homography::SAME),
        Degradation::Scanned => scanned(picture, &mut rng),
        Degradation::Photographed => photographed(&picture, &mut rng),
    }
}

fn scanned(mut picture: RgbImage, rng: &mut Rng) -> (RgbImage, Homography) {
    if rng.chance(0.4) {
        ghost(&mut picture, rng.between(0.04, 0.12));
    }
    for _ in 0..rng.whole(0, 4) {
        stain(&mut picture, rng);
    }
    let (w, h) = picture.dimensions();
    let (fw, fh) = (f64::from(w), f64::from(h));
    let turn =
        f64::from(rng.between(-5.0, 5.0) * if rng.chance(0.5) { 1.0 } else { 0.4 }).to_radians();
    let (cos, sin) = (turn.cos(), turn.sin());
    let (cx, cy) = (fw / 2.0, fh / 2.0);
    let map = Homography([
        cos,
        -sin,
        cx - cos * cx + sin * cy,
        sin,
        cos,
        cy - sin * cx - cos * cy,
        0.0,
        0.0,
        1.0,
    ]);
    let ground = rng.pick(&[
        [250, 250, 248],
        [232, 230, 226],
        [40, 38, 38],
        [252, 252, 252],
    ]);
    let mut out = warp(&picture, &map, (w, h), |_, _| Rgb(ground));
    finish(&mut out, rng, (0.0, 0.09), (2.0, 9.0));
    (out, map)
}

fn photographed(picture: &RgbImage, rng: &mut Rng) -> (RgbImage, Homography) {
    let (w, h) = (f64::from(picture.width()), f64::from(picture.height()));
    let edge = f64::from(rng.between(0.04, 0.1)) * w.min(h);
    let strength = rng.between(0.3, 1.0);
    let mut off = |size: f64| size * 0.12 * f64::from(rng.unit() * strength) + edge;
    let (fw, fh) = (w + 2.0 * edge, h + 2.0 * edge);
    let corners = [
        (off(w), off(h)),
        (fw - off(w), off(h)),
        (fw - off(w), fh - off(h)),
        (off(w), fh - off(h)),
    ];
    let map = Homography::to_corners(w, h, corners);
    let clouds = Clouds::new(rng);
    let base = rng.pick(&[
        [58.0, 44.0, 36.0],
        [70.0, 72.0, 76.0],
        [40.0, 52.0, 46.0],
        [92.0, 70.0, 50.0],
    ]);
    let table = |x: u32, y: u32| {
        let k = 1.0
            + 0.12 * clouds.at(x as f32 * 0.012, y as f32 * 0.15)
            + 0.06 * clouds.at(x as f32 * 0.7, y as f32 * 0.7);
        Rgb(base.map(|c: f32| (c * k) as u8))
    };
    let mut out = warp(picture, &map, (fw as u32, fh as u32), table);
    finish(&mut out, rng, (0.15, 0.45), (3.0, 10.0));
    (out, map)
}

/// Draw a picture through a map, bilinear, over a ground.
fn warp(
    picture: &RgbImage,
    map: &Homography,
    size: (u32, u32),
    ground: impl Fn(u32, u32) -> Rgb<u8>,
) -> RgbImage {
    let back = map.inverse();
    let (w, h) = picture.dimensions();
    RgbImage::from_fn(size.0, size.1, |x, y| {
        let (sx, sy) = back.apply(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let (sx, sy) = (sx as f32 - 0.5, sy as f32 - 0.5);
        if sx < 0.0 || sy < 0.0 || sx >= (w - 1) as f32 || sy >= (h - 1) as f32 {
            return ground(x, y);
        }
        let (x0, y0) = (sx as u32, sy as u32);
        let (tx, ty) = (sx - x0 as f32, sy - y0 as f32);
        let get = |dx: u32, dy: u32, k: usize| f32::from(picture.get_pixel(x0 + dx, y0 + dy).0[k]);
        Rgb([0, 1, 2].map(|k| {
            let top = get(0, 0, k) * (1.0 - tx) + get(1, 0, k) * tx;
            let low = get(0, 1, k) * (1.0 - tx) + get(1, 1, k) * tx;
            (top * (1.0 - ty) + low * ty) as u8
        }))
    })
}

/// The back of the sheet shows through, mirrored.
fn ghost(picture: &mut RgbImage, share: f32) {
    let other = picture.clone();
    let w = picture.width();
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let behind = other.get_pixel(w - 1 - x, y);
        for (value, back) in pixel.0.iter_mut().zip(behind.0) {
            *value = (f32::from(*value) * (1.0 - share * (1.0 - f32::from(back) / 255.0))) as u8;
        }
    }
}

/// A brown stain with a darker rim.
fn stain(picture: &mut RgbImage, rng: &mut Rng) {
    let (w, h) = picture.dimensions();
    let (cx, cy) = (rng.unit() * w as f32, rng.unit() * h as f32);
    let radius = rng.between(0.03, 0.14) * w.min(h) as f32;
    let depth = rng.between(0.06, 0.2);
    let clouds = Clouds::new(rng);
    let low = |c: f32| (c - radius * 1.4).max(0.0) as u32;
    for y in low(cy)..((cy + radius * 1.4) as u32).min(h) {
        for x in low(cx)..((cx + radius * 1.4) as u32).min(w) {
            let (dx, dy) = (x as f32 - cx, y as f32 - cy);
            let r = dx.hypot(dy) / radius
                + 0.2 * clouds.at(x as f32 / radius * 3.0, y as f32 / radius * 3.0);
            if r < 1.0 {
                let dark = depth * (0.5 + 0.5 * r.powi(6));
                for (value, share) in picture
                    .get_pixel_mut(x, y)
                    .0
                    .iter_mut()
                    .zip([0.6, 1.0, 1.6])
                {
                    *value = (f32::from(*value) * (1.0 - dark * share)) as u8;
                }
            }
        }
    }
}

/// Light that falls off, blur, noise, salt and pepper, JPEG.
fn finish(picture: &mut RgbImage, rng: &mut Rng, fall: (f32, f32), grain: (f32, f32)) {
    let blur = rng.between(0.4, 1.3);
    *picture = image::imageops::fast_blur(picture, blur);
    let (w, h) = picture.dimensions();
    let turn = rng.between(0.0, std::f32::consts::TAU);
    let (fall, grain) = (rng.between(fall.0, fall.1), rng.between(grain.0, grain.1));
    let salt = rng.between(0.0, 0.0016);
    let (dx, dy) = (turn.cos(), turn.sin());
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let t = (x as f32 / w as f32 - 0.5) * dx + (y as f32 / h as f32 - 0.5) * dy;
        let light = 1.0 - fall * (t + 0.5).clamp(0.0, 1.0);
        let speck = rng.unit();
        let noise = rng.bell() * grain;
        for value in &mut pixel.0 {
            *value = (f32::from(*value) * light + noise).clamp(0.0, 255.0) as u8;
        }
        if speck < salt {
            pixel.0 = [if speck < salt / 2.0 { 20 } else { 250 }; 3];
        }
    }
    let mut bytes = Vec::new();
    let quality = rng.whole(60, 90) as u8;
    JpegEncoder::new_with_quality(&mut bytes, quality)
        .encode_image(&*picture)
        .expect("a picture has a JPEG");
    *picture = image::load_from_memory(&bytes)
        .expect("what was written can be read")
        .to_rgb8();
}
