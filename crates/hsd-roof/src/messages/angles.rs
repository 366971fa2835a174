//! Hip roofs over walls at odd angles: of a wing, and of a hall too wide for one.

use hsd_base::diagnostic::Diagnostic;
use hsd_base::source::Span;
use hsd_base::text;

/// Wings at odd angles that get hip roofs of their own; `wall` is one that slants.
#[cold]
pub fn wings_at_angles(wall: Span, storey: u32) -> Diagnostic {
    let message = text!([storey]
        "storey {storey} has a wing at an odd angle: it gets a hip roof of its own, and the rest is roofed by rectangles",
        "{storey}階には斜めに延びる部分があります。その部分だけに寄棟屋根を架け、残りは長方形ごとに屋根を架けます"
    );
    Diagnostic::note(522, wall, message).help(text!(
        "if that is meant, nothing needs to be done; `<Roofs method=\"skeleton\"/>` makes one hip roof over all of it",
        "それでよければそのままで構いません。`<Roofs method=\"skeleton\"/>` と書けば全体が一つの寄棟屋根になります"
    ))
}

/// A hall at odd angles too wide for one hip roof.
#[cold]
pub fn deck(storey: Span, number: u32) -> Diagnostic {
    let message = text!([number]
        "the hip roof of storey {number} would be wider than 15 ken (27 m), so its slopes end in a flat deck",
        "{number}階の寄棟屋根は幅が十五間(27 m)を超えるため、上を平らな屋根にします"
    );
    Diagnostic::note(523, storey, message).help(text!(
        "for slopes up to a ridge, however high, ask for the shape: `<Roofs shape=\"YOS\"/>`",
        "どんなに高くなっても棟まで斜面を続けるには、`<Roofs shape=\"YOS\"/>` と形を書いてください"
    ))
}
