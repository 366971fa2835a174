//! Massive roofs: one closed solid for roofs that meet, with their attics, for details that show no joinery.
//!
//! A roof consists of slabs and of gable walls under them. Each is a closed solid, with faces inside the house that are
//! never visible. Here the space below becomes part of it: inside the walls the solid reaches the wall plate, under
//! eaves and verges to the lower surface of its slabs, and the vertical faces between the two are the gable walls.
//! Roofs that meet have no faces between them.
//!
//! The upper surface is cut into parts with a plane below each, no two of which share any space (`parts`). They become
//! upright columns, whose common surface is the solid (`union`); faces side by side in one plane become one (`merge`).
//! A simple roof that meets no other needs none of this: its solid has a closed form (`lean`), and its timber stays beside it.
//!
//! | roof | becomes |
//! |---|---|
//! | on a wall plate | massive |
//! | under the eaves of its trunk, or hung on a wall | a part of the same solid without attic: the room below is no part of the roof |
//! | flat | stays a slab with its upstands, two overlapping solids, since it has no attic |
//!
//! Roofs that touch only along an edge cannot form one closed solid and are split into several. Brackets and purlins
//! stay separate solids that penetrate the roof they carry.

mod closed;
mod lean;
mod merge;
mod parts;
mod union;

use crate::solid::SUNK;
use crate::solid::sheet::surface;
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{Finish, Roof, Solid};
pub use lean::lean;
pub(crate) use lean::{Plate, Slope, Wing, united as of_wings};
use parts::Part;

/// The maximum number of sets of roofs tried if they cannot all become one solid.
const MOST_SETS: usize = 8;

/// Returns groups of the roofs of a house that may meet: those of one storey, except flat ones.
pub fn groups(roofs: &[Roof]) -> impl Iterator<Item = &[Roof]> {
    let sloped = |r: &Roof| r.shape != RoofShape::Flat;
    roofs.chunk_by(move |p, q| p.storey == q.storey && sloped(p) && sloped(q))
}

/// Returns the solids of one of these [`groups`]; none if it has no attic. Roofs that touch only in an edge cannot be
/// one closed solid: such a group becomes several.
pub fn massive(roofs: &[Roof]) -> Option<Vec<Solid>> {
    let alone = match roofs {
        [roof] => lone_with_timber(roof),
        _ => None,
    };
    alone.or_else(|| general(roofs))
}

/// Returns the same from the union of columns, whatever the roofs are.
pub fn general(roofs: &[Roof]) -> Option<Vec<Solid>> {
    roofs.iter().find(|r| r.attic.filled)?;
    Some(united(&roofs.iter().collect::<Vec<_>>()))
}

/// Returns the solid of a roof that meets no other in closed form, and its timber; none if it is not simple.
fn lone_with_timber(roof: &Roof) -> Option<Vec<Solid>> {
    let timber = roof
        .solids
        .iter()
        .filter(|s| surface(s).is_none() && !is_gable(s));
    let solid = lean::alone(roof)?;
    Some(std::iter::once(solid).chain(timber.cloned()).collect())
}

/// Returns the solids of some roofs, as one if that is possible.
fn united(roofs: &[&Roof]) -> Vec<Solid> {
    together(roofs).unwrap_or_else(|| sets(roofs, together))
}

/// Returns the solids of some roofs that cannot all become one, in as few sets as `together` allows.
fn sets(roofs: &[&Roof], together: impl Fn(&[&Roof]) -> Option<Vec<Solid>>) -> Vec<Solid> {
    let mut sets: Vec<(Vec<&Roof>, Vec<Solid>)> = vec![];
    for &roof in roofs {
        let joined = sets.iter_mut().take(MOST_SETS).find_map(|set| {
            let all = [&set.0[..], &[roof]].concat();
            Some((together(&all)?, set))
        });
        match joined {
            Some((solids, set)) => {
                set.0.push(roof);
                set.1 = solids;
            }
            None => {
                let own = together(&[roof]).unwrap_or_else(|| roof.solids.clone());
                sets.push((vec![roof], own));
            }
        }
    }
    sets.into_iter().flat_map(|set| set.1).collect()
}

/// Returns the solids of some roofs as one, if that is possible.
fn together(roofs: &[&Roof]) -> Option<Vec<Solid>> {
    let (mut parts, mut others) = (vec![], vec![]);
    for roof in roofs {
        let filled = roof.attic.filled;
        let plate = roof.attic.plate - SUNK;
        for solid in &roof.solids {
            if let Some((pieces, drop)) = surface(solid) {
                for (outline, top) in pieces {
                    let part = Part::sheet(outline, top, drop, roof.kind);
                    match filled {
                        true => part.filled(&roof.attic, plate, &mut parts),
                        false => parts.push(part),
                    }
                }
            } else if !is_gable(solid) {
                others.push(solid.clone());
            } else if !filled {
                Part::wall(solid, &mut parts);
            }
        }
    }
    let parts = parts::settle(parts)?;
    let columns: Vec<_> = parts.iter().flat_map(Part::columns).collect();
    let mut solids = union::union(&columns)?;
    solids.extend(others);
    Some(solids)
}

pub(crate) fn is_gable(solid: &Solid) -> bool {
    solid.faces.iter().all(|f| f.finish == Finish::Gable)
}
