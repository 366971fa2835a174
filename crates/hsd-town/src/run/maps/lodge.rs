//! Puts the features of a layer into a spool as they are read, so that the layer is never in memory.

use super::{Sheet, no_truth, not_placed};
use crate::layer::{LeftLot, Lot, Lots, Sieve, TownFrame};
use crate::plan::Lodger;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::World;
use hsd_ir::ast::town::Layer;
use hsd_syntax::messages::town as say;
use hsd_syntax::parse::fields::{FieldTest, NoTruth};
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

/// Filters the features of a layer and writes them to a spool, one after another.
struct Passing<'p> {
    /// The layer, without features.
    head: Lots,
    test: Option<FieldTest>,
    /// The columns of the file that is read, as the layer has them; `None` where they are its own.
    columns: Option<BTreeMap<usize, usize>>,
    lodger: &'p mut Lodger,
    sieve: Sieve,
    number: usize,
    before: usize,
    passed: usize,
    no_truth: Option<NoTruth>,
    failed: Option<io::Error>,
}

impl Passing<'_> {
    fn take(&mut self, mut lot: Lot) {
        if self.failed.is_some() || self.no_truth.is_some() {
            return;
        }
        if let Some(columns) = &self.columns {
            lot.renumber(columns);
        }
        self.before += 1;
        let passes = self.test.as_ref().map(|test| self.head.passes(&lot, test));
        match passes {
            None | Some(Ok(true)) => {}
            Some(Ok(false)) => return,
            Some(Err(why)) => {
                self.no_truth = Some(why);
                return;
            }
        }
        self.passed += 1;
        self.head.check_numbers(&lot);
        if let Some(why) = self.sieve.refuse(&self.head, &lot) {
            self.head.left.push(LeftLot::of(&lot, why));
            return;
        }
        let [a, b] = lot.shape.bounds();
        let [c, d] = self.head.bounds.unwrap_or([a, b]);
        self.head.bounds = Some([a.min(c), b.max(d)]);
        self.failed = self.lodger.add(self.number, &self.head, lot).err();
    }
}

/// Puts the features of a layer that pass its `where` into a spool; returns the layer without them, `None` if its files cannot
/// be put into the frame of the town.
pub(super) fn layer(
    world: &dyn World,
    sheets: Vec<Sheet>,
    (frame, written): (&TownFrame, &Layer),
    (lodger, number, sieve): (&mut Lodger, usize, Sieve),
    out: &mut Diagnostics,
) -> io::Result<Option<Lots>> {
    let mut heads = sheets.iter().map(|sheet| sheet.raw.head());
    let Some(mut head) = heads.next() else {
        return Ok(None);
    };
    head.layer = written.clone();
    // Known before the first feature is tested: a field that only a later file has is no unknown one.
    let mut columns = vec![None];
    columns.extend(heads.map(|other| Some(head.adopt(&other))));
    let test = written.filter.as_ref().map(|f| FieldTest::read(&f.value));
    let (test, no_truth_yet) = match test.transpose() {
        Ok(test) => (test, None),
        Err(why) => (None, Some(why)),
    };
    let mut passing = Passing {
        head,
        test,
        columns: None,
        lodger,
        sieve,
        number,
        before: 0,
        passed: 0,
        no_truth: no_truth_yet,
        failed: None,
    };
    let mut is_whole = true;
    for (Sheet { file, raw }, columns) in sheets.into_iter().zip(columns) {
        let raw = Arc::try_unwrap(raw).unwrap_or_else(|kept| (*kept).clone());
        passing.columns = columns;
        let said = (written, file.lead.as_deref());
        match raw.placed(world, frame, said, &mut |lot| passing.take(lot)) {
            Ok(lots) => passing.head.merge_faults(lots),
            Err(why) => {
                out.push(not_placed(&file, &why));
                is_whole = false;
            }
        }
    }
    if let Some(error) = passing.failed {
        return Err(error);
    }
    if let Some(filter) = &written.filter {
        match &passing.no_truth {
            Some(why) => out.push(no_truth(filter, why, &passing.head)),
            None if passing.before > 0 && passing.passed == 0 => {
                out.push(say::nothing_passes(filter.span, passing.before));
            }
            None => {}
        }
    }
    Ok(Some(passing.head).filter(|_| is_whole))
}
