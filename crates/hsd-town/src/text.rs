//! The houses of a town as texts: each a `Place` of its type with all parameters, where it stands and the seed of its draws, or,
//! where the type is written in the town file, a copy of the house and a `Place` for it. A text is kept only if it reads
//! back as the house that the town builds.

use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::rng::Place;
use hsd_base::source::{FileId, Limits, Source, SourceCache};
use hsd_driver::FeatureHouse;
use hsd_ir::ast::town::{HouseText, SiteWalls, Stood};
use hsd_ir::ast::{House, Item, Piece, Stand, Value};
use hsd_map::{Area, Chain};
use hsd_syntax::parse::xml::{Trees, escaped};
use hsd_syntax::parse::{self, ReadContext};
use hsd_syntax::print::essence;
use hsd_syntax::templates::Template;
use std::fmt::Write;

/// What the text of a house says beside the house itself.
pub(super) struct Told<'a> {
    /// The type.
    pub(super) kind: &'a str,
    /// Its parameters.
    pub(super) parameters: &'a [(String, Value)],
    /// Where it stands.
    pub(super) stood: &'a Stood,
    /// The house with all expressions computed, as an element.
    pub(super) written: Option<&'a String>,
    /// The seed of the run.
    pub(super) seed: Option<u64>,
}

/// Writes a house, which has this name in the model.
pub(super) fn write(house: &House, name: &str, told: &Told<'_>) -> HouseText {
    // What a town builds all the same is an error in a file.
    if told.stood.walls.as_ref().is_some_and(crosses) {
        return HouseText {
            placed: None,
            own: String::new(),
        };
    }
    let is_type = Template::named(told.kind).is_some();
    let own = told.written.map(|written| {
        let kind = word_of(name);
        let place = place(house, name, &kind, told, &[]);
        format!(
            "<define name=\"{}\">{written}</define>\n{place}",
            escaped(&kind)
        )
    });
    HouseText {
        placed: is_type.then(|| place(house, name, told.kind, told, told.parameters)),
        own: own.unwrap_or_default(),
    }
}

/// Writes a house of rows or of a part alone, which stands by itself: a fence, a torii.
pub(super) fn lone(house: &House, name: &str) -> HouseText {
    let settings = &house.settings;
    let mut own = format!("<House name=\"{}\"", escaped(name));
    for (name, value) in [
        ("x", settings.x),
        ("y", settings.y),
        ("z", settings.z),
        ("azimuth", settings.azimuth),
    ] {
        let _ = write!(
            own,
            " {name}=\"{}\"",
            number(value.map_or(0.0, |v| v.value))
        );
    }
    own.push('>');
    for storey in &house.storeys {
        let Item::One(storey) = storey else { continue };
        own.push_str("<Storey");
        if let Some(height) = storey.height {
            let _ = write!(own, " height=\"{}\"", number(height.value));
        }
        own.push_str("><Loop inner=\"yes\">");
        for row in storey.loops.iter().flat_map(|walk| &walk.rows) {
            let Item::One(row) = row else { continue };
            let turn = row.turn.map_or(0.0, |turn| turn.value);
            let _ = write!(own, "<Row turn=\"{}\">", number(turn));
            row.pieces
                .iter()
                .for_each(|piece| lone_part(piece, &mut own));
            own.push_str("</Row>");
        }
        own.push_str("</Loop></Storey>");
    }
    for put in &house.fittings.puts {
        let _ = write!(
            own,
            "<Put code=\"{}\" at=\"0 0\"",
            escaped(put.code.value.as_str().trim_end())
        );
        for (name, value) in [("width", put.width), ("height", put.height)] {
            if let Some(value) = value {
                let _ = write!(own, " {name}=\"{}\"", number(value));
            }
        }
        own.push_str("/>");
    }
    if !house.storeys.is_empty() {
        own.push_str("<Roofs mode=\"explicit\"/>");
    }
    own.push_str("</House>");
    HouseText { placed: None, own }
}

fn lone_part(piece: &Item<Piece>, own: &mut String) {
    let Item::One(Piece::Part(part)) = piece else {
        return;
    };
    let _ = write!(
        own,
        "<Part code=\"{}\"",
        escaped(part.code.value.as_str().trim_end())
    );
    for (name, value) in [("width", part.width), ("height", part.height)] {
        if let Some(value) = value {
            let _ = write!(own, " {name}=\"{}\"", number(value.value));
        }
    }
    own.push_str("/>");
}

/// Returns true if the walls of an outline cross each other, or may do so.
fn crosses(walls: &SiteWalls) -> bool {
    let chain = |ring: &Vec<DVec2>| Chain::flat(ring.clone());
    let area = Area {
        outline: chain(&walls.ring),
        holes: walls.holes.iter().map(chain).collect(),
    };
    hsd_map::crosses(&area) != Ok(false)
}

/// Returns the name of a house as that of a definition, which must not look like a file.
fn word_of(name: &str) -> String {
    name.replace(['/', '.'], "-") + " house"
}

