//! Writes outputs atomically: all files under temporary names first, then renamed.

use crate::Failure;
use crate::files::input::STDIN;
use crate::files::reason;
use crate::files::temporary::Temporary;
use clap::ValueEnum;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_export::gltf::{Glb, Gltf};
use hsd_export::{OutFile, obj, stl};
use std::borrow::Cow;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Model formats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// Binary glTF, everything in one file.
    #[default]
    Glb,
    /// glTF as JSON, with buffer and textures in separate files.
    Gltf,
    /// OBJ, with MTL and textures in separate files.
    Obj,
    /// STL for 3D printing, in millimetres.
    Stl,
}

impl Model {
    pub(crate) fn extension(self) -> &'static str {
        match self {
            Model::Glb => "glb",
            Model::Gltf => "gltf",
            Model::Obj => "obj",
            Model::Stl => "stl",
        }
    }

    /// Returns the format for the extension of a path.
    pub(crate) fn of_extension(path: &Path) -> Option<Model> {
        let extension = path.extension()?;
        let mut all = [Model::Glb, Model::Gltf, Model::Obj, Model::Stl].into_iter();
        all.find(|m| extension.eq_ignore_ascii_case(m.extension()))
    }

    /// Returns the format of an output; `.glb` for a device or a pipe without an extension.
    pub(crate) fn of(path: &Path) -> Result<Model, Failure> {
        let device = || fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir());
        if let Some(model) = Model::of_extension(path) {
            return Ok(model);
        }
        if path.extension().is_none() && device() {
            return Ok(Model::Glb);
        }
        let shown = path.display();
        let folder = match path.extension() {
            None => text!([shown]
                "; for a folder, write `{shown}/`",
                "。フォルダーの場合は `{shown}/` と書いてください"
            ),
            Some(_) => Text::default(),
        };
        Err(Failure::Usage(text!([shown, folder]
            "{shown}: the extension of a model must be .glb, .gltf, .obj or .stl{folder}",
            "{shown}: モデルの拡張子は .glb、.gltf、.obj、.stl のどれかです{folder}"
        )))
    }
}

/// The files of a model.
pub(crate) struct Files<'a> {
    main: Content<'a>,
    /// The files the main one refers to, by their paths below its folder.
    beside: Vec<(String, Content<'a>)>,
}

