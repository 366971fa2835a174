//! The part pictures of `examples/figure4.hsd` are drawn here, as cut-outs of a facade of the 1970s would
//! look after rectification (003-01). `HSD_UPDATE=1 cargo test --release figure4_pictures` writes them.
use image::{Rgb, RgbImage};
use std::{fs, io::Cursor, path::Path};

type Colour = [u8; 3];

const CONCRETE: Colour = [176, 171, 160];
const FRAME: Colour = [92, 94, 96];
const PANEL: Colour = [120, 134, 142];
const TILE: Colour = [142, 96, 74];

struct Drawing(RgbImage);

impl Drawing {
    fn new(width: u32, height: u32, ground: Colour) -> Drawing {
        let mut drawing = Drawing(RgbImage::new(width, height));
        drawing.fill(0, 0, width, height, ground);
        drawing
    }

    /// A rectangle with a little grain, as a photograph has.
    fn fill(&mut self, x0: u32, y0: u32, x1: u32, y1: u32, colour: Colour) {
        for y in y0..y1.min(self.0.height()) {
            for x in x0..x1.min(self.0.width()) {
                let grain = (grain(x, y) % 9) as i32 - 4;
                let pixel = colour.map(|c| (i32::from(c) + grain).clamp(0, 255) as u8);
                self.0.put_pixel(x, y, Rgb(pixel));
            }
        }
    }

    /// A pane: sky above, the street's far side below, in a dark frame.
    fn pane(&mut self, x0: u32, y0: u32, x1: u32, y1: u32, blind: u32) {
        self.fill(x0, y0, x1, y1, FRAME);
        for y in y0 + 4..y1 - 4 {
            let down = (y - y0) * 100 / (y1 - y0);
            let sky = [70 + down * 4 / 10, 96 + down * 5 / 10, 124 + down * 4 / 10];
            let far = [58, 66 + down / 8, 70];
            let c = if down < 62 { sky } else { far };
            self.fill(x0 + 4, y, x1 - 4, y + 1, c.map(|v| v.min(255) as u8));
        }
        let drawn = y0 + 4 + (y1 - y0 - 8) * blind / 100;
        for y in y0 + 4..drawn {
            let slat = if y % 5 == 0 {
                [168, 166, 154]
            } else {
                [206, 203, 190]
            };
            self.fill(x0 + 4, y, x1 - 4, y + 1, slat);
        }
    }

    fn png(&self) -> Vec<u8> {
        let mut bytes = Cursor::new(vec![]);
        self.0
            .write_to(&mut bytes, image::ImageFormat::Png)
            .unwrap();
        bytes.into_inner()
    }
}

fn grain(x: u32, y: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h ^ (h >> 13)
}

/// A bay of the ground floor: shop window, door or shutter over a tiled plinth.
fn ground(kind: u32) -> Drawing {
    let mut d = Drawing::new(160, 224, TILE);
    d.fill(0, 0, 160, 40, PANEL);
    match kind {
        2 => {
            d.pane(14, 52, 80, 224, 0);
            d.pane(80, 52, 146, 224, 0);
        }
        4 => {
            for y in (52..216).step_by(6) {
                d.fill(12, y, 148, y + 5, [150, 156, 158]);
                d.fill(12, y + 5, 148, y + 6, [96, 100, 104]);
            }
        }
        _ => d.pane(10, 52, 150, 196, if kind == 3 { 22 } else { 0 }),
    }
    d
}

/// A whole bay of a middle or top floor.
fn bay(blind: u32, cornice: bool) -> Drawing {
    let mut d = Drawing::new(160, 224, CONCRETE);
    if cornice {
        d.fill(0, 0, 160, 26, [150, 146, 138]);
        d.fill(0, 26, 160, 30, [88, 86, 82]);
    }
    d.pane(16, 46, 78, 150, blind);
    d.pane(82, 46, 144, 150, blind / 2);
    d.fill(10, 150, 150, 158, [196, 192, 182]);
    d
}

fn upper(blind: u32) -> Drawing {
    let mut d = Drawing::new(80, 112, CONCRETE);
    d.pane(4, 12, 76, 112, blind);
    d
}

fn lower(stained: bool) -> Drawing {
    let mut d = Drawing::new(80, 112, PANEL);
    d.fill(0, 0, 80, 6, FRAME);
    if stained {
        d.fill(30, 6, 34, 90, [104, 112, 114]);
    }
    d.fill(0, 100, 80, 112, CONCRETE);
    d
}

fn pictures() -> Vec<(String, Drawing)> {
    let mut all: Vec<(String, Drawing)> =
        (1..=4).map(|n| (format!("f1f1f{n}"), ground(n))).collect();
    all.push(("f1fkf1".into(), bay(0, false)));
    all.push(("f1fkf3".into(), bay(45, false)));
    for (n, blinds) in [(2, [0, 30, 60]), (4, [15, 80, 0])] {
        for (i, blind) in blinds.into_iter().enumerate() {
            all.push((format!("f1fkf{n}u{}", i + 1), upper(blind)));
            all.push((format!("f1fkf{n}l{}", i + 1), lower(i == 1)));
        }
    }
    all.extend((1..=4).map(|n| (format!("f1ftf{n}"), bay(n * 18 - 18, true))));
    all
}

#[test]
fn the_pictures_lie_beside_the_example() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/textures");
    for (name, drawing) in pictures() {
        let path = folder.join(format!("{name}.png"));
        if std::env::var_os("HSD_UPDATE").is_some() {
            fs::create_dir_all(&folder).unwrap();
            fs::write(&path, drawing.png()).unwrap();
        }
        let found = image::load_from_memory(&fs::read(&path).unwrap())
            .unwrap()
            .to_rgb8();
        assert_eq!(found, drawing.0, "{name}");
    }
}
