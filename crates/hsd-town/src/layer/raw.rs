//! Features in the coordinates of their file, as they are read. Those of a large map are not kept: what the frame of the town
//! depends on is collected, and the file is read a second time to place them.

use super::spread::{FARTHEST, Spread};
use super::{Lot, Lots, TownFrame, as_text, height, led, parted, shape};
use glam::DVec2;
use hsd_base::source::{Spanned, World};
use hsd_ir::ast::town::Layer;
use hsd_map::{Crs, Datums, Fault, Faults, Geometry, Kind, Mismatch, Options, Reader, Transform};

/// Features in the coordinates of their file.
#[derive(Clone, Debug)]
pub struct Raw {
    /// Empty if there are more than are kept in memory.
    features: Vec<hsd_map::Feature>,
    seen: Seen,
    crs: Crs,
    /// True if neither the file nor the layer says what the coordinates are.
    is_guessed: bool,
    /// True if the reader did not check the coordinates, since it knew no system.
    is_unchecked: bool,
    lots: Lots,
}

/// Totals over all features of a map, collected while they are read.
#[derive(Clone, Debug, Default)]
struct Seen {
    count: usize,
    spread: Spread,
    widths: hsd_map::Widths,
    /// Features of which a point cannot be in the reference system.
    refused: usize,
    has_lines: bool,
}

/// Why features cannot be put into the frame of a town.
#[derive(Debug)]
pub enum NotPlaced {
    /// The systems cannot be converted.
    Mismatch(Mismatch),
    /// The map cannot be read once more.
    Fault(Fault),
}

/// Opens a map, a path that the world has found.
fn open(world: &dyn World, path: &str, layer: &Layer) -> Result<Box<dyn Reader>, Fault> {
    let text = |t: &Option<Spanned<String>>| t.as_ref().map(|t| t.value.as_str().into());
    let options = Options {
        layer: text(&layer.layer),
        encoding: text(&layer.encoding),
        crs: named(layer),
        ..Options::default()
    };
    hsd_map::open(world, path, &options)
}

fn named(layer: &Layer) -> Option<Crs> {
    let crs = layer.crs.as_ref();
    crs.and_then(|crs| Crs::from_name(&crs.value))
}

/// Reads the features of a map, a path that the world has found. Of more than `most` none is kept.
///
/// # Errors
/// If it cannot be read at all.
pub fn read(world: &dyn World, path: &str, layer: &Layer, most: usize) -> Result<Raw, Fault> {
    let mut reader = open(world, path, layer)?;
    let (mut features, mut faults, mut unread) = (vec![], Faults::default(), vec![]);
    let mut seen = Seen::default();
    while let Some(next) = reader.next() {
        match next {
            Ok(feature) => {
                let known = reader.layer().crs.clone();
                seen.add(
                    &feature,
                    &known.or_else(|| named(layer)).unwrap_or_else(Crs::wgs84),
                );
                match seen.count > most {
                    true => features = vec![],
                    false => features.push(feature),
                }
            }
            // The file is beyond all limits, so the rest of it is not used either.
            Err(fault) if fault.is_exhausted_file() => return Err(fault),
            Err(fault) => {
                faults.push(fault.clone());
                unread.push(fault);
            }
        }
        reader.remarks().into_iter().for_each(|f| faults.push(f));
    }
    reader.remarks().into_iter().for_each(|f| faults.push(f));
    let known = reader.layer();
    let columns = known.columns.list().iter().enumerate();
    let columns = columns
        .map(|(n, column)| (column.name.clone(), n))
        .collect();
    let crs = known.crs.clone().or_else(|| named(layer));
    faults.set_used(seen.count - seen.refused);
    Ok(Raw {
        features,
        seen,
        is_guessed: crs.is_none() || known.crs_is_usual,
        is_unchecked: known.crs.is_none(),
        crs: crs.unwrap_or_else(Crs::wgs84),
        lots: Lots {
            layer: layer.clone(),
            lots: vec![],
            bounds: None,
            columns,
            faults,
            unread,
            left: vec![],
            file: path.into(),
        },
    })
}

impl Seen {
    fn add(&mut self, feature: &hsd_map::Feature, crs: &Crs) {
        let geometry = &feature.geometry;
        self.count += 1;
        if geometry.points().any(|p| crs.refuses(p).is_some()) {
            self.refused += 1;
            return;
        }
        self.spread
            .add(&geometry.points().collect::<Vec<DVec2>>(), crs);
        self.widths.add(geometry.width());
        self.has_lines |= matches!(geometry, hsd_map::Geometry::Lines(_));
    }
}

impl Raw {
    /// Returns where its features lie, and the system that they are in.
    pub(crate) fn spread(&self) -> (&Spread, &Crs) {
        (&self.seen.spread, &self.crs)
    }

    /// Returns true if the coordinates can only be guessed: no system is named, and most features cannot lie in degrees. As
    /// degrees they would be too large, or make features as wide as countries or as far apart as cities.
    pub fn is_nowhere(&self) -> bool {
        let seen = &self.seen;
        let are_no_degrees = 2 * seen.refused > seen.count
            || seen.widths.are_metres()
            || self.crs.is_degrees() && !seen.spread.is_gathered();
        self.is_guessed && are_no_degrees
    }

