//! Writes a first town: layers with what was found, rules that a reader can change, comments that say how.

use super::fields::{Fields, Use};
use super::sheets::standing;
use super::{Kind, Plane, Surveyed};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Fields that are listed in a comment.
const MOST_LISTED: usize = 14;
/// Values of a field that a test names.
const MOST_NAMED: usize = 12;

/// Returns a town over some layers, in the order given; `name` is its name.
pub fn town(name: &str, layers: &[Surveyed]) -> String {
    let stands = standing(layers);
    let of = |wanted: bool| {
        let all = layers.iter().zip(&stands);
        let all = all.filter(move |(_, stands)| **stands == wanted);
        all.map(|(layer, _)| layer).collect::<Vec<&Surveyed>>()
    };
    let (layers, apart) = (&of(true)[..], of(false));
    let names = names(layers);
    let mut out = format!(
        "<!-- A first town, written by `hsd town init` from what the maps say. Change anything: the layers say what is known,\n     \
         the `for`s say what is built on it. Build it with\n\n       hsd town {}.hsd -o {}.glb\n\n     \
         A place keeps its house while the seed stays the same. -->\n<Town name=\"{}\" seed=\"1\">\n",
        escaped(name),
        escaped(name),
        escaped(name)
    );
    for (layer, name) in layers.iter().zip(&names) {
        write_layer(&mut out, layer, name);
    }
    left_out(&mut out, &apart);
    let has_houses = layers.iter().any(|l| l.kind == Kind::Houses);
    for (layer, name) in layers.iter().zip(&names) {
        match layer.kind {
            Kind::Houses => houses(&mut out, layer, name),
            Kind::Lots if !has_houses => lots(&mut out, name),
            _ => {}
        }
    }
    if !layers
        .iter()
        .any(|l| matches!(l.kind, Kind::Houses | Kind::Lots))
    {
        nothing(&mut out, layers, &names);
    }
    out.push_str("</Town>\n");
    out
}

/// Returns a name for each layer, all different.
fn names(layers: &[&Surveyed]) -> Vec<String> {
    let mut used: BTreeMap<&str, usize> = BTreeMap::new();
    let mut of = |layer: &&Surveyed| {
        let word = match layer.kind {
            Kind::Houses => "houses",
            Kind::Lots => "lots",
            Kind::Roads => "roads",
            Kind::Blocks => "blocks",
            Kind::Trees => "trees",
            Kind::Areas => "areas",
            Kind::Lines => "lines",
            Kind::Places => "places",
            Kind::Heights => "ground",
        };
        let count = used.entry(word).or_default();
        *count += 1;
        match *count {
            1 => word.to_owned(),
            n => format!("{word}{n}"),
        }
    };
    layers.iter().map(&mut of).collect()
}

/// Returns the number of features as a comment begins with it; a grid has none.
fn count(layer: &Surveyed) -> String {
    match layer.kind {
        Kind::Heights => String::new(),
        _ => format!("{}: ", layer.features),
    }
}

/// Writes what is known, or assumed, of the coordinates of a layer.
fn write_plane(out: &mut String, layer: &Surveyed) {
    match layer.plane {
        Plane::Metres => out.push_str(
            "\n       The file does not say its coordinates, which can be no degrees: they are taken as metres. If they are of a\n       \
             plane zone, say which: crs=\"EPSG:6674\".",
        ),
        Plane::Degrees => out.push_str(
            "\n       The file does not say its coordinates: they are taken as longitude and latitude.",
        ),
        Plane::OwnSurvey => out.push_str(
            "\n       The file has metres of a survey of its own, and does not say where that lies on the earth.",
        ),
        Plane::Said(_) => {}
    }
}

/// Lists the fields of a layer and how often they have a value.
fn write_fields(out: &mut String, layer: &Surveyed) {
    let fields: Vec<(&str, usize)> = layer.fields.shares().collect();
    if !fields.is_empty() {
        out.push_str("\n       Fields, and how many features of a hundred have them:");
        for (n, (field, share)) in fields.iter().take(MOST_LISTED).enumerate() {
            let lead = if n % 4 == 0 { "\n         " } else { "  " };
            let _ = write!(out, "{lead}{} {share}", comment(field));
        }
        if fields.len() > MOST_LISTED {
            let _ = write!(out, "  and {} more", fields.len() - MOST_LISTED);
        }
    }
}

