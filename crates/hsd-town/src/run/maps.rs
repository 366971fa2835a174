//! Reads the maps and tables of a town into one frame, and joins points to outlines.

mod frame;
mod join;
mod lodge;

use super::TownInput;
use super::font::font;
use crate::layer::{
    self, Ground, KeptMaps, LeftWhy, Lots, MapFile, NoFiles, NoGround, NoOutlines, NotPlaced, Raw,
    Sieve, TownFrame, part,
};
use crate::plan::{Lodger, Lodging, Plan, has_no_streets, is_divided};
use crate::table::{NoTable, Rows};
use hsd_base::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd_base::source::{Source, Spanned, World};
use hsd_base::text;
use hsd_ir::ast::town::{Layer, Town};
use hsd_map::{Fault, Mismatch};
use hsd_syntax::messages::town as say;
use hsd_syntax::parse::fields::{FieldTest, NoTruth};
use hsd_syntax::parse::xml;
use rayon::prelude::*;
use std::io;
use std::ops::Range;
use std::sync::Arc;

/// Reads the maps and tables of a town; `None` if its layers cannot be read.
pub fn plan(input: TownInput<'_>, town: &Town, out: &mut Diagnostics) -> Option<Plan> {
    // Without spools nothing can fail.
    plan_lodged(input, town, None, out).ok().flatten()
}

/// The same; the features of a large town wait in a spool.
///
/// # Errors
/// Those of the spool.
pub fn plan_lodged(
    input: TownInput<'_>,
    town: &Town,
    lodging: Option<Lodging<'_>>,
    out: &mut Diagnostics,
) -> io::Result<Option<Plan>> {
    let (town, grounds) = apart(input, town, out);
    let town = &town;
    let most = lodging.map_or(usize::MAX, |lodging| lodging.from);
    let mut raw = vec![];
    for written in &town.layers {
        let first: Option<&Vec<Sheet>> = raw.first();
        let is_globe = first.is_some_and(|first| first.iter().all(|s| s.raw.are_degrees()));
        raw.extend(read_layer(input, written, (most, is_globe), out));
    }
    let mut tables = vec![];
    for table in &town.tables {
        match read_table(input, table) {
            Ok(rows) => tables.push(rows),
            Err(why) => out.push(say::no_table(table.src.span, &table.src.value, &why)),
        }
    }
    let first = raw.first().filter(|_| raw.len() == town.layers.len());
    let Some(frame) = first.and_then(|first| frame::frame(town, first, out)) else {
        return Ok(None);
    };
    let features = raw.iter().flatten().map(|sheet| sheet.raw.len());
    let is_large = features.sum::<usize>() > most;
    let lodging = lodging.filter(|_| is_large);
    let lodger = lodging.map(|lodging| Lodger::new(lodging.new, &town.tiles));
    let mut lodger = lodger.transpose()?;
    let layers = layers(input.world, town, (raw, &frame), lodger.as_mut(), out)?;
    let Some(mut layers) = layers else {
        return Ok(None);
    };
    let unjoined = join::join(town, &mut layers, out);
    for lots in &mut layers {
        lots.sift(&mut sieve(town, &lots.layer));
        report_left(lots, out);
    }
    let Some(ground) = ground(input, &grounds, (&frame, &layers), out) else {
        return Ok(None);
    };
    let mut plan = Plan::new(town.clone(), frame, layers, tables);
    plan.unjoined = unjoined;
    plan.ground = Arc::new(ground);
    plan.font = font(input, town, out);
    plan.laid = Arc::new(super::outdoors::laid_first(input, &plan));
    if let Some(lodger) = lodger {
        plan.lodge(lodger)?;
    }
    Ok(Some(plan))
}

/// Puts the layers of a town into its frame; `None` if one cannot be. What can pass by goes to the lodger, if there is one.
fn layers(
    world: &dyn World,
    town: &Town,
    (raw, frame): (Vec<Vec<Sheet>>, &TownFrame),
    mut lodger: Option<&mut Lodger>,
    out: &mut Diagnostics,
) -> io::Result<Option<Vec<Lots>>> {
    let mut layers = vec![];
    for (number, (raw, written)) in raw.into_iter().zip(&town.layers).enumerate() {
        let of = (frame, written);
        if let Some(lodger) = lodger
            .as_deref_mut()
            .filter(|_| passes_by(town, written, &raw))
        {
            let sieve = sieve(town, written);
            let lots = lodge::layer(world, raw, of, (lodger, number, sieve), out)?;
            if let Some(lots) = lots {
                lots.faults
                    .report(&written.name.value, Some(written.src.span), out);
                layers.push(lots);
            }
            continue;
        }
        let Some(mut lots) = placed(world, raw, of, out) else {
            continue;
        };
        if !outline(&mut lots, out) {
            continue;
        }
        if written.joins.is_empty() {
            keep(&mut lots, out);
        }
        if written.divided.is_some() {
            lots.sift(&mut Sieve::new(true));
            // What is wrong with the map is reported at the layer that is divided.
            (lots.faults, lots.unread, lots.left) = Default::default();
            lots.divide();
        }
        lots.check_all_numbers();
        lots.faults
            .report(&written.name.value, Some(written.src.span), out);
        layers.push(lots);
    }
    Ok(Some(layers).filter(|layers| layers.len() == town.layers.len()))
}

