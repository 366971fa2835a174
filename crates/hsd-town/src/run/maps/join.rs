//! Joins layers of points to outlines, and says of which points nothing is taken.

use super::keep;
use crate::layer::{Joined, Lots, NoJoin, Unjoined};
use hsd_base::diagnostic::Diagnostics;
use hsd_ir::ast::town::{Join, Town};
use hsd_syntax::messages::town as say;
use hsd_syntax::parse::xml;

/// Joins points to outlines, then leaves out the outlines that do not pass the `where` of their layer. Returns the points
/// that belong to no outline or give way to another, with the reason.
pub(super) fn join(town: &Town, layers: &mut [Lots], out: &mut Diagnostics) -> Vec<Unjoined> {
    let mut unjoined = vec![];
    for (number, written) in town.layers.iter().enumerate() {
        for how in &written.joins {
            let name = &how.layer.value;
            let found = town.layers.iter().position(|l| l.name.value == *name);
            // Unknown names have been reported.
            let Some(from) = found else {
                continue;
            };
            let joined = match layers.get_disjoint_mut([number, from]) {
                Ok([outlines, points]) => outlines.join(points, how),
                Err(_) => Err(NoJoin::NoPoints),
            };
            match joined {
                Ok(joined) => {
                    report_join(how, &joined, out);
                    unjoined.extend(unused(how, &layers[from], &joined));
                }
                Err(NoJoin::NoPoints) => out.push(say::no_points(how.layer.span, name)),
                Err(NoJoin::NoField(names)) => {
                    let by = how.by.as_ref().unwrap_or(&how.layer);
                    let near = xml::nearest(&by.value, names.iter().map(|n| &**n));
                    out.push(say::unknown_field(by.span, &by.value, near, &names));
                }
            }
        }
        if !written.joins.is_empty() {
            keep(&mut layers[number], out);
        }
    }
    unjoined
}

fn report_join(how: &Join, joined: &Joined, out: &mut Diagnostics) {
    let (span, name) = (how.layer.span, &how.layer.value);
    if joined.several > 0 {
        out.push(say::several_points(
            span,
            name,
            joined.several,
            joined.left.len(),
        ));
    }
    if !joined.without.is_empty() {
        let (count, by_key) = (joined.without.len(), how.by.is_some());
        out.push(say::points_without_outline(span, name, count, by_key));
    }
    if joined.outlines_differ > 0 {
        let fields: Vec<String> = joined.differing.iter().cloned().collect();
        out.push(say::fields_differ(
            span,
            name,
            &fields,
            joined.outlines_differ,
        ));
    }
}

/// Returns the points whose fields no outline takes.
fn unused(how: &Join, points: &Lots, joined: &Joined) -> Vec<Unjoined> {
    let of = |point: &usize, code, reason| Unjoined {
        layer: how.layer.value.clone(),
        key: points.lots[*point].key.clone(),
        code,
        reason,
    };
    let without = joined.without.iter();
    let without = without.map(|p| of(p, "HSD1155", "it belongs to no outline"));
    let left = joined.left.iter();
    let left = left.map(|p| of(p, "HSD1154", "another point of its outline counts"));
    without.chain(left).collect()
}
