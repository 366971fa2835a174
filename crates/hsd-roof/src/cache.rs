//! Roofs of houses with the same plan are made once: rows and towns repeat their houses, and roofs are the most
//! expensive step.
//!
//! The key is everything that roofs depend on, to the last bit, without places in the source and without the house's
//! origin and azimuth. Cached roofs are in the house frame, so they fit every house of the key; only places are
//! replaced by those of the other house. Hence a house does not depend on the cache. A cache owns what it keeps and can
//! move to another thread.

use glam::DVec2;
use hsd_base::diagnostic::{Diagnostic, Origin};
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{RoofLine, RoofShape, RoofStyle};
use hsd_ir::building::{House, HouseRoofs, Ring, Roof, Storey, Wall};
use hsd_ir::program::Roofs;
use std::collections::HashMap;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maximum size of a cache in words of 8 bytes, approximately: 4 MiB. Beyond it everything is dropped, since similar
/// houses tend to be near each other.
const MOST_WORDS: usize = 1 << 19;

/// The same of what is kept from run to run: 64 MiB.
const MOST_KEPT: usize = 1 << 23;

/// Everything that the roofs of a house depend on, to the last bit.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Key {
    /// The hash of all words, computed once: a key is looked up first and inserted afterwards.
    hash: u64,
    words: Box<[u64]>,
}

impl Hash for Key {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash);
    }
}

/// The roofs of the houses roofed so far, by key.
pub struct RoofCache {
    /// Only looked up, never iterated over, so its order cannot matter.
    kept: HashMap<Key, Arc<Kept>>,
    words: usize,
    most: usize,
    /// True if roofs are made for what is seen of them from afar.
    afar: bool,
    /// Where it looks for what it does not know.
    others: Option<KeptRoofs>,
}

/// Roofs that are kept from run to run: an editor reads a source file again at every key, and one house of it has
/// changed. A copy refers to the same roofs; all threads may use it.
#[derive(Clone)]
pub struct KeptRoofs(Arc<Mutex<RoofCache>>);

/// The roofs of a house.
struct Kept {
    roofs: Arc<HouseRoofs>,
    diagnostics: Vec<Diagnostic>,
    /// The places of that house as [`places`] lists them; empty if neither roofs nor diagnostics have any.
    places: Box<[Span]>,
}

impl RoofCache {
    /// Returns the same cache, for roofs of which nothing is asked but what is seen from afar.
    #[must_use]
    pub fn from_afar(self, afar: bool) -> RoofCache {
        RoofCache { afar, ..self }
    }

    pub(super) fn is_from_afar(&self) -> bool {
        self.afar
    }

    /// Returns the roofs and diagnostics kept for this key, with the places of this house. `None` if there are none, or
    /// if a place is ambiguous.
    pub(super) fn find(
        &self,
        house: &House,
        key: &Key,
    ) -> Option<(Arc<HouseRoofs>, Vec<Diagnostic>)> {
        let kept = self.kept.get(key).cloned();
        let kept = kept.or_else(|| self.others.as_ref()?.find(key))?;
        let mut roofs = Arc::clone(&kept.roofs);
        let mut diagnostics = kept.diagnostics.clone();
        if !kept.places.is_empty() {
            let pairs = pairs(&kept.places, &places(house))?;
            let mut known = true;
            let exchange = |place: &mut Span| match pairs.get(place) {
                Some(other) => *place = *other,
                None => known = false,
            };
            let all = roof_places(&mut roofs).chain(message_places(&mut diagnostics));
            all.for_each(exchange);
            if !known {
                return None;
            }
        }
        Some((roofs, diagnostics))
    }

    /// Keeps the roofs of a house and their diagnostics.
    pub(super) fn keep(
        &mut self,
        key: Key,
        house: &House,
        roofs: &Arc<HouseRoofs>,
        diagnostics: &[Diagnostic],
    ) {
        let placed = !diagnostics.is_empty() || roofs.roofs.iter().any(|r| r.span.is_some());
        let places = if placed { places(house) } else { vec![] };
        let kept = Arc::new(Kept {
            roofs: Arc::clone(roofs),
            diagnostics: diagnostics.to_vec(),
            places: places.into(),
        });
        if let Some(others) = &self.others {
            others.lock().insert(key.clone(), kept.clone());
        }
        self.insert(key, kept);
    }

    fn new(most: usize, others: Option<KeptRoofs>) -> RoofCache {
        RoofCache {
            kept: HashMap::new(),
            words: 0,
            most,
            afar: false,
            others,
        }
    }

