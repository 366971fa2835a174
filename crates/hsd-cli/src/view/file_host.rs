//! The editor host of the command line: files on disk, and a command that opens an editor.

use crate::Failure;
use crate::files::input::Inputs;
use crate::files::output::{Committer, Files};
use crate::files::temporary::Guarded;
use crate::options::ReadArgs;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::{Source, Span, World};
use hsd_base::text;
use hsd_driver::Options;
use hsd_driver::fs::InputRecord;
use hsd_scene::{Detail, Shown};
use hsd_view::EditorHost;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use tempfile::TempDir;

/// Files on disk, read with the options of the command line.
pub(crate) struct FileHost {
    pub(crate) read_args: ReadArgs,
    /// The level of detail of models.
    pub(crate) detail: Detail,
    /// How much of each house models show.
    pub(crate) shown: Shown,
    /// The words of the editor command.
    pub(crate) editor: Option<Vec<String>>,
    /// True if source files may be changed.
    pub(crate) writes: bool,
    /// The folders of towns.
    pub(crate) scratch: Mutex<Vec<(TempDir, Guarded)>>,
    /// The files that were read.
    pub(crate) record: InputRecord,
}

/// Returns a failure as an I/O error.
fn stopped(stop: Failure) -> io::Error {
    match stop {
        Failure::Io(why) | Failure::Usage(why) => {
            io::Error::other(why.in_language(Language::English).into_owned())
        }
        Failure::Pipe => io::ErrorKind::BrokenPipe.into(),
    }
}

impl EditorHost for FileHost {
    fn read(
        &self,
        path: &Path,
        work: &mut dyn FnMut(Source, &dyn World, &Options),
    ) -> io::Result<()> {
        let inputs = [path.to_owned()];
        let limit = self.read_args.limits().bytes;
        let mut out = Diagnostics::new();
        let read = Inputs::read(&inputs, limit, &mut out).map_err(stopped)?;
        if !read.taken().all(|taken| taken) {
            return Err(io::Error::other(
                "the file is larger than --max-bytes allows",
            ));
        }
        let options = Options {
            detail: self.detail,
            shown: self.shown,
            ..self.read_args.options(&read, &mut out).map_err(stopped)?
        };
        self.record.add(path);
        let world = self.read_args.world(&inputs).recorded_in(&self.record);
        if let Some(source) = read.sources.into_iter().next() {
            work(source, &world, &options);
        }
        Ok(())
    }

    fn scratch(&self) -> io::Result<PathBuf> {
        let mut builder = tempfile::Builder::new();
        let made = Guarded::new(|| builder.prefix("hsd-view-").tempdir(), TempDir::path)?;
        let path = made.0.path().to_owned();
        let mut all = self.scratch.lock().unwrap_or_else(PoisonError::into_inner);
        all.push(made);
        Ok(path)
    }

    fn bytes(&self, path: &Path) -> io::Result<Vec<u8>> {
        let mut bytes = vec![];
        let limit = self.read_args.limits().bytes as u64;
        File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    fn writes(&self) -> bool {
        self.writes
    }

    fn write(&self, path: &Path, before: &[u8], after: &[u8]) -> io::Result<()> {
        if !self.writes {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        if fs::read(path)? != before {
            return Err(io::Error::other("the file has changed on disk"));
        }
        // Renaming would replace even a read-only file.
        if fs::metadata(path)?.permissions().readonly() {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        // Strokes and edits change the file itself.
        let committer = Committer::knowing(self.record.clone()).editing(path);
        let written = committer.write(path, Files::bytes(after.to_vec()));
        written.map(drop).map_err(stopped)
    }

    fn opens(&self) -> bool {
        self.editor.is_some()
    }

    fn open(&self, source: &Source, span: Span) -> io::Result<()> {
        let (line, column) = source.line_column(span);
        let missing = || io::Error::other("no editor command: use hsd view --editor COMMAND");
        let (program, arguments) = self
            .editor
            .as_deref()
            .and_then(<[String]>::split_first)
            .ok_or_else(missing)?;
        let place = |word: &String| {
            word.replace("{line}", &line.to_string())
                .replace("{column}", &column.to_string())
                .replace("{file}", source.name())
        };
        let mut command = Command::new(program);
        command.args(arguments.iter().map(place));
        command.stdin(Stdio::null()).stdout(Stdio::null());
        let mut child = command.spawn()?;
        // Reaps the process.
        std::thread::spawn(move || child.wait());
        Ok(())
    }
}

/// Splits a command into words at blanks outside quotation marks. No shell is involved.
pub(super) fn editor(command: &str) -> Result<Vec<String>, Failure> {
    let (mut words, mut word, mut quote) = (vec![], None::<String>, None);
    for c in command.chars() {
        match quote {
            Some(q) if c == q => quote = None,
            None if c == '"' || c == '\'' => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            None if c.is_whitespace() => words.extend(word.take()),
            _ => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    if quote.is_some() || words.is_empty() {
        return Err(Failure::Usage(text!([command]
            "--editor {command}: expected a command, as in 'code -g {{file}}:{{line}}'",
            "--editor {command}: 'code -g {{file}}:{{line}}' のようなコマンドを指定してください"
        )));
    }
    if !words.iter().any(|w| w.contains("{file}")) {
        words.push("{file}".to_owned());
    }
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_divided_as_a_shell_would() {
        let words = |command| editor(command).expect("is a command");
        assert_eq!(
            words("code -g {file}:{line}"),
            ["code", "-g", "{file}:{line}"]
        );
        assert_eq!(
            words("'my editor' \"--at={line}\" {file}"),
            ["my editor", "--at={line}", "{file}"]
        );
        assert_eq!(words("emacsclient"), ["emacsclient", "{file}"]);
        assert!(editor("  ").is_err());
        assert!(editor("code 'x").is_err());
    }
}
