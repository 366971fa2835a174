//! The passes from the syntax tree to fitted buildings: [`expand`], [`lower`], and after the roof [`fit`].

pub mod expand;
pub mod fit;
pub mod lower;
pub mod messages;
