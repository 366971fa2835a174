//! The texts that are open, and what is known of them.

use super::lines::{Encoding, Lines};
use super::settings::Settings;
use super::uri;
use super::world::{MARK, Open, Overlay, key, marked};
use crate::ide::Analysis;
use crate::source::{FileId, Source};
use gen_lsp_types::{Range, TextDocumentContentChangeEvent};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// One open text.
pub(super) struct Document {
    /// As the client writes it.
    pub(super) uri: String,
    /// What other texts know it by.
    path: Option<PathBuf>,
    /// The client's count of changes.
    pub(super) version: i32,
    /// The whole text.
    pub(super) text: String,
    /// Its lines.
    pub(super) lines: Lines,
    /// What is known of the text, unless it has changed since.
    pub(super) analysis: Option<Analysis>,
    /// Whether the program failed over the text as it is.
    given_up: bool,
    /// The texts that it asked for when it was last read.
    asked: BTreeSet<PathBuf>,
}

impl Document {
    /// Bytes of the text that [`Analysis`] does not count: a byte order mark.
    pub(super) fn mark(&self) -> usize {
        if self.text.starts_with(MARK) {
            MARK.len()
        } else {
            0
        }
    }

    /// Notes that nothing is known of the text any more.
    fn forget(&mut self) {
        self.analysis = None;
        self.given_up = false;
    }

    /// Takes over changes, one after the other.
    pub(super) fn edit(
        &mut self,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) {
        use TextDocumentContentChangeEvent as Change;
        for change in changes {
            match change {
                Change::TextDocumentContentChangePartial(part) => {
                    self.replace(part.range, &part.text, encoding);
                }
                Change::TextDocumentContentChangeWholeDocument(whole) => {
                    self.lines = Lines::new(&whole.text);
                    self.text = whole.text;
                }
            }
        }
    }

    fn replace(&mut self, range: Range, text: &str, encoding: Encoding) {
        let range = self.lines.offsets(&self.text, range, encoding);
        self.text.replace_range(range.clone(), text);
        self.lines.edit(&range, text.len(), &self.text);
    }
}

/// All open texts.
#[derive(Default)]
pub(super) struct Documents {
    open: BTreeMap<String, Document>,
    /// Those that are files: what texts see that include them.
    pub(super) files: Open,
    /// Counts up whenever anything may have changed.
    pub(super) edition: u64,
}

impl Documents {
    /// An open text.
    pub(super) fn get(&self, uri: &str) -> Option<&Document> {
        self.open.get(uri)
    }

    /// All open texts.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Document> {
        self.open.values()
    }

    /// The open text of a file.
    pub(super) fn of_file(&self, path: &Path) -> Option<&Document> {
        let key = key(path);
        self.iter().find(|d| d.path.as_ref() == Some(&key))
    }

    /// What the client calls its files, and whether it counts a mark among their characters.
    pub(super) fn names(&self) -> BTreeMap<PathBuf, (String, bool)> {
        let name = |d: &Document| Some((d.path.clone()?, (d.uri.clone(), d.mark() > 0)));
        self.iter().filter_map(name).collect()
    }

    /// Opens a text.
    pub(super) fn open(&mut self, uri: String, version: i32, text: String) {
        let path = uri::to_path(&uri).map(|p| key(&p));
        let lines = Lines::new(&text);
        let document = Document {
            uri: uri.clone(),
            path: path.clone(),
            version,
            text,
            lines,
            analysis: None,
            given_up: false,
            asked: BTreeSet::new(),
        };
        self.open.insert(uri.clone(), document);
        self.changed(&uri);
    }

    /// Changes a text; nothing happens where it is not open.
    pub(super) fn edit(
        &mut self,
        uri: &str,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) {
        if let Some(document) = self.open.get_mut(uri) {
            document.version = version;
            document.edit(changes, encoding);
            self.changed(uri);
        }
    }

    /// Closes a text: what includes it sees the file on disk again.
    pub(super) fn close(&mut self, uri: &str) -> Option<Document> {
        let closed = self.open.remove(uri)?;
        if let Some(path) = &closed.path {
            self.files.remove(path);
            self.forget(path);
        }
        Some(closed)
    }

    /// Notes that a text is another, for itself and for whoever reads it.
    fn changed(&mut self, uri: &str) {
        let Some(document) = self.open.get_mut(uri) else {
            return;
        };
        document.forget();
        if let Some(path) = document.path.clone() {
            let text = marked(&document.text).into();
            self.files.insert(path.clone(), text);
            self.forget(&path);
        }
    }

    /// Notes that a file is another, for whoever reads it.
    pub(super) fn forget(&mut self, path: &Path) {
        self.edition += 1;
        for document in self.open.values_mut() {
            if document.asked.contains(path) {
                document.forget();
            }
        }
    }

    /// Notes that anything may have changed.
    pub(super) fn forget_all(&mut self) {
        self.edition += 1;
        for document in self.open.values_mut() {
            document.forget();
        }
    }

    /// A text of which nothing is known and that may be read.
    pub(super) fn stale(&self) -> Option<&str> {
        let stale = |d: &&Document| d.analysis.is_none() && !d.given_up;
        self.open.values().find(stale).map(|d| &*d.uri)
    }

    /// Leaves a text unread until it changes: the program failed over it, and would again.
    pub(super) fn give_up(&mut self, uri: &str) {
        if let Some(document) = self.open.get_mut(uri) {
            document.given_up = true;
        }
    }

    /// Reads a text, unless it is known already; says whether it was read.
    pub(super) fn analyse(&mut self, uri: &str, settings: &Settings) -> bool {
        let Some(document) = self.open.get(uri).filter(|d| d.analysis.is_none()) else {
            return false;
        };
        let (analysis, asked) = self.read(uri, &document.text, settings);
        if let Some(document) = self.open.get_mut(uri) {
            document.analysis = Some(analysis);
            document.asked = asked;
        }
        true
    }

    /// What would be known of a text if it read so.
    pub(super) fn trial(&self, uri: &str, text: &str, settings: &Settings) -> Analysis {
        self.read(uri, text, settings).0
    }

    /// Reads a text; tells which others it asked for.
    fn read(&self, uri: &str, text: &str, settings: &Settings) -> (Analysis, BTreeSet<PathBuf>) {
        let path = uri::to_path(uri);
        let folder = path.as_deref().and_then(Path::parent);
        let world = Overlay::new(folder, settings, &self.files);
        let name = path.as_deref().and_then(Path::to_str).unwrap_or(uri);
        let source = Source::new(FileId(0), name, marked(text).as_bytes());
        let analysis = Analysis::new(source, &world, &world.options(settings));
        (analysis, world.into_asked())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_was_given_up_is_read_when_it_changes() {
        let mut documents = Documents::default();
        documents.open("file:///a.hsd".to_owned(), 1, "KSK".to_owned());
        assert_eq!(documents.stale(), Some("file:///a.hsd"));
        documents.give_up("file:///a.hsd");
        assert_eq!(documents.stale(), None);
        documents.edit("file:///a.hsd", 2, vec![], Encoding::Utf8);
        assert_eq!(documents.stale(), Some("file:///a.hsd"));
    }
}
