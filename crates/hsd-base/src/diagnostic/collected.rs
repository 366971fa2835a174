//! The diagnostics of a run, counted by kind: a report shows the first ones of each kind and the number of the rest.

use super::messages::file;
use super::{Code, Diagnostic, Edit, Origin, Severity};
use crate::source::{FileId, Span};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The maximum number of diagnostics kept for one file: by a reader in all, by a run for each code and severity. Nobody
/// reads more, and they would exceed the memory limit (docs/contract.md 7).
pub const ENOUGH: usize = 500;

/// The maximum number of diagnostics of one code and severity kept for one layer: features of a layer share their
/// problems.
pub const ENOUGH_OF_LAYER: usize = 20;

/// The collected diagnostics of a run.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    kinds: BTreeMap<Kind, Tally>,
}

/// The key by which diagnostics are counted.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    of: Whole,
    code: Code,
    severity: Severity,
}

/// The file or layer that contains an origin.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Whole {
    File(FileId),
    Layer(Arc<str>),
}

/// The diagnostics of a kind.
#[derive(Clone, Debug)]
struct Tally {
    /// Their number, kept or not.
    count: usize,
    /// The greatest origin among those kept.
    last: Origin,
}

impl Kind {
    fn of(diagnostic: &Diagnostic) -> Kind {
        Kind {
            of: match &diagnostic.origin {
                Origin::Source(span) => Whole::File(span.file),
                Origin::Feature { layer, .. } => Whole::Layer(layer.clone()),
            },
            code: diagnostic.code,
            severity: diagnostic.severity,
        }
    }

    /// Returns the maximum number of diagnostics kept.
    fn enough(&self) -> usize {
        match self.of {
            Whole::File(_) => ENOUGH,
            Whole::Layer(_) => ENOUGH_OF_LAYER,
        }
    }
}

