//! The grounds of a town. Those of some thousand houses are kept; more go to a spool, district by district, so that the
//! memory they take does not grow with the town.

use super::{Ground, Grounds, Met, Near, PASSAGE};
use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Span;
use hsd_export::spool::{NewSpool, Spool};
use hsd_passes::messages::plan::{gap_in_wall, in_each_other};
use std::collections::BTreeMap;
use std::io::{self, SeekFrom};
use std::mem;

/// The grounds that are kept in memory.
const KEPT: usize = 1 << 14;

/// The number of districts.
const DISTRICTS: usize = 64;

/// The side of the squares that districts consist of, metres.
const SQUARE: f64 = 256.0;

/// The squares of a house beyond which it is put into all districts.
const SQUARES: i64 = 1024;

/// The bytes of a district that go to the spool at a time.
const BLOCK: usize = 1 << 14;

/// The grounds of all houses of a run.
pub(crate) struct SpilledGrounds<'n> {
    kept: Grounds,
    new: NewSpool<'n>,
    spilled: Option<Spilled>,
    count: u32,
}

/// Grounds in a spool.
struct Spilled {
    spool: Box<dyn Spool>,
    length: u64,
    districts: Vec<District>,
}

/// A district: the squares with the same remainder, all over the town.
#[derive(Default)]
struct District {
    /// Its blocks in the spool: start and length.
    blocks: Vec<(u64, usize)>,
    /// Its end, which is not in the spool yet.
    pending: Vec<u8>,
}

/// A house in a message: its place and its name.
type Place = (Span, Box<str>);

impl<'n> SpilledGrounds<'n> {
    /// Creates the list; `together` = houses of different files stand in one scene.
    pub(crate) fn new(together: bool, new: NewSpool<'n>) -> SpilledGrounds<'n> {
        SpilledGrounds {
            kept: Grounds::new(together),
            new,
            spilled: None,
            count: 0,
        }
    }

    /// Adds houses, in their order.
    ///
    /// # Errors
    /// Those of the spool.
    pub(crate) fn add(&mut self, grounds: impl IntoIterator<Item = Ground>) -> io::Result<()> {
        self.kept.add(grounds);
        if self.kept.list.len() < KEPT {
            return Ok(());
        }
        let spilled = match &mut self.spilled {
            Some(spilled) => spilled,
            none => none.insert(Spilled {
                spool: (self.new)()?,
                length: 0,
                districts: (0..DISTRICTS).map(|_| District::default()).collect(),
            }),
        };
        for ground in self.kept.list.drain(..) {
            spilled.add(&ground, self.count)?;
            self.count += 1;
        }
        Ok(())
    }

    /// Reports what is wrong, as [`Grounds::report`] does.
    ///
    /// # Errors
    /// Those of the spool.
    pub(crate) fn report(
        mut self,
        head: impl Fn(Span) -> Span,
        out: &mut Diagnostics,
    ) -> io::Result<()> {
        let Some(mut spilled) = self.spilled else {
            self.kept.report(head, out);
            return Ok(());
        };
        for ground in self.kept.list.drain(..) {
            spilled.add(&ground, self.count)?;
            self.count += 1;
        }
        let (mut met, mut gaps) = (BTreeMap::new(), vec![]);
        for district in 0..DISTRICTS {
            let (numbers, list) = spilled.read(district)?;
            let grounds = Grounds {
                list,
                together: self.kept.together,
            };
            let place = |number: u32| -> Place {
                let ground = &grounds.list[number as usize];
                (ground.span, ground.name.clone())
            };
            let found = grounds.findings(|end| district_of(square(end)) == district);
            for Met { own, other, shared } in found.met {
                let number = |local: u32| numbers[local as usize];
                let first = (number(other), shared, [own, other].map(place));
                // Of those in several districts the one written first.
                let known = met.entry(number(own)).or_insert_with(|| first.clone());
                if first.0 < known.0 {
                    *known = first;
                }
            }
            for Near { own, other, length } in found.gaps {
                gaps.push((numbers[own as usize], length, [own, other].map(place)));
            }
        }
        gaps.sort_by_key(|gap| gap.0);
        for (_, shared, [(own, name), (other, second)]) in met.into_values() {
            out.push(in_each_other(
                [own, other].map(&head),
                [&*name, &*second],
                shared,
            ));
        }
        for (_, length, [(own, name), (other, second)]) in gaps {
            out.push(gap_in_wall(
                [own, other].map(&head),
                [&*name, &*second],
                length,
            ));
        }
        Ok(())
    }
}

impl Spilled {
    /// Puts a ground into all districts that it, or a wall that ends before it, lies in.
    fn add(&mut self, ground: &Ground, number: u32) -> io::Result<()> {
        let mut bytes = vec![];
        ground.write(number, &mut bytes);
        for district in districts(ground.low - PASSAGE, ground.high + PASSAGE) {
            let District { blocks, pending } = &mut self.districts[district];
            pending.extend_from_slice(&bytes);
            if pending.len() >= BLOCK {
                self.spool.write_all(pending)?;
                blocks.push((self.length, pending.len()));
                self.length += pending.len() as u64;
                pending.clear();
            }
        }
        Ok(())
    }

    /// Returns the grounds of a district in the order of their numbers.
    fn read(&mut self, district: usize) -> io::Result<(Vec<u32>, Vec<Ground>)> {
        let District { blocks, pending } = mem::take(&mut self.districts[district]);
        let mut grounds = vec![];
        let mut bytes = vec![];
        for (start, length) in blocks {
            bytes.resize(length, 0);
            self.spool.seek(SeekFrom::Start(start))?;
            self.spool.read_exact(&mut bytes)?;
            let mut rest = &bytes[..];
            grounds.extend(std::iter::from_fn(|| Ground::read(&mut rest)));
        }
        let mut rest = &pending[..];
        grounds.extend(std::iter::from_fn(|| Ground::read(&mut rest)));
        Ok(grounds.into_iter().unzip())
    }
}

fn square(p: DVec2) -> (i64, i64) {
    ((p.x / SQUARE).floor() as i64, (p.y / SQUARE).floor() as i64)
}

/// Returns the district of a square: neighbours have different ones.
fn district_of((x, y): (i64, i64)) -> usize {
    (x.rem_euclid(8) * 8 + y.rem_euclid(8)) as usize
}

/// Returns the districts of a rectangle, each once.
fn districts(low: DVec2, high: DVec2) -> Vec<usize> {
    let ((x0, y0), (x1, y1)) = (square(low), square(high));
    let side = |from: i64, to: i64| to.saturating_sub(from).saturating_add(1);
    if side(x0, x1).saturating_mul(side(y0, y1)) > SQUARES {
        return (0..DISTRICTS).collect();
    }
    let all = (x0..=x1).flat_map(|x| (y0..=y1).map(move |y| district_of((x, y))));
    let mut all: Vec<usize> = all.collect();
    all.sort_unstable();
    all.dedup();
    all
}
