//! Texts of a drawing as outlines, so that it looks the same wherever it is opened.

use crate::paper::{Anchor, Label, Shape, Sheet};
use glam::{DVec2, dvec2};
use hsd_base::lettering::Font;

/// Returns the sheet with outlines instead of texts, and the letters that the font does not have.
pub fn outlined(sheet: &Sheet, font: &Font<'_>) -> (Sheet, Vec<char>) {
    let (mut sheet, mut missing) = (sheet.clone(), vec![]);
    for mark in sheet.views.iter_mut().flat_map(|v| &mut v.marks) {
        if let Shape::Label(label) = &mark.shape {
            mark.shape = Shape::Letters(rings(label, font, &mut missing));
        }
    }
    missing.sort_unstable();
    missing.dedup();
    (sheet, missing)
}

/// Returns the outlines of a label on its sheet.
fn rings(label: &Label, font: &Font<'_>, missing: &mut Vec<char>) -> Vec<Vec<DVec2>> {
    let text = font.lettering(&label.text);
    missing.extend(text.missing);
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => text.width / 2.0,
        Anchor::End => text.width,
    };
    let place = |p: &DVec2| {
        let off = (*p - dvec2(back, 0.0)) * (label.size / text.size);
        label.at + if label.upward { off.perp() } else { off }
    };
    let place_ring = |ring: &Vec<DVec2>| ring.iter().map(place).collect();
    text.rings.iter().map(place_ring).collect()
}
