//! A production line: items are begun and handed on one at a time, in their order, and made on all threads between.
//!
//! No thread waits while there is work, and at most some items are under way. With any number of threads, each step sees the
//! same items.

use rayon::ScopeFifo;
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Begins items with `next` until there are none, makes each with `make` and hands it to `take`, on the threads of the current
/// `rayon` pool. The item with number `n`, counted from 0, is begun after the one with number `n - ahead` is taken.
///
/// # Errors
/// The first of `take`, after which nothing is begun or taken any more.
pub(super) fn in_order<A, B, E>(
    ahead: usize,
    next: impl FnMut(usize) -> Option<A> + Send,
    make: impl Fn(A) -> B + Sync,
    take: impl FnMut(usize, B) -> Result<(), E> + Send,
) -> Result<(), E>
where
    A: Send,
    B: Send,
    E: Send,
{
    let line = Line {
        ahead,
        next: Mutex::new(next),
        make,
        take: Mutex::new(take),
        state: Mutex::new(State {
            begun: 0,
            taken: 0,
            begins: true,
            takes: false,
            ended: false,
            made: BTreeMap::new(),
            failure: None,
        }),
    };
    rayon::scope_fifo(|scope| line.begin(scope));
    let state = line.state.into_inner();
    let failure = state.unwrap_or_else(PoisonError::into_inner).failure;
    failure.map_or(Ok(()), Err)
}

struct Line<N, M, T, B, E> {
    ahead: usize,
    next: Mutex<N>,
    make: M,
    take: Mutex<T>,
    state: Mutex<State<B, E>>,
}

struct State<B, E> {
    /// The numbers of items that were begun and taken.
    begun: usize,
    taken: usize,
    /// True while a thread begins items or is to, and while one takes some.
    begins: bool,
    takes: bool,
    /// True if no more are begun.
    ended: bool,
    /// Those that wait for others before them, by number.
    made: BTreeMap<usize, B>,
    failure: Option<E>,
}

impl<'s, N, M, T, A, B, E> Line<N, M, T, B, E>
where
    N: FnMut(usize) -> Option<A> + Send,
    M: Fn(A) -> B + Sync,
    T: FnMut(usize, B) -> Result<(), E> + Send,
    A: Send + 's,
    B: Send,
    E: Send,
{
    /// Begins items while there is room: what it takes to begin one may last long, as when a file is read, and meanwhile the other
    /// threads make those before it.
    fn begin(&'s self, scope: &ScopeFifo<'s>) {
        let mut next = locked(&self.next);
        loop {
            let mut state = self.state();
            let number = state.begun;
            if state.ended || number - state.taken >= self.ahead {
                state.begins = false;
                return;
            }
            drop(state);
            let item = next(number);
            let mut state = self.state();
            match item {
                Some(item) => {
                    state.begun += 1;
                    scope.spawn_fifo(move |scope| self.made(number, (self.make)(item), scope));
                }
                None => state.ended = true,
            }
        }
    }

    /// Keeps an item that is made. Then takes those whose turn it is, and begins more once half of them are taken, unless other
    /// threads do so.
    fn made(&'s self, number: usize, made: B, scope: &ScopeFifo<'s>) {
        let mut state = self.state();
        state.made.insert(number, made);
        if !std::mem::replace(&mut state.takes, true) {
            state = self.take(state);
            state.takes = false;
        }
        let room = state.begun - state.taken <= self.ahead / 2;
        if room && !state.ended && !std::mem::replace(&mut state.begins, true) {
            drop(state);
            // At once, so that there is work while it lasts.
            self.begin(scope);
        }
    }

    fn take<'a>(&'a self, mut state: MutexGuard<'a, State<B, E>>) -> MutexGuard<'a, State<B, E>> {
        while state.failure.is_none() {
            let number = state.taken;
            let Some(made) = state.made.remove(&number) else {
                break;
            };
            drop(state);
            let taken = locked(&self.take)(number, made);
            state = self.state();
            state.taken += 1;
            if let Err(error) = taken {
                (state.failure, state.ended) = (Some(error), true);
            }
        }
        state
    }

    fn state(&self) -> MutexGuard<'_, State<B, E>> {
        locked(&self.state)
    }
}

/// Locks what no other thread holds for long. A step that panics ends the run.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Runs a line on some threads, the items of which need times that differ; returns what was taken.
    fn run(
        threads: usize,
        ahead: usize,
        fails: Option<usize>,
    ) -> (Vec<(usize, u64)>, Option<usize>) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let (mut taken, under_way) = (vec![], AtomicUsize::new(0));
        let result = pool.expect("threads start").install(|| {
            in_order(
                ahead,
                |number| {
                    let before = under_way.fetch_add(1, Ordering::SeqCst);
                    assert!(before < ahead, "{before} items are under way");
                    (number < 200).then_some(number as u64)
                },
                |item| (0..item * 7919 % 5000).fold(item, |sum, n| sum.rotate_left(5) ^ n),
                |number, made| {
                    under_way.fetch_sub(1, Ordering::SeqCst);
                    taken.push((number, made));
                    if fails == Some(number) {
                        Err(number)
                    } else {
                        Ok(())
                    }
                },
            )
        });
        (taken, result.err())
    }

    #[test]
    fn items_are_taken_in_order_on_any_number_of_threads() {
        let (one, failure) = run(1, 1, None);
        assert_eq!(failure, None);
        assert!(one.iter().map(|(number, _)| *number).eq(0..200));
        for (threads, ahead) in [(1, 8), (2, 3), (4, 64), (8, 2)] {
            assert_eq!(run(threads, ahead, None), (one.clone(), None));
        }
    }

    #[test]
    fn nothing_is_taken_after_a_failure() {
        for threads in [1, 4] {
            let (taken, failure) = run(threads, 16, Some(50));
            assert_eq!(failure, Some(50));
            assert!(taken.iter().map(|(number, _)| *number).eq(0..51));
        }
    }
}
