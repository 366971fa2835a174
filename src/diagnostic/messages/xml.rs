//! Messages about the XML form (HSD02xx): its markup in [`markup`] and [`tags`], its elements in [`elements`].

mod elements;
mod language;
mod markup;
mod pieces;
mod tags;

pub use elements::*;
pub use language::*;
pub use markup::*;
pub use pieces::*;
pub use tags::*;
