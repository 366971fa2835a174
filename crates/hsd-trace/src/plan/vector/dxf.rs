//! DXF from release 12 to 2018: layers, blocks and what is drawn.

use super::entity::{self, Home, Record};
use super::lines::Lines;
use super::pairs::{self, Pair};
use super::refused::Refused;
use glam::DMat3;
use std::collections::BTreeMap;

/// The largest file, bytes.
const LARGEST: usize = 64 << 20;
/// The most blocks in each other.
const DEEPEST: usize = 16;
/// The most copies of blocks in a drawing.
const COPIES: usize = 200_000;

/// A layer.
#[derive(Clone, Copy, Debug, Default)]
struct Layer {
    is_hidden: bool,
    colour: i32,
    line_type: Option<u32>,
}

/// A block: its base, and what is drawn in it.
#[derive(Clone, Debug, Default)]
struct Block {
    base: [f64; 2],
    records: std::ops::Range<usize>,
}

/// What a file holds.
struct File<'p> {
    records: Vec<Record<'p>>,
    layers: BTreeMap<String, Layer>,
    blocks: BTreeMap<String, Block>,
    entities: std::ops::Range<usize>,
    unit_mm: Option<f64>,
}

/// Reads the lines of a DXF.
///
/// # Errors
/// If it is none, or too large.
pub fn read(bytes: &[u8]) -> Result<Lines, Refused> {
    if bytes.len() > LARGEST {
        return Err(Refused::TooLarge {
            what: "bytes",
            most: LARGEST,
        });
    }
    let mut text = String::new();
    let pairs = pairs::read(bytes, &mut text)?;
    let mut lines = Lines::default();
    let file = file(&pairs, &mut lines)?;
    lines.unit_mm = file.unit_mm;
    lines.is_model = true;
    let mut out = Drawn {
        file: &file,
        lines,
        copies: 0,
        open: vec![],
    };
    let home = Home {
        matrix: DMat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0]),
        ..Home::default()
    };
    out.draw(file.entities.clone(), &home)?;
    Ok(out.lines)
}

