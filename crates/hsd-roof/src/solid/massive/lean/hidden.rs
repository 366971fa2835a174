//! Where the slopes in one plane are not seen: where others take their place, and where attics and verges hide what is below.

use crate::facet::{Convex, Corner, HalfPlane, Higher, area};
use crate::frame::Plane;
use crate::solid::massive::lean::areas::{Area, Plan};
use crate::solid::massive::lean::wings::{Plate, Slope, Wing, is_same};
use hsd_base::geometry::tolerance::SLIVER;
use smallvec::SmallVec;

/// The areas of a slope in plan.
pub(super) struct Areas<'s> {
    slope: &'s Slope,
    /// The number of its plane, and that plane.
    plane: usize,
    top: Plane,
    outline: Area,
    body: Area,
    verges: SmallVec<[(&'s Convex, Area); 2]>,
}

impl<'s> Areas<'s> {
    /// Returns the areas of a slope; none if it is a sliver.
    pub(super) fn of(
        slope: &'s Slope,
        plan: &mut Plan,
        planes: &mut Vec<Plane>,
    ) -> Option<Areas<'s>> {
        let known = planes.iter().position(|p| is_same(*p, slope.top));
        let plane = known.unwrap_or(planes.len());
        if known.is_none() {
            planes.push(slope.top);
        }
        let outline = plan.area(&slope.outline)?;
        let body = match slope.verges.is_empty() {
            true => None,
            false => plan.area(&slope.body),
        };
        let verges = slope.verges.iter();
        Some(Areas {
            slope,
            plane,
            top: planes[plane],
            outline,
            body: body.unwrap_or(outline),
            verges: verges.filter_map(|v| Some((v, plan.area(v)?))).collect(),
        })
    }
}

/// A convex part of a roof: slopes below it are not seen, and it may have an attic.
pub(super) struct Body<'a, 's> {
    /// One slope, or those of a wing over a rectangle, of which each is the lowest over its own part.
    slopes: &'a [Areas<'s>],
    outline: Convex,
    area: Area,
    pub(super) filled: Option<Area>,
}

impl<'a, 's> Body<'a, 's> {
    /// Adds the bodies of a wing, given the areas of its slopes: one if they fill a rectangle, else one for each.
    pub(super) fn add(
        wing: &Wing,
        slopes: &'a [Areas<'s>],
        plate: &Plate,
        plan: &mut Plan,
        all: &mut Vec<Body<'a, 's>>,
    ) {
        let corners = wing.body.map(|rect| rect.corners());
        let outline = corners.map(|all| all.map(|at| Corner { at, rim: false }));
        if let Some(outline) = outline
            && let Some(area) = plan.area(&outline)
        {
            let outline = Convex::from_slice(&outline);
            return all.push(Body::over(slopes, (outline, area), plate, plan));
        }
        for own in slopes {
            let place = (own.slope.body.clone(), own.body);
            all.push(Body::over(std::slice::from_ref(own), place, plate, plan));
        }
    }

    fn over(
        slopes: &'a [Areas<'s>],
        (outline, area): (Convex, Area),
        plate: &Plate,
        plan: &mut Plan,
    ) -> Body<'a, 's> {
        let mut body = Body {
            slopes,
            outline,
            area,
            filled: None,
        };
        // Its lower surface lies above the floor where the upper one lies above this.
        let floor = plate.floor.map(|floor| Plane::level(floor + plate.drop));
        body.filled = floor.and_then(|floor| body.above(floor, plan));
        body
    }

    /// Returns the part of it, in plan, that lies above a plane.
    fn above(&self, plane: Plane, plan: &mut Plan) -> Option<Area> {
        let mut rest: Option<Convex> = None;
        for slope in self.slopes {
            match HalfPlane::where_higher(slope.top, plane) {
                Higher::Nowhere => return None,
                Higher::Everywhere => {}
                Higher::Inside(side) => {
                    rest = Some(side.inside(rest.as_ref().unwrap_or(&self.outline)));
                }
            }
        }
        match rest {
            None => Some(self.area),
            Some(rest) => plan.area(&rest),
        }
    }
}

/// Where slopes in one plane are not seen.
#[derive(Default)]
pub(super) struct Hidden {
    /// The outlines of the slopes.
    pub(super) outlines: Vec<Area>,
    /// Where another takes their place.
    pub(super) covered: Vec<Area>,
    /// Where they would lie in the thickness of a verge above them.
    pub(super) within: Vec<Area>,
    /// Where their own verges lie upon another, or where they lie over the attic.
    pub(super) below: Vec<Area>,
}

impl Hidden {
    /// Finds where the slopes in one plane are not seen.
    pub(super) fn find(
        &mut self,
        (number, top): (usize, Plane),
        (areas, bodies): (&[Areas<'_>], &[Body<'_, '_>]),
        drop: f64,
        plan: &mut Plan,
    ) {
        let Hidden {
            outlines,
            covered,
            within,
            below,
        } = self;
        outlines.clear();
        covered.clear();
        within.clear();
        below.clear();
        let own = || areas.iter().filter(|a| a.plane == number);
        outlines.extend(own().map(|a| a.outline));
        for body in bodies {
            let near = |area: &Area| outlines.iter().any(|o| o.is_near(area));
            match body.slopes.iter().filter(|a| a.plane == number).count() {
                0 if near(&body.area) => covered.extend(body.above(top, plan).filter(near)),
                0 => {}
                count if count == outlines.len() => below.extend(body.filled),
                // Verges of one may lie over other slopes of another.
                _ => {
                    let own = body.slopes.iter().filter(|a| a.plane == number);
                    for (own, filled) in own.zip(std::iter::repeat(body.filled)) {
                        let common = filled.map(|filled| plan.common(filled, &own.slope.body));
                        below.extend(common.and_then(|common| plan.area(&common)));
                    }
                }
            }
        }
        for other in areas.iter().filter(|a| a.plane != number) {
            if !outlines.iter().any(|o| o.is_near(&other.outline)) {
                continue;
            }
            for (verge, area) in &other.verges {
                if outlines.iter().any(|o| o.is_near(area)) {
                    within.extend(plan.area(&between(verge, top, other.top, drop)));
                }
            }
            let verges = own().flat_map(|a| &a.verges);
            for (verge, _) in verges.filter(|v| other.outline.is_near(&v.1)) {
                let upper = between(verge, other.top, top, drop);
                if area(&upper) > SLIVER {
                    let common = plan.common(other.outline, &upper);
                    below.extend(plan.area(&common));
                }
            }
        }
    }
}

/// Returns the part of a convex outline where one plane is higher than another.
fn higher(outline: &[Corner], upper: Plane, lower: Plane) -> Convex {
    match HalfPlane::where_higher(upper, lower) {
        Higher::Everywhere => Convex::from_slice(outline),
        Higher::Nowhere => Convex::new(),
        Higher::Inside(side) => side.inside(outline),
    }
}

/// Returns the part of a convex outline where a plane lies in a slab below another.
fn between(outline: &[Corner], plane: Plane, top: Plane, drop: f64) -> Convex {
    higher(&higher(outline, top, plane), plane, top.raised(-drop))
}
