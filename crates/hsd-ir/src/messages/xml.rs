//! Messages about the XML form (HSD02xx): its markup in [`markup`] and [`tags`], its elements in [`elements`] and [`values`].

mod elements;
mod language;
mod markup;
mod fixes;
mod parameters;
mod pieces;
mod places;
mod tags;
mod values;

pub use elements::*;
pub use fixes::offer;
pub use language::known;
pub use language::*;
pub use markup::*;
pub use parameters::*;
pub use pieces::*;
pub use places::*;
pub use tags::*;
pub use values::*;
