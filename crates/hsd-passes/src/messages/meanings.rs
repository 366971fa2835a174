//! Messages about names of parts where a code belongs (HSD03xx).

use hsd_base::diagnostic::messages::words::shortened;
use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::catalog::PartDef;
use hsd_ir::messages::parts::{in_cells, written};

/// A name of parts where a code belongs.
#[cold]
pub fn part_meaning(span: Span, word: &str, parts: &[&PartDef]) -> Diagnostic {
    let word = shortened(word);
    let message = text!([word]
        "`{word}` is what parts are called, not a code",
        "`{word}` は部材の呼び名で、部材コードではありません"
    );
    let offer = |part: &&PartDef| {
        let (code, en, ja) = (part.code().trim_end(), &part.en, &part.ja);
        text!([code, en, ja] "`{code}` ({en})", "`{code}` ({ja})")
    };
    let offers = Text::joined(parts.iter().map(offer).collect(), " or ", "か ");
    let found = Diagnostic::error(301, span, message).help(text!([offers, word]
        "write {offers}; `hsd parts {word}` finds others",
        "{offers} と書いてください。ほかは `hsd parts {word}` で探せます"
    ));
    // A part of another width would open the walls.
    let usual = parts.iter().filter(|part| part.width() == 1.0);
    usual.fold(found, |found, part| {
        let code = part.code();
        found.fix(written(code.trim_end()), span, in_cells(span, code))
    })
}
