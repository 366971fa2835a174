//! What stands on paper: marks with their roles, views made of them, and sheets on which views stand.
//!
//! Frame of a view: millimetres on paper, x to the right, y up; the origin lies where that of the model is seen. On a sheet
//! the same, from its lower left corner.

use glam::{DVec2, dvec2};
use std::sync::Arc;

/// What a mark stands for: the layer of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// The middle of each bay's wall, with the code of its part.
    Axis,
    /// Edges of what lies beyond the cut, or is seen in an elevation.
    Seen,
    /// Edges of mats.
    Mat,
    /// Cut floors, verandas, platforms.
    Floor,
    /// Cut roofs.
    Roof,
    /// Cut beams, brackets, ornaments.
    Timber,
    /// Cut walls, and bays of them.
    Wall,
    /// Cut doors.
    Door,
    /// Cut windows and lattices.
    Window,
    /// Bays that stand open.
    Open,
    /// Cut posts.
    Post,
    /// Ridges and hips.
    Ridge,
    /// Valleys.
    Valley,
    /// Arrows down the slopes.
    Fall,
    /// The ground.
    Ground,
    /// Where sections are cut.
    Section,
    /// Lines of dimensions and their figures.
    Dimension,
    /// Titles and names.
    Text,
    /// North arrow, frame and title block.
    Frame,
}

impl Role {
    /// All roles, those below first.
    pub const ALL: [Role; 19] = [
        Role::Axis,
        Role::Seen,
        Role::Mat,
        Role::Floor,
        Role::Roof,
        Role::Timber,
        Role::Wall,
        Role::Door,
        Role::Window,
        Role::Open,
        Role::Post,
        Role::Ridge,
        Role::Valley,
        Role::Fall,
        Role::Ground,
        Role::Section,
        Role::Dimension,
        Role::Text,
        Role::Frame,
    ];

    /// The word in `data-role` and the name of the layer.
    pub fn word(self) -> &'static str {
        match self {
            Role::Axis => "axis",
            Role::Seen => "seen",
            Role::Mat => "mat",
            Role::Floor => "floor",
            Role::Roof => "roof",
            Role::Timber => "timber",
            Role::Wall => "wall",
            Role::Door => "door",
            Role::Window => "window",
            Role::Open => "open",
            Role::Post => "post",
            Role::Ridge => "ridge",
            Role::Valley => "valley",
            Role::Fall => "fall",
            Role::Ground => "ground",
            Role::Section => "section",
            Role::Dimension => "dimension",
            Role::Text => "text",
            Role::Frame => "frame",
        }
    }

    /// The width of its lines, millimetres: 0.13 fine, 0.25 medium, 0.5 heavy (ISO 128-20).
    pub fn pen(self) -> f64 {
        match self {
            Role::Axis | Role::Seen | Role::Mat | Role::Fall | Role::Dimension | Role::Open => 0.13,
            Role::Door | Role::Window | Role::Floor | Role::Valley | Role::Section => 0.18,
            Role::Roof | Role::Timber | Role::Wall | Role::Post => 0.35,
            Role::Ridge | Role::Frame | Role::Text => 0.25,
            Role::Ground => 0.5,
        }
    }

    /// The grey of its areas, from 0, black, to 1, paper.
    pub fn fill(self) -> f64 {
        match self {
            Role::Post | Role::Text | Role::Fall | Role::Frame | Role::Dimension => 0.0,
            Role::Wall => 0.45,
            Role::Timber => 0.72,
            Role::Roof => 0.85,
            Role::Floor | Role::Mat => 0.93,
            _ => 1.0,
        }
    }

    /// The lengths of dashes and gaps of its lines, millimetres; none if they are drawn through.
    pub fn dashes(self) -> &'static [f64] {
        match self {
            Role::Axis => &[3.0, 0.8, 0.4, 0.8],
            Role::Section => &[6.0, 1.2, 1.2, 1.2],
            Role::Valley => &[2.0, 0.8],
            _ => &[],
        }
    }
}

/// A place at the foot of a line of text that the text is set to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The text begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The place of its anchor, on the base line.
    pub at: DVec2,
    /// The text.
    pub text: String,
    /// The height of its letters from the base line to the top of a kanji, millimetres.
    pub size: f64,
    /// What stands at `at`.
    pub anchor: Anchor,
    /// True if it runs upwards.
    pub upward: bool,
}

/// The shape of a mark.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Separate lines.
    Lines(Vec<[DVec2; 2]>),
    /// An area between rings, filled in its role's grey and outlined. The area lies to the left of the rings; overlapping
    /// rings count once.
    Area(Vec<Vec<DVec2>>),
    /// The outlines of letters, filled by the even-odd rule and not outlined.
    Letters(Vec<Vec<DVec2>>),
    /// A text.
    Label(Label),
}

/// Something drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it stands for.
    pub role: Role,
    /// The code of the part that it shows, if it shows one.
    pub code: Option<String>,
    /// Further attributes of its group in SVG, from which `hsd plan` reads the house again.
    pub facts: Option<Arc<Facts>>,
    /// Its shape.
    pub shape: Shape,
}

