//! What a drawn house really is: the oracle that a reader of drawings is judged by.

/// A corner of the grid in units of half a ken: `(a, b)`, a to the LEFT along the front, b BACK from the street.
pub type Point = (i32, i32);

/// What stands on one unit of wall.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
pub enum Kind {
    /// Clay, plaster or boards: closed.
    Wall,
    /// Sliding doors: fusuma, shoji, board doors.
    Slide,
    /// A leaf on hinges.
    Hinged,
    /// A window.
    Window,
    /// A lattice.
    Lattice,
    /// Nothing between the posts.
    Open,
}

impl Kind {
    /// The name in the truth files.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Wall => "wall",
            Kind::Slide => "slide",
            Kind::Hinged => "hinged",
            Kind::Window => "window",
            Kind::Lattice => "lattice",
            Kind::Open => "open",
        }
    }
}

/// One unit of wall. Units of one `symbol` are drawn together: a pair of doors is two units of one symbol.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Unit {
    /// Where it begins.
    pub from: Point,
    /// Where it ends, one unit on. Outer units walk with the house on their right.
    pub to: Point,
    /// What stands there.
    pub kind: Kind,
    /// Number of the symbol it belongs to, unique in the plan.
    pub symbol: u32,
}

/// What one walks on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Floor {
    /// Mats.
    Tatami,
    /// Boards.
    Board,
    /// Beaten earth: doma, tori-niwa.
    Earth,
    /// A veranda: a strip of boards along rooms.
    Veranda,
}

/// A rectangle of the grid, `from` the lower corner.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Area {
    /// Least a and b.
    pub from: Point,
    /// Greatest a and b.
    pub to: Point,
}

impl Area {
    /// Units along a.
    pub fn width(&self) -> i32 {
        self.to.0 - self.from.0
    }

    /// Units along b.
    pub fn depth(&self) -> i32 {
        self.to.1 - self.from.1
    }

    /// Its middle.
    pub fn middle(&self) -> (f32, f32) {
        (
            (self.from.0 + self.to.0) as f32 / 2.0,
            (self.from.1 + self.to.1) as f32 / 2.0,
        )
    }

    /// The lower corners of its cells.
    pub fn cells(self) -> impl Iterator<Item = Point> {
        (self.from.1..self.to.1).flat_map(move |b| (self.from.0..self.to.0).map(move |a| (a, b)))
    }
}

/// A room; all are rectangles.
#[derive(Clone, Debug)]
pub struct RoomTruth {
    /// Where it lies.
    pub area: Area,
    /// Its floor.
    pub floor: Floor,
    /// Its mats, two cells each, half mats one.
    pub mats: Vec<Area>,
}

/// What stands in a room.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Furnishing {
    /// Parallel treads with an arrow.
    Stairs,
    /// Tokonoma.
    Alcove,
    /// Oshiire.
    Closet,
    /// Kamado: a bench with round fire holes.
    Stove,
    /// A well.
    Well,
    /// Irori: a square hearth in the floor.
    Hearth,
    /// A privy.
    Privy,
}

/// A thing at its place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Fixture {
    /// What it is.
    pub what: Furnishing,
    /// The cells it fills.
    pub area: Area,
}

/// A house on one storey.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Units along the front.
    pub width: i32,
    /// Units back.
    pub depth: i32,
    /// The corners of the outline, clockwise as seen from above, from the front's right-hand end.
    pub outline: Vec<Point>,
    /// The corners of each courtyard, counter-clockwise (the house is always on the right).
    pub courts: Vec<Vec<Point>>,
    /// Every unit of the outline, in order, then of each courtyard.
    pub outer: Vec<Unit>,
    /// Every unit of wall between two rooms.
    pub inner: Vec<Unit>,
    /// The rooms.
    pub rooms: Vec<RoomTruth>,
    /// What stands in them.
    pub fixtures: Vec<Fixture>,
    /// Where posts stand.
    pub posts: Vec<Point>,
}

/// Neighbouring units of one symbol, drawn as one thing.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// Where it begins.
    pub from: Point,
    /// Which way it goes.
    pub along: Point,
    /// How many units long it is.
    pub length: i32,
    /// What it is.
    pub kind: Kind,
    /// Whether it is part of the outline or of a courtyard.
    pub outer: bool,
}

impl Plan {
    /// The symbols of the plan: outer ones first.
    pub fn runs(&self) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        let mut last = u32::MAX;
        for (unit, outer) in self
            .outer
            .iter()
            .map(|u| (u, true))
            .chain(self.inner.iter().map(|u| (u, false)))
        {
            let along = (unit.to.0 - unit.from.0, unit.to.1 - unit.from.1);
            match runs.last_mut() {
                Some(run) if last == unit.symbol => run.length += 1,
                _ => runs.push(Run {
                    from: unit.from,
                    along,
                    length: 1,
                    kind: unit.kind,
                    outer,
                }),
            }
            last = unit.symbol;
        }
        runs
    }
}
