//! Ink of a unit as tones, and how much of it two units share.

/// Samples along a unit.
pub(super) const ALONG: usize = 24;

/// A share of ink as a number of 0 to 255.
pub(super) fn tone(share: f32) -> u8 {
    (share * 255.0 + 0.5) as u8
}

/// Ink of a unit by place, and the sums by which it is compared.
#[derive(Clone, PartialEq)]
pub(super) struct Tones {
    by_place: Vec<u8>,
    /// The sum of all.
    pub(super) all: u32,
    first_row: u32,
    last_row: u32,
}

impl Tones {
    /// Sums ink.
    pub(super) fn new(by_place: Vec<u8>) -> Tones {
        let sum = |tones: &[u8]| tones.iter().map(|t| u32::from(*t)).sum();
        Tones {
            all: sum(&by_place),
            first_row: sum(&by_place[..ALONG]),
            last_row: sum(&by_place[by_place.len() - ALONG..]),
            by_place,
        }
    }

    /// The ink at each place.
    pub(super) fn by_place(&self) -> &[u8] {
        &self.by_place
    }

    /// Ink in common with that of another unit: a row farther on, in place and a row back.
    pub(super) fn common(&self, other: &Tones) -> [u32; 3] {
        let (mine, theirs) = (&self.by_place, &other.by_place);
        let end = mine.len() - ALONG;
        // The lesser of two is half of what their sum exceeds their difference by, and processors sum differences fastest.
        let lesser = |sum: u32, a: &[u8], b: &[u8]| {
            let differences = a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(*b)));
            (sum - differences.sum::<u32>()) / 2
        };
        let all = self.all + other.all;
        [
            lesser(
                all - self.last_row - other.first_row,
                &mine[..end],
                &theirs[ALONG..],
            ),
            lesser(all, mine, theirs),
            lesser(
                all - self.first_row - other.last_row,
                &mine[ALONG..],
                &theirs[..end],
            ),
        ]
    }
}
