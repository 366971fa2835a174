//! Open documents and their analyses.

use super::lines::{Encoding, Lines};
use super::settings::Settings;
use super::towns::{TownDone, TownJob};
use super::uri;
use super::world::{MARK, Open, Overlay, key, marked};
use gen_lsp_types::{Range, TextDocumentContentChangeEvent};
use hsd_base::source::{FileId, Source};
use hsd_driver::Options;
use hsd_ide::Analysis;
use hsd_roof::KeptRoofs;
use hsd_town::{KeptMaps, TownFacts};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An open document.
pub(super) struct Document {
    /// The URI, as the client writes it.
    pub(super) uri: String,
    /// The path by which other documents include it.
    path: Option<PathBuf>,
    /// The version number of the client.
    pub(super) version: i32,
    /// The text.
    pub(super) text: String,
    /// The lines of the text.
    pub(super) lines: Lines,
    /// The analysis, unless the text has changed since.
    pub(super) analysis: Option<Analysis>,
    /// True if the analysis of this text has panicked.
    given_up: bool,
    /// The files requested by the last analysis.
    asked: BTreeSet<PathBuf>,
    /// The number of the last analysis among all.
    reading: u64,
    /// What is known of the town that it is, or was before the last changes.
    town: Option<Arc<TownFacts>>,
}

impl Document {
    /// Returns the length of the byte order mark, which [`Analysis`] does not count.
    pub(super) fn mark(&self) -> usize {
        if self.text.starts_with(MARK) {
            MARK.len()
        } else {
            0
        }
    }

    /// Discards the analysis.
    fn forget(&mut self) {
        if let Some(old) = self.analysis.take() {
            // Nobody waits until the trees of a town are gone.
            rayon::spawn(move || drop(old));
        }
        self.given_up = false;
    }

    /// Applies changes in order.
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

/// All open documents.
#[derive(Default)]
pub(super) struct Documents {
    open: BTreeMap<String, Document>,
    /// The open documents that are files, as seen by documents that include them.
    pub(super) files: Open,
    /// Incremented whenever anything may have changed.
    pub(super) edition: u64,
    /// The roofs of all documents: a key changes those of one house.
    roofs: KeptRoofs,
    /// The maps of all towns.
    maps: KeptMaps,
    /// The number of analyses so far.
    readings: u64,
}

impl Documents {
    /// Returns an open document.
    pub(super) fn get(&self, uri: &str) -> Option<&Document> {
        self.open.get(uri)
    }

    /// Returns all open documents.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Document> {
        self.open.values()
    }

    /// Returns the open document of a file.
    pub(super) fn of_file(&self, path: &Path) -> Option<&Document> {
        let key = key(path);
        self.iter().find(|d| d.path.as_ref() == Some(&key))
    }

    /// Returns the URIs of the open files, and whether their texts start with a byte order mark.
    pub(super) fn names(&self) -> BTreeMap<PathBuf, (String, bool)> {
        let name = |d: &Document| Some((d.path.clone()?, (d.uri.clone(), d.mark() > 0)));
        self.iter().filter_map(name).collect()
    }

    /// Opens a document.
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
            reading: 0,
            town: None,
        };
        self.open.insert(uri.clone(), document);
        self.changed(&uri);
    }

    /// Changes a document, if it is open.
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

    /// Closes a document; documents that include it see the file on disk again.
    pub(super) fn close(&mut self, uri: &str) -> Option<Document> {
        let closed = self.open.remove(uri)?;
        if let Some(path) = &closed.path {
            self.files.remove(path);
            self.forget(path);
        }
        Some(closed)
    }

    /// Discards the analyses of a changed document and of those that include it.
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

    /// Discards the analyses of documents that read a changed file, or the names of the files in its folder.
    pub(super) fn forget(&mut self, path: &Path) {
        self.edition += 1;
        for document in self.open.values_mut() {
            let folder = path.parent();
            if document.asked.contains(path) || folder.is_some_and(|f| document.asked.contains(f)) {
                document.forget();
            }
        }
    }

    /// Discards all analyses.
    pub(super) fn forget_all(&mut self) {
        self.edition += 1;
        for document in self.open.values_mut() {
            document.forget();
        }
    }

    /// Returns a document to be analysed.
    pub(super) fn stale(&self) -> Option<&str> {
        let stale = |d: &&Document| d.analysis.is_none() && !d.given_up;
        self.open.values().find(stale).map(|d| &*d.uri)
    }

    /// Excludes a document from analysis until it changes, because analysing it has panicked.
    pub(super) fn give_up(&mut self, uri: &str) {
        if let Some(document) = self.open.get_mut(uri) {
            document.given_up = true;
        }
    }

    /// Analyses a document unless its analysis is up to date; returns whether it did.
    pub(super) fn analyse(&mut self, uri: &str, settings: &Settings) -> bool {
        let Some(document) = self.open.get(uri).filter(|d| d.analysis.is_none()) else {
            return false;
        };
        let (mut analysis, asked) = self.read(uri, &document.text, settings);
        self.readings += 1;
        if let Some(document) = self.open.get_mut(uri) {
            document.town = document.town.take().filter(|_| analysis.checked.is_town);
            analysis.town.clone_from(&document.town);
            document.analysis = Some(analysis);
            document.asked = asked;
            document.reading = self.readings;
        }
        true
    }

    /// Returns the work of checking a document as a town, if its analysis says that it is one.
    pub(super) fn town(&self, uri: &str, settings: &Settings) -> Option<TownJob> {
        let document = self.open.get(uri)?;
        let analysis = document.analysis.as_ref()?;
        analysis.checked.is_town.then(|| TownJob {
            uri: uri.to_owned(),
            reading: document.reading,
            folder: uri::to_path(uri).and_then(|p| p.parent().map(Path::to_owned)),
            source: analysis.source.clone(),
            included: analysis.checked.included.clone(),
            open: self.files.clone(),
            settings: settings.clone(),
            maps: self.maps.clone(),
        })
    }

    /// Adds the result of checking a town to its analysis; returns false if the text has changed since.
    pub(super) fn add_town(&mut self, made: TownDone) -> bool {
        let Some(document) = self.open.get_mut(&made.uri) else {
            return false;
        };
        let is_same = document.reading == made.reading;
        let Some(analysis) = document.analysis.as_mut().filter(|_| is_same) else {
            return false;
        };
        document.asked.extend(made.asked);
        let town = Arc::new(made.facts);
        // While its text has errors the maps may not be readable; their fields are still of use.
        if !town.layers.is_empty() || document.town.is_none() {
            document.town = Some(town.clone());
        }
        analysis.add_town(town, made.included, made.found);
        analysis.town.clone_from(&document.town);
        true
    }

    /// Analyses a document as if it had this text.
    pub(super) fn trial(&self, uri: &str, text: &str, settings: &Settings) -> Analysis {
        self.read(uri, text, settings).0
    }

    /// Analyses a document; returns the files it requested.
    fn read(&self, uri: &str, text: &str, settings: &Settings) -> (Analysis, BTreeSet<PathBuf>) {
        let path = uri::to_path(uri);
        let folder = path.as_deref().and_then(Path::parent);
        let world = Overlay::new(folder, settings, &self.files);
        let name = path.as_deref().and_then(Path::to_str).unwrap_or(uri);
        let source = Source::new(FileId(0), name, marked(text).as_bytes());
        let options = Options {
            roofs: Some(self.roofs.clone()),
            ..world.options(settings)
        };
        let analysis = Analysis::new(source, &world, &options);
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
