//! Lone roofs in closed form: slopes whose edges all lie on the rim or on another slope as a whole, with one level attic.
//!
//! Nothing is cut and nothing is searched for in space. Each slope contributes its upper face, the edges on its rim and
//! the part of its lower face outside the filling. The borders of the fillings that face outwards form one ring: it is
//! the border of the floor, and where the slopes stand over it, gable walls rise from it.

use crate::facet::Corner;
use crate::solid::massive::lean::corners::WELD;
use crate::solid::massive::lean::pieces::Piece;
use glam::DVec2;
use hsd_base::geometry::tolerance::{JOINT, STRAIGHT};
use hsd_ir::building::{Corners, Face, Finish, Solid};

/// Roofs of more slopes go the general way, since every corner is compared with all others here.
const MOST_SLOPES: usize = 12;

/// Heights over one corner that differ by less are one, metres.
const SAME: f64 = 1e-6;

/// Returns the solid of the slopes of one roof; none if they meet in another way than edge on edge.
pub(super) fn lone(pieces: &[Piece]) -> Option<Solid> {
    let bottom = pieces.first()?.bottom;
    let alike = |p: &Piece| {
        let same = p.bottom == bottom && p.kind.is_some() && p.kind == pieces[0].kind;
        same && !p.filled.is_empty()
    };
    if pieces.len() > MOST_SLOPES || bottom.slope != DVec2::ZERO || !pieces.iter().all(alike) {
        return None;
    }
    let mut made = Made {
        floor: bottom.at(DVec2::ZERO),
        ..Made::default()
    };
    for piece in pieces {
        made.slope(piece)?;
    }
    made.is_joined().then_some(())?;
    made.attic()?;
    Some(made.solid)
}

/// A level over a corner.
#[derive(Clone, Copy)]
enum Level {
    Top,
    Low,
    Floor,
}

/// A corner of the plan with the points over it.
struct Place {
    at: DVec2,
    /// Heights of the levels that are known.
    heights: [Option<f64>; 3],
    points: [Option<u32>; 3],
}

/// The solid in the making.
#[derive(Default)]
struct Made {
    solid: Solid,
    places: Vec<Place>,
    floor: f64,
    /// The edges that slopes share, and those that their fillings share, which another slope runs along backwards.
    shared: Vec<(u32, u32)>,
    /// The outward edges of the fillings.
    border: Vec<(u32, u32)>,
}

impl Made {
    /// Returns the number of a corner.
    fn place(&mut self, at: DVec2) -> u32 {
        let near = |p: &Place| (p.at - at).abs().max_element() < WELD;
        let known = self.places.iter().position(near);
        known.unwrap_or_else(|| {
            self.places.push(Place {
                at,
                heights: [None; 3],
                points: [None; 3],
            });
            self.places.len() - 1
        }) as u32
    }

    /// Notes a height; none if slopes disagree about it.
    fn raise(&mut self, place: u32, level: Level, z: f64) -> Option<()> {
        let known = &mut self.places[place as usize].heights[level as usize];
        let same = known.is_none_or(|known| (known - z).abs() < SAME);
        known.get_or_insert(z);
        same.then_some(())
    }

    /// Returns the point over a corner; where the lower surface reaches the floor both are one.
    fn point(&mut self, place: u32, level: Level) -> Option<u32> {
        let here = &mut self.places[place as usize];
        let low = here.heights[Level::Low as usize];
        let level = match level {
            Level::Floor if low.is_some_and(|z| (z - self.floor).abs() < JOINT) => Level::Low,
            level => level,
        };
        if let Some(known) = here.points[level as usize] {
            return Some(known);
        }
        let z = match level {
            Level::Floor => self.floor,
            level => here.heights[level as usize]?,
        };
        self.solid.points.push(here.at.extend(z));
        let number = self.solid.points.len() as u32 - 1;
        here.points[level as usize] = Some(number);
        Some(number)
    }

    fn face(&mut self, corners: Corners, finish: Finish) {
        self.solid.faces.push(Face { corners, finish });
    }

    /// Returns the points of a ring on one level.
    fn ring(&mut self, places: impl Iterator<Item = u32>, level: Level) -> Option<Corners> {
        places.map(|p| self.point(p, level)).collect()
    }

    /// Adds the faces of a slope outside its filling.
    fn slope(&mut self, piece: &Piece) -> Option<()> {
        let outline: Vec<u32> = piece.outline.iter().map(|c| self.place(c.at)).collect();
        let filled: Vec<u32> = piece.filled.iter().map(|c| self.place(c.at)).collect();
        if !is_simple(&outline) || !is_simple(&filled) {
            return None;
        }
        for &place in outline.iter().chain(&filled) {
            let top = piece.top.at(self.places[place as usize].at);
            self.raise(place, Level::Top, top)?;
            self.raise(place, Level::Low, top - piece.drop)?;
        }
        let kind = piece.kind?;
        let top = self.ring(outline.iter().copied(), Level::Top)?;
        self.face(top, Finish::Covering(kind));
        for (corner, (p, q)) in piece.outline.iter().zip(edges(&outline)) {
            match corner.rim {
                true => {
                    let low = self.ring([p, q].into_iter(), Level::Low)?;
                    let top = self.ring([q, p].into_iter(), Level::Top)?;
                    let corners = low.into_iter().chain(top).collect();
                    self.face(corners, Finish::Edge(kind));
                }
                false => self.shared.push((p, q)),
            }
        }
        let soffit = self.soffit(&piece.outline, &outline, &filled)?;
        let soffit = self.ring(soffit.into_iter().rev(), Level::Low)?;
        self.face(soffit, Finish::Soffit);
        Some(())
    }

