//! Writing outputs: every file under a temporary name first, then all renamed. A reader sees the old file or
//! the new one, never a part of it.

use super::Stop;
use super::input::STDIN;
use crate::backend::{Images, OutFile, gltf, obj, stl};
use crate::scene::Scene;
use clap::ValueEnum;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The formats of models.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Model {
    /// glTF in one file.
    #[default]
    Glb,
    /// glTF as text, with its buffer and pictures beside it.
    Gltf,
    /// OBJ with MTL and pictures beside it.
    Obj,
    /// STL for printing, in millimetres.
    Stl,
}

impl Model {
    pub(super) fn ending(self) -> &'static str {
        match self {
            Model::Glb => "glb",
            Model::Gltf => "gltf",
            Model::Obj => "obj",
            Model::Stl => "stl",
        }
    }

    /// The format that the ending of a file name stands for.
    pub(super) fn of_ending(path: &Path) -> Option<Model> {
        let ending = path.extension()?;
        let mut all = [Model::Glb, Model::Gltf, Model::Obj, Model::Stl].into_iter();
        all.find(|m| ending.eq_ignore_ascii_case(m.ending()))
    }

    /// The format of an output; `.glb` for a device or a pipe, whose name has no ending.
    pub(super) fn of(path: &Path) -> Result<Model, Stop> {
        let device = || fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir());
        if let Some(model) = Model::of_ending(path) {
            return Ok(model);
        }
        if path.extension().is_none() && device() {
            return Ok(Model::Glb);
        }
        let shown = path.display();
        let folder = match path.extension() {
            None => format!("; if it is to be a folder, write `{shown}/`"),
            Some(_) => String::new(),
        };
        let message = format!("{shown}: models end in .glb, .gltf, .obj or .stl{folder}");
        Err(Stop::Usage(message))
    }

    /// All files of a model, the main one last. `path` names the main one.
    pub(super) fn files<'a>(
        self,
        scene: &'a Scene,
        images: &'a dyn Images,
        path: &Path,
        beside: bool,
    ) -> Result<Vec<OutFile<'a>>, Stop> {
        let stem = path
            .file_stem()
            .map(|s| s.to_string_lossy())
            .unwrap_or_default();
        let one = |bytes: Vec<u8>| OutFile {
            name: String::new(),
            bytes: bytes.into(),
        };
        let mut files = match self {
            Model::Glb if beside => gltf::glb_beside(scene, images, &stem),
            Model::Glb => vec![one(gltf::glb(scene, images))],
            Model::Gltf => gltf::gltf(scene, images, &stem),
            Model::Obj => obj::obj(scene, images, &stem),
            Model::Stl => vec![one(stl::stl(scene))],
        };
        if let Some(main) = files.last_mut() {
            main.name = path
                .file_name()
                .map(|n| n.to_string_lossy().into_owned())
                .unwrap_or_default();
            if self == Model::Glb && main.bytes.len() > u32::MAX as usize {
                let message = "more than 4 GiB do not fit a .glb; write a .gltf or several files";
                return Err(Stop::Io(format!("{}: {message}", path.display())));
            }
        }
        Ok(files)
    }
}

/// Puts the files of a model beside `path`.
pub(super) fn write(path: &Path, files: &[OutFile<'_>]) -> Result<(), Stop> {
    if path.as_os_str() == STDIN {
        let mut out = io::stdout().lock();
        for file in files {
            out.write_all(&file.bytes)?;
        }
        return Ok(out.flush()?);
    }
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut ready = vec![];
    for (i, file) in files.iter().enumerate() {
        // The main file keeps a name that is no UTF-8.
        let target = if i + 1 == files.len() {
            path.to_owned()
        } else {
            folder.join(&file.name)
        };
        ready.push(prepare(&target, &file.bytes).map_err(|e| Stop::at(target.display(), e))?);
    }
    for (temporary, target) in ready.into_iter().flatten() {
        let renamed = temporary.persist(&target);
        renamed.map_err(|e| Stop::at(target.display(), e.error))?;
    }
    Ok(())
}

/// A whole file under a temporary name in the folder of its target, and the target with links followed.
/// What is no file (a device, a pipe) is written at once.
fn prepare(target: &Path, bytes: &[u8]) -> io::Result<Option<(NamedTempFile, PathBuf)>> {
    let target = match fs::metadata(target) {
        Ok(known) if known.is_dir() => return Err(io::Error::other("is a folder")),
        Ok(known) if !known.is_file() => {
            fs::OpenOptions::new()
                .write(true)
                .open(target)?
                .write_all(bytes)?;
            return Ok(None);
        }
        Ok(_) => target.canonicalize()?,
        Err(_) => target.to_owned(),
    };
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    // Other folders are not made: a misspelt output should not grow a tree.
    if folder.to_string_lossy().ends_with("_textures") && !folder.exists() {
        fs::create_dir(folder)?;
    }
    if !folder.is_dir() {
        let message = format!("there is no folder {}", folder.display());
        return Err(io::Error::new(io::ErrorKind::NotFound, message));
    }
    // The temporary name, which these errors would tell, is nothing to the reader.
    let mut file = temporary(folder).map_err(|e| io::Error::from(e.kind()))?;
    file.as_file_mut().write_all(bytes)?;
    Ok(Some((file, target)))
}

/// A file that others may read, as if it had been made under its final name.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".hsd-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666)); // less the user's mask
    }
    builder.tempfile_in(folder)
}
