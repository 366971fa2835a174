//! The catalogue of parts: the meaning of each code, its width, and the simple bodies that make up its shape.
//!
//! Built-in and custom parts are made in the same way, from the elements that the reader of the XML form finds.
//! Built-in parts are known everywhere; custom ones are known in a [`Scope`](custom), so that one code may mean
//! different things in two houses of a run. A code is looked up from the house outwards: among its custom parts, those
//! of its file, of files named by `--catalog`, of the file `catalog.hsd` beside it, and the built-in ones.

pub mod body;
mod nearest;
mod custom;
mod read;
mod reading;
mod search;
pub mod value;

pub use crate::ast::Era;
use crate::ast::{CodeText, WrittenPart};
use crate::catalog::custom::Scope;
use crate::material::SurfaceId;
use crate::messages::catalog as say;
use body::Element;
use hsd_base::diagnostic::{Diagnostics, Noun, noun};
use hsd_base::source::{FileId, Span, Spanned};
pub use reading::{folded, narrow};
pub use search::Query;
use serde::{Serialize, Serializer};
use std::collections::BTreeSet;
use value::Mm;

/// Index of a part in its [`Catalog`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct PartId(pub u16);

/// A set of known custom parts; the default is empty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct ScopeId(u32);

/// The relation of a part to the frame of its house.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// Between posts that show: shin-kabe, and all joinery.
    Posts,
    /// Thick plaster over the posts: o-kabe, storehouses.
    Bare,
    /// A modern wall without posts.
    Modern,
    /// A fence or garden wall: lower than the storey, no posts of the house.
    Fence,
    /// A part outside the wall plane or without a wall: posts, wings, voids.
    Free,
}

/// The kind of an opening that people use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Opening {
    /// To walk through.
    Door,
    /// To look through.
    Window,
}

/// The lowest head of a door, shaku: low side doors end at 4.5.
const HEAD: f64 = 4.0;

/// The filling under an opening.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Below {
    /// A boarded dado.
    Dado,
    /// The neighbour's wall.
    Wall,
    /// Nothing.
    Open,
}

/// A part: the head of its entry, and its bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct PartDef {
    code: CodeText,
    class: char,
    /// The Japanese name.
    pub ja: Box<str>,
    /// The romanised Japanese name.
    pub romaji: Box<str>,
    /// The English name.
    pub en: Box<str>,
    /// Other names by which a search finds it, in any script.
    pub aliases: Box<[Box<str>]>,
    width: f64,
    /// Foot of the opening above the storey's floor, shaku; `None` = a wall of the storey's height.
    pub from: Option<f64>,
    /// Top of the opening or fence, shaku.
    pub to: Option<f64>,
    /// The material, as a phrase.
    pub made: Box<str>,
    /// The era it belongs to.
    pub era: Era,
    /// Weathering classes joined by `+` (docs/evidence.md 4.9).
    pub weathering: Box<str>,
    /// The finish of small walls above and below its neighbours; only walls have one.
    pub finish: Option<SurfaceId>,
    /// Relation to the frame of the house.
    pub stance: Stance,
    /// Filling under the opening.
    pub below: Below,
    /// True if a small wall fills the space above the opening.
    pub above: bool,
    /// Width of the opening if it is narrower than the bay.
    pub clear: Option<Mm>,
    /// Share of light that its glass reflects.
    pub reflection: Option<f64>,
    /// The floor seen through it, if it is not the storey's usual one.
    pub floor: Option<SurfaceId>,
    /// True if it fills the half of a split unit regardless of its heights.
    pub fills: bool,
    /// Height by which a front with this part rises above the highest storey, shaku.
    pub parapet: Option<f64>,
    /// The name of the image that its `picture` elements show.
    pub texture: Option<Spanned<String>>,
    /// Elements of its shape.
    pub body: Vec<Element>,
    /// The definition, for parts based on this one.
    written: WrittenPart,
}

