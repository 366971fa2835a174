//! Progress of `hsd build`: messages and a bar on standard error.

use crate::Failure;
use crate::files::messages::{Teller, Told};
use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Source;
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::OnceCell;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// Progress on standard error; with a progress bar if there are several jobs, they take long and it is a terminal.
pub(super) struct Progress {
    pub(super) teller: Teller,
    /// True if only diagnostics are printed.
    pub(super) quiet: bool,
    /// True if a line is printed for each model.
    pub(super) verbose: bool,
    start: Instant,
    jobs: usize,
    done: std::cell::Cell<u64>,
    bar: OnceCell<ProgressBar>,
}

impl Progress {
    pub(super) fn new(quiet: bool, jobs: usize, teller: Teller) -> Progress {
        let quiet = quiet || teller.is_program();
        Progress {
            teller,
            quiet,
            verbose: !quiet && jobs == 1,
            start: Instant::now(),
            jobs,
            done: 0.into(),
            bar: OnceCell::new(),
        }
    }

    pub(super) fn line(&self, text: &Text) -> Result<(), Failure> {
        let text = text.in_language(self.teller.language);
        self.above(|| writeln!(io::stderr(), "{text}"))?;
        Ok(())
    }

    pub(super) fn report(&self, sources: &[Source], list: &[Diagnostic]) -> Result<Told, Failure> {
        self.above(|| self.teller.report(sources, list))
    }

    /// Writes above the progress bar.
    fn above<T>(&self, write: impl FnOnce() -> T) -> T {
        match self.bar.get() {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    pub(super) fn advance(&self) -> Result<(), Failure> {
        self.done.set(self.done.get() + 1);
        if self.jobs > 1 {
            self.teller.progress(self.done.get() as usize, self.jobs)?;
        }
        let long = self.start.elapsed() > Duration::from_secs(1);
        if self.jobs > 1 && long && !self.quiet && io::stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {eta}");
            let bar = self.bar.get_or_init(|| {
                let bar = ProgressBar::new(self.jobs as u64);
                style.map_or(bar.clone(), |style| bar.with_style(style))
            });
            bar.set_position(self.done.get());
        }
        Ok(())
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}
