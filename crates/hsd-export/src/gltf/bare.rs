//! Detail 0: triangles without normals, which readers shade flat. Corners at one place with the same texture
//! coordinates are one vertex, whatever faces meet there: the arrays of a house shrink to less than half.

use super::arrays::MaterialRef;
use hsd_scene::Primitive;

/// Primitives on common vertices.
#[derive(Default)]
pub(super) struct Bare {
    /// Metres, z up.
    pub(super) positions: Vec<[f32; 3]>,
    /// As in the file: repeats of the texture, v downwards. Vertices without a texture have any.
    pub(super) uvs: Vec<[f32; 2]>,
    /// The indices of each primitive.
    pub(super) indices: Vec<Vec<u32>>,
}

/// A slot of [`Places`] that holds no vertex.
const FREE: u32 = u32::MAX;

impl Bare {
    /// Joins primitives of these materials.
    pub(super) fn of(list: &[(&Primitive, MaterialRef)]) -> Bare {
        let count = list.iter().map(|(p, _)| p.positions.len()).sum();
        let mut bare = Bare {
            positions: Vec::with_capacity(count / 2),
            uvs: Vec::with_capacity(count / 2),
            indices: vec![vec![]; list.len()],
        };
        let mut places = Places::new(count);
        // Those without a texture come last, since they take the vertices of others.
        for textured in [true, false] {
            for (n, (p, material)) in list.iter().enumerate() {
                if material.metres.is_some() == textured {
                    let numbers = bare.numbers(p, material.metres, &mut places);
                    bare.indices[n] = p.indices.iter().map(|i| numbers[*i as usize]).collect();
                }
            }
        }
        bare
    }

    /// Returns the numbers of the vertices of a primitive.
    fn numbers(&mut self, p: &Primitive, metres: Option<f32>, places: &mut Places) -> Vec<u32> {
        let corners = p.positions.iter().zip(&p.uvs);
        let number = |(position, uv): (&[f32; 3], &[f32; 2])| {
            let [x, y, z] = *position;
            let uv = metres.map(|m| [uv[0] / m + 0.0, 1.0 - uv[1] / m]);
            self.number([x + 0.0, y + 0.0, z + 0.0], uv, places)
        };
        corners.map(number).collect()
    }

    fn number(&mut self, position: [f32; 3], uv: Option<[f32; 2]>, places: &mut Places) -> u32 {
        let same = |n: u32| {
            let n = n as usize;
            self.positions[n] == position && uv.is_none_or(|uv| self.uvs[n] == uv)
        };
        let slot = places.find(position, same);
        if *slot == FREE {
            *slot = self.positions.len() as u32;
            self.positions.push(position);
            self.uvs.push(uv.unwrap_or_default());
        }
        *slot
    }
}

/// The numbers of vertices by their positions, in slots of which at least half are free.
struct Places {
    slots: Vec<u32>,
}

impl Places {
    fn new(count: usize) -> Places {
        Places {
            slots: vec![FREE; (2 * count).next_power_of_two()],
        }
    }

    /// Returns the slot of the vertex at a position that passes a test, or a free one.
    fn find(&mut self, position: [f32; 3], same: impl Fn(u32) -> bool) -> &mut u32 {
        let last = self.slots.len() - 1;
        let mut at = hash(position) as usize & last;
        while self.slots[at] != FREE && !same(self.slots[at]) {
            at = (at + 1) & last;
        }
        &mut self.slots[at]
    }
}

fn hash([x, y, z]: [f32; 3]) -> u32 {
    const ODD: u64 = 0x9E37_79B9_7F4A_7C15;
    let mix = |sum: u64, x: f32| (sum ^ u64::from(x.to_bits())).wrapping_mul(ODD);
    (mix(mix(mix(0, x), y), z) >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use gltf::json::Index;
    use hsd_scene::MaterialId;

    fn square(z: f32, uv: f32) -> Primitive {
        let corners = [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
        Primitive {
            material: MaterialId(0),
            positions: corners.into(),
            normals: vec![[0.0, 0.0, 1.0]; 4],
            uvs: corners.map(|[x, y, _]| [x + uv, y]).into(),
            mirror_uvs: vec![],
            indices: vec![0, 1, 2, 0, 2, 3],
        }
    }

    fn material(metres: Option<f32>) -> MaterialRef {
        MaterialRef {
            number: Index::new(0),
            metres,
            relief: false,
            mirrors: false,
        }
    }

    #[test]
    fn corners_are_shared_where_nothing_differs() {
        let (low, moved, high) = (square(0.0, 0.0), square(0.0, 2.0), square(1.0, 0.0));
        let vertices = |list: &[(&Primitive, Option<f32>)]| {
            let list: Vec<_> = list.iter().map(|(p, m)| (*p, material(*m))).collect();
            let bare = Bare::of(&list);
            for ((p, _), indices) in list.iter().zip(&bare.indices) {
                let own = p.indices.iter().map(|i| p.positions[*i as usize]);
                let shown = indices.iter().map(|i| bare.positions[*i as usize]);
                assert!(own.eq(shown));
            }
            bare.positions.len()
        };
        assert_eq!(vertices(&[(&low, Some(1.0)), (&low, Some(1.0))]), 4);
        assert_eq!(vertices(&[(&low, Some(1.0)), (&moved, Some(1.0))]), 8);
        assert_eq!(vertices(&[(&low, Some(1.0)), (&low, Some(2.0))]), 7);
        assert_eq!(vertices(&[(&moved, None), (&low, Some(1.0))]), 4);
        assert_eq!(vertices(&[(&low, None), (&moved, None), (&high, None)]), 8);
    }
}
