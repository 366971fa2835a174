//! The other formats hold what the SVG holds.

use super::{read, sheet_of};
use hsd::drawing::paper::{Role, Shape};
use hsd::drawing::{dxf, pdf, svg};
use std::collections::BTreeMap;

/// Groups of a DXF: code and value.
fn groups(text: &str) -> Vec<(u32, &str)> {
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len() % 2, 0);
    let pairs = lines.chunks(2);
    pairs
        .map(|p| (p[0].parse().expect("is a code"), p[1]))
        .collect()
}

#[test]
fn a_dxf_has_the_lines_of_the_svg_on_layers_of_their_roles() {
    let sheet = sheet_of("examples/machiya.hsd", None, 100).expect("there is room");
    let text = dxf::write(&sheet);
    assert!(text.is_ascii());
    let groups = groups(&text);
    assert_eq!(groups.last(), Some(&(0, "EOF")));
    let mut layers = vec![];
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for (k, group) in groups.iter().enumerate() {
        match *group {
            (0, "LAYER") => layers.push(groups[k + 1].1),
            (0, kind @ ("LINE" | "POLYLINE" | "VERTEX" | "SEQEND" | "TEXT")) => {
                let (8, layer) = groups[k + 1] else {
                    panic!("{kind} has no layer");
                };
                assert!(layers.contains(&layer), "{layer} is not declared");
                *counts.entry((kind, layer)).or_default() += 1;
            }
            _ => (),
        }
    }
    let svg = read(&svg::write(&sheet));
    for role in Role::ALL {
        let own = || svg.iter().filter(|d| d.role == role.word());
        let lines: usize = own().filter(|d| !d.closed).map(|d| d.rings.len()).sum();
        let rings: usize = own().filter(|d| d.closed).map(|d| d.rings.len()).sum();
        let layer = role.word().to_uppercase();
        let count = |kind| counts.get(&(kind, &*layer)).copied().unwrap_or_default();
        assert_eq!(
            (count("LINE"), count("POLYLINE"), count("SEQEND")),
            (lines, rings, rings),
            "{layer}"
        );
    }
    // In millimetres of the house: the farthest point is a hundred times as far as on paper.
    let xs = groups
        .iter()
        .filter(|g| g.0 == 10 || g.0 == 11)
        .map(|g| g.1.parse::<f64>().unwrap());
    assert!((xs.fold(0.0, f64::max) - sheet.size.x * 100.0).abs() < 1e-3);
}

#[test]
fn a_pdf_has_every_point_and_says_its_size() {
    let sheet = sheet_of("examples/machiya.hsd", None, 100).expect("there is room");
    let bytes = pdf::write(&sheet);
    assert!(bytes.starts_with(b"%PDF-") && bytes.ends_with(b"%%EOF"));
    let text = String::from_utf8_lossy(&bytes);
    let points = sheet.size * 72.0 / 25.4;
    let numbers = text
        .split("/MediaBox [")
        .nth(1)
        .and_then(|t| t.split(']').next())
        .expect("has a size");
    let numbers: Vec<f64> = numbers.split(' ').map(|n| n.parse().unwrap()).collect();
    assert!((numbers[2] - points.x).abs() < 0.01 && (numbers[3] - points.y).abs() < 0.01);
    let marks = sheet.views.iter().flat_map(|v| &v.marks);
    let (mut moves, mut labels) = (0, 0);
    for mark in marks {
        match &mark.shape {
            Shape::Lines(lines) => moves += lines.len(),
            Shape::Area(rings) | Shape::Letters(rings) => moves += rings.len(),
            Shape::Label(_) => labels += 1,
        }
    }
    assert_eq!(text.lines().filter(|l| l.ends_with(" m")).count(), moves);
    assert_eq!(text.lines().filter(|l| *l == "BT").count(), labels);
}

#[test]
fn the_same_sheet_is_the_same_bytes() {
    let once = || sheet_of("examples/plot.hsd", None, 200).expect("there is room");
    let (one, other) = (once(), once());
    assert_eq!(svg::write(&one), svg::write(&other));
    assert_eq!(dxf::write(&one), dxf::write(&other));
    assert_eq!(pdf::write(&one), pdf::write(&other));
}
