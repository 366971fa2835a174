//! The native half of the Python package `hsd`: models and diagnostics of source files, and the command line as a function, from
//! which the package makes the steps of a town. Python's lock is released while hsd works.

use hsd::diagnostic::Origin;
use hsd::render;
use hsd::scene::{NodeId, Scene};
use hsd::{
    Detail, Diagnostics, FileId, FolderWorld, Language, NoFiles, Options, Severity, Source, World,
};
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::io::Cursor;
use std::path::PathBuf;

create_exception!(
    _hsd,
    CompileError,
    PyException,
    "The source file has errors: `args[1]` is the list of its diagnostics."
);

/// The most pixels of an image that a source file names.
const PIXELS: u64 = 100_000_000;

/// A problem of a source file, with its place, its reason and its fix.
#[pyclass(frozen, get_all, eq, module = "hsd")]
#[derive(Clone, Debug, PartialEq)]
struct Diagnostic {
    /// The stable code, such as `HSD0104`; `hsd explain` tells more.
    code: String,
    /// `error`, `warning` or `note`.
    severity: String,
    /// The problem, in one sentence.
    message: String,
    /// How to fix it; empty if nothing can be said.
    help: String,
    /// The file.
    file: String,
    /// The first line and column, from 1; 0 for a feature of a map.
    line: usize,
    column: usize,
}

#[pymethods]
impl Diagnostic {
    fn __repr__(&self) -> String {
        let Diagnostic { code, severity, .. } = self;
        let Diagnostic { file, line, column, .. } = self;
        format!("<{severity} {code} {file}:{line}:{column}: {}>", self.message)
    }

    fn __str__(&self) -> String {
        let Diagnostic { code, severity, .. } = self;
        let Diagnostic { file, line, column, .. } = self;
        format!("{file}:{line}:{column}: {severity}[{code}]: {}", self.message)
    }
}

/// A source file and how it is read.
struct Job {
    source: Source,
    world: Box<dyn World + Send + Sync>,
    options: Options,
    language: Language,
}

impl Job {
    fn new(
        (text, name, folder): (&str, &str, Option<PathBuf>),
        (parameters, seed, detail): (Vec<(String, String)>, Option<u64>, u8),
        language: &str,
    ) -> PyResult<Job> {
        let detail = *Detail::ALL.get(usize::from(detail)).ok_or_else(|| {
            PyValueError::new_err("detail is 0, 1, 2 or 3")
        })?;
        let language = match language {
            "en" => Language::English,
            "ja" => Language::Japanese,
            _ => return Err(PyValueError::new_err("language is `en` or `ja`")),
        };
        let mut options = Options {
            parameters,
            detail,
            ..Options::default()
        };
        options.expand.seed = seed;
        let name = match &folder {
            Some(folder) => folder.join(name).to_string_lossy().into_owned(),
            None => name.to_owned(),
        };
        Ok(Job {
            source: Source::new(FileId(0), &name, text.as_bytes()),
            world: match folder {
                Some(folder) => Box::new(
                    FolderWorld::new(vec![folder.clone(), folder.join("textures")], PIXELS)
                        .with_roots(vec![folder]),
                ),
                None => Box::new(NoFiles),
            },
            options,
            language,
        })
    }

    /// Returns what was found, with the files that were read beside the source.
    fn list(&self, out: Diagnostics, included: &[Source]) -> Vec<Diagnostic> {
        let list = out.into_sorted().into_iter();
        let words = |text: &hsd::diagnostic::Text| text.in_language(self.language).into_owned();
        let one = |d: hsd::Diagnostic| {
            let mut sources = std::iter::once(&self.source).chain(included);
            let place = match &d.origin {
                Origin::Source(span) => sources
                    .find(|source| source.id() == span.file)
                    .map(|source| (source.name().to_owned(), source.line_column(*span))),
                Origin::Feature { .. } => None,
            };
            let (file, (line, column)) = place.unwrap_or((self.source.name().to_owned(), (0, 0)));
            Diagnostic {
                code: d.code.to_string(),
                severity: match d.severity {
                    Severity::Error => "error",
                    Severity::Warning => "warning",
                    Severity::Note => "note",
                }
                .to_owned(),
                message: words(&d.full_message()),
                help: words(&d.help),
                file,
                line,
                column,
            }
        };
        list.map(one).collect()
    }

