//! SVG of any program: shapes with their colours, pens, classes and groups; texts by their place alone.

use super::lines::{Lines, MOST, Stroke, arc, cubic, moved};
use super::refused::Refused;
use super::style::{Look, Rules};
use super::xml::{Attributes, Element, walk};
use glam::{DMat3, DVec2, dvec2};
use std::collections::BTreeMap;
use svgtypes::{SimplePathSegment, SimplifyingPathParser};

/// The most uses in each other.
const DEEPEST: usize = 8;
/// The most elements, those that are used several times counted each time.
const ELEMENTS: usize = 1_000_000;
/// What is drawn only where something refers to it.
const KEPT_BACK: [&str; 8] = [
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "marker",
    "pattern",
    "metadata",
    "namedview",
];

/// An element of the tree.
struct Node {
    name: String,
    attributes: Attributes,
    /// Where what is in it ends.
    end: usize,
}

/// Reads the lines of an SVG.
///
/// # Errors
/// If it is none, or too large.
pub fn read(text: &str) -> Result<Lines, Refused> {
    let (nodes, rules) = tree(text)?;
    if nodes.first().is_none_or(|n| n.name != "svg") {
        return Err(Refused::NotXml {
            at: 0,
            what: "the element <svg> was looked for".to_owned(),
        });
    }
    let ids = nodes
        .iter()
        .enumerate()
        .filter_map(|(k, n)| Some((n.attributes.get("id")?, k)))
        .collect();
    let mut out = Drawn {
        nodes: &nodes,
        ids,
        rules,
        lines: Lines::default(),
        met: 0,
        symbols: 0,
        open: vec![],
    };
    out.draw(0, &Look::default())?;
    Ok(out.lines)
}

fn tree(text: &str) -> Result<(Vec<Node>, Rules), Refused> {
    let (mut nodes, mut depths, mut rules) = (Vec::<Node>::new(), vec![], Rules::default());
    walk(text, &mut |element: &Element<'_>| {
        if element.name() == "style" {
            rules.add(element.text);
        }
        if nodes.len() >= ELEMENTS {
            return Err(Refused::TooLarge {
                what: "elements",
                most: ELEMENTS,
            });
        }
        nodes.push(Node {
            name: element.name().to_owned(),
            attributes: element.attributes().clone(),
            end: 0,
        });
        depths.push(element.depth());
        Ok(())
    })?;
    // What is in an element comes after it and lies deeper.
    let mut open: Vec<usize> = vec![];
    for k in 0..nodes.len() {
        while open.last().is_some_and(|o| depths[*o] >= depths[k]) {
            if let Some(closed) = open.pop() {
                nodes[closed].end = k;
            }
        }
        open.push(k);
    }
    let end = nodes.len();
    open.into_iter().for_each(|k| nodes[k].end = end);
    Ok((nodes, rules))
}

struct Drawn<'n> {
    nodes: &'n [Node],
    ids: BTreeMap<&'n str, usize>,
    rules: Rules,
    lines: Lines,
    met: usize,
    symbols: u32,
    open: Vec<usize>,
}

impl Drawn<'_> {
    fn draw(&mut self, at: usize, above: &Look) -> Result<(), Refused> {
        let node = &self.nodes[at];
        self.met += 1;
        if self.met > ELEMENTS {
            return Err(Refused::TooLarge {
                what: "elements",
                most: ELEMENTS,
            });
        }
        if KEPT_BACK.contains(&node.name.as_str()) && self.open.last() != Some(&at) {
            return Ok(());
        }
        let look = above.of(&node.name, &node.attributes, &self.rules, &mut self.lines);
        if look.is_hidden {
            return Ok(());
        }
        if node.name == "use" {
            return self.used(&node.attributes, &look);
        }
        self.shape(node, &look)?;
        let mut k = at + 1;
        while k < node.end {
            self.draw(k, &look)?;
            k = self.nodes[k].end;
        }
        Ok(())
    }

    fn used(&mut self, attributes: &Attributes, look: &Look) -> Result<(), Refused> {
        let link = attributes
            .get("href")
            .or(attributes.get("xlink:href"))
            .unwrap_or_default();
        let Some(&target) = self.ids.get(link.trim_start_matches('#')) else {
            self.lines.leave_out("use of what is not there");
            return Ok(());
        };
        if self.open.contains(&target) || self.open.len() >= DEEPEST {
            self.lines.leave_out("use of itself");
            return Ok(());
        }
        let off = dvec2(number(attributes, "x"), number(attributes, "y"));
        let mut look = look.clone();
        look.matrix *= DMat3::from_translation(off);
        look.blocks
            .insert(0, self.lines.name(link.trim_start_matches('#')));
        if look.symbol == 0 {
            self.symbols += 1;
            look.symbol = self.symbols;
        }
        self.open.push(target);
        self.draw(target, &look)?;
        self.open.pop();
        Ok(())
    }

    fn shape(&mut self, node: &Node, look: &Look) -> Result<(), Refused> {
        let Some(paths) = outlines(node) else {
            return Ok(());
        };
        let is_text = node.name == "text";
        if !is_text && look.stroke.is_none() && look.fill.is_none() {
            return Ok(());
        }
        let spread = libm::sqrt(look.matrix.determinant().abs());
        for (points, is_closed) in paths {
            let fill = look.fill.filter(|_| !is_text);
            let stroke = Stroke {
                points: points.iter().map(|p| moved(&look.matrix, *p)).collect(),
                is_closed: is_closed || fill.is_some() && look.stroke.is_none(),
                fill,
                is_text,
                width: if look.stroke.is_some() {
                    look.width * spread
                } else {
                    0.0
                },
                colour: look.stroke.or(look.fill).unwrap_or_default(),
                layers: look.layers.clone(),
                blocks: look.blocks.clone(),
                line_type: look.dashes,
                symbol: look.symbol,
            };
            if !self.lines.put(stroke) {
                return Err(Refused::TooLarge {
                    what: "corners",
                    most: MOST,
                });
            }
        }
        Ok(())
    }
}

