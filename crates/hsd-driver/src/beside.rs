//! Houses of several files that all stand at the origin are put side by side, in the order of the files, as seen from the
//! south (docs/contract.md 9). Files that say where their houses stand keep them there.

use super::{Options, Read};
use glam::dvec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::Heading;
use hsd_base::source::{Limits, Source, SourceCache, Spanned, World};
use hsd_ir::ast::{Document, House, Stand};
use hsd_ir::building;
use hsd_passes::expand::{Expander, HouseContext, HouseId};
use hsd_passes::lower;
use hsd_passes::messages::plan::side_by_side;
use hsd_syntax::parse::xml::Trees;
use hsd_syntax::parse::{self, Before, ReadContext};

/// Free room between the walls of neighbours, metres: eaves on both sides fit into it.
const APART: f64 = 3.0;

/// Puts the houses of all files that say nothing of their places side by side.
pub(super) fn put(
    read: &mut Read,
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) {
    let unplaced: Vec<usize> = (0..read.documents.len())
        .filter(|n| is_unplaced(&read.documents[*n]))
        .collect();
    let [_, second, ..] = unplaced[..] else {
        return;
    };
    // What is wrong with the houses is reported when they are built.
    let mut unheard = Diagnostics::new();
    let mut free: Option<f64> = None;
    for n in &unplaced {
        let mut expander = Expander::new(&read.catalog, world, &options.expand);
        let houses = read.documents[*n].houses.iter().enumerate();
        let extents = houses.filter_map(|(index, house)| {
            let context = HouseContext {
                source: sources[*n],
                scope: read.catalog.known_in(*n, index),
                variant: None,
            };
            let id = HouseId(index as u64);
            let program = expander.house(house, id, context, &mut unheard)?;
            extent(&lower::house(program, &mut unheard))
        });
        let whole = extents.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let Some([low, high]) = whole else {
            continue;
        };
        let by = free.map_or(0.0, |free| free - low);
        free = Some(high + by + APART);
        for house in &mut read.documents[*n].houses {
            house.settings.x = Some(Spanned::new(by, house.span));
        }
    }
    out.push(side_by_side(sources[second].span(0..0), unplaced.len()));
}

/// Returns true if the houses of a file, of which this is the first piece, are put beside those of other files: then all of
/// them are needed at once.
pub fn is_put_aside(piece: &Source, limits: &Limits) -> bool {
    let mut unheard = Diagnostics::new();
    let cache = SourceCache::new(0, 0, 0);
    let setting = ReadContext {
        before: Some(Before::default()),
        ..ReadContext::alone(limits, &cache)
    };
    let document = parse::parse_in(piece, setting, &mut Trees::default(), &mut unheard);
    is_unplaced(&document)
}

/// Returns true if a document says nowhere where its houses stand.
fn is_unplaced(document: &Document) -> bool {
    let unplaced = |house: &House| {
        let surveyed = house.outline.as_ref();
        let surveyed = surveyed.is_some_and(|o| matches!(o.stand, Stand::Surveyed(_)));
        let written = [&house.settings.x, &house.settings.y].into_iter().flatten();
        let at_origin = written.into_iter().all(|place| place.value == 0.0);
        at_origin && house.placement.is_none() && !surveyed
    };
    !document.houses.is_empty() && document.houses.iter().all(unplaced)
}

/// Returns how far the walls of a house reach to the west and the east, metres in the world.
fn extent(house: &building::House) -> Option<[f64; 2]> {
    let turn = Heading::new(180.0 - house.azimuth).vector();
    let rings = house.storeys.iter().flat_map(|storey| &storey.rings);
    let corners = rings.flat_map(|r| &r.walls).flat_map(|w| [w.from, w.to]);
    let east = corners.map(|p| {
        let p = turn.rotate(dvec2(-p.x, p.y) * house.unit);
        p.x + house.origin[0]
    });
    east.fold(None, |extent: Option<[f64; 2]>, x| {
        let [low, high] = extent.unwrap_or([x, x]);
        Some([low.min(x), high.max(x)])
    })
}