/// Returns what leaves out features of a layer.
fn sieve(town: &Town, layer: &Layer) -> Sieve {
    let name = &layer.name.value;
    let has_rules = town.rules.iter().any(|rule| rule.each.value == *name);
    let is_housed = has_rules && town.housed.contains(name);
    // Parts of divided areas do not overlap.
    Sieve::new(layer.divided.is_none() && (is_housed || is_divided(town, layer)))
}

/// Reports the features of a layer that are left out.
fn report_left(lots: &Lots, out: &mut Diagnostics) {
    let name = &lots.layer.name;
    for why in [LeftWhy::Twice, LeftWhy::Outside] {
        let keys = lots.left.iter().filter(|left| left.why == why);
        let keys: Vec<&str> = keys.map(|left| &*left.key).collect();
        match (why, keys.is_empty()) {
            (_, true) => {}
            (LeftWhy::Twice, _) => out.push(say::drawn_twice(name.span, &name.value, &keys)),
            (LeftWhy::Outside, _) => out.push(say::centre_outside(name.span, &name.value, &keys)),
        }
    }
}

/// Returns true if the features of a layer can be put into a spool one after another: nothing is joined to them, no street is made
/// of them, and no network has to keep its poles out of their walls.
fn passes_by(town: &Town, layer: &Layer, sheets: &[Sheet]) -> bool {
    let name = &layer.name.value;
    let has_rules = town.rules.iter().any(|rule| rule.each.value == *name);
    let mut joins = town.layers.iter().flat_map(|l| &l.joins);
    let is_joined = !layer.joins.is_empty() || joins.any(|join| join.layer.value == *name);
    let has_lines = sheets.iter().any(|sheet| sheet.raw.has_lines());
    // Zones are looked at before the lots in them, ponds before streams.
    let is_first = has_lines || town.zones.contains(name) || town.waters.contains(name);
    let is_made = layer.outline.is_some() || layer.divided.is_some();
    let is_alone = town.networks.is_empty() && has_no_streets(town, name);
    has_rules && !is_joined && !is_made && !is_first && is_alone
}

/// Reads the files of a layer, in their order; `None` if one of them cannot be read. If the town is known to be in degrees, wide
/// features in a file without a system are outliers and not metres.
fn read_layer(
    input: TownInput<'_>,
    written: &Layer,
    (most, is_globe): (usize, bool),
    out: &mut Diagnostics,
) -> Option<Vec<Sheet>> {
    let files = match files(input, &written.src) {
        Ok(files) => files,
        Err(none) => {
            out.push(say::no_map(none.span, &none.src, &none.why));
            return None;
        }
    };
    let count = files.len();
    let read: Vec<(MapFile, Result<Arc<Raw>, Fault>)> = files
        .into_par_iter()
        .map(|file| {
            let raw = read_map(input, &file.path, written, most);
            (file, raw)
        })
        .collect();
    let mut sheets = vec![];
    for (file, raw) in read {
        match raw {
            Ok(raw) if raw.is_nowhere() && (!is_globe || raw.has_refused()) => {
                out.push(nowhere(&file, &raw));
            }
            Ok(raw) => sheets.push(Sheet { file, raw }),
            Err(fault) => out.push(hsd_map::diagnostic(&fault, 1, file.span.into())),
        }
    }
    (sheets.len() == count).then_some(sheets)
}

/// Says that nobody knows where the features of a file lie.
fn nowhere(file: &MapFile, raw: &Raw) -> Diagnostic {
    let Some(unknown) = raw.unknown_crs() else {
        return say::no_crs(file.span, &file.src);
    };
    let mut said = hsd_map::diagnostic(unknown, 1, file.span.into());
    said.severity = Severity::Error;
    said
}

/// A file of a layer, as it has been read.
struct Sheet {
    file: MapFile,
    raw: Arc<Raw>,
}

