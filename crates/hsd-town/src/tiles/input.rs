//! What a tile is made from: the houses that the rules make of its features. Their hash names its files, so a tile whose
//! houses are the same is not made again, whatever else has changed in the town file.

use super::mesh::Tile;
use super::terrain::Patch;
use crate::decision::Record;
use crate::run::{self, Chunk};
use crate::{Plan, TownInput};
use glam::DVec3;
use hsd_base::source::Source;
use hsd_driver::FeatureHouse;
use hsd_export::gltf::FeatureRow;
use hsd_ir::ast::WrittenPart;
use hsd_scene::Detail;
use hsd_syntax::print::essence;
use std::io;
use twox_hash::XxHash3_128;

/// Counts up when the files of a tile change their form.
const FORM: u32 = 1;

/// A tile whose rules have been evaluated.
pub struct TileInput {
    /// The decisions on its features, without the houses.
    pub chunk: Chunk,
    /// Its houses.
    pub houses: Vec<FeatureHouse>,
    /// The row of each house in the table.
    pub row_of: Vec<u32>,
    /// The features on which houses stand.
    pub rows: Vec<FeatureRow>,
    /// The place from which its vertices count, whole metres.
    pub centre: DVec3,
    /// The hash of all that its files depend on.
    pub hash: String,
}

/// What the hashes of all tiles begin with.
#[derive(Clone)]
pub struct TileSalt(Vec<u8>);

impl TileSalt {
    /// Collects what all tiles depend on: the program, the options, the levels, whether they are packed, and custom parts, of other files and of the
    /// town's own.
    pub fn new(
        input: TownInput<'_>,
        (levels, packed): (&[Detail], bool),
        (parts, written): (&[&Source], &[WrittenPart]),
    ) -> TileSalt {
        let expand = &input.options.expand;
        let mut salt = format!(
            "{} {FORM} {levels:?} {}{:?} {:?}",
            env!("CARGO_PKG_VERSION"),
            if packed { "packed " } else { "" },
            expand.seed,
            expand.limits
        );
        for source in parts {
            salt.push_str(source.text());
        }
        let mut salt = salt.into_bytes();
        salt.extend(essence(written));
        TileSalt(salt)
    }
}

impl TileSalt {
    /// Returns its bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }

    /// Returns the hash of all that the files of a piece of ground depend on.
    pub fn piece(&self, patch: &Patch, row: &FeatureRow) -> String {
        let mut hasher = XxHash3_128::new();
        hasher.write(&self.0);
        hasher.write(format!("{:?} {row:?}", patch.centre()).as_bytes());
        hasher.write(&patch.essence());
        named_by(&hasher)
    }
}

fn named_by(hasher: &XxHash3_128) -> String {
    format!("{:016x}", hasher.finish_128() as u64)
}

/// Evaluates the rules at the features of a tile. `year` is the year of the town, if it has one.
///
/// # Errors
/// Those of the spool in which the features wait.
pub fn evaluate(
    tile: &Tile,
    (plan, town): (&Plan, TownInput<'_>),
    year: Option<&str>,
    salt: &TileSalt,
) -> io::Result<TileInput> {
    let (mut chunk, centre) = tile.with(plan, |part, lots, centre| {
        (run::evaluate(town, part, lots), centre)
    })?;
    let houses = std::mem::take(&mut chunk.houses);
    let (mut rows, mut row_of) = (vec![], vec![]);
    for record in chunk.records.iter().filter(|record| record.houses > 0) {
        row_of.extend(std::iter::repeat_n(rows.len() as u32, record.houses));
        rows.push(row(record, (plan, town.source), year));
    }
    let mut hasher = XxHash3_128::new();
    hasher.write(&salt.0);
    hasher.write(format!("{centre:?} {rows:?}").as_bytes());
    for house in &houses {
        hasher.write(house.name.as_bytes());
        hasher.write(&essence(&house.house));
        hasher.write(&essence(&house.plain));
    }
    Ok(TileInput {
        chunk,
        houses,
        row_of,
        rows,
        centre,
        hash: named_by(&hasher),
    })
}

/// Returns what the table of a tile tells of a feature.
fn row(record: &Record, (plan, source): (&Plan, &Source), year: Option<&str>) -> FeatureRow {
    let parameters = record.parameters.iter();
    let own = parameters.clone().find(|(name, _)| name == "year");
    let parameters: Vec<String> = parameters.map(|(n, v)| format!("{n}={v}")).collect();
    let span = record.span.filter(|span| span.file == source.id());
    FeatureRow {
        key: record.key.to_string(),
        layer: record.layer.to_string(),
        kind: record.kind.clone(),
        year: match own {
            Some((_, year)) => year.to_string(),
            None => year.unwrap_or_default().to_owned(),
        },
        evidence: match &plan.layers[record.id.0].layer.evidence {
            Some(map) if record.evidence.is_empty() => map.value.clone(),
            _ => record.evidence.clone(),
        },
        parameters: parameters.join(" "),
        rule: record.rule as u32,
        line: span.map_or(0, |span| source.line_column(span).0 as u32),
    }
}