impl PartDef {
    /// Returns its code of five columns, or its longer name.
    pub fn code(&self) -> &str {
        self.code.as_str()
    }

    /// Returns the place of its definition.
    pub fn span(&self) -> Span {
        self.written.span
    }

    /// Returns its Japanese name, whole and without the content of parentheses.
    fn ja_names(&self) -> [&str; 2] {
        let head = self.ja.split('(').next().unwrap_or_default();
        [&self.ja, head]
    }

    /// Returns true if a search finds the part by its code, a name or an alias.
    pub fn is_found_by(&self, query: &Query) -> bool {
        let names = [&*self.ja, &*self.romaji, &*self.en];
        let aliases = self.aliases.iter().map(|a| &**a);
        names.into_iter().chain(aliases).any(|n| query.finds(n))
    }

    /// Returns its width in U: 0, 1/2, 1 or 2.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Returns the letter of its class: K wall, T door, M window, G lattice, H post, A opening, N modern, O outdoors; a
    /// blank for the void. Custom parts have that of their base.
    pub fn class(&self) -> char {
        self.class
    }

    /// Returns the opening that it closes; `None` for walls, posts and open bays. Modern parts have one class for all, so
    /// their heights decide: a door reaches from the floor to a head's height, a window stands above a sill or is glass.
    pub fn opening(&self) -> Option<Opening> {
        match (self.class, self.from) {
            ('T', _) => Some(Opening::Door),
            ('M' | 'G', _) => Some(Opening::Window),
            ('N', Some(foot)) if foot > 0.0 => Some(Opening::Window),
            ('N', Some(_)) => self
                .to
                .is_some_and(|to| to >= HEAD)
                .then_some(Opening::Door),
            ('N', None) => self.reflection.map(|_| Opening::Window),
            _ => None,
        }
    }

    /// Returns true if it is open down to the floor. In class A, party walls, aprons, rails and benches are not.
    pub fn is_open(&self) -> bool {
        self.below == Below::Open
    }

    /// Returns true if it is an open bay to walk through.
    pub fn is_passage(&self) -> bool {
        self.class == 'A' && self.is_open()
    }

    /// Returns true if one walks through it: an open bay, or a door that no wall fills, as one does behind a shutter box.
    pub fn leads_through(&self) -> bool {
        let filled = self.body.iter().any(Element::is_whole_wall);
        self.is_passage() || self.opening() == Some(Opening::Door) && !filled
    }

    /// Returns true if it closes its bay: no light comes through while its doors and shutters are shut. Open bays, transoms
    /// and fences leave room above or below.
    pub fn closes(&self) -> bool {
        let lets_in = self.class == ' ' || !self.above || self.stance == Stance::Fence;
        self.width > 0.0 && !self.is_passage() && !lets_in
    }
}

impl Serialize for PartDef {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        // Heights given in metres carry rounding errors when converted to shaku.
        let rounded = |h: Option<f64>| h.map(|h| (h * 1e3).round() / 1e3);
        let mut out = s.serialize_struct("PartDef", 13)?;
        out.serialize_field("code", self.code())?;
        out.serialize_field("class", &self.class())?;
        out.serialize_field("opening", &self.opening())?;
        out.serialize_field("ja", &self.ja)?;
        out.serialize_field("romaji", &self.romaji)?;
        out.serialize_field("en", &self.en)?;
        out.serialize_field("aliases", &self.aliases)?;
        out.serialize_field("width", &self.width)?;
        out.serialize_field("from", &rounded(self.from))?;
        out.serialize_field("to", &rounded(self.to))?;
        out.serialize_field("made", &self.made)?;
        out.serialize_field("era", &self.era)?;
        out.serialize_field("weathering", &self.weathering)?;
        out.end()
    }
}

/// Number of slots of the hash table: a power of two, at least twice the number of parts.
const SLOTS: usize = 512;

/// An empty slot; no part has this number.
const EMPTY: u16 = u16::MAX;

