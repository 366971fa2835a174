//! A town in parts as bytes: what all tiles share, and for each tile its features with all that their houses depend on, outlines,
//! streets, blocks and heights round them. Whoever has these bytes and the town file needs no map.

use super::blocks::Blocks;
use super::{LaidFirst, LotId, Plan};
use crate::layer::{Ground, Lot, Lots, TownFrame};
use crate::street::Streets;
use crate::table::Rows;
use hsd_base::geometry::grid::{Bounds, Grid};
use hsd_ir::ast::town::{Layer, Town};
use hsd_map::pack::{Packer, Unpacker};
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

impl Plan {
    /// Returns what all parts share: the frame, what layers are without their features, the tables.
    pub fn pack_head(&self) -> Vec<u8> {
        let mut bytes = vec![];
        let mut out = Packer::new(&mut bytes);
        out.crs(&self.frame.crs);
        out.point(self.frame.origin);
        out.count(self.layers.len());
        self.layers.iter().for_each(|l| l.pack_head(&mut out));
        out.count(self.tables.len());
        self.tables.iter().for_each(|table| table.pack(&mut out));
        let font = self.font.as_deref().unwrap_or_default();
        out.count(font.len());
        out.bytes(font);
        bytes
    }

    /// Returns a part of a town, of which some features belong to its tile, as bytes.
    pub fn pack_part(&self, own: &[LotId]) -> Vec<u8> {
        let mut bytes = vec![];
        let mut out = Packer::new(&mut bytes);
        let lots = || self.layers.iter().map(|layer| &layer.lots).enumerate();
        out.count(lots().map(|(_, lots)| lots.len()).sum());
        let mut bounds: Option<Bounds> = None;
        // Both lists are in the order of layers and features.
        let mut own = own.iter().peekable();
        for (layer, lots) in lots() {
            for (number, lot) in lots.iter().enumerate() {
                let is_own = own.next_if_eq(&&(layer, number)).is_some();
                out.bytes(&[u8::from(is_own)]);
                lot.pack(layer, out.all());
                let [a, b] = lot.shape.bounds();
                let [c, d] = bounds.unwrap_or([a, b]);
                bounds = Some([a.min(c), b.max(d)]);
            }
        }
        let bounds = bounds.unwrap_or_default();
        out.count(self.streets.len());
        for (name, streets) in self.streets.iter() {
            out.text(name);
            streets.pack(bounds, &mut out);
        }
        self.blocks.pack(bounds, &mut out);
        self.ground.pack(bounds, &mut out);
        self.laid.pack(bounds, &mut out);
        bytes
    }

    /// Returns the ground in a box of a town as bytes.
    pub fn pack_ground(&self, bounds: Bounds) -> Vec<u8> {
        let mut bytes = vec![];
        self.ground.pack(bounds, &mut Packer::new(&mut bytes));
        bytes
    }
}

/// Reads the parts of a town.
#[derive(Debug)]
pub struct PartReader {
    /// The town without features.
    pub head: Plan,
    /// Its layers as written, those of heights among them.
    written: Vec<Layer>,
}

impl PartReader {
    /// Reads what all parts share; the town is that of the same file.
    ///
    /// # Errors
    /// If the bytes are not those of this town.
    pub fn new(mut town: Town, mut bytes: &[u8]) -> io::Result<PartReader> {
        let mut from = Unpacker::new(&mut bytes);
        let frame = TownFrame {
            crs: from.crs()?,
            origin: from.point()?,
            // Its features have been placed.
            middle: glam::DVec2::ZERO,
        };
        let layers = (0..from.count()?).map(|_| Lots::unpack_head(&mut from, &town.layers));
        let layers = layers.collect::<io::Result<Vec<Lots>>>()?;
        let tables = (0..from.count()?).map(|_| Rows::unpack(&mut from));
        let tables = tables.collect::<io::Result<Vec<Rows>>>()?;
        let size = from.count()?;
        let font = from.bytes(size)?;
        let font = (size > 0).then(|| font.into());
        let own = layers.iter().map(|lots| lots.layer.clone()).collect();
        let written = std::mem::replace(&mut town.layers, own);
        let head = Plan {
            town: Arc::new(town),
            frame,
            layers,
            tables: Arc::new(tables),
            ground: Arc::default(),
            unjoined: vec![],
            streets: Arc::default(),
            blocks: Arc::default(),
            laid: Arc::default(),
            font,
            lodged: None,
            outlines: vec![],
            index: Grid::default(),
            fronts: BTreeMap::new(),
        };
        Ok(PartReader { head, written })
    }

    /// Reads the part of a tile, with its own features.
    ///
    /// # Errors
    /// If the bytes are not those of this town.
    pub fn part(&self, mut bytes: &[u8]) -> io::Result<(Plan, Vec<LotId>)> {
        let wrong = || io::Error::from(io::ErrorKind::InvalidData);
        let mut from = Unpacker::new(&mut bytes);
        let mut layers: Vec<Lots> = self.head.layers.iter().map(Lots::head).collect();
        let mut own = vec![];
        for _ in 0..from.count()? {
            let is_own = from.array::<1>()? == [1];
            let (layer, lot) = Lot::unpack(from.rest())?;
            let lots = &mut layers.get_mut(layer).ok_or_else(wrong)?.lots;
            if is_own {
                own.push((layer, lots.len()));
            }
            lots.push(lot);
        }
        let streets = (0..from.count()?).map(|_| {
            let name = from.text()?.into();
            Ok((name, Streets::unpack(&mut from)?))
        });
        let streets = streets.collect::<io::Result<BTreeMap<String, Streets>>>()?;
        let blocks = Blocks::unpack(&mut from)?;
        let ground = Ground::unpack(&mut from, &self.head.frame, &self.written)?;
        let laid = LaidFirst::unpack(&mut from)?;
        if !from.rest().is_empty() {
            return Err(wrong());
        }
        let head = Plan {
            streets: Arc::new(streets),
            ..self.head.with_layers(vec![])
        };
        let part = Plan {
            blocks: Arc::new(blocks),
            ground: Arc::new(ground),
            laid: Arc::new(laid),
            ..head.with_layers(layers)
        };
        Ok((part, own))
    }

    /// Reads a part that is ground alone.
    ///
    /// # Errors
    /// If the bytes are not those of this town.
    pub fn ground(&self, mut bytes: &[u8]) -> io::Result<Plan> {
        let mut from = Unpacker::new(&mut bytes);
        let ground = Ground::unpack(&mut from, &self.head.frame, &self.written)?;
        let layers = self.head.layers.iter().map(Lots::head).collect();
        Ok(Plan {
            ground: Arc::new(ground),
            ..self.head.with_layers(layers)
        })
    }
}
