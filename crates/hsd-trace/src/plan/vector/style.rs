//! How the elements of an SVG look: what they have of their own, from style sheets and from the groups round them.

use super::lines::Lines;
use super::xml::Attributes;
use glam::{DMat3, dvec3};
use std::collections::BTreeMap;
use std::str::FromStr;

/// Rules of style sheets: declarations by a class (`.wall`), an id (`#walls`) or an element (`path`).
#[derive(Default)]
pub(super) struct Rules(BTreeMap<String, Vec<(String, String)>>);

impl Rules {
    /// Adds a style sheet; selectors of more than one step go by the last one.
    pub(super) fn add(&mut self, sheet: &str) {
        for rule in sheet.split('}') {
            let Some((selectors, body)) = rule.split_once('{') else {
                continue;
            };
            for selector in selectors.split(',') {
                let last = selector.split_whitespace().last().unwrap_or_default();
                self.0
                    .entry(last.to_owned())
                    .or_default()
                    .extend(declared(body));
            }
        }
    }

    fn of(&self, name: &str, attributes: &Attributes) -> Vec<(String, String)> {
        let classes = attributes
            .get("class")
            .unwrap_or_default()
            .split_whitespace()
            .map(|c| format!(".{c}"));
        let id = attributes.get("id").map(|id| format!("#{id}"));
        let keys = std::iter::once(name.to_owned()).chain(classes).chain(id);
        keys.filter_map(|key| self.0.get(&key))
            .flatten()
            .cloned()
            .collect()
    }
}

fn declared(body: &str) -> impl Iterator<Item = (String, String)> {
    let pairs = body.split(';').filter_map(|d| d.split_once(':'));
    pairs.map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
}

/// How an element looks.
#[derive(Clone, Debug)]
pub(super) struct Look {
    pub(super) matrix: DMat3,
    pub(super) stroke: Option<[u8; 3]>,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) width: f64,
    pub(super) dashes: Option<u32>,
    pub(super) is_hidden: bool,
    /// Names that say what it is, the nearest first.
    pub(super) layers: Vec<u32>,
    pub(super) blocks: Vec<u32>,
    pub(super) symbol: u32,
}

impl Default for Look {
    fn default() -> Look {
        Look {
            matrix: DMat3::IDENTITY,
            stroke: None,
            fill: Some([0; 3]),
            width: 1.0,
            dashes: None,
            is_hidden: false,
            layers: vec![],
            blocks: vec![],
            symbol: 0,
        }
    }
}

impl Look {
    /// How an element in this one looks.
    pub(super) fn of(
        &self,
        name: &str,
        attributes: &Attributes,
        rules: &Rules,
        lines: &mut Lines,
    ) -> Look {
        let mut look = self.clone();
        if let Some(matrix) = attributes
            .get("transform")
            .and_then(|t| svgtypes::Transform::from_str(t).ok())
        {
            look.matrix *= DMat3::from_cols(
                dvec3(matrix.a, matrix.b, 0.0),
                dvec3(matrix.c, matrix.d, 0.0),
                dvec3(matrix.e, matrix.f, 1.0),
            );
        }
        let own = [
            "stroke",
            "fill",
            "stroke-width",
            "stroke-dasharray",
            "display",
            "visibility",
        ];
        let own = own
            .into_iter()
            .filter_map(|key| Some((key.to_owned(), attributes.get(key)?.to_owned())));
        let style = declared(attributes.get("style").unwrap_or_default()).collect::<Vec<_>>();
        for (key, value) in own.chain(rules.of(name, attributes)).chain(style) {
            look.set(&key, &value, lines);
        }
        // What a program calls its layers, and what a hand has written.
        let named = ["data-role", "inkscape:label", "class", "id"]
            .into_iter()
            .filter_map(|key| attributes.get(key));
        let mut names: Vec<u32> = named
            .flat_map(str::split_whitespace)
            .map(|n| lines.name(n))
            .collect();
        names.append(&mut look.layers);
        look.layers = names;
        look
    }

    fn set(&mut self, key: &str, value: &str, lines: &mut Lines) {
        match key {
            "stroke" => self.stroke = painted(value, self.stroke),
            "fill" => self.fill = painted(value, self.fill),
            "stroke-width" => {
                let end = value
                    .find(|c: char| c.is_ascii_alphabetic() || c == '%')
                    .unwrap_or(value.len());
                self.width = value[..end]
                    .trim()
                    .parse()
                    .ok()
                    .filter(|w: &f64| w.is_finite() && *w >= 0.0)
                    .unwrap_or(self.width);
            }
            "stroke-dasharray" => self.dashes = (value != "none").then(|| lines.name("DASHED")),
            "display" => self.is_hidden |= value == "none",
            "visibility" => self.is_hidden = matches!(value, "hidden" | "collapse"),
            _ => {}
        }
    }
}

fn painted(value: &str, above: Option<[u8; 3]>) -> Option<[u8; 3]> {
    match value {
        "none" | "transparent" => None,
        "inherit" | "currentColor" => above.or(Some([0; 3])),
        other => svgtypes::Color::from_str(other)
            .map_or(above, |c| (c.alpha > 0).then_some([c.red, c.green, c.blue])),
    }
}