/// What an element draws: places in its own frame, and whether they close; `None` if it is no shape.
fn outlines(node: &Node) -> Option<Vec<(Vec<DVec2>, bool)>> {
    let a = &node.attributes;
    let of = |name: &str| number(a, name);
    Some(match node.name.as_str() {
        "path" => path(a.get("d").unwrap_or_default()),
        "line" => vec![(
            vec![dvec2(of("x1"), of("y1")), dvec2(of("x2"), of("y2"))],
            false,
        )],
        "polyline" | "polygon" => vec![(
            corners(a.get("points").unwrap_or_default()),
            node.name == "polygon",
        )],
        "rect" => {
            let (low, high) = (
                dvec2(of("x"), of("y")),
                dvec2(of("x") + of("width"), of("y") + of("height")),
            );
            vec![(
                vec![low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)],
                true,
            )]
        }
        "circle" | "ellipse" => {
            let radius = |name: &str| a.get("r").map_or_else(|| of(name), |_| of("r"));
            let axes = [DVec2::X * radius("rx"), DVec2::Y * radius("ry")];
            vec![(
                arc(dvec2(of("cx"), of("cy")), axes, 0.0, std::f64::consts::TAU),
                true,
            )]
        }
        "text" => vec![(vec![dvec2(of("x"), of("y"))], false)],
        _ => return None,
    })
}

/// A length in user units; one in percent or with a unit is read by its number.
pub(super) fn number(attributes: &Attributes, name: &str) -> f64 {
    let text = attributes.get(name).unwrap_or_default().trim();
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E')))
        .unwrap_or(text.len());
    text[..end]
        .parse()
        .ok()
        .filter(|n: &f64| n.is_finite())
        .unwrap_or(0.0)
}

fn corners(points: &str) -> Vec<DVec2> {
    svgtypes::PointsParser::from(points)
        .map(|(x, y)| dvec2(x, y))
        .collect()
}

/// The lines of a path, each with whether it is closed; what comes after something unreadable is left out, as browsers do.
fn path(d: &str) -> Vec<(Vec<DVec2>, bool)> {
    let mut paths: Vec<(Vec<DVec2>, bool)> = vec![];
    for segment in SimplifyingPathParser::from(d).map_while(Result::ok) {
        let last = paths
            .last()
            .and_then(|(p, _)| p.last())
            .copied()
            .unwrap_or_default();
        let mut add = |points: Vec<DVec2>| {
            // After a path was closed the next one begins where it began.
            match paths.last_mut() {
                Some((path, false)) => path.extend(points),
                Some((path, true)) => {
                    let mut next = vec![path[0]];
                    next.extend(points);
                    paths.push((next, false));
                }
                None => {}
            }
        };
        match segment {
            SimplePathSegment::MoveTo { x, y } => paths.push((vec![dvec2(x, y)], false)),
            SimplePathSegment::LineTo { x, y } => add(vec![dvec2(x, y)]),
            SimplePathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
            } => add(cubic([last, dvec2(x1, y1), dvec2(x2, y2), dvec2(x, y)])),
            SimplePathSegment::Quadratic { x1, y1, x, y } => {
                let (middle, end) = (dvec2(x1, y1), dvec2(x, y));
                add(cubic([
                    last,
                    last.lerp(middle, 2.0 / 3.0),
                    end.lerp(middle, 2.0 / 3.0),
                    end,
                ]));
            }
            SimplePathSegment::ClosePath => {
                if let Some((_, is_closed)) = paths.last_mut() {
                    *is_closed = true;
                }
            }
        }
    }
    paths.retain(|(points, _)| points.len() > 1);
    paths
}
