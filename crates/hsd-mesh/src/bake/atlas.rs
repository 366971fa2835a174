//! Packs baked images onto square pages, so that many parts need few materials.

use crate::bake::Picture;
use hsd_scene::Baked;
use hsd_scene::texture::{Packing, jpeg, png};
use image::{ImageBuffer, Pixel, RgbImage, RgbaImage};

/// An image of bytes.
type Map<P> = ImageBuffer<P, Vec<u8>>;

/// Side of a page, pixels.
const SIDE: u32 = 1024;

/// Pixels around an image that repeat its border, so that neighbours do not bleed in at smaller mip levels.
const MARGIN: u32 = 4;

/// The place of an image in the atlas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot {
    /// Index of the page.
    pub(crate) page: u32,
    /// Its lower left and upper right corner, 0 to 1, v upwards.
    pub(crate) uv: [[f32; 2]; 2],
}

/// Pages that still take images, for each of the two kinds. Older ones are encoded, so that the memory of a town does not
/// grow by all its pixels.
const OPEN: usize = 4;

/// The pages of opaque images and those of images with holes.
#[derive(Debug, Default)]
pub(crate) struct Atlas {
    pages: Vec<Page>,
    /// The shelves of pages that still take images.
    shelves: Vec<Shelf>,
    /// True if only colours are kept.
    pub(crate) flat: bool,
}

/// A page and its content so far.
#[derive(Debug)]
struct Page {
    holes: bool,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Open(Box<Pixels>),
    /// Its files are being made.
    Closing,
    /// The files, and the factor by which distances from the upper edge grow in texture coordinates.
    Closed(Baked, f32),
}

/// The pixels of a page.
#[derive(Debug)]
struct Pixels {
    color: RgbaImage,
    /// Normals, and occlusion with roughness and metalness; none of a flat page.
    relief: Option<[RgbImage; 2]>,
}

impl Pixels {
    fn new(flat: bool) -> Pixels {
        let maps = [[128, 128, 255], [255, 255, 0]];
        let map = |empty| RgbImage::from_pixel(SIDE, SIDE, image::Rgb(empty));
        Pixels {
            color: RgbaImage::new(SIDE, SIDE),
            relief: (!flat).then(|| maps.map(map)),
        }
    }

    /// Encodes the page down to a row, its maps at the same time; only the colours if it is flat.
    fn encode(self, used: u32, holes: bool) -> Baked {
        let color = cut(self.color, used);
        let relief = self.relief.map(|maps| maps.map(|map| cut(map, used)));
        let color = move || match holes {
            true => png(&color, Packing::Quickest),
            false => jpeg(&opaque(color), 90),
        };
        let relief = move || match relief {
            None => (vec![], vec![]),
            Some([normal, orm]) => {
                rayon::join(|| jpeg(&normal, 92), || png(&orm, Packing::Quickest))
            }
        };
        let (color, (normal, orm)) = rayon::join(color, relief);
        Baked {
            color: color.into(),
            normal: normal.into(),
            orm: orm.into(),
            holes,
        }
    }
}

/// Returns the upper rows of an image.
fn cut<P: Pixel<Subpixel = u8>>(image: Map<P>, rows: u32) -> Map<P> {
    let width = image.width();
    let mut bytes = image.into_raw();
    bytes.truncate(width as usize * rows as usize * usize::from(P::CHANNEL_COUNT));
    ImageBuffer::from_raw(width, rows, bytes).expect("has as many bytes as pixels")
}

/// Returns the colours of an image, in its own memory.
fn opaque(image: RgbaImage) -> RgbImage {
    let (width, height) = image.dimensions();
    let mut bytes = image.into_raw();
    let pixels = bytes.len() / 4;
    for pixel in 0..pixels {
        let [r, g, b] = [0, 1, 2].map(|channel| bytes[4 * pixel + channel]);
        bytes[3 * pixel..3 * pixel + 3].copy_from_slice(&[r, g, b]);
    }
    bytes.truncate(3 * pixels);
    RgbImage::from_raw(width, height, bytes).expect("has three bytes a pixel")
}