    /// Compiles the source, and hands the result to `then` unless there are errors.
    fn compiled<T>(
        &self,
        then: impl FnOnce(&hsd::Compiled, &mut Diagnostics) -> T,
    ) -> Result<T, Vec<Diagnostic>> {
        let mut out = Diagnostics::new();
        let compiled = hsd::compile(&[&self.source], &*self.world, &self.options, &mut out);
        if out.has_errors() {
            return Err(self.list(out, &compiled.included));
        }
        let made = then(&compiled, &mut out);
        match out.has_errors() {
            true => Err(self.list(out, &compiled.included)),
            false => Ok(made),
        }
    }
}

/// Makes the exception for a source file with errors.
fn refused(list: Vec<Diagnostic>) -> PyErr {
    let first = list.iter().find(|d| d.severity == "error");
    let message = first.map_or(String::new(), Diagnostic::__str__);
    CompileError::new_err((message, list))
}

/// Returns the roots of a scene: its houses.
fn roots(scene: &Scene) -> Vec<NodeId> {
    let nodes = scene.nodes.iter().enumerate();
    let roots = nodes.filter(|(_, node)| node.parent.is_none());
    roots.map(|(number, _)| NodeId(number as u32)).collect()
}

#[pyfunction]
#[pyo3(signature = (text, name, folder, parameters, seed, detail, language))]
#[allow(clippy::too_many_arguments)] // the package's own function has names for them
fn compile<'py>(
    py: Python<'py>,
    text: &str,
    name: &str,
    folder: Option<PathBuf>,
    parameters: Vec<(String, String)>,
    seed: Option<u64>,
    detail: u8,
    language: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let job = Job::new((text, name, folder), (parameters, seed, detail), language)?;
    let made = py.detach(|| {
        job.compiled(|made, out| hsd::glb(made, &*job.world, &job.options, out))
    });
    Ok(PyBytes::new(py, &made.map_err(refused)?))
}

#[pyfunction]
#[pyo3(signature = (text, name, folder, parameters, seed, language))]
fn check(
    py: Python<'_>,
    text: &str,
    name: &str,
    folder: Option<PathBuf>,
    parameters: Vec<(String, String)>,
    seed: Option<u64>,
    language: &str,
) -> PyResult<Vec<Diagnostic>> {
    let job = Job::new((text, name, folder), (parameters, seed, 3), language)?;
    Ok(py.detach(|| {
        let mut out = Diagnostics::new();
        let checked = hsd::check(&[&job.source], &*job.world, &job.options, &mut out);
        job.list(out, &checked.included)
    }))
}

/// Draws a house as a PNG.
#[pyfunction]
#[pyo3(signature = (text, name, folder, parameters, seed, size, language))]
#[allow(clippy::too_many_arguments)] // the package's own function has names for them
fn draw<'py>(
    py: Python<'py>,
    text: &str,
    name: &str,
    folder: Option<PathBuf>,
    parameters: Vec<(String, String)>,
    seed: Option<u64>,
    size: (u32, u32),
    language: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let sound = |side: u32| (16..=4096).contains(&side);
    if !sound(size.0) || !sound(size.1) {
        return Err(PyValueError::new_err("width and height are 16 to 4096 pixels"));
    }
    let job = Job::new((text, name, folder), (parameters, seed, 2), language)?;
    let drawn = py.detach(|| {
        job.compiled(|made, _| {
            let picture = render::picture(&made.scene, &roots(&made.scene), size);
            let mut png = Cursor::new(vec![]);
            let written = picture.write_to(&mut png, image::ImageFormat::Png);
            written.map(|()| png.into_inner())
        })
    });
    let png = drawn.map_err(refused)?;
    let png = png.map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(PyBytes::new(py, &png))
}

/// Runs a command line in this process; returns its exit status and what it says of its failure.
#[pyfunction]
fn call(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> (u8, String) {
    py.detach(|| hsd::cli::call(arguments))
}

#[pymodule]
fn _hsd(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("CompileError", module.py().get_type::<CompileError>())?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<Diagnostic>()?;
    module.add_function(wrap_pyfunction!(compile, module)?)?;
    module.add_function(wrap_pyfunction!(check, module)?)?;
    module.add_function(wrap_pyfunction!(draw, module)?)?;
    module.add_function(wrap_pyfunction!(call, module)?)
}
