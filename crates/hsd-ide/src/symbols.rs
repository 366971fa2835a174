//! Document symbols, as a tree: houses, storeys, rows and roofs, and definitions.

use super::walked::{self, Built, Lines, Walked};
use super::{Analysis, sections};
use hsd_syntax::parse::syntax::Element;
use hsd_syntax::parse::syntax::LineKind;
use std::ops::Range;

/// Maximum length of a row's name, characters.
const LONGEST: usize = 60;

/// The kind of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A house, or several of them.
    House,
    /// A storey, or the floor of a facade.
    Storey,
    /// A wall line.
    Row,
    /// A walk of its own.
    Loop,
    /// A facade.
    Facade,
    /// The roofs of a house, or one of them.
    Roof,
    /// A definition.
    Piece,
    /// A `Param`.
    Parameter,
    /// A `let`.
    Value,
    /// A custom part.
    Part,
    /// An included file.
    File,
    /// Any other element of a house.
    Fitting,
}

/// A symbol of a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// The name.
    pub name: String,
    /// Further details, in short.
    pub detail: String,
    /// The kind.
    pub kind: SymbolKind,
    /// The whole range.
    pub range: Range<usize>,
    /// The range of its name, or of what identifies it; within `range`.
    pub selection: Range<usize>,
    /// The nested symbols, in the order of the file.
    pub children: Vec<Symbol>,
}

/// Returns the symbols of a source file.
pub fn symbols(a: &Analysis) -> Vec<Symbol> {
    let known = KnownName {
        a,
        storeys: walked::storeys(a),
        walls: walked::walls(a, &(0..a.text().len())),
    };
    let mut found = known.legacy();
    found.extend(known.elements());
    found
}

/// The file, and the building made from it.
struct KnownName<'a> {
    a: &'a Analysis,
    storeys: Lines<Built<'a>>,
    walls: Lines<Walked<'a>>,
}