impl Diagnostics {
    /// Creates an empty collection.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a diagnostic; after the first [`ENOUGH`] of a kind, or [`ENOUGH_OF_LAYER`], it is only counted.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let kind = Kind::of(&diagnostic);
        let enough = kind.enough();
        let tally = self.kinds.entry(kind).or_insert_with(|| Tally {
            count: 0,
            last: diagnostic.origin.clone(),
        });
        tally.count += 1;
        if tally.count > enough {
            return;
        }
        if tally.last < diagnostic.origin {
            tally.last = diagnostic.origin.clone();
        }
        self.list.push(diagnostic);
    }

    /// Returns the first error.
    pub fn first_error(&self) -> Option<&Diagnostic> {
        self.list.iter().find(|d| d.severity == Severity::Error)
    }

    /// Returns the diagnostics of a house that stands on a feature of a map: there is no text that could be changed at their
    /// place. Notes are left out, and errors are warnings, since the rest of the town is built.
    #[must_use]
    pub fn of_feature(self, origin: &Origin) -> Diagnostics {
        let mut moved = Diagnostics::new();
        for mut diagnostic in self.list {
            if diagnostic.severity > Severity::Note {
                diagnostic.severity = Severity::Warning;
                diagnostic.origin = origin.clone();
                diagnostic.fixes.clear();
                diagnostic.labels.clear();
                moved.push(diagnostic);
            }
        }
        moved
    }

    /// Adds all diagnostics of another collection.
    pub fn append(&mut self, other: Diagnostics) {
        for diagnostic in other.list {
            self.push(diagnostic);
        }
        for (kind, tally) in other.kinds {
            let left_out = tally.count.saturating_sub(kind.enough());
            if let Some(own) = self.kinds.get_mut(&kind) {
                own.count += left_out;
            }
        }
    }

    /// Adds the diagnostics of another collection, one per place and code: a problem of a source file is found again in
    /// each house made from it.
    pub fn push_new(&mut self, other: Diagnostics) {
        let key = |d: &Diagnostic| (d.origin.clone(), d.code);
        let mut known: BTreeSet<_> = self.list.iter().map(key).collect();
        for diagnostic in other.list {
            if known.insert(key(&diagnostic)) {
                self.push(diagnostic);
            }
        }
        // It is unknown which of those left out are new.
        for (kind, tally) in other.kinds {
            if let Some(own) = self.kinds.get_mut(&kind) {
                own.count = own.count.max(tally.count);
            }
        }
    }

    /// Returns the diagnostics with those of a file at another place, once each, and without what leads into that file.
    #[must_use]
    pub fn moved(self, from: FileId, to: Span) -> Diagnostics {
        let away = |d: &Diagnostic| d.span().is_some_and(|span| span.file == from);
        if !self.list.iter().any(away) {
            return self;
        }
        let mut moved = Diagnostics::new();
        let mut known = BTreeSet::new();
        for mut diagnostic in self.list {
            let is_news = !diagnostic.leave(from, to) || known.insert(diagnostic.code);
            if is_news {
                moved.push(diagnostic);
            }
        }
        moved
    }

    /// Gives the files of all places other numbers.
    pub fn renumber(&mut self, number: &mut dyn FnMut(FileId) -> FileId) {
        let list = std::mem::take(&mut self.list);
        let counts: Vec<(Kind, Tally)> = std::mem::take(&mut self.kinds).into_iter().collect();
        for mut diagnostic in list {
            let labels = diagnostic.labels.iter_mut().map(|label| &mut label.span);
            let edits = diagnostic.fixes.iter_mut().flat_map(|fix| &mut fix.edits);
            for span in labels.chain(edits.map(|edit| &mut edit.span)) {
                span.file = number(span.file);
            }
            if let Origin::Source(span) = &mut diagnostic.origin {
                span.file = number(span.file);
            }
            self.list.push(diagnostic);
        }
        for (mut kind, mut tally) in counts {
            if let Whole::File(file) = &mut kind.of {
                *file = number(*file);
            }
            if let Origin::Source(span) = &mut tally.last {
                span.file = number(span.file);
            }
            self.kinds.insert(kind, tally);
        }
    }

    /// Returns those of the kept diagnostics that are to be kept further.
    #[must_use]
    pub fn filtered(mut self, keep: impl FnMut(&Diagnostic) -> bool) -> Diagnostics {
        self.list.retain(keep);
        self
    }

    /// Returns how many of each kind are only counted, with the last one that is kept.
    pub fn left_out(&self) -> Vec<(&Origin, Code, Severity, usize)> {
        let kinds = self.kinds.iter();
        let more = kinds.map(|(kind, tally)| {
            let more = tally.count.saturating_sub(kind.enough());
            (&tally.last, kind.code, kind.severity, more)
        });
        more.filter(|(_, _, _, more)| *more > 0).collect()
    }

    /// Counts more of the kind of one that is kept.
    pub fn count_more(&mut self, of: Origin, code: Code, severity: Severity, more: usize) {
        let sample = Diagnostic::new(severity, code.0, of, "".into());
        if let Some(tally) = self.kinds.get_mut(&Kind::of(&sample)) {
            tally.count += more;
        }
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Removes the fixes with an edit that must not be made.
    pub fn retain_fixes(&mut self, keep: impl Fn(&Edit) -> bool) {
        let fixed = self.list.iter_mut().filter(|d| !d.fixes.is_empty());
        for found in fixed {
            found.fixes.retain(|fix| fix.edits.iter().all(&keep));
        }
    }

    /// Returns true if any diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// Returns the number of diagnostics, kept or not, by layer (`None` for source files), code and severity.
    pub fn counts(&self) -> BTreeMap<(Option<&str>, Code, Severity), usize> {
        let mut counts = BTreeMap::new();
        for (kind, tally) in &self.kinds {
            let layer = match &kind.of {
                Whole::File(_) => None,
                Whole::Layer(layer) => Some(&**layer),
            };
            *counts.entry((layer, kind.code, kind.severity)).or_default() += tally.count;
        }
        counts
    }

    /// Returns the kept diagnostics in the order of insertion.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Returns the diagnostics sorted by origin and code (stable), without exact repetitions. If some of a kind are left
    /// out, a diagnostic with their number follows the last one kept.
    pub fn into_sorted(mut self) -> Vec<Diagnostic> {
        for (kind, tally) in self.kinds {
            let more = tally.count.saturating_sub(kind.enough());
            if more > 0 {
                let closing = file::more_of_a_kind(tally.last, kind.code, more, kind.severity);
                self.list.push(closing);
            }
        }
        self.list
            .sort_by(|a, b| (&a.origin, a.code).cmp(&(&b.origin, b.code)));
        self.list.dedup();
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Language;
    use crate::source::Span;

    fn span(file: u32, start: u32) -> Span {
        Span {
            file: FileId(file),
            start,
            end: start + 1,
        }
    }

    fn feature(layer: &str, key: usize) -> Origin {
        Origin::Feature {
            layer: layer.into(),
            key: format!("b{key:04}").into(),
        }
    }

    fn words(list: &[Diagnostic], language: Language) -> Vec<String> {
        let words = list.iter().map(|d| d.message.in_language(language));
        words.map(String::from).collect()
    }

    #[test]
    fn a_layer_shows_twenty_of_a_kind_and_counts_the_rest() {
        let mut out = Diagnostics::new();
        for key in 0..25 {
            out.push(Diagnostic::warning(413, feature("bldg", key), "far off"));
            out.push(Diagnostic::error(410, feature("wall", key), "no wall"));
        }
        out.push(Diagnostic::note(413, feature("bldg", 3), "by the way"));
        out.push(Diagnostic::warning(413, span(0, 3), "far off"));
        let counts = out.counts();
        assert_eq!(counts[&(Some("bldg"), Code(413), Severity::Warning)], 25);
        assert_eq!(counts[&(Some("bldg"), Code(413), Severity::Note)], 1);
        assert_eq!(counts[&(Some("wall"), Code(410), Severity::Error)], 25);
        assert_eq!(counts[&(None, Code(413), Severity::Warning)], 1);
        assert!(out.has_errors());
        let list = out.into_sorted();
        assert_eq!(list.len(), 1 + 22 + 21);
        assert_eq!(list[0].span(), Some(span(0, 3)), "files come first");
        let closing = &list[22];
        assert_eq!(
            (closing.code, closing.severity),
            (Code(909), Severity::Warning)
        );
        assert_eq!(closing.origin, feature("bldg", 19));
        let both = [Language::English, Language::Japanese].map(|l| words(&list, l)[22].clone());
        assert_eq!(both[0], "… and 5 more of HSD0413 in the layer `bldg`");
        assert_eq!(both[1], "…レイヤー `bldg` にはほかに HSD0413 が5件あります");
    }

    #[test]
    fn a_file_shows_enough_of_a_kind_and_errors_stay() {
        let mut out = Diagnostics::new();
        for start in 0..2_000 {
            out.push(Diagnostic::warning(309, span(0, start), "idle"));
            out.push(Diagnostic::warning(309, span(1, start % 100), "idle"));
        }
        out.push(Diagnostic::error(309, span(0, 1_999), "worse"));
        let list = out.clone().into_sorted();
        assert_eq!(
            list.len(),
            2 * (ENOUGH + 1) + 1 - 400,
            "repetitions are one"
        );
        assert_eq!(list[ENOUGH].span(), Some(span(0, ENOUGH as u32 - 1)));
        let said = &words(&list, Language::English)[ENOUGH];
        assert_eq!(said, "1500 more of HSD0309 in this file are not shown");
        assert_eq!(list[ENOUGH + 1].severity, Severity::Error);
        // The count survives being joined, and is not doubled by what is known.
        let mut all = Diagnostics::new();
        all.append(out.clone());
        all.push_new(out.clone());
        assert_eq!(all.counts(), out.counts());
        assert_eq!(all.into_sorted(), list);
    }
}
