//! A house under construction: rectangular storeys of bays.

use hsd_base::geometry::STEPS;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{
    Brackets, CodeText, Finial, FinialKind, Measures, Order, Paint, Platform, Posts, RoofKind,
    RoofLine, RoofShape, RoofStyle, Side, StoreyKind, Veranda,
};
use hsd_ir::catalog::Catalog;
use hsd_ir::program::{Content, Drawn, Loop, Split, Storey, Unit, WallLine};

/// The part of a bay, and the bay's width in shaku.
pub(super) type Bay = (&'static str, f64);

/// Widths of bays are whole multiples of this in U, a tenth of a millimetre: walls close exactly, and storeys are
/// centred on each other.
const GRID: f64 = 1e-4;

/// Rounds a length of the plan in U to that grid.
fn units(shaku: f64, unit: f64) -> f64 {
    on_steps((shaku / unit / GRID).round() * GRID)
}

/// Rounds away the errors of sums.
fn on_steps(u: f64) -> f64 {
    let steps = STEPS as f64;
    (u * steps).round() / steps
}

/// A house under construction; lengths in shaku.
pub(in crate::expand) struct Draft<'c> {
    /// The catalogue of its codes.
    catalog: &'c Catalog,
    /// The element that it is made from.
    pub(super) span: Span,
    /// One U in shaku.
    pub(super) unit: f64,
    pub storeys: Vec<Storey>,
    pub(super) platform: Option<Platform>,
    pub(super) finials: Vec<Finial>,
    /// The style of its roofs.
    pub(super) style: RoofStyle,
    /// Written roofs.
    pub(super) lines: Vec<RoofLine>,
    /// Width and depth of the ground storey in U.
    ground: Option<[f64; 2]>,
    /// The rectangle of the last storey in U: a0, b0, a1, b1.
    rect: [f64; 4],
    /// Its top.
    top: f64,
}

/// A rectangular storey, centred on the ground storey.
pub(super) struct DraftStorey<'a> {
    /// Bays of the four walls in walk order, from right to left.
    pub(super) walls: [&'a [Bay]; 4],
    pub(super) height: f64,
    /// Height from its foot to the floor of its veranda, a plain wall.
    pub(super) base: f64,
    pub(super) order: Order,
}

