//! A mebibyte of anything is checked within a second of processor time and 256 MiB (docs/contract.md 7). Time is compared with
//! a drill of the same run, memory is what the system says of a process.

use super::heaps::{Heap, heaps};
use crate::support::cpu::spent;
use crate::support::{assert_none, number};
use hsd::backend::spool::in_memory;
use hsd::diagnostic::Diagnostics;
use hsd::driver::Feed;
use hsd::source::{FileId, NoFiles, Source};
use hsd::{Options, driver};
use std::fs;
use std::hint::black_box;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Bytes of an input, and of memory.
const SIZE: usize = 1 << 20;
const MEMORY: u64 = 256 << 20;

/// Steps of the drill: a second on the slowest machine that the contract was measured on.
const DRILL: u64 = 300_000_000;

/// What is known to take longer, and how many times the drill: searches for the best cuts of roofs.
const LONGER: [(&str, u32); 2] = [("stairs of 10", 8), ("stairs of 100", 3)];

fn drill() -> Duration {
    let steps = || {
        let mut n = 88_172_645_463_325_252_u64;
        for _ in 0..DRILL {
            n ^= n << 13;
            n ^= n >> 7;
            n ^= n << 17;
            black_box(n);
        }
    };
    spent(steps).1
}

/// The most memory that a process has had, while it could still be asked, in bytes.
fn peak(arguments: &[&std::ffi::OsStr]) -> u64 {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hsd"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0;
    while child.try_wait().expect("it can be waited for").is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        let kib = line.and_then(|l| l.trim().trim_end_matches(" kB").parse::<u64>().ok());
        most = most.max(kib.unwrap_or(0) << 10);
        sleep(Duration::from_millis(2));
    }
    most
}

fn findings(heap: &Heap, folder: &std::path::Path, drill: Duration) -> Vec<String> {
    let bytes = heap.of(SIZE);
    let source = Source::new(FileId(0), heap.name, &bytes);
    let check = || {
        let (options, mut out) = (Options::default(), Diagnostics::new());
        let sources = [&source];
        let feed = Feed::whole(&sources);
        let found = driver::inspect(feed, &NoFiles, &options, &mut out, &in_memory);
        found.expect("memory takes every byte").houses
    };
    let took = spent(check).1.min(spent(check).1);
    let path = folder.join("heap.hsd");
    fs::write(&path, &bytes).expect("can be written");
    let memory = peak(&[
        "check".as_ref(),
        "--threads".as_ref(),
        "2".as_ref(),
        path.as_ref(),
    ]);
    let times = LONGER.iter().find(|(name, _)| *name == heap.name);
    let most = drill * times.map_or(1, |(_, times)| *times);
    let mut found = vec![];
    if took > most {
        found.push(format!("{}: took {took:?}, more than {most:?}", heap.name));
    }
    if memory > MEMORY {
        found.push(format!("{}: took {} MiB", heap.name, memory >> 20));
    }
    found
}

#[cfg(target_os = "linux")]
#[test]
fn a_mebibyte_of_anything_is_checked_within_a_second_and_256_mib() {
    if number("HSD_INPUTS", 1) == 1 {
        return; // It takes a minute.
    }
    let folder = tempfile::tempdir().expect("a folder can be made");
    let drill = drill();
    let all = heaps();
    let all = all.iter().flat_map(|h| findings(h, folder.path(), drill));
    assert_none(&all.collect::<Vec<_>>());
}