/// Sorts the pairs of a file into records and sections.
fn file<'p>(pairs: &'p [Pair<'p>], lines: &mut Lines) -> Result<File<'p>, Refused> {
    let starts: Vec<usize> = (0..pairs.len()).filter(|k| pairs[*k].0 == 0).collect();
    let end = |k: usize| starts.get(k + 1).copied().unwrap_or(pairs.len());
    let records: Vec<Record<'p>> = starts
        .iter()
        .enumerate()
        .map(|(k, s)| Record::new(&pairs[*s..end(k)]))
        .collect();
    let mut file = File {
        records,
        layers: BTreeMap::new(),
        blocks: BTreeMap::new(),
        entities: 0..0,
        unit_mm: None,
    };
    let mut k = 0;
    let mut found = false;
    while k < file.records.len() {
        if file.records[k].kind != "SECTION" {
            k += 1;
            continue;
        }
        found = true;
        let close = (k + 1..file.records.len())
            .find(|j| file.records[*j].kind == "ENDSEC")
            .unwrap_or(file.records.len());
        match file.records[k].text(2).unwrap_or_default() {
            "HEADER" => file.unit_mm = unit(file.records[k].pairs),
            "TABLES" => layers(&mut file, k + 1..close, lines),
            "BLOCKS" => blocks(&mut file, k + 1..close),
            "ENTITIES" => file.entities = k + 1..close,
            _ => {}
        }
        k = close;
    }
    match found {
        true => Ok(file),
        false => Err(Refused::NotDxf {
            line: 1,
            what: "a SECTION was looked for".to_owned(),
        }),
    }
}

/// Millimetres in a unit, by $INSUNITS.
fn unit(header: &[Pair<'_>]) -> Option<f64> {
    let at = header
        .iter()
        .position(|(code, value)| *code == 9 && value.trim() == "$INSUNITS")?;
    let number: i32 = header.get(at + 1)?.1.trim().parse().ok()?;
    Some(match number {
        1 => 25.4,
        2 => 304.8,
        4 => 1.0,
        5 => 10.0,
        6 => 1000.0,
        10 => 914.4,
        14 => 100.0,
        _ => return None,
    })
}

fn layers(file: &mut File<'_>, records: std::ops::Range<usize>, lines: &mut Lines) {
    for k in records {
        let record = &file.records[k];
        let Some(name) = record.text(2).filter(|_| record.kind == "LAYER") else {
            continue;
        };
        let colour = record.whole(62).unwrap_or(7);
        let is_frozen = record.whole(70).unwrap_or(0) & 1 == 1;
        let line_type = record.text(6).map(|name| lines.name(name));
        let layer = Layer {
            is_hidden: is_frozen || colour < 0,
            colour: colour.abs(),
            line_type,
        };
        file.layers.insert(name.to_uppercase(), layer);
    }
}

fn blocks(file: &mut File<'_>, records: std::ops::Range<usize>) {
    let mut open: Option<(String, Block)> = None;
    for k in records.clone() {
        let record = &file.records[k];
        match record.kind {
            "BLOCK" => {
                let base = [
                    record.real(10).unwrap_or(0.0),
                    record.real(20).unwrap_or(0.0),
                ];
                let name = record.text(2).unwrap_or_default().to_uppercase();
                open = Some((
                    name,
                    Block {
                        base,
                        records: k + 1..records.end,
                    },
                ));
            }
            "ENDBLK" => {
                if let Some((name, mut block)) = open.take() {
                    block.records.end = k;
                    file.blocks.insert(name, block);
                }
            }
            _ => {}
        }
    }
}

/// What has been drawn.
struct Drawn<'f, 'p> {
    file: &'f File<'p>,
    lines: Lines,
    copies: usize,
    open: Vec<String>,
}

impl Drawn<'_, '_> {
    fn draw(&mut self, records: std::ops::Range<usize>, home: &Home) -> Result<(), Refused> {
        let full = || Refused::TooLarge {
            what: "corners",
            most: super::lines::MOST,
        };
        let mut k = records.start;
        while k < records.end {
            let record = &self.file.records[k];
            let parts = k + 1..records.end;
            // Vertices and attributes follow what they belong to.
            let count = parts
                .clone()
                .take_while(|j| {
                    matches!(self.file.records[*j].kind, "VERTEX" | "ATTRIB" | "SEQEND")
                })
                .count();
            let follow = &self.file.records[parts.start..parts.start + count];
            k += 1 + count;
            if record.whole(67) == Some(1) || record.whole(60) == Some(1) {
                continue;
            }
            let own = self.own(record, home);
            if own.hidden {
                continue;
            }
            if record.kind == "INSERT" {
                self.insert(record, &own)?;
            } else if record.kind != "BLOCK" && record.kind != "ENDBLK" {
                let style = self.style(record, &own);
                if !entity::draw(record, follow, &own, &style, &mut self.lines) {
                    return Err(full());
                }
            }
        }
        Ok(())
    }

    /// What a record has of its own and from the block that it is part of.
    fn own(&mut self, record: &Record<'_>, home: &Home) -> Home {
        let name = entity::decoded(record.text(8).unwrap_or("0"));
        let layer = self
            .file
            .layers
            .get(&record.text(8).unwrap_or("0").to_uppercase())
            .copied()
            .unwrap_or(Layer {
                colour: 7,
                ..Layer::default()
            });
        let inherits = name == "0" && home.layer.is_some();
        let colour = match record.whole(62) {
            Some(0) => home.colour,
            Some(256) | None if inherits => home.colour,
            Some(256) | None => layer.colour,
            Some(own) => own.abs(),
        };
        let layer_name = if inherits {
            home.layer
        } else {
            Some(self.lines.name(&name))
        };
        Home {
            layer: layer_name,
            hidden: home.hidden || layer.is_hidden && !inherits,
            colour,
            ..home.clone()
        }
    }

    fn style(&mut self, record: &Record<'_>, own: &Home) -> entity::Style {
        let by_layer = self
            .file
            .layers
            .get(&record.text(8).unwrap_or("0").to_uppercase())
            .and_then(|l| l.line_type);
        let line_type = record
            .text(6)
            .filter(|t| !t.eq_ignore_ascii_case("BYLAYER") && !t.eq_ignore_ascii_case("BYBLOCK"));
        let line_type = line_type.map(|t| self.lines.name(t)).or(by_layer);
        let colour = record.whole(420).map_or_else(
            || entity::colour(own.colour),
            |c| [(c >> 16) as u8, (c >> 8) as u8, c as u8],
        );
        entity::Style {
            layer: own.layer,
            colour,
            line_type,
            width: record.real(43).filter(|w| *w > 0.0).unwrap_or(0.0),
        }
    }

    fn insert(&mut self, record: &Record<'_>, own: &Home) -> Result<(), Refused> {
        let name = record.text(2).unwrap_or_default().to_uppercase();
        let Some(block) = self.file.blocks.get(&name) else {
            self.lines.leave_out("INSERT of a block that is not there");
            return Ok(());
        };
        if self.open.contains(&name) || self.open.len() >= DEEPEST {
            self.lines.leave_out("INSERT of a block in itself");
            return Ok(());
        }
        let number = self
            .lines
            .name(&entity::decoded(record.text(2).unwrap_or_default()));
        self.open.push(name);
        for matrix in entity::copies(record, block.base) {
            self.copies += 1;
            if self.copies > COPIES {
                return Err(Refused::TooLarge {
                    what: "copies of blocks",
                    most: COPIES,
                });
            }
            let mut home = Home {
                matrix: own.matrix * matrix,
                ..own.clone()
            };
            home.blocks.insert(0, number);
            // The outermost block is the symbol.
            if own.symbol == 0 {
                home.symbol = self.copies as u32;
            }
            self.draw(block.records.clone(), &home)?;
        }
        self.open.pop();
        Ok(())
    }
}
