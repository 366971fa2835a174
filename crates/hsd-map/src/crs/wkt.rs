//! Well-known text of reference systems, as in `.prj` files: both versions, as far as maps of towns use them.

use super::{Crs, Datum, Meridian, Projection, table};

/// The nesting that is read; real texts have five levels.
const DEEPEST: usize = 32;

/// A node: `NAME[items]`.
struct Node<'a> {
    name: &'a str,
    items: Vec<Item<'a>>,
}

enum Item<'a> {
    Node(Node<'a>),
    Text(&'a str),
    Number(f64),
}

/// Returns the system that a text describes.
pub(super) fn crs(text: &str) -> Option<Crs> {
    let text = text.trim().trim_start_matches('\u{feff}');
    let (root, _) = node(text, 0)?;
    // A compound system, or one bound to another by a shift, has the horizontal one inside.
    let root = horizontal(&root)?;
    if let Some(known) = root.code().and_then(Crs::from_epsg) {
        return Some(known);
    }
    let geographic = ["GEOGCS", "GEOGCRS", "GEODCRS", "BASEGEOGCRS", "BASEGEODCRS"];
    let base = match geographic.iter().any(|n| root.is(n)) {
        true => return degrees(root),
        false => geographic.iter().find_map(|name| root.child(name))?,
    };
    projected(root, datum(base)?)
}

fn horizontal<'a, 't>(root: &'a Node<'t>) -> Option<&'a Node<'t>> {
    let inner = ["PROJCS", "PROJCRS", "GEOGCS", "GEOGCRS", "GEODCRS"];
    if inner.iter().any(|n| root.is(n)) {
        return Some(root);
    }
    root.children().find_map(horizontal)
}

fn degrees(root: &Node<'_>) -> Option<Crs> {
    let datum = datum(root)?;
    // Units other than degrees are as good as unknown.
    let unit = ["UNIT", "ANGLEUNIT"].iter().find_map(|n| root.child(n));
    let unit = unit.and_then(Node::number).unwrap_or(1f64.to_radians());
    if (unit - 1f64.to_radians()).abs() > 1e-9 {
        return None;
    }
    let code = match &datum {
        Datum::Wgs84 => Some(4326),
        Datum::Jgd2011 => Some(6668),
        Datum::Jgd2000 => Some(4612),
        Datum::Tokyo => Some(4301),
        Datum::Other { .. } | Datum::Local => None,
    };
    let known = code.and_then(Crs::from_epsg);
    known.or_else(|| {
        Some(Crs {
            name: root.text()?.into(),
            datum,
            projection: Projection::Degrees,
        })
    })
}

/// Names of parameters in both versions, small and without signs.
const LATITUDE: [&str; 3] = [
    "latitudeoforigin",
    "latitudeofnaturalorigin",
    "latitudeoffalseorigin",
];
const LONGITUDE: [&str; 3] = [
    "centralmeridian",
    "longitudeofnaturalorigin",
    "longitudeoffalseorigin",
];
const SCALE: [&str; 2] = ["scalefactor", "scalefactoratnaturalorigin"];
const EAST: [&str; 2] = ["falseeasting", "eastingatfalseorigin"];
const NORTH: [&str; 2] = ["falsenorthing", "northingatfalseorigin"];
const PARALLELS: [[&str; 2]; 2] = [
    ["standardparallel1", "latitudeof1ststandardparallel"],
    ["standardparallel2", "latitudeof2ndstandardparallel"],
];

fn projected(root: &Node<'_>, datum: Datum) -> Option<Crs> {
    let inner = root.child("CONVERSION").unwrap_or(root);
    let method = inner.child("PROJECTION").or(inner.child("METHOD"))?;
    let method = plain(method.text()?);
    if method.contains("mercatorauxiliarysphere") || method.contains("pseudomercator") {
        return Crs::from_epsg(3857);
    }
    let unit = ["UNIT", "LENGTHUNIT"].iter().find_map(|n| root.child(n));
    let unit = unit.and_then(Node::number).unwrap_or(1.0);
    let value = |names: &[&str]| inner.parameter(names);
    let meridian = Meridian {
        lat: value(&LATITUDE).unwrap_or(0.0),
        lon: value(&LONGITUDE).unwrap_or(0.0),
        scale: value(&SCALE).unwrap_or(1.0),
        east: value(&EAST).unwrap_or(0.0) * unit,
        north: value(&NORTH).unwrap_or(0.0) * unit,
        unit,
    };
    let is_usable = unit > 0.0 && meridian.scale > 0.0;
    let projection = match method.as_str() {
        _ if !is_usable => return None,
        "transversemercator" | "gausskruger" => Projection::TransverseMercator(meridian),
        _ if method.starts_with("lambertcon") => {
            let first = value(&PARALLELS[0]).unwrap_or(meridian.lat);
            let second = value(&PARALLELS[1]).unwrap_or(first);
            Projection::Defined(meridian.conic([first, second]))
        }
        _ => return None,
    };
    let known = match projection {
        Projection::TransverseMercator(_) => table::of_meridian(&datum, &meridian),
        _ => None,
    };
    Some(known.unwrap_or_else(|| Crs {
        name: root.text().unwrap_or_default().into(),
        datum,
        projection,
    }))
}

impl Meridian {
    /// Returns the definition of a conic projection with the same origin and these standard parallels, in degrees.
    fn conic(&self, [first, second]: [f64; 2]) -> Box<str> {
        let origin = format!(
            "+lat_0={} +lon_0={} +k_0={}",
            self.lat, self.lon, self.scale
        );
        let place = format!(
            "+x_0={} +y_0={} +to_meter={}",
            self.east, self.north, self.unit
        );
        format!("+proj=lcc +lat_1={first} +lat_2={second} {origin} {place}").into()
    }
}

/// Returns the datum of a geographic system by its name.
fn datum(base: &Node<'_>) -> Option<Datum> {
    let node = ["DATUM", "GEODETICDATUM", "TRF", "ENSEMBLE"];
    let node = node.iter().find_map(|name| base.child(name))?;
    let name = plain(node.text()?);
    let name = name
        .strip_prefix("d")
        .filter(|n| !n.starts_with("atum"))
        .unwrap_or(&name);
    Some(match name {
        "wgs1984" | "wgs84" | "worldgeodeticsystem1984" | "worldgeodeticsystem1984ensemble" => {
            Datum::Wgs84
        }
        // They agree with WGS 84 within a metre.
        "northamerican1983"
        | "northamericandatum1983"
        | "etrs1989"
        | "europeanterrestrialreferencesystem1989"
        | "europeanterrestrialreferencesystem1989ensemble" => Datum::Wgs84,
        "jgd2011" | "japanesegeodeticdatum2011" => Datum::Jgd2011,
        "jgd2000" | "japanesegeodeticdatum2000" => Datum::Jgd2000,
        "tokyo" => Datum::Tokyo,
        _ => {
            let ellipsoid = ["SPHEROID", "ELLIPSOID"]
                .iter()
                .find_map(|n| node.child(n))?;
            let mut numbers = ellipsoid.numbers();
            let (a, rf) = (numbers.next()?, numbers.next()?);
            let sane = (6.0e6..7.0e6).contains(&a) && (rf == 0.0 || rf > 100.0);
            let name = node.text()?.into();
            let definition = match rf > 0.0 {
                true => format!("+a={a} +rf={rf}").into(),
                false => format!("+a={a} +b={a}").into(),
            };
            return sane.then_some(Datum::Other { name, definition });
        }
    })
}

/// Returns a name in small letters and digits only, so that spellings agree.
fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| c.is_alphanumeric());
    kept.flat_map(char::to_lowercase).collect()
}

