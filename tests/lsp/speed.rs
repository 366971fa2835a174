//! How long a key takes and what memory it leaves behind; measured where the program is optimized. `cargo bench --bench
//! lsp` tells more.

use crate::lsp::program::Program;
use crate::support::clock::{OPTIMISED, slowness};
use serde_json::{Value, json};
use std::time::Duration;

const URI: &str = "file:///speed.hsd";
const HOUSE: &str = include_str!("../../examples/machiya.hsd");

/// Types so many keys into a text, and waits for the diagnostics of each.
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

fn open(lines: usize) -> Program {
    let text = vec![HOUSE.trim_end(); lines / 21].join("\n%\n");
    let mut program = Program::start();
    program.open(URI, &text);
    program
}

fn close(mut program: Program) {
    program.ask(2, "shutdown", Value::Null);
    program.notify("exit", Value::Null);
    assert_eq!(program.end(), Some(0));
}

#[test]
#[ignore = "measures time, which needs the machine for itself"]
fn a_key_takes_milliseconds() {
    if !OPTIMISED {
        return;
    }
    for (lines, bound) in [(2_000, 10), (20_000, 50)] {
        let mut program = open(lines);
        let Some((before, _)) = program.used() else {
            return;
        };
        let count = 200;
        keys(&mut program, 0, count, lines);
        let (after, _) = program.used().expect("was told before");
        let each = (after - before) / count as u32;
        let bound = Duration::from_millis(bound).mul_f64(slowness());
        assert!(
            each < bound,
            "{lines} lines: {each:?} of processor time a key, more than {bound:?}"
        );
        close(program);
    }
}

#[test]
fn ten_thousand_keys_leave_no_memory_behind() {
    if !OPTIMISED {
        return;
    }
    let lines = 210;
    let mut program = open(lines);
    keys(&mut program, 0, 1000, lines);
    let Some((_, before)) = program.used() else {
        return;
    };
    keys(&mut program, 1000, 10_000, lines);
    let (_, after) = program.used().expect("was told before");
    assert!(after < before + 8 * 1024, "{before} KiB became {after} KiB");
    close(program);
}
