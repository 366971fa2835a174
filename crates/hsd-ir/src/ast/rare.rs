//! Parts of a house that most houses leave at their defaults.

use super::{Fittings, Roofs, Settings};
use serde::{Serialize, Serializer};
use std::ops::{Deref, DerefMut};
use std::sync::LazyLock;

/// A value that is usually the default, which then takes no more room than a pointer: a mebibyte of text can hold a
/// quarter of a million houses without a single setting. Changing it makes the room.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rare<T>(Option<Box<T>>);

/// A type with a default that lasts as long as the program.
pub trait Usual: Default + PartialEq + 'static {
    /// Returns the default.
    fn usual() -> &'static Self;
}

impl<T: Usual> From<T> for Rare<T> {
    fn from(value: T) -> Rare<T> {
        Rare((value != *T::usual()).then(|| Box::new(value)))
    }
}

impl<T: Usual> Deref for Rare<T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.0.as_deref().unwrap_or_else(|| T::usual())
    }
}

impl<T: Usual> DerefMut for Rare<T> {
    fn deref_mut(&mut self) -> &mut T {
        self.0.get_or_insert_default()
    }
}

impl<T: Usual + Serialize> Serialize for Rare<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (**self).serialize(serializer)
    }
}

macro_rules! usual {
    ($($of:ty),*) => {
        $(impl Usual for $of {
            fn usual() -> &'static Self {
                static USUAL: LazyLock<$of> = LazyLock::new(<$of>::default);
                &USUAL
            }
        })*
    };
}

usual!(Settings, Fittings, Roofs);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ast::House;
    use hsd_base::source::{Span, Spanned};

    #[test]
    fn what_is_usual_takes_no_room() {
        let mut settings = Rare::from(Settings::default());
        assert!(settings.0.is_none() && settings.unit.is_none());
        settings.unit = Some(Spanned::new(3.25, Span::default()));
        assert_eq!(settings.unit.as_ref().map(|u| u.value), Some(3.25));
        assert!(
            size_of::<House>() <= 256,
            "{} bytes for a house of nothing",
            size_of::<House>()
        );
    }
}
