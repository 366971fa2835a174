//! The outputs of a run: their formats, their contents, and the committer that writes them.

mod commit;

pub(crate) use commit::Committer;

use crate::Failure;
use clap::ValueEnum;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_export::gltf::{Glb, Gltf};
use hsd_export::{OutFile, obj, stl};
use std::borrow::Cow;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

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

/// Returns the folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