/// Puts the files of a layer into the frame of the town, one after another.
fn placed(
    world: &dyn World,
    sheets: Vec<Sheet>,
    (frame, written): (&TownFrame, &Layer),
    out: &mut Diagnostics,
) -> Option<Lots> {
    let mut layer: Option<Lots> = None;
    let mut is_whole = true;
    for Sheet { file, raw } in sheets {
        let raw = Arc::try_unwrap(raw).unwrap_or_else(|kept| (*kept).clone());
        let (said, mut list) = ((written, file.lead.as_deref()), vec![]);
        match raw.placed(world, frame, said, &mut |lot| list.push(lot)) {
            Ok(mut lots) => {
                lots.lots = list;
                match &mut layer {
                    Some(layer) => layer.append(lots),
                    None => layer = Some(lots),
                }
            }
            Err(why) => {
                out.push(not_placed(&file, &why));
                is_whole = false;
            }
        }
    }
    layer.filter(|_| is_whole)
}

/// Says why a file cannot be put into the frame of the town.
fn not_placed(file: &MapFile, why: &NotPlaced) -> Diagnostic {
    match why {
        NotPlaced::Mismatch(why) => say::no_map(file.span, &file.src, &mismatch(why)),
        NotPlaced::Fault(fault) => hsd_map::diagnostic(fault, 1, file.span.into()),
    }
}

/// Joins the points of a layer to outlines where it says so; returns false if they cannot be.
fn outline(lots: &mut Lots, out: &mut Diagnostics) -> bool {
    let outline = lots.layer.outline.clone();
    match lots.outline() {
        Ok(()) => return true,
        Err(NoOutlines::NoPoints) => {
            if let Some(outline) = outline {
                out.push(say::no_vertices(outline.span, false));
            }
        }
        Err(NoOutlines::NoField(name, names)) => {
            let near = xml::nearest(&name.value, names.iter().map(|n| &**n));
            out.push(say::unknown_field(name.span, &name.value, near, &names));
        }
    }
    false
}

/// Returns the files that a layer names.
fn files(input: TownInput<'_>, src: &Spanned<String>) -> Result<Vec<MapFile>, NoFiles> {
    layer::files(input.world, input.source.name(), src)
}

/// Returns the town without its layers of heights, which have no features, and these layers.
fn apart(input: TownInput<'_>, town: &Town, out: &mut Diagnostics) -> (Town, Vec<Layer>) {
    let is_grid = |layer: &Layer| {
        let is_grid = |file: &MapFile| hsd_map::heights::is_grid(input.world, &file.path);
        files(input, &layer.src).is_ok_and(|files| files.iter().all(is_grid))
    };
    let mut town = town.clone();
    let layers = std::mem::take(&mut town.layers).into_iter();
    let (grounds, layers): (Vec<Layer>, Vec<Layer>) = layers.partition(is_grid);
    town.layers = layers;
    let is_ground = |name: &&Spanned<String>| grounds.iter().any(|g| g.name.value == name.value);
    let joined = town.layers.iter().flat_map(|layer| &layer.joins);
    let joined = joined.map(|join| &join.layer);
    let named = town.rules.iter().map(|rule| &rule.each);
    let named = named.chain(&town.fronts).chain(joined).filter(is_ground);
    for name in named {
        out.push(say::heights_have_no_features(name.span, &name.value));
    }
    let of_features = grounds.iter().flat_map(|ground| {
        let said = [&ground.layer, &ground.key, &ground.filter];
        let spans = said.into_iter().flatten().map(|said| said.span);
        let fields = ground.fields.iter().map(|field| field.span);
        let joins = ground.joins.iter().map(|join| join.span);
        spans
            .chain(fields)
            .chain(joins)
            .map(move |span| (span, ground))
    });
    for (span, ground) in of_features {
        out.push(say::heights_have_no_features(span, &ground.name.value));
    }
    if town.layers.is_empty()
        && let Some(ground) = grounds.first()
    {
        out.push(say::heights_alone(town.span, ground.name.span));
    }
    (town, grounds)
}

