//! What the tags of a GeoTIFF say of its place (OGC 19-008): the reference system, whether a place is the corner or the middle
//! of a cell, the unit of heights.

use crate::Crs;

/// Keys.
const RASTER: u16 = 1025;
const CITATIONS: [u16; 3] = [3073, 2049, 1026];
const GEOGRAPHIC: u16 = 2048;
const PROJECTED: u16 = 3072;
const VERTICAL_UNIT: u16 = 4099;

/// The directory of keys.
#[derive(Debug, Default)]
pub(super) struct GeoKeys {
    numbers: Vec<u16>,
    texts: String,
}

impl GeoKeys {
    pub(super) fn new(numbers: Vec<u16>, texts: String) -> GeoKeys {
        GeoKeys { numbers, texts }
    }

    fn entries(&self) -> impl Iterator<Item = [u16; 4]> + '_ {
        let all = self.numbers.get(4..).unwrap_or_default();
        all.chunks_exact(4).map(|e| [e[0], e[1], e[2], e[3]])
    }

    fn number(&self, key: u16) -> Option<u16> {
        let found = self
            .entries()
            .find(|[own, place, ..]| *own == key && *place == 0);
        found.map(|entry| entry[3])
    }

    fn text(&self, key: u16) -> Option<&str> {
        let found = self
            .entries()
            .find(|[own, place, ..]| *own == key && *place == 34737)?;
        let (from, length) = (usize::from(found[3]), usize::from(found[2]));
        Some(self.texts.get(from..from + length)?.trim_end_matches('|'))
    }

    /// Returns true if the place of the raster is the middle of its first cell, not its corner.
    pub(super) fn is_of_points(&self) -> bool {
        self.number(RASTER) == Some(2)
    }

    /// Returns the metres of a unit of height; `None` for one that is not known.
    pub(super) fn vertical_unit(&self) -> Option<f64> {
        match self.number(VERTICAL_UNIT) {
            None | Some(0 | 9001 | 32767) => Some(1.0),
            Some(9002) => Some(0.3048),
            Some(9003) => Some(1200.0 / 3937.0),
            Some(_) => None,
        }
    }

    /// Returns the reference system; `Err` with a name for one that is not known.
    pub(super) fn crs(&self) -> Result<Option<Crs>, Box<str>> {
        const OWN: u16 = 32767;
        let code = self.number(PROJECTED).or_else(|| self.number(GEOGRAPHIC));
        if let Some(code) = code.filter(|code| *code != OWN && *code != 0) {
            let found = Crs::from_epsg(code.into());
            return found.map(Some).ok_or_else(|| format!("EPSG:{code}").into());
        }
        // Some programs write the whole description as a citation.
        let texts: Vec<&str> = CITATIONS.iter().filter_map(|key| self.text(*key)).collect();
        let wkt = texts.iter().find_map(|text| {
            let at = text.find("PROJCS[").or_else(|| text.find("GEOGCS["))?;
            Crs::from_wkt(&text[at..])
        });
        match (wkt, texts.first()) {
            (Some(crs), _) => Ok(Some(crs)),
            (None, Some(text)) if code.is_some() => {
                Err(text.chars().take(60).collect::<String>().into())
            }
            (None, _) => Ok(None),
        }
    }
}
