//! `hsd town` to a folder: a town in tiles.

mod folder;
mod progress;

pub(super) use folder::Folder;
pub(super) use progress::Progress;

use super::streamed;
use crate::Failure;
use crate::files::messages::Teller;
use crate::files::output::{Committer, folder_of};
use crate::files::terminal::{HOUSE, bytes, counted};
use hsd_base::diagnostic::{Diagnostics, Language, Noun, Text, noun};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_export::images::Library;
use hsd_export::spool::Spool;
use hsd_export::{gltf, obj};
use hsd_ir::ast;
use hsd_town::stream::Ledger;
use hsd_town::tiles::record::{LevelRecord, TileRecord};
use hsd_town::tiles::run::{self, TileJob, TileParts, TiledTown};
use hsd_town::tiles::{TileStore, envelopes};
use hsd_town::{Plan, TownInput, TownReport};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The noun for features of maps.
pub(super) const FEATURE: Noun = noun("feature", "地物{}件");

pub(super) const TILE: Noun = noun("tile", "タイル{}枚");

/// The options of a town in tiles.
pub(super) struct Wish<'a> {
    /// The folder.
    pub(super) output: &'a Path,
    /// The levels of detail, where they are not those of the town file.
    pub(super) levels: Option<Vec<u8>>,
    /// True if the arrays of tiles are packed.
    pub(super) packed: bool,
    /// True if triangles, bytes and graphics memory are printed.
    pub(super) stats: bool,
    /// True if only diagnostics are.
    pub(super) quiet: bool,
}

/// The root of a town in tiles.
pub(super) const TILESET: &str = "tileset.json";

/// The tables that every town has.
const TABLES: [&str; 2] = ["decisions.csv", "report.json"];

/// The files of a town with envelopes of lots.
const ENVELOPES: [&str; 5] = ["obj", "mtl", "glb", "csv", "html"];

/// Returns the path of a table: in the folder of a town, or beside its model.
fn beside(output: &Path, name: &str) -> PathBuf {
    match output.is_dir() {
        true => output.join(name),
        false => output.with_extension(name),
    }
}

/// Returns the paths of the tables of every town.
pub(super) fn table_paths(output: &Path) -> [PathBuf; 2] {
    TABLES.map(|name| beside(output, name))
}

/// Fails if a model or a table of a town that was built, but not yet written, is an input.
pub(super) fn check_outputs(
    (output, ledger): (&Path, &Ledger),
    main: Option<&Path>,
    committer: &Committer,
) -> Result<(), Failure> {
    let envelopes = ENVELOPES.map(|ending| beside(output, &format!("envelopes.{ending}")));
    let envelopes = envelopes
        .into_iter()
        .filter(|_| !ledger.envelopes.is_empty());
    let main = main.into_iter().map(Path::to_owned);
    committer.check(main.chain(table_paths(output)).chain(envelopes))
}

/// Writes the table of decisions and the report into a folder, or beside a model; with them the envelopes of lots, if there are any.
pub(super) fn tables(
    output: &Path,
    ledger: &mut Ledger,
    committer: &Committer,
) -> Result<(), Failure> {
    check_outputs((output, ledger), None, committer)?;
    let beside = |name: &str| beside(output, name);
    let rows = &ledger.envelopes;
    if !rows.is_empty() {
        let (scene, path) = (envelopes::scene(rows), beside("envelopes.obj"));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let library = Library::default();
        let own = obj::obj(&scene, &library, &stem).into_iter().map(|file| {
            let target = folder_of(&path).join(&file.name);
            (target, file.bytes.into_owned())
        });
        let mut files: Vec<(PathBuf, Vec<u8>)> = own.collect();
        files.push((beside("envelopes.glb"), gltf::glb(&scene, &library)));
        files.push((beside("envelopes.csv"), envelopes::table(rows).into_bytes()));
        files.push((beside("envelopes.html"), envelopes::page(rows).into_bytes()));
        committer.write_all(files)?;
    }
    let (table, report) = (&mut ledger.decisions, &ledger.report);
    let [decisions_path, report_path] = table_paths(output);
    committer.write_poured(vec![
        (
            decisions_path,
            Box::new(|out: &mut dyn Write| table.write(out)),
        ),
        (
            report_path,
            Box::new(|out: &mut dyn Write| {
                serde_json::to_writer_pretty(out, report)?;
                Ok(0)
            }),
        ),
    ])
}

