//! The colour of holes, which shows at their edges in smaller mip levels.

/// The number of pixels that colour spreads into a hole.
const STEPS: u8 = 8;

/// Marks a pixel that has no colour yet.
const UNKNOWN: u8 = u8::MAX;

/// Fills holes with the colour of their nearest neighbours in a few steps, so that edges do not darken in smaller mip
/// levels. `color` is RGBA; opaque pixels are known.
pub(super) fn fill(color: &mut [u8], w: usize, h: usize) {
    // The step in which each pixel got its colour.
    let mut steps: Vec<u8> = color
        .chunks_exact(4)
        .map(|p| if p[3] > 0 { 0 } else { UNKNOWN })
        .collect();
    let all = 0..w * h;
    let mut edge: Vec<usize> = all.filter(|at| steps[*at] == UNKNOWN).collect();
    for step in 1..=STEPS {
        let mut filled = vec![];
        for at in edge {
            if steps[at] != UNKNOWN {
                continue;
            }
            let known = |at: &usize| steps[*at] < step;
            if let Some(from) = neighbours(at, w, h).find(known) {
                color.copy_within(4 * from..4 * from + 3, 4 * at);
                steps[at] = step;
                filled.push(at);
            }
        }
        // Others have no neighbour that was not known before.
        let next = filled.into_iter().flat_map(|at| neighbours(at, w, h));
        edge = next.filter(|at| steps[*at] == UNKNOWN).collect();
    }
}

/// Returns the pixels to the left, to the right, above and below.
fn neighbours(at: usize, w: usize, h: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (at % w, at / w);
    let four = [
        (x > 0).then(|| at - 1),
        (x + 1 < w).then(|| at + 1),
        (y > 0).then(|| at - w),
        (y + 1 < h).then(|| at + w),
    ];
    four.into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_spreads_into_holes_for_some_pixels() {
        let mut color = vec![0; 4 * 20];
        color[..4].copy_from_slice(&[9, 8, 7, 255]);
        fill(&mut color, 20, 1);
        for (x, pixel) in color.chunks_exact(4).enumerate() {
            let opaque = if x == 0 { 255 } else { 0 };
            match x <= usize::from(STEPS) {
                true => assert_eq!(pixel, [9, 8, 7, opaque]),
                false => assert_eq!(pixel, [0; 4]),
            }
        }
    }
}
