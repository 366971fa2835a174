//! Tables of a town: small CSV files.

use hsd_ir::ast::Value;
use hsd_ir::ast::town::Unfound;
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// A table.
#[derive(Debug)]
pub struct Rows {
    /// Its name in the town.
    pub name: String,
    /// The number of the column by which rows are found.
    key: usize,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Why a text is no table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoTable {
    /// It has no rows.
    Empty,
    /// It has no column of the name of the key.
    NoKey,
    /// A row has more or fewer cells than there are columns: its line.
    Uneven(usize),
}

impl Rows {
    /// Reads a table.
    ///
    /// # Errors
    /// Why the text is none.
    pub fn read(name: &str, key: &str, text: &str) -> Result<Rows, NoTable> {
        let mut lines = text
            .lines()
            .enumerate()
            .filter(|(_, l)| !l.trim().is_empty());
        let (_, head) = lines.next().ok_or(NoTable::Empty)?;
        let columns = cells(head);
        let key = columns
            .iter()
            .position(|c| c == key)
            .ok_or(NoTable::NoKey)?;
        let mut rows = vec![];
        for (number, line) in lines {
            let row = cells(line);
            if row.len() != columns.len() {
                return Err(NoTable::Uneven(number + 1));
            }
            rows.push(row);
        }
        Ok(Rows {
            name: name.to_owned(),
            key,
            columns,
            rows,
        })
    }

    /// Appends the table to bytes.
    pub(crate) fn pack(&self, out: &mut Packer<'_>) {
        out.text(&self.name);
        out.count(self.key);
        out.count(self.columns.len());
        out.count(self.rows.len());
        let cells = self.columns.iter().chain(self.rows.iter().flatten());
        cells.for_each(|cell| out.text(cell));
    }

    /// Takes a table from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Rows> {
        let (name, key) = (from.text()?.into(), from.count()?);
        let (columns, rows) = (from.count()?, from.count()?);
        let mut row = || (0..columns).map(|_| Ok(from.text()?.into())).collect();
        let columns: Vec<String> = row()?;
        if key >= columns.len() {
            return Err(io::ErrorKind::InvalidData.into());
        }
        Ok(Rows {
            name,
            key,
            columns,
            rows: (0..rows).map(|_| row()).collect::<io::Result<_>>()?,
        })
    }

    /// Returns the cell of the row with a key.
    ///
    /// # Errors
    /// Which of key and column is not there.
    pub fn cell(&self, key: &Value, column: &str) -> Result<Value, Unfound> {
        let at = self
            .columns
            .iter()
            .position(|c| c == column)
            .ok_or(Unfound {
                argument: 2,
                known: self.columns.clone(),
            })?;
        let is_row = |row: &&Vec<String>| Value::read(&row[self.key]) == *key;
        let row = self.rows.iter().find(is_row).ok_or_else(|| Unfound {
            argument: 1,
            known: self.rows.iter().map(|row| row[self.key].clone()).collect(),
        })?;
        Ok(Value::read(&row[at]))
    }
}

/// Divides a line at commas; quotes hold commas together.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut cell, mut quoted) = (vec![], String::new(), false);
    let mut chars = line.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '"' if quoted && chars.peek() == Some(&'"') => {
                chars.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(std::mem::take(&mut cell).trim().to_owned()),
            c => cell.push(c),
        }
    }
    cells.push(cell.trim().to_owned());
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_by_their_key() {
        let text = "year,so-nikai,\"chu, nikai\"\n1928,40.5,29.7\n1998,40.5,19.3\n";
        let rows = Rows::read("shares", "year", text).expect("is a table");
        let cell = rows.cell(&Value::Number(1928.0), "chu, nikai");
        assert_eq!(cell, Ok(Value::Number(29.7)));
        assert_eq!(
            rows.cell(&Value::Number(1900.0), "so-nikai")
                .expect_err("no such year")
                .argument,
            1
        );
        assert_eq!(
            Rows::read("t", "key", "a,b\n").expect_err("no key"),
            NoTable::NoKey
        );
        assert_eq!(
            Rows::read("t", "a", "a,b\n1\n").expect_err("a cell is missing"),
            NoTable::Uneven(2)
        );
    }
}
