//! Texts that are large for what they say, or say more than anybody builds.

/// A storey of so many teeth in a row.
pub(crate) fn comb(teeth: usize) -> Vec<u8> {
    let side = "KSK  \nKSK  L\nKSK  L\nKSK  \n".repeat(teeth - 1);
    let front = "KSK  ".repeat(2 * teeth - 1);
    format!("0 0\n9\n\n{front}\nKSK  KSK  \n{side}KSK  \nKSK  KSK  \n").into_bytes()
}

/// A house whose plan climbs in so many steps, so many thousandths of a shaku higher than usual, as its lines.
pub(crate) fn stair(steps: usize, higher: usize) -> String {
    let height = 9.0 + higher as f64 / 1000.0;
    let front = "KSK  ".repeat(steps);
    let side = "KSK  L\nKSK  \n".repeat(steps - 1);
    format!("0 0\n{height}\n\n{front}\nKSK  \n{side}KSK  \n{front}\n%\n")
}

/// 1 MiB of such houses, no two of one plan.
pub(crate) fn unlike_stairs(steps: usize) -> Vec<u8> {
    let mut text = String::new();
    for higher in 0.. {
        let next = stair(steps, higher);
        if text.len() + next.len() > 1 << 20 {
            break;
        }
        text += &next;
    }
    text.into_bytes()
}

/// A house with more roof lines than anybody means, each in others' way.
pub(crate) fn pile_of_roofs() -> Vec<u8> {
    let wall = "KSK  ".repeat(200);
    let line = |n: usize| {
        let (a, b) = (n * 37 % 190, n * 61 % 193);
        format!("K X * KIR {a} {b} {} {}\n", a + 1 + n % 5, b + 1 + n % 4)
    };
    let lines: String = (0..40_000).map(line).collect();
    format!("0 0\n9\n\n{wall}\n{wall}\n{wall}\n{wall}\n\n{lines}").into_bytes()
}

pub(crate) fn text_of(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("codes are ASCII")
}

/// A text of 1 MiB made of one piece again and again.
pub(crate) fn mebibyte(head: &str, piece: &str) -> Vec<u8> {
    let count = ((1 << 20) - head.len()) / piece.len();
    format!("{head}{}", piece.repeat(count)).into_bytes()
}