fn write_layer(out: &mut String, layer: &Surveyed, name: &str) {
    let what = match layer.kind {
        Kind::Houses => "outlines of buildings",
        Kind::Lots => "lots",
        Kind::Roads => "streets: houses front the nearest one",
        Kind::Blocks => "blocks: houses front their sides",
        Kind::Trees => "trees; nothing is made of them yet",
        Kind::Areas => "other areas; nothing is made of them yet",
        Kind::Lines => "other lines; nothing is made of them yet",
        Kind::Places => "places; nothing is made of them yet",
        Kind::Heights => "heights: the ground on which houses stand, on plinths where it slopes",
    };
    let count = count(layer);
    let _ = write!(out, "\n  <!-- {count}{what}.");
    if let Some((outline, order)) = &layer.vertices {
        let (outline, order) = (comment(outline), comment(order));
        let _ = write!(
            out,
            "\n       A table of vertices: {outline} says to which outline a point belongs, {order} is its number in that."
        );
    }
    write_fields(out, layer);
    write_plane(out, layer);
    let _ = write!(
        out,
        " -->\n  <Layer name=\"{name}\" src=\"{}\"",
        escaped(&layer.src)
    );
    let (outline, order) = layer
        .vertices
        .as_ref()
        .map(|(by, order)| (&**by, &**order))
        .unzip();
    // The key of an outline is its id.
    let key = layer.fields.key().filter(|_| layer.vertices.is_none());
    let of = [
        ("layer", layer.layer),
        ("outline", outline),
        ("order", order),
        ("crs", (layer.plane == Plane::Metres).then_some("local")),
        ("encoding", layer.encoding),
        ("key", key),
    ];
    for (attribute, value) in of {
        if let Some(value) = value {
            let _ = write!(out, " {attribute}=\"{}\"", escaped(value));
        }
    }
    let fields = meanings(layer);
    match &fields[..] {
        [] => out.push_str("/>\n"),
        fields => {
            out.push_str(">\n");
            fields.iter().for_each(|f| {
                let _ = writeln!(out, "    {f}");
            });
            out.push_str("  </Layer>\n");
        }
    }
}

/// Names the layers that have no place in the town, in a comment.
fn left_out(out: &mut String, layers: &[&Surveyed]) {
    if layers.is_empty() {
        return;
    }
    out.push_str(
        "\n  <!-- Not in this town: their metres have no common zero with the maps above, and nothing says where they lie.\n       \
         Each can be a town of its own; if you know the plane zone of one, name it as `crs` and take it in.\n",
    );
    for layer in layers {
        let (count, src) = (count(layer), comment(&escaped(&layer.src)));
        let _ = writeln!(out, "         {count}src=\"{src}\"");
    }
    out.push_str("  -->\n");
}

/// Returns the `Field`s that give plain names to what the rules ask for.
fn meanings(layer: &Surveyed) -> Vec<String> {
    let (fields, mut all) = (&layer.fields, vec![]);
    let mut add = |name: &str, from: &str, rest: &str| {
        let from = escaped(from);
        all.push(format!("<Field name=\"{name}\" from=\"{from}\" {rest}/>"));
    };
    match layer.kind {
        Kind::Houses => {
            if let Some(from) = fields.levels() {
                add("levels", from, "type=\"number\" default=\"2\"");
            }
            if let Some(from) = fields.height() {
                add("high", from, "type=\"number\" default=\"7\"");
            }
            if let Some((from, _)) = fields.kind() {
                add("kind", from, "type=\"text\" default=\"-\"");
            }
        }
        Kind::Roads => {
            if let Some(from) = fields.width().filter(|from| *from != "width") {
                add("width", from, "type=\"number\"");
            }
        }
        _ => {}
    }
    all
}

/// Kinds of buildings that have a type over outlines, the most storeys of that, and what they are.
const OVER_OUTLINES: [(Use, &str, u32, &str); 5] = [
    (Use::Temple, "temple", 1, "temples and shrines"),
    (Use::Hospital, "hospital", 14, "hospitals"),
    (Use::School, "school", 5, "schools"),
    (
        Use::Shops,
        "shop-row",
        3,
        "shops: one in every spacing of the front",
    ),
    (Use::Detached, "house", 3, "detached dwellings"),
];

/// Returns the `Place` of a type over outlines, with the storeys that the map knows of.
fn over_outline(fields: &Fields, house: &str, most: u32) -> String {
    let known = match (fields.levels(), fields.height()) {
        (Some(_), _) => "levels",
        (None, Some(_)) => "high / 3.4",
        (None, None) => return format!("<Place type=\"{house}\"/>"),
    };
    if most == 1 {
        return format!("<Place type=\"{house}\"/>");
    }
    format!("<Place type=\"{house}\" storeys=\"{{max(1, min({most}, round({known})))}}\"/>")
}