    /// Returns the outline without the filling, and notes the edges of the filling. None unless these meet the outline
    /// in one chain, on edges shared with other slopes.
    fn soffit(&mut self, corners: &[Corner], outline: &[u32], filled: &[u32]) -> Option<Vec<u32>> {
        let n = filled.len();
        let along: Vec<Option<usize>> = edges(filled)
            .map(|(u, v)| self.edge_along(outline, [u, v]))
            .collect();
        let starts = |i: &usize| along[*i].is_some() && along[(*i + n - 1) % n].is_none();
        let mut chains = (0..n).filter(starts);
        let (first, None) = (chains.next()?, chains.next()) else {
            return None;
        };
        let length = (0..n).take_while(|k| along[(first + k) % n].is_some());
        let length = length.count();
        for (i, (u, v)) in edges(filled).enumerate() {
            match along[i] {
                Some(edge) if corners[edge].rim => return None,
                Some(_) => self.shared.push((u, v)),
                None => self.border.push((u, v)),
            }
        }
        let end = (first + length) % n;
        let (from, to) = (along[(end + n - 1) % n]?, along[first]?);
        let mut ring = vec![filled[end]];
        let count = (to + outline.len() - (from + 1) % outline.len()) % outline.len();
        ring.extend((0..=count).map(|k| outline[(from + 1 + k) % outline.len()]));
        ring.extend((0..n - length).map(|k| filled[(first + n - k) % n]));
        ring.dedup();
        is_simple(&ring).then_some(ring)
    }

    /// Returns the edge of an outline on which both places lie.
    fn edge_along(&self, outline: &[u32], ends: [u32; 2]) -> Option<usize> {
        let at = |place: u32| self.places[place as usize].at;
        edges(outline).position(|(p, q)| {
            let way = (at(q) - at(p)).normalize_or_zero();
            let on = |place: u32| {
                place == p || place == q || way.perp_dot(at(place) - at(p)).abs() < WELD
            };
            ends.into_iter().all(on)
        })
    }

    /// Returns true if every shared edge is run along once in each direction.
    fn is_joined(&mut self) -> bool {
        let mut there = self.shared.clone();
        let mut back: Vec<(u32, u32)> = there.iter().map(|(p, q)| (*q, *p)).collect();
        there.sort_unstable();
        back.sort_unstable();
        there == back && there.windows(2).all(|w| w[0] != w[1])
    }

    /// Adds the floor and the gable walls.
    fn attic(&mut self) -> Option<()> {
        let ring = self.border_ring()?;
        let n = ring.len();
        let at = |made: &Made, k: usize| made.places[ring[k % n] as usize].at;
        let height = |made: &Made, k: usize| {
            let low = made.places[ring[k % n] as usize].heights[Level::Low as usize];
            low.map(|z| z - made.floor).filter(|h| *h > -JOINT)
        };
        let open: Vec<bool> = (0..n)
            .map(|k| {
                let (one, other) = (height(self, k)?, height(self, k + 1)?);
                Some(one.max(other) >= JOINT)
            })
            .collect::<Option<_>>()?;
        // A gable wall goes on over corners at which the ring does not turn.
        let goes_on: Vec<bool> = (0..n)
            .map(|k| {
                let before = at(self, k) - at(self, k + n - 1);
                let after = at(self, k + 1) - at(self, k);
                let turn = before
                    .normalize_or_zero()
                    .perp_dot(after.normalize_or_zero());
                open[k] && open[(k + n - 1) % n] && turn.abs() < STRAIGHT
            })
            .collect();
        let corners = || (0..n).filter(|k| !goes_on[*k]);
        if corners().count() < 3 {
            return None;
        }
        let floor = self.ring(corners().rev().map(|k| ring[k]), Level::Floor)?;
        self.face(floor, Finish::Soffit);
        for k in corners().filter(|k| open[*k]) {
            let more = (1..n).take_while(|m| goes_on[(k + m) % n]).count();
            let along = (k..=k + 1 + more).map(|k| ring[k % n]);
            let ends = [ring[k], ring[(k + 1 + more) % n]];
            let mut wall = self.ring(ends.into_iter(), Level::Floor)?;
            let upper = self.ring(along.rev(), Level::Low)?;
            wall.extend(upper);
            wall.dedup();
            if wall.first() == wall.last() {
                wall.pop();
            }
            if wall.len() < 3 {
                return None;
            }
            self.face(wall, Finish::Gable);
        }
        Some(())
    }

    /// Returns the border of the filling as one ring.
    fn border_ring(&self) -> Option<Vec<u32>> {
        let first = self.border.first()?.0;
        let mut ring = vec![first];
        loop {
            let here = ring[ring.len() - 1];
            let mut next = self.border.iter().filter(|e| e.0 == here);
            let (edge, None) = (next.next()?, next.next()) else {
                return None;
            };
            match edge.1 == first {
                true => break,
                false => ring.push(edge.1),
            }
            (ring.len() <= self.border.len()).then_some(())?;
        }
        (ring.len() == self.border.len() && ring.len() > 2).then_some(ring)
    }
}

/// Returns the edges of a ring.
fn edges(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(p, q)| (*p, *q))
}

/// Returns true if a ring has three corners or more, none of them twice.
fn is_simple(ring: &[u32]) -> bool {
    let twice = |n: usize| ring[..n].contains(&ring[n]);
    ring.len() > 2 && !(1..ring.len()).any(twice)
}
