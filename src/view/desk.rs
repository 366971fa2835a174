//! The desk of the author: where texts lie as they are written, and where the editor is.

use crate::driver::Options;
use crate::source::{Source, Span, World};
use std::io;
use std::path::Path;

/// What the preview needs of the author's desk: the disk and a command that starts an editor, or an editor that the
/// language server speaks with.
pub trait Desk: Send + Sync {
    /// Reads the text of a file, and hands it over with what surrounds it.
    ///
    /// # Errors
    /// Where the file cannot be read.
    fn read(
        &self,
        path: &Path,
        work: &mut dyn FnMut(Source, &dyn World, &Options),
    ) -> io::Result<()>;

    /// The text of a file as bytes, as [`Desk::write`] would put them in place.
    ///
    /// # Errors
    /// Where the file cannot be read.
    fn bytes(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// Whether texts may be changed from the page.
    fn writes(&self) -> bool;

    /// Puts a text in the place of the one that reads `before`.
    ///
    /// # Errors
    /// Where it cannot be written.
    fn write(&self, path: &Path, before: &[u8], after: &[u8]) -> io::Result<()>;

    /// Whether there is an editor that can be sent to a place.
    fn opens(&self) -> bool;

    /// Sends the editor to a place of a text that was read.
    ///
    /// # Errors
    /// Where there is no editor, or it cannot be started.
    fn open(&self, source: &Source, span: Span) -> io::Result<()>;
}