/// Copies an image to a place on a page. Its edge goes on into the margin.
fn copy<P: Pixel<Subpixel = u8>>(from: &Map<P>, to: &mut Map<P>, (x, y): (u32, u32)) {
    let channels = usize::from(P::CHANNEL_COUNT);
    let (w, h) = (from.width() as usize, from.height());
    let row_bytes = to.width() as usize * channels;
    let margin = MARGIN as usize * channels;
    for v in 0..h + 2 * MARGIN {
        let own = v.saturating_sub(MARGIN).min(h - 1) as usize * w * channels;
        let own = &from.as_raw()[own..own + w * channels];
        let start = (y + v) as usize * row_bytes + x as usize * channels;
        let page: &mut [u8] = to;
        let row = &mut page[start..start + own.len() + 2 * margin];
        row[margin..margin + own.len()].copy_from_slice(own);
        let (first, last) = (&own[..channels], &own[own.len() - channels..]);
        for pixel in row[..margin].chunks_exact_mut(channels) {
            pixel.copy_from_slice(first);
        }
        for pixel in row[margin + own.len()..].chunks_exact_mut(channels) {
            pixel.copy_from_slice(last);
        }
    }
}

/// A row of images on a page.
#[derive(Debug)]
struct Shelf {
    page: u32,
    holes: bool,
    foot: u32,
    height: u32,
    used: u32,
}

impl Atlas {
    /// Places an image on a page that has room for it.
    pub(crate) fn place(&mut self, picture: &Picture) -> Spot {
        let (w, h) = picture.color.dimensions();
        let (x, y, page) = self.room(w + 2 * MARGIN, h + 2 * MARGIN, picture.holes);
        let Content::Open(pixels) = &mut self.pages[page as usize].content else {
            unreachable!("shelves are on open pages");
        };
        copy(&picture.color, &mut pixels.color, (x, y));
        if let Some([normal, orm]) = &mut pixels.relief {
            copy(&picture.normal, normal, (x, y));
            copy(&picture.orm, orm, (x, y));
        }
        let share = |t: u32| t as f32 / SIDE as f32;
        let (x, y) = (x + MARGIN, y + MARGIN);
        Spot {
            page,
            uv: [
                [share(x), 1.0 - share(y + h)],
                [share(x + w), 1.0 - share(y)],
            ],
        }
    }

    /// Returns true if the images of a page have holes.
    pub(crate) fn has_holes(&self, page: u32) -> bool {
        self.pages[page as usize].holes
    }

    /// Returns all pages without their unused ends and, for each, the factor by which distances from the upper edge grow
    /// in texture coordinates.
    pub(crate) fn finish(mut self) -> (Vec<Baked>, Vec<f32>) {
        (0..self.pages.len()).for_each(|page| self.close(page));
        let closed = self
            .pages
            .into_iter()
            .filter_map(|page| match page.content {
                Content::Closed(baked, grown) => Some((baked, grown)),
                Content::Open(_) | Content::Closing => None,
            });
        closed.unzip()
    }

    /// Encodes a page without its unused end; it takes no more images.
    fn close(&mut self, page: usize) {
        let Page { holes, content } = &mut self.pages[page];
        let own = self.shelves.iter().filter(|s| s.page as usize == page);
        let used = own.map(|s| s.foot + s.height).max().unwrap_or(SIDE);
        // Blocks of pictures that are packed later are four pixels high.
        let used = used.next_multiple_of(4).min(SIDE);
        let grown = SIDE as f32 / used as f32;
        *content = match std::mem::replace(content, Content::Closing) {
            Content::Open(pixels) => Content::Closed(pixels.encode(used, *holes), grown),
            other => other,
        };
        self.shelves.retain(|s| s.page as usize != page);
    }

    /// Finds a free corner and its page: on the lowest shelf that is high enough, otherwise on a new one.
    fn room(&mut self, w: u32, h: u32, holes: bool) -> (u32, u32, u32) {
        let fits = |s: &&mut Shelf| s.holes == holes && s.height >= h && s.used + w <= SIDE;
        let best = self
            .shelves
            .iter_mut()
            .filter(fits)
            .min_by_key(|s| s.height);
        // A shelf much too high is left to pictures that need it.
        if let Some(shelf) = best.filter(|s| s.height <= h + h / 2) {
            let x = shelf.used;
            shelf.used += w;
            return (x, shelf.foot, shelf.page);
        }
        let (page, foot) = self.strip(h, holes);
        self.shelves.push(Shelf {
            page,
            holes,
            foot,
            height: h,
            used: w,
        });
        (0, foot, page)
    }

