//! A page of a PDF: its lines with their colours, pens and layers, or the one picture on it.

mod unpacked;

use super::lines::{Lines, MOST, Stroke, cubic, moved};
use super::refused::Refused;
use crate::plan::{Picture, Unreadable};
use glam::{DMat3, DVec2, dvec2, dvec3};
use hayro_syntax::Pdf;
use hayro_syntax::content::UntypedIter;
use hayro_syntax::object::{Array, Dict, Name, Object, Stream};
use hayro_syntax::page::Resources;
use hsd_base::budget::{Account, Budget, Resource};
use hsd_scan::picture::MOST_BYTES;
use std::sync::Arc;

/// The largest file, bytes.
const LARGEST: usize = 64 << 20;
/// The cost of using a form, in points: it is looked up and unpacked.
const FORM: u64 = 16;
/// The most forms in each other.
const DEEPEST: usize = 8;
/// A page with fewer strokes is its picture with a frame.
const FEW: usize = 40;

/// What a page holds.
#[derive(Clone, Debug)]
pub enum Page {
    /// Lines.
    Lines(Lines),
    /// A picture.
    Picture(Picture),
}

/// Reads a page, counted from 1, which may expand to about this memory, bytes.
///
/// # Errors
/// If the file is not a PDF, locked, too large, expands to too much, or has no such page.
pub fn read(bytes: &[u8], number: usize, memory: u64) -> Result<Page, Refused> {
    let account = Account::new(Arc::new(Budget::new(memory)));
    account.read(bytes.len() as u64);
    let account = &*account;
    if bytes.len() > LARGEST {
        return Err(Refused::TooLarge {
            what: "bytes",
            most: LARGEST,
        });
    }
    if !bytes[..bytes.len().min(1024)]
        .windows(5)
        .any(|w| w == b"%PDF-")
    {
        return Err(Refused::NotPdf("%PDF was looked for".to_owned()));
    }
    unpacked::charge(bytes, account)?;
    let pdf = Pdf::new(bytes.to_vec()).map_err(|e| Refused::NotPdf(format!("{e:?}")))?;
    let pages = pdf.pages();
    let page = number
        .checked_sub(1)
        .and_then(|k| pages.get(k))
        .ok_or(Refused::NoPage {
            asked: number,
            pages: pages.len(),
        })?;
    let mut drawn = Drawn {
        lines: Lines::default(),
        pictures: vec![],
        account,
    };
    let turn = page.initial_transform(true).as_coeffs();
    let state = State {
        matrix: matrix(turn),
        ..State::default()
    };
    charge_contents(page.raw(), account)?;
    if let Some(stream) = page.page_stream() {
        drawn.draw(UntypedIter::new(stream), page.resources(), state, 0)?;
    }
    let Drawn {
        lines, pictures, ..
    } = drawn;
    let strokes = lines.strokes.iter().filter(|s| !s.is_text).count();
    match pictures.into_iter().max_by_key(|(area, _)| *area) {
        Some((_, picture)) if strokes < FEW => decoded(&picture).map(Page::Picture),
        _ if lines.strokes.is_empty() => Err(Refused::Blank),
        _ => Ok(Page::Lines(lines)),
    }
}

/// Charges for the contents of a page, which may name one stream many times.
fn charge_contents(page: &Dict<'_>, account: &Account) -> Result<(), Refused> {
    let contents = page.get::<Array<'_>>("Contents");
    for stream in contents.iter().flat_map(|list| list.iter::<Stream<'_>>()) {
        let length = stream.decoded_data().map_or(0, |data| data.len());
        account.charge(Resource::InflatedBytes, length as u64)?;
    }
    Ok(())
}

fn matrix([a, b, c, d, e, f]: [f64; 6]) -> DMat3 {
    DMat3::from_cols(dvec3(a, b, 0.0), dvec3(c, d, 0.0), dvec3(e, f, 1.0))
}

