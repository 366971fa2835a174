//! `hsd view`: runs the live preview.

mod file_host;
pub(super) mod first;
mod photographs;

use super::options::{DetailArgs, ReadArgs, report};
use super::{Exit, Failure, Outcome};
use clap::Args;
pub(super) use file_host::FileHost;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::text;
use hsd_report::{Format, Report};
use hsd_view::{Preview, PreviewOptions, RecursiveMode};
use photographs::Photographs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The root of a town in tiles.
const TILESET: &str = "tileset.json";

/// Preview houses in the browser, updated at every save.
///
/// A local page shows the model, the plan and the diagnostics. For a folder, any source file or model in it can be
/// opened there. A town is built in tiles, which the page streams. No data leaves this machine. The command runs until interrupted.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd view house.hsd                                   preview a house beside your editor
  hsd view street/                                     preview the source files of a folder
  hsd view town.hsd --detail 1                         preview hundreds of houses with textures for parts
  hsd view --facade front.jpg                          make a front of photographs: corners, lattice and masks by hand
  hsd view kyoto/                                      look at a town in tiles that `hsd town` has written
  hsd view house.hsd --editor 'code -g {file}:{line}'  go to the line of a part when it is clicked")]
pub(super) struct View {
    /// A source file, a town, a folder of source files or of tiles, or a model (.glb).
    #[arg(value_name = "FILE", required_unless_present = "facade")]
    input: Option<PathBuf>,

    /// Make a front of these photographs of one wall in the page, as `hsd facade` does.
    #[arg(long, value_name = "PHOTO", num_args = 1.., conflicts_with = "input")]
    facade: Vec<PathBuf>,

    /// Write the front into this folder [default: that of the first photograph, named as it is].
    #[arg(short, long, value_name = "DIR", requires = "facade")]
    output: Option<PathBuf>,

    #[command(flatten)]
    read_args: ReadArgs,

    #[command(flatten)]
    detail_args: DetailArgs,

    /// Run this command to go to a location in your editor; {file}, {line} and {column} are replaced.
    #[arg(long, value_name = "COMMAND", env = "HSD_EDITOR")]
    editor: Option<String>,

    /// Disable editing in the page.
    #[arg(long)]
    read_only: bool,

    /// Set the port of the page [default: any free port].
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,

    /// Print the address without opening the browser.
    #[arg(long)]
    no_open: bool,
}

impl View {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.read_args.check_folders()?;
        check_page()?;
        let editor = self.editor.as_deref().map(file_host::editor).transpose()?;
        let host = FileHost {
            read_args: self.read_args.clone(),
            detail: self.detail_args.detail(),
            shown: self.detail_args.shown(),
            editor,
            writes: !self.read_only,
            scratch: Default::default(),
            record: Default::default(),
        };
        let preview = match &self.input {
            Some(input) => start(input, &self.read_args, host, self.port, language)?,
            None => match self.photographs(host, language)? {
                Some(preview) => preview,
                None => return Ok(Exit::Errors),
            },
        };
        let url = preview.url();
        writeln!(io::stdout(), "{url}")?;
        io::stdout().flush()?;
        if !self.no_open && open::that_detached(&url).is_err() {
            let hint = text!(
                "could not start a browser; open the address above",
                "ブラウザーを起動できませんでした。上のアドレスを開いてください"
            );
            writeln!(io::stderr(), "hsd: {}", hint.in_language(language))?;
        }
        preview.wait().map_err(|e| Failure::at(&url, e))?;
        Ok(Exit::Done)
    }
}

impl View {
    /// Starts the page of photographs; `None` if one of them is none, which is reported.
    fn photographs(&self, host: FileHost, language: Language) -> Result<Option<Preview>, Failure> {
        let (mut sources, mut out) = (vec![], Diagnostics::new());
        let told = (!self.read_only, language);
        let output = self.output.as_deref();
        let opened = Photographs::open(&self.facade, output, told, (&mut sources, &mut out))?;
        let Some(photographs) = opened else {
            let list = out.into_sorted();
            let written = Report::new(&sources, &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
            return Ok(None);
        };
        let root = photographs.root.clone();
        let watched = photographs.watched();
        let failed = |e: io::Error| Failure::at(root.display(), e);
        let preview = Preview::start(PreviewOptions {
            only: vec![photographs.file(), photographs.street()],
            watched,
            root: root.clone(),
            language,
            host: Box::new(host),
            front: Some(Box::new(photographs)),
            port: self.port,
        });
        preview.map(Some).map_err(failed)
    }
}

/// Fails if the program was built without the page.
pub(super) fn check_page() -> Result<(), Failure> {
    match hsd_view::is_built() {
        true => Ok(()),
        false => Err(Failure::Usage(hsd_view::how_to_build())),
    }
}

/// Starts the preview of a file or a folder.
pub(super) fn start(
    input: &Path,
    read_args: &ReadArgs,
    host: FileHost,
    port: u16,
    language: Language,
) -> Result<Preview, Failure> {
    let failed = |e: io::Error| Failure::at(input.display(), e);
    let real = input.canonicalize().map_err(failed)?;
    let (root, only, mode) = if real.join(TILESET).is_file() {
        (real, vec![TILESET.to_owned()], RecursiveMode::NonRecursive)
    } else if real.is_dir() {
        (real, vec![], RecursiveMode::Recursive)
    } else {
        let folder = real.parent().unwrap_or(Path::new("/")).to_owned();
        let name = real.file_name().map(|n| n.to_string_lossy().into_owned());
        let only = name.into_iter().collect();
        (folder, only, RecursiveMode::NonRecursive)
    };
    let mut watched = vec![(root.clone(), mode)];
    let inputs = only.iter().map(|name| root.join(name));
    let inputs: Vec<PathBuf> = inputs.collect();
    let beside = read_args.folders(&inputs).into_iter();
    let beside = beside.chain(read_args.catalog_folders());
    let beside = beside.chain(
        inputs
            .iter()
            .flat_map(|path| hsd_view::texture_folders(path)),
    );
    let beside = beside.chain(inputs.iter().flat_map(|path| hsd_view::map_folders(path)));
    for folder in beside.filter_map(|f| f.canonicalize().ok()) {
        let known = |(f, mode): &(PathBuf, RecursiveMode)| {
            *f == folder || *mode == RecursiveMode::Recursive && folder.starts_with(f)
        };
        if !watched.iter().any(known) {
            watched.push((folder, RecursiveMode::NonRecursive));
        }
    }
    Preview::start(PreviewOptions {
        root,
        only,
        language,
        host: Box::new(host),
        front: None,
        port,
        watched,
    })
    .map_err(failed)
}