/// Returns a maker of spools in the folder of an output.
pub(super) fn spools_beside(
    output: &Path,
) -> impl Fn() -> io::Result<Box<dyn Spool>> + Send + Sync + use<> {
    let folder = streamed::spool_folder(output);
    move || streamed::spool(&folder)
}

/// Builds a town in tiles below a folder; returns whether something is missing that the author wanted, the files that were
/// read, and what was found.
pub(super) fn build(
    (wish, committer): (&Wish<'_>, &Committer),
    input: TownInput<'_>,
    (read, plan): (hsd_driver::Read, &Plan),
    mut out: Diagnostics,
    teller: Teller,
) -> Result<(bool, Vec<Source>, Diagnostics), Failure> {
    let failed = |error| Failure::at(wish.output.display(), error);
    let folder = Folder::of_town(wish.output, committer).map_err(failed)?;
    let division = ast::town::Tiles {
        detail: wish
            .levels
            .clone()
            .unwrap_or(plan.town.tiles.detail.clone()),
        ..plan.town.tiles.clone()
    };
    let parts = TileParts::of(&read, input.options);
    let spool = spools_beside(wish.output);
    let job = TileJob {
        packed: wish.packed,
        spool: plan.lodged.is_some().then_some(&spool),
        ..parts.job(input, plan, &read.catalog, &division)
    };
    let progress = Progress::new(plan.features(), wish.quiet, teller);
    let made = run::run(job, &folder, &|n| progress.advance(n), &mut out);
    progress.clear();
    let mut made = made.map_err(failed)?;
    progress.finish()?;
    finish(wish, (&mut made, plan), &folder, teller.language)?;
    Ok((made.ledger.is_incomplete(), made.included, out))
}

/// Writes the tables and the tileset of a town whose tiles are in its folder, sweeps that, and prints what was built.
pub(super) fn finish(
    wish: &Wish<'_>,
    (made, plan): (&mut TiledTown, &Plan),
    folder: &Folder,
    language: Language,
) -> Result<(), Failure> {
    let failed = |error| Failure::at(wish.output.display(), error);
    let tree = made.tileset(plan);
    tables(wish.output, &mut made.ledger, &folder.committer)?;
    // The root comes last: whoever reads it finds what it names.
    let mut branches = BTreeSet::new();
    for (name, bytes) in tree.branches {
        folder.commit(&name, &bytes.into()).map_err(failed)?;
        branches.insert(name);
    }
    folder.sync();
    let root = vec![(wish.output.join(TILESET), tree.root)];
    folder.committer.write_all(root)?;
    folder.sweep(&made.files(), &branches).map_err(failed)?;
    if !wish.quiet {
        for line in lines(wish, made) {
            writeln!(io::stderr(), "{}", line.in_language(language))?;
        }
    }
    if wish.stats {
        writeln!(io::stderr(), "{}", statistics(made).in_language(language))?;
    }
    Ok(())
}

/// Returns the number of features of a town in each state.
pub(super) fn features(report: &TownReport) -> Text {
    let (features, built) = (counted(report.features, FEATURE), report.built);
    let (skipped, unused) = (report.skipped.len(), report.unused);
    text!([features, built, skipped, unused]
        "{features}: {built} built, {skipped} skipped, {unused} unused",
        "{features}（建物 {built}、省略 {skipped}、未使用 {unused}）"
    )
}

/// Returns the line printed of the envelopes of lots; `None` if there are none.
pub(super) fn above(ledger: &Ledger) -> Option<Text> {
    let (count, above) = (ledger.envelopes.len(), ledger.report.above_envelope.len());
    (count > 0).then(|| {
        text!([count, above]
            "  {count} envelopes of lots, {above} houses above theirs",
            "  敷地のエンベロープ {count} 件、うち建物が超えるもの {above} 件"
        )
    })
}

/// Returns the lines printed after a town: what was built, and from which level its heights count.
fn lines(wish: &Wish<'_>, made: &TiledTown) -> Vec<Text> {
    let (name, report) = (wish.output.display(), &made.ledger.report);
    let features = features(report);
    let houses = counted(made.tiles.iter().map(|t| t.houses).sum(), HOUSE);
    let tiles = counted(made.tiles.len(), TILE);
    let levels = made.tiles.iter().flat_map(|t| &t.levels);
    let size = bytes(levels.map(|l| l.bytes as usize).sum());
    let kept = made.kept;
    let mut lines = vec![text!([name, features, houses, tiles, size]
        "{name}: {features}, {houses} in {tiles}, {size}",
        "{name}: {features}、{houses}、{tiles}、{size}"
    )];
    if kept > 0 {
        lines.push(text!([kept]
            "  {kept} of the tiles were there already",
            "  うち {kept} 枚は前からあったものです"
        ));
    }
    lines.extend(above(&made.ledger));
    lines.push(match made.zero {
        Some(0.0) => text!(
            "  heights: 0 is the ellipsoid of the globe, which in Japan lies some 25 to 45 m below sea level; `geoid=\"yes\"` of `Town` counts from the sea",
            "  高さ: 0 は地球楕円体の面です。日本では海面より 25〜45 m ほど低くなります。`Town` の `geoid=\"yes\"` で海面からになります"
        ),
        Some(zero) => text!([zero]
            "  heights: 0 is the sea, which stands {zero} m above the ellipsoid of the globe here (EGM96)",
            "  高さ: 0 は海面です。ここでは地球楕円体より {zero} m 高い面です(EGM96)"
        ),
        None => text!(
            "  the maps are in local metres, so the tiles stand nowhere on the globe: name a plane with `crs` to place them",
            "  地図が局所座標なので、タイルは地球上に置かれません。置くには `crs` で座標系を指定してください"
        ),
    });
    lines
}

/// Returns triangles, bytes and an estimate of graphics memory for each level of all tiles, for the busiest tile, and for the
/// view of the start, which shows the farthest level of all.
fn statistics(made: &TiledTown) -> Text {
    let details: BTreeMap<u8, Vec<(&TileRecord, &LevelRecord)>> = made
        .tiles
        .iter()
        .flat_map(|tile| tile.levels.iter().map(move |level| (tile, level)))
        .fold(BTreeMap::new(), |mut all, (tile, level)| {
            all.entry(level.detail).or_default().push((tile, level));
            all
        });
    let mut rows = vec![];
    for (detail, levels) in &details {
        rows.push(row(&format!("detail {detail}"), levels));
    }
    let all = details.values().flatten();
    if let Some(busiest) = all.max_by_key(|(_, level)| level.arrays) {
        let name = format!("{}, detail {}", busiest.0.tile, busiest.1.detail);
        rows.push(row(&name, &[*busiest]));
    }
    let rows = rows.join("\n");
    text!([rows]
        "  {rows}\n  (triangles, files, graphics memory with textures; the view of the start shows the first line at most)",
        "  {rows}\n  (三角形、ファイル、テクスチャーを含む描画メモリー。はじめの視野は最大で一行目です)"
    )
}

fn row(name: &str, levels: &[(&TileRecord, &LevelRecord)]) -> String {
    let sum = |of: fn(&LevelRecord) -> u64| levels.iter().map(|(_, l)| of(l)).sum::<u64>();
    let textures: BTreeMap<&str, u64> = levels
        .iter()
        .flat_map(|(tile, level)| level.textures.iter().map(|n| &tile.textures[*n]))
        .map(|texture| (&*texture.file, texture.graphics))
        .collect();
    let graphics = sum(|l| l.arrays) + textures.values().sum::<u64>();
    let (triangles, files) = (sum(|l| l.triangles as u64), sum(|l| l.bytes));
    let mib = |bytes: u64| bytes as f64 / f64::from(1 << 20);
    format!(
        "{name:<24} {triangles:>10} {:>9.1} MiB {:>9.1} MiB",
        mib(files),
        mib(graphics)
    )
}
