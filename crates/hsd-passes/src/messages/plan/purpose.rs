//! Messages about what a house is for (HSD043x).

use hsd_base::diagnostic::Diagnostic;
use hsd_base::source::Span;
use hsd_base::text;

/// HSD0432: roofs follow the purpose of a house that has none.
#[cold]
pub fn no_use(word: Span) -> Diagnostic {
    Diagnostic::warning(
        432,
        word,
        text!(
            "`shape=\"use\"` needs to know what the house is for; it gets gables",
            "`shape=\"use\"` には建物の用途が要ります。ここでは切妻にします"
        ),
    )
    .help(text!(
        "say so on the house: `<House use=\"temple\">`; or name a shape here, such as `KIR` for gables",
        "`<House use=\"temple\">` のように建物の用途を書くか、`KIR`(切妻)のような形をここに書いてください"
    ))
}
