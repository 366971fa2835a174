//! Messages about files and limits, in both languages, and the words that messages of other crates share. One `#[cold]`
//! function per message.

pub mod file;
pub mod limits;
pub mod words;
