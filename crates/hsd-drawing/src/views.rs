//! The views of a subject: plans of storeys, elevations, sections.

mod bays;
mod outdoors;
mod rooms;
mod stairs;

use crate::cut;
use crate::dimension::{self, APART, Line, Measure};
use crate::look::Look;
use crate::paper::{Anchor, Bounds, Mark, Role, Shape, View};
use crate::roofs;
use hsd_base::diagnostic::Language;
use hsd_ir::building::Storey;

use crate::seen::Depths;
use crate::subject::Subject;
use crate::{Plane, Settings};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::text;

/// The height of a plan's cut above its floor, metres: through doors and windows, above benches.
const CUT: f64 = 1.2;

/// The height of titles and names, millimetres.
const TITLE: f64 = 3.5;

/// Returns the plan of a storey, counted from 1: cut above its floor, and what lies below.
pub(super) fn plan(subject: &Subject<'_>, number: u32, settings: &Settings) -> View {
    let scale = settings.millimetres();
    let floors = storeys(subject, number).map(|(floor, s)| floor + CUT.min((s.z1 - s.z0) * 0.6));
    let height = floors.fold(f64::MIN, f64::max);
    let look = Look::down(scale).cut_at(DVec3::Z * height);
    let mut marks = drawn(subject, look);
    marks.extend(rooms::rooms(subject, number, settings));
    marks.extend(stairs::stairs(subject, number, settings));
    marks.extend(bays::bays(subject, number, settings));
    let drawn = bounds_of(&marks);
    if number == 1 {
        marks.extend(section_marks(subject, drawn, settings));
    }
    plan_dimensions(subject, number, settings, &mut marks);
    if number == 1 {
        marks.extend(north(subject, bounds_of(&marks)));
    }
    let title = match settings.language {
        Language::English => format!("Plan of storey {number}"),
        Language::Japanese => format!("{number}階平面図"),
    };
    titled(format!("plan-{number}"), title, (settings, drawn), marks)
}

/// The storeys of a number, with their floors above the ground of the subject.
fn storeys<'s>(subject: &'s Subject<'_>, number: u32) -> impl Iterator<Item = (f64, &'s Storey)> {
    subject.houses.iter().flat_map(move |built| {
        let own = built
            .house
            .storeys
            .iter()
            .filter(move |s| s.number == number);
        own.map(|s| (subject.point(&built.house, DVec3::Z * s.z0).z, s))
    })
}

/// Returns what a look cuts, over what is seen behind it.
fn drawn(subject: &Subject<'_>, look: Look) -> Vec<Mark> {
    let depths = Depths::new(subject, look);
    let mut marks = vec![Mark::new(Role::Seen, Shape::Lines(depths.lines()))];
    if look.cut > f64::NEG_INFINITY {
        marks.extend(cut::cut(subject, &look));
    }
    marks
}

/// Returns an elevation, with its heights.
pub(super) fn elevation(subject: &Subject<'_>, side: Side, settings: &Settings) -> View {
    let look = side.look(settings.millimetres());
    let marks = drawn(subject, look);
    let (name, title) = (
        side.word(),
        side.title().in_language(settings.language).into_owned(),
    );
    upright(subject, marks, name.to_owned(), title, settings)
}

/// Returns a section: what a plane cuts, and what is seen behind it.
pub(super) fn section(subject: &Subject<'_>, plane: Plane, settings: &Settings) -> View {
    let scale = settings.millimetres();
    let look = match plane {
        Plane::A(_) => Look::from_right(scale),
        Plane::B(_) => Look::front(scale),
    };
    let marks = drawn(subject, look.cut_at(plane.place(subject)));
    let (name, at) = (format!("section-{}", plane.word()), plane.word());
    let title = match settings.language {
        Language::English => format!("Section {at}"),
        Language::Japanese => format!("断面図 {at}"),
    };
    upright(subject, marks, name, title, settings)
}

/// The side of a house.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The first line.
    Front,
    /// On the right of somebody who stands before the front.
    Right,
    /// Opposite the front.
    Back,
    /// On the left.
    Left,
}

impl Side {
    /// All sides, in the order of a walk round the house.
    pub const ALL: [Side; 4] = [Side::Front, Side::Right, Side::Back, Side::Left];

    /// Its word on the command line and in `data-view`.
    pub fn word(self) -> &'static str {
        match self {
            Side::Front => "front",
            Side::Right => "right",
            Side::Back => "back",
            Side::Left => "left",
        }
    }

    fn title(self) -> hsd_base::diagnostic::Text {
        match self {
            Side::Front => text!("Front elevation", "正面立面図"),
            Side::Right => text!("Right elevation", "右側立面図"),
            Side::Back => text!("Back elevation", "背面立面図"),
            Side::Left => text!("Left elevation", "左側立面図"),
        }
    }

    fn look(self, scale: f64) -> Look {
        match self {
            Side::Front => Look::front(scale),
            Side::Right => Look::from_right(scale),
            Side::Back => Look::back(scale),
            Side::Left => Look::from_left(scale),
        }
    }
}

