//! How a sheet itself draws things: the mean of what a first look was sure of. The symbols of a legend are a first guess; the
//! width of walls, the blur and the tone of a sheet are its own.

use super::super::legend::Role;
use super::patch::{ACROSS, Patch, skip};
use super::runs::Run;
use super::stamp::Stamp;
use super::tones::{ALONG, Tones};
use std::collections::BTreeMap;

/// The fewest times that a thing is drawn in a way that is learnt.
const LEAST: u32 = 3;

/// A way of drawing is learnt only if at least one in this many units of its role is drawn so.
const USUAL: u32 = 4;

/// Ink that was read by a stamp, summed.
struct Sum {
    times: u32,
    /// Black and red, for each unit of the stamp.
    ink: [Vec<Vec<u32>>; 2],
}

/// What was gathered, by stamps.
#[derive(Default)]
pub(super) struct Learnt {
    sums: BTreeMap<usize, Sum>,
}

impl Learnt {
    /// Takes a run of units into account, if there is no doubt of it.
    pub(super) fn take(&mut self, run: &Run, patches: &[Patch], stamps: &[Stamp]) {
        let Some((k, units)) = run.clear() else {
            return;
        };
        let stamp = &stamps[k];
        // Of two that differ only by their sides the mean is neither, and ticks that are not quite in place are a bar.
        if stamp.is_way() || stamp.mirrored.is_some() || stamp.role == Role::Lattice {
            return;
        }
        let empty = || vec![vec![0; ALONG * ACROSS]; stamp.units];
        let sum = self.sums.entry(k).or_insert_with(|| Sum {
            times: 0,
            ink: [empty(), empty()],
        });
        sum.times += (units.len() / stamp.units) as u32;
        for (at, patch) in patches[units].iter().enumerate() {
            let unit = at % stamp.units;
            for (sums, ink) in sum.ink.iter_mut().zip([&patch.black, &patch.red]) {
                let pairs = sums[unit].iter_mut().zip(ink.by_place());
                pairs.for_each(|(sum, tone)| *sum += u32::from(*tone));
            }
        }
    }

    /// Stamps of what was seen often enough.
    pub(super) fn stamps(&self, stamps: &[Stamp]) -> Vec<Stamp> {
        let units = |k: usize, sum: &Sum| sum.times * stamps[k].units as u32;
        let of_role = |role: Role| {
            let alike = self.sums.iter().filter(|(k, _)| stamps[**k].role == role);
            alike.map(|(k, sum)| units(*k, sum)).sum::<u32>()
        };
        // What is drawn so now and then is something else that looks like it.
        let often = self.sums.iter().filter(|(k, sum)| {
            sum.times >= LEAST && USUAL * units(**k, sum) >= of_role(stamps[**k].role)
        });
        let learnt = often.map(|(k, sum)| {
            let units = stamps[*k].units;
            let mean = |unit: usize, ink: &[u32]| -> Tones {
                let inside = |at: usize| {
                    let i = unit * ALONG + at % ALONG;
                    i >= skip() && i < units * ALONG - skip()
                };
                let tone = |(at, total): (usize, &u32)| match inside(at) {
                    true => (*total / sum.times) as u8,
                    false => 0,
                };
                Tones::new(ink.iter().enumerate().map(tone).collect())
            };
            let of =
                |ink: &Vec<Vec<u32>>| ink.iter().enumerate().map(|(u, i)| mean(u, i)).collect();
            stamps[*k].with_ink([of(&sum.ink[0]), of(&sum.ink[1])])
        });
        learnt.collect()
    }
}