impl<'a> Node<'a> {
    fn is(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }

    fn children(&self) -> impl Iterator<Item = &Node<'a>> {
        self.items.iter().filter_map(|item| match item {
            Item::Node(node) => Some(node),
            Item::Text(_) | Item::Number(_) => None,
        })
    }

    fn child(&self, name: &str) -> Option<&Node<'a>> {
        self.children().find(|c| c.is(name))
    }

    fn text(&self) -> Option<&'a str> {
        self.items.iter().find_map(|item| match item {
            Item::Text(text) => Some(*text),
            Item::Node(_) | Item::Number(_) => None,
        })
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.items.iter().filter_map(|item| match item {
            Item::Number(number) => Some(*number),
            Item::Node(_) | Item::Text(_) => None,
        })
    }

    /// Returns the value of a parameter by its names.
    fn parameter(&self, names: &[&str]) -> Option<f64> {
        let mut parameters = self.children().filter(|c| c.is("PARAMETER"));
        let named = parameters.find(|p| {
            let name = p.text().map(plain).unwrap_or_default();
            names.contains(&name.as_str())
        });
        named.and_then(Node::number)
    }

    fn number(&self) -> Option<f64> {
        self.numbers().next()
    }

    /// Returns its EPSG code, `AUTHORITY["EPSG","6674"]` or `ID["EPSG",6674]`.
    fn code(&self) -> Option<u32> {
        let id = self.child("AUTHORITY").or(self.child("ID"))?;
        if !id.text()?.eq_ignore_ascii_case("EPSG") {
            return None;
        }
        id.items.iter().skip(1).find_map(|item| match item {
            Item::Text(text) => text.trim().parse().ok(),
            Item::Number(number) => Some(*number as u32),
            Item::Node(_) => None,
        })
    }
}

/// Reads a node; returns it and what follows.
fn node(text: &str, depth: usize) -> Option<(Node<'_>, &str)> {
    let text = text.trim_start();
    let open = text.find(['[', '('])?;
    let name = text[..open].trim();
    let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if depth > DEEPEST || name.is_empty() || !name.chars().all(of_word) {
        return None;
    }
    let (mut items, mut rest) = (vec![], &text[open + 1..]);
    loop {
        rest = rest.trim_start().trim_start_matches(',').trim_start();
        if let Some(after) = rest.strip_prefix([']', ')']) {
            return Some((Node { name, items }, after));
        }
        let (item, after) = item(rest, depth)?;
        items.push(item);
        rest = after;
    }
}

fn item(text: &str, depth: usize) -> Option<(Item<'_>, &str)> {
    if let Some(quoted) = text.strip_prefix('"') {
        let end = quoted.find('"')?;
        return Some((Item::Text(&quoted[..end]), &quoted[end + 1..]));
    }
    let end = text.find([',', '[', ']', '(', ')'])?;
    if text[end..].starts_with(['[', '(']) {
        let (inner, after) = node(text, depth + 1)?;
        return Some((Item::Node(inner), after));
    }
    let word = text[..end].trim();
    let item = match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Item::Number(number),
        _ => Item::Text(word), // a bare word, such as the direction of an axis
    };
    Some((item, &text[end..]))
}
