//! Models that are written house by house are those of the whole scene, whatever keeps them meanwhile.

use crate::support::{assert_none, details_in_turn, texts_in_turn, world_of};
use hsd::backend::gltf::{Writer, gltf};
use hsd::backend::images::Library;
use hsd::backend::spool::{NewSpool, Spool, in_memory};
use hsd::backend::{OutFile, obj, stl};
use hsd::diagnostic::Diagnostics;
use hsd::driver::{self, Options};
use hsd::scene::{Detail, ScenePart};
use hsd::source::{FileId, NoFiles, Source, World};
use std::io;

fn options(detail: Detail) -> Options {
    Options {
        detail,
        ..Options::default()
    }
}

/// The model that is written house by house, and all messages.
fn streamed(
    source: &Source,
    world: &dyn World,
    detail: Detail,
    new: NewSpool<'_>,
) -> io::Result<(Vec<u8>, String)> {
    let mut out = Diagnostics::new();
    let mut writer = Writer::new(new)?;
    let mut sink = |part: ScenePart<'_>, images: &Library| writer.add(part, images);
    let town = driver::stream(
        driver::Feed::whole(&[source]),
        world,
        &options(detail),
        &mut out,
        (&mut sink, new),
    )?;
    writer.made_from(&town.provenance);
    let glb = writer.glb(&town.materials, &town.library, &town.grown)?;
    Ok((glb.bytes(), format!("{:?}", out.into_sorted())))
}

/// The same of the whole scene.
fn whole(source: &Source, world: &dyn World, detail: Detail) -> (Vec<u8>, String) {
    let mut out = Diagnostics::new();
    let compiled = hsd::compile(&[source], world, &options(detail), &mut out);
    let glb = hsd::glb(&compiled, world, &options(detail), &mut out);
    (glb, format!("{:?}", out.into_sorted()))
}

#[test]
fn a_streamed_model_is_that_of_the_whole_scene() {
    let mut findings = vec![];
    for (index, path) in texts_in_turn("examples", 2).into_iter().enumerate() {
        let bytes = std::fs::read(&path).expect("the file can be read");
        let name = path.file_name().expect("is a file").to_string_lossy();
        let source = Source::new(FileId(0), &*name, &bytes);
        let world = world_of(&path);
        for &detail in details_in_turn(index) {
            let stream = streamed(&source, &world, detail, &in_memory).expect("memory has room");
            if stream != whole(&source, &world, detail) {
                findings.push(format!("{name} at {detail:?}"));
            }
        }
    }
    assert_none(&findings);
}

/// Small formats have one mesh in world coordinates, so their houses are handed on with meshes of their own.
#[test]
fn obj_stl_and_gltf_are_written_house_by_house() {
    let mut findings = vec![];
    for name in ["machiya.hsd", "plot.hsd", "years.hsd"] {
        let path = std::path::Path::new("examples").join(name);
        let bytes = std::fs::read(&path).expect("the file can be read");
        let source = Source::new(FileId(0), name, &bytes);
        let world = world_of(&path);
        for detail in [Detail::Body, Detail::Flat] {
            let whole = plain_files(&source, &world, detail);
            let stream = plain_streams(&source, &world, detail).expect("memory has room");
            assert_eq!(whole.len(), stream.len(), "{name} at {detail:?}");
            let pairs = whole.iter().zip(&stream);
            let other = pairs.filter(|(one, other)| one != other);
            findings.extend(other.map(|((file, _), _)| format!("{file} of {name} at {detail:?}")));
        }
    }
    assert_none(&findings);
}

/// The names of files and their bytes.
type Files = Vec<(String, Vec<u8>)>;

/// An OBJ, an STL and a glTF of the whole scene.
fn plain_files(source: &Source, world: &dyn World, detail: Detail) -> Files {
    let (mut out, options) = (Diagnostics::new(), options(detail));
    let compiled = hsd::compile(&[source], world, &options, &mut out);
    let (paths, limits) = (&compiled.scene.pictures, &options.expand.limits);
    let mut library = driver::pictures(paths, &compiled.building, world, limits, &mut out);
    library.bake(&compiled.scene.baked);
    let mut files = obj::obj(&compiled.scene, &library, "a");
    files.extend(gltf(&compiled.scene, &library, "a"));
    let own = files.into_iter().map(|f| (f.name, f.bytes.into_owned()));
    let stl = (
        "a.stl".to_owned(),
        stl::stl(&compiled.scene, stl::Print::default()),
    );
    own.chain([stl]).collect()
}

