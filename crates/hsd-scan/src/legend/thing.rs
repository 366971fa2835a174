//! The symbols of a legend for things in rooms: stairs, wells, stoves.

use super::Values;
use glam::{DVec2, dvec2};

/// A kind of thing in a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ThingKind {
    /// Stairs.
    Stairs,
    /// A closet (oshi-ire).
    Closet,
    /// Clay stoves (kamado).
    Stove,
    /// A well.
    Well,
    /// A sink with its water jar.
    Sink,
    /// An alcove (tokonoma).
    Alcove,
    /// A sunken hearth (irori), which the language does not have.
    Hearth,
    /// A privy, which the language does not have.
    Privy,
}

impl ThingKind {
    /// All kinds with their names in legends, which are those of the language where it has them.
    pub const NAMED: [(&'static str, ThingKind); 8] = [
        ("stairs", ThingKind::Stairs),
        ("oshi-ire", ThingKind::Closet),
        ("kamado", ThingKind::Stove),
        ("well", ThingKind::Well),
        ("sink", ThingKind::Sink),
        ("tokonoma", ThingKind::Alcove),
        ("hearth", ThingKind::Hearth),
        ("privy", ThingKind::Privy),
    ];

    /// The name.
    pub fn name(self) -> &'static str {
        let named = ThingKind::NAMED.iter().find(|(_, kind)| *kind == self);
        named.map_or("", |(name, _)| name)
    }

    /// Whether the language has it as a `Fixture`.
    pub fn is_fixture(self) -> bool {
        !matches!(self, ThingKind::Hearth | ThingKind::Privy)
    }
}

/// The symbol of a thing: x to the right, y down, units, from its upper left corner, with its front at the lower side.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Its kind.
    pub kind: ThingKind,
    /// Its size, whole units.
    pub size: (i32, i32),
    /// Its strokes: each a line through places.
    pub strokes: Vec<Vec<DVec2>>,
    /// The fewest and the most treads; none of what has no treads.
    pub treads: Option<[usize; 2]>,
}

impl Thing {
    pub(super) fn new(values: &Values) -> Result<Thing, String> {
        let named = values.text("kind").ok_or("a <Thing> needs a kind")?;
        let kind = ThingKind::NAMED.iter().find(|(name, _)| *name == named);
        let (_, kind) = kind.ok_or_else(|| format!("`{named}` is no kind of thing"))?;
        let [width, depth] = values
            .pair("size")?
            .unwrap_or([1.0, 1.0])
            .map(|n| n.round().clamp(1.0, 8.0) as i32);
        Ok(Thing {
            kind: *kind,
            size: (width, depth),
            strokes: vec![],
            treads: None,
        })
    }

    /// Takes a mark of it; `None` if there is none of that name.
    pub(super) fn take(&mut self, name: &str, values: &Values) -> Option<Result<(), String>> {
        let taken = match name {
            "Stroke" => self.stroke(values),
            "Frame" => self.frame(values),
            "Ring" => self.ring(values),
            "Arrow" => {
                self.arrow();
                Ok(())
            }
            "Treads" => self.steps(values),
            _ => return None,
        };
        Some(taken)
    }

    fn extent(&self) -> DVec2 {
        dvec2(f64::from(self.size.0), f64::from(self.size.1))
    }

    fn stroke(&mut self, values: &Values) -> Result<(), String> {
        let place = |name: &str| -> Result<DVec2, String> {
            let pair = values.pair(name)?;
            let [x, y] = pair.ok_or_else(|| format!("a <Stroke> needs `{name}`"))?;
            Ok(dvec2(x, y))
        };
        self.strokes.push(vec![place("from")?, place("to")?]);
        Ok(())
    }

    fn frame(&mut self, values: &Values) -> Result<(), String> {
        let inset = values.number("inset")?.unwrap_or(0.0);
        let (low, high) = (DVec2::splat(inset), self.extent() - inset);
        let round = [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y), low];
        self.strokes.push(round.to_vec());
        Ok(())
    }

    fn ring(&mut self, values: &Values) -> Result<(), String> {
        let middle = values.pair("at")?.map_or(self.extent() / 2.0, DVec2::from);
        let radius = values.number("r")?.unwrap_or(0.3);
        let round = (0..=24).map(|k| {
            let turn = std::f64::consts::TAU * f64::from(k) / 24.0;
            middle + radius * dvec2(libm::cos(turn), libm::sin(turn))
        });
        self.strokes.push(round.collect());
        Ok(())
    }

    /// From the front to the back, with its head there.
    fn arrow(&mut self) {
        let (middle, back) = (self.extent().x / 2.0, 0.2);
        let tip = dvec2(middle, back);
        self.strokes
            .push(vec![dvec2(middle, self.extent().y - 0.2), tip]);
        let barb = |side: f64| dvec2(middle + side * 0.13, back + 0.22);
        self.strokes.push(vec![barb(-1.0), tip, barb(1.0)]);
    }

    fn steps(&mut self, values: &Values) -> Result<(), String> {
        let count = values.pair("count")?.unwrap_or([7.0, 11.0]);
        self.treads = Some(count.map(|n| n.clamp(3.0, 24.0) as usize));
        Ok(())
    }

    /// All ways in which it is drawn: one for each number of treads.
    pub fn drawn(&self) -> Vec<Vec<Vec<DVec2>>> {
        let Some([fewest, most]) = self.treads else {
            return vec![self.strokes.clone()];
        };
        let with = |count: usize| {
            let at = |k: usize| self.extent().y * k as f64 / count as f64;
            let across = |k: usize| vec![dvec2(0.0, at(k)), dvec2(self.extent().x, at(k))];
            let treads = (0..=count).map(across);
            treads.chain(self.strokes.iter().cloned()).collect()
        };
        (fewest..=most).map(with).collect()
    }
}