    /// Finds a page with a free strip of this height, and the start of the strip.
    fn strip(&mut self, h: u32, holes: bool) -> (u32, u32) {
        let last = self.shelves.iter().rev().find(|s| s.holes == holes);
        if let Some(shelf) = last {
            let foot = shelf.foot + shelf.height;
            if foot + h <= SIDE {
                return (shelf.page, foot);
            }
        }
        let open = |page: &&(usize, &Page)| {
            page.1.holes == holes && matches!(page.1.content, Content::Open(_))
        };
        let all = self.pages.iter().enumerate();
        if let Some((oldest, _)) = all.filter(|page| open(&page)).rev().nth(OPEN - 1) {
            self.close(oldest);
        }
        self.pages.push(Page {
            holes,
            content: Content::Open(Box::new(Pixels::new(self.flat))),
        });
        (self.pages.len() as u32 - 1, 0)
    }
}

#[cfg(test)]
mod tests {
    use crate::bake::atlas::*;

    fn picture(w: u32, h: u32, holes: bool) -> Picture {
        Picture {
            color: RgbaImage::from_pixel(w, h, image::Rgba([9, 9, 9, 255])),
            normal: RgbImage::new(w, h),
            orm: RgbImage::new(w, h),
            holes,
        }
    }

    #[test]
    fn pictures_never_overlap_and_stay_on_the_page() {
        let mut atlas = Atlas::default();
        let mut spots: Vec<Spot> = vec![];
        for i in 0..200_u32 {
            let (w, h) = (20 + i * 37 % 200, 30 + i * 53 % 400);
            spots.push(atlas.place(&picture(w, h, i % 3 == 0)));
        }
        for (i, a) in spots.iter().enumerate() {
            let [lo, hi] = a.uv;
            assert!(lo.iter().chain(&hi).all(|t| (0.0..=1.0).contains(t)));
            for b in spots[..i].iter().filter(|b| b.page == a.page) {
                let apart = |k: usize| a.uv[1][k] <= b.uv[0][k] || b.uv[1][k] <= a.uv[0][k];
                assert!(apart(0) || apart(1), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn empty_ends_of_pages_are_cut_off() {
        let mut atlas = Atlas::default();
        let spot = atlas.place(&picture(10, 100, false));
        let (pages, grown) = atlas.finish();
        let (page, grown) = (&pages[0], grown[0]);
        let color = image::load_from_memory(&page.color).expect("is a picture");
        assert_eq!((color.width(), color.height()), (SIDE, 108));
        // The foot of the picture is still where it was, counted from the upper edge.
        let foot = (1.0 - spot.uv[0][1]) * grown * 108.0;
        assert!((foot - 104.0).abs() < 1e-3, "{foot}");
    }

    #[test]
    fn holes_have_their_own_pages() {
        let mut atlas = Atlas::default();
        let whole = atlas.place(&picture(10, 10, false));
        let pierced = atlas.place(&picture(10, 10, true));
        assert_ne!(whole.page, pierced.page);
        assert!(atlas.has_holes(pierced.page) && !atlas.has_holes(whole.page));
    }

    #[test]
    fn old_pages_are_closed_and_stay_as_they_are() {
        let mut atlas = Atlas::default();
        let spots: Vec<Spot> = (0..60)
            .map(|_| atlas.place(&picture(400, 400, false)))
            .collect();
        let open = |page: &&Page| matches!(page.content, Content::Open(_));
        assert_eq!(atlas.pages.iter().filter(open).count(), OPEN);
        let (pages, grown) = atlas.finish();
        assert_eq!((pages.len(), grown.len()), (15, 15));
        assert!(spots.iter().all(|s| (s.page as usize) < pages.len()));
    }
}
