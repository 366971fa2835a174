//! Messages about the XML form (HSD02xx): its markup in [`markup`] and [`tags`], its elements in [`elements`].

mod elements;
mod markup;
mod tags;

pub use elements::*;
pub use markup::*;
pub use tags::*;
