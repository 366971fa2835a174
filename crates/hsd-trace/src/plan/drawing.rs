//! What a file of a plan holds, told by its content and not by its name: a picture, or a drawing in lines; and the house in such
//! a drawing, so that it is written and reviewed like one in a picture.

use super::gridded::Gridded;
use super::legend::Legend;
use super::text::is_doubtful;
use super::vector::fit::UNITS;
use super::vector::roles::{Means, Roles};
use super::vector::{self, dxf, hollow, lines::Lines, own, paint, pdf, svg};
use super::{
    Flat, Found, Front, Grid, Ink, Options, Picture, Plan, Stopped, Unreadable, several, walls,
};
use glam::{DMat3, DVec2, dvec2};

/// Bytes at the start of a file that tell what it is.
const HEAD: usize = 4096;

/// The directions of lines that are distinguished in a quarter of a turn, and the least turn that is taken back, radians.
const DIRECTIONS: usize = 180;
const LEAST_SKEW: f64 = 0.002;

/// The fewest strokes of known walls that a plan is read from alone.
const KNOWN_WALLS: usize = 20;

/// What a file holds.
#[derive(Clone, Debug)]
pub enum Content {
    /// A picture.
    Picture(Picture),
    /// A drawing in lines.
    Lines(Lines),
    /// A house that `hsd draw` has drawn: its text.
    House(String),
}

impl Content {
    /// Returns the number of pixels of the file in one of the image that is read; 1 for drawings.
    pub fn shrink(&self) -> f64 {
        match self {
            Content::Picture(picture) => picture.shrink,
            Content::Lines(_) | Content::House(_) => 1.0,
        }
    }
}

/// Why a file holds no plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Unopened {
    /// As a picture.
    Picture(Unreadable),
    /// As a drawing.
    Drawing(vector::Refused),
}

/// Formats of drawings.
enum Format {
    Svg,
    Dxf,
    Pdf,
}

/// Opens a file; of a PDF the page that is asked for, counted from 1. It may expand to about this memory, bytes.
///
/// # Errors
/// If it is damaged, too large, or of another format.
pub fn open(bytes: &[u8], page: usize, memory: u64) -> Result<Content, Unopened> {
    let opened = match format(bytes) {
        Some(Format::Svg) => open_svg(bytes),
        Some(Format::Dxf) => dxf::read(bytes).map(Content::Lines),
        Some(Format::Pdf) => pdf::read(bytes, page, memory).map(|page| match page {
            pdf::Page::Lines(lines) => Content::Lines(lines),
            pdf::Page::Picture(picture) => Content::Picture(picture),
        }),
        None => {
            return Picture::decode_within(bytes, memory)
                .map(Content::Picture)
                .map_err(Unopened::Picture);
        }
    };
    opened.map_err(Unopened::Drawing)
}

/// Whether a file is a PDF, so that one of its pages has to be chosen.
pub fn is_pdf(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(HEAD)];
    head.windows(5).any(|w| w == b"%PDF-")
}

fn format(bytes: &[u8]) -> Option<Format> {
    if is_pdf(bytes) {
        return Some(Format::Pdf);
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    if head.starts_with(b"AutoCAD Binary DXF") || head.starts_with(b"AC10") {
        return Some(Format::Dxf);
    }
    let text = String::from_utf8_lossy(head);
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('<') && text.contains("<svg") {
        return Some(Format::Svg);
    }
    // A DXF begins with a group code: a section, or a remark.
    let first = text.lines().next().unwrap_or_default().trim();
    matches!(first, "0" | "999").then_some(Format::Dxf)
}

fn open_svg(bytes: &[u8]) -> Result<Content, vector::Refused> {
    let text = std::str::from_utf8(bytes).map_err(|e| vector::Refused::NotXml {
        at: e.valid_up_to() as u64,
        what: "not UTF-8".to_owned(),
    })?;
    match own::read(text)? {
        Some(house) => Ok(Content::House(house)),
        None => svg::read(text).map(Content::Lines),
    }
}

/// The plan of a drawing.
#[derive(Clone, Debug)]
pub enum DrawnPlan {
    /// On a grid of half ken.
    Grid(Box<Drawn>),
    /// Wall by wall.
    Walls(Box<walls::Found>),
}

impl DrawnPlan {
    /// Returns the plan on an image of a drawing.
    fn of(plan: Plan) -> DrawnPlan {
        match plan {
            Plan::Walls(found) => DrawnPlan::Walls(found),
            Plan::Grid(found) => DrawnPlan::Grid(Box::new(Drawn::mute(*found))),
        }
    }
}

/// What was found in a drawing.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// As it would be found in a picture of the drawing; `to_picture` takes its pixels to places of the drawing.
    pub found: Found,
    /// Shaku in a unit of the grid, if the drawing says how large the house is.
    pub shaku: Option<f64>,
    /// Layers and groups of which nothing says what they stand for, those with most strokes first.
    pub unknown: Vec<String>,
}

