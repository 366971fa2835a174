//! The bodies of a part: a short list of simple elements with attributes. `tessellate/part` makes each into closed
//! solids; a part becomes more detailed by its list alone.
//!
//! Every element has a placement (`over from to left right front thick finish`), and attributes of its own.
//! `front` counts outwards from the wall's centre line, `thick` inwards from there.

use super::nearest::near;
use super::value::{Area, Joints, Level, Mm, Profile, Run, Sides, Value};
use crate::ast::{WrittenAttribute, WrittenBody, attribute_value};
use crate::material::SurfaceId;
use crate::messages::catalog as say;
use crate::messages::xml as elements;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Spanned;

/// An element of a part's body, with its children.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Its placement and material.
    pub place: Place,
    /// The kind.
    pub shape: Shape,
    /// The children (`oriel`, `grid`).
    pub children: Vec<Element>,
}

impl Element {
    /// Returns true if it is a wall over the whole opening.
    pub(super) fn is_whole_wall(&self) -> bool {
        let Place { over, from, to, .. } = &self.place;
        let whole = (*from, *to) == (Level::Start(0.0), Level::End(0.0));
        matches!(self.shape, Shape::Wall(_)) && *over == Area::Opening && whole
    }
}

/// Reads one attribute; returns its default if it is missing or cannot be read, which is reported.
pub(super) fn value<T: Value>(
    attributes: &[WrittenAttribute],
    name: &str,
    default: T,
    out: &mut Diagnostics,
) -> T {
    let Some(text) = attribute_value(attributes, name) else {
        return default;
    };
    T::read(&text.value).unwrap_or_else(|| {
        let offers = T::offers(&text.value);
        let (span, value) = (text.span, &text.value);
        out.push(say::wrong_value(span, name, value, T::FORM, &offers));
        default
    })
}

/// Defines structures whose fields are attributes.
macro_rules! attributes {
    ($($(#[$doc:meta])* $name:ident { $($(#[doc = $about:literal])* $field:ident: $ty:ty = $default:expr,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name { $($(#[doc = $about])* pub $field: $ty,)* }

        impl $name {
            /// The names of its attributes.
            const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];

            /// The descriptions of its attributes.
            const ABOUT: &'static [&'static str] = &[$(concat!($($about),*)),*];

            /// Reads the attributes of an element.
            fn read(attributes: &[WrittenAttribute], out: &mut Diagnostics) -> $name {
                let _ = (attributes, &out);
                $name { $($field: value(attributes, stringify!($field), $default, out),)* }
            }
        }
    )*};
}

/// Defines the kinds of elements by their words.
macro_rules! shapes {
    ($($word:literal $name:ident over $area:ident,)*) => {
        /// The kind of an element.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape { $(#[doc = $word] $name($name),)* }

        /// The words of all elements.
        pub(super) const WORDS: &[&str] = &[$($word),*];

        /// Returns the attributes of an element with their descriptions, by its word.
        pub fn attributes_of(word: &str) -> Option<Vec<(&'static str, &'static str)>> {
            let (names, about) = match word {
                $($word => ($name::NAMES, $name::ABOUT),)*
                _ => return None,
            };
            let own = names.iter().zip(about);
            let all = own.chain(Place::NAMES.iter().zip(Place::ABOUT));
            let all = all.map(|(name, about)| (*name, about.trim()));
            Some(all.chain([("over", "The area that it lies over.")]).collect())
        }

        impl Element {
            /// Reads an element without its children; `None` if its word is unknown, which is reported.
            pub(super) fn read(entry: &WrittenBody, out: &mut Diagnostics) -> Option<Element> {
                let attributes = &entry.attributes;
                let word: &str = &entry.word.value;
                let (shape, area, known) = match word {
                    $($word => (Shape::$name($name::read(attributes, out)), Area::$area, $name::NAMES),)*
                    _ => {
                        let near = near(word, WORDS);
                        let names = std::iter::once(entry.word.span).chain(entry.end);
                        let tags = elements::Tags { names: names.collect(), whole: vec![] };
                        out.push(elements::unknown_element(entry.word.span, word, near, None, &tags));
                        return None;
                    }
                };
                let known = [&["over"], Place::NAMES, known].concat();
                for attribute in attributes.iter().filter(|a| !known.contains(&a.name.value.as_str())) {
                    let Spanned { value, span } = &attribute.name;
                    let near = near(value, &known);
                    let near = near.map(|near| (near, attributes.iter().any(|a| a.name.value == near)));
                    out.push(elements::unknown_attribute(*span, value, word, near, &known, None));
                }
                let over = value(attributes, "over", area, out);
                let place = Place { over, ..Place::read(attributes, out) };
                Some(Element { place, shape, children: Vec::new() })
            }
        }
    };
}

