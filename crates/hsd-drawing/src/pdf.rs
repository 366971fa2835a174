//! Drawings as PDF: one page of the sheet's size. Texts stay texts, in a Japanese font that readers of PDF bring along;
//! with [`letters`](crate::letters) they are outlines. Each role is a layer.

use crate::paper::{Anchor, Label, Mark, Role, Shape, Sheet, width};
use glam::DVec2;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

/// Points in a millimetre.
const POINT: f64 = 72.0 / 25.4;

/// The fonts of Adobe's collection for Japanese that every reader of PDF knows or replaces.
const FONT: Name<'static> = Name(b"HeiseiKakuGo-W5");

/// The name of the font on the page.
const OWN: Name<'static> = Name(b"F1");

/// The width of Latin letters in thousandths, as [`width`] takes them.
const LATIN: f32 = 600.0;

/// Returns a sheet as the bytes of a PDF file.
pub fn write(sheet: &Sheet) -> Vec<u8> {
    let mut next = Ref::new(1);
    let [catalog, pages, page, content, font, cid, descriptor, info] =
        std::array::from_fn(|_| next.bump());
    let mut pdf = Pdf::new();
    let mut roles: Vec<Role> = sheet
        .views
        .iter()
        .flat_map(|v| &v.marks)
        .map(|m| m.role)
        .collect();
    roles.sort_unstable();
    roles.dedup();
    let layers: Vec<(Role, Ref)> = roles.into_iter().map(|role| (role, next.bump())).collect();
    let mut own = pdf.catalog(catalog);
    own.pages(pages);
    let mut shown = own.insert(Name(b"OCProperties")).dict();
    let all = || layers.iter().map(|(_, layer)| *layer);
    shown.insert(Name(b"OCGs")).array().items(all());
    shown
        .insert(Name(b"D"))
        .dict()
        .insert(Name(b"Order"))
        .array()
        .items(all());
    shown.finish();
    own.finish();
    pdf.pages(pages).kids([page]).count(1);
    pdf.document_info(info).title(TextStr(&sheet.title));
    let size = sheet.size * POINT;
    let mut own = pdf.page(page);
    own.parent(pages)
        .media_box(Rect::new(0.0, 0.0, size.x as f32, size.y as f32))
        .contents(content);
    let mut resources = own.resources();
    resources.fonts().pair(OWN, font);
    let mut named = resources.insert(Name(b"Properties")).dict();
    for (role, layer) in &layers {
        named.pair(Name(role.word().as_bytes()), *layer);
    }
    named.finish();
    resources.finish();
    own.finish();
    for (role, layer) in &layers {
        let mut group = pdf.indirect(*layer).dict();
        group.pair(Name(b"Type"), Name(b"OCG"));
        group.pair(Name(b"Name"), TextStr(role.word()));
    }
    font_of(&mut pdf, font, cid, descriptor);
    pdf.stream(content, &drawn(sheet).finish());
    pdf.finish()
}

/// Returns what is drawn, each run of marks of one role on its layer.
fn drawn(sheet: &Sheet) -> Content {
    let mut drawn = Content::new();
    drawn.set_line_cap(pdf_writer::types::LineCapStyle::RoundCap);
    for view in &sheet.views {
        for marks in view.marks.chunk_by(|a, b| a.role == b.role) {
            let layer = Name(marks[0].role.word().as_bytes());
            let begun = drawn.begin_marked_content_with_properties(Name(b"OC"));
            begun.properties_named(layer);
            marks.iter().for_each(|mark| draw(mark, &mut drawn));
            drawn.end_marked_content();
        }
    }
    drawn
}

/// Describes the font, which is not embedded.
fn font_of(pdf: &mut Pdf, font: Ref, cid: Ref, descriptor: Ref) {
    pdf.type0_font(font)
        .base_font(FONT)
        .encoding_predefined(Name(b"UniJIS-UTF16-H"))
        .descendant_font(cid);
    let mut own = pdf.cid_font(cid);
    own.subtype(CidFontType::Type0)
        .base_font(FONT)
        .system_info(SystemInfo {
            registry: Str(b"Adobe"),
            ordering: Str(b"Japan1"),
            supplement: 4,
        })
        .font_descriptor(descriptor)
        .default_width(1000.0);
    own.widths().same(1, 230, LATIN);
    own.finish();
    pdf.font_descriptor(descriptor)
        .name(FONT)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(0.0, -250.0, 1000.0, 900.0))
        .italic_angle(0.0)
        .ascent(850.0)
        .descent(-150.0)
        .cap_height(750.0)
        .stem_v(90.0);
}

fn draw(mark: &Mark, out: &mut Content) {
    let at = |p: &DVec2| ((p.x * POINT) as f32, (p.y * POINT) as f32);
    let ring = |points: &[DVec2], out: &mut Content| {
        for (k, p) in points.iter().enumerate() {
            let (x, y) = at(p);
            match k {
                0 => out.move_to(x, y),
                _ => out.line_to(x, y),
            };
        }
    };
    let dashes: Vec<f32> = mark
        .role
        .dashes()
        .iter()
        .map(|d| (d * POINT) as f32)
        .collect();
    out.set_line_width((mark.role.pen() * POINT) as f32);
    out.set_dash_pattern(dashes, 0.0);
    out.set_stroke_gray(0.0);
    match &mark.shape {
        Shape::Lines(lines) => {
            let seen: Vec<&[DVec2; 2]> = lines.iter().filter(|[p, q]| p != q).collect();
            if !seen.is_empty() {
                seen.iter().for_each(|l| ring(*l, out));
                out.stroke();
            }
        }
        Shape::Area(rings) => {
            out.set_fill_gray(mark.role.fill() as f32);
            for one in rings {
                ring(one, out);
                out.close_path();
            }
            out.fill_nonzero_and_stroke();
        }
        Shape::Letters(rings) => {
            out.set_fill_gray(0.0);
            for one in rings {
                ring(one, out);
                out.close_path();
            }
            out.fill_even_odd();
        }
        Shape::Label(label) => write_label(label, out),
    }
}

fn write_label(label: &Label, out: &mut Content) {
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => width(&label.text) * label.size / 2.0,
        Anchor::End => width(&label.text) * label.size,
    };
    let back = match label.upward {
        true => DVec2::new(0.0, back),
        false => DVec2::new(back, 0.0),
    };
    let at = (label.at - back) * POINT;
    let (cos, sin) = if label.upward { (0.0, 1.0) } else { (1.0, 0.0) };
    let bytes: Vec<u8> = label
        .text
        .encode_utf16()
        .flat_map(u16::to_be_bytes)
        .collect();
    out.set_fill_gray(0.0);
    out.begin_text();
    out.set_font(OWN, (label.size * POINT) as f32);
    out.set_text_matrix([cos, sin, -sin, cos, at.x as f32, at.y as f32]);
    out.show(Str(&bytes));
    out.end_text();
}
