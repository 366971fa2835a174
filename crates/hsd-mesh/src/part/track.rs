//! Sill and head of sliding leaves: shikii and kamoi with their grooves.

use crate::mesh::panel::Rect;
use crate::part::bay::Bay;
use hsd_ir::catalog::body::{Place, Track};

/// Width of the ridge between two grooves, metres.
const RIDGE: f64 = 0.001;

/// Adds a sill at the bottom and a head at the top of a rectangle, both grooved towards the leaves.
pub(crate) fn track(bay: &mut Bay<'_>, track: &Track, place: &Place, rect: Rect) {
    let size = track.size.0.min(rect.height() / 4.0);
    // A groove leaves half the timber.
    let deep = track.deep.0.min(size / 2.0);
    let sill = profile(track, place, (rect.z0, rect.z0 + size), -deep);
    bay.profile(place.finish, &sill, rect.x0, rect.x1);
    let head = profile(track, place, (rect.z1, rect.z1 - size), deep);
    bay.profile(place.finish, &head, rect.x0, rect.x1);
}

/// Returns the section between the plain side and the grooved side: (outwards, up).
fn profile(
    track: &Track,
    place: &Place,
    (plain, grooved): (f64, f64),
    step: f64,
) -> Vec<(f64, f64)> {
    let (front, back) = (place.front.0, place.front.0 - place.thick.0);
    let mut outline = vec![(front, plain), (front, grooved)];
    for i in 0..track.tracks {
        let from = track.groove.0 - f64::from(i) * (track.wide.0 + RIDGE);
        let to = from - track.wide.0;
        // A groove keeps within the timber.
        if from < front && to > back {
            let floor = grooved + step;
            outline.extend([(from, grooved), (from, floor), (to, floor), (to, grooved)]);
        }
    }
    outline.extend([(back, grooved), (back, plain)]);
    outline
}