    fn insert(&mut self, key: Key, kept: Arc<Kept>) {
        let words = key.words.len() + kept.words();
        if self.words + words > self.most {
            self.kept.clear();
            self.words = 0;
        }
        if words <= self.most {
            self.words += words;
            self.kept.insert(key, kept);
        }
    }
}

impl Default for RoofCache {
    fn default() -> RoofCache {
        RoofCache::new(MOST_WORDS, None)
    }
}

impl KeptRoofs {
    /// Returns a cache for some houses of a run that knows these roofs, and adds its own to them.
    pub fn cache(&self) -> RoofCache {
        RoofCache::new(MOST_WORDS, Some(self.clone()))
    }

    fn find(&self, key: &Key) -> Option<Arc<Kept>> {
        self.lock().kept.get(key).cloned()
    }

    fn lock(&self) -> MutexGuard<'_, RoofCache> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Default for KeptRoofs {
    fn default() -> KeptRoofs {
        KeptRoofs(Arc::new(Mutex::new(RoofCache::new(MOST_KEPT, None))))
    }
}

impl fmt::Debug for KeptRoofs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("KeptRoofs").finish_non_exhaustive()
    }
}

impl Kept {
    /// Returns its approximate size in words of 8 bytes.
    fn words(&self) -> usize {
        let solids = self.roofs.roofs.iter().flat_map(Roof::bodies);
        let soffits = self.roofs.soffits.iter().flat_map(|s| &s.solids);
        let solids = solids.chain(soffits);
        let solids: usize = solids.map(|s| 3 * s.points.len() + 6 * s.faces.len()).sum();
        32 + solids + 64 * self.diagnostics.len() + 2 * self.places.len()
    }
}

/// Returns the places of roofs. Shared roofs are copied only if they have some.
fn roof_places(roofs: &mut Arc<HouseRoofs>) -> impl Iterator<Item = &mut Span> {
    let placed = roofs.roofs.iter().any(|r| r.span.is_some());
    let own = placed.then(|| Arc::make_mut(roofs));
    let roofs = own.into_iter().flat_map(|own| &mut own.roofs);
    roofs.filter_map(|roof| roof.span.as_mut())
}

/// Returns the places of diagnostics, including those of their fixes.
fn message_places(diagnostics: &mut [Diagnostic]) -> impl Iterator<Item = &mut Span> {
    diagnostics.iter_mut().flat_map(|diagnostic| {
        let Diagnostic {
            origin,
            labels,
            fixes,
            ..
        } = diagnostic;
        let place = match origin {
            Origin::Source(span) => Some(span),
            Origin::Feature { .. } => None,
        };
        let labels = labels.iter_mut().map(|label| &mut label.span);
        let edits = fixes.iter_mut().flat_map(|fix| &mut fix.edits);
        let edits = edits.map(|edit| &mut edit.span);
        place.into_iter().chain(labels).chain(edits)
    })
}

/// Returns every place of a house that its roofs or their diagnostics may have, in one order for all houses of a key.
fn places(house: &House) -> Vec<Span> {
    let mut spans = vec![house.span];
    spans.extend(house.roofs.wished);
    style_spans(&house.roofs.style, &mut spans);
    for line in &house.roofs.lines {
        spans.extend([line.span, line.corners.span]);
        spans.extend(line.direction.map(|d| d.span));
        spans.extend(line.height.map(|h| h.span));
        style_spans(&line.style, &mut spans);
    }
    for storey in &house.storeys {
        spans.push(storey.span);
        for ring in &storey.rings {
            spans.push(ring.span);
            spans.extend(ring.walls.iter().map(|w| w.span));
        }
    }
    spans
}

fn style_spans(style: &RoofStyle, spans: &mut Vec<Span>) {
    let numbers = [
        style.pitch,
        style.eaves,
        style.verge,
        style.thickness,
        style.sori,
        style.gable,
        style.ratio,
        style.offset,
    ];
    spans.extend(style.kind.map(|k| k.span));
    spans.extend(style.shape.map(|s| s.span));
    spans.extend(numbers.into_iter().flatten().map(|n| n.span));
    spans.extend(style.noshi.map(|n| n.span));
    spans.extend(style.plain_ridge.map(|p| p.span));
    spans.extend(style.gable_wall.map(|w| w.span));
    spans.extend(style.paint.map(|p| p.span));
}

/// Returns the place in one house of each place in another; `None` if one place corresponds to two.
fn pairs(from: &[Span], to: &[Span]) -> Option<HashMap<Span, Span>> {
    let mut pairs = HashMap::with_capacity(from.len());
    let mut plain = from.len() == to.len();
    for (from, to) in from.iter().zip(to) {
        plain &= pairs.insert(*from, *to).is_none_or(|known| known == *to);
    }
    plain.then_some(pairs)
}

