//! The boards of `examples/tea-shop.hsd` are painted here: three variants of one picture. `HSD_UPDATE=1 cargo test --release
//! tea_shop_pictures` writes them.
use image::{Rgb, RgbImage};
use std::{fs, io::Cursor, path::Path};

const WIDTH: i32 = 128;
const HEIGHT: i32 = 320;
const INK: [i32; 3] = [38, 32, 28];

/// What a board shows at a point that is so far from its middle, in half widths, up and to the right.
type Sign = fn(f64, f64) -> Option<[i32; 3]>;

/// A leaf: where two circles cover each other, with its midrib.
fn leaf(x: f64, y: f64) -> Option<[i32; 3]> {
    let inside = |middle: f64| (x - middle).hypot(y) < 1.15;
    let rib = x.abs() < 0.04;
    (inside(0.6) && inside(-0.6)).then_some(if rib { [206, 190, 140] } else { [62, 92, 48] })
}

/// A bowl under three threads of steam.
fn bowl(x: f64, y: f64) -> Option<[i32; 3]> {
    let bowl = y < 0.0 && x.hypot(y * 1.1) < 0.72;
    let foot = (-0.78..-0.6).contains(&y) && x.abs() < 0.3;
    let steam =
        (0.15..1.1).contains(&y) && [-0.3, 0.0, 0.3].iter().any(|m: &f64| (x - m).abs() < 0.045);
    match () {
        () if bowl || foot => Some([52, 74, 112]),
        () if steam => Some(INK),
        () => None,
    }
}

/// A ring round three dots.
fn crest(x: f64, y: f64) -> Option<[i32; 3]> {
    let ring = (0.62..0.76).contains(&x.hypot(y));
    let dots = [(0.0, 0.28), (-0.26, -0.16), (0.26, -0.16)];
    let dot = dots.iter().any(|(a, b)| (x - a).hypot(y - b) < 0.2);
    (ring || dot).then_some([134, 40, 32])
}

/// A board of cedar with a frame of ink and its sign in the upper half.
fn board(sign: Sign) -> RgbImage {
    RgbImage::from_fn(WIDTH as u32, HEIGHT as u32, |px, py| {
        let (px, py) = (px as i32, py as i32);
        let edge = px.min(WIDTH - 1 - px).min(py.min(HEIGHT - 1 - py));
        let grain = (px * px / 37 + py / 50 + (px * 7919 + py * 31) % 5) % 11;
        let wood = [186 - grain, 150 - grain, 104 - grain];
        let half = f64::from(WIDTH) / 2.0;
        let (x, y) = (
            f64::from(px) / half - 1.0,
            (f64::from(HEIGHT) * 0.42 - f64::from(py)) / half,
        );
        let colour = match edge {
            4..8 => INK,
            _ => sign(x, y).unwrap_or(wood),
        };
        Rgb(colour.map(|c| c.clamp(0, 255) as u8))
    })
}

#[test]
fn the_boards_lie_beside_the_example() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/textures");
    let signs: [Sign; 3] = [leaf, bowl, crest];
    for (number, sign) in (1..).zip(signs) {
        let (path, drawn) = (folder.join(format!("SIGN.{number}.png")), board(sign));
        if std::env::var_os("HSD_UPDATE").is_some() {
            let mut bytes = Cursor::new(vec![]);
            drawn.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
            fs::write(&path, bytes.into_inner()).unwrap();
        }
        let found = image::load_from_memory(&fs::read(&path).unwrap());
        assert_eq!(found.unwrap().to_rgb8(), drawn, "{number}");
    }
}
