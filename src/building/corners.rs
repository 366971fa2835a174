//! The corners of a face. A town has millions of faces with three to six corners: those are kept in place,
//! without memory of their own.

use serde::{Serialize, Serializer};
use std::ops::{Deref, DerefMut};

/// How many corners are kept in place.
const FEW: usize = 6;

/// Indices into the points of a solid; used as a slice.
#[derive(Clone, Debug)]
pub struct Corners(Kept);

#[derive(Clone, Debug)]
enum Kept {
    /// So many of them.
    Few(u8, [u32; FEW]),
    Many(Vec<u32>),
}

impl Deref for Corners {
    type Target = [u32];

    fn deref(&self) -> &[u32] {
        match &self.0 {
            Kept::Few(count, corners) => &corners[..usize::from(*count)],
            Kept::Many(corners) => corners,
        }
    }
}

impl DerefMut for Corners {
    fn deref_mut(&mut self) -> &mut [u32] {
        match &mut self.0 {
            Kept::Few(count, corners) => &mut corners[..usize::from(*count)],
            Kept::Many(corners) => corners,
        }
    }
}

impl FromIterator<u32> for Corners {
    fn from_iter<I: IntoIterator<Item = u32>>(corners: I) -> Self {
        let mut few = [0; FEW];
        let mut corners = corners.into_iter();
        for count in 0..FEW {
            match corners.next() {
                Some(corner) => few[count] = corner,
                None => return Corners(Kept::Few(count as u8, few)),
            }
        }
        match corners.next() {
            Some(next) => Corners(Kept::Many(
                few.into_iter().chain([next]).chain(corners).collect(),
            )),
            None => Corners(Kept::Few(FEW as u8, few)),
        }
    }
}

impl<const N: usize> From<[u32; N]> for Corners {
    fn from(corners: [u32; N]) -> Self {
        corners.into_iter().collect()
    }
}

impl Serialize for Corners {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_number_of_corners_is_kept() {
        for count in 0..20 {
            let mut corners: Corners = (0..count).collect();
            assert!(corners.iter().copied().eq(0..count));
            corners.reverse();
            assert!(corners.iter().copied().eq((0..count).rev()));
        }
    }
}
