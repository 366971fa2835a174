//! Computes expressions, conditions and definitions (docs/contract.md 3) on the elements of a file: from a tree with
//! expressions, parameters, conditions, definitions and other files to a tree without any of them, which the rest of
//! the reader then reads like any other. So every attribute of every element can be an expression, and no later pass
//! knows of them.
//!
//! | file | computes |
//! |---|---|
//! | `braces` | `{...}` in attributes and codes |
//! | `scope` | the names known at each place |
//! | `names` | `Param` and `let` |
//! | `conditions` | `if` and `else` |
//! | `feature`, `features` | `for`: its content, at each feature of a map |
//! | `draws` | `random` among runs of text, and parameters chosen at random |
//! | `storeys` | the number `k`, and repetitions that use it |
//! | `pieces` | `define` and `use` |
//! | `places` | `Place` |
//! | `rounds` | repetitions with the number of the round, and of houses |
//! | `files` | `include` |
//! | `fixes` | fixes that editors offer |
//!
//! - A name is known after its `let` or `Param` in the same element and all its content; a definition in the whole
//!   element. `if` and `else` count as their content, so that names given in them are known after them.
//! - A definition knows the names of the place where it stands, and its own parameters; not those of the place of use.
//! - The content of the tree keeps its places: that of a computed value are the braces, that of a definition its `define`.
//! - A file without any of these is passed on unchanged.

mod braces;
mod conditions;
mod draws;
mod facts;
mod feature;
mod features;
mod files;
mod fixes;
mod names;
mod outlines;
mod pieces;
mod places;
mod rear;
mod rounds;
mod scope;
mod storeys;

pub(super) use braces::{Segment, segments};
pub(super) use feature::Rules;

use super::suggest::Suggest;
use super::tree::{Child, Element, Tree};
use super::trees::Trees;
use crate::parse::ReadContext;
use crate::parse::expr::Expr;
use crate::parse::reporter::Reporter;
use crate::parse::schema;
use crate::parse::schema::{Tag, is_language};
use crate::parse::xml::tree::text::Text;
use crate::parse::xml::tree::token::Attribute;
use conditions::Branch;
use hsd_base::source::Span;
use hsd_ir::ast::Parameter;
use hsd_ir::ast::town::RuleFacts;
use hsd_ir::messages::xml as say;
use pieces::Used;
use scope::{Frame, Scope};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;
use storeys::Storeys;

/// The cost of a copied element, in parts. The cost of the parts of a house is counted by `expand`.
const ELEMENT: u64 = 8;

/// The maximum number of messages that list known names.
const HINTS: u32 = 200;

/// The number of columns of text that count as one part.
const COLUMNS: usize = 5;

/// A tree without expressions.
pub(super) struct Computed<'a> {
    pub(super) tree: Rc<Tree<'a>>,
    pub(super) parameters: Vec<Parameter>,
    /// What the rules of a town say.
    pub(super) facts: RuleFacts,
    /// True if it exceeded the limit and was abandoned.
    pub(super) over: bool,
}

/// Computes a tree. Elements nest at most `nesting` deep in the result.
pub(super) fn compute<'a>(
    tree: Rc<Tree<'a>>,
    setting: ReadContext<'a>,
    nesting: usize,
    trees: &mut Trees<'a>,
    reporter: &mut Reporter<'a>,
) -> Computed<'a> {
    if is_plain(&tree, reporter) {
        return Computed {
            tree,
            parameters: vec![],
            facts: RuleFacts::default(),
            over: false,
        };
    }
    reporter.say_once();
    let mut expander = Expander::new(setting, nesting, trees, reporter);
    let places = tree.elements.iter().filter(|e| e.name == "Place").count();
    expander.limit = setting.limits.copied(places);
    expander.room = expander.limit;
    let scope = Frame::outermost();
    for root in &tree.roots {
        let made = expander.copy(&tree, *root, &scope);
        expander.made.roots.extend(made);
    }
    Computed {
        tree: Rc::new(expander.made),
        parameters: expander.parameters,
        facts: expander.feature.facts,
        over: expander.over,
    }
}

