//! Flights of stairs and the landings between them: one room (plans.md 2).

use super::faces::Faces;
use super::hatching::Treads;
use crate::plan::raster::Extent;

/// The least share of the treads of a flight in its room, and of its room under treads.
const INSIDE: f64 = 0.7;
const COVERED: f64 = 0.3;
/// The least share of the side of a flight along which another joins it, and of its width along which a landing does.
const BESIDE: f64 = 0.5;
const AT_END: f64 = 0.8;
/// The greatest distance of two rooms that join, as a share of the width of a flight.
const NEAR: f64 = 0.12;

/// A room with treads.
struct Flight {
    room: u32,
    extent: Extent,
    /// True if the stairs run across the sheet.
    runs_across: bool,
}

/// Joins the flights of a staircase and the landings between them.
pub(super) fn joined(mut faces: Faces, treads: &[Treads]) -> Faces {
    let extents = faces.extents();
    let flights: Vec<Flight> = treads
        .iter()
        .filter_map(|t| flight(t, &faces, &extents))
        .collect();
    let mut names: Vec<u32> = (0..=faces.count as u32).collect();
    let mut join = |a: u32, b: u32| {
        let (a, b) = (names[a as usize], names[b as usize]);
        names
            .iter_mut()
            .filter(|name| **name == b)
            .for_each(|name| *name = a);
    };
    for (k, one) in flights.iter().enumerate() {
        for other in &flights[k + 1..] {
            if one.room != other.room && one.is_beside(&other.extent) {
                join(one.room, other.room);
            }
        }
    }
    for (room, extent) in extents.iter().enumerate().skip(1) {
        let room = room as u32;
        if extent.area == 0 || flights.iter().any(|flight| flight.room == room) {
            continue;
        }
        let ends: Vec<&Flight> = flights
            .iter()
            .filter(|flight| flight.ends_at(extent))
            .collect();
        let of_flights: usize = ends.iter().map(|flight| flight.extent.area).sum();
        if ends.len() > 1 && extent.area <= of_flights {
            ends.iter().for_each(|flight| join(flight.room, room));
        }
    }
    faces.of = faces.of.map(|room| names[room as usize]);
    faces
}

/// Returns the room of which treads cover most.
fn flight(treads: &Treads, faces: &Faces, extents: &[Extent]) -> Option<Flight> {
    let places =
        (treads.y[0]..=treads.y[1]).flat_map(|y| (treads.x[0]..=treads.x[1]).map(move |x| (x, y)));
    let mut counts = vec![0_usize; faces.count + 1];
    let mut all = 0;
    for place in places {
        counts[faces.of[place] as usize] += 1;
        all += 1;
    }
    let room = (1..counts.len()).max_by_key(|room| counts[*room])?;
    let extent = extents[room];
    let is_covered = counts[room] as f64 >= COVERED * extent.area as f64;
    let is_inside = counts[room] as f64 >= INSIDE * all as f64;
    (is_covered && is_inside).then_some(Flight {
        room: room as u32,
        extent,
        runs_across: treads.upright,
    })
}

impl Flight {
    /// Returns the flight's extent along the stairs and across them.
    fn sides(&self, extent: &Extent) -> [[usize; 2]; 2] {
        match self.runs_across {
            true => [extent.x, extent.y],
            false => [extent.y, extent.x],
        }
    }

    fn near(&self) -> f64 {
        let [_, across] = self.sides(&self.extent);
        NEAR * (across[1] - across[0]) as f64
    }

    /// Returns true if a room touches its side or its end.
    fn is_beside(&self, other: &Extent) -> bool {
        let (own, other) = (self.sides(&self.extent), self.sides(other));
        let near = self.near();
        [0, 1].iter().any(|k| {
            apart(own[*k], other[*k]) <= near && shared(own[1 - k], other[1 - k]) >= BESIDE
        })
    }

    /// Returns true if a room touches one of its ends.
    fn ends_at(&self, other: &Extent) -> bool {
        let (own, other) = (self.sides(&self.extent), self.sides(other));
        apart(own[0], other[0]) <= self.near() && shared(own[1], other[1]) >= AT_END
    }
}

/// Returns the space between two ranges; much if they overlap by more than a line.
fn apart(a: [usize; 2], b: [usize; 2]) -> f64 {
    let between = b[0] as f64 - a[1] as f64;
    between.max(a[0] as f64 - b[1] as f64).abs()
}

/// Returns the share of the first range that the second covers.
fn shared(a: [usize; 2], b: [usize; 2]) -> f64 {
    let both = a[1].min(b[1]) as f64 - a[0].max(b[0]) as f64;
    both / (a[1] - a[0]).max(1) as f64
}