/// Returns an upright view on the ground, with the heights of the first house beside it.
fn upright(
    subject: &Subject<'_>,
    mut marks: Vec<Mark>,
    name: String,
    title: String,
    settings: &Settings,
) -> View {
    above_ground(&mut marks);
    let drawn = bounds_of(&marks);
    let bounds = drawn;
    let ground = [bounds.low.x - 6.0, bounds.high.x + 6.0].map(|x| dvec2(x, 0.0));
    marks.push(Mark::new(Role::Ground, Shape::Lines(vec![ground])));
    let scale = settings.millimetres();
    let first = subject.houses.iter().take(1);
    let levels = first.flat_map(|built| {
        let storeys = built.house.storeys.iter().flat_map(|s| [s.z0, s.z1]);
        storeys.map(|z| subject.point(&built.house, DVec3::Z * z).z)
    });
    let levels = levels.chain([0.0]).map(|z| z * scale).collect::<Vec<_>>();
    let from = bounds.high.x.max(ground[1].x);
    let paper = (scale, settings.language);
    let right = |step: f64| Line::Right {
        at: from + APART * step,
        from,
    };
    let all = dimension::places(levels.into_iter().chain([bounds.high.y]));
    dimension::chain(&all, right(1.0), Measure::Shaku, paper, &mut marks);
    if all.len() > 2 {
        let whole = [all[0], all[all.len() - 1]];
        dimension::chain(&whole, right(2.0), Measure::Shaku, paper, &mut marks);
    }
    titled(name, title, (settings, drawn), marks)
}

/// Leaves out what is seen below the ground; what is cut there stays.
fn above_ground(marks: &mut [Mark]) {
    for mark in marks.iter_mut().filter(|m| m.role == Role::Seen) {
        let Shape::Lines(lines) = &mut mark.shape else {
            continue;
        };
        lines.retain_mut(|line| {
            line.sort_by(|p, q| q.y.total_cmp(&p.y));
            let [high, low] = *line;
            if low.y < 0.0 && high.y > 0.0 {
                line[1] = high.lerp(low, high.y / (high.y - low.y));
            }
            high.y > 0.0
        });
    }
}

/// Returns the plan of all roofs from above.
pub(super) fn roof_plan(subject: &Subject<'_>, settings: &Settings) -> View {
    let look = Look::down(settings.millimetres());
    let depths = Depths::new(subject, look);
    let mut marks = vec![Mark::new(Role::Seen, Shape::Lines(depths.lines()))];
    marks.extend(roofs::lines(subject, &depths, settings));
    let drawn = bounds_of(&marks);
    let title = text!("Roof plan", "屋根伏図")
        .in_language(settings.language)
        .into_owned();
    titled("roof".to_owned(), title, (settings, drawn), marks)
}

/// Returns the plan of the plot: the ground storeys of all houses under the lines of their roofs.
pub(super) fn site_plan(subject: &Subject<'_>, settings: &Settings) -> View {
    let look = Look::down(settings.millimetres());
    let depths = Depths::new(subject, look);
    let mut marks = outdoors::outdoors(subject, settings);
    for built in &subject.houses {
        let rings = built.house.storeys.iter().take(1).flat_map(|s| &s.rings);
        let closed = rings.filter(|r| r.closed && !r.inner);
        let place = |p: DVec2| subject.plan_point(&built.house, p) * settings.millimetres();
        let area: Vec<Vec<DVec2>> = closed
            .map(|r| {
                let ring = leftwards(r.corners().into_iter().map(place).collect());
                match r.hole {
                    true => ring.into_iter().rev().collect(),
                    false => ring,
                }
            })
            .collect();
        if !area.is_empty() {
            marks.push(Mark::new(Role::Floor, Shape::Area(area.clone())));
        }
        let name = &built.house.name;
        if let (Some(first), false) = (area.first(), name.is_empty()) {
            let mut bounds = Bounds::default();
            first.iter().for_each(|p| bounds.add(*p));
            let at = (bounds.low + bounds.high) / 2.0;
            let name = hsd_base::diagnostic::visible::line(name);
            marks.push(Mark::label(Role::Text, at, 2.5, Anchor::Middle, name));
        }
    }
    marks.extend(roofs::outlines(subject, &depths));
    let drawn = bounds_of(&marks);
    marks.extend(north(subject, drawn));
    let title = text!("Site plan", "配置図")
        .in_language(settings.language)
        .into_owned();
    titled("site".to_owned(), title, (settings, drawn), marks)
}

/// Returns a view with its title below it.
fn titled(
    name: String,
    title: String,
    (settings, drawn): (&Settings, Bounds),
    mut marks: Vec<Mark>,
) -> View {
    let bounds = bounds_of(&marks);
    let words = format!("{title}  1:{}", settings.scale);
    let middle = (drawn.low.x + drawn.high.x) / 2.0;
    let at = dvec2(middle, bounds.low.y - 4.0 - TITLE);
    marks.push(Mark::label(Role::Text, at, TITLE, Anchor::Middle, words));
    View {
        name,
        title,
        drawn: drawn.size(),
        marks,
    }
}

