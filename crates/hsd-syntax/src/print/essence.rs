//! The meaning of a tree, without its places.
//!
//! Two files mean the same if their trees differ only in places. So this serializer writes everything except
//! [`Span`](hsd_base::source::Span)s, which it recognizes by their name, and knows nothing else of the trees: new fields
//! are compared too.

use hsd_ir::ast::{Document, House, WrittenPart};
use hsd_ir::building::Building;
use serde::ser::{self, Serialize, Serializer};
use std::fmt::Error;

/// Returns the content of a tree as bytes; equal for trees that differ only in places.
pub fn essence(tree: &(impl Essence + ?Sized)) -> Vec<u8> {
    tree.bytes()
}

/// A tree whose [`essence`] can be compared.
///
/// Only the trees of this list: each is compiled once, in this crate, not again in every crate that compares it.
pub trait Essence {
    #[doc(hidden)]
    fn bytes(&self) -> Vec<u8>;
}

macro_rules! trees {
    ($($tree:ty),*) => {
        $(impl Essence for $tree {
            fn bytes(&self) -> Vec<u8> {
                written(self)
            }
        })*
    };
}

trees!(Document, Building, House, Option<Box<House>>, [WrittenPart]);

fn written(tree: &(impl Serialize + ?Sized)) -> Vec<u8> {
    let mut writer = EssenceWriter { bytes: vec![] };
    // Writing to memory does not fail, and none of our trees refuses serialization.
    let written = tree.serialize(&mut writer);
    debug_assert!(written.is_ok());
    writer.bytes
}

struct EssenceWriter {
    bytes: Vec<u8>,
}

type Done = Result<(), Error>;

impl EssenceWriter {
    fn tag(&mut self, tag: u8) -> Done {
        self.bytes.push(tag);
        Ok(())
    }

    fn number(&mut self, number: u64) -> Done {
        self.bytes.extend(number.to_le_bytes());
        Ok(())
    }

    fn text(&mut self, text: &[u8]) -> Done {
        self.number(text.len() as u64)?;
        self.bytes.extend(text);
        Ok(())
    }

    fn open(&mut self) -> Result<&mut Self, Error> {
        self.tag(b'(')?;
        Ok(self)
    }
}

impl<'w> Serializer for &'w mut EssenceWriter {
    type Ok = ();
    type Error = Error;
    type SerializeSeq = &'w mut EssenceWriter;
    type SerializeTuple = &'w mut EssenceWriter;
    type SerializeTupleStruct = &'w mut EssenceWriter;
    type SerializeTupleVariant = &'w mut EssenceWriter;
    type SerializeMap = &'w mut EssenceWriter;
    type SerializeStruct = &'w mut EssenceWriter;
    type SerializeStructVariant = &'w mut EssenceWriter;

    fn serialize_bool(self, v: bool) -> Done {
        self.tag(u8::from(v))
    }

    fn serialize_i8(self, v: i8) -> Done {
        self.serialize_i64(v.into())
    }

    fn serialize_i16(self, v: i16) -> Done {
        self.serialize_i64(v.into())
    }

    fn serialize_i32(self, v: i32) -> Done {
        self.serialize_i64(v.into())
    }

    fn serialize_i64(self, v: i64) -> Done {
        self.number(v as u64)
    }

    fn serialize_u8(self, v: u8) -> Done {
        self.number(v.into())
    }

    fn serialize_u16(self, v: u16) -> Done {
        self.number(v.into())
    }

    fn serialize_u32(self, v: u32) -> Done {
        self.number(v.into())
    }

    fn serialize_u64(self, v: u64) -> Done {
        self.number(v)
    }

    fn serialize_f32(self, v: f32) -> Done {
        self.serialize_f64(v.into())
    }

    fn serialize_f64(self, v: f64) -> Done {
        self.number((v + 0.0).to_bits()) // -0 is 0
    }

    fn serialize_char(self, v: char) -> Done {
        self.number(u64::from(u32::from(v)))
    }

    fn serialize_str(self, v: &str) -> Done {
        self.text(v.as_bytes())
    }

    fn serialize_bytes(self, v: &[u8]) -> Done {
        self.text(v)
    }

    fn serialize_none(self) -> Done {
        self.tag(b'-')
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Done {
        self.tag(b'+')?;
        value.serialize(self)
    }

    fn serialize_unit(self) -> Done {
        Ok(())
    }

    fn serialize_unit_struct(self, _: &'static str) -> Done {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, index: u32, _: &'static str) -> Done {
        self.number(index.into())
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(
        self,
        name: &'static str,
        value: &T,
    ) -> Done {
        match name {
            "Span" => Ok(()),
            _ => value.serialize(self),
        }
    }

    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        value: &T,
    ) -> Done {
        self.number(index.into())?;
        value.serialize(self)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Self, Error> {
        self.open()
    }

    fn serialize_tuple(self, _: usize) -> Result<Self, Error> {
        self.open()
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Self, Error> {
        self.open()
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Error> {
        self.number(index.into())?;
        self.open()
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self, Error> {
        self.open()
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Self, Error> {
        self.open()
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Error> {
        self.number(index.into())?;
        self.open()
    }
}

/// Writes members one after another, with a closing bracket, so that no two lists run into each other.
macro_rules! members {
    ($($of:ident $member:ident),*) => {$(
        impl ser::$of for &mut EssenceWriter {
            type Ok = ();
            type Error = Error;

            fn $member<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
                self.tag(b',')?;
                value.serialize(&mut **self)
            }

            fn end(self) -> Done {
                self.tag(b')')
            }
        }
    )*};
}

members!(
    SerializeSeq serialize_element,
    SerializeTuple serialize_element,
    SerializeTupleStruct serialize_field,
    SerializeTupleVariant serialize_field
);

/// Writes members with names: of fields, or of their values in a map.
macro_rules! named_members {
    ($($of:ident),*) => {$(
        impl ser::$of for &mut EssenceWriter {
            type Ok = ();
            type Error = Error;

            fn serialize_field<T: ?Sized + Serialize>(&mut self, _: &'static str, value: &T) -> Done {
                self.tag(b',')?;
                value.serialize(&mut **self)
            }

            fn end(self) -> Done {
                self.tag(b')')
            }
        }
    )*};
}

named_members!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for &mut EssenceWriter {
    type Ok = ();
    type Error = Error;

    fn serialize_key<T: ?Sized + Serialize>(&mut self, key: &T) -> Done {
        self.tag(b',')?;
        key.serialize(&mut **self)
    }

    fn serialize_value<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        value.serialize(&mut **self)
    }

    fn end(self) -> Done {
        self.tag(b')')
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_base::source::{FileId, Span, Spanned};

    #[test]
    fn places_do_not_count_and_all_else_does() {
        let span = |start, end| Span {
            file: FileId(0),
            start,
            end,
        };
        let one = |value: &str, start| vec![Some(Spanned::new(value.to_owned(), span(start, 9)))];
        assert_eq!(written(&one("GSI", 0)), written(&one("GSI", 4)));
        assert_ne!(written(&one("GSI", 0)), written(&one("GDE", 0)));
        assert_ne!(written(&vec![1.0]), written(&vec![1.5]));
        assert_ne!(
            written(&(vec![1u8], vec![2u8])),
            written(&(vec![1u8, 2], vec![0u8; 0]))
        );
        assert_eq!(written(&Some(span(1, 2))), written(&Some(span(3, 4))));
        assert_ne!(written(&Some(span(1, 2))), written(&None::<Span>));
    }
}
