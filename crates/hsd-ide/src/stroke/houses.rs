//! Strokes that add and remove houses.

pub(super) mod ground;

use super::change::tidy;
use super::find::{self, Written};
use super::outline::{self, Walk};
use super::storeys::checked;
use super::xml::{gap_before, gone, plain};
use super::{legacy, refuse};
use crate::format::Edit;
use crate::sections;
use crate::stroke::sheet::{Sheet, name};
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::{Heading, SHAKU};
use hsd_ir::building::House;
use hsd_syntax::parse::syntax::Element;
use hsd_syntax::parse::syntax::LineKind;

/// The default height of a first storey in shaku.
const HEIGHT: f64 = 9.5;

/// The origin and unit of a new house.
struct Site {
    east: f64,
    north: f64,
    azimuth: f64,
    /// One U in shaku.
    unit: f64,
}

impl Site {
    /// Returns the site with its origin at a place in the plan of a house, or of the world.
    fn of(house: Option<&House>, place: DVec2) -> Site {
        let (origin, azimuth, unit) = match house {
            Some(house) => (house.origin, house.azimuth, house.unit),
            None => ([0.0; 3], 180.0, 3.0 * SHAKU),
        };
        let way = Heading::new(azimuth - 180.0).vector();
        let p = dvec2(-place.x, place.y) * unit;
        Site {
            east: origin[0] + p.x * way.x + p.y * way.y,
            north: origin[1] - p.x * way.y + p.y * way.x,
            azimuth,
            unit: unit / SHAKU,
        }
    }

    fn is_usual(&self) -> bool {
        (self.unit - 3.0).abs() < 1e-9
    }
}

/// Adds a house.
pub(super) fn draw(
    sheet: &Sheet<'_>,
    drawn: &[[f64; 2]],
    height: Option<f64>,
    house: Option<usize>,
) -> Result<Vec<Edit>, Text> {
    let corners = outline::checked(drawn)?;
    let height = checked(height.unwrap_or(HEIGHT))?;
    let houses = &sheet.a.checked.building.houses;
    let site = Site::of(
        house.and_then(|h| houses.get(h)).map(|b| &b.house),
        corners[0],
    );
    let codes = vec![super::draft::PLAIN.to_owned(); corners.len()];
    let walk = Walk::new(&corners, &codes, false)?.at_origin().with_door();
    let first = sheet.text.trim_start().chars().next();
    let edits = match first {
        Some('<' | '＜') => element(sheet, &site, &walk, height)?,
        _ => vec![lines(sheet, &site, &walk, height)?],
    };
    Ok(tidy(edits))
}

/// Adds a house at the end of a legacy file.
fn lines(sheet: &Sheet<'_>, site: &Site, walk: &Walk, height: f64) -> Result<Edit, Text> {
    let text = sheet.text;
    let end = legacy::line_end(text, 0);
    let (x, y, azimuth) = (plain(site.east), plain(site.north), plain(site.azimuth));
    let mut house = vec![format!("{x} {y} {azimuth}"), plain(height)];
    if !site.is_usual() {
        house.push(format!("unit {}", plain(site.unit)));
    }
    house.push(String::new());
    house.extend(walk.lines()?);
    let house: String = house.iter().map(|l| format!("{l}{end}")).collect();
    let open = sheet.outline.lines.iter().rev();
    let mut open = open.take_while(|l| l.kind != LineKind::Separator);
    let begun = open.any(|l| matches!(l.kind, LineKind::Wall | LineKind::Header | LineKind::Roof));
    let parted = if begun {
        format!("%{end}")
    } else {
        String::new()
    };
    let written = text
        .trim_end_matches(['\r', '\n', ' ', '\t', '\u{1a}', '\u{3000}'])
        .len();
    let gap = if written == 0 || text[written..].contains(['\r', '\n']) {
        ""
    } else {
        end
    };
    // A file may end with Ctrl-Z.
    let at = text.trim_end_matches('\u{1a}').len();
    let text = [gap, &parted, &house].concat();
    Ok(Edit {
        range: at..at,
        text,
    })
}

