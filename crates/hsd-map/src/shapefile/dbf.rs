//! Tables of dBase, as shapefiles have them: tolerant, since real ones keep to no standard.

use crate::fault::{Fault, Kind};
use crate::feature::{Columns, Layer, Value};
use crate::input::encoding_named;
use encoding_rs::Encoding;
use hsd_base::source::Stream;
use std::io::{BufRead, BufReader, Read};
use std::sync::Arc;

/// A table, read row by row.
pub(super) struct Table {
    rows: BufReader<Box<dyn Stream>>,
    fields: Vec<Field>,
    count: u64,
    row: Vec<u8>,
    /// The encoding that is named; if none is, every text is looked at.
    encoding: Option<&'static Encoding>,
    /// The number of rows that were read.
    at: u64,
}

struct Field {
    column: usize,
    of: u8,
    from: usize,
    length: usize,
}

/// What a text of numbers or dates may be: a value, or none that is meant.
type Parsed = Result<Value, Kind>;

impl Table {
    /// Reads the head of a table. `None`, with a remark, if it is none.
    pub(super) fn open(
        stream: Box<dyn Stream>,
        file: &Arc<str>,
        encoding: Option<&str>,
        layer: &mut Layer,
        remarks: &mut Vec<Fault>,
    ) -> Option<Table> {
        let mut rows = BufReader::new(stream);
        let mut damaged = || {
            let what = "the head of the table (.dbf)";
            remarks.push(Fault::of_file(file, Kind::Damaged { what }));
        };
        let mut head = [0; 32];
        let length =
            |head: &[u8; 32], at: usize| usize::from(u16::from_le_bytes([head[at], head[at + 1]]));
        let is_read = rows.read_exact(&mut head).is_ok() && length(&head, 8) > 32;
        let mut rest = vec![0; length(&head, 8).saturating_sub(32)];
        // dBase II (2) has another head.
        if !is_read || head[0] == 2 || rows.read_exact(&mut rest).is_err() {
            damaged();
            return None;
        }
        let named = encoding.and_then(encoding_named);
        let mut table = Table {
            rows,
            fields: vec![],
            count: u64::from(u32::from_le_bytes([head[4], head[5], head[6], head[7]])),
            row: vec![0; length(&head, 10)],
            encoding: named.or_else(|| language_driver(head[29])),
            at: 0,
        };
        if table.row.is_empty() {
            damaged();
            return None;
        }
        if let Some(name) = encoding.filter(|_| named.is_none()) {
            let name = name.into();
            remarks.push(Fault::of_file(file, Kind::UnknownEncoding { name }));
        }
        let mut from = 1;
        for descriptor in rest.chunks_exact(32).take_while(|d| d[0] != 0x0d) {
            let (field, name) = table.field(descriptor, from, layer, file, remarks)?;
            from += field.length;
            if !matches!(field.of, b'C' | b'N' | b'F' | b'D' | b'L' | b'I') {
                let of = char::from(field.of);
                remarks.push(Fault::of_file(file, Kind::ColumnType { of }).in_field(name));
            }
            table.fields.push(field);
        }
        layer.count = Some(table.count);
        Some(table)
    }

    /// Returns the field of a descriptor and the name of its column.
    fn field(
        &self,
        descriptor: &[u8],
        from: usize,
        layer: &mut Layer,
        file: &Arc<str>,
        remarks: &mut Vec<Fault>,
    ) -> Option<(Field, Box<str>)> {
        let name = &descriptor[..11];
        let end = name.iter().position(|b| *b == 0).unwrap_or(name.len());
        let (text, _) = self.decode(&name[..end]);
        let own: Box<str> = match text.trim() {
            "" => format!("field {}", layer.columns.list().len() + 1).into(),
            name => name.into(),
        };
        let mut name = own.clone();
        let mut again = 1;
        while layer.columns.find(&name).is_some() {
            again += 1;
            name = format!("{own}_{again}").into();
        }
        if again > 1 {
            remarks.push(Fault::of_file(file, Kind::DuplicateColumn).in_field(own));
        }
        let of = descriptor[11];
        // Long texts have the high byte of their length where numbers have decimals.
        let high = if of == b'C' {
            usize::from(descriptor[17])
        } else {
            0
        };
        let field = Field {
            column: layer.columns.number(&name)?,
            of,
            from,
            length: usize::from(descriptor[16]) + 256 * high,
        };
        Some((field, name))
    }

    /// Returns true if there is another row: the head may count more rows than the file has.
    pub(super) fn has_row(&mut self) -> bool {
        // 0x1a ends a table of dBase.
        let more = self
            .rows
            .fill_buf()
            .is_ok_and(|left| !matches!(left, [] | [0x1a]));
        self.at < self.count && more
    }

