//! The accessors of the arrays, as they are written: a town has a million of them, and those of the `gltf` crate hold their
//! bounds as trees of JSON values.

use super::arrays::Array;
use gltf::json::accessor::{ComponentType, Type};
use serde::{Serialize, Serializer};

/// The description of an array.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    buffer_view: u32,
    byte_offset: u64,
    count: usize,
    component_type: u32,
    #[serde(rename = "type")]
    elements: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<[Shortest; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<[Shortest; 3]>,
    /// True for whole numbers that stand for shares of one.
    #[serde(skip_serializing_if = "is_false")]
    normalized: bool,
}

impl Accessor {
    /// Returns that of an array, without its place.
    pub(super) fn of(
        array: Array,
        component: ComponentType,
        count: usize,
        bounds: Option<([f32; 3], [f32; 3])>,
    ) -> Accessor {
        Accessor {
            buffer_view: 0,
            byte_offset: 0,
            count,
            component_type: component.as_gl_enum(),
            elements: match array.elements() {
                Type::Scalar => "SCALAR",
                Type::Vec2 => "VEC2",
                Type::Vec3 => "VEC3",
                Type::Vec4 => "VEC4",
                Type::Mat2 => "MAT2",
                Type::Mat3 => "MAT3",
                Type::Mat4 => "MAT4",
            },
            min: bounds.map(|(min, _)| min.map(Shortest)),
            max: bounds.map(|(_, max)| max.map(Shortest)),
            normalized: false,
        }
    }

    /// The same array at a place in a view.
    pub(super) fn at(self, view: usize, byte_offset: u64) -> Accessor {
        Accessor {
            buffer_view: view as u32,
            byte_offset,
            ..self
        }
    }

    /// The same array with shares of one as signed bytes.
    pub(super) fn packed(self) -> Accessor {
        Accessor {
            component_type: ComponentType::I8.as_gl_enum(),
            normalized: true,
            ..self
        }
    }
}

fn is_false(flag: &bool) -> bool {
    !flag
}

/// A number with the fewest digits that are read as the same float.
#[derive(Clone, Copy)]
struct Shortest(f32);

impl Serialize for Shortest {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let Shortest(x) = *self;
        let usual = 1e-3..1e6;
        if x == 0.0 || usual.contains(&x.abs()) {
            return s.serialize_f32(x);
        }
        // Of very large and very small ones, where an exponent begins depends on the width of the float; all files have that of
        // f64.
        let wide = x.to_string().parse::<f64>();
        s.serialize_f64(wide.unwrap_or_else(|_| f64::from(x)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_wide_ones_with_their_digits() {
        let text = |x: f32| serde_json::to_string(&Shortest(x)).expect("a number is JSON");
        let all = [
            0.0,
            -0.0,
            0.1,
            -2.5,
            30.0,
            1e-3,
            1e-7,
            123456.7,
            1e6,
            1e16,
            0.3 + 0.6,
        ];
        let near = all
            .into_iter()
            .flat_map(|x: f32| [x.next_down(), x, x.next_up()]);
        for x in near {
            let wide: f64 = x.to_string().parse().expect("a number");
            assert_eq!(text(x), serde_json::json!(wide).to_string());
        }
        assert_eq!(text(f32::NAN), "null");
    }
}