/// Every part by number and by code.
#[derive(Clone, Debug)]
pub struct Catalog {
    parts: Vec<PartDef>,
    /// Packed codes with their parts, in open addressing: a source file holds hundreds of thousands of codes.
    table: Box<[(u64, u16); SLOTS]>,
    void: Option<PartId>,
    /// Number of built-in parts; custom ones follow them.
    builtin: usize,
    /// Custom parts; a [`ScopeId`] counts them from 1.
    scopes: Vec<Scope>,
    /// The scope of each house, by document.
    houses: Vec<Vec<ScopeId>>,
}

impl Catalog {
    /// Creates a catalogue of these built-in parts.
    pub fn new(entries: &[WrittenPart], out: &mut Diagnostics) -> Catalog {
        let mut catalog = Catalog {
            parts: Vec::new(),
            table: Box::new([(0, EMPTY); SLOTS]),
            void: None,
            builtin: 0,
            scopes: vec![],
            houses: vec![],
        };
        for entry in entries {
            let part = read::part(entry, None, out);
            let id = PartId(catalog.parts.len() as u16);
            let CodeText::Five(code) = part.code else {
                out.push(say::wrong_value(entry.span, "code", part.code(), FIVE, &[]));
                continue;
            };
            if catalog.parts.len() >= SLOTS / 2 {
                out.push(say::too_many_parts(entry.span, SLOTS / 2));
                break;
            }
            if !catalog.enter(code, id) {
                out.push(say::part_twice(entry.span, part.code(), entry.span, None));
                continue;
            }
            if code == *b"     " {
                catalog.void = Some(id);
                catalog.enter(*b".....", id);
            }
            catalog.parts.push(part);
        }
        catalog.builtin = catalog.parts.len();
        catalog
    }

    /// Adds the custom parts of a file and returns their scope, nested in `outer`, unless all of them are known there.
    /// Parts of included files yield to those of the file itself. Without parts, returns `outer`.
    pub fn extend(
        &mut self,
        outer: ScopeId,
        file: FileId,
        parts: &[WrittenPart],
        out: &mut Diagnostics,
    ) -> ScopeId {
        let (own, included): (Vec<_>, Vec<_>) = parts.iter().partition(|p| p.span.file == file);
        let outer = self.scope(outer, &included, out);
        self.scope(outer, &own, out)
    }

    /// Records the scopes of the houses of the next document, in their order.
    pub fn settle(&mut self, houses: Vec<ScopeId>) {
        self.houses.push(houses);
    }

    /// Returns the scope of a house, by the number of its document and its index there.
    pub fn known_in(&self, document: usize, house: usize) -> ScopeId {
        let houses = self.houses.get(document);
        houses
            .and_then(|h| h.get(house))
            .copied()
            .unwrap_or_default()
    }

    /// Returns the part that a code means in a scope.
    pub fn find_in(&self, scope: ScopeId, code: &CodeText) -> Option<PartId> {
        let mut next = scope;
        while let Some(scope) = self.own(next) {
            if let Some(id) = scope.names.get(code.as_str()) {
                return Some(*id);
            }
            next = scope.outer;
        }
        self.find(code)
    }

    /// Returns the parts known in a scope, its own before those of enclosing scopes; each code once.
    pub fn known(&self, scope: ScopeId) -> Vec<PartId> {
        let mut codes = BTreeSet::new();
        let mut found = vec![];
        let mut next = scope;
        while let Some(scope) = self.own(next) {
            let mut own: Vec<PartId> = scope.names.values().copied().collect();
            own.sort();
            own.dedup();
            found.extend(
                own.into_iter()
                    .filter(|id| codes.insert(self.part(*id).code())),
            );
            next = scope.outer;
        }
        let all = (0..).map(PartId).zip(&self.parts).take(self.builtin);
        found.extend(
            all.filter(|(_, p)| codes.insert(p.code()))
                .map(|(id, _)| id),
        );
        found
    }

