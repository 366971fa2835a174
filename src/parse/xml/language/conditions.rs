//! `if` and `else`: one of them stands for what it holds.

use super::super::read::check;
use super::{ElementRef, Expander, Scope};
use crate::ast::Value;
use crate::diagnostic::messages::xml as say;
use crate::parse::schema;
use crate::parse::schema::Tag;

/// The state of the condition that an `else` at this place would continue.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Branch {
    /// Nothing: there is no `if` before it.
    None,
    /// Nothing before it was chosen.
    Open,
    /// Something before it was.
    Chosen,
}

impl<'a> Expander<'a, '_> {
    /// Works out an `if`, or an `else` after that. An `else` with a test is another condition.
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
        // Without a sound test neither this nor what follows is chosen: is unknown which was meant.
        let holds = match test {
            _ if branch == Branch::Chosen => false,
            None if schema.tag == Tag::Else => true,
            None => return Branch::Chosen,
            Some(test) => match self.value(test, scope) {
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
