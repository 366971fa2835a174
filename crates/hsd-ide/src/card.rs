//! The card of a part: its names, its image, its dimensions, in Markdown.

use super::Analysis;
use crate::vocabulary;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use hsd_base::diagnostic::{Language, Text};
use hsd_base::geometry::SHAKU;
use hsd_base::text;
use hsd_ir::catalog::{Era, PartDef};
use hsd_mesh::part_sheet;
use hsd_scene::texture;
use image::imageops::{self, FilterType};
use std::sync::{Arc, Mutex, PoisonError};

/// Resolution at which parts are rendered, pixels per metre, and the share by which the image is then scaled down.
const DENSITY: f64 = 156.0;

/// The longer side of an image, pixels.
const SIDE: u32 = 160;

/// JPEG qualities in the order tried; the next if the image would be too large, bytes.
const QUALITIES: [u8; 3] = [88, 75, 50];
const LARGEST: usize = 8800; // 12 kB in base 64, including the surrounding markup

/// Maximum number of cached images, the most recent last.
const KEPT: usize = 256;

static PICTURES: Mutex<Vec<(PartDef, Option<Picture>)>> = Mutex::new(vec![]);

/// An image as JPEG.
pub type Picture = Arc<[u8]>;

/// Returns the card of a part, for a house of this number.
pub(super) fn card(
    a: &Analysis,
    part: &PartDef,
    house: usize,
    language: Language,
    pictures: bool,
) -> String {
    let picture = pictures.then(|| picture(part)).flatten();
    let code = match part.code().trim().is_empty() {
        true => ".....",
        false => part.code().trim_end(),
    };
    let mut out = format!("**`{code}`** {}", part.ja);
    if !part.romaji.is_empty() {
        out += &format!(" *{}*", part.romaji);
    }
    if let Some(picture) = picture {
        out += &format!("\n\n![{code}]({picture})");
    }
    if part.en != part.ja {
        out += &format!("\n\n{}", part.en);
    }
    out += "\n";
    let house = a.checked.building.houses.get(house);
    let unit = house.map_or(3.0 * SHAKU, |b| b.house.unit);
    let mut lines = vec![width(part.width(), unit), heights(part)];
    if !part.made.is_empty() {
        let said = vocabulary::meaning(vocabulary::STUFFS, &part.made);
        let made = said.map_or((&*part.made).into(), Text::from);
        lines.push(text!([made] "made of {made}", "材料: {made}"));
    }
    let class = vocabulary::class(part.class());
    let letter = part.class();
    if letter != ' ' {
        lines.push(text!([letter, class] "class {letter}: {class}", "分類 {letter}: {class}"));
    }
    if part.era != Era::All
        && let Some(era) = vocabulary::meaning(vocabulary::ERAS, part.era.word())
    {
        lines.push(text!([era] "era: {era}", "時代: {era}"));
    }
    for weathered in part.weathering.split('+') {
        if let Some(about) = vocabulary::weathering(weathered) {
            lines.push(text!([weathered, about]
                "weathers as {weathered}, {about}",
                "経年変化 {weathered}、{about}"
            ));
        }
    }
    lines.push(origin(a, part));
    for line in lines {
        out += &format!("\n- {}", line.in_language(language));
    }
    out
}

/// Formats a width in U, shaku and metres.
pub(super) fn width(units: f64, unit: f64) -> Text {
    let (u, shaku, metres) = (
        short(units, 3),
        short(units * unit / SHAKU, 2),
        short(units * unit, 2),
    );
    text!([u, shaku, metres]
        "width {u} U = {shaku} shaku = {metres} m",
        "幅 {u} U = {shaku} 尺 = {metres} m"
    )
}

fn heights(part: &PartDef) -> Text {
    match (part.from, part.to) {
        (Some(from), Some(to)) => {
            let (f, t) = (short(from, 2), short(to, 2));
            let (fm, tm) = (short(from * SHAKU, 2), short(to * SHAKU, 2));
            text!([f, t, fm, tm]
                "from {f} to {t} shaku above the floor ({fm} to {tm} m)",
                "床から {f}〜{t} 尺 ({fm}〜{tm} m)"
            )
        }
        _ => text!("as high as the storey", "階の高さいっぱい"),
    }
}

/// Returns the place where the part is defined.
fn origin(a: &Analysis, part: &PartDef) -> Text {
    let own = a
        .catalog()
        .parts()
        .iter()
        .position(|p| std::ptr::eq(p, part));
    let own = own.filter(|i| !a.catalog().is_builtin(hsd_ir::catalog::PartId(*i as u16)));
    let span = part.span();
    match own.and_then(|_| a.file(span.file)) {
        Some(file) => {
            let line = a.line_of(file, span);
            text!([line] "own part ({line})", "自作の部材 ({line})")
        }
        None => {
            let class = part.class();
            let class = if class == ' ' {
                "....."
            } else {
                &class.to_string()
            };
            text!([class]
                "in the catalogue: `hsd parts {class}`",
                "カタログ: `hsd parts {class}`"
            )
        }
    }
}

/// Formats a number with at most this many decimals.
pub(super) fn short(number: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", number + 0.0);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Returns the image of a part as a `data:` URI; `None` if the part is invisible.
fn picture(part: &PartDef) -> Option<String> {
    let file = part_picture(part)?;
    let text = BASE64_STANDARD.encode(&*file);
    Some(format!("data:image/jpeg;base64,{text}"))
}

/// Returns the image of a part as JPEG, its longer side of 160 pixels; `None` if the part is invisible. It is rendered
/// once.
pub fn part_picture(part: &PartDef) -> Option<Picture> {
    let kept = || PICTURES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, found)) = kept().iter().find(|(p, _)| p == part) {
        return found.clone();
    }
    let made: Option<Picture> = drawn(part).map(Into::into);
    let mut all = kept();
    if all.len() >= KEPT {
        all.remove(0);
    }
    all.push((part.clone(), made.clone()));
    made
}

fn drawn(part: &PartDef) -> Option<Vec<u8>> {
    // An image of a part of a hundred units would have a hundred megapixels.
    let density = DENSITY.min(DENSITY * 4.0 / part.width().max(1.0));
    let picture = part_sheet::picture(part, density)?;
    let (w, h) = picture.dimensions();
    let scale = f64::from(SIDE) / f64::from(w.max(h));
    let size = |n: u32| ((f64::from(n) * scale).round() as u32).max(1);
    let picture = imageops::resize(&picture, size(w), size(h), FilterType::Triangle);
    let mut files = QUALITIES.iter().map(|q| texture::jpeg(&picture, *q));
    files.find(|f| f.len() <= LARGEST)
}
