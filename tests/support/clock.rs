//! Processor time, and how fast this machine is just now.

use super::Numbers;
use std::fs;
use std::time::{Duration, Instant};

/// What [`drill`] takes on the machine that the bound was set on, when nothing else runs there.
const DRILL: Duration = Duration::from_millis(150);

/// Whether the program is optimised as far as it goes. If not, the time it takes says nothing about the program, and tests
/// are content with fewer inputs. Another question than whether it asserts, which `.ci/run` lets an optimised one do.
pub const OPTIMISED: bool = matches!(env!("HSD_OPT_LEVEL").as_bytes(), b"3");

/// How much slower than that machine this one is now: processor time too grows where others share caches and
/// memory. Never less than 1. `HSD_SLACK` is a factor for programs that are optimised less than those for users.
pub fn slowness() -> f64 {
    let fastest = (0..3).map(|_| drill()).min().expect("three drills");
    let slack = std::env::var("HSD_SLACK").ok();
    let slack: f64 = slack.and_then(|s| s.parse().ok()).unwrap_or(1.0);
    (fastest.as_secs_f64() / DRILL.as_secs_f64()).max(1.0) * slack
}

/// Processor time of work like the program's: small pieces of memory taken, filled, sorted and given back.
fn drill() -> Duration {
    let begun = Instant::now();
    let before = worked(begun);
    let mut numbers = Numbers(7);
    let mut kept: Vec<Vec<u64>> = vec![];
    let mut sum = 0;
    for _ in 0..600_000 {
        let mut piece: Vec<u64> = (0..8 + numbers.below(56)).map(|_| numbers.next()).collect();
        piece.sort_unstable();
        sum ^= piece[0];
        kept.push(piece);
        if kept.len() > 20_000 {
            kept.swap_remove(numbers.below(20_000));
        }
    }
    std::hint::black_box(sum);
    worked(begun).saturating_sub(before)
}

/// Time that this thread has had a processor for, so that a busy machine does not count; where the system
/// does not tell it, time by the clock.
pub fn worked(begun: Instant) -> Duration {
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|t| t.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| begun.elapsed(), Duration::from_nanos)
}