impl<'a> Files<'a> {
    fn one(main: Content<'a>) -> Files<'a> {
        Files {
            main,
            beside: vec![],
        }
    }

    /// A self-contained binary glTF.
    pub(crate) fn glb(glb: Glb<'a>) -> Files<'a> {
        Files::one(Content::Glb(Box::new(glb)))
    }

    /// A binary glTF and the textures it refers to.
    pub(crate) fn glb_beside(glb: Glb<'a>, beside: Vec<OutFile<'a>>) -> Files<'a> {
        Files {
            main: Content::Glb(Box::new(glb)),
            beside: ready(beside),
        }
    }

    /// A glTF in several files.
    pub(crate) fn gltf(gltf: Gltf<'a>) -> Files<'a> {
        let mut beside = ready(gltf.images);
        beside.extend(gltf.buffer.map(|buffer| {
            let name = buffer.name.clone();
            (name, Content::Poured(Box::new(|out| buffer.write(out))))
        }));
        Files {
            main: Content::Poured(Box::new(|out| gltf.json.write(out))),
            beside,
        }
    }

    /// An OBJ and the files it refers to.
    pub(crate) fn obj((text, beside): (obj::Text, Vec<OutFile<'a>>)) -> Files<'a> {
        Files {
            main: Content::Poured(Box::new(|out| text.write(out))),
            beside: ready(beside),
        }
    }

    /// An STL.
    pub(crate) fn stl(model: stl::Writer) -> Files<'a> {
        Files::one(Content::Poured(Box::new(|out| model.write(out))))
    }

    /// The bytes of a model by kind, as far as they are known before it is written.
    pub(crate) fn sizes(&self) -> Vec<(&'static str, u64)> {
        match &self.main {
            Content::Glb(glb) => glb.sizes(),
            Content::Bytes(_) | Content::Poured(_) => vec![],
        }
    }

    /// A single file with these contents.
    pub(crate) fn bytes(bytes: Vec<u8>) -> Files<'a> {
        Files::one(Content::Bytes(bytes.into()))
    }
}

/// Returns files whose bytes are all there.
fn ready(files: Vec<OutFile<'_>>) -> Vec<(String, Content<'_>)> {
    let ready = files.into_iter();
    ready.map(|f| (f.name, Content::Bytes(f.bytes))).collect()
}

/// The contents of a file.
enum Content<'a> {
    Bytes(Cow<'a, [u8]>),
    /// Serialized while writing, because the file of a town is larger than its scene.
    Glb(Box<Glb<'a>>),
    /// Written from start to end.
    Poured(Box<Pour<'a>>),
}

/// Writes a file; returns the number of bytes.
pub(crate) type Pour<'a> = dyn FnOnce(&mut dyn Write) -> io::Result<u64> + 'a;

impl Content<'_> {
    /// Writes to a seekable file; returns the number of bytes.
    fn write_file(self, file: &mut fs::File) -> io::Result<u64> {
        match self {
            Content::Bytes(bytes) => file.write_all(&bytes).map(|()| bytes.len() as u64),
            Content::Glb(glb) => glb.write(file),
            Content::Poured(pour) => poured(pour, file),
        }
    }

    /// Writes to a stream; returns the number of bytes.
    fn write_stream(self, out: &mut impl Write) -> io::Result<u64> {
        match self {
            Content::Bytes(bytes) => out.write_all(&bytes).map(|()| bytes.len() as u64),
            Content::Glb(glb) => {
                let mut made = io::Cursor::new(vec![]);
                let length = glb.write(&mut made)?;
                out.write_all(made.get_ref()).map(|()| length)
            }
            Content::Poured(pour) => poured(pour, out),
        }
    }
}

/// Writes in blocks.
fn poured(
    pour: impl FnOnce(&mut dyn Write) -> io::Result<u64>,
    out: impl Write,
) -> io::Result<u64> {
    let mut out = BufWriter::new(out);
    let length = pour(&mut out)?;
    out.flush().map(|()| length)
}

/// Writes files that are complete already, all or none of them.
pub(crate) fn write_all(files: Vec<(PathBuf, Vec<u8>)>) -> Result<(), Failure> {
    let files = files.into_iter();
    write_contents(files.map(|(path, bytes)| (path, Content::Bytes(bytes.into())))).map(drop)
}

/// Writes files that are written from start to end, all or none of them.
pub(crate) fn write_poured(files: Vec<(PathBuf, Box<Pour<'_>>)>) -> Result<(), Failure> {
    let files = files.into_iter();
    write_contents(files.map(|(path, pour)| (path, Content::Poured(pour)))).map(drop)
}

/// Writes the files of a model at and beside `path`; returns their total size in bytes. None of the files beside it
/// may replace one of `sources`, the files that the model is made from.
pub(crate) fn write_model(
    path: &Path,
    files: Files<'_>,
    sources: &[PathBuf],
) -> Result<u64, Failure> {
    let real = |p: &Path| p.canonicalize().ok();
    let sources: Vec<PathBuf> = sources.iter().filter_map(|p| real(p)).collect();
    for (name, _) in &files.beside {
        let target = folder_of(path).join(name);
        if real(&target).is_some_and(|target| sources.contains(&target)) {
            let shown = target.display();
            return Err(Failure::Usage(text!([shown]
                "{shown} is an input and would be overwritten by a file beside the model; choose another name with -o",
                "{shown} は入力ファイルですが、モデルに添えるファイルで上書きされてしまいます。-o で別の名前を指定してください"
            )));
        }
    }
    write(path, files)
}

/// Writes the files of a model at and beside `path`; returns their total size in bytes.
pub(crate) fn write(path: &Path, files: Files<'_>) -> Result<u64, Failure> {
    if path.as_os_str() == STDIN {
        let mut out = io::stdout().lock();
        let length = files.main.write_stream(&mut out)?;
        out.flush()?;
        return Ok(length);
    }
    let folder = folder_of(path);
    let beside = files.beside.into_iter();
    let beside = beside.map(|(name, content)| (folder.join(name), content));
    // Keeps the exact path of the main file, which may not be UTF-8.
    let main = (path.to_owned(), files.main);
    write_contents(beside.chain([main]))
}

/// Writes all files under temporary names, then renames them; returns their total size in bytes.
fn write_contents<'a>(files: impl Iterator<Item = (PathBuf, Content<'a>)>) -> Result<u64, Failure> {
    let (mut ready, mut length) = (vec![], 0);
    for (target, content) in files {
        let prepared = prepare(&target, content);
        let (bytes, file) = prepared.map_err(|e| Failure::at(target.display(), e))?;
        length += bytes;
        ready.extend(file);
    }
    for (temporary, target) in ready {
        let renamed = temporary.persist(&target);
        renamed.map_err(|e| Failure::at(target.display(), e))?;
    }
    Ok(length)
}

/// Returns the folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Fails if there is no such folder.
fn there(folder: &Path) -> io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    let shown = folder.display();
    let why = text!([shown] "no such folder: {shown}", "フォルダー {shown} がありません");
    Err(reason::error(io::ErrorKind::NotFound, why))
}

/// Creates a temporary file in a folder, which must be there.
pub(crate) fn temporary_in(folder: &Path) -> io::Result<Temporary> {
    there(folder)?;
    // Drops the temporary path from the error message.
    Temporary::new_in(folder).map_err(|e| io::Error::from(e.kind()))
}

/// Writes a temporary file in the folder of the target; returns the number of bytes, the file and the target with
/// links resolved. Devices and pipes are written directly.
fn prepare(target: &Path, content: Content<'_>) -> io::Result<(u64, Option<(Temporary, PathBuf)>)> {
    let mut rights = None;
    let target = match fs::metadata(target) {
        Ok(known) if known.is_dir() => {
            let why = text!("is a folder", "フォルダーです");
            return Err(reason::error(io::ErrorKind::Other, why));
        }
        Ok(known) if !known.is_file() => {
            let mut device = fs::OpenOptions::new().write(true).open(target)?;
            return Ok((content.write_stream(&mut device)?, None));
        }
        Ok(known) => {
            rights = Some(known.permissions());
            target.canonicalize()?
        }
        Err(_) => target.to_owned(),
    };
    let folder = folder_of(&target);
    let of_textures = folder.to_string_lossy().ends_with("_textures") && !folder.exists();
    let asked = if of_textures {
        folder_of(folder)
    } else {
        folder
    };
    there(asked)?;
    // Other folders are not created, so that a misspelt path fails.
    if of_textures {
        fs::create_dir(folder)?;
    }
    let mut file = temporary_in(folder)?;
    let length = content.write_file(file.as_file_mut())?;
    // Keeps the permissions of an existing file.
    if let Some(rights) = rights {
        file.as_file_mut().set_permissions(rights)?;
    }
    Ok((length, Some((file, target))))
}