impl Drawn {
    /// Returns the house found in a drawing whose layers have no roles.
    fn mute(found: Found) -> Drawn {
        Drawn {
            found,
            shaku: None,
            unknown: vec![],
        }
    }
}

/// A drawing without a plan.
#[derive(Clone, Debug)]
pub struct NoPlan {
    /// The reason.
    pub why: vector::Refused,
    /// The findings on its image.
    pub stopped: Option<Box<Stopped>>,
}

/// Finds the plan in the lines of a drawing, as [`find`] does, otherwise wall by wall.
///
/// # Errors
/// If there is none.
pub fn read(
    mut lines: Lines,
    roles: &Roles,
    unit_mm: Option<f64>,
    legends: &[Legend],
    front: Front,
) -> Result<DrawnPlan, NoPlan> {
    let why = match by_roles(lines.clone(), roles, unit_mm, front) {
        Ok(drawn) => return Ok(DrawnPlan::Grid(Box::new(drawn))),
        Err(refused) => refused,
    };
    let turned_back = straighten(&mut lines);
    if turned_back != DMat3::IDENTITY
        && let Ok(mut drawn) = by_roles(lines.clone(), roles, unit_mm, front)
    {
        drawn.found.flat.to_picture = turned_back * drawn.found.flat.to_picture;
        return Ok(DrawnPlan::Grid(Box::new(drawn)));
    }
    let to_drawing = turned_back * turn(&mut lines, front);
    // Furniture and gardens look like walls, so layers that are known come first.
    let is_off_grid = matches!(why, vector::Refused::NoGrid(_) | vector::Refused::NoHouse);
    let known = if is_off_grid {
        known(&lines, roles)
    } else {
        None
    };
    let plan = match known {
        Some((known, means)) => painted(known, Some(&means), &[]),
        None => painted(lines, None, legends),
    };
    match plan {
        Ok(mut plan) => {
            let flat = plan.flat_mut();
            flat.to_picture = to_drawing * flat.to_picture;
            Ok(DrawnPlan::of(plan))
        }
        Err(mut stopped) => {
            if let Some(stopped) = &mut stopped {
                stopped.flat.to_picture = to_drawing * stopped.flat.to_picture;
            }
            Err(NoPlan { why, stopped })
        }
    }
}

/// Reads the plan in a drawing wall by wall, even if it keeps to a grid. Known layers of walls are used alone.
pub fn by_walls(mut lines: Lines, roles: &Roles, front: Front) -> Option<walls::Found> {
    let turned_back = straighten(&mut lines);
    let to_drawing = turned_back * turn(&mut lines, front);
    let (painted, options) = match known(&lines, roles) {
        Some((known, means)) => image(known, Some(&means)),
        None => image(lines, None),
    }?;
    let (flat, ink) = match Gridded::of(&painted.picture, &options) {
        Ok(sheet) => (sheet.flat, sheet.ink),
        Err(stopped) => (stopped.flat, stopped.ink),
    };
    let mut found = walls::found(&flat, &ink, &options)?;
    found.flat.to_picture = to_drawing * painted.to_drawing * found.flat.to_picture;
    Some(found)
}

/// Turns back a building that is turned on its site; returns what turns places again.
fn straighten(lines: &mut Lines) -> DMat3 {
    let skew = skew(lines);
    if skew == 0.0 {
        return DMat3::IDENTITY;
    }
    let turned_back = DMat3::from_angle(skew);
    let upright = turned_back.inverse();
    let points = lines.strokes.iter_mut().flat_map(|s| &mut s.points);
    points.for_each(|p| *p = upright.transform_point2(*p));
    turned_back
}

