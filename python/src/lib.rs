//! The native half of the Python package `hsd`: models and messages of texts, and the command line, for the steps of a town and as
//! the program itself. Python's lock is free while hsd works.

mod job;

use hsd::Language;
use job::{Job, Told};
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::ffi::OsString;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

// As in the program: a town is millions of small trees.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The stack of a thread, bytes: texts nest deeply, and Python's own threads are small on some systems.
const STACK: usize = 16 << 20;

/// How long a signal may wait.
const PAUSE: Duration = Duration::from_millis(100);

/// Does a job without Python's lock, on threads of its own: a process that was forked has none of its parent's. A signal ends the
/// waiting, not the job, which goes on until it or the process ends.
///
/// # Errors If a signal came (`KeyboardInterrupt`), if there can be no threads, or if hsd has a fault.
fn apart<T: Send + 'static>(
    py: Python<'_>,
    threads: usize,
    job: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let pool = rayon::ThreadPoolBuilder::new();
    let pool = pool.num_threads(threads).stack_size(STACK).build();
    let pool = pool.map_err(|error| PyOSError::new_err(error.to_string()))?;
    let (done, mut wait) = channel();
    pool.spawn(move || {
        let made = std::panic::catch_unwind(std::panic::AssertUnwindSafe(job));
        // Nobody waits after a signal.
        let _ = done.send(made);
    });
    loop {
        let waiting = &mut wait;
        match py.detach(move || waiting.recv_timeout(PAUSE)) {
            Ok(Ok(made)) => return Ok(made),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Ok(Err(_)) | Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "hsd has a fault; standard error says where",
                ));
            }
        }
    }
}

fn language(name: &str) -> PyResult<Language> {
    match name {
        "en" => Ok(Language::English),
        "ja" => Ok(Language::Japanese),
        _ => Err(PyValueError::new_err("language is `en` or `ja`")),
    }
}

/// Makes a model: its bytes, none if the text has errors; the messages; and these with excerpts of the text.
#[pyfunction]
fn compile<'py>(
    py: Python<'py>,
    job: Job,
    threads: usize,
) -> PyResult<(Option<Bound<'py, PyBytes>>, Vec<Told>, String)> {
    let (glb, list, report) = apart(py, threads, move || job.compile())??;
    Ok((glb.map(|glb| PyBytes::new(py, &glb)), list, report))
}

/// Finds what is wrong with a text: the messages, and these with excerpts of the text.
#[pyfunction]
fn check(py: Python<'_>, job: Job, threads: usize) -> PyResult<(Vec<Told>, String)> {
    apart(py, threads, move || job.check())?.map_err(PyErr::from)
}

/// Lists the parts whose code or names hold a word, one a line.
#[pyfunction]
fn parts(filter: Option<String>, language: &str) -> PyResult<String> {
    Ok(hsd::cli::parts(filter, self::language(language)?))
}

/// Runs a command line; returns its exit status and what it says of its failure. Signals are left to Python.
#[pyfunction]
fn call(py: Python<'_>, arguments: Vec<OsString>, threads: usize) -> PyResult<(u8, String)> {
    apart(py, threads, move || hsd::cli::call(arguments))
}

/// Is the program: runs a command line, prints what it says and returns its exit status.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| hsd::cli::run(arguments))
}

/// The module that Python loads.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(compile, module)?)?;
    module.add_function(wrap_pyfunction!(check, module)?)?;
    module.add_function(wrap_pyfunction!(parts, module)?)?;
    module.add_function(wrap_pyfunction!(call, module)?)?;
    module.add_function(wrap_pyfunction!(main, module)?)
}
