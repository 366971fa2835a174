//! A model that was made before, and the pictures beside it, as its glTF names them.

use crate::backend::images::{JPEG, KTX2, PNG, is_cut};
use crate::diagnostic::messages::pictures as say;
use crate::diagnostic::{Diagnostic, Diagnostics, Noun, noun};
use crate::source::{FileId, Source};
use percent_encoding::percent_decode_str;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// How pictures that glTF may name begin, and their media types.
const KINDS: [(&[u8], &str); 3] = [
    (PNG, "image/png"),
    (JPEG, "image/jpeg"),
    (b"\xabKTX 20", KTX2),
];

/// What of a glTF is read.
#[derive(Deserialize)]
struct Document {
    #[serde(default)]
    images: Vec<Image>,
}

#[derive(Deserialize)]
struct Image {
    uri: Option<String>,
}

/// What a picture is, by its first bytes; `None` = no picture that glTF may name.
pub(super) fn kind(bytes: &[u8]) -> Option<&'static str> {
    let mut kinds = KINDS.iter();
    kinds
        .find(|(begins, _)| bytes.starts_with(begins))
        .map(|(_, kind)| *kind)
}

/// A model that was made before, with the pictures beside it.
pub(super) struct Model {
    pub(super) bytes: Vec<u8>,
    /// By their names in the model.
    pub(super) pictures: BTreeMap<String, Vec<u8>>,
    /// What messages speak of: the file as a whole, of which no text is shown.
    pub(super) source: Source,
    /// Pictures that cannot be shown.
    pub(super) said: Vec<Diagnostic>,
}

impl Model {
    /// Reads a `.glb` and its pictures below `root`, the real path of a folder; none that lie outside. A model that cannot be
    /// read names none: the page says so of it.
    ///
    /// # Errors
    /// Where the file itself cannot be read.
    pub(super) fn read(root: &Path, path: &Path) -> io::Result<Model> {
        let bytes = fs::read(path)?;
        let source = Source::new(FileId(0), path.to_string_lossy(), b"");
        let folder = path.parent().unwrap_or(root);
        let (mut pictures, mut out) = (BTreeMap::new(), Diagnostics::new());
        for name in names(&bytes).unwrap_or_default() {
            match picture(root, &folder.join(&name)) {
                Ok(bytes) => {
                    pictures.insert(name, bytes);
                }
                Err(why) => out.push(say::not_beside(source.span(0..0), &name, why)),
            }
        }
        Ok(Model {
            bytes,
            pictures,
            source,
            said: out.into_sorted(),
        })
    }
}

/// The names of the pictures beside a model, each once; `None` = it cannot be read.
fn names(model: &[u8]) -> Option<BTreeSet<String>> {
    let json = gltf::binary::Glb::from_slice(model).ok()?.json;
    let document: Document = serde_json::from_slice(&json).ok()?;
    let uris = document.images.into_iter().filter_map(|i| i.uri);
    let beside = uris.filter(|uri| !uri.starts_with("data:"));
    let plain = |uri: String| percent_decode_str(&uri).decode_utf8_lossy().into_owned();
    Some(beside.map(plain).collect())
}

/// A picture, or why it cannot be shown.
fn picture(root: &Path, path: &Path) -> Result<Vec<u8>, Noun> {
    const GONE: Noun = noun("it is not there", "ファイルがありません");
    const OUTSIDE: Noun = noun(
        "it lies outside of the folder that is shown",
        "表示しているフォルダーの外にあります",
    );
    const CLOSED: Noun = noun("it cannot be read", "ファイルを読めません");
    const OTHER: Noun = noun(
        "it is not a PNG, JPEG or KTX2 picture",
        "PNG、JPEG、KTX2 のどれでもありません",
    );
    const CUT: Noun = noun("its end is missing", "終わりが欠けています");
    let path = path.canonicalize().map_err(|_| GONE)?;
    if !path.starts_with(root) {
        return Err(OUTSIDE);
    }
    // Nothing is waited for that is no file.
    let bytes = path.is_file().then(|| fs::read(path).ok()).flatten();
    let bytes = bytes.ok_or(CLOSED)?;
    match kind(&bytes) {
        None => Err(OTHER),
        Some(_) if is_cut(&bytes) => Err(CUT),
        Some(_) => Ok(bytes),
    }
}

/// The folders below that of a model in which its pictures lie. `model` = a real path.
pub(super) fn folders(model: &Path) -> BTreeSet<PathBuf> {
    let root = model.parent().unwrap_or(Path::new("/"));
    let named = fs::read(model).ok().and_then(|bytes| names(&bytes));
    let paths = named.into_iter().flatten().map(|name| root.join(name));
    let folders = paths.filter_map(|path| path.parent()?.canonicalize().ok());
    folders.filter(|folder| folder.starts_with(root)).collect()
}

/// The path below a folder that a browser asks for where a picture is called this: without `.` and `..`.
pub(super) fn asked(name: &str) -> String {
    let mut parts = vec![];
    for part in name.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}
