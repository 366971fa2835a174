//! Legends: what a convention of drawing puts for a wall, a screen or a window (`grammar/legend-*.xml`).

mod thing;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
pub use thing::{Thing, ThingKind};

/// What stands on a unit of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Nothing.
    Empty,
    /// The edge of a mat or of boards: a line without a wall.
    Mat,
    /// A way without a door, between posts.
    Open,
    /// A wall.
    Wall,
    /// Sliding doors or screens.
    Slide,
    /// A door on hinges.
    Hinged,
    /// A window.
    Window,
    /// A lattice.
    Lattice,
}

impl Role {
    /// The roles that a legend may give, with their names.
    pub const NAMED: [(&'static str, Role); 7] = [
        ("mat", Role::Mat),
        ("open", Role::Open),
        ("wall", Role::Wall),
        ("slide", Role::Slide),
        ("hinged", Role::Hinged),
        ("window", Role::Window),
        ("lattice", Role::Lattice),
    ];

    /// Whether it parts what lies on its two sides.
    pub fn parts(self) -> bool {
        !matches!(self, Role::Empty | Role::Mat)
    }
}

/// A mark of a symbol. Places along it are 0 to 1 from end to end; places across it are in its spread, to the left positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A stroke along the wall.
    Line {
        /// Position across the wall.
        at: f64,
        /// Start along the wall.
        from: f64,
        /// End along the wall.
        to: f64,
        /// Width, pens.
        width: f64,
    },
    /// An area between two lines.
    Bar {
        /// Positions of the two lines across the wall.
        at: [f64; 2],
        /// Start along the wall.
        from: f64,
        /// End along the wall.
        to: f64,
    },
    /// Short strokes across the wall, at equal spaces.
    Ticks {
        /// Ends of the strokes across the wall.
        at: [f64; 2],
        /// Strokes per unit.
        count: u32,
        /// Width, pens.
        width: f64,
        /// True if the spaces at both ends are whole; otherwise they are halves.
        between_posts: bool,
    },
    /// A quarter circle about an end, a leaf's way, and the leaf.
    Arc,
    /// A stroke aslant from an end: a leaf without its way.
    Leaf,
}

/// What a mark is drawn with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Whether it is red.
    pub is_red: bool,
    /// How dark it is beside the darkest, 0 to 1.
    pub ink: f64,
}

/// How a thing is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Symbol {
    /// What it stands for.
    pub role: Role,
    /// The fewest and the most units over which it is drawn.
    pub units: [usize; 2],
    /// The least and the greatest spread, units.
    pub spread: [f64; 2],
    /// Whether all of it is drawn in red.
    pub is_red: bool,
    /// Its marks and what they are drawn with.
    pub marks: Vec<(Mark, Pen)>,
}

/// A convention.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Its name.
    pub name: String,
    /// Whether its strokes are drawn by hand and sway about the lines of the grid.
    pub is_by_hand: bool,
    /// Whether it is drawn on boards, not on paper.
    pub is_on_wood: bool,
    /// Its symbols on walls.
    pub symbols: Vec<Symbol>,
    /// Its symbols in rooms.
    pub things: Vec<Thing>,
}

/// What is wrong with a legend, and at which bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The bytes.
    pub at: std::ops::Range<usize>,
    /// What is wrong.
    pub what: String,
}

