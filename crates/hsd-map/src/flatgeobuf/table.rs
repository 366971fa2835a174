//! Tables of FlatBuffers, read without trust: every place is looked up within the buffer.

/// A table in a buffer.
#[derive(Clone, Copy)]
pub(super) struct Table<'a> {
    bytes: &'a [u8],
    at: usize,
}

/// A list in a buffer: its bytes from the first item on, and the number of items.
type List<'a> = (&'a [u8], usize);

impl<'a> Table<'a> {
    /// Returns the root table of a buffer.
    pub(super) fn root(bytes: &'a [u8]) -> Option<Table<'a>> {
        let at = u32_at(bytes, 0)? as usize;
        Some(Table { bytes, at })
    }

    /// Returns the place of a field; `None` if the table lacks it.
    fn field(&self, number: usize) -> Option<usize> {
        let back = i32::from_le_bytes(self.bytes.get(self.at..)?.first_chunk().copied()?);
        let names = usize::try_from((self.at as i64).checked_sub(i64::from(back))?).ok()?;
        let length = usize::from(u16_at(self.bytes, names)?);
        let slot = 4 + 2 * number;
        if slot + 2 > length {
            return None;
        }
        let offset = usize::from(u16_at(self.bytes, names + slot)?);
        (offset > 0).then_some(self.at + offset)
    }

    /// Returns the first bytes of a field.
    pub(super) fn scalar<const N: usize>(&self, number: usize) -> Option<[u8; N]> {
        self.bytes
            .get(self.field(number)?..)?
            .first_chunk()
            .copied()
    }

    fn target(&self, number: usize) -> Option<usize> {
        let at = self.field(number)?;
        at.checked_add(u32_at(self.bytes, at)? as usize)
    }

    /// Returns a table.
    pub(super) fn table(&self, number: usize) -> Option<Table<'a>> {
        let at = self.target(number)?;
        Some(Table {
            bytes: self.bytes,
            at,
        })
    }

    /// Returns a list of items of so many bytes.
    pub(super) fn list(&self, number: usize, size: usize) -> Option<List<'a>> {
        let at = self.target(number)?;
        let count = u32_at(self.bytes, at)? as usize;
        let from = at.checked_add(4)?;
        let end = from.checked_add(count.checked_mul(size)?)?;
        Some((self.bytes.get(from..end)?, count))
    }

    /// Returns a list of numbers.
    pub(super) fn numbers(&self, number: usize) -> Option<Vec<f64>> {
        let (bytes, _) = self.list(number, 8)?;
        let numbers = bytes
            .chunks_exact(8)
            .filter_map(|b| b.first_chunk().copied());
        Some(numbers.map(f64::from_le_bytes).collect())
    }

    /// Returns a text.
    pub(super) fn text(&self, number: usize) -> Option<String> {
        let (bytes, _) = self.list(number, 1)?;
        Some(String::from_utf8_lossy(bytes).into_owned())
    }

    /// Returns the tables of a list.
    pub(super) fn tables(&self, number: usize) -> Option<Vec<Table<'a>>> {
        let start = self.target(number)?.checked_add(4)?;
        let (_, count) = self.list(number, 4)?;
        let table = |item: usize| {
            let at = start + 4 * item;
            let at = at.checked_add(u32_at(self.bytes, at)? as usize)?;
            Some(Table {
                bytes: self.bytes,
                at,
            })
        };
        (0..count).map(table).collect()
    }
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes
        .get(at..)?
        .first_chunk()
        .copied()
        .map(u32::from_le_bytes)
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    bytes
        .get(at..)?
        .first_chunk()
        .copied()
        .map(u16::from_le_bytes)
}
