//! From keystroke to diagnostics, through the protocol: `cargo bench --bench lsp`.
//!
//! A client starts `hsd lsp`, types into texts of 2,000 and 20,000 lines of both forms, and waits after each key for the
//! diagnostics of its version. Printed are percentiles of the time from the key to the last byte of the answer, by the
//! clock; processor time of the server a key; and its memory before and after.

#![expect(clippy::print_stdout)] // that is what it is for

use program::Program;
use serde_json::json;
use std::time::Instant;

#[path = "../tests/lsp/program.rs"]
#[expect(unreachable_pub)] // it is a module of the tests as well
mod program;
mod texts;

/// Keys typed into each text; `HSD_KEYS` sets another number.
const KEYS: usize = 1000;

/// Types into a text and reports.
fn type_into(name: &str, text: &str, keys: usize) {
    let mut program = Program::start();
    let uri = "file:///bench/bench.hsd";
    program.open(uri, text);
    let lines: Vec<&str> = text.lines().collect();
    let walls: Vec<usize> = (0..lines.len())
        .filter(|l| lines[*l].contains("KSK  "))
        .collect();
    let (mut times, before) = (vec![], program.used());
    for key in 0..keys {
        // A letter of a code goes wrong and comes right again, all over the text.
        let line = walls[(key / 2) * 7919 % walls.len()];
        let column = lines[line].find("KSK  ").expect("is there");
        let place = |character: usize| json!({ "line": line, "character": character });
        let change = json!([{
            "range": { "start": place(column + 1), "end": place(column + 2) },
            "text": if key % 2 == 0 { "Q" } else { "S" },
        }]);
        let begun = Instant::now();
        program.change(uri, key + 2, change);
        times.push(begun.elapsed());
    }
    times.sort();
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e3;
    let used = program.used().zip(before);
    let each = used.map(|((after, _), (before, _))| (after - before).as_secs_f64() * 1e3);
    let memory = used.map_or((0, 0), |((_, after), (_, before))| (before, after));
    println!(
        "{name:22} {:6} lines {:5} kB  p50 {:6.2} ms  p90 {:6.2} ms  p99 {:6.2} ms  max {:6.2} ms  processor {:5.2} ms  memory {} -> {} KiB",
        lines.len(),
        text.len() / 1000,
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0),
        each.map_or(f64::NAN, |each| each / keys as f64),
        memory.0,
        memory.1,
    );
    program.end();
}

fn main() {
    let keys = std::env::var("HSD_KEYS").ok().and_then(|k| k.parse().ok());
    let keys = keys.unwrap_or(KEYS);
    for lines in [2_000, 20_000] {
        type_into("legacy, a street", &texts::legacy_lines(lines), keys);
        type_into("XML, a street", &texts::xml_lines(lines), keys);
    }
}
