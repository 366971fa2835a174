//! What a roof wears beyond its solids: ridge tiles, end tiles, barge boards.
//!
//! The lines to be dressed are read off the finished solids ([`seams`]), so that they are right after every
//! junction and for every shape; sizes come from `domain.md` 4.4 and the few wishes of [`Dress`]. All of it are
//! closed bodies that reach a little into what carries them, so that no face lies in another's plane.
//!
//! [`Dress`]: crate::building::Dress

mod barge;
mod body;
mod ridge;
mod seams;

#[cfg(test)]
mod tests;

use super::mesh::Soup;
use crate::building::Roof;
use crate::material::SurfaceId;
use crate::scene::Detail;
pub(super) use body::Body;
use seams::{Kind, Surface};

/// The bodies that dress a roof at a detail.
pub(super) fn dress(roof: &Roof, _detail: Detail) -> Vec<Body> {
    let surface = Surface::of(&roof.solids);
    if surface.facets.is_empty() {
        return vec![];
    }
    let mut bodies = Vec::new();
    for seam in surface.seams() {
        match seam.kind {
            Kind::Ridge | Kind::Hip => ridge::cap(&surface, &seam, roof, &mut bodies),
            Kind::Verge => barge::boards(&seam, &roof.dress, &mut bodies),
            Kind::Valley | Kind::Eaves | Kind::Crest | Kind::Flank => {}
        }
    }
    bodies
}

/// Adds bodies to the soups of their surfaces.
pub(super) fn pour(bodies: &[Body], soups: &mut Vec<(SurfaceId, Soup)>) {
    for body in bodies {
        let at = soups.iter().position(|(finish, _)| *finish == body.finish);
        let at = at.unwrap_or_else(|| {
            soups.push((body.finish, Soup::default()));
            soups.len() - 1
        });
        body.pour(&mut soups[at].1);
    }
}
