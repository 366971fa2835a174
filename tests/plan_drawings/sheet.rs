//! A sheet of strokes in units: what the three conventions draw on, and what pixels, SVG and DXF are made of.

use super::rng::Rng;
use super::truth::{Plan, Point, Run};

/// A place on the sheet, x to the right and y down, in units.
pub type Place = (f32, f32);

/// How plans are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Convention {
    /// Modern survey drawings, as in the Kyo-machiya books.
    Survey,
    /// Edo sashizu: black walls, red screens, coloured slips.
    Sashizu,
    /// Carpenters' board plans: dots and lines in ink on wood.
    Itazu,
}

/// Which draughtsman drew it: widths, sizes and habits come from the seed. An `unseen` one has habits that no legend
/// was made for; readers may do worse there, but must not collapse.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Variant {
    /// The draughtsman.
    pub seed: u64,
    /// Whether he has habits of his own.
    pub unseen: bool,
}

/// Colour of a stroke.
pub type Ink = [u8; 3];

/// What a stroke stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash, PartialOrd, Ord)]
pub enum Role {
    /// Coloured slips and hatching of floors.
    Floor,
    /// The unit grid.
    Grid,
    /// Mats.
    Mat,
    /// Stairs, alcoves, stoves, wells.
    Fixture,
    /// Walls.
    Wall,
    /// Sliding and hinged doors.
    Door,
    /// Windows and lattices.
    Window,
    /// Posts.
    Post,
    /// Dimensions outside.
    Dimension,
    /// Pseudo writing.
    Text,
    /// Everything round the house: title, north arrow, garden, frame.
    Margin,
}

impl Role {
    /// The name of its layer in a CAD drawing.
    pub fn layer(self) -> &'static str {
        match self {
            Role::Floor => "FLOOR",
            Role::Grid => "GRID",
            Role::Mat => "MAT",
            Role::Fixture => "FIXTURE",
            Role::Wall => "WALL",
            Role::Door => "DOOR",
            Role::Window => "WINDOW",
            Role::Post => "POST",
            Role::Dimension => "DIM",
            Role::Text => "TEXT",
            Role::Margin => "SITE",
        }
    }
}

/// One stroke or filled shape.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A line through points.
    Line(Vec<Place>),
    /// A closed line.
    Loop(Vec<Place>),
    /// A filled polygon.
    Fill(Vec<Place>),
    /// A filled circle.
    Disc(Place, f32),
    /// A circle.
    Ring(Place, f32),
    /// The shorter arc round a centre from one point to another.
    Arc(Place, Place, Place),
}

/// A shape with its ink; `width` in units.
#[derive(Clone, Debug)]
pub struct Item {
    /// What is drawn.
    pub shape: Shape,
    /// How wide its line is.
    pub width: f32,
    /// Its colour.
    pub ink: Ink,
    /// What it stands for.
    pub role: Role,
}

/// A hand that trembles: how far, in units.
#[derive(Clone, Debug)]
struct Hand {
    tremble: f32,
    rng: Rng,
}

/// The sheet.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Width and height in units.
    pub size: Place,
    /// Where (a, b) = (0, 0) lies.
    pub origin: Place,
    /// The strokes, in the order they are drawn.
    pub items: Vec<Item>,
    hand: Option<Hand>,
}

/// The place of a symbol: `along` the wall, `across` towards the house (outer walls) or either room.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    at: Place,
    along: Place,
    across: Place,
}

impl Frame {
    /// A local place on the sheet.
    pub fn to(&self, p: Place) -> Place {
        (
            self.at.0 + self.along.0 * p.0 + self.across.0 * p.1,
            self.at.1 + self.along.1 * p.0 + self.across.1 * p.1,
        )
    }

    /// A shape of local places on the sheet.
    pub fn shape(&self, shape: &Shape) -> Shape {
        let all = |list: &[Place]| list.iter().map(|&p| self.to(p)).collect();
        match shape {
            Shape::Line(list) => Shape::Line(all(list)),
            Shape::Loop(list) => Shape::Loop(all(list)),
            Shape::Fill(list) => Shape::Fill(all(list)),
            Shape::Disc(c, r) => Shape::Disc(self.to(*c), *r),
            Shape::Ring(c, r) => Shape::Ring(self.to(*c), *r),
            Shape::Arc(c, from, to) => Shape::Arc(self.to(*c), self.to(*from), self.to(*to)),
        }
    }
}

impl Sheet {
    /// An empty sheet with margins left, top, right, bottom in units.
    pub fn new(plan: &Plan, margins: [f32; 4]) -> Self {
        let (w, d) = (plan.width as f32, plan.depth as f32);
        Self {
            size: (w + margins[0] + margins[2], d + margins[1] + margins[3]),
            origin: (margins[0] + w, margins[1] + d),
            items: Vec::new(),
            hand: None,
        }
    }

    /// Draw by hand from now on.
    pub fn by_hand(&mut self, tremble: f32, rng: &mut Rng) {
        self.hand = Some(Hand {
            tremble,
            rng: Rng::new(rng.next(), 7),
        });
    }