/// The picture of a stream.
fn decoded(stream: &Stream<'_>) -> Result<Picture, Refused> {
    let wrong = |what: &str| Refused::NotPdf(format!("its picture cannot be read: {what}"));
    let unreadable = |e: Unreadable| Refused::Picture(e);
    let raw = stream.raw_data();
    // A JPEG is in the file as it is.
    if raw.starts_with(&[0xff, 0xd8]) {
        return Picture::decode(&raw).map_err(unreadable);
    }
    let dict = stream.dict();
    let size = |key: &str| dict.get::<u32>(key).filter(|s| *s > 0);
    let (width, height) = size("Width")
        .zip(size("Height"))
        .ok_or_else(|| wrong("it has no size"))?;
    let pixels = width as usize * height as usize;
    // The image of the stream and that of the plan, three bytes a pixel each.
    if pixels as u64 > MOST_BYTES / 6 {
        return Err(Refused::TooLarge {
            what: "pixels",
            most: (MOST_BYTES / 6) as usize,
        });
    }
    let data = stream.decoded().map_err(|e| wrong(&format!("{e:?}")))?;
    let bits = if dict.get::<bool>("ImageMask") == Some(true) {
        1
    } else {
        dict.get::<u32>("BitsPerComponent").unwrap_or(8)
    };
    let parts = match (bits, data.len() / pixels.max(1)) {
        (1, _) if data.len() >= width.div_ceil(8) as usize * height as usize => 0,
        (8, 1) => 1,
        (8, 3) => 3,
        (8, 4) => 4,
        _ => {
            return Err(wrong(
                "it is not grey, RGB or CMYK with 8 bits, nor black and white",
            ));
        }
    };
    let row = width.div_ceil(8) as usize;
    let image = image::RgbImage::from_fn(width, height, |x, y| {
        let (x, y) = (x as usize, y as usize);
        let at = (y * width as usize + x) * parts;
        image::Rgb(match parts {
            0 => [(data[y * row + x / 8] >> (7 - x % 8) & 1) * 255; 3],
            1 => [data[at]; 3],
            3 => [data[at], data[at + 1], data[at + 2]],
            _ => cmyk([0, 1, 2, 3].map(|k| f64::from(data[at + k]) / 255.0)),
        })
    });
    Ok(Picture::of(image.into()))
}

fn cmyk([c, m, y, k]: [f64; 4]) -> [u8; 3] {
    [c, m, y]
        .map(|ink| ((1.0 - ink.clamp(0.0, 1.0)) * (1.0 - k.clamp(0.0, 1.0)) * 255.0).round() as u8)
}

/// What holds for the next stroke.
#[derive(Clone)]
struct State {
    matrix: DMat3,
    stroke: [u8; 3],
    fill: [u8; 3],
    width: f64,
    is_dashed: bool,
}

impl Default for State {
    fn default() -> State {
        State {
            matrix: DMat3::IDENTITY,
            stroke: [0; 3],
            fill: [0; 3],
            width: 1.0,
            is_dashed: false,
        }
    }
}

/// The name of the layer that marked content begins, if it is one.
fn layer_of(operands: Vec<Object<'_>>, resources: &Resources<'_>) -> Option<String> {
    let names: Vec<Name<'_>> = operands.into_iter().filter_map(Object::into_name).collect();
    let named = names.get(1).filter(|_| names[0].as_ref() == b"OC")?;
    let layer = resources.properties.get::<Dict<'_>>(named)?;
    let name = layer.get::<hayro_syntax::object::String<'_>>("Name")?;
    Some(text(name.as_ref()))
}

/// A path being drawn.
type Path = Vec<(Vec<DVec2>, bool)>;

struct Drawn<'p> {
    account: &'p Account,
    lines: Lines,
    pictures: Vec<(u64, Stream<'p>)>,
}

