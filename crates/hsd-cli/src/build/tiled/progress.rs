//! How far the building of a town is: a bar for people at a terminal, lines for a program.

use crate::Failure;
use crate::files::messages::Teller;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};
use std::sync::{Mutex, PoisonError};

/// The features of a town that are done.
pub(in crate::build) struct Progress {
    bar: ProgressBar,
    teller: Teller,
    of: usize,
    /// How many, or why no more of them can be told.
    done: Mutex<Result<usize, Failure>>,
}

impl Progress {
    /// Begins with all features ahead; without a bar if `quiet`.
    pub(in crate::build) fn new(of: usize, quiet: bool, teller: Teller) -> Progress {
        Progress {
            bar: bar(of, quiet, teller),
            teller,
            of,
            done: Mutex::new(Ok(0)),
        }
    }

    /// Tells that some more features are done.
    pub(in crate::build) fn advance(&self, features: usize) {
        self.bar.inc(features as u64);
        // One line after another. Where nobody reads them any more, the run goes on and ends with that.
        let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        if let Ok(before) = *done {
            let now = before + features;
            *done = self.teller.progress(now, self.of).map(|()| now);
        }
    }

    /// Takes the bar away.
    pub(in crate::build) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Ends it. Fails if a line could not be written.
    pub(in crate::build) fn finish(self) -> Result<(), Failure> {
        self.clear();
        let done = self
            .done
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        done.map(drop)
    }
}

/// Returns a bar with rate and time left, hidden where nobody looks.
fn bar(features: usize, quiet: bool, teller: Teller) -> ProgressBar {
    if quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template(teller.language.choose(
        "{bar:40} {pos}/{len} features, {per_sec}, {eta} left",
        "{bar:40} {pos}/{len} 件、{per_sec}、残り {eta}",
    ));
    let bar = ProgressBar::new(features as u64);
    style.map_or(bar.clone(), |style| bar.with_style(style))
}