/// Attributes of a group of marks in SVG, without `data-`: which house, wall or room it shows. Lengths are units of the house
/// (heights shaku), places in its own plan.
pub type Facts = Vec<(&'static str, String)>;

/// Returns the lines of an arrow with an open head, millimetres.
pub fn arrow(from: DVec2, tip: DVec2) -> Vec<[DVec2; 2]> {
    let way = (tip - from).normalize_or_zero();
    let (back, side) = (tip - way * 1.4, way.perp() * 0.6);
    vec![[from, tip], [back + side, tip], [back - side, tip]]
}

impl Mark {
    /// Creates a mark that shows no part.
    pub fn new(role: Role, shape: Shape) -> Mark {
        Mark {
            role,
            code: None,
            facts: None,
            shape,
        }
    }

    /// Returns it with attributes for its group.
    pub fn telling(self, facts: &Arc<Facts>) -> Mark {
        Mark {
            facts: Some(facts.clone()),
            ..self
        }
    }

    /// Creates a line of text.
    pub fn label(role: Role, at: DVec2, size: f64, anchor: Anchor, text: String) -> Mark {
        let label = Label {
            at,
            text,
            size,
            anchor,
            upward: false,
        };
        Mark::new(role, Shape::Label(label))
    }

    /// Returns it moved.
    fn moved(&self, by: DVec2) -> Mark {
        let rings = |rings: &[Vec<DVec2>]| -> Vec<Vec<DVec2>> {
            let moved = |ring: &Vec<DVec2>| ring.iter().map(|p| *p + by).collect();
            rings.iter().map(moved).collect()
        };
        let shape = match &self.shape {
            Shape::Lines(lines) => Shape::Lines(lines.iter().map(|l| l.map(|p| p + by)).collect()),
            Shape::Area(area) => Shape::Area(rings(area)),
            Shape::Letters(letters) => Shape::Letters(rings(letters)),
            Shape::Label(label) => Shape::Label(Label {
                at: label.at + by,
                ..label.clone()
            }),
        };
        Mark {
            role: self.role,
            code: self.code.clone(),
            facts: self.facts.clone(),
            shape,
        }
    }

    /// Returns its bounds; a text is taken as wide as kanji are.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::default();
        match &self.shape {
            Shape::Lines(lines) => lines.iter().flatten().for_each(|p| bounds.add(*p)),
            Shape::Area(rings) | Shape::Letters(rings) => {
                rings.iter().flatten().for_each(|p| bounds.add(*p));
            }
            Shape::Label(label) => {
                let width = width(&label.text) * label.size;
                let from = match label.anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => -width / 2.0,
                    Anchor::End => -width,
                };
                for (along, up) in [(from, -0.2), (from + width, 1.0)] {
                    let off = match label.upward {
                        false => dvec2(along, up * label.size),
                        true => dvec2(-up * label.size, along),
                    };
                    bounds.add(label.at + off);
                }
            }
        }
        bounds
    }
}

/// Returns the width of a text as a multiple of its size, in a font whose Latin letters are at most 0.6 wide.
pub fn width(text: &str) -> f64 {
    let one = |c: char| if c.is_ascii() { 0.6 } else { 1.0 };
    text.chars().map(one).sum()
}

/// A rectangle round points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lower left corner.
    pub low: DVec2,
    /// The upper right corner.
    pub high: DVec2,
}

impl Default for Bounds {
    /// Returns the bounds of nothing.
    fn default() -> Bounds {
        Bounds {
            low: DVec2::MAX,
            high: DVec2::MIN,
        }
    }
}

impl Bounds {
    /// Extends it to a point.
    pub fn add(&mut self, p: DVec2) {
        self.low = self.low.min(p);
        self.high = self.high.max(p);
    }

    /// Extends it to other bounds.
    pub fn join(&mut self, other: Bounds) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
    }

    /// Returns width and height; zero for those of nothing.
    pub fn size(&self) -> DVec2 {
        (self.high - self.low).max(DVec2::ZERO)
    }
}

/// One view of a subject.
#[derive(Clone, Debug)]
pub struct View {
    /// Its name on the command line and in `data-view`: `plan-1`, `front`, `section-a3.5`.
    pub name: String,
    /// Its title, in the reader's language.
    pub title: String,
    /// The size of what it shows of the subject, without dimensions and title, millimetres.
    pub drawn: DVec2,
    /// What is drawn, from below to above.
    pub marks: Vec<Mark>,
}

impl View {
    /// Returns the bounds of all marks.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::default();
        self.marks.iter().for_each(|m| bounds.join(m.bounds()));
        bounds
    }

    /// Returns the size that it would have if what it shows were so many times as large.
    pub fn size_at(&self, times: f64) -> DVec2 {
        self.bounds().size() + self.drawn * (times - 1.0)
    }

    /// Returns it moved.
    pub fn moved(&self, by: DVec2) -> View {
        View {
            name: self.name.clone(),
            title: self.title.clone(),
            drawn: self.drawn,
            marks: self.marks.iter().map(|m| m.moved(by)).collect(),
        }
    }
}

/// A sheet of paper with views on it.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Width and height, millimetres.
    pub size: DVec2,
    /// Metres of the model in a metre on paper: 100 for 1:100.
    pub scale: u32,
    /// What the sheet shows.
    pub title: String,
    /// The views in their places, then the frame.
    pub views: Vec<View>,
}
