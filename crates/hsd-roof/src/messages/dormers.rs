//! Messages about dormers and monitors, which stand on other roofs.

use super::{short, written};
use hsd_base::diagnostic::Diagnostic;
use hsd_base::source::Span;
use hsd_base::text;

/// HSD0514: a dormer with the direction of a ridge.
#[cold]
pub fn dormer_direction(direction: Span, shape: &str) -> Diagnostic {
    let message = text!([shape]
        "{shape} is a gable that looks to one side",
        "{shape} は片側を向く破風です"
    );
    let mut found = Diagnostic::warning(514, direction, message).help(text!(
        "write the side it looks to, down the slope: F, B, L or R; or `*`",
        "破風の向く側、屋根の下る側を F、B、L、R か `*` で書いてください"
    ));
    for letter in ["F", "B", "L", "R"] {
        found = found.fix(written(letter), direction, letter);
    }
    found
}

/// HSD0524: a dormer or monitor with no roof to stand on.
#[cold]
pub fn dormer_without_slope(place: Span, shape: &str) -> Diagnostic {
    let message = text!([shape]
        "{shape} stands on the slope of another roof, and there is none under this rectangle that falls to its side; it is left out",
        "{shape} は他の屋根の流れの上に載るものですが、この矩形の下にその側へ下る屋根がないため省きました"
    );
    Diagnostic::warning(524, place, message).help(text!(
        "put the rectangle over the roof with its gable towards the eaves; write the height of the storey whose roof it is if there are several",
        "破風を軒の側にして矩形を屋根の上に置いてください。屋根が幾層もあるときは、その階の高さを書いてください"
    ))
}

/// HSD0524: a monitor that is not over a roof with all of its rectangle.
#[cold]
pub fn monitor_without_roof(place: Span, shape: &str) -> Diagnostic {
    let message = text!([shape]
        "{shape} stands on another roof, and there is no sloped roof under this rectangle; it is left out",
        "{shape} は他の屋根に載るものですが、この矩形の下に勾配屋根がないため省きました"
    );
    Diagnostic::warning(524, place, message).help(text!(
        "put the rectangle over the roof, that of a monitor wholly; write the height of the storey whose roof it is if there are several",
        "矩形を屋根の上に置いてください。越屋根では全体が屋根の上になければなりません。屋根が幾層もあるときは、その階の高さを書いてください"
    ))
}

/// HSD0525: a dormer that would be higher than the roof it stands on.
#[cold]
pub fn dormer_too_high(place: Span, wish: f64, pitch: f64) -> Diagnostic {
    let (wish, pitch) = (short(wish), short(pitch));
    let message = text!([wish, pitch]
        "at {wish} sun the ridge of this gable would lie above the roof it stands on, so its pitch is {pitch} sun",
        "{wish} 寸勾配ではこの破風の棟が載っている屋根より高くなるため、{pitch} 寸勾配にしました"
    );
    Diagnostic::warning(525, place, message).help(text!(
        "make the gable narrower, put it nearer to the eaves, or write a lower pitch",
        "破風を狭くするか、軒に近づけるか、緩い勾配にしてください"
    ))
}

/// HSD0519: a dormer or monitor as the roof of a whole storey.
#[cold]
pub fn automatic_dormer(shape: Span, letters: &str, number: u32) -> Diagnostic {
    let message = text!([letters, number]
        "{letters} stands on another roof and cannot cover a storey: storey {number} gets gable roofs",
        "{letters} は他の屋根に載るもので階を覆えないため、{number}階は切妻にしました"
    );
    Diagnostic::warning(519, shape, message)
        .help(text!(
            "write it as a roof line with its rectangle, and another shape for the storey",
            "矩形を持つ屋根の行として書き、この階には別の形を指定してください"
        ))
        .fix(written("KIR"), shape, "KIR")
}