/// Writes the rules of buildings.
fn houses(out: &mut String, layer: &Surveyed, name: &str) {
    let fields = &layer.fields;
    let sheds = test_of(&fields.uses(Use::Shed));
    let small = match &sheds {
        Some(sheds) => format!("area < 9 or {sheds}"),
        None => "area < 9".to_owned(),
    };
    let large = fields.uses(Use::Large);
    let mut tall: Vec<String> = vec![];
    if fields.levels().is_some() {
        tall.push("levels > 3".to_owned());
    }
    if fields.height().is_some() {
        tall.push("high > 12".to_owned());
    }
    tall.extend(test_of(&large).map(|kinds| format!("area > 200 and {kinds}")));
    tall.push("area > 1000".to_owned());
    let small = escaped(&small);
    let _ = write!(
        out,
        "\n  <!-- Sheds get no house. -->\n  <for each=\"{name}\" test=\"{{{small}}}\"><Skip because=\"a shed\"/></for>\n\
         \n  <!-- The rest. The first test that holds decides. -->\n  <for each=\"{name}\" test=\"{{not ({small})}}\">\n",
    );
    let mut cases: Vec<(String, String, &str)> = vec![];
    for (kind, house, most, what) in OVER_OUTLINES {
        if let Some(test) = test_of(&fields.uses(kind)) {
            cases.push((test, over_outline(fields, house, most), what));
        }
    }
    cases.push((
        tall.join(" or "),
        over_outline(fields, "block", 40),
        "large buildings",
    ));
    if let Some(stores) = test_of(&fields.uses(Use::Store)) {
        cases.push((
            stores,
            "<Place type=\"kura\" on=\"centre\"/>".into(),
            "storehouses",
        ));
    }
    cases.push((
        "frontage < 2.7".into(),
        "<Place type=\"hiraya\" on=\"outline\"/>".into(),
        "too narrow for a rectangle: walls along the outline",
    ));
    let low = match (fields.levels(), fields.height()) {
        (Some(_), _) => Some("levels < 2"),
        (None, Some(_)) => Some("high < 5"),
        (None, None) => None,
    };
    if let Some(low) = low {
        cases.push((low.into(), "<Place type=\"hiraya\"/>".into(), "one storey"));
    }
    write_cases(out, &cases, 2, &mut |out, depth| drawn(out, depth));
    out.push_str("  </for>\n");
}

/// Writes tests one in the other, and what remains.
fn write_cases(
    out: &mut String,
    cases: &[(String, String, &str)],
    depth: usize,
    rest: &mut dyn FnMut(&mut String, usize),
) {
    let pad = "  ".repeat(depth);
    let Some(((test, made, why), others)) = cases.split_first() else {
        rest(out, depth);
        return;
    };
    let _ = write!(
        out,
        "{pad}<!-- {why} -->\n{pad}<if test=\"{{{}}}\">{made}</if>\n{pad}<else>\n",
        escaped(test)
    );
    write_cases(out, others, depth + 1, rest);
    let _ = writeln!(out, "{pad}</else>");
}

/// Writes the draw of a type by the shares of Kyoto.
fn drawn(out: &mut String, depth: usize) {
    let pad = "  ".repeat(depth);
    let _ = writeln!(
        out,
        "{pad}<!-- town houses; the weights are the shares of types in Kyoto in 1998 -->\n{pad}<random>"
    );
    for (kind, weight) in [
        ("so-nikai", 40.5),
        ("kanban", 20.4),
        ("chu-nikai", 19.3),
        ("hiraya", 9.3),
        ("shimotaya", 5.7),
    ] {
        let _ = writeln!(
            out,
            "{pad}  <choice weight=\"{weight}\"><Place type=\"{kind}\"/></choice>"
        );
    }
    let _ = writeln!(out, "{pad}</random>");
}

/// Writes the rules of lots without buildings.
fn lots(out: &mut String, name: &str) {
    let _ = write!(
        out,
        "\n  <!-- Lots, not houses: a town house stands at the front of each lot up to 600 square metres, its depth by its type.\n       \
         Narrow strips and large lots stay empty. -->\n  \
         <for each=\"{name}\" test=\"{{frontage &lt; 2.7 or depth &lt; 4 or area > 600}}\"><Skip because=\"no lot of a town house\"/></for>\n  \
         <for each=\"{name}\" test=\"{{frontage >= 2.7 and depth >= 4 and area &lt;= 600}}\">\n",
    );
    drawn(out, 2);
    out.push_str("  </for>\n");
}

/// Writes rules for maps without houses or lots: nothing is built, and it is said how something would be.
fn nothing(out: &mut String, layers: &[&Surveyed], names: &[String]) {
    for (layer, name) in layers.iter().zip(names) {
        let how = match layer.kind {
            Kind::Places | Kind::Trees => "<Place type=\"hiraya\" on=\"centre\"/>",
            Kind::Roads | Kind::Lines | Kind::Heights => continue,
            _ => "<Place type=\"kanban\" on=\"outline\"/>",
        };
        let _ = write!(
            out,
            "\n  <!-- No buildings and no lots: nothing is built. A house on each of these would be\n       {how} -->\n  \
             <for each=\"{name}\"><Skip because=\"no building\"/></for>\n",
        );
    }
}

/// Returns a test for some values of the field of kinds.
fn test_of(values: &[&str]) -> Option<String> {
    let quoted = |value: &&str| !value.contains(['\'', '{', '}']);
    let values = values
        .iter()
        .copied()
        .filter(|v| quoted(v))
        .take(MOST_NAMED);
    let tests: Vec<String> = values.map(|value| format!("kind = '{value}'")).collect();
    (!tests.is_empty()).then(|| format!("({})", tests.join(" or ")))
}

/// Writes a text so that it can stand in an attribute.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('"', "&quot;")
}

/// Writes a text so that it can stand in a comment.
fn comment(text: &str) -> String {
    text.replace("--", "- -")
}
