//! Reference systems as PROJ defines them: the EPSG codes outside Japan.

use super::{Crs, Datum, Projection};

/// Parameters that say what the datum is.
const OF_DATUM: [&str; 7] = ["datum", "ellps", "a", "b", "rf", "towgs84", "nadgrids"];
/// Parameters that change nothing in a plane.
const IDLE: [&str; 3] = ["no_defs", "vunits", "type"];
/// Datums that agree with WGS 84 as far as maps of towns do: NAD83 is a metre off.
const MODERN: [&str; 2] = ["WGS84", "NAD83"];
/// Ellipsoids that agree with that of WGS 84.
const MODERN_ELLIPSOIDS: [&str; 2] = ["WGS84", "GRS80"];

/// Returns the system of a code.
pub(super) fn of_code(code: u32) -> Option<Crs> {
    let found = crs_definitions::from_code(u16::try_from(code).ok()?)?;
    let parameters: Vec<(&str, &str)> = found.proj4.split_whitespace().map(parameter).collect();
    let value = |name: &str| parameters.iter().find(|p| p.0 == name).map(|p| p.1);
    // Other meridians and axes to the south or west: hardly any map of houses has them.
    if value("pm").is_some() || value("axis").is_some() {
        return None;
    }
    let of = |is_wanted: &dyn Fn(&str) -> bool| -> Box<str> {
        let wanted = found.proj4.split_whitespace();
        let wanted = wanted.filter(|word| is_wanted(parameter(word).0));
        wanted.collect::<Vec<_>>().join(" ").into()
    };
    let projection = match value("proj")? {
        "geocent" => return None,
        "longlat" => Projection::Degrees,
        _ => Projection::Defined(of(&|name| {
            !OF_DATUM.contains(&name) && !IDLE.contains(&name)
        })),
    };
    let is_unshifted = |shift: &str| shift.split(',').all(|s| s.parse() == Ok(0.0));
    let is_modern = match (value("datum"), value("ellps"), value("towgs84")) {
        (Some(datum), ..) => MODERN.contains(&datum),
        (_, Some(ellipsoid), Some(shift)) => {
            MODERN_ELLIPSOIDS.contains(&ellipsoid) && is_unshifted(shift)
        }
        _ => false,
    };
    let datum = match is_modern {
        true => Datum::Wgs84,
        false => {
            let definition = of(&|name| OF_DATUM.contains(&name));
            Datum::Other {
                name: definition.clone(),
                definition,
            }
        }
    };
    let name = format!("EPSG:{code}").into();
    Some(Crs {
        name,
        datum,
        projection,
    })
}

/// Returns true if the unit of a projection is the metre.
pub(super) fn is_in_metres(definition: &str) -> bool {
    let mut parameters = definition.split_whitespace().map(parameter);
    parameters.all(|p| match p.0 {
        "units" => p.1 == "m",
        "to_meter" => p.1.parse() == Ok(1.0),
        _ => true,
    })
}

/// Returns true if a datum has a shift to WGS 84.
pub(super) fn has_shift(definition: &str) -> bool {
    let mut parameters = definition.split_whitespace().map(parameter);
    parameters.any(|p| ["datum", "towgs84"].contains(&p.0))
}

/// Splits `+name=value`.
fn parameter(word: &str) -> (&str, &str) {
    let word = word.trim_start_matches('+');
    word.split_once('=').unwrap_or((word, ""))
}
