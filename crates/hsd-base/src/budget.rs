//! Bounds on what inputs expand to, so that no file exhausts memory or time by naming the same thing many times.
//!
//! A run has one [`Budget`], and each file that is read has an [`Account`] with it. The allowance of an account grows with the
//! bytes of the file, so what a file writes out is always granted. References and packed data expand to more than that. The
//! difference is taken from the budget that all files share, and returned when the file has been read.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A resource that is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resource {
    /// Points of geometries.
    Points,
    /// Bytes of texts of fields.
    TextBytes,
    /// Features, and the parts of one.
    Features,
    /// Bytes that packed data expand to.
    InflatedBytes,
    /// Pixels of images and cells of grids.
    Pixels,
}

impl Resource {
    const COUNT: usize = 5;

    /// Bytes of memory of a run for each one that files may share.
    fn bytes(self) -> u64 {
        match self {
            Resource::Points => 256,
            Resource::Features => 2048,
            Resource::TextBytes | Resource::Pixels => 16,
            Resource::InflatedBytes => 8,
        }
    }

    /// Returns the allowance of a file of this size, bytes. It is at least twice what the densest real files need.
    fn granted(self, bytes: u64) -> u64 {
        match self {
            Resource::Features => bytes / 8,
            Resource::Points => bytes,
            Resource::TextBytes | Resource::Pixels => bytes.saturating_mul(16),
            Resource::InflatedBytes => bytes.saturating_mul(100),
        }
    }

    /// Returns the name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Resource::Points => "points",
            Resource::TextBytes => "bytes of text",
            Resource::Features => "features",
            Resource::InflatedBytes => "unpacked bytes",
            Resource::Pixels => "pixels or cells",
        }
    }
}

/// The budget of a run.
#[derive(Debug)]
pub struct Budget {
    limits: [u64; Resource::COUNT],
    spent: [AtomicU64; Resource::COUNT],
}

impl Budget {
    /// The memory of a run, bytes, where none is given.
    pub const MEMORY: u64 = 512 << 20;

    /// Creates the budget of a run that may take about this memory for what its files expand to, bytes.
    pub fn new(memory: u64) -> Budget {
        let all = [
            Resource::Points,
            Resource::TextBytes,
            Resource::Features,
            Resource::InflatedBytes,
            Resource::Pixels,
        ];
        let mut limits = [0; Resource::COUNT];
        for of in all {
            limits[of as usize] = memory / of.bytes();
        }
        Budget {
            limits,
            spent: Default::default(),
        }
    }

    fn take(&self, of: Resource, count: u64) -> Result<(), Exhausted> {
        let limit = self.limits[of as usize];
        let taken =
            self.spent[of as usize].fetch_update(Ordering::Relaxed, Ordering::Relaxed, |spent| {
                spent.checked_add(count).filter(|sum| *sum <= limit)
            });
        taken.map(drop).map_err(|_| Exhausted { of, limit })
    }
}

impl Default for Budget {
    fn default() -> Budget {
        Budget::new(Budget::MEMORY)
    }
}

/// The account of a file with the budget of its run.
#[derive(Debug)]
pub struct Account {
    budget: Arc<Budget>,
    /// Bytes of the file so far.
    bytes: AtomicU64,
    spent: [AtomicU64; Resource::COUNT],
    /// The share that was taken from the budget.
    taken: [AtomicU64; Resource::COUNT],
}

impl Account {
    /// Opens an account for a file of which nothing has been read.
    pub fn new(budget: Arc<Budget>) -> Arc<Account> {
        Arc::new(Account {
            budget,
            bytes: AtomicU64::default(),
            spent: Default::default(),
            taken: Default::default(),
        })
    }

    /// Adds the number of bytes that were read from the file, before unpacking.
    pub fn read(&self, bytes: u64) {
        self.bytes.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Charges what the file expands to, before it is made. A file is read by one thread at a time.
    ///
    /// # Errors
    /// If neither the bytes of the file nor the budget allow it. Nothing is charged then.
    pub fn charge(&self, of: Resource, count: u64) -> Result<(), Exhausted> {
        let at = of as usize;
        let spent = self.spent[at].load(Ordering::Relaxed).saturating_add(count);
        let own = of.granted(self.bytes.load(Ordering::Relaxed));
        let taken = self.taken[at].load(Ordering::Relaxed);
        let more = spent.saturating_sub(own).saturating_sub(taken);
        if more > 0 {
            self.budget.take(of, more)?;
            self.taken[at].store(taken + more, Ordering::Relaxed);
        }
        self.spent[at].store(spent, Ordering::Relaxed);
        Ok(())
    }
}

impl Drop for Account {
    fn drop(&mut self) {
        for (shared, taken) in self.budget.spent.iter().zip(&self.taken) {
            shared.fetch_sub(taken.load(Ordering::Relaxed), Ordering::Relaxed);
        }
    }
}

/// The reason why something is not made: it would exceed the budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exhausted {
    /// The resource that is exhausted.
    pub of: Resource,
    /// The number that the files of the run share.
    pub limit: u64,
}

impl fmt::Display for Exhausted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "more than {} {}", self.limit, self.of.name())
    }
}

impl std::error::Error for Exhausted {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_writes_out_is_granted() {
        let account = Account::new(Arc::new(Budget::new(0)));
        assert!(account.charge(Resource::Points, 1).is_err());
        account.read(100);
        assert!(account.charge(Resource::Points, 100).is_ok());
        assert!(account.charge(Resource::Points, 1).is_err());
        assert!(account.charge(Resource::TextBytes, 1600).is_ok());
    }

    #[test]
    fn files_share_what_goes_beyond_and_return_it() {
        let budget = Arc::new(Budget::new(2560));
        let (one, two) = (Account::new(budget.clone()), Account::new(budget.clone()));
        assert!(one.charge(Resource::Points, 7).is_ok());
        let refused = two.charge(Resource::Points, 4);
        assert_eq!(
            refused,
            Err(Exhausted {
                of: Resource::Points,
                limit: 10
            })
        );
        assert!(two.charge(Resource::Points, 3).is_ok());
        drop(one);
        assert!(two.charge(Resource::Points, 7).is_ok());
        assert!(two.charge(Resource::Points, u64::MAX).is_err());
    }
}