/// Reads the ground of a town whose features are there.
fn ground(
    input: TownInput<'_>,
    grounds: &[Layer],
    (frame, layers): (&TownFrame, &[Lots]),
    out: &mut Diagnostics,
) -> Option<Ground> {
    let boxes = layers.iter().flat_map(|layer| &layer.lots);
    let lodged = layers.iter().filter_map(|layer| layer.bounds);
    let bounds = boxes.map(|lot| lot.shape.bounds()).chain(lodged);
    let bounds = bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
    let bounds = bounds.unwrap_or_default();
    let (mut read, mut is_whole) = (vec![], true);
    for written in grounds {
        // A path that is not found is no grid.
        let files = files(input, &written.src).ok()?;
        let (mut remarks, mut elsewhere) = (vec![], 0);
        for file in &files {
            let from = (input.world, input.kept);
            let place = (frame, bounds);
            let found = layer::GroundLayer::read(from, &file.path, written, place, &mut remarks);
            let (span, src) = (file.span, &file.src);
            for fault in remarks.drain(..) {
                out.push(hsd_map::diagnostic(&fault, 1, span.into()));
            }
            let why = match found {
                Ok(ground) => {
                    read.push(ground);
                    continue;
                }
                Err(NoGround::Elsewhere) => {
                    elsewhere += 1;
                    continue;
                }
                Err(NoGround::Fault(fault)) => hsd_map::diagnostic(&fault, 1, span.into()),
                Err(NoGround::NoCrs) => say::no_crs(span, src),
                Err(NoGround::Mismatch(why)) => say::no_map(span, src, &mismatch(&why)),
            };
            out.push(why);
            is_whole = false;
        }
        // Sheets of a region reach beyond a town; one at least lies in it.
        if elsewhere == files.len() {
            out.push(say::no_ground_here(written.src.span, &written.src.value));
            is_whole = false;
        }
    }
    is_whole.then(|| Ground::new(read))
}

/// Reads a map, unless it is kept.
fn read_map(
    input: TownInput<'_>,
    path: &str,
    written: &Layer,
    most: usize,
) -> Result<Arc<Raw>, Fault> {
    let world = input.world;
    let Some(kept) = input.kept else {
        return layer::read(world, path, written, most).map(Arc::new);
    };
    let key = KeptMaps::key(path, written);
    if let Some(raw) = kept.find(&key, world) {
        return Ok(raw);
    }
    // Taken first, so that a map that changes meanwhile is read again.
    let stamp = world.stamp(path);
    let raw = Arc::new(layer::read(world, path, written, usize::MAX)?);
    kept.keep(key, stamp, &raw);
    Ok(raw)
}

/// Leaves out the features that do not pass the `where` of their layer.
fn keep(lots: &mut Lots, out: &mut Diagnostics) {
    let Some(written) = lots.layer.filter.clone() else {
        return;
    };
    let kept = FieldTest::read(&written.value).and_then(|test| lots.keep(&test));
    match kept {
        Ok(before) if before > 0 && lots.lots.is_empty() => {
            out.push(say::nothing_passes(written.span, before));
        }
        Ok(_) => {}
        Err(why) => out.push(no_truth(&written, &why, lots)),
    }
}

/// Says why the `where` of a layer tells nothing.
fn no_truth(written: &Spanned<String>, why: &NoTruth, lots: &Lots) -> Diagnostic {
    let at = |range: &Range<usize>| part(written.span, &written.value, range.clone());
    match why {
        NoTruth::Wanted(range, wanted) => say::no_test(at(range), *wanted),
        NoTruth::Unknown(range, name) => {
            let names = lots.names();
            let near = xml::nearest(name, names.iter().map(|n| &**n));
            say::unknown_field(at(range), name, near, &names)
        }
    }
}

/// Returns why the coordinates of a map cannot be those of the town.
fn mismatch(why: &Mismatch) -> hsd_base::diagnostic::Text {
    match why {
        Mismatch::Datum => text!(
            "its datum is another one, and no grid to convert it is at hand",
            "測地系が違い、変換のための格子がありません"
        ),
        Mismatch::Local => text!(
            "it is in metres of a local survey, and the town is not, or the reverse: write `crs` in the layer or in the town",
            "地図と町の片方だけが局所座標です。レイヤーか町に `crs` を書いてください"
        ),
        Mismatch::Unusable => text!("its reference system cannot be used", "座標系を使えません"),
    }
}

fn read_table(
    input: TownInput<'_>,
    table: &hsd_ir::ast::town::Table,
) -> Result<Rows, hsd_base::diagnostic::Text> {
    let path = super::path(input, &table.src)?;
    let most = input.options.expand.limits.bytes;
    let bytes = input
        .world
        .text_bytes(&path, most)
        .map_err(|e| e.to_string())?;
    let read = Source::new(input.source.id(), &path, &bytes);
    Rows::read(&table.name.value, &table.key.value, read.text()).map_err(|why| match why {
        NoTable::Empty => text!("it has no rows", "行がありません"),
        NoTable::NoKey => {
            let key = &table.key.value;
            text!([key] "it has no column `{key}`", "`{key}` の列がありません")
        }
        NoTable::Uneven(line) => text!([line]
            "line {line} has another number of cells than the first",
            "{line} 行目の列の数が最初の行と違います"
        ),
    })
}
