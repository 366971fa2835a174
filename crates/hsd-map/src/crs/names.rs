//! Names of reference systems in files and in towns.

use super::{Crs, wkt};

/// Returns the system of a name.
pub(super) fn crs(name: &str) -> Option<Crs> {
    let name = name.trim();
    let small = name.to_ascii_lowercase();
    if small == "local" {
        return Some(Crs::local());
    }
    if small.ends_with("crs84") || small.ends_with("crs84h") {
        return Some(Crs::wgs84());
    }
    if name.contains('[') {
        return wkt::crs(name);
    }
    let code = match small.strip_prefix("epsg:") {
        Some(code) => code,
        // URNs and addresses end in the code: `urn:ogc:def:crs:EPSG::6674`.
        None if small.contains("epsg") => small.rsplit([':', '/', '#']).next()?,
        None => &small,
    };
    Crs::from_epsg(code.trim_start_matches(':').parse().ok()?)
}