/// Returns true if there is nothing to compute.
fn is_plain(tree: &Tree<'_>, reporter: &Reporter<'_>) -> bool {
    const NAMES: [&str; 10] = [
        "Param", "let", "define", "use", "if", "else", "include", "choice", "Place", "for",
    ];
    let of_houses = |e: &Element<'_>| {
        let mut inner = e.children.iter().filter_map(|child| match child {
            Child::Element(index) => Some(tree.elements[*index].name),
            Child::Text(_) => None,
        });
        match e.name {
            "Houses" | "Group" => inner.any(|name| name == "repeat"),
            "repeat" => inner.any(|name| matches!(name, "Put" | "Ground")),
            _ => false,
        }
    };
    let computes = |e: &Element<'_>| {
        NAMES.contains(&e.name) || of_houses(e) || e.name == "repeat" && e.has_attribute("index")
    };
    // One sign at a time is found many times as fast as either of two.
    let text = reporter.source.text();
    let braces = text.contains('{') || text.contains('}');
    !braces && !tree.elements.iter().any(computes)
}

/// Returns true if the value of an attribute holds an expression.
fn is_computed(attribute: &Attribute<'_>) -> bool {
    braces::are_in(&attribute.value) && !attribute.is_foreign()
}

/// The state of the expansion.
struct Expander<'a, 'f> {
    reporter: &'f mut Reporter<'a>,
    setting: ReadContext<'a>,
    trees: &'f mut Trees<'a>,
    nesting: usize,
    suggest: Suggest,
    made: Tree<'a>,
    parameters: Vec<Parameter>,
    /// Expressions by their place: a definition is parsed once however often it is used.
    parsed: BTreeMap<usize, Option<Rc<Expr>>>,
    /// The definitions of parameters, by the place of their element.
    written: BTreeMap<usize, Rc<names::WrittenParameter>>,
    storeys: Storeys,
    /// The open output elements, outermost first.
    open: draws::Open<'a>,
    /// The active uses, outermost first.
    uses: Vec<Used<'a>>,
    /// The uses so far of the house in the making.
    again: Option<pieces::UsesSoFar<'a>>,
    /// The number of results so far that hold at their place alone.
    local: Cell<usize>,
    /// The houses being placed, outermost first.
    placed: Vec<places::Placed<'a>>,
    files: files::Files<'a>,
    feature: feature::AtFeature<'a, 'f>,
    /// The number of open elements, conditions, uses and files.
    depth: usize,
    /// The number of messages that may still list known names, which takes time.
    hints: u32,
    /// True while copies are made, beyond the elements as written.
    copying: bool,
    /// The number of parts that may still be made of copies.
    room: u64,
    /// The limit of a file.
    limit: u64,
    over: bool,
}

impl<'a, 'f> Expander<'a, 'f> {
    /// Creates the state at the start of a file.
    fn new(
        setting: ReadContext<'a>,
        nesting: usize,
        trees: &'f mut Trees<'a>,
        reporter: &'f mut Reporter<'a>,
    ) -> Self {
        Expander {
            reporter,
            setting,
            trees,
            nesting,
            suggest: Suggest::new(),
            made: Tree::default(),
            parameters: vec![],
            parsed: BTreeMap::new(),
            written: BTreeMap::new(),
            storeys: Storeys::default(),
            uses: vec![],
            again: None,
            local: Cell::new(0),
            placed: vec![],
            open: draws::Open::outermost(
                setting.seed,
                setting.before.map_or(0, |before| before.houses),
            ),
            files: files::Files::default(),
            feature: feature::AtFeature::default(),
            depth: 0,
            hints: HINTS,
            copying: false,
            limit: setting.limits.parts as u64,
            room: setting.limits.parts as u64,
            over: false,
        }
    }
}

