//! Floors and facades by their ids: floors of one id in a structure share a row, and images are named by both
//! (`f1f2f3` shows place 3 of floor 2 of facade 1).

use crate::parse::names::SymbolKind;
use crate::parse::names::file::{File, trimmed, word};
use crate::parse::names::table::{NameTable, Occurrence, Role};
use crate::parse::syntax::Element;
use std::collections::BTreeMap;
use std::ops::Range;

/// Ids of a structure: its number, floor or facade, id.
type Ids<'a> = BTreeMap<(usize, SymbolKind, &'a str), usize>;

/// Marks the ids of a file.
pub(super) fn marks(file: File<'_>, index: &mut NameTable) {
    let elements = &file.outline.elements;
    let mut structures: Vec<Option<usize>> = vec![];
    let mut filled = vec![false; elements.len()];
    let mut ids = Ids::new();
    for (own, element) in elements.iter().enumerate() {
        let outer = element.parent.and_then(|p| structures[p]);
        structures.push(match word(element) {
            "Structure" => Some(own),
            _ => outer,
        });
        let edit = matches!(word(element), "random" | "replace");
        filled[own] |= !element.words.is_empty();
        if let Some(parent) = element.parent.filter(|_| !edit) {
            filled[parent] = true;
        }
    }
    for (own, element) in elements.iter().enumerate() {
        let kind = match word(element) {
            "Floor" => SymbolKind::Floor,
            "Facade" => SymbolKind::Facade,
            _ => continue,
        };
        let id = element.attribute("id").and_then(|a| trimmed(file.text, a));
        let (Some(structure), Some(range)) = (structures[own], id) else {
            continue;
        };
        let id = letter(&file.text[range.clone()]);
        let symbol = *ids
            .entry((structure, kind, id))
            .or_insert_with(|| index.add(kind, id));
        let declares = kind == SymbolKind::Facade || filled[own];
        let role = if declares { Role::Declares } else { Role::Uses };
        index.marks.push(mark(file, range, symbol, role));
    }
    if !ids.is_empty() {
        for (own, element) in elements.iter().enumerate() {
            if let Some(structure) = structures[own] {
                pictures(file, element, structure, &ids, index);
            }
        }
    }
}

/// Returns the id, with `t` for `top`.
fn letter(id: &str) -> &str {
    if id == "top" { "t" } else { id }
}

fn mark(file: File<'_>, range: Range<usize>, symbol: usize, role: Role) -> Occurrence {
    Occurrence {
        file: file.id,
        range,
        symbol,
        role,
    }
}

/// Marks the ids in the names of images.
fn pictures(
    file: File<'_>,
    element: &Element,
    structure: usize,
    ids: &Ids<'_>,
    index: &mut NameTable,
) {
    if !matches!(word(element), "Part" | "random" | "replace" | "Texture") {
        return;
    }
    let lists = ["code", "with"].into_iter();
    for list in lists.filter_map(|name| trimmed(file.text, element.attribute(name)?)) {
        let text = &file.text[list.clone()];
        let mut at = list.start;
        for name in text.split_inclusive([',', ' ']) {
            for (kind, range) in of_picture(name.trim_end_matches([',', ' '])) {
                if let Some(symbol) = ids.get(&(structure, kind, &name[range.clone()])) {
                    let range = at + range.start..at + range.end;
                    index.marks.push(mark(file, range, *symbol, Role::Computed));
                }
            }
            at += name.len();
        }
    }
}

/// Returns the ids in the name of an image such as `f1f2f3u1`.
fn of_picture(name: &str) -> Vec<(SymbolKind, Range<usize>)> {
    let marks: Vec<usize> = name.match_indices('f').map(|(i, _)| i).collect();
    match marks[..] {
        [0, second, third] if second > 1 && third > second + 1 => vec![
            (SymbolKind::Facade, 1..second),
            (SymbolKind::Floor, second + 1..third),
        ],
        _ => vec![],
    }
}
