//! The same strokes as vectors: SVG with groups by role, DXF R12 with layers.

use super::paint::{arc, strokes};
use super::sheet::{Convention, Place, Role, Shape, Sheet, Variant};
use super::truth::{Kind, Plan, Run};
use std::fmt::Write as _;

/// Millimetres a unit in CAD drawings.
const MM: f32 = 909.09;

/// How a CAD drawing is organised.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cad {
    /// Walls as lines on both faces, doors as loose lines.
    Lines,
    /// Walls as closed polylines, doors as loose lines.
    Polylines,
    /// Walls as closed polylines, every opening an insert of a block.
    Blocks,
}

/// The drawing as SVG, 10 user units a unit; one group for each run of strokes of one role.
pub fn svg(plan: &Plan, convention: Convention, variant: Variant) -> String {
    let sheet = strokes(plan, convention, variant);
    let (w, h) = (sheet.size.0 * 10.0, sheet.size.1 * 10.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w:.2} {h:.2}\" width=\"{w:.2}mm\" height=\"{h:.2}mm\">\n"
    );
    let mut open: Option<Role> = None;
    for item in &sheet.items {
        if open != Some(item.role) {
            if open.is_some() {
                out.push_str("</g>\n");
            }
            let _ = writeln!(out, "<g class=\"{}\">", item.role.layer().to_lowercase());
            open = Some(item.role);
        }
        let [r, g, b] = item.ink;
        let filled = matches!(item.shape, Shape::Fill(_) | Shape::Disc(..));
        let paint = if filled {
            format!("fill=\"#{r:02x}{g:02x}{b:02x}\"")
        } else {
            format!(
                "fill=\"none\" stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"{:.3}\"",
                item.width * 10.0
            )
        };
        let _ = writeln!(out, "{}", element(&item.shape, &paint));
    }
    out.push_str(if open.is_some() {
        "</g>\n</svg>\n"
    } else {
        "</svg>\n"
    });
    out
}

fn element(shape: &Shape, paint: &str) -> String {
    let data = |list: &[Place], close: &str| {
        let mut d = String::new();
        for (k, p) in list.iter().enumerate() {
            let _ = write!(
                d,
                "{}{:.3} {:.3}",
                if k == 0 { "M" } else { "L" },
                p.0 * 10.0,
                p.1 * 10.0
            );
        }
        format!("<path d=\"{d}{close}\" {paint}/>")
    };
    match shape {
        Shape::Line(list) => data(list, ""),
        Shape::Loop(list) | Shape::Fill(list) => data(list, "Z"),
        Shape::Disc(c, r) | Shape::Ring(c, r) => {
            format!(
                "<circle cx=\"{:.3}\" cy=\"{:.3}\" r=\"{:.3}\" {paint}/>",
                c.0 * 10.0,
                c.1 * 10.0,
                r * 10.0
            )
        }
        Shape::Arc(c, from, to) => data(&arc(*c, *from, *to), ""),
    }
}

/// A DXF being written: pairs of a group code and a value.
#[derive(Default)]
struct Tags(String);

impl Tags {
    fn tag(&mut self, code: i32, value: impl std::fmt::Display) {
        let _ = writeln!(self.0, "{code}\n{value}");
    }

    fn place(&mut self, code: i32, p: Place) {
        self.tag(code, format!("{:.3}", p.0));
        self.tag(code + 10, format!("{:.3}", p.1));
    }

    fn entity(&mut self, name: &str, layer: &str) {
        self.tag(0, name);
        self.tag(8, layer);
    }

    fn line(&mut self, layer: &str, from: Place, to: Place) {
        self.entity("LINE", layer);
        self.place(10, from);
        self.place(11, to);
    }

    fn polyline(&mut self, layer: &str, list: &[Place], closed: bool) {
        self.entity("POLYLINE", layer);
        self.tag(66, 1);
        self.tag(70, i32::from(closed));
        for &p in list {
            self.entity("VERTEX", layer);
            self.place(10, p);
        }
        self.entity("SEQEND", layer);
    }

    fn shape(&mut self, layer: &str, shape: &Shape, to: &dyn Fn(Place) -> Place) {
        let all = |list: &[Place]| -> Vec<Place> { list.iter().map(|&p| to(p)).collect() };
        match shape {
            Shape::Line(list) if list.len() == 2 => self.line(layer, to(list[0]), to(list[1])),
            Shape::Line(list) => self.polyline(layer, &all(list), false),
            Shape::Loop(list) | Shape::Fill(list) => self.polyline(layer, &all(list), true),
            Shape::Disc(c, r) | Shape::Ring(c, r) => {
                self.entity("CIRCLE", layer);
                self.place(10, to(*c));
                self.tag(40, format!("{:.3}", r * MM));
            }
            Shape::Arc(c, from, end) => self.arc(layer, to(*c), to(*from), to(*end)),
        }
    }

