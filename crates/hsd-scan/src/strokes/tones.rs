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
    /// The ink before each row and, last, all of it.
    before: Vec<u32>,
    /// The first row with ink, and the row after the last.
    rows: [usize; 2],
}

impl Tones {
    /// Sums ink.
    pub(super) fn new(by_place: Vec<u8>) -> Tones {
        let mut before = vec![0];
        for row in by_place.chunks_exact(ALONG) {
            let ink: u32 = row.iter().map(|t| u32::from(*t)).sum();
            before.push(before[before.len() - 1] + ink);
        }
        let is_inked = |row: &[u32]| row[1] > row[0];
        let first = before.windows(2).position(is_inked).unwrap_or(0);
        let last = before.windows(2).rposition(is_inked);
        Tones {
            rows: [first, last.map_or(first, |last| last + 1)],
            before,
            by_place,
        }
    }

    /// The sum of all.
    pub(super) fn all(&self) -> u32 {
        self.before[self.before.len() - 1]
    }

    /// The ink at each place.
    pub(super) fn by_place(&self) -> &[u8] {
        &self.by_place
    }

    /// Ink in common with that of another unit: a row farther on, in place and a row back.
    pub(super) fn common(&self, other: &Tones) -> [u32; 3] {
        [1, 0, -1].map(|shift| self.common_at(other, shift))
    }

    /// Ink in common with the rows so much farther on.
    fn common_at(&self, other: &Tones, shift: isize) -> u32 {
        let end = self.before.len() as isize - 1;
        let [first, last] = self.rows.map(|row| row as isize);
        let (first, last) = (first.max(-shift), last.min(end - shift));
        if first >= last {
            return 0;
        }
        let rows = |tones: &Tones, shift: isize| {
            let [from, to] = [first, last].map(|row| (row + shift) as usize);
            (from, to, tones.before[to] - tones.before[from])
        };
        let (mine, theirs) = (rows(self, 0), rows(other, shift));
        let a = &self.by_place[mine.0 * ALONG..mine.1 * ALONG];
        let b = &other.by_place[theirs.0 * ALONG..theirs.1 * ALONG];
        // The lesser of two is half of what their sum exceeds their difference by, and processors sum differences fastest.
        let differences = a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(*b)));
        (mine.2 + theirs.2 - differences.sum::<u32>()) / 2
    }
}