    /// Returns true if its features can only be in degrees. The file or the layer names such a system, or they are very small.
    pub fn are_degrees(&self) -> bool {
        self.crs.is_degrees() && (!self.is_guessed || self.seen.widths.are_degrees())
    }

    /// Returns true if a point of a feature cannot be in its system.
    pub fn has_refused(&self) -> bool {
        self.seen.refused > 0
    }

    /// Returns why the system that the file names cannot be used, if it names one and nothing else says what it is.
    pub fn unknown_crs(&self) -> Option<&Fault> {
        let mut faults = self.lots.faults.iter().map(|(fault, _)| fault);
        let unknown = faults.find(|fault| matches!(fault.kind, Kind::UnknownCrs { .. }));
        unknown.filter(|_| self.is_unchecked)
    }

    /// Returns the number of features.
    pub fn len(&self) -> usize {
        self.seen.count
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.seen.count == 0
    }

    /// Returns true if one of them is a line.
    pub fn has_lines(&self) -> bool {
        self.seen.has_lines
    }

    /// Returns the layer without its features.
    pub(crate) fn head(&self) -> Lots {
        self.lots.head()
    }

    /// Puts the features of a layer as it is written now into the frame of the town, and hands them to `take`. `lead` stands
    /// before the keys that the file gives, since those of another file may be the same. Returns the layer without them.
    ///
    /// # Errors
    /// If the systems cannot be converted, or the map cannot be read once more.
    pub fn placed(
        self,
        world: &dyn World,
        frame: &TownFrame,
        (written, lead): (&Layer, Option<&str>),
        take: &mut dyn FnMut(Lot),
    ) -> Result<Lots, NotPlaced> {
        let way = Transform::new(&self.crs, &frame.crs, Datums::Exact);
        let way = way.map_err(NotPlaced::Mismatch)?;
        let mut lots = self.lots;
        lots.layer = written.clone();
        let key = written.key.as_ref();
        let key = key.and_then(|k| lots.columns.get(&*k.value).copied());
        let unchecked = Some(&self.crs).filter(|_| self.is_unchecked);
        let mut place = |feature: hsd_map::Feature| {
            let whose = (feature.number, feature.id.clone());
            let way = (unchecked, &way);
            match placed_lots(feature, way, frame, (key, lead)) {
                Ok(lots) => lots.into_iter().for_each(&mut *take),
                Err(kind) => {
                    let fault = Fault::of_file(&lots.file, kind);
                    let fault = fault.of_feature(whose.0, whose.1);
                    lots.faults.push(fault.clone());
                    lots.unread.push(fault);
                }
            }
        };
        if self.features.is_empty() && self.seen.count > 0 {
            let path = lots.file.clone();
            let mut again = open(world, &path, written).map_err(NotPlaced::Fault)?;
            while let Some(next) = again.next() {
                // What is wrong was found at the first time.
                again.remarks();
                next.into_iter().for_each(&mut place);
            }
        } else {
            self.features.into_iter().for_each(place);
        }
        for which in lots.unread.iter_mut().filter_map(|f| f.feature.as_mut()) {
            if lead.is_some() {
                which.id = Some(led(lead, &which.key()));
            }
        }
        Ok(lots)
    }
}

/// Puts a feature into the frame of a town. Each of several areas or points is a lot, with a number behind the key.
///
/// # Errors
/// If it cannot lie in its system, the projection has no such place, or it is an outlier.
fn placed_lots(
    mut feature: hsd_map::Feature,
    (unchecked, way): (Option<&Crs>, &Transform),
    frame: &TownFrame,
    (key, lead): (Option<usize>, Option<&str>),
) -> Result<Vec<Lot>, Kind> {
    for chain in feature.geometry.chains_mut() {
        for point in &mut chain.points {
            let p = *point;
            let refused = unchecked.and_then(|crs| Some((crs, crs.refuses(p)?)));
            if let Some((crs, seems)) = refused {
                let (x, y, crs) = (p.x, p.y, crs.name.clone());
                return Err(Kind::OutsideCrs { x, y, crs, seems });
            }
            *point = way.apply(p).ok_or(Kind::NotFinite)? - frame.origin;
            let off = point.distance(frame.middle);
            if off > FARTHEST {
                let kilometres = (off / 1000.0).round() as u64;
                return Err(Kind::Outlier { kilometres });
            }
        }
    }
    let named = key.and_then(|column| feature.field(column));
    let named = named.and_then(as_text);
    let key = named.map_or_else(|| led(lead, &feature.key()), String::into_boxed_str);
    let lot = |geometry: Geometry, key, fields| Lot {
        number: 0,
        key,
        z: height(&geometry),
        shape: shape(geometry),
        fields,
    };
    let mut parts = parted(feature.geometry);
    if parts.len() == 1 {
        let whole = parts.remove(0);
        return Ok(vec![lot(whole, key, feature.fields)]);
    }
    let parts = parts.into_iter().enumerate();
    let lots = parts.map(|(n, part)| {
        let key = format!("{key}/{}", n + 1).into();
        lot(part, key, feature.fields.clone())
    });
    Ok(lots.collect())
}
