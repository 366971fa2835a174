//! What several test files share: the whole chain on a text, the rules every result keeps, a small source of
//! numbers that look random.
#![allow(dead_code, unreachable_pub)] // each test file uses its own share

use hsd::Options;
use hsd::building::{Building, Solid};
use hsd::catalog::Catalog;
use hsd::check::solid_flaws;
use hsd::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd::scene::{Detail, Kind, Mesh, Scene};
use hsd::source::{FileId, IncludeError, NoFiles, PictureFile, Source, Span, World};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub use hsd_testing::{OPTIMISED, Words, assert_none, cpu, root, sampled};

pub mod coplanar;
pub mod crossings;
pub mod depths;
pub mod maps;
pub mod shapes;
pub mod view;

/// Everything the chain makes of one file.
pub struct Run {
    pub source: Source,
    pub included: Vec<Source>,
    pub diagnostics: Vec<Diagnostic>,
    pub catalog: Cow<'static, Catalog>,
    pub building: Building,
    pub scene: Scene,
}

impl Run {
    pub fn has_errors(&self) -> bool {
        self.diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
    }

    /// The diagnostics as a reader in a terminal would have them in short form.
    pub fn short(&self) -> String {
        self.diagnostics.iter().map(|d| short(d, self)).collect()
    }

    /// The file of a span.
    pub fn file(&self, span: Span) -> &Source {
        let mut all = std::iter::once(&self.source).chain(&self.included);
        all.find(|s| s.id() == span.file)
            .expect("the file is there")
    }
}

/// `4:1: error HSD0401: message` and its help and labels below it.
fn short(d: &Diagnostic, run: &Run) -> String {
    let place = |span: Span| {
        let source = run.file(span);
        let (line, column) = source.line_column(span);
        let other = source.id() != run.source.id();
        let name = if other { source.name() } else { "" };
        format!("{name}{}{line}:{column}", if other { ":" } else { "" })
    };
    let severity = match d.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let mut text = format!(
        "{}: {severity} {}: {}\n",
        place(d.span().unwrap()),
        d.code,
        d.message.en()
    );
    text += &format!(
        "  marked: {:?}\n",
        &run.file(d.span().unwrap()).text()
            [run.file(d.span().unwrap()).text_range(d.span().unwrap())]
    );
    text += &format!("  help: {}\n", d.help.en());
    for label in &d.labels {
        text += &format!("  {}: {}\n", place(label.span), label.message.en());
    }
    text
}

/// Part pictures in the folder `textures` of a folder, and texts below it; some of these as they would be after a
/// change, by name.
struct Folder(PathBuf, BTreeMap<String, Vec<u8>>);

impl World for Folder {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        let path = ["png", "jpg"]
            .iter()
            .map(|ending| self.0.join(format!("textures/{name}.{ending}")))
            .find(|path| path.is_file())?;
        let size = image::image_dimensions(&path).ok()?;
        let path = path.to_string_lossy().into_owned();
        Some(PictureFile { path, size })
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        std::fs::read(path)
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, IncludeError> {
        let path = self.0.join(self.text(from, href)?);
        let size = image::image_dimensions(&path).map_err(|_| IncludeError::Missing)?;
        let path = path.to_string_lossy().into_owned();
        Ok(PictureFile { path, size })
    }

    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        if href.contains("..") {
            return Err(IncludeError::Outside);
        }
        let path = Path::new(from).with_file_name(href);
        let there = self.0.join(&path).is_file();
        let name = path.to_string_lossy().into_owned();
        there.then_some(name).ok_or(IncludeError::Missing)
    }

    fn text_bytes(&self, path: &str, _: usize) -> std::io::Result<Vec<u8>> {
        let changed = self.1.get(path).cloned();
        changed.map_or_else(|| std::fs::read(self.0.join(path)), Ok)
    }
}

/// The chain on bytes, without any pictures.
pub fn compile(name: &str, bytes: &[u8]) -> Run {
    compile_in(&NoFiles, name, bytes)
}

/// The chain on a file of the repository, with the pictures beside it.
pub fn compile_file(path: &Path) -> Run {
    compile_changed(path, BTreeMap::new())
}

/// The same with other bytes in some files: it, or those that it includes, by their names.
pub fn compile_changed(path: &Path, changed: BTreeMap<String, Vec<u8>>) -> Run {
    let name = path.file_name().expect("is a file").to_string_lossy();
    let bytes = changed.get(&*name).cloned();
    let bytes = bytes.unwrap_or_else(|| std::fs::read(path).expect("the file can be read"));
    let folder = path.parent().expect("is in a folder").to_owned();
    compile_in(&Folder(folder, changed), &name, &bytes)
}

fn compile_in(world: &dyn World, name: &str, bytes: &[u8]) -> Run {
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), name, bytes);
    let made = hsd::compile(&[&source], world, &Options::default(), &mut out);
    Run {
        source,
        included: made.included,
        diagnostics: out.into_sorted(),
        catalog: made.catalog,
        building: made.building,
        scene: made.scene,
    }
}

