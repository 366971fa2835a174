//! Selects the solids that a roof shows. At details without joinery, roofs that meet form one massive solid, which the
//! first of them shows; the others show only their trim.

use crate::roof::infill::{Infill, is_fill};
use crate::roof::plaster;
use crate::trim::Twist;
use glam::{DVec2, DVec3};
use hsd_ir::building::{Face, Finish, Roof, Solid};
use hsd_ir::material::SurfaceId;
use hsd_roof::solid::massive::{groups, lean, massive};
use hsd_scene::Detail;
use std::borrow::Cow;

/// Returns for each roof of a house the roofs whose solids it shows.
pub(crate) fn shares(roofs: &[Roof], detail: Detail) -> Vec<&[Roof]> {
    if !is_massive(detail) {
        return roofs.iter().map(std::slice::from_ref).collect();
    }
    let mut shares = Vec::with_capacity(roofs.len());
    for group in groups(roofs) {
        if group.iter().any(|r| r.attic.filled) {
            shares.push(group);
            shares.extend(std::iter::repeat_n(&[][..], group.len() - 1));
        } else {
            shares.extend(group.iter().map(std::slice::from_ref));
        }
    }
    shares
}

fn is_massive(detail: Detail) -> bool {
    detail <= Detail::Flat
}

/// The properties of a roof that depend on the walls below.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Walls {
    /// Surface and position of the gable infill over each wall, one entry per solid.
    pub(crate) gables: Vec<Infill>,
    /// True if they are plastered over their posts; eaves and verges are then plastered as well.
    pub(crate) plastered: bool,
    /// Wood or paint of soffits and boards; `None` = bare.
    pub(crate) timber: Option<SurfaceId>,
}

/// The solids that some roofs show.
pub(crate) struct Bulk<'a> {
    pub(crate) solids: Cow<'a, [Solid]>,
    twists: Vec<Twist>,
    gables: Gables<'a>,
    plastered: bool,
    timber: Option<SurfaceId>,
}

/// The surfaces of gable walls.
enum Gables<'a> {
    /// By solid.
    BySolid(&'a [Infill]),
    /// The positions in plan of the gable fills that a massive roof contains.
    Near(Vec<([DVec2; 2], SurfaceId)>),
}

impl<'a> Bulk<'a> {
    /// Solids by themselves, in the default surfaces.
    pub(crate) fn plain(solids: &'a [Solid]) -> Bulk<'a> {
        Bulk {
            solids: Cow::Borrowed(solids),
            twists: vec![],
            gables: Gables::BySolid(&[]),
            plastered: false,
            timber: None,
        }
    }

    /// The solids of these roofs over some walls, and their facets that are twisted.
    pub(crate) fn of(
        roofs: &'a [Roof],
        walls: &'a Walls,
        twists: Vec<Twist>,
        detail: Detail,
    ) -> Bulk<'a> {
        let (gables, plastered, timber) = (&walls.gables[..], walls.plastered, walls.timber);
        let whole = match detail {
            Detail::Body => whole(roofs),
            Detail::Flat => massive(roofs).map(Cow::Owned),
            Detail::Openings | Detail::Everything => None,
        };
        match (whole, roofs) {
            (Some(mut solids), _) => {
                let all = roofs.iter().flat_map(|r| &r.solids).zip(gables);
                let fills: Vec<_> = all.filter(|(s, _)| is_fill(s)).collect();
                for (solid, fill) in &fills {
                    if let Some(flush) = fill.flush {
                        flush.lay(solid, roofs, solids.to_mut());
                    }
                }
                let near = fills.iter().map(|(s, fill)| (around(s), fill.surface));
                Bulk {
                    gables: Gables::Near(near.collect()),
                    solids,
                    twists,
                    plastered,
                    timber,
                }
            }
            (None, roofs) => Bulk {
                solids: laid(roofs, gables),
                twists,
                gables: Gables::BySolid(gables),
                plastered,
                timber,
            },
        }
    }

    /// Returns the surface of a face that depends on the walls below.
    pub(crate) fn given(&self, solid: usize, face: &Face) -> Option<SurfaceId> {
        match face.finish {
            Finish::Gable => self.gable(solid, face),
            Finish::Soffit if self.plastered => Some(plaster()),
            Finish::Soffit | Finish::Timber => self.timber,
            _ => None,
        }
    }

    /// Returns the direction up the slope along a face of the covering that looks to `normal`, where it is not that up the face.
    pub(crate) fn up(&self, normal: DVec3) -> Option<DVec3> {
        self.twists.iter().find_map(|twist| twist.up(normal))
    }

    /// Returns the surface of a gable wall.
    fn gable(&self, solid: usize, face: &Face) -> Option<SurfaceId> {
        match &self.gables {
            Gables::BySolid(all) => all.get(solid).map(|fill| fill.surface),
            Gables::Near(fills) => {
                let points = &self.solids[solid].points;
                let corners = face.corners.iter().map(|c| points[*c as usize].truncate());
                let middle = corners.sum::<DVec2>() / face.corners.len() as f64;
                let off = |[lo, hi]: &[DVec2; 2]| middle.clamp(*lo, *hi).distance_squared(middle);
                let nearest = fills.iter().min_by(|p, q| off(&p.0).total_cmp(&off(&q.0)));
                nearest.map(|n| n.1)
            }
        }
    }
}

/// Returns the solids that some roofs show at the least detail; none if they have no attic.
fn whole(roofs: &[Roof]) -> Option<Cow<'_, [Solid]>> {
    match roofs.iter().find_map(|roof| roof.whole.as_deref()) {
        Some(made) => Some(Cow::Borrowed(made)),
        None => lean(roofs).map(Cow::Owned),
    }
}

/// Returns the solids of a roof, its fills flush with the walls below.
fn laid<'a>(roofs: &'a [Roof], gables: &[Infill]) -> Cow<'a, [Solid]> {
    let solids: &[Solid] = roofs.first().map_or(&[], |r| &r.solids);
    if gables.iter().all(|fill| fill.flush.is_none()) {
        return Cow::Borrowed(solids);
    }
    let of = |(solid, fill): (&Solid, &Infill)| match fill.flush {
        Some(flush) => flush.laid(solid, roofs),
        None => solid.clone(),
    };
    Cow::Owned(solids.iter().zip(gables).map(of).collect())
}

fn around(solid: &Solid) -> [DVec2; 2] {
    let plan = solid.points.iter().map(|p| p.truncate());
    plan.fold([DVec2::MAX, DVec2::MIN], |[lo, hi], p| {
        [lo.min(p), hi.max(p)]
    })
}