/// Adds a house after the last one of an XML file.
fn element(sheet: &Sheet<'_>, site: &Site, walk: &Walk, height: f64) -> Result<Vec<Edit>, Text> {
    let elements = &sheet.outline.elements;
    let roots: Vec<_> = elements.iter().filter(|e| e.parent.is_none()).collect();
    let [root] = roots[..] else {
        return Err(refuse::structure());
    };
    let end = legacy::line_end(sheet.text, root.range.start);
    let (x, y) = (plain(site.east), plain(site.north));
    let azimuth = match (site.azimuth - 180.0).abs() < 1e-9 {
        true => String::new(),
        false => format!(" azimuth=\"{}\"", plain(site.azimuth)),
    };
    let unit = match site.is_usual() {
        true => String::new(),
        false => format!(" unit=\"{}\"", plain(site.unit)),
    };
    let rows = walk.rows();
    let rows: String = rows.iter().map(|r| format!("{end}      {r}")).collect();
    let house = format!(
        "  <House x=\"{x}\" y=\"{y}\"{azimuth}{unit}>{end}    <Storey height=\"{}\">{rows}{end}    </Storey>{end}  </House>{end}",
        plain(height)
    );
    behind(sheet, root, &house, end)
}

/// Inserts a house after the last one below a root; a single root house becomes one of several.
fn behind(sheet: &Sheet<'_>, root: &Element, house: &str, end: &str) -> Result<Vec<Edit>, Text> {
    let put = |at: usize, text: String| Edit {
        range: at..at,
        text,
    };
    let closing = root.end_name.as_ref().map(|n| n.start - 2);
    match (name(root), closing) {
        ("Houses", Some(at)) => {
            let before = sheet.text[..at].trim_end_matches([' ', '\t']);
            Ok(vec![match before.ends_with(['\n', '\r']) {
                true => put(before.len(), house.to_owned()),
                false => put(at, format!("{end}{house}")),
            }])
        }
        ("House", Some(_)) => Ok(vec![
            put(root.range.start, format!("<Houses>{end}")),
            put(root.range.end, format!("{end}{house}</Houses>")),
        ]),
        _ => Err(refuse::structure()),
    }
}

/// Removes a house.
pub(super) fn remove(sheet: &Sheet<'_>, house: usize) -> Result<Vec<Edit>, Text> {
    let own = find::house(sheet, house)?;
    if sheet.a.checked.building.houses.len() < 2 {
        return Err(refuse::last_house());
    }
    match find::written_house(sheet, own)? {
        Written::Lines(lines) => lines_gone(sheet, &lines),
        Written::Element(element) => {
            let own = &sheet.outline.elements[element];
            let parent = own.parent.map(|p| name(&sheet.outline.elements[p]));
            if name(own) != "House" || parent != Some("Houses") {
                return Err(refuse::structure());
            }
            let range = own.range.clone();
            if sheet
                .outline
                .comments
                .iter()
                .any(|c| range.start <= c.start && c.end <= range.end)
            {
                return Err(refuse::comments());
            }
            let gap = gap_before(sheet.text, range.start);
            let bare = gap.is_empty() && sheet.text[..range.start].ends_with(['\n', '\r']);
            let edits = if bare {
                vec![Edit {
                    range,
                    text: String::new(),
                }]
            } else {
                gone(sheet, range)
            };
            Ok(tidy(edits))
        }
    }
}

/// Removes the lines of a house, and one of the lines that separate it from others.
fn lines_gone(sheet: &Sheet<'_>, house: &sections::House) -> Result<Vec<Edit>, Text> {
    let lines = &sheet.outline.lines;
    let own = &lines[house.lines.clone()];
    if own.iter().any(|l| l.kind == LineKind::Comment) {
        return Err(refuse::comments());
    }
    let parts = |l: &usize| lines[*l].kind == LineKind::Separator;
    let after = (house.lines.end..lines.len()).find(parts);
    let before = (0..house.lines.start).rev().find(parts);
    let range = match (after, before) {
        (Some(after), _) => house.lines.start..after + 1,
        (None, Some(before)) => before..house.lines.end,
        (None, None) => return Err(refuse::last_house()),
    };
    if lines[range.clone()]
        .iter()
        .any(|l| l.kind == LineKind::Comment)
    {
        return Err(refuse::comments());
    }
    let first = legacy::whole_line(sheet, lines[range.start].range.clone());
    let last = legacy::whole_line(sheet, lines[range.end - 1].range.clone());
    let range = first.start.min(last.start)..last.end.max(first.end);
    Ok(vec![Edit {
        range,
        text: String::new(),
    }])
}