/// The pictures and texts beside a file of the repository.
pub fn world_of(path: &Path) -> impl World {
    let folder = path.parent().expect("is in a folder").to_owned();
    Folder(folder, BTreeMap::new())
}

/// The `.hsd` files of a folder of the repository, by name.
pub fn texts(folder: &str) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(root().join(folder))
        .expect("the folder is there")
        .map(|entry| entry.expect("can be listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "hsd"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{folder} holds no .hsd file");
    files
}

/// The examples with most triangles, three quarters of all, in the turns in which tests see them.
const GREAT: [&[&str]; 3] = [
    &["mino-kokubunji"],
    &["pagoda", "suzakumon"],
    &["ninomaru", "precinct", "street"],
];

/// Returns true if tests check everything, which they do before a release (`HSD_THOROUGH`), instead of samples.
pub fn thorough() -> bool {
    std::env::var_os("HSD_THOROUGH").is_some()
}

/// Number of inputs of a test that could look at `all`: if [`thorough`] all, else an eighth.
pub fn part_of(all: usize) -> usize {
    if thorough() { all } else { all.div_ceil(8) }
}

/// Details for the model number `index` of a test that looks long at many models: all if [`thorough`], else one in turn.
pub fn details_in_turn(index: usize) -> &'static [Detail] {
    match thorough() {
        true => &Detail::ALL,
        false => &Detail::ALL[index % Detail::ALL.len()..][..1],
    }
}

/// The `.hsd` files of a folder for a test that looks long at each: all if [`thorough`], else of the great examples those of one
/// turn. Those of the first are in the tests that take all, and in [`texts`].
pub fn texts_in_turn(folder: &str, turn: usize) -> Vec<PathBuf> {
    let mut files = texts(folder);
    if !thorough() {
        let others = GREAT.iter().enumerate().filter(|(k, _)| *k != turn);
        let left_out: Vec<&str> = others
            .flat_map(|(_, names)| names.iter().copied())
            .collect();
        files.retain(|path| !left_out.contains(&&*stem(path)));
    }
    files
}

/// A grey picture as a PNG file.
pub fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(vec![]);
    image::GrayImage::new(width, height)
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("memory can be written");
    bytes.into_inner()
}

/// A file's name without its ending.
pub fn stem(path: &Path) -> String {
    let stem = path.file_stem().expect("is a file");
    stem.to_string_lossy().into_owned()
}

/// Compares a text with the file that holds what it should be; with `HSD_UPDATE=1` writes it instead.
pub fn expect(path: &Path, found: &str, differing: &mut Vec<String>) {
    if std::env::var_os("HSD_UPDATE").is_some() {
        std::fs::create_dir_all(path.parent().expect("is in a folder")).expect("can be made");
        std::fs::write(path, found).expect("can be written");
        return;
    }
    let wanted = std::fs::read_to_string(path).unwrap_or_default();
    if wanted != found {
        let name = path.strip_prefix(root()).unwrap_or(path).display();
        differing.push(format!(
            "{name} (HSD_UPDATE=1 writes it)\n{}",
            first_difference(&wanted, found)
        ));
    }
}

fn first_difference(wanted: &str, found: &str) -> String {
    let (mut left, mut right) = (wanted.lines(), found.lines());
    for number in 1.. {
        let (l, r) = (left.next(), right.next());
        if l != r {
            let line = |l: Option<&str>| l.unwrap_or("(end)").to_owned();
            return format!(
                "  line {number}\n  - {}\n  + {}\n  all that was found:\n{found}",
                line(l),
                line(r)
            );
        }
        if l.is_none() {
            break;
        }
    }
    "  only line ends differ".into()
}

/// What is wrong with the places of diagnostics: outside of the file, not a character's border, no help.
pub fn flaws_of_diagnostics(run: &Run, bytes: usize) -> Vec<String> {
    let mut flaws = vec![];
    for d in &run.diagnostics {
        let spans = std::iter::once(d.span().unwrap()).chain(d.labels.iter().map(|l| l.span));
        for span in spans {
            let other = span.file != run.source.id();
            let bytes = if other { run.file(span).size() } else { bytes };
            if span.start > span.end || span.end as usize > bytes {
                flaws.push(format!("{}: {span:?} is outside of {bytes} bytes", d.code));
            }
        }
        if d.help.en().trim().is_empty() {
            flaws.push(format!("{}: says no mend", d.code));
        }
        if d.message.en().trim().is_empty() || d.message.en().ends_with('.') {
            flaws.push(format!("{}: message {:?}", d.code, d.message.en()));
        }
    }
    flaws
}

/// Cubic metres of a closed solid.
pub fn volume(solid: &Solid) -> f64 {
    let p = |c: u32| solid.points[c as usize];
    solid
        .faces
        .iter()
        .flat_map(|f| f.corners.windows(2).skip(1).map(move |w| (f.corners[0], w)))
        .map(|(first, w)| p(first).dot(p(w[0]).cross(p(w[1]))) / 6.0)
        .sum()
}

