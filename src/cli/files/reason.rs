//! Why a file could not be read or written.

use crate::diagnostic::Text;
use crate::text;
use std::fmt;
use std::io::{Error, ErrorKind};

/// A reason of our own, as the payload of an error of input or output.
#[derive(Debug)]
struct Own(Text);

impl fmt::Display for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Own {}

/// An error with a reason of our own.
pub(in crate::cli) fn error(kind: ErrorKind, why: Text) -> Error {
    Error::new(kind, Own(why))
}

/// The reason of an error; the usual ones of the system in both languages.
pub(in crate::cli) fn of(error: &Error) -> Text {
    if let Some(own) = error.get_ref().and_then(|e| e.downcast_ref::<Own>()) {
        return own.0.clone();
    }
    let ja = match error.kind() {
        ErrorKind::NotFound => "ファイルかフォルダーがありません",
        ErrorKind::PermissionDenied => "許可されていません",
        ErrorKind::AlreadyExists => "すでにあります",
        ErrorKind::StorageFull => "空き容量がありません",
        _ => return error.to_string().into(),
    };
    text!("{error}", "{ja}")
}
