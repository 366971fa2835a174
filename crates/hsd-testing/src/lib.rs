//! Helpers that the tests of several crates share: words of messages, samples for properties, processor time.

use hsd_base::diagnostic::{Language, Text};
use proptest::test_runner::{Config as ProptestConfig, RngSeed};
use std::path::Path;

pub mod cpu;

/// The words of a text.
pub trait Words {
    /// Returns the English words.
    fn en(&self) -> String;
    /// Returns the Japanese words.
    fn ja(&self) -> String;
}

impl Words for Text {
    fn en(&self) -> String {
        self.in_language(Language::English).into_owned()
    }

    fn ja(&self) -> String {
        self.in_language(Language::Japanese).into_owned()
    }
}

/// True if the tests are optimised. Tests of many inputs use fewer of them otherwise.
pub const OPTIMISED: bool = !matches!(env!("HSD_OPT_LEVEL").as_bytes(), b"0");

/// Returns a configuration of `cases` samples per property, the same in every run. `PROPTEST_RNG_SEED` and
/// `PROPTEST_CASES` select other samples and more.
pub fn sampled(cases: u32) -> ProptestConfig {
    let asked = ProptestConfig::default();
    let rng_seed = match asked.rng_seed {
        RngSeed::Random => RngSeed::Fixed(1),
        fixed => fixed,
    };
    let more = std::env::var_os("PROPTEST_CASES").is_some();
    ProptestConfig {
        cases: if more { asked.cases } else { cases },
        failure_persistence: None,
        rng_seed,
        ..asked
    }
}

/// Returns the root of the repository.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Fails with all findings at once.
pub fn assert_none(findings: &[String]) {
    assert!(
        findings.is_empty(),
        "{} findings\n{}\n",
        findings.len(),
        findings.join("\n")
    );
}
