//! The columns of roof lines (`docs/evidence.md` 6): letters to the left, numbers to the right, each field below the same
//! field of the line above.

use crate::parse::syntax::LineKind;
use std::ops::Range;

/// Number of fields before the options: covering, direction, height, shape, a0, b0, a1, b1.
const FIELDS: usize = 8;

/// Minimum widths of the fields, so that they are in columns 1, 3, 5-9, 11-13, 15-17, 19-21, 23-25, 27-29.
const WIDTHS: [usize; FIELDS] = [1, 1, 5, 3, 3, 3, 3, 3];

/// Fields of numbers.
const NUMBERS: [usize; 5] = [2, 4, 5, 6, 7];

/// The widths of the fields of one house's roof lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Table {
    widths: [usize; FIELDS],
}

impl Default for Table {
    fn default() -> Self {
        Table { widths: WIDTHS }
    }
}

/// Returns a table for each house of a source file.
pub(super) fn tables(text: &str, lines: &[(Range<usize>, LineKind)]) -> Vec<Table> {
    let mut tables = vec![Table::default()];
    for (range, kind) in lines {
        match kind {
            LineKind::Separator => tables.push(Table::default()),
            LineKind::Roof => {
                if let Some(table) = tables.last_mut() {
                    table.hold(&text[range.clone()]);
                }
            }
            _ => {}
        }
    }
    tables
}

impl Table {
    /// Widens the fields for a line.
    pub(super) fn hold(&mut self, raw: &str) {
        let Some(fields) = fields(raw) else { return };
        for (width, field) in self.widths.iter_mut().zip(&fields) {
            *width = (*width).max(field.chars().count());
        }
    }

    /// Writes a line.
    pub(super) fn line(&self, raw: &str, text: &mut String) {
        let Some(fields) = fields(raw) else {
            return words(raw, text);
        };
        for (i, (field, width)) in fields.iter().zip(self.widths).enumerate() {
            if i > 0 {
                text.push(' ');
            }
            let blanks = width.saturating_sub(field.chars().count());
            let before = if NUMBERS.contains(&i) { blanks } else { 0 };
            text.extend(std::iter::repeat_n(' ', before));
            text.push_str(field);
            text.extend(std::iter::repeat_n(' ', blanks - before));
        }
        for (i, option) in raw.split_whitespace().skip(FIELDS).enumerate() {
            text.push_str(if i > 0 { " " } else { "  " });
            text.push_str(option);
        }
    }
}

/// Returns the fields of a line that has all of them.
fn fields(raw: &str) -> Option<Vec<String>> {
    let list: Vec<&str> = raw.split_whitespace().take(FIELDS).collect();
    let number = |text: &str| text.parse::<f64>().is_ok();
    let letters = |text: &str, count| text == "*" || text.chars().count() == count;
    let [kind, direction, height, shape, corners @ ..] = &list[..] else {
        return None;
    };
    let whole = letters(kind, 1)
        && letters(direction, 1)
        && (*height == "*" || number(height))
        && letters(shape, 3)
        && corners.len() == 4
        && corners.iter().all(|c| number(c));
    whole.then(|| {
        let mut fields: Vec<String> = list.iter().map(|&f| f.to_owned()).collect();
        if height.bytes().all(|b| b.is_ascii_digit()) {
            fields[2].push_str(".0");
        }
        fields
    })
}

/// Writes the words of a line one blank apart.
pub(super) fn words(raw: &str, text: &mut String) {
    for (i, word) in raw.split_whitespace().enumerate() {
        if i > 0 {
            text.push(' ');
        }
        text.push_str(word);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_stand_in_their_columns() {
        let line = |raw: &str| {
            let mut text = String::new();
            let mut table = Table::default();
            table.hold(raw);
            table.line(raw, &mut text);
            text
        };
        let printed = "K X  14.0 KIR   0   0   6   8  P4.0 E2.5 G0.5 M3";
        assert_eq!(line("K X 14 KIR 0 0 6 8 P4.0   E2.5 G0.5 M3"), printed);
        assert_eq!(line(printed), printed);
        assert_eq!(
            line("I * * HIS 0.5 -1.5 6 10"),
            "I *     * HIS 0.5 -1.5   6  10"
        );
        assert_eq!(line("K X 14"), "K X 14");
    }
}
