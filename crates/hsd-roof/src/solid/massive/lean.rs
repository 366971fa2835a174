//! The same solids with as few faces as possible, for the least detail: slopes, soffits and gables are not cut where
//! nothing is to be seen.
//!
//! Each slope is one slab over its whole outline with a filling under the part of it that lies over the attic
//! (`pieces`). Slabs and fillings share the corners of one plan (`plan`), their surfaces are added up there, and the
//! faces that remain in one plane become one, which need not be convex (`faces`).
//!
//! Plain roofs on one plate need none of this: their solid comes from slopes that nothing has divided yet (`slopes`), those
//! of a wing together (`wings`), and is theirs from the start. A roof that meets no other has a closed form (`lone`). Pieces
//! that share space are cut first (`settled`). Everything else goes the general way.

mod areas;
mod corners;
mod faces;
mod heights;
mod hidden;
mod lone;
mod pieces;
mod plan;
mod settled;
mod slopes;
mod stretches;
mod wings;

use crate::solid::massive::closed;
use crate::solid::massive::lean::pieces::Piece;
use crate::solid::massive::merge::Polygon;
use glam::{DVec2, DVec3};
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{Finish, Roof, Solid};
use hsd_ir::check;

pub(crate) use slopes::united;
pub(crate) use wings::{Plate, Slope, Wing};

/// Roofs whose bounds are farther apart do not touch, metres.
const APART: f64 = 1e-3;

/// The maximum number of rounds of splitting edges that cross at different heights.
const ROUNDS: usize = 4;

/// Returns the solids of one of the groups of roofs without timber under them; none if it has no attic.
pub fn lean(roofs: &[Roof]) -> Option<Vec<Solid>> {
    roofs.iter().find(|r| r.attic.filled)?;
    let mut solids = vec![];
    for part in apart(roofs) {
        solids.extend(made(&part).into_iter().filter(is_seen));
    }
    Some(solids)
}

/// Returns the solid of a simple roof in closed form; none of others.
pub(super) fn alone(roof: &Roof) -> Option<Solid> {
    lone::lone(&pieces::pieces(&[roof])).filter(is_sound)
}

/// Returns the solids of some roofs: of a simple one in closed form, of others from their common plan.
fn made(roofs: &[&Roof]) -> Vec<Solid> {
    let pieces = pieces::pieces(roofs);
    let alone = roofs.len() == 1;
    let simple = alone.then(|| lone::lone(&pieces)).flatten();
    match simple.filter(is_sound) {
        Some(solid) => vec![solid],
        None => divided(roofs, pieces),
    }
}

/// Returns the solids of some roofs, of each half by itself if the whole would touch itself along an edge.
fn divided(roofs: &[&Roof], pieces: Vec<Piece>) -> Vec<Solid> {
    match direct(roofs, pieces) {
        Ok(solids) => solids,
        Err(Refused::Touching) if roofs.len() > 1 => {
            let (these, those) = roofs.split_at(roofs.len() / 2);
            [made(these), made(those)].concat()
        }
        Err(_) => super::united(roofs),
    }
}

/// Why roofs cannot become solids without the general union.
enum Refused {
    /// They meet in a way that only the general union knows.
    Meeting,
    /// They touch along an edge only, so that they cannot be one closed solid.
    Touching,
}

/// Returns the solids of some roofs without the general union.
fn direct(roofs: &[&Roof], pieces: Vec<Piece>) -> Result<Vec<Solid>, Refused> {
    // Verges of half-hips that meet other roofs end in the middle of slopes.
    if roofs.len() > 1 && roofs.iter().any(|r| r.shape == RoofShape::HalfHip) {
        return Err(Refused::Meeting);
    }
    let (points, faces) = bounds(pieces).ok_or(Refused::Meeting)?;
    let solids = closed::bounded(&points, faces).ok_or(Refused::Touching)?;
    match solids.iter().all(is_sound) {
        true => Ok(solids),
        false => Err(Refused::Meeting),
    }
}

fn is_sound(solid: &Solid) -> bool {
    solid.faces.iter().all(|face| check::is_sound(solid, face))
}

/// Returns the faces that bound some slopes, and their points.
fn bounds(pieces: Vec<Piece>) -> Option<(Vec<DVec3>, Vec<Polygon>)> {
    let pieces = settled::settle(pieces)?;
    let mut plan = plan::Plan::of(&pieces);
    for _ in 0..ROUNDS {
        plan.conform();
        let raised = plan.raised(&pieces)?;
        if !plan.split(&raised) {
            let patches = plan.patches(&pieces, &raised)?;
            let faces = faces::merged(&raised.points, &patches)?;
            return Some((raised.points, faces));
        }
    }
    None
}

fn is_seen(solid: &Solid) -> bool {
    solid.faces.iter().any(|f| f.finish != Finish::Timber)
}

/// Returns the roofs in sets that do not touch each other, each in the order given.
fn apart(roofs: &[Roof]) -> Vec<Vec<&Roof>> {
    let mut sets: Vec<(Vec<usize>, [DVec2; 2])> = vec![];
    for (n, roof) in roofs.iter().enumerate() {
        let mut set = (vec![n], around(roof));
        let mut k = 0;
        while k < sets.len() {
            if touch(&sets[k].1, &set.1) {
                let (more, [lo, hi]) = sets.swap_remove(k);
                set.0.extend(more);
                set.1 = [set.1[0].min(lo), set.1[1].max(hi)];
                k = 0;
            } else {
                k += 1;
            }
        }
        sets.push(set);
    }
    sets.iter_mut().for_each(|s| s.0.sort_unstable());
    sets.sort_unstable_by_key(|s| s.0[0]);
    let of = |set: &(Vec<usize>, [DVec2; 2])| set.0.iter().map(|n| &roofs[*n]).collect();
    sets.iter().map(of).collect()
}

fn touch(a: &[DVec2; 2], b: &[DVec2; 2]) -> bool {
    (a[0] - APART).cmple(b[1]).all() && (b[0] - APART).cmple(a[1]).all()
}

fn around(roof: &Roof) -> [DVec2; 2] {
    let points = roof.solids.iter().flat_map(|s| &s.points);
    points.fold([DVec2::MAX, DVec2::MIN], |[lo, hi], p| {
        [lo.min(p.truncate()), hi.max(p.truncate())]
    })
}