/// Returns the lines of walls, posts and openings with their meanings; `None` if there are few walls.
fn known(lines: &Lines, roles: &Roles) -> Option<(Lines, Vec<Means>)> {
    let all = roles.of(lines);
    let is_known = |m: &Means| m.is_opening() || matches!(m, Means::Wall | Means::Post);
    let mut known = lines.clone();
    let mut means = all.iter();
    known.strokes.retain(|_| {
        means
            .next()
            .copied()
            .flatten()
            .is_some_and(|m| is_known(&m))
    });
    let means: Vec<Means> = all.into_iter().flatten().filter(is_known).collect();
    let walls = means.iter().filter(|m| **m == Means::Wall).count();
    (walls >= KNOWN_WALLS).then_some((known, means))
}

/// Draws an image of the lines with the hollow walls filled, and what is known of its size; `None` without lines.
///
/// `means` has the meanings of all strokes if they are known.
fn image(mut lines: Lines, means: Option<&[Means]>) -> Option<(paint::Painted, Options)> {
    hollow::fill(&mut lines, means);
    let painted = paint::paint(&lines)?;
    let drawing = painted.to_drawing.transform_vector2(DVec2::X).length();
    let options = Options {
        metres: lines.unit_mm.map(|mm| mm / 1000.0 * drawing),
        units: if lines.is_model && lines.unit_mm.is_none() {
            UNITS.map(|mm| (mm, mm / 1000.0 * drawing)).to_vec()
        } else {
            vec![]
        },
        ..Options::default()
    };
    Some((painted, options))
}

/// Reads the plan on an [`image`] of the lines.
///
/// # Errors
/// If there is none; with what was found, if anything was drawn.
fn painted(
    lines: Lines,
    means: Option<&[Means]>,
    legends: &[Legend],
) -> Result<Plan, Option<Box<Stopped>>> {
    let (painted, options) = image(lines, means).ok_or(None)?;
    let plan = match super::read(&painted.picture, legends, &options) {
        Ok(Plan::Grid(found)) if !is_clear(&found) => {
            match walls::found(&found.flat, &found.ink, &options) {
                Some(walls) => Ok(Plan::Walls(Box::new(walls))),
                None => Err(found.stopped(super::Refused::NoHouse)),
            }
        }
        plan => plan,
    };
    let map = |flat: &mut Flat| flat.to_picture = painted.to_drawing * flat.to_picture;
    match plan {
        Ok(mut plan) => {
            map(plan.flat_mut());
            Ok(plan)
        }
        Err(mut stopped) => {
            map(&mut stopped.flat);
            Err(Some(stopped))
        }
    }
}