impl Legend {
    /// Reads a legend.
    ///
    /// # Errors
    /// At the first thing that is none of a legend's.
    pub fn read(text: &str) -> Result<Legend, Wrong> {
        let mut reader = Reader::from_str(text);
        let mut legend = Legend {
            name: String::new(),
            is_by_hand: false,
            is_on_wood: false,
            symbols: Vec::new(),
            things: Vec::new(),
        };
        let mut holder = None;
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event();
            let end = (reader.buffer_position() as usize)
                .max(reader.error_position() as usize)
                .min(text.len());
            let wrong = |what: String| Wrong {
                at: start.min(end)..end,
                what,
            };
            match event.map_err(|e| wrong(e.to_string()))? {
                Event::Eof => return Ok(legend),
                Event::Start(tag) | Event::Empty(tag) => {
                    let values = Values::of(&tag).map_err(wrong)?;
                    let taken = legend.take(tag.name().as_ref(), &values, &mut holder);
                    taken.map_err(wrong)?;
                }
                _ => {}
            }
        }
    }

    /// Whether some of its symbols have red marks.
    pub fn has_red(&self) -> bool {
        let marks = self.symbols.iter().flat_map(|s| &s.marks);
        marks.into_iter().any(|(_, pen)| pen.is_red)
    }

    /// Takes an element; `holder` is what the marks that follow belong to.
    fn take(
        &mut self,
        name: &str,
        values: &Values,
        holder: &mut Option<Holder>,
    ) -> Result<(), String> {
        match name {
            "Legend" => {
                self.name = values.text("name").unwrap_or_default().to_owned();
                self.is_by_hand = values.text("hand") == Some("free");
                self.is_on_wood = match values.text("ground") {
                    None => false,
                    Some("wood") => true,
                    Some(other) => return Err(format!("ground=\"{other}\" is not `wood`")),
                };
            }
            "Symbol" => {
                self.symbols.push(symbol(values)?);
                *holder = Some(Holder::Symbol);
            }
            "Thing" => {
                self.things.push(Thing::new(values)?);
                *holder = Some(Holder::Thing);
            }
            // Of drawings in lines (`vector::roles`).
            "Layer" | "Block" | "LineType" | "Colour" => {}
            _ => {
                if let (Some(Holder::Thing), Some(thing)) = (*holder, self.things.last_mut()) {
                    let taken = thing.take(name, values);
                    return taken
                        .unwrap_or_else(|| Err(format!("<{name}> is no mark of a <Thing>")));
                }
                let mark = mark(name, values)?;
                let symbol = self
                    .symbols
                    .last_mut()
                    .ok_or("a mark stands in a <Symbol>")?;
                let is_red = symbol.is_red || values.text("colour") == Some("red");
                let ink = values.number("ink")?.unwrap_or(1.0).clamp(0.05, 1.0);
                symbol.marks.push((mark, Pen { is_red, ink }));
            }
        }
        Ok(())
    }
}

/// What marks belong to.
#[derive(Clone, Copy)]
enum Holder {
    Symbol,
    Thing,
}

fn symbol(values: &Values) -> Result<Symbol, String> {
    let named = values.text("role").ok_or("a <Symbol> needs a role")?;
    let role = Role::NAMED.iter().find(|(name, _)| *name == named);
    let (_, role) = role.ok_or_else(|| format!("`{named}` is no role"))?;
    Ok(Symbol {
        role: *role,
        units: values
            .pair("units")?
            .unwrap_or([1.0, 1.0])
            .map(|n| n.clamp(1.0, 8.0) as usize),
        spread: values.pair("spread")?.unwrap_or([0.0, 0.0]),
        is_red: values.text("colour") == Some("red"),
        marks: Vec::new(),
    })
}

fn mark(name: &str, values: &Values) -> Result<Mark, String> {
    let from = values.number("from")?.unwrap_or(0.0);
    let to = values.number("to")?.unwrap_or(1.0);
    let across = || values.pair("at").map(|at| at.unwrap_or([-1.0, 1.0]));
    Ok(match name {
        "Line" => Mark::Line {
            at: values.number("at")?.unwrap_or(0.0),
            from,
            to,
            width: values.number("width")?.unwrap_or(1.0),
        },
        "Bar" => Mark::Bar {
            at: across()?,
            from,
            to,
        },
        "Ticks" => Mark::Ticks {
            at: across()?,
            count: values.number("count")?.unwrap_or(4.0).clamp(1.0, 20.0) as u32,
            width: values.number("width")?.unwrap_or(1.0),
            between_posts: values.text("between") == Some("posts"),
        },
        "Arc" => Mark::Arc,
        "Leaf" => Mark::Leaf,
        other => return Err(format!("<{other}> is no mark")),
    })
}

/// The attributes of a tag.
struct Values(Vec<(String, String)>);

impl Values {
    fn of(tag: &BytesStart<'_>) -> Result<Values, String> {
        let pairs = tag.attributes().map(|a| {
            let a = a.map_err(|e| e.to_string())?;
            Ok((a.key.as_ref().to_owned(), a.value.to_string()))
        });
        pairs.collect::<Result<_, String>>().map(Values)
    }

    fn text(&self, name: &str) -> Option<&str> {
        self.0
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, value)| value.as_str())
    }

    fn number(&self, name: &str) -> Result<Option<f64>, String> {
        let Some(text) = self.text(name) else {
            return Ok(None);
        };
        let number = text.trim().parse::<f64>().ok().filter(|n| n.is_finite());
        number
            .map(Some)
            .ok_or_else(|| format!("{name}=\"{text}\" is no number"))
    }

    fn pair(&self, name: &str) -> Result<Option<[f64; 2]>, String> {
        let Some(text) = self.text(name) else {
            return Ok(None);
        };
        let numbers: Vec<f64> = text
            .split_whitespace()
            .filter_map(|n| n.parse().ok())
            .collect();
        match numbers[..] {
            [one] => Ok(Some([one, one])),
            [low, high] => Ok(Some([low, high])),
            _ => Err(format!("{name}=\"{text}\" is not two numbers")),
        }
    }
}
