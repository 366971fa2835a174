//! Corners of a plan that are nearly at one place are one.

use glam::DVec2;

/// Corners nearer in plan are one, metres.
pub(super) const WELD: f64 = 2e-5;

/// Returns the corners in ascending order of x, those nearly at one place once, and for each one given its number among
/// them.
pub(super) fn welded(corners: &[DVec2]) -> (Vec<DVec2>, Vec<u32>) {
    let (mut place, places) = distinct(corners);
    let mut order: Vec<(i64, u32)> = places.iter().map(|at| ascending(at.x)).zip(0..).collect();
    order.sort_unstable();
    let mut number = vec![0; order.len()];
    let mut corners: Vec<DVec2> = Vec::with_capacity(order.len());
    for (_, n) in order {
        let at = places[n as usize];
        let near = corners.iter().rev().take_while(|c| at.x - c.x < WELD);
        let same = near.enumerate().find(|(_, c)| (c.y - at.y).abs() < WELD);
        let id = match same.map(|s| s.0) {
            Some(back) => corners.len() - 1 - back,
            None => {
                corners.push(at);
                corners.len() - 1
            }
        };
        number[n as usize] = id as u32;
    }
    for place in &mut place {
        *place = number[*place as usize];
    }
    (corners, place)
}

/// Returns whole numbers in the order of numbers: they are compared faster.
fn ascending(x: f64) -> i64 {
    let bits = x.to_bits().cast_signed();
    bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed()
}

/// Returns for each corner the number of its place, and the places in the order of their first corners. Slabs, fillings
/// and slopes side by side have most corners in common, to the last bit; only those that differ are left to be sorted.
fn distinct(corners: &[DVec2]) -> (Vec<u32>, Vec<DVec2>) {
    const NONE: u32 = u32::MAX;
    let count = corners.len();
    let mut slots = vec![NONE; (2 * count).next_power_of_two()];
    let (mut numbers, mut places) = (Vec::with_capacity(count), Vec::with_capacity(count / 2));
    let bits = |at: DVec2| at.to_array().map(f64::to_bits);
    for &at in corners {
        let own = bits(at);
        let mixed = own.iter().fold(0, |mixed: u64, n| {
            (mixed.rotate_left(5) ^ n).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        });
        // The upper half of a product depends on all bits.
        let mut slot = (mixed >> 32) as usize & (slots.len() - 1);
        let same = |known: u32| known == NONE || bits(places[known as usize]) == own;
        while !same(slots[slot]) {
            slot = (slot + 1) & (slots.len() - 1);
        }
        if slots[slot] == NONE {
            slots[slot] = places.len() as u32;
            places.push(at);
        }
        numbers.push(slots[slot]);
    }
    (numbers, places)
}
