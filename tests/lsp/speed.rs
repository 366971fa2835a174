//! Processor time that a key takes, compared with a whole check of the same text, and memory that keys leave behind. The times
//! themselves: `cargo bench --bench lsp`.

use crate::lsp::program::Program;
use crate::support::OPTIMISED;
use crate::support::cpu::spent;
use hsd::diagnostic::Diagnostics;
use hsd::driver::{self, Options};
use hsd::source::{FileId, NoFiles, Source};
use serde_json::{Value, json};
use std::time::Duration;

const URI: &str = "file:///speed.hsd";
const HOUSE: &str = include_str!("../../examples/machiya.hsd");

/// Types keys number `first` and following into a text, and waits for the diagnostics of each.
fn keys(program: &mut Program, first: usize, count: usize, lines: usize) {
    for key in first..first + count {
        let line = 8 + (key / 2 * 7919) % (lines / 21) * 21;
        let place = |character: usize| json!({ "line": line, "character": character });
        let change = json!([{
            "range": { "start": place(1), "end": place(2) },
            "text": if key % 2 == 0 { "Q" } else { "P" },
        }]);
        program.change(URI, key + 2, change);
    }
}

/// A street of the house in a number of lines.
fn text(lines: usize) -> String {
    vec![HOUSE.trim_end(); lines / 21].join("\n%\n")
}

fn open(lines: usize) -> Program {
    let mut program = Program::start();
    program.open(URI, &text(lines));
    program
}

fn close(mut program: Program) {
    program.ask(2, "shutdown", Value::Null);
    program.notify("exit", Value::Null);
    assert_eq!(program.end(), Some(0));
}

/// Returns the processor time in this process for everything that `hsd check` does with the text of [`open`]: the mean of some runs.
fn check(lines: usize, runs: usize) -> Duration {
    let source = Source::new(FileId(0), "speed.hsd", text(lines).as_bytes());
    let all = || {
        for _ in 0..runs {
            let (options, mut out) = (Options::default(), Diagnostics::new());
            driver::check(&[&source], &NoFiles, &options, &mut out);
        }
    };
    spent(all).1 / runs as u32
}

#[test]
#[cfg_attr(not(target_os = "linux"), ignore = "reads /proc")]
fn a_key_takes_no_longer_than_checking_the_text() {
    for (lines, count) in [(2_000, 400), (20_000, 80)] {
        let mut program = open(lines);
        let part = count / 10;
        // A check is measured right after some keys, since a machine that others use is slower at times.
        let pairs: Vec<(Duration, Duration)> = (0..10)
            .map(|k| {
                let (before, _) = program.used().expect("/proc is there");
                keys(&mut program, k * part, part, lines);
                let (after, _) = program.used().expect("/proc is there");
                ((after - before) / part as u32, check(lines, part))
            })
            .collect();
        assert!(
            pairs.iter().any(|(key, check)| *key < 2 * *check),
            "{lines} lines: processor time of a key and of `hsd check`: {pairs:?}"
        );
        close(program);
    }
}

#[test]
#[cfg_attr(not(target_os = "linux"), ignore = "reads /proc")]
fn thousands_of_keys_leave_no_memory_behind() {
    let lines = 210;
    let mut program = open(lines);
    keys(&mut program, 0, 1000, lines);
    let (_, before) = program.used().expect("/proc is there");
    let count = if OPTIMISED { 4_000 } else { 1_000 };
    keys(&mut program, 1000, count, lines);
    let (_, after) = program.used().expect("/proc is there");
    assert!(after < before + 8 * 1024, "{before} KiB became {after} KiB");
    close(program);
}
