//! `hsd parts`: the catalogue.

use super::terminal::{padded, width};
use super::{Exit, Outcome, Stop};
use crate::catalog::{Catalog, PartDef};
use clap::{Args, ValueEnum};
use std::io::{self, Write};

/// List the parts a wall can be made of.
///
/// Codes have five columns, blanks included; widths are in U (0.909 m), heights in shaku (0.303 m).
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd parts lattice            every part with `lattice` in a name
  hsd parts --format json K    all walls, for a program

Classes: K wall, T door, M window, G lattice, H post, A opening, N modern.")]
pub(super) struct Parts {
    /// How the list is written.
    #[arg(long, value_enum, default_value_t)]
    format: List,

    /// Only parts with this in their code or a name; one capital letter means a class.
    filter: Option<String>,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum List {
    /// Columns.
    #[default]
    Table,
    /// An array.
    Json,
}

impl Parts {
    pub(super) fn run(&self) -> Outcome {
        let all = Catalog::builtin().parts().iter();
        let parts: Vec<&PartDef> = all.filter(|p| self.takes(p)).collect();
        let text = match self.format {
            List::Table => table(&parts),
            List::Json => {
                let text = serde_json::to_string_pretty(&parts);
                text.map_err(|e| Stop::Io(format!("cannot be written as JSON: {e}")))? + "\n"
            }
        };
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes())?;
        out.flush()?;
        if parts.is_empty() {
            let filter = self.filter.as_deref().unwrap_or_default();
            writeln!(io::stderr(), "no part has {filter:?} in its code or a name")?;
        }
        Ok(Exit::Done)
    }

    fn takes(&self, part: &PartDef) -> bool {
        let Some(filter) = &self.filter else {
            return true;
        };
        let mut letters = filter.chars();
        if let (Some(class @ 'A'..='Z'), None) = (letters.next(), letters.next()) {
            return part.class() == class;
        }
        let wanted = filter.to_lowercase();
        let fields = [
            part.code(),
            &part.ja,
            &part.romaji,
            &part.en,
            class_word(part.class()),
        ];
        fields.iter().any(|f| f.to_lowercase().contains(&wanted))
    }
}

fn class_word(class: char) -> &'static str {
    match class {
        'K' => "wall",
        'T' => "door",
        'M' => "window",
        'G' => "lattice",
        'H' => "post",
        'A' => "opening",
        'N' => "modern",
        _ => "void",
    }
}

fn table(parts: &[&PartDef]) -> String {
    let head = ["code", "U", "from", "to", "era", "name", "", ""].map(str::to_owned);
    let height = |h: Option<f64>| h.map_or(String::new(), |h| format!("{h}"));
    let row = |p: &&PartDef| {
        [
            p.code().to_owned(),
            format!("{}", p.width()),
            height(p.from),
            height(p.to),
            p.era.word().to_owned(),
            p.ja.to_string(),
            p.romaji.to_string(),
            p.en.to_string(),
        ]
    };
    let rows: Vec<[String; 8]> = std::iter::once(head).chain(parts.iter().map(row)).collect();
    let column = |k: usize| rows.iter().map(|r| width(&r[k])).max().unwrap_or(0);
    let widths: [usize; 8] = std::array::from_fn(column);
    let mut out = String::new();
    for row in &rows {
        let cells = row
            .iter()
            .zip(widths)
            .map(|(cell, width)| padded(cell, width));
        out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        out.push('\n');
    }
    out
}