/// The same, house by house.
fn plain_streams(source: &Source, world: &dyn World, detail: Detail) -> io::Result<Files> {
    let new: NewSpool<'_> = &in_memory;
    let mut writers = (
        obj::Writer::new(new)?,
        Writer::new(new)?,
        stl::Writer::new(stl::Print::default(), new)?,
    );
    let mut sink = |part: ScenePart<'_>, images: &Library| {
        writers.0.add(part, images)?;
        writers.1.add(part, images)?;
        writers.2.add(part)
    };
    let options = Options {
        own_meshes: true,
        ..options(detail)
    };
    let sources = [source];
    let feed = driver::Feed::whole(&sources);
    let mut out = Diagnostics::new();
    let town = driver::stream(feed, world, &options, &mut out, (&mut sink, new))?;
    let (materials, images, grown) = (&town.materials, &town.library, &town.grown);
    let owned = |files: Vec<OutFile<'_>>| -> Files {
        let own = files.into_iter().map(|f| (f.name, f.bytes.into_owned()));
        own.collect()
    };
    let (text, beside) = writers.0.finish(materials, images, grown, "a");
    let mut files = owned(beside);
    files.push(poured("a.obj", |out| text.write(out))?);
    writers.1.made_from(&town.provenance);
    let made = writers.1.gltf(materials, images, grown, "a")?;
    files.extend(owned(made.images));
    let buffer = made.buffer.expect("houses have vertices");
    files.push(poured("a.bin", |out| buffer.write(out))?);
    files.push(poured("a.gltf", |out| made.json.write(out))?);
    files.push(poured("a.stl", |out| writers.2.write(out))?);
    Ok(files)
}

/// A file that says how long it is.
fn poured(
    name: &str,
    pour: impl FnOnce(&mut Vec<u8>) -> io::Result<u64>,
) -> io::Result<(String, Vec<u8>)> {
    let mut bytes = vec![];
    let length = pour(&mut bytes)?;
    assert_eq!(length, bytes.len() as u64, "{name}");
    Ok((name.to_owned(), bytes))
}

/// Unlike houses for more than two batches, some of them aged; every ninth is the twin of its neighbour.
fn town(count: usize) -> Source {
    let house = |n: usize| {
        let (width, depth) = (3 + n % 5, 3 + n / 5 % 4);
        let age = if n.is_multiple_of(50) {
            " age=\"40\""
        } else {
            ""
        };
        let (front, side) = ("TKD 2".repeat(width), "KSK  ".repeat(depth));
        let back = "GSI  ".repeat(2 * width);
        format!(
            "<House x=\"{}\" y=\"{}\"{age}><Storey height=\"{}\"><Row>{front}</Row><Row>{side}</Row>\
             <Row>{back}</Row><Row>{side}</Row></Storey></House>\n",
            n % 20 * 20,
            n / 20 * 20,
            9.0 + (n % 3) as f64 / 10.0
        )
    };
    let numbers = (0..count).map(|n| if n % 9 == 8 { n - 1 } else { n });
    let houses: String = numbers.map(house).collect();
    let text = format!("<Houses>\n{houses}</Houses>\n");
    Source::new(FileId(0), "town.hsd", text.as_bytes())
}

#[test]
fn any_number_of_threads_writes_the_same_town() {
    let town = town(300);
    for detail in [Detail::Body, Detail::Flat] {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().expect("threads start");
            let made = pool.install(|| streamed(&town, &NoFiles, detail, &in_memory));
            made.expect("memory has room")
        };
        let alone = with(1);
        for threads in [2, 7] {
            assert!(with(threads) == alone, "{threads} threads, {detail:?}");
        }
    }
}