attributes! {
    /// Where an element is and what it is made of.
    Place {
        /// The area that the next four count in.
        over: Area = Area::Opening,
        /// Its foot.
        from: Level = Level::Start(0.0),
        /// Its top.
        to: Level = Level::End(0.0),
        /// Its left end, seen from outside.
        left: Level = Level::Start(0.0),
        /// Its right end.
        right: Level = Level::End(0.0),
        /// Outermost plane, outwards from the centre line.
        front: Mm = Mm(0.045),
        /// Thickness, inwards from there.
        thick: Mm = Mm(0.030),
        /// The material.
        finish: SurfaceId = SurfaceId::named("cedar"),
    }
    /// A plain box over the place.
    Slab {}
    /// The panel of a wall.
    Wall {
        /// Its back leans in by this share of the height, its front too: an earth wall's batter.
        batter: f64 = 0.0,
    }
    /// Boards side by side, on whatever lies behind.
    Boards {
        /// Their direction.
        run: Run = Run::Level,
        /// Approximate width of one; a whole number of them fills the place.
        size: Mm = Mm(0.270),
        /// Open joint between two.
        gap: Mm = Mm(0.0),
        /// Projection of the foot of each over the next (clapboards).
        lap: Mm = Mm(0.0),
        /// Number of boards; 0 = by their size.
        count: u32 = 0,
        /// Setback of every other one, which shows the joints.
        step: Mm = Mm(0.0),
        /// Width of strips over the joints, half a one at each end; 0 = none.
        strip: Mm = Mm(0.0),
    }
    /// Upright bars, counted.
    Bars {
        /// Number of long ones.
        count: u32 = 9,
        /// Width of a long one.
        size: Mm = Mm(0.020),
        /// Clear width between neighbours, where it is given; else it follows from the count.
        gap: Option<Mm> = None,
        /// Short ones after each long one; also after the last.
        children: u32 = 0,
        /// Width of a short one.
        childsize: Mm = Mm(0.018),
        /// Share of the height cut away from the top of the short ones.
        cut: f64 = 0.0,
        /// Chamfer of the edges of their fronts.
        edge: Mm = Mm(0.0),
        /// True if the edges are round instead, as of bars wound with rope and plastered; half the width = round bars.
        round: bool = false,
        /// True if the gaps between them end round.
        slits: bool = false,
        /// True if the first and last lie at the ends of the place, as battens do.
        ends: bool = false,
    }
    /// Level bars, counted, spread evenly from the foot to the top.
    Rails {
        /// Number of rails.
        count: u32 = 2,
        /// Height of one.
        size: Mm = Mm(0.030),
        /// True if the first and last lie at the ends of the place.
        ends: bool = false,
    }
    /// A frame inside the edges of the place.
    Frame {
        /// Width of its members.
        size: Mm = Mm(0.040),
        /// The members present.
        sides: Sides = Sides::ALL,
    }
    /// Sliding leaves side by side, the left one in front.
    Leaf {
        /// Number of leaves.
        leaves: u32 = 1,
        /// Number of leaves one above another, as shutters let down into grooves.
        stack: u32 = 1,
        /// Width of the stiles.
        stile: Mm = Mm(0.040),
        /// Height of the top and bottom rails.
        rail: Mm = Mm(0.050),
        /// Rails between.
        rails: u32 = 0,
        /// Their height.
        railsize: Mm = Mm(0.024),
        /// Upright bars.
        bars: u32 = 0,
        /// Their width.
        barsize: Mm = Mm(0.015),
        /// Panes side by side.
        cols: u32 = 1,
        /// Panes one above another.
        rows: u32 = 1,
        /// Width of the bars between panes.
        muntin: Mm = Mm(0.012),
        /// The content.
        pane: SurfaceId = SurfaceId::named("boards"),
        /// Height of boards at its foot.
        dado: Mm = Mm(0.0),
        /// Upright boards that its pane is made of; 0 = one sheet.
        planks: u32 = 0,
        /// Height of the pull on the stile where a hand finds it; 0 = none.
        pull: Mm = Mm(0.0),
    }
    /// Sill and head of sliding leaves, with their grooves.
    Track {
        /// Height of sill and head.
        size: Mm = Mm(0.040),
        /// Grooves.
        tracks: u32 = 1,
        /// Outermost plane of the first groove.
        groove: Mm = Mm(0.041),
        /// Width of a groove.
        wide: Mm = Mm(0.032),
        /// Depth of a groove.
        deep: Mm = Mm(0.012),
    }
    /// A box in front of the wall, open at its sides, its front made of the children.
    Oriel {
        /// Bars at each side.
        side: u32 = 0,
        /// Thickness of its corner posts.
        post: Mm = Mm(0.045),
        /// Width of the bars at its sides.
        sidesize: Mm = Mm(0.020),
        /// Thin rails at each side between foot and top.
        siderails: u32 = 0,
        /// Overhang of its own small roof; 0 = none.
        eaves: Mm = Mm(0.0),
        /// The roof's rise in the horizontal.
        pitch: f64 = 0.3,
        /// Brackets below it.
        arms: u32 = 0,
        /// The covering of the roof.
        roof: SurfaceId = SurfaceId::named("board_roof"),
        /// True if it has a floor.
        floor: bool = true,
    }
    /// Cloths side by side on a pole.
    Cloth {
        /// Number of cloths.
        count: u32 = 3,
        /// Width of one.
        size: Mm = Mm(0.340),
        /// Length of the hanging cloth.
        drop: Mm = Mm(1.130),
        /// Loops by which each hangs from the pole.
        loops: u32 = 3,
    }
    /// Laths in an arc from the foot of the wall: inu-yarai.
    Apron {
        /// Number of laths.
        count: u32 = 25,
        /// Distance of its foot from the wall.
        out: Mm = Mm(0.450),
        /// Level laths over them.
        rails: u32 = 3,
    }
    /// A small roof along the place, both sides.
    Coping {
        /// Projection beyond front and back.
        out: Mm = Mm(0.150),
        /// Rise in the horizontal.
        pitch: f64 = 0.4,
        /// Approximate spacing of its rolls of round tiles; 0 = none.
        rolls: Mm = Mm(0.0),
        /// Whether its ridge runs from front to back; it then projects at the sides.
        across: bool = false,
    }
    /// A small roof in front of the place, its top edge at the top.
    Hood {
        /// Rise in the horizontal.
        pitch: f64 = 0.3,
    }
    /// A wall at right angles to the facade with a little roof: udatsu.
    Wing {
        /// Projection from the wall.
        out: Mm = Mm(0.750),
        /// The covering of its roof.
        roof: SurfaceId = SurfaceId::named("kawara_edge"),
        /// Approximate spacing of its rolls of round tiles; 0 = none.
        rolls: Mm = Mm(0.0),
    }
    /// Dark walls, ceiling and end of what lies behind an opening.
    Depth {
        /// Its depth.
        depth: Mm = Mm(3.0),
        /// The shape of its end.
        end: SurfaceId = SurfaceId::named("dark"),
    }
    /// Raised plaster joints of a tile wall.
    Namako {
        /// Their direction.
        joints: Joints = Joints::Diagonal,
        /// Side of a tile.
        tile: Mm = Mm(0.270),
        /// Width of a joint.
        joint: Mm = Mm(0.036),
    }
    /// A grid of panels with open joints.
    Panels {
        /// Approximate width of one.
        width: Mm = Mm(0.900),
        /// Approximate height of one.
        height: Mm = Mm(1.800),
        /// Joint.
        gap: Mm = Mm(0.010),
    }
    /// Round studs in a grid.
    Studs {
        /// Side by side.
        cols: u32 = 3,
        /// One above another.
        rows: u32 = 3,
        /// Diameter.
        size: Mm = Mm(0.040),
    }
    /// Frames one inside another, each farther back: the jambs of a storehouse.
    Jambs {
        /// Number of frames.
        count: u32 = 3,
        /// Width and depth of a step.
        size: Mm = Mm(0.040),
    }
    /// Leaves that stand open at right angles to the wall, stepped at their edges.
    Open {
        /// Their reach outwards.
        out: Mm = Mm(0.450),
        /// Steps.
        count: u32 = 3,
        /// The leaves present: l, r or both.
        sides: Sides = Sides::ALL,
        /// Reduction of each step at every edge.
        size: Mm = Mm(0.036),
    }
    /// The fillings of the corners of an opening, which leave it rounded: half its width makes a circle.
    Corners {
        /// Radius.
        size: Mm = Mm(0.100),
        /// True if it looks like the small walls around the opening.
        around: bool = false,
    }
    /// A bell-shaped opening (kato-mado): the wall outside of its curve, and a rim along it.
    Bell {
        /// Width of the rim.
        rim: Mm = Mm(0.050),
    }
    /// A round bar in the middle of its place.
    Pole {
        /// Its direction.
        run: Run = Run::Level,
    }
    /// Level slats that bulge outwards: a roller shutter.
    Slats {
        /// Approximate height of one.
        size: Mm = Mm(0.075),
        /// Height of the bulge.
        bulge: Mm = Mm(0.009),
    }
    /// Its children again in each cell of a grid.
    Grid {
        /// Cells side by side.
        cols: u32 = 1,
        /// Cells one above another.
        rows: u32 = 1,
        /// Distance between two cells.
        gap: Mm = Mm(0.0),
    }
    /// A post on the line.
    Post {
        /// Its side.
        size: Mm = Mm(0.121),
    }
    /// A body of revolution around the upright axis in the middle of its place.
    Turned {
        /// Height and radius of each corner from the foot up, mm or shares of the place: `0 150, 40% 90, 100% 0`.
        profile: Profile = Profile::default(),
        /// Number of its sides; 0 = round, by the detail.
        sides: u32 = 0,
        /// How far its middle is before the centre line.
        out: Mm = Mm(0.0),
        /// Turn of its first corner, degrees.
        turn: f64 = 0.0,
    }
    /// A panel whose front shows the texture of its part.
    Shown {}
    /// Boards at the foot of a wall under a drip board.
    Dado {
        /// Width of a board.
        size: Mm = Mm(0.240),
    }
}

shapes! {
    "box" Slab over Opening,
    "wall" Wall over Bay,
    "boards" Boards over Opening,
    "bars" Bars over Opening,
    "rails" Rails over Opening,
    "frame" Frame over Opening,
    "leaf" Leaf over Opening,
    "track" Track over Opening,
    "oriel" Oriel over Opening,
    "cloth" Cloth over Opening,
    "apron" Apron over Bay,
    "coping" Coping over Bay,
    "hood" Hood over Opening,
    "wing" Wing over Bay,
    "depth" Depth over Opening,
    "namako" Namako over Bay,
    "panels" Panels over Bay,
    "studs" Studs over Opening,
    "jambs" Jambs over Opening,
    "open" Open over Opening,
    "corners" Corners over Opening,
    "bell" Bell over Opening,
    "pole" Pole over Opening,
    "slats" Slats over Opening,
    "grid" Grid over Opening,
    "post" Post over Bay,
    "dado" Dado over Bay,
    "turned" Turned over Opening,
    "picture" Shown over Opening,
}
