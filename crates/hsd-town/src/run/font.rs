//! Reads the font of a town, with whose letters its signs are written.

use crate::TownInput;
use hsd_base::diagnostic::{Diagnostics, Text};
use hsd_base::lettering::Font;
use hsd_base::source::Spanned;
use hsd_base::text;
use hsd_ir::ast::town::Town;
use hsd_syntax::messages::town as say;
use std::sync::Arc;

/// The largest file of a font, bytes: those of Chinese characters have about 20 MB.
const LARGEST: usize = 64 << 20;

/// Returns the bytes of the font that a town names; `None` for none, or for one that cannot be read, which is told.
pub(super) fn font(input: TownInput<'_>, town: &Town, out: &mut Diagnostics) -> Option<Arc<[u8]>> {
    let named = town.font.as_ref()?;
    match read(input, named) {
        Ok(bytes) => Some(bytes),
        Err(why) => {
            out.push(say::no_font(named.span, &named.value, &why));
            None
        }
    }
}

fn read(input: TownInput<'_>, named: &Spanned<String>) -> Result<Arc<[u8]>, Text> {
    let path = super::path(input, named)?;
    let bytes = input.world.text_bytes(&path, LARGEST);
    let bytes = bytes.map_err(|error| Text::from(error.to_string()))?;
    match Font::read(&bytes) {
        Some(_) => Ok(bytes.into()),
        None => Err(text!("it is no font", "フォントではありません")),
    }
}