#[test]
fn files_keep_a_model_as_memory_does() {
    let town = town(40);
    let in_files = || -> io::Result<Box<dyn Spool>> { Ok(Box::new(tempfile::tempfile()?)) };
    let made = |new: NewSpool<'_>| streamed(&town, &NoFiles, Detail::Flat, new);
    let of_files = made(&in_files).expect("the disk has room");
    assert!(of_files == made(&in_memory).expect("memory has room"));
}

/// A disk that is full after some bytes.
struct Full(io::Cursor<Vec<u8>>);

impl io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.get_ref().len() + bytes.len() > 100_000 {
            true => Err(io::ErrorKind::StorageFull.into()),
            false => self.0.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl io::Read for Full {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.read(bytes)
    }
}

impl io::Seek for Full {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

#[test]
fn a_full_disk_is_told() {
    let full = || -> io::Result<Box<dyn Spool>> { Ok(Box::new(Full(io::Cursor::default()))) };
    let made = streamed(&town(300), &NoFiles, Detail::Everything, &full);
    let error = made.expect_err("there is no room");
    assert_eq!(error.kind(), io::ErrorKind::StorageFull);
}

#[test]
fn a_house_seen_from_afar_is_one_node_with_one_mesh() {
    let source = town(9);
    let mut out = Diagnostics::new();
    let options = options(Detail::Body);
    let scene = hsd::compile(&[&source], &NoFiles, &options, &mut out).scene;
    assert_eq!(scene.nodes.len(), 9);
    assert!(scene.nodes.iter().all(|node| node.mesh.is_some()));
    // The twin of a neighbour shows its mesh.
    assert_eq!(scene.meshes.len(), 8);
    let glb = hsd::backend::gltf::glb(&scene, &hsd::backend::NoImages);
    let read = gltf::Gltf::from_slice(&glb).expect("is a model");
    for mesh in read.meshes() {
        let arrays = |p: gltf::Primitive<'_>| p.attributes().map(|(_, a)| a.index()).collect();
        let arrays: Vec<Vec<usize>> = mesh.primitives().map(arrays).collect();
        assert!(arrays.iter().all(|own| *own == arrays[0]), "{arrays:?}");
    }
}

/// A house with too many triangles is left out by itself, however the model is written.
#[test]
fn a_house_with_too_many_triangles_is_left_out() {
    let house = |name: &str, parts: usize| {
        let wall = format!("<Row><repeat num='{parts}'>KOS</repeat></Row>");
        let walls = wall.repeat(4);
        format!("<House name='{name}'><Storey>{walls}</Storey></House>")
    };
    let houses = [("a", 4), ("large", 60), ("b", 5)].map(|(name, parts)| house(name, parts));
    let text = format!("<Houses>{}</Houses>", houses.concat());
    let source = Source::new(FileId(0), "town.hsd", text.as_bytes());
    for detail in [Detail::Flat, Detail::Openings, Detail::Everything] {
        let mut asked = options(detail);
        let shown = |asked: &Options| {
            let mut out = Diagnostics::new();
            let scene = hsd::compile(&[&source], &NoFiles, asked, &mut out).scene;
            let roots = scene.nodes.iter().filter(|n| n.parent.is_none());
            let names: Vec<_> = roots.map(|n| n.name.to_string()).collect();
            let found = out.into_sorted();
            let mut again = Diagnostics::new();
            let mut sink = |_: ScenePart<'_>, _: &Library| Ok(());
            driver::stream(
                driver::Feed::whole(&[&source]),
                &NoFiles,
                asked,
                &mut again,
                (&mut sink, &in_memory),
            )
            .expect("no disk");
            assert_eq!(found, again.into_sorted(), "{detail:?}");
            let limit = found.iter().filter(|d| d.code.0 == 911);
            (names.join(", "), limit.count())
        };
        assert_eq!(shown(&asked), ("house a, house large, house b".into(), 0));
        // The large house has many times the triangles of the others.
        while shown(&asked).1 == 0 {
            asked.expand.limits.triangles /= 2;
        }
        assert_eq!(shown(&asked), ("house a, house b".into(), 1), "{detail:?}");
        asked.expand.limits.triangles = 1;
        assert_eq!(shown(&asked), (String::new(), 3), "{detail:?}");
    }
}