fn place(
    house: &House,
    name: &str,
    kind: &str,
    told: &Told<'_>,
    parameters: &[(String, Value)],
) -> String {
    let (stood, settings) = (told.stood, &house.settings);
    let mut text = String::from("<Place");
    let mut put = |attribute: &str, value: &str| {
        let _ = write!(text, " {attribute}=\"{}\"", escaped(value));
    };
    put("type", kind);
    put("name", name);
    put("x", &number(stood.at.x));
    put("y", &number(stood.at.y));
    if stood.z != 0.0 {
        put("z", &number(stood.z));
    }
    if stood.walls.is_none() {
        put("azimuth", &number(stood.azimuth));
    }
    if stood.centred {
        put("at", "centre");
    }
    if stood.plinth > 0.0 {
        put("plinth", &number(stood.plinth));
    }
    let seed = settings.seed.map_or(0, |seed| seed.value);
    let root = Place::seed(told.seed.unwrap_or(seed));
    let drawn = house
        .name
        .as_ref()
        .map_or(root.at(0), |own| root.named(&own.value));
    put("seed", &drawn.seed_under(name).to_string());
    if let Some(age) = settings.age {
        put("age", &number(age.value));
    }
    if let Some(era) = settings.era {
        put("era", era.value.word());
    }
    for (parameter, value) in parameters {
        put(parameter, &value.to_string());
    }
    match &stood.walls {
        None => text.push_str("/>"),
        Some(walls) => {
            text.push('>');
            outline(walls, &mut text);
            text.push_str("</Place>");
        }
    }
    text
}

fn outline(walls: &SiteWalls, text: &mut String) {
    let _ = write!(
        text,
        "<Outline points=\"{}\" front=\"{}\"",
        points(&walls.ring),
        walls.front
    );
    for (name, sides) in [("street", &walls.street), ("neighbour", &walls.neighbour)] {
        if !sides.is_empty() {
            let _ = write!(text, " {name}=\"{}\"", numbers(sides));
        }
    }
    text.push('>');
    for hole in &walls.holes {
        let _ = write!(text, "<Hole points=\"{}\"/>", points(hole));
    }
    text.push_str("</Outline>");
}

fn points(ring: &[DVec2]) -> String {
    let point = |p: &DVec2| format!("{} {}", number(p.x), number(p.y));
    ring.iter().map(point).collect::<Vec<_>>().join(", ")
}

fn numbers(list: &[u32]) -> String {
    let written: Vec<String> = list.iter().map(u32::to_string).collect();
    written.join(" ")
}

/// Writes a number with all its digits; no negative zero.
fn number(value: f64) -> String {
    (value + 0.0).to_string()
}

/// Reads the texts of houses back, and chooses for each the one that is the house.
pub(super) fn check(houses: &mut [FeatureHouse], limits: &Limits) {
    let read = read(houses.iter().map(text_of), limits);
    for (house, again) in houses.iter_mut().zip(read) {
        let same = again.is_some_and(|again| same(&house.house, &again));
        if let Some(text) = house.text.as_mut().filter(|_| !same) {
            text.placed = None;
        }
    }
    let own = |house: &&mut FeatureHouse| house.text.as_ref().is_some_and(|t| t.placed.is_none());
    let mut others: Vec<&mut FeatureHouse> = houses.iter_mut().filter(own).collect();
    let read = self::read(others.iter().map(|house| text_of(house)), limits);
    for (house, again) in others.iter_mut().zip(read) {
        let same = again.is_some_and(|again| same(&house.house, &again));
        if let Some(text) = house.text.as_mut().filter(|_| !same) {
            text.own.clear();
        }
    }
}

fn text_of(house: &FeatureHouse) -> &str {
    house.text.as_ref().map_or("", |text| text.text())
}

/// Reads texts, each of one house; `None` for one that is something else.
fn read<'t>(texts: impl Iterator<Item = &'t str>, limits: &Limits) -> Vec<Option<House>> {
    let sources: Vec<Source> = texts
        .map(|text| format!("<Houses>{text}</Houses>"))
        .map(|text| Source::new(FileId(0), "house.hsd", text.as_bytes()))
        .collect();
    let cache = SourceCache::new(1, limits.includes, limits.included_bytes);
    let setting = ReadContext {
        limits: *limits,
        ..ReadContext::alone(limits, &cache)
    };
    let each = |source| {
        let mut out = Diagnostics::new();
        let mut houses = parse::parse_in(source, setting, &mut Trees::default(), &mut out).houses;
        let sound = houses.len() == 1 && !out.has_errors();
        houses.pop().filter(|_| sound)
    };
    sources.iter().map(each).collect()
}

/// Returns true if two houses are the same apart from the names under which they draw. A surveyed outline does not turn, and
/// no sides are the same as an empty list of sides.
fn same(one: &House, other: &House) -> bool {
    let [one, other] = [one, other].map(|house| {
        let mut house = house.clone();
        house.name = None;
        house.settings.seed = None;
        house.placement = None;
        if let Some(outline) = &mut house.outline {
            let outline = &mut **outline;
            for sides in [&mut outline.street, &mut outline.neighbour] {
                *sides = sides.take().filter(|sides| !sides.value.is_empty());
            }
        }
        let surveyed = |o: &hsd_ir::ast::Outline| matches!(o.stand, Stand::Surveyed(_));
        if house.outline.as_deref().is_some_and(surveyed) {
            house.settings.azimuth = None;
        }
        essence(&house)
    });
    one == other
}