    /// Returns the number of rows that the head says.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// Returns the fields of the row of this number, which must not lie before the last one; what is wrong with them goes
    /// into `found`, with the name of the field.
    pub(super) fn row(
        &mut self,
        number: u64,
        columns: &mut Columns,
        found: &mut Vec<(Option<Box<str>>, Kind)>,
    ) -> Vec<(usize, Value)> {
        while self.at <= number {
            if self.at >= self.count || self.rows.read_exact(&mut self.row).is_err() {
                found.push((None, Kind::NoRow));
                return vec![];
            }
            self.at += 1;
        }
        let mut fields = vec![];
        for field in &self.fields {
            let end = field.from + field.length;
            let Some(bytes) = self.row.get(field.from..end.min(self.row.len())) else {
                continue;
            };
            let value = self.value(field.of, bytes).unwrap_or_else(|kind| {
                let name = columns.list()[field.column].name.clone();
                let garbled = (kind == Kind::Encoding).then(|| self.decode(bytes).0);
                found.push((Some(name), kind));
                garbled.map_or(Value::Null, |text| Value::Text(text.trim_end().into()))
            });
            columns.note(field.column, &value);
            fields.push((field.column, value));
        }
        fields
    }

    fn value(&self, of: u8, bytes: &[u8]) -> Parsed {
        match of {
            b'I' if bytes.len() == 4 => {
                let number = i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
                Ok(Value::Integer(number.into()))
            }
            b'N' | b'F' => number(&self.decode(bytes).0),
            b'L' => Ok(match bytes.first() {
                Some(b'T' | b't' | b'Y' | b'y') => Value::Bool(true),
                Some(b'F' | b'f' | b'N' | b'n') => Value::Bool(false),
                _ => Value::Null,
            }),
            b'D' => Ok(date(&self.decode(bytes).0)),
            _ => {
                let (text, is_garbled) = self.decode(bytes);
                let text = text.trim_matches('\0').trim_end();
                match is_garbled {
                    true => Err(Kind::Encoding),
                    false if text.is_empty() => Ok(Value::Null),
                    false => Ok(Value::Text(text.into())),
                }
            }
        }
    }

    /// Returns the text of bytes, and whether some are not in the encoding.
    fn decode(&self, bytes: &[u8]) -> (String, bool) {
        let bytes = bytes.trim_ascii_end();
        if let Some(encoding) = self.encoding {
            let (text, is_garbled) = encoding.decode_without_bom_handling(bytes);
            // A text that was cut to the length of its field may end within a character.
            return match is_garbled && text.ends_with('\u{fffd}') && !bytes.is_empty() {
                true => {
                    let cut = &bytes[..bytes.len() - 1];
                    let (shorter, is_garbled) = encoding.decode_without_bom_handling(cut);
                    (shorter.into_owned(), is_garbled)
                }
                false => (text.into_owned(), is_garbled),
            };
        }
        if let Ok(text) = std::str::from_utf8(bytes) {
            return (text.to_owned(), false);
        }
        let japanese = encoding_rs::SHIFT_JIS.decode_without_bom_handling(bytes);
        match japanese {
            (text, false) => (text.into_owned(), false),
            _ => {
                let western = encoding_rs::WINDOWS_1252.decode_without_bom_handling(bytes);
                (western.0.into_owned(), false)
            }
        }
    }
}

fn number(text: &str) -> Parsed {
    let text = text.trim_matches(|c: char| c.is_whitespace() || c == '\0');
    if text.is_empty() || text.chars().all(|c| c == '*') {
        return Ok(Value::Null);
    }
    if let Ok(whole) = text.parse() {
        return Ok(Value::Integer(whole));
    }
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(Value::Number(number)),
        _ => Err(Kind::NotANumber { text: text.into() }),
    }
}

fn date(text: &str) -> Value {
    let text = text.trim_matches(|c: char| c.is_whitespace() || c == '\0');
    let is_date = text.len() == 8 && text.bytes().all(|b| b.is_ascii_digit());
    match is_date {
        _ if text.is_empty() || text == "00000000" => Value::Null,
        true => Value::Text(format!("{}-{}-{}", &text[..4], &text[4..6], &text[6..]).into()),
        false => Value::Text(text.into()),
    }
}

/// Returns the encoding that the head names. Western ones are written by default whatever the texts are, so they say
/// nothing.
fn language_driver(id: u8) -> Option<&'static Encoding> {
    Some(match id {
        0x13 | 0x7b => encoding_rs::SHIFT_JIS,
        0x4d | 0x7a => encoding_rs::GBK,
        0x4e | 0x79 => encoding_rs::EUC_KR,
        0x4f | 0x78 => encoding_rs::BIG5,
        0x65 => encoding_rs::IBM866,
        0xc8 => encoding_rs::WINDOWS_1250,
        0xc9 => encoding_rs::WINDOWS_1251,
        _ => return None,
    })
}