impl Key {
    pub(super) fn of(house: &House, afar: bool) -> Key {
        // All fields are named, so that the compiler rejects a new one here.
        let House {
            span: _,
            name: _,
            placed: _,
            variant: _,
            origin: _,
            azimuth: _,
            age: _,
            unit,
            street,
            storeys,
            raised: _,
            plinth: _,
            platform: _,
            finials: _,
            puts: _,
            grounds: _,
            outdoors: _,
            roofs,
        } = house;
        let Roofs {
            mode,
            method,
            wished,
            style,
            by_use: _,
            lines,
            slant_told,
        } = &**roofs;
        let mut words = Words(Vec::with_capacity(64));
        words.number(*unit);
        words.flags(&[*street, wished.is_some(), *slant_told, afar]);
        words.0.extend([*mode as u64, *method as u64]);
        words.style(style);
        words.0.push(lines.len() as u64);
        lines.iter().for_each(|line| words.line(line));
        storeys.iter().for_each(|storey| words.storey(storey));
        let pent = |line: &RoofLine| line.style.shape.is_some_and(|s| s.value == RoofShape::Pent);
        if *street || lines.iter().any(pent) {
            storeys.iter().for_each(|storey| words.posts(storey));
        }
        const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
        let mixed = |hash: u64, word: &u64| (hash.rotate_left(26) ^ word).wrapping_mul(ODD);
        Key {
            hash: words.0.iter().fold(0, mixed),
            words: words.0.into(),
        }
    }
}

struct Words(Vec<u64>);

impl Words {
    fn number(&mut self, number: f64) {
        self.0.push(number.to_bits());
    }

    fn point(&mut self, p: DVec2) {
        self.number(p.x);
        self.number(p.y);
    }

    fn flags(&mut self, flags: &[bool]) {
        let bits = flags
            .iter()
            .fold(1, |bits, flag| bits << 1 | u64::from(*flag));
        self.0.push(bits);
    }

    fn wish<T: Copy>(&mut self, wish: &Option<Spanned<T>>, word: impl Fn(T) -> u64) {
        self.flags(&[wish.is_some()]);
        self.0.extend(wish.as_ref().map(|w| word(w.value)));
    }

    fn style(&mut self, style: &RoofStyle) {
        let RoofStyle {
            kind,
            shape,
            pitch,
            eaves,
            verge,
            thickness,
            noshi,
            sori,
            gable,
            ratio,
            plain_ridge,
            gable_wall,
            offset,
            paint,
        } = style;
        self.wish(kind, |kind| kind as u64);
        self.wish(shape, |shape| shape as u64);
        for length in [pitch, eaves, verge, thickness, sori, gable, ratio, offset] {
            self.wish(length, f64::to_bits);
        }
        self.wish(noshi, u64::from);
        self.wish(plain_ridge, u64::from);
        self.wish(gable_wall, |wall| wall as u64);
        self.wish(paint, |paint| paint as u64);
    }

    fn line(&mut self, line: &RoofLine) {
        let RoofLine {
            span: _,
            style,
            direction,
            height,
            corners,
        } = line;
        self.style(style);
        self.wish(direction, |direction| direction as u64);
        self.wish(height, f64::to_bits);
        corners.value.iter().for_each(|u| self.number(*u));
    }

    fn storey(&mut self, storey: &Storey) {
        let Storey {
            span: _,
            number,
            kind,
            z0,
            z1,
            order: _,
            rings,
            rooms: _,
            fixtures: _,
        } = storey;
        self.0
            .extend([u64::from(*number), *kind as u64, rings.len() as u64]);
        self.number(*z0);
        self.number(*z1);
        rings.iter().for_each(|ring| self.ring(ring));
    }

    /// The places of posts, on which the arms of pent roofs stand.
    fn posts(&mut self, storey: &Storey) {
        let walls = storey.rings.iter().flat_map(|ring| &ring.walls);
        for unit in walls.flat_map(|wall| &wall.units) {
            self.number(unit.width);
        }
    }

    fn ring(&mut self, ring: &Ring) {
        let Ring {
            span: _,
            hole,
            closed,
            inner,
            walls,
        } = ring;
        self.flags(&[*hole, *closed, *inner]);
        self.0.push(walls.len() as u64);
        for wall in walls {
            let Wall {
                span: _,
                facade,
                from,
                to,
                direction,
                units: _,
                reflection: _,
            } = wall;
            self.0.push(u64::from(*facade));
            self.point(*from);
            self.point(*to);
            self.point(*direction);
        }
    }
}