impl KnownName<'_> {
    /// Returns the houses of the legacy form.
    fn legacy(&self) -> Vec<Symbol> {
        let (outline, text) = (self.a.outline(), self.a.text());
        let houses = sections::houses(outline, text);
        let houses = houses.iter().enumerate();
        houses
            .map(|(number, house)| {
                let range = sections::text_range(outline, &house.lines);
                let (name, selection) = self.house_name(house, number);
                let mut children = vec![];
                for (number, lines) in house.storeys.iter().enumerate() {
                    children.push(self.storey_of_lines(lines, number));
                }
                children.extend(house.roofs.as_ref().map(|lines| self.roofs_of_lines(lines)));
                Symbol {
                    name,
                    detail: String::new(),
                    kind: SymbolKind::House,
                    selection,
                    range,
                    children,
                }
            })
            .collect()
    }

    /// Returns the name of a house, and its place.
    fn house_name(&self, house: &sections::House, number: usize) -> (String, Range<usize>) {
        let (outline, text) = (self.a.outline(), self.a.text());
        let lines = house.header.clone().unwrap_or_default();
        for line in &outline.lines[lines] {
            if line.kind == LineKind::Header
                && let Some(rest) = text[line.range.clone()].trim().strip_prefix("name")
                && rest.starts_with(char::is_whitespace)
            {
                let name = rest.trim();
                let start = name.as_ptr() as usize - text.as_ptr() as usize;
                return (name.to_owned(), start..start + name.len());
            }
        }
        let first = outline.lines[house.lines.start].range.clone();
        (format!("House {}", number + 1), first)
    }

    fn storey_of_lines(&self, lines: &Range<usize>, number: usize) -> Symbol {
        let outline = self.a.outline();
        let range = sections::text_range(outline, lines);
        let built = self
            .storeys
            .range((range.start, 0)..=(range.end, usize::MAX));
        let built: Vec<Built<'_>> = built.flat_map(|(_, s)| s).copied().collect();
        let (name, detail) = storey(&built);
        let rows = outline.lines[lines.clone()].iter();
        let rows = rows.filter(|l| l.kind == LineKind::Wall && !l.range.is_empty());
        let text = self.a.text();
        let children =
            rows.map(|l| self.row(l.range.clone(), l.range.clone(), &text[l.range.clone()]));
        Symbol {
            name: name.unwrap_or_else(|| format!("Storey {}", number + 1)),
            detail,
            kind: SymbolKind::Storey,
            selection: outline.lines[lines.start].range.clone(),
            children: children.collect(),
            range,
        }
    }

    fn roofs_of_lines(&self, lines: &Range<usize>) -> Symbol {
        let (outline, text) = (self.a.outline(), self.a.text());
        let roofs = outline.lines[lines.clone()].iter();
        let roofs = roofs.filter(|l| l.kind == LineKind::Roof);
        let children: Vec<Symbol> = roofs
            .map(|line| {
                let words: Vec<&str> = text[line.range.clone()].split_whitespace().collect();
                let word = |i: usize| words.get(i).copied().unwrap_or_default();
                leaf(
                    format!("{} {}", word(3), word(0)).trim().to_owned(),
                    format!("{} {}", word(1), word(2)),
                    SymbolKind::Roof,
                    line.range.clone(),
                    line.range.clone(),
                )
            })
            .collect();
        Symbol {
            name: "Roofs".to_owned(),
            detail: String::new(),
            kind: SymbolKind::Roof,
            range: sections::text_range(outline, lines),
            selection: outline.lines[lines.start].range.clone(),
            children,
        }
    }

    /// Returns the symbol of a wall line: its codes, and its length.
    fn row(&self, range: Range<usize>, selection: Range<usize>, codes: &str) -> Symbol {
        let walls = self.walls.get(&(range.start, range.end));
        let walls = walls.map_or(&[][..], Vec::as_slice);
        let lengths = walls.iter().map(|w| walked::length(w.wall));
        let detail = match walls {
            [] => String::new(),
            _ => format!("{} U", walked::span_of(lengths)),
        };
        let words: Vec<&str> = codes.split_whitespace().collect();
        let mut name = words.join(" ");
        if let Some((cut, _)) = name.char_indices().nth(LONGEST) {
            name.truncate(cut);
            name.push('…');
        }
        if name.is_empty() {
            "Row".clone_into(&mut name);
        }
        leaf(name, detail, SymbolKind::Row, range, selection)
    }

    /// Returns the codes in an element and its descendants.
    fn codes_in(&self, number: usize) -> String {
        let elements = &self.a.outline().elements;
        let end = elements[number].range.end;
        let inside = elements[number..]
            .iter()
            .take_while(|e| e.range.start < end);
        let words = inside.flat_map(|e| &e.words);
        let words: Vec<&str> = words.map(|w| &self.a.text()[w.range.clone()]).collect();
        words.join(" ")
    }

    /// Returns the symbols of the XML form.
    fn elements(&self) -> Vec<Symbol> {
        let elements = &self.a.outline().elements;
        let mut made: Vec<Option<Symbol>> = (0..elements.len()).map(|e| self.element(e)).collect();
        let mut roots = vec![];
        // Children follow their parents: going backwards, each is complete when its turn comes.
        let mut waiting: Vec<Vec<Symbol>> = vec![vec![]; elements.len()];
        for number in (0..elements.len()).rev() {
            let mut inside = std::mem::take(&mut waiting[number]);
            let mut own = match made[number].take() {
                Some(mut symbol) => {
                    inside.reverse();
                    symbol.children = inside;
                    vec![symbol]
                }
                None => inside,
            };
            match elements[number].parent {
                Some(parent) => waiting[parent].append(&mut own),
                None => roots.append(&mut own),
            }
        }
        roots.reverse();
        roots
    }

    /// Returns the kind of an element; `None` = its content takes its place.
    fn element(&self, number: usize) -> Option<Symbol> {
        let (element, text) = (&self.a.outline().elements[number], self.a.text());
        let said = |name: &str| element.value(name).map(str::trim).filter(|v| !v.is_empty());
        let detail = |name: &str| said(name).unwrap_or_default().to_owned();
        let schema = element.schema?;
        let (kind, name, detail) = match schema.name {
            "House" | "Structure" => (SymbolKind::House, said("name"), String::new()),
            "Storey" | "Floor" => {
                let key = (element.range.start, element.range.end);
                let built = self.storeys.get(&key);
                let (name, told) = storey(built.map_or(&[][..], Vec::as_slice));
                let name = name.or(said("id").map(|id| format!("{} {id}", schema.name)));
                let mut symbol = symbol(element, SymbolKind::Storey, name.as_deref(), told);
                if symbol.detail.is_empty() {
                    symbol.detail = detail("height");
                }
                return Some(symbol);
            }
            "Row" => {
                let (range, selection) = (element.range.clone(), element.name.clone());
                return Some(self.row(range, selection, &self.codes_in(number)));
            }
            "Loop" => (SymbolKind::Loop, None, String::new()),
            "Room" => (SymbolKind::Piece, said("name"), detail("floor")),
            "Facade" => (SymbolKind::Facade, said("id"), detail("ratio")),
            "Roofs" | "Roof" => {
                let words = ["shape", "kind", "pitch"].map(detail);
                (SymbolKind::Roof, None, words.join(" ").trim().to_owned())
            }
            "define" => {
                let names = element.attributes.iter().filter(|a| a.word != "name");
                let names: Vec<&str> = names.map(|a| &text[a.name.clone()]).collect();
                (SymbolKind::Piece, said("name"), names.join(", "))
            }
            "Param" => (SymbolKind::Parameter, said("name"), detail("default")),
            "let" => (SymbolKind::Value, said("name"), detail("value")),
            "PartDef" => (SymbolKind::Part, said("code"), detail("ja")),
            "Put" => (SymbolKind::Part, said("code"), detail("at")),
            "Ground" => (SymbolKind::Fitting, None, detail("surface")),
            "include" => (SymbolKind::File, said("href"), String::new()),
            "Fixture" | "Platform" | "Posts" | "Veranda" | "Brackets" | "Finial" | "Pagoda"
            | "Gate" | "Hall" | "Shrine" => (SymbolKind::Fitting, None, detail("kind")),
            _ => return None,
        };
        Some(symbol(element, kind, name, detail))
    }
}

/// Returns the name and detail of a storey as built.
fn storey(built: &[Built<'_>]) -> (Option<String>, String) {
    if built.is_empty() {
        return (None, String::new());
    }
    let numbers = walked::numbers(built);
    let name = numbers.map_or_else(|| "Parapet".to_owned(), |n| format!("Storey {n}"));
    let height = walked::span_of(built.iter().map(|b| b.height()));
    let perimeter = walked::span_of(built.iter().map(|b| b.perimeter()));
    (Some(name), format!("{height} shaku, {perimeter} U"))
}

/// Returns the symbol of an element, named after the element if it has no name of its own.
fn symbol(element: &Element, kind: SymbolKind, name: Option<&str>, detail: String) -> Symbol {
    let word = element.schema.map_or("", |s| s.name);
    leaf(
        name.unwrap_or(word).to_owned(),
        detail,
        kind,
        element.range.clone(),
        element.name.clone(),
    )
}

fn leaf(
    name: String,
    detail: String,
    kind: SymbolKind,
    range: Range<usize>,
    selection: Range<usize>,
) -> Symbol {
    Symbol {
        name,
        detail,
        kind,
        range,
        selection,
        children: vec![],
    }
}