impl<'p> Drawn<'p> {
    fn draw(
        &mut self,
        mut operations: UntypedIter<'_>,
        resources: &Resources<'p>,
        first: State,
        depth: usize,
    ) -> Result<(), Refused> {
        let mut state = first;
        let (mut kept, mut layers, mut path): (Vec<State>, Vec<Option<u32>>, Path) =
            (vec![], vec![], vec![]);
        while let Some(operation) = operations.next() {
            self.account.charge(Resource::Points, 1)?;
            let operands: Vec<Object<'_>> = operation.operands().cloned().collect();
            let numbers: Vec<f64> = operands
                .iter()
                .filter_map(|o| o.clone().into_number().map(|n| n.as_f64()))
                .collect();
            let word: &[u8] = operation.operator;
            match word {
                b"q" if kept.len() < 4096 => kept.push(state.clone()),
                b"Q" => state = kept.pop().unwrap_or(state),
                b"S" | b"s" | b"f" | b"F" | b"f*" | b"B" | b"B*" | b"b" | b"b*" | b"n" => {
                    self.paint(word, std::mem::take(&mut path), &state, &layers)?;
                }
                b"BDC" | b"BMC" => {
                    let name = layer_of(operands, resources);
                    layers.push(name.map(|n| self.lines.name(&n)));
                }
                b"EMC" => drop(layers.pop()),
                b"Do" => {
                    let name = operands.into_iter().find_map(Object::into_name);
                    if let Some(form) = name.and_then(|n| resources.get_x_object(&n)) {
                        self.used(form, resources, &state, depth)?;
                    }
                }
                b"Tj" | b"TJ" | b"'" | b"\"" => {
                    let at = moved(&state.matrix, DVec2::ZERO);
                    self.put(Stroke {
                        points: vec![at],
                        is_text: true,
                        ..Stroke::default()
                    })?;
                }
                _ if !build(word, &numbers, &mut path) => set(word, &numbers, operands, &mut state),
                _ => {}
            }
        }
        Ok(())
    }

    fn used(
        &mut self,
        form: Stream<'p>,
        resources: &Resources<'p>,
        state: &State,
        depth: usize,
    ) -> Result<(), Refused> {
        let kind = form.dict().get::<Name<'_>>("Subtype");
        match kind.as_ref().map(|k| k.as_ref()) {
            Some(b"Image") => {
                let area = state.matrix.determinant().abs().min(1e12) as u64;
                self.pictures.push((area, form));
                Ok(())
            }
            Some(b"Form") if depth < DEEPEST => {
                self.account.charge(Resource::Points, FORM)?;
                let Ok(data) = form.decoded_data() else {
                    return Ok(());
                };
                let length = data.len() as u64;
                self.account.charge(Resource::InflatedBytes, length)?;
                let own = form.dict().get::<Dict<'p>>("Resources").map(Resources::new);
                let turn = form
                    .dict()
                    .get::<[f64; 6]>("Matrix")
                    .map_or(DMat3::IDENTITY, matrix);
                let state = State {
                    matrix: state.matrix * turn,
                    ..state.clone()
                };
                self.draw(
                    UntypedIter::new(&data),
                    own.as_ref().unwrap_or(resources),
                    state,
                    depth + 1,
                )
            }
            _ => Ok(()),
        }
    }

    /// Adds a path as strokes, areas or both; white areas take away nothing and are left out.
    fn paint(
        &mut self,
        word: &[u8],
        path: Path,
        state: &State,
        layers: &[Option<u32>],
    ) -> Result<(), Refused> {
        let strokes = matches!(word, b"S" | b"s" | b"B" | b"B*" | b"b" | b"b*");
        let fills = matches!(word, b"f" | b"F" | b"f*" | b"B" | b"B*" | b"b" | b"b*");
        let closes = matches!(word, b"s" | b"b" | b"b*");
        if !strokes && !fills {
            return Ok(());
        }
        let spread = libm::sqrt(state.matrix.determinant().abs());
        let dashes = state.is_dashed.then(|| self.lines.name("DASHED"));
        for (points, is_closed) in path {
            self.put(Stroke {
                points: points.iter().map(|p| moved(&state.matrix, *p)).collect(),
                is_closed: is_closed || closes || !strokes,
                fill: fills.then_some(state.fill),
                width: if strokes { state.width * spread } else { 0.0 },
                colour: if strokes { state.stroke } else { state.fill },
                layers: layers.iter().rev().copied().flatten().collect(),
                line_type: dashes,
                ..Stroke::default()
            })?;
        }
        Ok(())
    }

