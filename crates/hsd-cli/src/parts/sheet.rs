//! `hsd parts --sheet`: the catalogue as an HTML page or a glTF model.

use super::{class_word, rounded, with_blanks};
use crate::files::output::{Committer, Files};
use crate::{Exit, Failure, Outcome};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use hsd_base::text;
use hsd_export::gltf::Glb;
use hsd_export::images::Library;
use hsd_ir::catalog::PartDef;
use hsd_mesh::part_sheet;
use hsd_scene::Detail;
use hsd_scene::texture;
use std::fmt::Write as _;
use std::path::Path;

/// Image resolution in pixels per metre.
const DENSITY: f64 = 150.0;

/// Writes the page or the model, depending on the file extension.
pub(super) fn write(parts: &[&PartDef], to: &Path, committer: &Committer) -> Outcome {
    let extension = to.extension().map(|e| e.to_ascii_lowercase());
    match extension.as_ref().and_then(|e| e.to_str()) {
        Some("html" | "htm") => {
            let page = page(parts).into_bytes();
            committer.write(to, Files::bytes(page))?;
        }
        Some("glb") => {
            let scene = part_sheet::scene(parts, Detail::Everything);
            let library = Library::default();
            committer.write(to, Files::glb(Glb::inside(&scene, &library)))?;
        }
        _ => {
            let shown = to.display();
            return Err(Failure::Usage(text!([shown]
                "{shown}: the extension of a sheet must be .html or .glb",
                "{shown}: 図録の拡張子は .html か .glb です"
            )));
        }
    }
    Ok(Exit::Done)
}

const STYLE: &str = "
:root { color-scheme: light; font-family: 'Noto Sans', 'Noto Sans CJK JP', 'Hiragino Sans', sans-serif; }
body { margin: 2rem auto; max-width: 80rem; padding: 0 1rem; background: #f6f3ec; color: #2b2724; }
h2 { border-bottom: 1px solid #bdb3a4; margin-top: 2.5rem; }
ul { display: flex; flex-wrap: wrap; align-items: flex-end; gap: 1.5rem; list-style: none; padding: 0; }
li { width: min-content; min-width: 9rem; font-size: .85rem; line-height: 1.35; }
li div { min-height: 9.5em; }
img { display: block; margin: 0 auto .4rem; }
code { background: #e6dfd2; padding: 0 .3em; white-space: pre; }
p { margin: .1rem 0; }
.size { color: #6a6056; }
";

/// Returns a self-contained HTML page.
fn page(parts: &[&PartDef]) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Parts of hsd {version}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <h1>Parts <span lang=\"ja\">部材</span></h1>\n\
         <p>Every part in a storey of ten shaku (3.03 m), drawn obliquely. Widths are in U (0.909 m), heights in shaku \
         (0.303 m) above the storey's floor.</p>\n",
        version = env!("CARGO_PKG_VERSION")
    );
    for class in parts.chunk_by(|a, b| a.class() == b.class()) {
        let letter = class[0].class();
        if letter == ' ' {
            continue; // the void is invisible
        }
        let _ = writeln!(out, "<h2>{letter} {}</h2>\n<ul>", class_word(letter));
        class.iter().for_each(|part| card(part, &mut out));
        out.push_str("</ul>\n");
    }
    out + "</body>\n</html>\n"
}

fn card(part: &PartDef, out: &mut String) {
    let Some(picture) = part_sheet::picture(part, DENSITY) else {
        return;
    };
    let (w, h) = picture.dimensions();
    let data = BASE64_STANDARD.encode(texture::jpeg(&picture, 85));
    let [ja, romaji, en, made] = [&part.ja, &part.romaji, &part.en, &part.made].map(|t| escaped(t));
    let heights = match (part.from, part.to) {
        (Some(from), Some(to)) => format!("{}–{} shaku", rounded(from), rounded(to)),
        _ => "full storey".to_owned(),
    };
    let _ = writeln!(
        out,
        "<li><img src=\"data:image/jpeg;base64,{data}\" width=\"{w}\" height=\"{h}\" alt=\"{en}\">\n<div>\n\
         <p><code>{code}</code> <b lang=\"ja\">{ja}</b></p>\n<p><i>{romaji}</i></p>\n<p>{en}</p>\n\
         <p class=\"size\">{width} U, {heights}, {era}; {made}</p>\n</div></li>",
        code = with_blanks(part.code()),
        width = rounded(part.width()),
        era = part.era.word(),
    );
}

/// Escapes text for HTML.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}
