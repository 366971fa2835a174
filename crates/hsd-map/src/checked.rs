//! Checks what a reader yields, whatever its format, so that a feature that comes out has a usable geometry: finite
//! coordinates that its reference system can hold, no doubled points, closed rings of three corners or more that run the
//! right way round. Rings that cross themselves are reported and kept, since only who uses them knows how to mend them.

mod crossing;

use super::crs::Crs;
use super::fault::{Fault, Kind};
use super::feature::{Area, Chain, Feature, Geometry, Layer, Place};
use super::{Options, Reader};
use hsd_base::budget::{Account, Resource};
use std::collections::HashSet;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Heights of ground and buildings, metres. NaN is outside.
const HEIGHTS: RangeInclusive<f64> = -500.0..=9_000.0;

/// Ids that are remembered to find those that occur twice; 8 bytes each.
const MOST_IDS: usize = 4 << 20;

/// A reader whose features are checked.
pub(super) struct Checked {
    inner: Box<dyn Reader>,
    account: Arc<Account>,
    /// True once the file has exhausted the budget of features.
    is_over: bool,
    file: Arc<str>,
    points: usize,
    remarks: Vec<Fault>,
    ids: Ids,
}

/// The ids seen, as hashes of a fixed function.
#[derive(Default)]
struct Ids {
    seen: HashSet<u64, BuildHasherDefault<DefaultHasher>>,
}

impl Ids {
    /// Returns false if an id was there before.
    fn insert(&mut self, id: &str) -> bool {
        if self.seen.len() == MOST_IDS {
            return true;
        }
        let hasher = BuildHasherDefault::<DefaultHasher>::default();
        self.seen.insert(hasher.hash_one(id))
    }
}

impl Checked {
    pub(super) fn new(
        inner: Box<dyn Reader>,
        account: Arc<Account>,
        file: Arc<str>,
        options: &Options,
    ) -> Checked {
        Checked {
            inner,
            account,
            is_over: false,
            file,
            points: options.limits.points,
            remarks: vec![],
            ids: Ids::default(),
        }
    }

    fn fault(&self, feature: &Feature, kind: Kind) -> Fault {
        let fault = Fault::of_file(&self.file, kind);
        let fault = fault.of_feature(feature.number, feature.id.clone());
        match feature.place {
            Place::Byte(byte) => fault.at(byte),
            Place::Record(_) => fault,
        }
    }

    /// Returns the feature with a usable geometry, or why it has none.
    fn check(&mut self, mut feature: Feature) -> Result<Feature, Fault> {
        let crs = self.inner.layer().crs.as_ref();
        if let Some(kind) = refusal(&feature.geometry, crs, self.points) {
            return Err(self.fault(&feature, kind));
        }
        if crs.is_some_and(Crs::is_degrees) {
            feature.geometry.chains_mut().for_each(unwrap);
        }
        let geometry = std::mem::replace(&mut feature.geometry, Geometry::Lines(vec![]));
        let remarks = match tidied(geometry) {
            Ok((geometry, remarks)) => {
                feature.geometry = geometry;
                remarks
            }
            Err(kind) => return Err(self.fault(&feature, kind)),
        };
        for kind in remarks {
            let remark = self.fault(&feature, kind);
            self.remarks.push(remark);
        }
        if let Some(id) = &feature.id
            && !self.ids.insert(id)
        {
            let remark = self.fault(&feature, Kind::DuplicateKey);
            self.remarks.push(remark);
        }
        Ok(feature)
    }
}

impl Iterator for Checked {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over {
            return None;
        }
        let found = self.inner.next()?;
        // Features that cannot be used are kept too, as faults.
        if let Err(exhausted) = self.account.charge(Resource::Features, 1) {
            self.is_over = true;
            return Some(Err(Fault::of_file(&self.file, exhausted.into())));
        }
        Some(found.and_then(|feature| self.check(feature)))
    }
}

impl Reader for Checked {
    fn layer(&self) -> &Layer {
        self.inner.layer()
    }

    fn remarks(&mut self) -> Vec<Fault> {
        let mut remarks = self.inner.remarks();
        remarks.append(&mut self.remarks);
        remarks
    }
}

/// Returns why the coordinates cannot be used, if they cannot.
fn refusal(geometry: &Geometry, crs: Option<&Crs>, most: usize) -> Option<Kind> {
    let count: usize = geometry.chains().map(|chain| chain.points.len()).sum();
    if count > most {
        let (what, limit) = ("points of a feature", most as u64);
        return Some(Kind::TooLarge { what, limit });
    }
    // The system may be found out later; numbers that are too large for any system are rejected here.
    let local = Crs::local();
    let crs = crs.unwrap_or(&local);
    for p in geometry.points() {
        if !p.is_finite() {
            return Some(Kind::NotFinite);
        }
        if let Some(seems) = crs.refuses(p) {
            let (x, y, crs) = (p.x, p.y, crs.name.clone());
            return Some(Kind::OutsideCrs { x, y, crs, seems });
        }
    }
    None
}

/// Extends longitudes beyond 180 degrees where a shape crosses the line at which they jump to -180. Shapes are narrower than
/// half the globe.
fn unwrap(chain: &mut Chain) {
    let longitudes = chain.points.iter().map(|p| p.x);
    let (low, high) = longitudes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    if high - low > 180.0 {
        for p in chain.points.iter_mut().filter(|p| p.x < 0.0) {
            p.x += 360.0;
        }
    }
}