fn bounds_of(marks: &[Mark]) -> Bounds {
    let mut bounds = Bounds::default();
    marks.iter().for_each(|m| bounds.join(m.bounds()));
    match bounds.low.x <= bounds.high.x {
        true => bounds,
        false => Bounds {
            low: DVec2::ZERO,
            high: DVec2::ZERO,
        },
    }
}

/// Adds the lengths of a storey below and on the left: between the corners of its outlines, and as a whole.
fn plan_dimensions(subject: &Subject<'_>, number: u32, settings: &Settings, marks: &mut Vec<Mark>) {
    let (scale, bounds) = (settings.millimetres(), bounds_of(marks));
    let mut corners: Vec<DVec2> = vec![];
    for built in &subject.houses {
        let storeys = built.house.storeys.iter().filter(|s| s.number == number);
        for ring in storeys.flat_map(|s| &s.rings).filter(|r| !r.inner) {
            let place = |p| subject.plan_point(&built.house, p) * scale;
            corners.extend(ring.corners().into_iter().map(place));
        }
    }
    let Some(first) = subject.houses.first() else {
        return;
    };
    let (ken, paper) = (
        Measure::Ken(first.house.unit * 2.0),
        (scale, settings.language),
    );
    let (xs, ys) = (
        dimension::places(corners.iter().map(|p| p.x)),
        dimension::places(corners.iter().map(|p| p.y)),
    );
    let below = |step: f64| Line::Below {
        at: bounds.low.y - APART * step,
        from: bounds.low.y,
    };
    let left = |step: f64| Line::Left {
        at: bounds.low.x - APART * step,
        from: bounds.low.x,
    };
    for (all, line) in [(&xs, &below as &dyn Fn(f64) -> Line), (&ys, &left)] {
        dimension::chain(all, line(1.0), ken, paper, marks);
        if all.len() > 2 {
            dimension::chain(&[all[0], all[all.len() - 1]], line(2.0), ken, paper, marks);
        }
    }
}

/// Returns the lines of the sections on a plan, with arrows the way they look.
fn section_marks(subject: &Subject<'_>, bounds: Bounds, settings: &Settings) -> Vec<Mark> {
    let mut marks = vec![];
    for plane in &settings.sections {
        let at = plane.place(subject) * settings.millimetres();
        let (ends, way) = match plane {
            Plane::A(_) => {
                let end = |y| dvec2(at.x, y);
                (
                    [end(bounds.low.y - 3.0), end(bounds.high.y + 3.0)],
                    dvec2(-1.0, 0.0),
                )
            }
            Plane::B(_) => {
                let end = |x| dvec2(x, at.y);
                (
                    [end(bounds.low.x - 3.0), end(bounds.high.x + 3.0)],
                    dvec2(0.0, 1.0),
                )
            }
        };
        marks.push(Mark::new(Role::Section, Shape::Lines(vec![ends])));
        for end in ends {
            let across = way.perp() * 1.2;
            let arrow = vec![end - across, end + across, end + way * 3.0];
            marks.push(Mark::new(Role::Frame, Shape::Area(vec![leftwards(arrow)])));
        }
        let (text, high) = (plane.word(), ends[1]);
        let at = high + dvec2(1.6, 0.4);
        marks.push(Mark::label(Role::Text, at, 2.0, Anchor::Start, text));
    }
    marks
}

/// Returns a ring counter-clockwise.
fn leftwards(mut ring: Vec<DVec2>) -> Vec<DVec2> {
    if cut::area(std::slice::from_ref(&ring)) < 0.0 {
        ring.reverse();
    }
    ring
}

/// Returns the north arrow, beside a plan of the first house's front below.
fn north(subject: &Subject<'_>, bounds: Bounds) -> Vec<Mark> {
    let Some(first) = subject.houses.first() else {
        return vec![];
    };
    let (sin, cos) = (first.house.azimuth + 180.0).to_radians().sin_cos();
    let way = dvec2(-sin, cos);
    let at = dvec2(bounds.high.x + 9.0, bounds.high.y - 8.0);
    let tip = at + way * 7.0;
    let side = way.perp() * 2.0;
    let ring = leftwards(vec![at - way * 3.0 - side, at - way * 1.2, tip]);
    let other = leftwards(vec![at - way * 3.0 + side, at - way * 1.2, tip]);
    let lines = (0..3).map(|k| [other[k], other[(k + 1) % 3]]).collect();
    vec![
        Mark::new(Role::Frame, Shape::Area(vec![ring])),
        Mark::new(Role::Frame, Shape::Lines(lines)),
        Mark::label(
            Role::Text,
            tip + way * 2.2 - dvec2(0.0, 1.0),
            2.5,
            Anchor::Middle,
            "N".to_owned(),
        ),
    ]
}
