//! The plane and the origin of a town, from the places of its first layer.

use super::Sheet;
use crate::layer::{Spread, TownFrame};
use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_ir::ast::town::Town;
use hsd_map::{Crs, Datums, Projection, Transform};
use hsd_syntax::messages::town as say;

/// The origin of a town lies on whole kilometres.
const KILOMETRE: f64 = 1000.0;

/// Finds the plane and the origin of a town, whose first layer has these files.
pub(super) fn frame(town: &Town, first: &[Sheet], out: &mut Diagnostics) -> Option<TownFrame> {
    let local = Crs::local();
    let crs = first.first().map_or(&local, |sheet| sheet.raw.spread().1);
    let mut spread = Spread::default();
    for (own, system) in first.iter().map(|sheet| sheet.raw.spread()) {
        if system.name == crs.name {
            spread.append(own);
        }
    }
    let median = spread.median().unwrap_or_default();
    let plane = match &town.crs {
        Some(name) => match Crs::from_name(&name.value) {
            Some(crs) if crs.is_in_metres() => crs,
            Some(_) => {
                out.push(say::crs_not_in_metres(name.span, &name.value));
                return None;
            }
            None => {
                out.push(say::unknown_crs(name.span, &name.value));
                return None;
            }
        },
        None => match &crs.projection {
            Projection::TransverseMercator(_) | Projection::Local if crs.is_in_metres() => {
                crs.clone()
            }
            _ => {
                let degrees = Transform::new(crs, &Crs::wgs84(), Datums::Exact).ok();
                let at = degrees.and_then(|t| t.apply(median)).unwrap_or(median);
                Crs::zone_at(at, &crs.datum)
            }
        },
    };
    let to_plane = Transform::new(crs, &plane, Datums::Exact).ok();
    let in_plane = |at| to_plane.as_ref().and_then(|t| t.apply(at));
    let origin = match (&town.origin, &to_plane) {
        (Some(origin), _) => DVec2::from(origin.value),
        (None, None) => DVec2::ZERO,
        (None, Some(to_plane)) => {
            let at = in_plane(spread.centre(median, crs, to_plane)).unwrap_or_default();
            (at / KILOMETRE).round() * KILOMETRE
        }
    };
    let middle = in_plane(median).unwrap_or(origin) - origin;
    Some(TownFrame {
        crs: plane,
        origin,
        middle,
    })
}
