//! Uses of a definition that come back in a house with the same arguments: what they make is made once, and stands in several
//! places of the tree. Storeys mostly have the same walls.
//!
//! Only pieces of walls are, and nothing that holds at its place alone: a number of the storey, a random choice, a message.

use super::super::super::tree::Child;
use super::super::scope::DefinedPiece;
use super::super::{Expander, Scope};
use super::Arguments;
use crate::parse::schema;
use crate::parse::schema::Tag;
use hsd_ir::ast::Value;
use std::rc::Rc;

/// The most uses that a house remembers.
const MOST: usize = 64;

/// The uses in a house so far.
#[derive(Default)]
pub(in crate::parse::xml::language) struct UsesSoFar<'a>(Vec<KnownUse<'a>>);

/// The elements that a definition made with certain arguments.
struct KnownUse<'a> {
    of: UseKey<'a>,
    children: Vec<Child<'a>>,
    /// How deep it was made, and its cost in parts.
    depth: usize,
    parts: u64,
}

/// All that the content of a use depends on.
pub(super) struct UseKey<'a> {
    piece: DefinedPiece<'a>,
    home: Scope<'a>,
    arguments: Vec<(String, Value)>,
}

/// The state before a use.
pub(super) struct BeforeUse {
    elements: usize,
    children: usize,
    local: usize,
    told: usize,
    room: u64,
}

impl UseKey<'_> {
    fn is(&self, other: &UseKey<'_>) -> bool {
        self.piece.is(&other.piece)
            && std::ptr::addr_eq(Rc::as_ptr(&self.home), Rc::as_ptr(&other.home))
            && self.arguments == other.arguments
    }
}

impl<'a> Expander<'a, '_> {
    /// Returns what a use depends on, if what it makes may come back.
    pub(super) fn use_key(
        &self,
        piece: &DefinedPiece<'a>,
        home: &Scope<'a>,
        arguments: &Arguments<'_, 'a>,
    ) -> Option<UseKey<'a>> {
        // An editor asks for the values of every place.
        self.again
            .as_ref()
            .filter(|_| self.setting.values.is_none())?;
        let value = |(name, (_, value)): (&String, &(_, Option<Value>))| {
            Some((name.clone(), value.clone()?))
        };
        Some(UseKey {
            piece: piece.clone(),
            home: Rc::clone(home),
            arguments: arguments.iter().map(value).collect::<Option<_>>()?,
        })
    }

    /// Puts what the same use made before into an element; returns false if there was none.
    pub(super) fn put_again(&mut self, key: &UseKey<'a>, into: usize) -> bool {
        let known = self.again.iter().flat_map(|again| &again.0);
        let fits = |k: &&KnownUse<'a>| k.depth >= self.depth && k.parts <= self.room;
        let Some(known) = known.into_iter().filter(fits).find(|k| k.of.is(key)) else {
            return false;
        };
        self.room -= known.parts;
        for child in &known.children {
            if let Child::Element(index) = child {
                let element = &mut self.made.elements[*index];
                element.shared = true;
                self.open.pass(element.name);
            }
        }
        let children = known.children.iter().cloned();
        self.made.elements[into].children.extend(children);
        true
    }

    /// Returns the state before a use.
    pub(super) fn before_use(&self, into: usize) -> BeforeUse {
        BeforeUse {
            elements: self.made.elements.len(),
            children: self.made.elements[into].children.len(),
            local: self.local.get(),
            told: self.reporter.told(),
            room: self.room,
        }
    }

    /// Remembers what a use made, if it may come back.
    pub(super) fn remember_use(&mut self, of: UseKey<'a>, before: &BeforeUse, into: usize) {
        let same = self.local.get() == before.local && self.reporter.told() == before.told;
        let elements = &self.made.elements;
        let plain = |name: &str| {
            let tag = schema::named(name).map(|s| s.tag);
            tag.is_some_and(|tag| {
                use Tag::{Door, Fill, Lower, Part, SideWall, Split, Upper};
                matches!(tag, Door | Fill | Lower | Part | SideWall | Split | Upper)
            })
        };
        let children = &elements[into].children[before.children..];
        let own = |child: &Child<'_>| match child {
            Child::Element(index) => *index >= before.elements || elements[*index].shared,
            Child::Text(_) => true,
        };
        if !same
            || self.over
            || !elements[before.elements..].iter().all(|e| plain(e.name))
            || !children.iter().all(own)
        {
            return;
        }
        let (children, depth) = (children.to_vec(), self.depth);
        let parts = before.room - self.room;
        if let Some(again) = self.again.as_mut().filter(|again| again.0.len() < MOST) {
            again.0.push(KnownUse {
                of,
                children,
                depth,
                parts,
            });
        }
    }
}
