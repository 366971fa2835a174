//! Puts the town together of the tiles that were made of planned work.

use super::{PlannedTile, Worker};
use crate::tiles::run::{TiledTown, zero};
use hsd_base::diagnostic::Diagnostics;
use hsd_export::spool::NewSpool;
use std::io;

/// Returns the town of all its tiles; `Err` names those that are not there, unless `lacking` allows that.
///
/// # Errors
/// Those of the spool in which the table waits.
pub fn seal(
    worker: &Worker<'_>,
    (lacking, spool): (bool, NewSpool<'_>),
    out: &mut Diagnostics,
) -> io::Result<Result<TiledTown, Vec<String>>> {
    let all = &worker.manifest.tiles;
    if !lacking {
        let unmade = all.iter().filter(|tile| worker.made(tile).is_none());
        let unmade: Vec<String> = unmade.map(|tile| tile.key.clone()).collect();
        if !unmade.is_empty() {
            return Ok(Err(unmade));
        }
    }
    let mut town = TiledTown::new(Some(spool))?;
    for tile in all {
        let Some(done) = worker.made(tile).or_else(|| worker.unmade(tile)) else {
            return Err(damaged(tile));
        };
        town.take(done, out)?;
    }
    let plan = worker.town();
    let closing = worker.manifest.closing.clone();
    let (ledger, _) = town.ledger.close(plan, closing, out)?;
    let included = match out.is_empty() {
        true => vec![],
        false => worker.included(),
    };
    Ok(Ok(TiledTown {
        ledger,
        included,
        zero: zero(plan),
        tiles: town.tiles,
        kept: 0,
    }))
}

fn damaged(tile: &PlannedTile) -> io::Error {
    let why = format!("{}: not what was planned", tile.part());
    io::Error::new(io::ErrorKind::InvalidData, why)
}
