//! `if` and `else`: the chosen one is replaced by its content.

use super::super::read::check;
use super::{ElementRef, Expander, Scope};
use crate::parse::schema;
use crate::parse::schema::Tag;
use crate::parse::xml::tree::text::Text;
use hsd_ir::ast::Value;
use hsd_ir::messages::xml as say;

/// The state of the condition that an `else` at this place would continue.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Branch {
    /// There is no `if` before it.
    None,
    /// No branch before it was chosen.
    Open,
    /// A branch before it was chosen.
    Chosen,
}

impl<'a> Expander<'a, '_> {
    /// Returns the value of a test; one that asks for a field that the feature lacks does not hold.
    fn tested(&mut self, test: &Text<'_>, scope: &Scope<'a>) -> Option<Value> {
        let before = self.key_draws("if", "test");
        self.take_lacks();
        let value = self.value(test, scope);
        self.restore_draws(before);
        match self.take_lacks() {
            true if value.is_none() => Some(Value::Truth(false)),
            _ => value,
        }
    }

    /// Evaluates an `if`, or an `else` after it. An `else` with a test is another condition.
    pub(super) fn condition(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        parent: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
        branch: Branch,
    ) -> Branch {
        let element = element_ref.element();
        let Some(schema) = schema::named(element.name) else {
            return branch;
        };
        if branch == Branch::None {
            let fix = self.behind_the_if(element_ref, parent);
            self.reporter
                .at(&element.name_range, |s| say::else_without_if(s, fix));
            return Branch::None;
        }
        let of = check(self.reporter, &mut self.suggest, schema, element);
        let test = of.get("test").map(|a| &a.value);
        // Without a valid test neither this branch nor the following ones are chosen: the intended one is unknown.
        let holds = match test {
            _ if branch == Branch::Chosen => false,
            None if schema.tag == Tag::Else => true,
            None => return Branch::Chosen,
            Some(test) => match self.tested(test, scope) {
                Some(Value::Truth(truth)) => truth,
                Some(found) => {
                    let quoted = test.as_str();
                    let worth = self.worth(quoted, scope);
                    let sound = matches!(worth, Some(Value::Truth(_)));
                    self.reporter.at(&test.whole(), |s| {
                        say::test_no_truth(s, quoted, &found, sound)
                    });
                    return Branch::Chosen;
                }
                None => return Branch::Chosen,
            },
        };
        if holds {
            self.inside(&element.name_range, into, |expander| {
                expander.list(element_ref, scope, into);
            });
        }
        match (schema.tag, test) {
            (Tag::Else, None) => Branch::None,
            _ if holds => Branch::Chosen,
            _ => branch,
        }
    }
}
