//! Descriptions of I/O errors in both languages.

use hsd_base::diagnostic::{Language, Text};
use hsd_base::text;
use std::fmt;
use std::io::{Error, ErrorKind};

/// A bilingual description, as the payload of an I/O error.
#[derive(Debug)]
struct Bilingual(Text);

impl fmt::Display for Bilingual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.in_language(Language::English))
    }
}

impl std::error::Error for Bilingual {}

/// Returns an I/O error with a bilingual description.
pub(crate) fn error(kind: ErrorKind, why: Text) -> Error {
    Error::new(kind, Bilingual(why))
}

/// Returns the description of an error; common system errors are translated.
pub(crate) fn of(error: &Error) -> Text {
    if let Some(own) = error.get_ref().and_then(|e| e.downcast_ref::<Bilingual>()) {
        return own.0.clone();
    }
    let ja = match error.kind() {
        ErrorKind::NotFound => "ファイルまたはフォルダーがありません",
        ErrorKind::PermissionDenied => "アクセスが許可されていません",
        ErrorKind::AlreadyExists => "すでにあります",
        ErrorKind::StorageFull => "空き容量がありません",
        _ => return error.to_string().into(),
    };
    text!([error, ja] "{error}", "{ja}")
}
