//! The models that a run of `hsd build` writes.

use crate::Failure;
use crate::files::input::STDIN;
use crate::files::output::Model;
use hsd_base::source::Source;
use hsd_base::text;
use std::collections::HashMap;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// The source files of one model and its output.
#[derive(Debug)]
pub(crate) struct Job {
    pub(super) inputs: Vec<PathBuf>,
    pub(super) output: PathBuf,
    pub(super) model: Model,
    /// The seed, if the model is one of several variants.
    pub(super) seed: Option<u64>,
}

impl Job {
    /// Fails if the model would be written to a terminal.
    pub(super) fn check_terminal(&self) -> Result<(), Failure> {
        if self.output.as_os_str() == STDIN && io::stdout().is_terminal() {
            return Err(Failure::Usage(text!(
                "a model cannot be printed on a terminal; name a file with -o, as in `-o house.glb`",
                "モデルは端末に出力できません。`-o house.glb` のように -o でファイルを指定してください"
            )));
        }
        Ok(())
    }

    /// The source files.
    pub(super) fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }

    /// Returns the paths of the source files, of those they include and of images.
    pub(super) fn files_read(&self, included: &[Source], pictures: &[String]) -> Vec<PathBuf> {
        let beside = included.iter().map(Source::name);
        let beside = beside.chain(pictures.iter().map(String::as_str));
        let read = self.inputs.iter().cloned();
        read.chain(beside.map(PathBuf::from)).collect()
    }
}

/// Returns a job for each input. Fails if two have the same output, ignoring case, as some file systems do.
pub(super) fn each(
    inputs: &[PathBuf],
    model: Model,
    output: impl Fn(&Path) -> PathBuf,
) -> Result<Vec<Job>, Failure> {
    let mut jobs: Vec<Job> = vec![];
    let mut taken = HashMap::new();
    // The catalogue file of a folder contains no house.
    let parts = |input: &PathBuf| inputs.len() > 1 && input.ends_with(hsd_driver::PARTS_BESIDE);
    for input in inputs.iter().filter(|input| !parts(input)) {
        let output = output(input);
        let key = output.to_string_lossy().to_lowercase();
        if let Some(other) = taken.insert(key, input) {
            return Err(Failure::one_output(other, input, &output));
        }
        jobs.push(Job {
            inputs: vec![input.clone()],
            output,
            model,
            seed: None,
        });
    }
    Ok(jobs)
}
