//! Facades in the widths of their codes: where all parts of a house are scaled alike, its unit is scaled instead.

use hsd_base::geometry::SAME;
use hsd_ir::catalog::Catalog;
use hsd_ir::program::{Content, House, Unit};

/// Returns a house whose parts have the widths of their codes, and a unit that makes it as large as it was; `None` if its
/// parts are scaled in several ways, or something else is written in its units.
pub fn in_own_widths(house: &House, catalog: &Catalog) -> Option<House> {
    let whole = |walk: &hsd_ir::program::Loop| walk.start == (0.0, 0.0);
    let walks = house.storeys.iter().flat_map(|s| &s.loops);
    if !house.roofs.lines.is_empty() || !walks.clone().all(whole) {
        return None;
    }
    let units = || walks.clone().flat_map(|w| &w.lines).flat_map(|l| &l.units);
    let own = |unit: &Unit| match &unit.content {
        Content::Part(id) => Some(catalog.part(*id).width()).filter(|width| *width > 0.0),
        Content::Picture(_) => Some(1.0),
        Content::Void | Content::Split(_) => None,
    };
    let mut scales = units().filter_map(|unit| Some(unit.width / own(unit)?));
    let scale = scales.next().filter(|scale| *scale > SAME)?;
    if scales.any(|other| (other / scale - 1.0).abs() > SAME) {
        return None;
    }
    let mut made = house.clone();
    // Without the last digits of a quotient.
    let short = |x: f64| (x * 1e9).round() / 1e9;
    made.unit_shaku = short(house.unit_shaku * scale);
    let loops = made.storeys.iter_mut().flat_map(|s| &mut s.loops);
    for unit in loops.flat_map(|w| &mut w.lines).flat_map(|l| &mut l.units) {
        unit.width = own(unit).unwrap_or(short(unit.width / scale));
    }
    Some(made)
}