    /// A point of the grid on the sheet.
    pub fn at(&self, p: Point) -> Place {
        self.near((p.0 as f32, p.1 as f32))
    }

    /// A place between points of the grid on the sheet.
    pub fn near(&self, p: Place) -> Place {
        (self.origin.0 - p.0, self.origin.1 - p.1)
    }

    /// The frame of a symbol; `flip` turns it to the other side of the wall.
    pub fn frame(&self, run: &Run, flip: bool) -> Frame {
        let (da, db) = (run.along.0 as f32, run.along.1 as f32);
        let side = if flip { -1.0 } else { 1.0 };
        Frame {
            at: self.at(run.from),
            along: (-da, -db),
            across: (db * side, -da * side),
        }
    }

    /// Draw a shape.
    pub fn put(&mut self, role: Role, ink: Ink, width: f32, shape: Shape) {
        let shape = match (&mut self.hand, shape) {
            (Some(hand), Shape::Line(list)) => Shape::Line(hand.shake(&list, false)),
            (Some(hand), Shape::Loop(list)) => Shape::Loop(hand.shake(&list, true)),
            (Some(hand), Shape::Fill(list)) => Shape::Fill(hand.shake(&list, true)),
            (Some(hand), Shape::Disc(c, r)) => Shape::Fill(hand.blot(c, r)),
            (_, shape) => shape,
        };
        self.items.push(Item {
            shape,
            width,
            ink,
            role,
        });
    }

    /// Draw a line between two places.
    pub fn line(&mut self, role: Role, ink: Ink, width: f32, from: Place, to: Place) {
        self.put(role, ink, width, Shape::Line(vec![from, to]));
    }

    /// Draw a line of dashes.
    pub fn dashes(&mut self, role: Role, ink: Ink, width: f32, ends: (Place, Place), dash: f32) {
        let (from, to) = ends;
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let count = ((length / dash / 2.0).round().max(1.0)) as i32;
        let at = |t: f32| (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t);
        for k in 0..count {
            let (start, step) = (k as f32 / count as f32, 1.0 / count as f32);
            self.line(
                role,
                ink,
                width,
                at(start + step * 0.2),
                at(start + step * 0.75),
            );
        }
    }

    /// Draw a symbol of local shapes at its frame.
    pub fn symbol(&mut self, frame: &Frame, role: Role, ink: Ink, width: f32, shapes: &[Shape]) {
        for shape in shapes {
            self.put(role, ink, width, frame.shape(shape));
        }
    }

    /// A stroke of the brush: fat, a little uneven, blunt at its ends.
    pub fn brush(&mut self, role: Role, ink: Ink, width: f32, from: Place, to: Place) {
        let length = (to.0 - from.0).hypot(to.1 - from.1).max(1e-3);
        let (ux, uy) = ((to.0 - from.0) / length, (to.1 - from.1) / length);
        let steps = (length * 1.6).ceil() as usize + 1;
        let side = |k: usize, half: f32| {
            let t = length * k as f32 / steps as f32;
            (from.0 + ux * t - uy * half, from.1 + uy * t + ux * half)
        };
        let mut outline: Vec<Place> = (0..=steps).map(|k| side(k, width / 2.0)).collect();
        outline.extend((0..=steps).rev().map(|k| side(k, -width / 2.0)));
        self.put(role, ink, 0.0, Shape::Fill(outline));
    }
}

impl Hand {
    /// Move every place a little; long straight pieces get a place in between, so that they are not quite straight.
    fn shake(&mut self, list: &[Place], closed: bool) -> Vec<Place> {
        let mut out = Vec::with_capacity(list.len() * 2);
        let ends = if closed { list.len() } else { list.len() - 1 };
        for (k, &p) in list.iter().enumerate() {
            out.push(self.near(p));
            let q = list[(k + 1) % list.len()];
            let length = (q.0 - p.0).hypot(q.1 - p.1);
            let extra = if k < ends && length > 1.2 {
                (length / 1.5).ceil() as usize
            } else {
                1
            };
            for step in 1..extra {
                let t = step as f32 / extra as f32;
                out.push(self.near((p.0 + (q.0 - p.0) * t, p.1 + (q.1 - p.1) * t)));
            }
        }
        out
    }

    fn near(&mut self, p: Place) -> Place {
        (
            p.0 + self.rng.bell() * self.tremble,
            p.1 + self.rng.bell() * self.tremble,
        )
    }

    /// A dot of the brush: not quite round.
    fn blot(&mut self, centre: Place, radius: f32) -> Vec<Place> {
        let centre = self.near(centre);
        (0..10)
            .map(|k| {
                let turn = k as f32 * std::f32::consts::TAU / 10.0;
                let r = radius * (1.0 + self.rng.bell() * 0.1);
                (centre.0 + r * turn.cos(), centre.1 + r * turn.sin())
            })
            .collect()
    }
}
