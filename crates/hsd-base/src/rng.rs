//! Random choices: each one is a hash of its place, so that an edit elsewhere changes no other choice.
//!
//! A [`Place`] is folded from (seed, house, facade or row, storey, position, operation), one field after another, by
//! the finaliser of splitmix64; strings enter as 64-bit FNV-1a. The numbers are part of the language: a house must look
//! the same in every later version, so nothing here may change.

/// The place of a random choice, as a hash of all fields so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place(u64);

const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Undoes [`mix`].
fn unmixed(mut z: u64) -> u64 {
    z = z ^ (z >> 31) ^ (z >> 62);
    z = z.wrapping_mul(inverse(0x94D0_49BB_1331_11EB));
    z = z ^ (z >> 27) ^ (z >> 54);
    z = z.wrapping_mul(inverse(0xBF58_476D_1CE4_E5B9));
    z ^ (z >> 30) ^ (z >> 60)
}

/// Returns the number that undoes a multiplication by an odd one. Each round doubles the bits that are right.
fn inverse(odd: u64) -> u64 {
    (0..6).fold(odd, |near, _| {
        near.wrapping_mul(2u64.wrapping_sub(odd.wrapping_mul(near)))
    })
}

fn fnv(text: &str) -> u64 {
    text.bytes().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}

impl Place {
    /// Returns the root place of a seed.
    pub fn seed(seed: u64) -> Place {
        Place(mix(seed.wrapping_add(STEP)))
    }

    /// Returns the place of the number `n` within this one.
    pub fn at(self, n: u64) -> Place {
        Place(mix(self.0.rotate_left(23) ^ mix(n.wrapping_add(STEP))))
    }

    /// Returns the place of a name within this one; it never equals that of a number.
    pub fn named(self, name: &str) -> Place {
        self.at(u64::MAX).at(fnv(name))
    }

    /// Returns the seed whose root has this place under a name: what is drawn there is drawn here.
    pub fn seed_under(self, name: &str) -> u64 {
        // Each step of a place can be undone.
        let before =
            |place: u64, n: u64| (unmixed(place) ^ mix(n.wrapping_add(STEP))).rotate_right(23);
        let root = before(before(self.0, fnv(name)), u64::MAX);
        unmixed(root).wrapping_sub(STEP)
    }

    /// Returns the random number of this place, uniform in 0 <= share < 1.
    pub fn share(self) -> f64 {
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns the hash, from which a later step can continue.
    pub fn key(self) -> u64 {
        self.0
    }

    /// Returns the place that a key was taken from.
    pub fn of(key: u64) -> Place {
        Place(key)
    }

    /// Returns a random index by weights, given as their running sums: finite, not decreasing, the last above 0.
    pub fn pick(self, sums: &[f64]) -> usize {
        let mark = self.share() * sums.last().copied().unwrap_or(0.0);
        let index = sums.partition_point(|sum| *sum <= mark);
        index.min(sums.len().saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use crate::rng::*;

    #[test]
    fn draws_are_stable_for_ever() {
        let place = Place::seed(7).named("shop").at(0).at(3);
        assert_eq!(place, Place(FOREVER));
    }

    const FOREVER: u64 = 2_266_374_785_538_885_389;

    #[test]
    fn a_place_has_a_seed_under_any_name() {
        for n in [0, 1, 7, u64::MAX] {
            let place = Place::seed(n).named("so-nikai");
            let seed = place.seed_under("houses 12");
            assert_eq!(Place::seed(seed).named("houses 12"), place);
        }
    }

    #[test]
    fn draws_are_even_and_weights_count() {
        let root = Place::seed(0);
        let mut counts = [0; 3];
        for n in 0..30_000 {
            counts[root.at(n).pick(&[1.0, 1.0, 4.0])] += 1;
        }
        assert_eq!(counts[1], 0);
        assert!((counts[0] - 7_500i32).abs() < 300, "{counts:?}");
    }

    #[test]
    fn neighbours_and_operations_are_independent() {
        let root = Place::seed(1);
        let drawn = |n: u64, operation: u64| root.at(n).at(operation).pick(&[1.0, 2.0]);
        let same = (0..10_000).filter(|&n| drawn(n, 0) == drawn(n, 1)).count();
        assert!(same.abs_diff(5_000) < 200, "{same}");
        let same = (0..10_000)
            .filter(|&n| drawn(n, 0) == drawn(n + 1, 0))
            .count();
        assert!(same.abs_diff(5_000) < 200, "{same}");
    }
}