impl<'c> Draft<'c> {
    pub(super) fn new(span: Span, unit: f64, catalog: &'c Catalog) -> Draft<'c> {
        Draft {
            catalog,
            span,
            unit,
            storeys: vec![],
            platform: None,
            finials: vec![],
            style: RoofStyle::default(),
            lines: vec![],
            ground: None,
            rect: [0.0; 4],
            top: 0.0,
        }
    }

    /// Returns the number of its parts.
    pub(super) fn parts(&self) -> u64 {
        let loops = self.storeys.iter().flat_map(|s| &s.loops);
        let lines = loops.flat_map(|l| &l.lines);
        lines.map(|l| l.units.len() as u64).sum()
    }

    /// Adds a storey.
    pub(super) fn storey(&mut self, level: &DraftStorey<'_>) {
        let zone = level.order.brackets.as_ref().map_or(0.0, Brackets::zone);
        // The share of the height above the base.
        let wall = level.height - zone;
        let share = (1.0 - level.base / wall.max(0.1)).clamp(0.05, 1.0);
        let lines: Vec<WallLine> = level
            .walls
            .iter()
            .map(|bays| self.line(bays, share))
            .collect();
        let long = |line: &WallLine| line.units.iter().map(|u| u.width).sum::<f64>();
        let size = [long(&lines[0]), long(&lines[1])];
        let ground = *self.ground.get_or_insert(size);
        let [a, b] = [0, 1].map(|k| on_steps((ground[k] - size[k]) / 2.0));
        self.rect = [a, b, on_steps(a + size[0]), on_steps(b + size[1])];
        let walk = self.walk((a, b), lines, false);
        self.top += level.height;
        self.storeys.push(Storey {
            span: self.span,
            height: level.height,
            kind: StoreyKind::Storey,
            order: level.order.clone(),
            loops: vec![walk],
            rooms: vec![],
            fixtures: vec![],
        });
    }

    /// Adds a square storey with the same bays on every side; `heights` are its base and its height.
    pub(super) fn tier(&mut self, side: &[Bay], heights: (f64, f64), order: Order) {
        let (base, height) = heights;
        self.storey(&DraftStorey {
            walls: [side, side, side, side],
            height,
            base,
            order,
        });
    }

    /// Adds a wall inside the ground storey, parallel to its front, at this distance behind it.
    pub(super) fn inner(&mut self, behind: f64, bays: &[Bay]) {
        let line = self.line(bays, 1.0);
        let start = (0.0, units(behind, self.unit));
        let walk = self.walk(start, vec![line], true);
        if let Some(storey) = self.storeys.last_mut() {
            storey.loops.push(walk);
        }
    }

    /// Adds columns inside the last storey, so far in from its walls, in bays like those of a front and a side.
    pub(super) fn columns(&mut self, inset: [f64; 2], [front, side]: [&[Bay]; 2]) {
        let lines = [front, side, front, side];
        let lines = lines.map(|bays| self.line(bays, 1.0)).into();
        let [a, b] = inset.map(|shaku| units(shaku, self.unit));
        let walk = self.walk((a, b), lines, true);
        if let Some(storey) = self.storeys.last_mut() {
            storey.loops.push(walk);
        }
    }

    fn walk(&self, start: (f64, f64), lines: Vec<WallLine>, inner: bool) -> Loop {
        Loop {
            span: self.span,
            hole: false,
            inner,
            drawn: Drawn::Rows,
            start,
            lines,
        }
    }

    /// Returns a built-in part of the catalogue; a test looks for every code that is used here.
    fn content(&self, code: &str) -> Content {
        let part = self.catalog.find(&CodeText::new(code));
        part.map_or(Content::Void, Content::Part)
    }

    fn line(&self, bays: &[Bay], share: f64) -> WallLine {
        let units = bays.iter().map(|bay| self.bay(*bay, share)).collect();
        WallLine {
            span: self.span,
            units,
            turn: 90.0,
            reflection: false,
        }
    }

    fn bay(&self, (code, width): Bay, share: f64) -> Unit {
        let width = units(width, self.unit);
        let whole = |code: &str| Unit {
            span: self.span,
            width,
            content: self.content(code),
            height: None,
            reflection: None,
            picture: None,
        };
        if share > 0.999 || code == WALL {
            return whole(code);
        }
        let split = Split {
            ratio: share,
            upper: vec![whole(code)],
            lower: vec![whole(WALL)],
        };
        Unit {
            content: Content::Split(Box::new(split)),
            ..whole(code)
        }
    }

    /// Adds a roof over the whole of the last storey; the storey above will cut it.
    pub(super) fn roof(&mut self, style: RoofStyle) {
        self.lines.push(RoofLine {
            span: self.span,
            style,
            direction: None,
            height: self.say(self.top),
            corners: Spanned::new(self.rect, self.span),
        });
    }

    /// Returns a value with the span of the element.
    pub(super) fn say<T>(&self, value: T) -> Option<Spanned<T>> {
        Some(Spanned::new(value, self.span))
    }

    /// Sets the style of all roofs, with defaults.
    pub(super) fn look(&mut self, measures: &Measures, usual: &Usual, paint: Paint) {
        let of = |given: Option<Spanned<f64>>, usual: f64| given.or(self.say(usual));
        self.style = RoofStyle {
            kind: measures.kind.or(self.say(usual.kind)),
            shape: measures.shape.or(self.say(usual.shape)),
            pitch: of(measures.pitch, usual.pitch),
            eaves: of(measures.eaves, usual.eaves),
            verge: self.say(usual.verge),
            thickness: of(measures.thickness, usual.thickness),
            noshi: self.say(usual.noshi),
            sori: of(measures.sori, usual.sori),
            gable: self.say(usual.gable),
            ratio: None,
            plain_ridge: self.say(usual.plain),
            gable_wall: None,
            offset: None,
            paint: self.say(paint),
        };
    }

    /// Adds the platform, unless its height is zero.
    pub(super) fn platform(
        &mut self,
        measures: &Measures,
        height: f64,
        margin: f64,
        stairs: Stairs,
    ) {
        let height = super::or(measures.platform, height);
        let margin = measures.margin.map_or([margin; 2], |m| m.value);
        let (sides, width) = stairs;
        self.platform = (height > 0.0).then_some(Platform {
            span: self.span,
            height,
            margin,
            stairs: sides,
            width: Some(width),
        });
    }

    pub(super) fn finial(&mut self, kind: FinialKind, height: Option<f64>, count: Option<u32>) {
        self.finials.push(Finial {
            span: self.span,
            kind,
            height,
            count,
            at: None,
        });
    }

    pub(super) fn posts(&self, size: f64, paint: Paint, nageshi: u32) -> Option<Posts> {
        Some(Posts {
            span: self.span,
            size,
            round: true,
            paint,
            nageshi,
        })
    }

    pub(super) fn brackets(&self, steps: u32, height: f64, out: f64) -> Option<Brackets> {
        Some(Brackets {
            span: self.span,
            steps,
            height: Some(height),
            out: Some(if steps == 0 { 0.0 } else { out }),
            paint: None,
        })
    }

    pub(super) fn veranda(
        &self,
        width: f64,
        height: f64,
        rail: hsd_ir::ast::Rail,
        stairs: Vec<Side>,
    ) -> Option<Veranda> {
        (width > 0.0).then_some(Veranda {
            span: self.span,
            width,
            height,
            rail,
            stairs,
            paint: None,
        })
    }
}

/// Sides with stairs, and their width.
pub(super) type Stairs = (Vec<Side>, f64);

/// The default style of roofs.
pub(super) struct Usual {
    pub(super) kind: RoofKind,
    pub(super) shape: RoofShape,
    pub(super) pitch: f64,
    pub(super) eaves: f64,
    pub(super) verge: f64,
    pub(super) thickness: f64,
    pub(super) noshi: u32,
    pub(super) sori: f64,
    pub(super) gable: f64,
    /// True if the ridge ends without onigawara.
    pub(super) plain: bool,
}

/// White plaster between posts.
pub(super) const WALL: &str = "KSK";

/// Nothing between columns.
pub(super) const OPEN: &str = "AFU";

/// Returns the doors and the windows between posts: painted as these are, or bare wood.
pub(super) fn joinery(paint: Paint) -> (&'static str, &'static str) {
    match paint {
        Paint::Vermilion | Paint::Bengara => ("TIK", "MRG"),
        _ => ("TIKS", "MRGS"),
    }
}

/// Returns the bays of a side, mirrored: `edge` at the ends, `next` beside them, and this number of `middle` in the
/// middle.
pub(super) fn bays(
    count: u32,
    width: f64,
    edge: &'static str,
    middle: (&'static str, u32),
) -> Vec<Bay> {
    let inner = middle.1.min(count);
    // An even number of bays in the middle of an odd number would be off centre.
    let first = (count - inner) / 2;
    let is_middle = |i: u32| i >= first && i < first + inner;
    (0..count)
        .map(|i| (if is_middle(i) { middle.0 } else { edge }, width))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_known() {
        for code in [
            "KSK", "KOB", "TIK", "TIKS", "TIH", "TSK", "TST", "MRG", "MRGS", "AFU",
        ] {
            let part = hsd_syntax::parse::builtin().find(&CodeText::new(code));
            assert!(part.is_some(), "{code}");
        }
    }

    #[test]
    fn doors_stand_in_the_middle() {
        let codes = |n, m| -> Vec<&str> {
            bays(n, 1.0, "a", ("b", m))
                .into_iter()
                .map(|b| b.0)
                .collect()
        };
        assert_eq!(codes(5, 3), ["a", "b", "b", "b", "a"]);
        assert_eq!(codes(2, 7), ["b", "b"]);
        assert_eq!(codes(1, 0), ["a"]);
    }
}
