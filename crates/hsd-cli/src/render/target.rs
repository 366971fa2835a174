//! The files that images are written to, and their formats.

use crate::Failure;
use crate::files::output::{Committer, Files};
use clap::ValueEnum;
use hsd_scene::texture;
use std::io;
use std::path::{Path, PathBuf};

/// The JPEG quality.
const QUALITY: u8 = 88;

/// Image formats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum ImageFormat {
    /// Lossless.
    #[default]
    Png,
    /// Several times smaller, with losses.
    Jpg,
}

impl ImageFormat {
    pub(super) fn of(path: &Path) -> Option<ImageFormat> {
        match &*path.extension()?.to_string_lossy().to_lowercase() {
            "png" => Some(ImageFormat::Png),
            "jpg" | "jpeg" => Some(ImageFormat::Jpg),
            _ => None,
        }
    }

    fn extension(self) -> &'static str {
        match self {
            ImageFormat::Png => "png",
            ImageFormat::Jpg => "jpg",
        }
    }
}

/// The output of a run.
pub(super) enum Target<'a> {
    File(&'a Path, ImageFormat),
    Folder(&'a Path, ImageFormat),
}

impl Target<'_> {
    /// Returns the path of the image of a view.
    pub(super) fn path(&self, input: &Path, view: &str) -> PathBuf {
        match self {
            Target::File(path, _) => path.to_path_buf(),
            Target::Folder(folder, kind) => {
                let stem = input.file_stem().unwrap_or_default().to_string_lossy();
                folder.join(format!("{stem}-{view}.{}", kind.extension()))
            }
        }
    }

    pub(super) fn kind(&self) -> ImageFormat {
        match self {
            Target::File(_, kind) | Target::Folder(_, kind) => *kind,
        }
    }
}

/// Writes an image.
pub(super) fn write(
    path: &Path,
    kind: ImageFormat,
    png: Vec<u8>,
    committer: &Committer,
) -> Result<(), Failure> {
    let drawn = image::load_from_memory_with_format(&png, image::ImageFormat::Png);
    let drawn = drawn.map_err(|e| Failure::at(path.display(), io::Error::other(e.to_string())))?;
    let bytes = match kind {
        ImageFormat::Png => png,
        ImageFormat::Jpg => texture::jpeg(&drawn.into_rgb8(), QUALITY),
    };
    committer.write(path, Files::bytes(bytes)).map(drop)
}
