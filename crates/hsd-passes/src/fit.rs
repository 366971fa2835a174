//! Fittings of a house: platform, veranda, tie beams, bracket complexes, finials, rooms. They need the finished roofs: purlins
//! end under them, finials stand on them.
//!
//! - [`mod@outdoors`]: what is beside the house;
//! - [`around`]: outlines at a margin outside the walls;
//! - [`platform`], [`plinth`], [`veranda`], [`brackets`], [`beams`], [`finial`]: one kind of fitting each;
//! - [`mod@rooms`]: the areas between walls ([`areas`], [`plan`]), the mats in them ([`mats`], [`names`]), what is built into
//!   them ([`fixtures`]), and where one gets to ([`ways`]);
//! - [`undersides`]: the undersides of the roofs over brackets.

mod areas;
mod around;
mod beams;
mod brackets;
mod finial;
mod fixtures;
mod mats;
mod names;
mod outdoors;
mod plan;
mod platform;
mod plinth;
mod rooms;
mod undersides;
mod veranda;
mod ways;

use crate::messages::fittings as say;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::SAME;
use hsd_base::source::Span;
use hsd_ir::ast;
use hsd_ir::building::fittings::{Fitting, FittingKind, Veranda};
use hsd_ir::building::{Fixture, House, HouseRoofs, Ring, Room, Storey, Wall};
use hsd_ir::catalog::Catalog;
use hsd_ir::program::Content;
use plan::Plan;
use std::cell::OnceCell;
use std::sync::Arc;
use undersides::Undersides;

pub use fixtures::Hindrance;
pub use plan::InStorey;

/// Works out the fittings of one house. A roof under a finial that replaces the usual jewel is marked as crowned.
pub fn house(
    house: &House,
    roofs: &mut Arc<HouseRoofs>,
    catalog: &Catalog,
    out: &mut Diagnostics,
) -> Vec<Fitting> {
    let mut made = vec![];
    let undersides = OnceCell::new();
    let mut deck = bases(house, &mut made, out);
    for (i, storey) in house.storeys.iter().enumerate() {
        let order = &storey.order;
        let number = storey.number;
        if let Some(veranda) = &order.veranda {
            let it = match i {
                0 => deck.take(),
                _ => veranda::veranda(house, storey, veranda, false),
            };
            match it {
                Some(it) => made.push(fitting(veranda.span, number, FittingKind::Veranda(it))),
                None => out.push(say::nothing_to_stand_at(veranda.span, "Veranda")),
            }
        }
        if let Some(posts) = order.posts.as_ref().filter(|p| p.nageshi > 0) {
            let beams = beams::beams(catalog, house, storey, posts);
            let paint = paint(Some(posts.paint));
            made.push(fitting(
                posts.span,
                number,
                FittingKind::Beams(beams, paint),
            ));
        }
        if let Some(brackets) = &order.brackets {
            let below = undersides.get_or_init(|| Undersides::of(roofs));
            let it = brackets::brackets(house, storey, brackets, below);
            made.push(fitting(brackets.span, number, FittingKind::Brackets(it)));
        }
    }
    for finial in &house.finials {
        match finial::finial(house, roofs, finial) {
            Some((it, roof)) => {
                if finial::crowns(it.kind) {
                    Arc::make_mut(roofs).roofs[roof].trim.crowned = true;
                }
                made.push(fitting(finial.span, 0, FittingKind::Finial(it)));
            }
            None => out.push(say::no_roof_below(finial.span)),
        }
    }
    let puts = house.puts.iter();
    made.extend(puts.map(|put| outdoors::put(house, put, out)));
    let grounds = house.grounds.iter().enumerate();
    made.extend(grounds.map(|(n, ground)| outdoors::ground(house, ground, n)));
    made
}

/// Works out the rooms of one house and what is built into them.
pub fn rooms(house: &House, catalog: &Catalog, out: &mut Diagnostics) -> (Vec<Room>, Vec<Fixture>) {
    rooms::rooms(house, catalog, out)
}

/// Returns what there is at a point of a storey, U.
pub fn in_storey(storey: &Storey, at: DVec2) -> InStorey {
    Plan::of(storey, 0).map_or(InStorey::Outside, |plan| plan.at(at))
}

/// Returns why a fixture cannot stand in a storey among those of the house that do; the storey is its place in the list.
pub fn hindrance<'f>(
    house: &House,
    level: usize,
    fixture: &ast::Fixture,
    standing: impl Iterator<Item = &'f Fixture>,
) -> Option<Hindrance<'f>> {
    fixtures::hindrance(house, level, fixture, standing)
}

/// Lays out the platform, which it adds, and the veranda of the ground storey, which it returns: the flights of both are
/// one matter.
fn bases(house: &House, made: &mut Vec<Fitting>, out: &mut Diagnostics) -> Option<Veranda> {
    let ground = house.storeys.first();
    let platform = |written| platform::platform(house, ground?, written);
    let mut deck = ground.and_then(|g| {
        let written = g.order.veranda.as_ref()?;
        veranda::veranda(house, g, written, true)
    });
    if let Some(written) = &house.platform {
        match platform(written) {
            Some(mut it) => {
                let flights = deck.iter_mut().flat_map(|d| &mut d.stairs);
                platform::stand(flights, &mut it);
                made.push(fitting(written.span, 0, FittingKind::Platform(it)));
            }
            None => out.push(say::nothing_to_stand_at(written.span, "Platform")),
        }
    }
    if let Some(it) = plinth::plinth(house, made, deck.as_ref()) {
        made.push(fitting(house.span, 0, FittingKind::Plinth(it)));
    }
    deck
}

fn fitting(span: Span, storey: u32, what: FittingKind) -> Fitting {
    Fitting { span, storey, what }
}

/// Returns the surface of a paint, or of bare wood.
fn paint(paint: Option<hsd_ir::ast::Paint>) -> hsd_ir::material::SurfaceId {
    hsd_ir::material::SurfaceId::named(paint.unwrap_or_default().surface())
}

/// Returns a plan point in the house frame, metres.
fn metres(house: &House, p: DVec2) -> DVec2 {
    house.place(p, 0.0).truncate()
}

/// Returns the direction out of the house at a wall, house frame.
fn outward(wall: &Wall) -> DVec2 {
    // The interior is on the right of the walk.
    dvec2(-wall.direction.y, -wall.direction.x)
}

/// Returns the closed outer rings of a storey.
fn rings(storey: &Storey) -> impl Iterator<Item = &Ring> {
    storey.rings.iter().filter(|r| r.closed && !r.hole)
}

/// Returns the positions of a wall's posts, in U from its right end: its ends and the borders of its bays.
fn posts_of(wall: &Wall) -> Vec<f64> {
    let length = wall.from.distance(wall.to);
    let mut at = 0.0;
    let mut posts = vec![0.0];
    for unit in wall.units.iter().filter(|u| u.width > 0.0) {
        at += unit.width;
        let known = posts.last().is_some_and(|last| at - last < SAME);
        if !known && at < length - SAME {
            posts.push(at);
        }
    }
    posts.push(length);
    posts
}

/// Returns true if a bay holds a wall or an opening rather than a void.
fn stands(content: &Content) -> bool {
    !matches!(content, Content::Void)
}