    /// Returns true if a part is built in.
    pub fn is_builtin(&self, id: PartId) -> bool {
        usize::from(id.0) < self.builtin
    }

    /// Enters a code into the table; returns false if it is there already.
    fn enter(&mut self, code: [u8; 5], id: PartId) -> bool {
        let key = pack(code);
        let mut slot = place(key);
        while self.table[slot].1 != EMPTY {
            if self.table[slot].0 == key {
                return false;
            }
            slot = (slot + 1) % SLOTS;
        }
        self.table[slot] = (key, id.0);
        true
    }

    /// Returns the custom parts of a scope; `None` if only the built-in ones are known.
    fn own(&self, scope: ScopeId) -> Option<&Scope> {
        let index = (scope.0 as usize).checked_sub(1)?;
        self.scopes.get(index)
    }

    /// Returns the built-in part of exactly this code; `.....` is the void.
    pub fn find(&self, code: &CodeText) -> Option<PartId> {
        let CodeText::Five(code) = code else {
            return None;
        };
        let key = pack(*code);
        let mut slot = place(key);
        loop {
            match self.table[slot] {
                (_, EMPTY) => return None,
                (found, id) if found == key => return Some(PartId(id)),
                _ => slot = (slot + 1) % SLOTS,
            }
        }
    }

    /// Returns the part of a number; numbers come from this catalogue only.
    pub fn part(&self, id: PartId) -> &PartDef {
        &self.parts[usize::from(id.0)]
    }

    /// Returns every part in the catalogue's order.
    pub fn parts(&self) -> &[PartDef] {
        &self.parts
    }

    /// Returns true if a part is the void, where the walk continues without a wall.
    pub fn is_void(&self, id: PartId) -> bool {
        self.void == Some(id)
    }

    /// Returns the part of this name or alias, Japanese or romanised; the content of parentheses may be omitted.
    pub fn called(&self, name: &str) -> Option<&PartDef> {
        let lower = name.to_lowercase();
        let named = |part: &&PartDef| part.ja_names().contains(&name);
        let romaji = |part: &&PartDef| !name.is_empty() && part.romaji.to_lowercase() == lower;
        let parts = || self.parts.iter();
        let also = |part: &&PartDef| part.aliases.iter().any(|a| **a == *name);
        let found = parts().find(named).or_else(|| parts().find(romaji));
        found.or_else(|| parts().find(also))
    }

    /// Returns the part with the longest Japanese name that a string begins with, and the length of that name in it.
    pub fn named_at(&self, text: &str) -> Option<(&PartDef, usize)> {
        let first = text.chars().next()?;
        let parts = self.parts.iter().filter(|p| p.ja.starts_with(first));
        let names = parts.flat_map(|p| p.ja_names().map(|n| (p, n)));
        let found = names.filter(|(_, n)| !n.is_empty() && text.starts_with(n));
        // Of equal names the first: the plain part precedes the wide one.
        let longest = found.reduce(|best, next| {
            if next.1.len() > best.1.len() {
                next
            } else {
                best
            }
        });
        longest.map(|(part, name)| (part, name.len()))
    }

    /// Returns up to three parts that an unknown code may mean, best first; at most three edits away.
    pub fn nearest(&self, code: &str) -> Vec<PartId> {
        nearest::nearest(self, code)
    }
}

/// The form of built-in codes.
const FIVE: Noun = noun("five columns of ASCII", "ASCII の五桁");

/// Packs a code into one number.
fn pack(code: [u8; 5]) -> u64 {
    let [a, b, c, d, e] = code;
    u64::from_le_bytes([a, b, c, d, e, 0, 0, 0])
}

/// Returns the slot at which the search for a key starts.
fn place(key: u64) -> usize {
    // Fibonacci hashing: the upper bits of the product depend on all five letters.
    (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 55) as usize % SLOTS
}
