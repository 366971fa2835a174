//! What is known of the features of a tile: the table of `EXT_structural_metadata`.

use super::json_file::File;
use crate::pieces::Pieces;
use serde_json::{Map, Value, json};

/// A row of the table of features: one feature of a map and the house on it.
#[derive(Clone, Debug, Default)]
pub struct FeatureRow {
    /// Its key in its layer.
    pub key: String,
    /// Its layer.
    pub layer: String,
    /// The type of its house.
    pub kind: String,
    /// The year of its house, if something tells it.
    pub year: String,
    /// Where the house comes from.
    pub evidence: String,
    /// The parameters of the house, `name=value` with blanks between them.
    pub parameters: String,
    /// The number of the rule that made it, from 1.
    pub rule: u32,
    /// The line of the town file that made it, from 1.
    pub line: u32,
}

/// The table of some features.
pub(super) struct Table<'a>(&'a [FeatureRow]);

/// A column of texts.
type Column = (&'static str, &'static str, fn(&FeatureRow) -> &str);

/// The columns of texts: name, description, value.
const TEXTS: [Column; 6] = [
    ("key", "The feature's key in its layer", |row| &row.key),
    ("layer", "The feature's layer", |row| &row.layer),
    ("type", "The type of the house", |row| &row.kind),
    ("year", "The year of the house", |row| &row.year),
    ("evidence", "Where the house comes from", |row| {
        &row.evidence
    }),
    ("parameters", "The parameters of the type", |row| {
        &row.parameters
    }),
];

impl<'a> Table<'a> {
    pub(super) fn new(rows: &'a [FeatureRow]) -> Table<'a> {
        Table(rows)
    }

    /// Writes the columns to the buffer; returns the extension of the root.
    pub(super) fn written(&self, file: &mut File, bin: &mut Pieces) -> Value {
        let (mut properties, mut columns) = (Map::new(), Map::new());
        for (name, description, of) in TEXTS {
            let texts: Vec<&str> = self.0.iter().map(of).collect();
            // A view has one byte at least; a column without any text is left out.
            if texts.iter().all(|text| text.is_empty()) {
                continue;
            }
            let values = file.view(bin, None, |out| {
                texts.iter().for_each(|text| out.extend(text.as_bytes()));
            });
            let offsets = file.view(bin, None, |out| {
                let mut end = 0;
                out.extend(u32::to_le_bytes(0));
                for text in &texts {
                    end += text.len() as u32;
                    out.extend(end.to_le_bytes());
                }
            });
            properties.insert(
                name.to_owned(),
                json!({ "type": "STRING", "description": description }),
            );
            columns.insert(
                name.to_owned(),
                json!({ "values": values, "stringOffsets": offsets, "stringOffsetType": "UINT32" }),
            );
        }
        for (name, description, of) in [
            (
                "rule",
                "The rule that made the house, from 1",
                (|row| row.rule) as fn(&FeatureRow) -> u32,
            ),
            (
                "line",
                "The line of the town file that made the house",
                |row| row.line,
            ),
        ] {
            let values = file.view(bin, None, |out| {
                out.extend(self.0.iter().flat_map(|row| of(row).to_le_bytes()));
            });
            let kind = json!({
                "type": "SCALAR", "componentType": "UINT32", "description": description,
            });
            properties.insert(name.to_owned(), kind);
            columns.insert(name.to_owned(), json!({ "values": values }));
        }
        json!({
            "schema": { "id": "hsd_town", "classes": {
                "house": { "name": "House", "properties": properties }
            } },
            "propertyTables": [
                { "name": "houses", "class": "house", "count": self.0.len(), "properties": columns }
            ],
        })
    }
}