/// The corners of each triangle of a mesh; `None` where an index points nowhere.
fn triangles(mesh: &Mesh) -> Option<Vec<[[f32; 3]; 3]>> {
    let mut all = vec![];
    for p in &mesh.primitives {
        for t in p.indices.chunks(3) {
            let corner = |k: usize| p.positions.get(*t.get(k)? as usize).copied();
            all.push([corner(0)?, corner(1)?, corner(2)?]);
        }
    }
    Some(all)
}

fn double_area(t: &[[f32; 3]; 3]) -> f64 {
    let v = t.map(|p| glam::DVec3::from_array(p.map(f64::from)));
    (v[1] - v[0]).cross(v[2] - v[0]).length()
}

/// What is wrong with one mesh.
pub fn flaws_of_mesh(mesh: &Mesh) -> Vec<String> {
    let mut flaws = vec![];
    for p in &mesh.primitives {
        let n = p.positions.len();
        if p.normals.len() != n || p.uvs.len() != n {
            flaws.push("arrays of different length".into());
        }
        let all = p.positions.iter().chain(&p.normals).flatten();
        if !all.chain(p.uvs.iter().flatten()).all(|x| x.is_finite()) {
            flaws.push("a number is not finite".into());
        }
        let unit = |v: &[f32; 3]| (v.iter().map(|x| x * x).sum::<f32>().sqrt() - 1.0).abs() < 1e-3;
        if !p.normals.iter().all(unit) {
            flaws.push("a normal is not of unit length".into());
        }
        if p.indices.is_empty() || p.indices.len() % 3 != 0 {
            flaws.push(format!("{} indices", p.indices.len()));
        }
    }
    match triangles(mesh) {
        None => flaws.push("an index points nowhere".into()),
        Some(all) => {
            let slivers = all.iter().filter(|t| double_area(t) < 1e-9).count();
            if slivers > 0 {
                flaws.push(format!("{slivers} triangles without area"));
            }
        }
    }
    flaws
}

/// Whether a mesh is closed when corners at the same place count as one: each way along an edge as often as
/// the other.
pub fn open_edges(mesh: &Mesh) -> usize {
    let place = |p: [f32; 3]| p.map(|x| (x + 0.0).to_bits()); // + 0.0: no negative zero
    let mut edges: BTreeMap<_, i32> = BTreeMap::new();
    for t in triangles(mesh).unwrap_or_default() {
        for k in 0..3 {
            let (from, to) = (place(t[k]), place(t[(k + 1) % 3]));
            let step = if from < to { 1 } else { -1 };
            *edges.entry((from.min(to), from.max(to))).or_default() += step;
        }
    }
    edges.values().filter(|&&n| n != 0).count()
}

/// Everything that is wrong with the results of a run.
pub fn flaws(run: &Run) -> Vec<String> {
    let mut flaws = vec![];
    for (house, built) in run.building.houses.iter().enumerate() {
        for (index, roof) in built.roofs.roofs.iter().enumerate() {
            for solid in &roof.solids {
                for flaw in solid_flaws(solid) {
                    let shape = roof.shape.letters();
                    flaws.push(format!("house {house}, roof {index} ({shape}): {flaw:?}"));
                }
            }
        }
    }
    for (house, built) in run.building.houses.iter().enumerate() {
        for solid in built.roofs.soffits.iter().flat_map(|s| &s.solids) {
            let found = solid_flaws(solid).map(|flaw| format!("house {house}, soffit: {flaw:?}"));
            flaws.extend(found);
        }
    }
    for mesh in &run.scene.meshes {
        for flaw in flaws_of_mesh(mesh) {
            flaws.push(format!("mesh {}: {flaw}", mesh.name));
        }
    }
    for node in run.scene.nodes.iter().filter(|n| n.kind == Kind::Roof) {
        let Some(mesh) = node.mesh else { continue };
        let open = open_edges(&run.scene.meshes[mesh.0 as usize]);
        if open > 0 {
            flaws.push(format!("roof node {}: {open} open edges", node.name));
        }
    }
    flaws
}

/// Numbers that look random, the same on every machine (SplitMix64).
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Less than `bound`, which is not 0.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    pub fn of<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }
}

/// A number of the environment, for longer runs by hand.
pub fn number(name: &str, otherwise: usize) -> usize {
    let given = std::env::var(name).ok().and_then(|n| n.parse().ok());
    given.unwrap_or(otherwise)
}

/// Calls `work` for 0, 1, ... `count - 1` on all processors and joins what it finds, in that order.
pub fn on_all_processors(count: usize, work: impl Fn(usize) -> Vec<String> + Sync) -> Vec<String> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let next = std::sync::atomic::AtomicUsize::new(0);
    let mut found: Vec<(usize, Vec<String>)> = std::thread::scope(|scope| {
        let spawn = |_| {
            scope.spawn(|| {
                let mut own = vec![];
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    if index >= count {
                        return own;
                    }
                    own.push((index, work(index)));
                }
            })
        };
        let threads: Vec<_> = (0..workers).map(spawn).collect();
        let joined = threads.into_iter().map(|t| t.join());
        joined.flat_map(|own| own.expect("no panic")).collect()
    });
    found.sort_by_key(|(index, _)| *index);
    found.into_iter().flat_map(|(_, list)| list).collect()
}
