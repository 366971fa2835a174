//! Letters of our own, for signs without a font: capitals, figures and marks as strokes of one thickness, on a grid of 4 by 6.

use super::Lettering;
use glam::{DVec2, dvec2};

/// The size of the letters, in the units of the grid: capitals of a font are seven tenths of it high.
const SIZE: f64 = 8.4;
/// From the start of a letter to that of the next, and half the thickness of a stroke.
const STEP: f64 = 5.5;
const HALF: f64 = 0.42;
/// How far the corner of a bent stroke may reach, as a multiple of half its thickness.
const CORNER: f64 = 1.6;

/// The strokes of letters, divided by `|`: places on the grid, each two figures, from the left and from below. A stroke that
/// ends where it begins is closed; none crosses itself.
const LETTERS: [(char, &str); 46] = [
    ('A', "00 26 40|12 32"),
    ('B', "00 06 36 45 44 33 42 41 30 00|03 33"),
    ('C', "45 36 16 05 01 10 30 41"),
    ('D', "00 06 26 44 42 20 00"),
    ('E', "46 06 00 40|03 33"),
    ('F', "46 06 00|03 33"),
    ('G', "45 36 16 05 01 10 30 41 43 23"),
    ('H', "00 06|40 46|03 43"),
    ('I', "20 26|10 30|16 36"),
    ('J', "01 10 20 31 36"),
    ('K', "00 06|46 02|13 40"),
    ('L', "06 00 40"),
    ('M', "00 06 23 46 40"),
    ('N', "00 06 40 46"),
    ('O', "10 30 41 45 36 16 05 01 10"),
    ('P', "00 06 36 45 44 33|33 03"),
    ('Q', "10 30 41 45 36 16 05 01 10|22 40"),
    ('R', "00 06 36 45 44 33|33 03|23 40"),
    ('S', "01 10 30 41 42 33 13 04 05 16 36 45"),
    ('T', "20 26|06 46"),
    ('U', "06 01 10 30 41 46"),
    ('V', "06 20 46"),
    ('W', "06 10 23 30 46"),
    ('X', "00 46|06 40"),
    ('Y', "06 23 46|23 20"),
    ('Z', "06 46 00 40"),
    ('0', "10 30 41 45 36 16 05 01 10|12 34"),
    ('1', "05 26 20|10 30"),
    ('2', "05 16 36 45 44 00 40"),
    ('3', "05 16 36 45 44 33 42 41 30 10 01|13 33"),
    ('4', "30 36 02|02 42"),
    ('5', "46 06 04 34 43 41 30 10 01"),
    ('6', "45 36 16 05 01 10 30 41 42 33|33 03"),
    ('7', "06 46 10"),
    ('8', "13 33 42 41 30 10 01 02 13|13 04 05 16 36 45 44 33"),
    ('9', "01 10 30 41 45 36 16 05 04 13|13 43"),
    ('-', "13 33"),
    ('.', "20 21"),
    (',', "21 10"),
    ('\'', "26 24"),
    ('/', "00 46"),
    ('(', "36 24 22 30"),
    (')', "16 24 22 10"),
    (':', "20 21|23 24"),
    ('+', "13 33|22 24"),
    ('&', "40 05 16 25|25 01 10 20 42"),
];

/// The stroke over a long vowel.
const LONG: &str = "17 37";

/// Returns the outlines of a text in our own letters; small ones are written as capitals, those of full width as narrow ones.
pub fn lettering(text: &str) -> Lettering {
    let (mut rings, mut along, mut missing) = (vec![], 0.0, vec![]);
    for letter in text.chars() {
        let (plain, is_long) = plain(letter);
        let known = LETTERS.iter().find(|(own, _)| *own == plain);
        match known {
            Some((_, strokes)) => {
                let long = is_long.then_some(LONG);
                for stroke in strokes.split('|').chain(long) {
                    let places = places(stroke).map(|p| p + dvec2(along, 0.0));
                    rings.extend(outlines(&places.collect::<Vec<DVec2>>()));
                }
            }
            None if plain == ' ' => {}
            None => {
                missing.push(letter);
                continue;
            }
        }
        along += STEP;
    }
    Lettering {
        rings,
        width: (along - (STEP - 4.0)).max(0.0),
        size: SIZE,
        missing,
    }
}

/// Returns the letter of the alphabet that a letter is written as, and whether its vowel is long.
fn plain(letter: char) -> (char, bool) {
    let narrow = match letter {
        '\u{3000}' => ' ',
        '！'..='～' => char::from_u32(letter as u32 - 0xFEE0).unwrap_or(letter),
        '‐' | '–' | '‑' | 'ー' => '-',
        '’' => '\'',
        other => other,
    };
    let (base, is_long) = match narrow {
        'ā' | 'Ā' | 'â' => ('a', true),
        'ī' | 'Ī' => ('i', true),
        'ū' | 'Ū' | 'û' => ('u', true),
        'ē' | 'Ē' => ('e', true),
        'ō' | 'Ō' | 'ô' => ('o', true),
        other => (other, false),
    };
    (base.to_ascii_uppercase(), is_long)
}

fn places(stroke: &str) -> impl Iterator<Item = DVec2> + '_ {
    stroke.split(' ').map(|place| {
        let mut figures = place.bytes().map(|b| f64::from(b - b'0'));
        dvec2(
            figures.next().unwrap_or_default(),
            figures.next().unwrap_or_default(),
        )
    })
}

/// Returns the ring round a stroke; of a closed one those outside and inside of it.
fn outlines(stroke: &[DVec2]) -> Vec<Vec<DVec2>> {
    let is_closed = stroke.len() > 2 && stroke.first() == stroke.last();
    let points = if is_closed { &stroke[1..] } else { stroke };
    let count = points.len();
    let way = |from: usize, to: usize| (points[to] - points[from]).normalize_or_zero();
    let side = |n: usize, half: f64| {
        let before = (n > 0 || is_closed).then(|| way((n + count - 1) % count, n));
        let after = (n + 1 < count || is_closed).then(|| way(n, (n + 1) % count));
        let (Some(d), Some(e)) = (before.or(after), after.or(before)) else {
            return points[n];
        };
        let bent = (d.perp() + e.perp()).normalize_or(d.perp());
        let far = (1.0 / bent.dot(d.perp()).max(1e-3)).min(CORNER);
        // Ends are square, and as far out as the stroke is thick.
        let end = match (before, after) {
            (None, Some(e)) => -e,
            (Some(d), None) => d,
            _ => DVec2::ZERO,
        };
        points[n] + bent * (far * half) + end * HALF
    };
    let left: Vec<DVec2> = (0..count).map(|n| side(n, HALF)).collect();
    let right: Vec<DVec2> = (0..count).rev().map(|n| side(n, -HALF)).collect();
    match is_closed {
        true => vec![left, right],
        false => vec![left.into_iter().chain(right).collect()],
    }
}