    fn put(&mut self, stroke: Stroke) -> Result<(), Refused> {
        let points = stroke.points.len() as u64;
        self.account.charge(Resource::Points, points)?;
        match self.lines.put(stroke) {
            true => Ok(()),
            false => Err(Refused::TooLarge {
                what: "corners",
                most: MOST,
            }),
        }
    }
}

/// Letters of a name: UTF-16 with its mark, else UTF-8.
fn text(bytes: &[u8]) -> String {
    match bytes.strip_prefix(&[0xfe, 0xff]) {
        Some(wide) => {
            let units: Vec<u16> = wide
                .chunks_exact(2)
                .map(|c| u16::from_be_bytes([c[0], c[1]]))
                .collect();
            String::from_utf16_lossy(&units)
        }
        None => String::from_utf8_lossy(bytes).into_owned(),
    }
}

/// Adds to a path; false if the operation does something else.
fn build(word: &[u8], numbers: &[f64], path: &mut Path) -> bool {
    let last = path
        .last()
        .and_then(|(p, _)| p.last())
        .copied()
        .unwrap_or_default();
    let mut add = |points: Vec<DVec2>| match path.last_mut() {
        Some((line, false)) => line.extend(points),
        Some((line, true)) => {
            let first = line[0];
            path.push((std::iter::once(first).chain(points).collect(), false));
        }
        None => {}
    };
    match (word, numbers) {
        (b"m", &[x, y]) => path.push((vec![dvec2(x, y)], false)),
        (b"l", &[x, y]) => add(vec![dvec2(x, y)]),
        (b"c", &[a, b, c, d, x, y]) => add(cubic([last, dvec2(a, b), dvec2(c, d), dvec2(x, y)])),
        (b"v", &[c, d, x, y]) => add(cubic([last, last, dvec2(c, d), dvec2(x, y)])),
        (b"y", &[a, b, x, y]) => add(cubic([last, dvec2(a, b), dvec2(x, y), dvec2(x, y)])),
        (b"h", _) => {
            if let Some((_, is_closed)) = path.last_mut() {
                *is_closed = true;
            }
        }
        (b"re", &[x, y, w, h]) => path.push((
            vec![
                dvec2(x, y),
                dvec2(x + w, y),
                dvec2(x + w, y + h),
                dvec2(x, y + h),
            ],
            true,
        )),
        _ => return false,
    }
    true
}

/// Sets what holds from now on.
fn set(word: &[u8], numbers: &[f64], operands: Vec<Object<'_>>, state: &mut State) {
    let colour = match numbers {
        [grey] => Some([*grey; 3].map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)),
        [r, g, b] => Some([*r, *g, *b].map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)),
        [c, m, y, k] => Some(cmyk([*c, *m, *y, *k])),
        _ => None,
    };
    match (word, numbers) {
        (b"cm", &[a, b, c, d, e, f]) => state.matrix *= matrix([a, b, c, d, e, f]),
        (b"w", &[width]) => state.width = width.abs(),
        (b"d", _) => {
            let dashes = operands.into_iter().find_map(Object::into_array);
            state.is_dashed = dashes.is_some_and(|d| d.iter::<f64>().next().is_some());
        }
        (b"G" | b"RG" | b"K" | b"SC" | b"SCN", _) => state.stroke = colour.unwrap_or(state.stroke),
        (b"g" | b"rg" | b"k" | b"sc" | b"scn", _) => state.fill = colour.unwrap_or(state.fill),
        _ => {}
    }
}
