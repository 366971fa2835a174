//! Streams of elements as packed by meshopt. Floats are integer multiples of a power of two (its filter `EXPONENTIAL`):
//! neighbours then differ in few bits, and the uniform step leaves no gaps.

use meshopt::encode_filter_oct;
use serde_json::{Value, json};

/// Bits per coordinate of a normal.
const DIRECTION_BITS: i32 = 12;

/// The content of a packed view.
pub(in crate::gltf) enum Stream {
    /// Number of floats per element; each has an exponent in the high byte and a mantissa.
    Floats(usize, Vec<u32>),
    /// Normals or tangents, octahedrally encoded to two coordinates and a sign.
    Directions(Vec<[i16; 4]>),
    /// Corners of triangles, with their size in bytes.
    Indices(usize, Vec<u32>),
}

impl Stream {
    pub(in crate::gltf) fn floats(elements: usize) -> Stream {
        Stream::Floats(elements, vec![])
    }

    pub(in crate::gltf) fn directions() -> Stream {
        Stream::Directions(vec![])
    }

    pub(in crate::gltf) fn indices(bytes: usize) -> Stream {
        Stream::Indices(bytes, vec![])
    }

    /// Appends floats, rounded to 2 to the power of `step` unless they are too large for it.
    pub(in crate::gltf) fn push_floats(&mut self, values: &[f32], step: i32) {
        if let Stream::Floats(_, all) = self {
            let step = step_of(values, step);
            let exponent = (step as u32) << 24;
            let mantissa = |x: &f32| multiple(*x, step) as u32 & 0x00ff_ffff;
            all.extend(values.iter().map(|x| exponent | mantissa(x)));
        }
    }

    /// Appends unit vectors of three numbers, or four where the last is a sign.
    pub(in crate::gltf) fn push_directions(&mut self, values: &[f32], numbers: usize) {
        if let Stream::Directions(all) = self {
            let four = |v: &[f32]| [v[0], v[1], v[2], v.get(3).copied().unwrap_or(0.0)];
            let list: Vec<[f32; 4]> = values.chunks_exact(numbers).map(four).collect();
            all.extend(encode_filter_oct::<i16>(&list, DIRECTION_BITS));
        }
    }

    pub(in crate::gltf) fn push_indices(&mut self, values: &[u32]) {
        if let Stream::Indices(_, all) = self {
            all.extend(values);
        }
    }

    /// Returns the size of an unpacked element, bytes.
    pub(in crate::gltf) fn stride(&self) -> usize {
        match self {
            Stream::Floats(elements, _) => 4 * elements,
            Stream::Directions(_) => 8,
            Stream::Indices(bytes, _) => *bytes,
        }
    }

    /// Returns the number of elements.
    pub(in crate::gltf) fn count(&self) -> usize {
        match self {
            Stream::Floats(elements, all) => all.len() / elements,
            Stream::Directions(all) => all.len(),
            Stream::Indices(_, all) => all.len(),
        }
    }

    /// Returns the unpacked size, bytes.
    pub(in crate::gltf) fn length(&self) -> usize {
        self.stride() * self.count()
    }

