//! What stands by itself beside a house: each code becomes a part with its size.

use super::codes::Which;
use super::{Pass, storeys};
use crate::messages::fittings as say;
use glam::DVec2;
use hsd_ir::ast;
use hsd_ir::program::Put;

impl Pass<'_, '_> {
    /// Returns what stands beside the house; only parts do.
    pub(super) fn puts(&mut self, written: &[ast::Put]) -> Vec<Put> {
        let mut puts = Vec::with_capacity(written.len());
        for put in written {
            self.charge(1, put.span);
            let found = self.resolve(&put.code.value, put.code.span);
            let Which::Part(id) = found.which else {
                let name = self.codes.name(found.which);
                self.out.push(say::no_part_to_put(put.code.span, name));
                continue;
            };
            let part = self.codes.catalog.part(id);
            puts.push(Put {
                span: put.span,
                part: id,
                at: DVec2::from(put.at.value),
                turn: put.turn,
                width: put.width.unwrap_or(part.width()),
                height: put.height.or(part.to).unwrap_or(storeys::HEIGHT),
            });
        }
        puts
    }
}
