//! Access of the preview to source files, the editor, and photographs that become a front.

use hsd_base::source::{Source, Span, World};
use hsd_driver::Options;
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};

/// The services that the preview needs from its host: files on disk and an editor command (`hsd view`), or the editor
/// connected to the language server.
pub trait EditorHost: Send + Sync {
    /// Reads a source file and passes it to `work` with its surroundings.
    ///
    /// # Errors
    /// If the file cannot be read.
    fn read(
        &self,
        path: &Path,
        work: &mut dyn FnMut(Source, &dyn World, &Options),
    ) -> io::Result<()>;

    /// Returns a new folder for the tiles of a town, which is removed when the program ends.
    ///
    /// # Errors
    /// If there is none.
    fn scratch(&self) -> io::Result<PathBuf>;

    /// Returns the contents of a file, as [`EditorHost::write`] takes them.
    ///
    /// # Errors
    /// If the file cannot be read.
    fn bytes(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// Returns whether source files can be changed from the page.
    fn writes(&self) -> bool;

    /// Replaces the contents `before` of a file by `after`.
    ///
    /// # Errors
    /// If the file has changed or cannot be written.
    fn write(&self, path: &Path, before: &[u8], after: &[u8]) -> io::Result<()>;

    /// Returns whether there is an editor that can open locations.
    fn opens(&self) -> bool;

    /// Opens the editor at a location in a source.
    ///
    /// # Errors
    /// If there is no editor or it cannot be started.
    fn open(&self, source: &Source, span: Span) -> io::Result<()>;
}

/// The services that the page of photographs needs from its host: it finds, straightens and builds what `hsd facade` does. The
/// types of what is asked and answered are in `view/src/server/front.ts`.
pub trait FrontHost: Send + Sync {
    /// Returns what is known of the photographs: `Photographs`.
    fn about(&self) -> Value;

    /// Returns a photograph as JPEG, upright; `None` if there is none of this number.
    fn photo(&self, number: usize) -> Option<Vec<u8>>;

    /// Returns the wall of a photograph seen straight, small: takes `StraightRequest`, returns `Straight`.
    ///
    /// # Errors
    /// If what is asked makes no sense, with the reason in words.
    fn straight(&self, asked: Value) -> Result<Value, String>;

    /// Writes the front: takes `Told`, returns `Built`.
    ///
    /// # Errors
    /// If nothing could be written, with the reason in words.
    fn build(&self, told: Value) -> Result<Value, String>;
}
