//! Names by which other programs know a thing again when a model is built anew: `shop/s1/f2/91` is what has its
//! left end 0.91 m from the right end of the second facade of the first storey. They come from places, so that they stay when neighbours come,
//! go or change.

use compact_str::{CompactString, format_compact};
use hsd_scene::{Kind, Node, ScenePart};
use std::collections::HashMap;
use std::num::NonZeroU32;
use twox_hash::XxHash3_128;

/// Centimetres of a metre: places are rounded to them.
const CENTIMETRES: f64 = 100.0;

/// How often each name of a house has been given in a model. A city has a million of them, so they are known by a hash; two with
/// the same one would be counted together. Houses without a name are not kept: their places differ.
#[derive(Default)]
pub(super) struct Given(HashMap<u64, u32>);

impl Given {
    fn count(&mut self, name: &str) -> u32 {
        if name.starts_with('@') {
            return 1;
        }
        let count = self
            .0
            .entry(XxHash3_128::oneshot(name.as_bytes()) as u64)
            .or_insert(0);
        *count += 1;
        *count
    }
}

/// Returns the names of some nodes and all above them, after those given before; others have an empty one.
pub(super) fn identities(
    part: ScenePart<'_>,
    named: &[bool],
    given: &mut Given,
) -> Vec<CompactString> {
    let mut names: Vec<CompactString> = Vec::with_capacity(named.len());
    let mut taken: HashMap<CompactString, u32> = HashMap::new();
    for (i, node) in part.nodes.iter().enumerate() {
        if !named[i] {
            names.push(CompactString::default());
            continue;
        }
        let parent = part.parent(i);
        let own = own(node, parent.map(|p| &part.nodes[p]));
        let whole = match parent {
            Some(parent) => format_compact!("{}/{own}", names[parent]),
            None => own,
        };
        // Those of one name or at one place are counted.
        let here = taken.entry(whole.clone()).or_insert(0);
        *here += 1;
        let count = match parent {
            None => given.count(&whole).max(*here),
            Some(_) => *here,
        };
        names.push(match count {
            1 => whole,
            n => format_compact!("{whole}-{n}"),
        });
    }
    names
}

/// Returns the name of a node below its parent.
fn own(node: &Node, parent: Option<&Node>) -> CompactString {
    let [x, y, z] = node.at.to_array().map(|x| (x * CENTIMETRES).round() as i64);
    let in_facade = parent.is_some_and(|parent| parent.kind == Kind::Facade);
    let kind = node.kind.word();
    match node.kind {
        Kind::House => {
            let name = node.name.strip_prefix("house ").unwrap_or(&node.name);
            // Houses without a name are numbered, and numbers change.
            match name.is_empty() || name.bytes().all(|b| b.is_ascii_digit()) {
                true => format_compact!("@{x},{y}"),
                false => name.replace('/', "-").into(),
            }
        }
        Kind::Storey => {
            let letter = node.name.chars().next().unwrap_or('s');
            format_compact!("{letter}{}", node.storey.unwrap_or(0))
        }
        Kind::Facade => format_compact!("f{}", node.facade.map_or(0, NonZeroU32::get)),
        _ if in_facade => {
            let word = match node.kind {
                Kind::Part => CompactString::default(),
                // A sill, a wall plate; what is numbered has its number from its neighbours.
                Kind::Member => {
                    let numbered = |c: char| c.is_ascii_digit() || c == '.' || c == ' ';
                    let name = node.called().trim_end_matches(numbered);
                    name.replace([' ', '/'], "-").into()
                }
                _ => CompactString::from(kind),
            };
            match z {
                0 => format_compact!("{word}{}", -x),
                z => format_compact!("{word}{}.{z}", -x),
            }
        }
        _ => {
            let storey = node
                .storey
                .filter(|_| parent.is_some_and(|p| p.storey.is_none()));
            let storey = storey.map_or(CompactString::default(), |s| format_compact!("{s}"));
            match [x, y, z] {
                [0, 0, 0] => format_compact!("{kind}{storey}"),
                [x, y, _] => format_compact!("{kind}{storey}@{x},{y}"),
            }
        }
    }
}