    /// Returns the extension's name of the packing mode.
    pub(in crate::gltf) fn mode(&self) -> &'static str {
        match self {
            Stream::Indices(..) => "TRIANGLES",
            Stream::Floats(..) | Stream::Directions(_) => "ATTRIBUTES",
        }
    }

    /// Returns the extension's name of the filter applied after unpacking.
    pub(in crate::gltf) fn filter(&self) -> Option<&'static str> {
        match self {
            Stream::Floats(..) => Some("EXPONENTIAL"),
            Stream::Directions(_) => Some("OCTAHEDRAL"),
            Stream::Indices(..) => None,
        }
    }

    /// Returns what a view says of its packed bytes, given where they begin in buffer 0 and how many they are.
    pub(in crate::gltf) fn extension(&self, start: usize, length: usize) -> Value {
        let mut extension = json!({
            "buffer": 0,
            "byteOffset": start,
            "byteLength": length,
            "byteStride": self.stride(),
            "count": self.count(),
            "mode": self.mode(),
        });
        if let Some(filter) = self.filter() {
            extension["filter"] = filter.into();
        }
        extension
    }

    /// Returns the packed bytes; empty for an empty stream.
    pub(in crate::gltf) fn packed(&self) -> Vec<u8> {
        if self.count() == 0 {
            return vec![];
        }
        let packed = match self {
            Stream::Floats(1, all) => vertices(all.as_chunks::<1>().0, |x| x.to_le()),
            Stream::Floats(2, all) => vertices(all.as_chunks::<2>().0, |x| x.to_le()),
            Stream::Floats(3, all) => vertices(all.as_chunks::<3>().0, |x| x.to_le()),
            Stream::Floats(_, all) => vertices(all.as_chunks::<4>().0, |x| x.to_le()),
            Stream::Directions(all) => vertices(all, |x| x.to_le()),
            Stream::Indices(_, all) => {
                let vertices = all.iter().max().map_or(0, |i| *i as usize + 1);
                meshopt::encode_index_buffer(all, vertices)
            }
        };
        packed.expect("there is room for the worst case")
    }
}

/// Packs elements in version 0 of the codec, the only one that the extension supports.
fn vertices<T: Copy, const N: usize>(
    all: &[[T; N]],
    little: impl Fn(T) -> T,
) -> meshopt::Result<Vec<u8>> {
    let list: Vec<[T; N]> = all.iter().map(|e| e.map(&little)).collect();
    meshopt::encode_vertex_buffer_level(&list, 2, Some(0))
}

/// Rounds floats as [`Stream::push_floats`] does.
pub(in crate::gltf) fn rounded(values: &[f32], step: i32) -> Vec<f32> {
    let step = step_of(values, step);
    let whole = |x: &f32| (f64::from(multiple(*x, step)) * power(step)) as f32;
    values.iter().map(whole).collect()
}

/// Returns the least step, at least `least`, at which all floats are multiples that fit 24 bits.
fn step_of(values: &[f32], least: i32) -> i32 {
    let largest = values.iter().fold(0.0, |m: f32, x| m.max(x.abs()));
    let fits = |step: &i32| f64::from(largest) / power(*step) < f64::from((1 << 23) - 1);
    (least..100).find(fits).unwrap_or(100)
}

fn multiple(x: f32, step: i32) -> i32 {
    (f64::from(x) / power(step)).round() as i32
}

/// Returns 2 to the power of `step`, exactly.
fn power(step: i32) -> f64 {
    libm::ldexp(1.0, step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_stand_on_a_grid() {
        let values = [0.0, 1.0, -0.909_091, 2000.0];
        let near = rounded(&values, -12);
        assert_eq!(near[..2], [0.0, 1.0]);
        assert!((near[2] - values[2]).abs() <= 0.5 / 4096.0);
        // A step that does not reach gives way.
        assert_eq!(rounded(&[1e7], -12), [1e7]);
        assert_eq!(step_of(&[1e7], -12), 1);
        assert_eq!(step_of(&[-2047.5], -12), -12);
    }

    #[test]
    fn a_reader_gets_the_rounded_floats() {
        let values = [0.125, -3.3, 100.01, 1e6, -1e6, 0.0];
        let mut stream = Stream::floats(3);
        stream.push_floats(&values, -12);
        assert_eq!((stream.count(), stream.length()), (2, 24));
        let packed = stream.packed();
        let mut read: Vec<[u32; 3]> =
            meshopt::decode_vertex_buffer(&packed, 2).expect("it is whole");
        meshopt::decode_filter_exp(&mut read);
        let read: Vec<f32> = read
            .as_flattened()
            .iter()
            .map(|x| f32::from_bits(*x))
            .collect();
        assert_eq!(read, rounded(&values, -12));
    }
}
