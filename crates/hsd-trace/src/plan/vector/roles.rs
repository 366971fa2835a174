//! What the layers, blocks, colours and line types of a drawing stand for, by legends (`grammar/legend-cad.xml`).

use super::lines::{Lines, Stroke};
use super::refused::Refused;
use super::xml::{Element, walk};
use std::collections::BTreeMap;

/// What a stroke stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Means {
    /// A wall.
    Wall,
    /// A door of any kind.
    Door,
    /// A window or a lattice.
    Glazing,
    /// Sliding doors or screens.
    Slide,
    /// A door on hinges.
    Hinged,
    /// A window.
    Window,
    /// A lattice.
    Lattice,
    /// A way without a door.
    Open,
    /// A post.
    Post,
    /// The edge of a mat.
    Mat,
    /// A line of the grid.
    Grid,
    /// Something in a room.
    Inside,
    /// Nothing of the plan.
    Ignore,
}

impl Means {
    /// Words of legends.
    pub const NAMED: [(&'static str, Means); 13] = [
        ("wall", Means::Wall),
        ("door", Means::Door),
        ("glazing", Means::Glazing),
        ("slide", Means::Slide),
        ("hinged", Means::Hinged),
        ("window", Means::Window),
        ("lattice", Means::Lattice),
        ("open", Means::Open),
        ("post", Means::Post),
        ("mat", Means::Mat),
        ("grid", Means::Grid),
        ("inside", Means::Inside),
        ("ignore", Means::Ignore),
    ];

    /// Whether it stands on a wall in place of it.
    pub fn is_opening(self) -> bool {
        matches!(
            self,
            Means::Door
                | Means::Glazing
                | Means::Slide
                | Means::Hinged
                | Means::Window
                | Means::Lattice
                | Means::Open
        )
    }
}

/// The names that a legend gives roles.
#[derive(Clone, Debug, Default)]
pub struct Roles {
    layers: Vec<(String, Means)>,
    blocks: Vec<(String, Means)>,
    line_types: Vec<(String, Means)>,
    colours: Vec<([u8; 3], Means)>,
}

impl Roles {
    /// Reads the `<Layer>`, `<Block>`, `<LineType>` and `<Colour>` of a legend; its symbols are the picture reader's.
    ///
    /// # Errors
    /// If it is no XML, or names no role.
    pub fn read(text: &str) -> Result<Roles, Refused> {
        let mut roles = Roles::default();
        walk(text, &mut |element: &Element<'_>| {
            let wrong = |what: String| Refused::Legend {
                at: element.at.clone(),
                what,
            };
            if !matches!(element.name(), "Layer" | "Block" | "LineType" | "Colour") {
                return Ok(());
            }
            let word = element.own("role").unwrap_or_default();
            let role = Means::NAMED.iter().find(|(name, _)| *name == word);
            let role = role.ok_or_else(|| wrong(format!("`{word}` is no role")))?.1;
            if element.name() == "Colour" {
                let value = element.own("value").unwrap_or_default();
                let colour: svgtypes::Color = value
                    .parse()
                    .map_err(|_| wrong(format!("`{value}` is no colour")))?;
                roles
                    .colours
                    .push(([colour.red, colour.green, colour.blue], role));
                return Ok(());
            }
            let name = element
                .own("name")
                .filter(|n| !n.is_empty())
                .ok_or_else(|| wrong(format!("a <{}> needs a name", element.name())))?;
            let list = match element.name() {
                "Layer" => &mut roles.layers,
                "Block" => &mut roles.blocks,
                _ => &mut roles.line_types,
            };
            list.push((name.to_uppercase(), role));
            Ok(())
        })?;
        Ok(roles)
    }

    /// Adds those of another legend, which hold where this one says nothing.
    #[must_use]
    pub fn or(mut self, other: Roles) -> Roles {
        self.layers.extend(other.layers);
        self.blocks.extend(other.blocks);
        self.line_types.extend(other.line_types);
        self.colours.extend(other.colours);
        self
    }

    /// What the strokes of a drawing stand for; none where nothing says it.
    pub fn of(&self, lines: &Lines) -> Vec<Option<Means>> {
        let mut known: [BTreeMap<u32, Option<Means>>; 3] = Default::default();
        let [layers, blocks, line_types] = &mut known;
        let look =
            |list: &[(String, Means)], known: &mut BTreeMap<u32, Option<Means>>, number: u32| {
                *known.entry(number).or_insert_with(|| {
                    let name = lines.named(number).to_uppercase();
                    list.iter()
                        .find(|(pattern, _)| fits(pattern, &name))
                        .map(|(_, role)| *role)
                })
            };
        let mut one = |stroke: &Stroke| {
            let block = stroke
                .blocks
                .iter()
                .find_map(|b| look(&self.blocks, blocks, *b));
            let layer = stroke
                .layers
                .iter()
                .find_map(|l| look(&self.layers, layers, *l));
            // A text is no wall, whatever its layer.
            if stroke.is_text {
                return Some(
                    layer
                        .filter(|l| *l == Means::Ignore)
                        .unwrap_or(Means::Inside),
                );
            }
            let own = || {
                self.colours
                    .iter()
                    .find(|(c, _)| *c == stroke.colour)
                    .map(|(_, role)| *role)
            };
            let line = stroke
                .line_type
                .and_then(|t| look(&self.line_types, line_types, t));
            block.or(layer).or(line).or_else(own)
        };
        lines.strokes.iter().map(&mut one).collect()
    }
}

/// Whether a name fits a pattern whose `*` stand for any letters.
fn fits(pattern: &str, name: &str) -> bool {
    let mut pieces = pattern.split('*');
    let first = pieces.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let mut pieces: Vec<&str> = pieces.collect();
    let Some(last) = pieces.pop() else {
        return rest.is_empty();
    };
    for piece in pieces {
        match rest.find(piece) {
            Some(at) => rest = &rest[at + piece.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}