/// An element of a tree.
struct ElementRef<'s, 'a> {
    tree: &'s Rc<Tree<'a>>,
    index: usize,
}

impl<'s, 'a> ElementRef<'s, 'a> {
    fn element(&self) -> &'s Element<'a> {
        &self.tree.elements[self.index]
    }

    fn tag(&self) -> Option<Tag> {
        schema::named(self.element().name).map(|s| s.tag)
    }

    fn child(&self, index: usize) -> ElementRef<'s, 'a> {
        ElementRef { index, ..*self }
    }
}

impl<'a> Expander<'a, '_> {
    /// Copies an element; `None` if it would nest too deep or exceed the limit.
    fn copy(&mut self, tree: &Rc<Tree<'a>>, index: usize, scope: &Scope<'a>) -> Option<usize> {
        let element_ref = ElementRef { tree, index };
        match element_ref.tag() {
            Some(Tag::Storey | Tag::Floor) => self.storey(&element_ref, scope),
            Some(Tag::House | Tag::Facade) => {
                let outside = std::mem::take(&mut self.storeys);
                let before = self.again.replace(pieces::UsesSoFar::default());
                let made = self.element(&element_ref, scope);
                self.storeys = outside;
                self.again = before;
                made
            }
            _ => self.element(&element_ref, scope),
        }
    }

    /// Copies an element with its attributes and content.
    fn element(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>) -> Option<usize> {
        let element = element_ref.element();
        if !self.take(
            ELEMENT * (1 + element.attributes.len() as u64),
            &element.name_range,
        ) {
            return None;
        }
        let made = self.made.elements.len();
        let mut attributes = element.attributes.clone();
        for attribute in attributes.iter_mut().filter(|a| is_computed(a)) {
            let before = self.key_draws(element.name, attribute.name);
            self.fill_attribute(attribute, scope);
            self.restore_draws(before);
        }
        if element_ref.tag() == Some(Tag::House) {
            self.name_placed(&mut attributes);
            self.seed_house(&mut attributes, element);
        }
        self.made.elements.push(Element {
            name: element.name,
            name_range: element.name_range.clone(),
            tag: element.tag.clone(),
            range: element.range.clone(),
            attributes,
            children: vec![],
            cut: element.cut,
            shared: false,
        });
        self.enter(element_ref, made);
        self.inside(&element_ref.element().name_range, made, |expander| {
            expander.content(element_ref, scope, made);
        });
        self.leave();
        Some(made)
    }

    /// Puts the values of expressions into an attribute.
    fn fill_attribute(&mut self, attribute: &mut Attribute<'a>, scope: &Scope<'a>) {
        if !braces::are_in(&attribute.value) {
            return;
        }
        match self.filled(&attribute.value, scope) {
            Some(value) => attribute.value = value,
            None => {
                attribute.value = Text::instead(String::new(), attribute.value.whole());
                attribute.faulty = true;
            }
        }
    }

    /// Runs an action one level deeper, unless that is too deep; `into` = the element that loses it then.
    fn inside(
        &mut self,
        place: &std::ops::Range<usize>,
        into: usize,
        work: impl FnOnce(&mut Self),
    ) {
        if self.depth >= self.nesting {
            let limit = self.nesting;
            self.made.elements[into].cut = true;
            self.reporter.at(place, |s| say::nested_too_deep(s, limit));
            return;
        }
        self.depth += 1;
        work(self);
        self.depth -= 1;
    }

    /// Copies the content of an element.
    fn content(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>, into: usize) {
        let children = &element_ref.element().children;
        let names = |child: &Child<'_>| match child {
            Child::Element(index) => {
                let child = element_ref.child(*index);
                child.tag().is_some_and(is_language) || draws::is_choice(&child)
            }
            Child::Text(_) => false,
        };
        if children.iter().any(names) {
            self.list(element_ref, &Frame::within(scope), into);
        } else {
            self.list(element_ref, scope, into);
        }
    }

    /// Copies the content of an element, whose names are those of this frame.
    fn list(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>, into: usize) {
        let children = &element_ref.element().children;
        for child in children {
            if let Child::Element(index) = child
                && element_ref.child(*index).tag() == Some(Tag::Define)
            {
                self.define(&element_ref.child(*index), scope);
            }
        }
        let mut branch = Branch::None;
        for child in children {
            if self.over {
                return;
            }
            match child {
                Child::Text(text) => {
                    branch = Branch::None;
                    self.codes(text, scope, into);
                }
                Child::Element(index) => {
                    let child = element_ref.child(*index);
                    branch = self.child(&child, element_ref, scope, into, branch);
                }
            }
        }
    }

    /// Copies a child of an element; returns the condition for an `else` after it.
    fn child(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        parent: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
        branch: Branch,
    ) -> Branch {
        match element_ref.tag() {
            Some(Tag::Param) => self.param(element_ref, parent, scope),
            Some(Tag::Let) => self.assign(element_ref, scope),
            Some(Tag::Define) => {}
            Some(Tag::Use) => self.use_piece(element_ref, scope, into),
            Some(Tag::If) => return self.condition(element_ref, parent, scope, into, Branch::Open),
            Some(Tag::Else) => return self.condition(element_ref, parent, scope, into, branch),
            Some(Tag::Include) => self.include(element_ref, scope, into),
            Some(Tag::For) => self.rule(element_ref, scope, into),
            Some(Tag::Place) => self.place(element_ref, scope, into),
            Some(Tag::Rear) if self.feature.site.is_some() => {
                self.rear_at_feature(element_ref, scope, into)
            }
            Some(Tag::Residence | Tag::Block) if self.feature.site.is_some() => {
                self.grounds_at_feature(element_ref, scope, into)
            }
            Some(Tag::House) if self.feature.site.is_some() && self.placed.is_empty() => {
                self.house_at_feature(element_ref, scope, into)
            }
            Some(Tag::Repeat) if rounds::is_written_out(element_ref, parent) => {
                self.write_out(element_ref, scope, into)
            }
            Some(Tag::Repeat) => self.repeat(element_ref, scope, into),
            Some(Tag::Random) if draws::is_choice(element_ref) => {
                self.choose(element_ref, scope, into)
            }
            _ => self.add(element_ref, scope, into),
        }
        Branch::None
    }

    /// Copies an element into another.
    fn add(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>, into: usize) {
        if let Some(made) = self.copy(element_ref.tree, element_ref.index, scope) {
            let child = Child::Element(made);
            self.made.elements[into].children.push(child);
        }
    }

    /// Records that a result holds at its place alone.
    fn note_local(&self) {
        self.local.set(self.local.get() + 1);
    }

    /// Returns the known names for a message, up to the maximum number of messages.
    fn known(&mut self, gather: impl FnOnce() -> Vec<String>) -> Vec<String> {
        if self.hints == 0 {
            return vec![];
        }
        self.hints -= 1;
        gather()
    }

    /// Adds a run of text to an element.
    fn add_text(&mut self, text: Text<'a>, into: usize) {
        let parts = 2 + text.as_str().len() / COLUMNS;
        if self.take(parts as u64, &text.whole()) {
            self.made.elements[into].children.push(Child::Text(text));
        }
    }

    /// Counts parts against the limit, if more is made than is written; returns false if it is exceeded.
    fn take(&mut self, parts: u64, place: &std::ops::Range<usize>) -> bool {
        if self.copying || !self.uses.is_empty() {
            match self.room.checked_sub(parts) {
                Some(left) => self.room = left,
                None => self.stop(place),
            }
        }
        !self.over
    }

    #[cold]
    fn stop(&mut self, place: &std::ops::Range<usize>) {
        if !self.over {
            self.over = true;
            let chain: Vec<(String, Span)> = self.chain();
            let limit = self.limit;
            self.reporter
                .at(place, |s| say::copies_too_large(s, limit, &chain));
        }
    }
}
