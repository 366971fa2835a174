//! Codes that have left their columns of five, in both forms of the language.

use hsd_base::diagnostic::{Diagnostic, Edit};
use hsd_base::source::Span;
use hsd_base::text;

/// A line whose codes are not in their columns.
pub struct Slip {
    /// Its codes from the first that is out of step.
    pub span: Span,
    /// The column of the first.
    pub column: usize,
    /// The place of all its codes, and the codes in columns.
    pub fix: (Span, String),
    /// The turn letter after them in XML, where a row turns with `turn`.
    pub turn: Option<SlippedTurn>,
}

/// A turn letter after the codes of a row in XML.
pub struct SlippedTurn {
    /// The letter.
    pub letter: char,
    /// Its place.
    pub span: Span,
    /// The place for a `turn`, if the row has none.
    pub attribute: Option<Span>,
}

impl SlippedTurn {
    fn edits(&self) -> Vec<Edit> {
        let turn = format!(" turn=\"{}\"", self.letter);
        let written = self.attribute.map(|at| Edit::new(at, turn));
        written
            .into_iter()
            .chain([Edit::new(self.span, "")])
            .collect()
    }
}

/// The most lines that one message puts right.
const MOST_LINES: usize = 500;

/// Words that look like codes but are not in their columns, in one line or in many of a house.
#[cold]
pub fn out_of_step(first: Slip, more: Vec<Slip>) -> Diagnostic {
    let count = 1 + more.len();
    let meant = first.fix.1.trim_end();
    let mut line: String = meant.chars().take(80).collect();
    if line.len() < meant.len() {
        line.push('…');
    }
    let column = first.column;
    let one = text!([column]
        "from column {column} on, the codes are not in their columns: each takes exactly five",
        "{column}桁目から部材コードがずれています。部材コードはちょうど五桁ずつです"
    );
    let (message, help) = match (count, &first.turn) {
        (1, None) => (
            one,
            text!([line] "write `{line}`", "`{line}` と書いてください"),
        ),
        (1, Some(turn)) => (one, {
            let letter = turn.letter;
            text!([line, letter]
                "write `<Row turn=\"{letter}\">{line}</Row>`: in XML a row turns with `turn`",
                "`<Row turn=\"{letter}\">{line}</Row>` と書いてください。XML の行は `turn` で曲げます"
            )
        }),
        _ => (
            text!([column, count]
                "from column {column} on, the codes are not in their columns, nor in {count} lines of this house in all: each takes exactly five",
                "{column}桁目から部材コードがずれています。この家では全部で{count}行がずれています。部材コードはちょうど五桁ずつです"
            ),
            text!([line] "write `{line}`, and the other lines alike", "`{line}` と書き、ほかの行も同じように直してください"),
        ),
    };
    let span = first.span;
    let slips = std::iter::once(first).chain(more).take(MOST_LINES);
    let edits = slips.flat_map(|slip| {
        let turn = slip.turn.as_ref().map_or(vec![], SlippedTurn::edits);
        std::iter::once(Edit::new(slip.fix.0, slip.fix.1)).chain(turn)
    });
    Diagnostic::error(132, span, message).help(help).fix_all(
        text!(
            "Align the codes to five columns",
            "部材コードを五桁ずつに揃える"
        ),
        edits.collect(),
    )
}