    /// DXF arcs run counter-clockwise, in degrees.
    fn arc(&mut self, layer: &str, c: Place, from: Place, to: Place) {
        let turn = |p: Place| (p.1 - c.1).atan2(p.0 - c.0).to_degrees().rem_euclid(360.0);
        let (mut start, mut end) = (turn(from), turn(to));
        if (end - start).rem_euclid(360.0) > 180.0 {
            std::mem::swap(&mut start, &mut end);
        }
        self.entity("ARC", layer);
        self.place(10, c);
        self.tag(40, format!("{:.3}", (from.0 - c.0).hypot(from.1 - c.1)));
        self.tag(50, format!("{start:.3}"));
        self.tag(51, format!("{end:.3}"));
    }
}

/// The survey drawing as DXF R12 in millimetres, y up, (a, b) = (0, 0) at the origin and a to the left.
pub fn dxf(plan: &Plan, cad: Cad, variant: Variant) -> String {
    let sheet = super::survey::sheet(plan, variant);
    let origin = sheet.origin;
    let to = move |p: Place| ((p.0 - origin.0) * MM, (origin.1 - p.1) * MM);
    let runs = plan.runs();
    let mut tags = Tags::default();
    tags.tag(0, "SECTION");
    tags.tag(2, "HEADER");
    tags.tag(9, "$ACADVER");
    tags.tag(1, "AC1009");
    tags.tag(0, "ENDSEC");
    if cad == Cad::Blocks {
        blocks(&mut tags, &runs, variant);
    }
    tags.tag(0, "SECTION");
    tags.tag(2, "ENTITIES");
    walls(&mut tags, &sheet, &runs, cad, variant, &to);
    for item in &sheet.items {
        let loose = match item.role {
            Role::Wall => false,
            Role::Door | Role::Window => cad != Cad::Blocks,
            _ => item.ink != [255; 3],
        };
        if loose {
            tags.shape(item.role.layer(), &item.shape, &to);
        }
    }
    if cad == Cad::Blocks {
        inserts(&mut tags, &runs);
    }
    tags.tag(0, "ENDSEC");
    tags.tag(0, "EOF");
    tags.0
}

fn walls(
    tags: &mut Tags,
    sheet: &Sheet,
    runs: &[Run],
    cad: Cad,
    variant: Variant,
    to: &dyn Fn(Place) -> Place,
) {
    let half = super::survey::wall_of(variant) / 2.0;
    for run in runs.iter().filter(|run| run.kind == Kind::Wall) {
        let frame = sheet.frame(run, false);
        let length = run.length as f32;
        let at = |x: f32, y: f32| to(frame.to((x, y)));
        if cad == Cad::Lines {
            for y in [-half, half] {
                tags.line("WALL", at(half, y), at(length - half, y));
            }
        } else {
            let quad = [
                at(0.0, -half),
                at(length, -half),
                at(length, half),
                at(0.0, half),
            ];
            tags.polyline("WALL", &quad, true);
        }
    }
}

fn block_name(run: &Run) -> String {
    format!("{}{}", run.kind.name().to_uppercase(), run.length)
}

fn layer_of(kind: Kind) -> &'static str {
    if matches!(kind, Kind::Window | Kind::Lattice) {
        "WINDOW"
    } else {
        "DOOR"
    }
}

/// One block for each kind and length, along +x from the origin.
fn blocks(tags: &mut Tags, runs: &[Run], variant: Variant) {
    tags.tag(0, "SECTION");
    tags.tag(2, "BLOCKS");
    let mut known: Vec<String> = Vec::new();
    for run in runs
        .iter()
        .filter(|run| !matches!(run.kind, Kind::Wall | Kind::Open))
    {
        let name = block_name(run);
        if known.contains(&name) {
            continue;
        }
        tags.entity("BLOCK", "0");
        tags.tag(2, &name);
        tags.tag(70, 0);
        tags.place(10, (0.0, 0.0));
        for shape in super::survey::local(run, variant) {
            tags.shape("0", &shape, &|p| (p.0 * MM, p.1 * MM));
        }
        tags.entity("ENDBLK", "0");
        known.push(name);
    }
    tags.tag(0, "ENDSEC");
}

fn inserts(tags: &mut Tags, runs: &[Run]) {
    for run in runs
        .iter()
        .filter(|run| !matches!(run.kind, Kind::Wall | Kind::Open))
    {
        tags.entity("INSERT", layer_of(run.kind));
        tags.tag(2, block_name(run));
        tags.place(10, (-run.from.0 as f32 * MM, run.from.1 as f32 * MM));
        let turn = (run.along.1 as f32)
            .atan2(-run.along.0 as f32)
            .to_degrees()
            .rem_euclid(360.0);
        tags.tag(50, format!("{turn:.1}"));
    }
}
