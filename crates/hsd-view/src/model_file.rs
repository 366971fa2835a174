//! Existing models (`.glb`) and their external textures.

use hsd_base::diagnostic::{Diagnostic, Diagnostics, Noun, noun};
use hsd_base::source::{FileId, Source};
use hsd_export::images::{JPEG, KTX2, PNG, is_cut};
use hsd_passes::messages::pictures as say;
use percent_encoding::percent_decode_str;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Magic numbers and media types of the image formats of glTF.
const KINDS: [(&[u8], &str); 3] = [
    (PNG, "image/png"),
    (JPEG, "image/jpeg"),
    (b"\xabKTX 20", KTX2),
];

/// The part of a glTF document that is read.
#[derive(Deserialize)]
struct GltfJson {
    #[serde(default)]
    images: Vec<Image>,
}

#[derive(Deserialize)]
struct Image {
    uri: Option<String>,
}

/// Returns the media type of an image by its first bytes; `None` for formats that glTF does not allow.
pub(super) fn kind(bytes: &[u8]) -> Option<&'static str> {
    let mut kinds = KINDS.iter();
    kinds
        .find(|(begins, _)| bytes.starts_with(begins))
        .map(|(_, kind)| *kind)
}

/// A model with its external textures.
pub(super) struct ModelFile {
    pub(super) bytes: Vec<u8>,
    /// By their names in the model.
    pub(super) pictures: BTreeMap<String, Vec<u8>>,
    /// The file as a source without text, for diagnostics.
    pub(super) source: Source,
    /// Diagnostics of textures that cannot be shown.
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl ModelFile {
    /// Reads a `.glb` and its external textures below `root`, a canonical path. A damaged model has no textures; the page
    /// reports it.
    ///
    /// # Errors
    /// If the file itself cannot be read.
    pub(super) fn read(root: &Path, path: &Path) -> io::Result<ModelFile> {
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
        Ok(ModelFile {
            bytes,
            pictures,
            source,
            diagnostics: out.into_sorted(),
        })
    }
}

/// Returns the names of the external textures of a model; `None` if it cannot be parsed.
fn names(model: &[u8]) -> Option<BTreeSet<String>> {
    let json = gltf::binary::Glb::from_slice(model).ok()?.json;
    let document: GltfJson = serde_json::from_slice(&json).ok()?;
    let uris = document.images.into_iter().filter_map(|i| i.uri);
    let beside = uris.filter(|uri| !uri.starts_with("data:"));
    let plain = |uri: String| percent_decode_str(&uri).decode_utf8_lossy().into_owned();
    Some(beside.map(plain).collect())
}

/// Reads a texture, or returns the reason why it cannot be shown.
fn picture(root: &Path, path: &Path) -> Result<Vec<u8>, Noun> {
    const GONE: Noun = noun("the file does not exist", "ファイルがありません");
    const OUTSIDE: Noun = noun(
        "the file is outside the opened folder",
        "開いているフォルダーの外にあります",
    );
    const CLOSED: Noun = noun("the file cannot be read", "ファイルを読めません");
    const OTHER: Noun = noun(
        "the file is not a PNG, JPEG or KTX2 image",
        "PNG、JPEG、KTX2 のどれでもありません",
    );
    const CUT: Noun = noun("the file is truncated", "ファイルの末尾が欠けています");
    let path = path.canonicalize().map_err(|_| GONE)?;
    if !path.starts_with(root) {
        return Err(OUTSIDE);
    }
    // Does not open devices and pipes, which could block.
    let bytes = path.is_file().then(|| fs::read(path).ok()).flatten();
    let bytes = bytes.ok_or(CLOSED)?;
    match kind(&bytes) {
        None => Err(OTHER),
        Some(_) if is_cut(&bytes) => Err(CUT),
        Some(_) => Ok(bytes),
    }
}

/// Returns the paths of the external textures of a model; none of one that is damaged.
pub(super) fn textures(model: &Path) -> Vec<PathBuf> {
    let folder = model.parent().unwrap_or(Path::new(""));
    let named = fs::read(model).ok().and_then(|bytes| names(&bytes));
    named
        .into_iter()
        .flatten()
        .map(|name| folder.join(name))
        .collect()
}

/// Returns the folders of the external textures of a model, below its own. `model` is a canonical path.
pub(super) fn folders(model: &Path) -> BTreeSet<PathBuf> {
    let root = model.parent().unwrap_or(Path::new("/"));
    let named = fs::read(model).ok().and_then(|bytes| names(&bytes));
    let paths = named.into_iter().flatten().map(|name| root.join(name));
    let folders = paths.filter_map(|path| path.parent()?.canonicalize().ok());
    folders.filter(|folder| folder.starts_with(root)).collect()
}

/// Returns the path that a browser requests for a relative URI: without `.` and `..`.
pub(super) fn requested_path(name: &str) -> String {
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