/// What was found while a geometry was tidied.
#[derive(Default)]
struct Found {
    doubled: usize,
    is_unclosed: bool,
    crosses: bool,
    /// The most pairs of sides that are compared to find crossings, if there are more.
    compared: Option<usize>,
    /// The number of missing heights.
    no_heights: usize,
    /// Parts that were dropped, since they have too few points.
    dropped: usize,
    /// The points of the largest of them.
    most_points: usize,
}

impl Found {
    fn kinds(&self) -> impl Iterator<Item = Kind> {
        let points = self.doubled;
        let doubled = (points > 0).then_some(Kind::DoubledPoints { points });
        let parts = self.dropped;
        let dropped = (parts > 0).then_some(Kind::DroppedParts { parts });
        let unclosed = self.is_unclosed.then_some(Kind::Unclosed);
        let crossing = self.crosses.then_some(Kind::Crossing);
        let points = self.no_heights;
        let heights = (points > 0).then_some(Kind::NoHeights { points });
        let all = [doubled, dropped, unclosed, crossing, heights];
        all.into_iter().flatten()
    }

    fn drop_part(&mut self, points: usize) {
        self.dropped += 1;
        self.most_points = self.most_points.max(points);
    }
}

/// Returns true if sides of an area cross, or lie on each other.
///
/// # Errors
/// The limit, if more pairs of sides would have to be compared.
pub fn crosses(area: &Area) -> Result<bool, usize> {
    crossing::crosses(area)
}

/// Returns a geometry without doubled points and parts that are none, its rings the right way round, and what was found.
///
/// # Errors
/// If nothing is left, or its sides are too many in one place.
pub fn tidied(mut geometry: Geometry) -> Result<(Geometry, Vec<Kind>), Kind> {
    let mut found = Found::default();
    match tidy(&mut geometry, &mut found) {
        true => match found.compared {
            None => Ok((geometry, found.kinds().collect())),
            Some(most) => Err(Kind::TooLarge {
                what: "pairs of sides near each other",
                limit: most as u64,
            }),
        },
        false => Err(match found.most_points {
            0 => Kind::NoGeometry,
            points => Kind::TooFewPoints { points },
        }),
    }
}

/// Tidies a geometry; returns whether anything is left.
fn tidy(geometry: &mut Geometry, found: &mut Found) -> bool {
    match geometry {
        Geometry::Points(points) => {
            settle_heights(points, found);
            !points.points.is_empty()
        }
        Geometry::Lines(lines) => {
            lines.retain_mut(|line| {
                settle_heights(line, found);
                found.doubled += drop_doubled(line);
                let is_line = line.points.len() > 1;
                if !is_line {
                    found.drop_part(line.points.len());
                }
                is_line
            });
            !lines.is_empty()
        }
        Geometry::Areas(areas) => {
            areas.retain_mut(|area| tidy_area(area, found));
            !areas.is_empty()
        }
    }
}

fn tidy_area(area: &mut Area, found: &mut Found) -> bool {
    if !tidy_ring(&mut area.outline, found, false) {
        return false;
    }
    area.holes.retain_mut(|hole| tidy_ring(hole, found, true));
    match crossing::crosses(area) {
        Ok(crosses) => found.crosses |= crosses,
        Err(most) => found.compared = Some(most),
    }
    true
}

/// Opens, cleans and turns a ring; returns whether it encloses anything.
fn tidy_ring(ring: &mut Chain, found: &mut Found, is_hole: bool) -> bool {
    settle_heights(ring, found);
    let is_closed = ring.points.len() > 1 && ring.points.first() == ring.points.last();
    if is_closed {
        ring.points.pop();
        ring.heights.pop();
    }
    let before = ring.points.len();
    found.doubled += drop_doubled(ring);
    if ring.points.len() < 3 {
        found.drop_part(ring.points.len());
        return false;
    }
    found.is_unclosed |= !is_closed && before > 0;
    if (ring.signed_area() < 0.0) != is_hole {
        ring.reverse();
    }
    true
}

/// Drops heights that are not given for every point. Marks of programs for missing values become the mean of the others.
fn settle_heights(chain: &mut Chain, found: &mut Found) {
    if chain.heights.len() != chain.points.len() {
        chain.heights.clear();
    }
    let is_height = |z: &f64| HEIGHTS.contains(z);
    let (sum, known) = chain
        .heights
        .iter()
        .filter(|z| is_height(z))
        .fold((0.0, 0_usize), |(sum, count), z| (sum + z, count + 1));
    let missing = chain.heights.len() - known;
    if missing == 0 {
        return;
    }
    found.no_heights += missing;
    if known == 0 {
        chain.heights.clear();
        return;
    }
    for z in chain.heights.iter_mut().filter(|z| !is_height(z)) {
        *z = sum / known as f64;
    }
}

/// Drops points that stand on the one before; returns how many.
fn drop_doubled(chain: &mut Chain) -> usize {
    let before = chain.points.len();
    if chain.points.windows(2).all(|w| w[0] != w[1]) {
        return 0;
    }
    let is_new = |at: usize| at == 0 || chain.points[at] != chain.points[at - 1];
    let kept: Vec<usize> = (0..before).filter(|at| is_new(*at)).collect();
    let has_heights = !chain.heights.is_empty();
    *chain = Chain {
        points: kept.iter().map(|at| chain.points[*at]).collect(),
        heights: match has_heights {
            true => kept.iter().map(|at| chain.heights[*at]).collect(),
            false => vec![],
        },
    };
    before - chain.points.len()
}