/// Returns how far most of the lines of a drawing are turned from its axes, radians; 0 if hardly.
fn skew(lines: &Lines) -> f64 {
    let all = || {
        let sides = lines.strokes.iter().flat_map(|s| s.points.windows(2));
        sides
            .map(|side| side[1] - side[0])
            .filter(|way| way.length() > 0.0)
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let angle = |way: DVec2| libm::atan2(way.y, way.x).rem_euclid(quarter);
    let bin = |angle: f64| ((angle / quarter * DIRECTIONS as f64) as usize).min(DIRECTIONS - 1);
    let mut lengths = vec![0.0; DIRECTIONS];
    all().for_each(|way| lengths[bin(angle(way))] += way.length());
    let fullest = (0..DIRECTIONS).max_by(|a, b| lengths[*a].total_cmp(&lengths[*b]));
    let middle = (fullest.unwrap_or(0) as f64 + 0.5) / DIRECTIONS as f64 * quarter;
    let (mut sum, mut weight) = (0.0, 0.0);
    for way in all() {
        let off = (angle(way) - middle + quarter / 2.0).rem_euclid(quarter) - quarter / 2.0;
        if off.abs() <= quarter / DIRECTIONS as f64 {
            (sum, weight) = (sum + off * way.length(), weight + way.length());
        }
    }
    let turned = if weight > 0.0 {
        middle + sum / weight
    } else {
        0.0
    };
    let turned = if turned > quarter / 2.0 {
        turned - quarter
    } else {
        turned
    };
    if turned.abs() > LEAST_SKEW {
        turned
    } else {
        0.0
    }
}

/// Finds the house in a drawing on a grid of half ken, by the roles of its layers or as in an image.
///
/// `unit_mm` is the length of half a ken in millimetres, if known.
///
/// # Errors
/// If there is none.
pub fn find(
    mut lines: Lines,
    roles: &Roles,
    unit_mm: Option<f64>,
    legends: &[Legend],
    front: Front,
) -> Result<Drawn, vector::Refused> {
    let names = match by_roles(lines.clone(), roles, unit_mm, front) {
        Err(vector::Refused::NoRoles(names)) => names,
        found => return found,
    };
    let back = turn(&mut lines, front);
    let painted = paint::paint(&lines);
    let found = painted.and_then(|painted| {
        let mut found = super::find(&painted.picture, legends, &Options::default()).ok()?;
        found.flat.to_picture = back * painted.to_drawing * found.flat.to_picture;
        Some(found)
    });
    let found = found
        .filter(is_clear)
        .ok_or(vector::Refused::NoRoles(names))?;
    Ok(Drawn::mute(found))
}

/// Finds the house in the lines of a drawing by the roles of its layers, blocks and colours.
///
/// `unit_mm` is the length of half a ken in millimetres, if known.
fn by_roles(
    mut lines: Lines,
    roles: &Roles,
    unit_mm: Option<f64>,
    front: Front,
) -> Result<Drawn, vector::Refused> {
    let back = turn(&mut lines, front);
    let Some(painted) = paint::paint(&lines) else {
        return Err(vector::Refused::Blank);
    };
    let to_drawing = back * painted.to_drawing;
    let found = vector::find(lines, roles, unit_mm)?;
    Ok(Drawn {
        shaku: found.shaku(),
        unknown: unknown(&found),
        found: as_picture(found, &painted, to_drawing),
    })
}

/// Whether the walls round a house are clear: a clean drawing has few in doubt, and other drawings that close by chance many.
fn is_clear(found: &Found) -> bool {
    let outer = &found.shape.outer;
    let doubts = outer.iter().filter(|wall| is_doubtful(wall)).count();
    doubts * 3 < outer.len()
}

fn unknown(found: &vector::Found) -> Vec<String> {
    let mut unknown: Vec<(&str, usize)> = found.unknown().into_iter().collect();
    unknown.sort_by_key(|(name, count)| (usize::MAX - count, *name));
    let named = unknown.into_iter().map(|(name, _)| name.to_owned());
    named.filter(|name| !name.is_empty()).collect()
}

fn as_picture(found: vector::Found, painted: &paint::Painted, to_drawing: DMat3) -> Found {
    let sheet = painted.picture.pixels.clone();
    let grid = found.grid;
    let to_sheet = painted.to_drawing.inverse()
        * DMat3::from_translation(grid.origin)
        * DMat3::from_scale(DVec2::splat(grid.unit));
    let unit = to_sheet.transform_vector2(DVec2::X).x;
    let ink = Ink::of(&sheet);
    Found {
        flat: Flat {
            sheet,
            to_picture: to_drawing,
            corners: None,
            skew: 0.0,
            plans: several::plans(&ink).map_or(vec![], |several| several.regions),
        },
        ink,
        grid: Grid {
            to_sheet,
            across: found.units.across,
            down: found.units.down,
            fit: grid.fit,
            unit,
            residual: 0.0,
        },
        units: found.units,
        shape: found.shape,
        legend: "cad".to_owned(),
    }
}

/// Turns a drawing so that the street is at its lower edge; returns what turns places back.
fn turn(lines: &mut Lines, front: Front) -> DMat3 {
    let turned = |p: DVec2| match front {
        Front::Bottom => p,
        Front::Top => -p,
        Front::Left => dvec2(p.y, -p.x),
        Front::Right => dvec2(-p.y, p.x),
    };
    for point in lines.strokes.iter_mut().flat_map(|s| &mut s.points) {
        *point = turned(*point);
    }
    let to = DMat3::from_cols(
        turned(DVec2::X).extend(0.0),
        turned(DVec2::Y).extend(0.0),
        glam::DVec3::Z,
    );
    to.inverse()
}
