//! Processor time of pieces of work, compared with other work of the same run: never with a clock, since the machine may be
//! busy, slow, or run a program that is optimised less.

use cpu_time::ThreadTime;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::time::Duration;

/// The most that work on four times the input may take, as a multiple: linear growth takes 4, a little more where the larger
/// input no longer fits a cache, quadratic 16.
const LINEAR: u32 = 10;

/// Measurements of each size before growth is called more than linear; the least of each counts, since whatever disturbs
/// a measurement makes it longer.
const ROUNDS: u32 = 20;

/// Smaller differences are the machine's.
const NOISE: Duration = Duration::from_micros(200);

thread_local! {
    /// A pool of this thread alone: work on several threads is done here, where it is measured.
    static ALONE: Option<ThreadPool> = {
        let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
        pool.build().ok()
    };
}

/// The processor time that this thread takes for a piece of work; it does the work of all threads itself.
pub fn spent<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    ALONE.with(|pool| assert!(pool.is_some(), "a test has a thread of its own"));
    let begun = ThreadTime::now();
    let result = work();
    (result, begun.elapsed())
}

/// Reports work that grows faster than its input. `make` makes an input of the size that it is given, which takes no
/// part in the measurement.
pub fn growth<I, T>(
    size: usize,
    make: impl Fn(usize) -> I,
    work: impl Fn(&I) -> T,
) -> Option<String> {
    let (small, large) = (make(size), make(4 * size));
    let time = |input| spent(|| work(input)).1;
    let (mut least, mut most) = (time(&small), Duration::MAX);
    for _ in 0..ROUNDS {
        most = most.min(time(&large));
        if most <= least * LINEAR + NOISE {
            return None;
        }
        least = least.min(time(&small));
    }
    let times = most.as_secs_f64() / least.as_secs_f64().max(1e-9);
    Some(format!(
        "takes {times:.1} times as long for four times as much: {least:?}, then {most:?}"
    ))
}

/// Fails where work grows faster than its input, as [`growth`] reports it.
pub fn assert_linear<I, T>(
    name: &str,
    size: usize,
    make: impl Fn(usize) -> I,
    work: impl Fn(&I) -> T,
) {
    let faster = growth(size, make, work);
    assert!(faster.is_none(), "{name} {}", faster.unwrap_or_default());
}

#[test]
fn work_that_grows_faster_is_noticed() {
    let list = |size| (0..size as u64).collect::<Vec<_>>();
    let linear = |list: &Vec<u64>| {
        list.iter()
            .fold(7u64, |sum, n| std::hint::black_box(sum ^ n))
    };
    // Four times as much takes 64 times as long: no disturbance of a measurement hides that.
    let cubic = |list: &Vec<u64>| {
        let triples = list.iter().flat_map(|_| list).map(|_| linear(list));
        triples.fold(0, |sum, n| sum ^ n)
    };
    assert_eq!(growth(500_000, list, linear), None);
    assert!(growth(150, list, cubic).is_some());
}

#[test]
fn work_of_other_threads_is_counted() {
    use rayon::prelude::*;
    let sum = |n: u64| (0..n).fold(7u64, |sum, n| std::hint::black_box(sum ^ n));
    let (_, one) = spent(|| sum(4_000_000));
    let (_, eight) = spent(|| (0..8).into_par_iter().map(|_| sum(4_000_000)).sum::<u64>());
    assert!(eight > one, "{one:?}, then {eight:?}");
}
