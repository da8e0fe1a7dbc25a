//! FlatBuffers by hand: tables with optional fields, vectors and texts, little endian.
//!
//! Source: <https://flatbuffers.dev/internals/>. Offsets of a file are judged at every step, so that one which points out of its buffer is
//! a field that is wrong, never a panic.

/// The content of a buffer, without its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Buffer<'a>(&'a [u8]);

/// A table of a buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Table<'a> {
    buffer: Buffer<'a>,
    at: usize,
    /// Where its fields are, and how many bytes of that there are.
    fields: usize,
    length: usize,
}

/// The message of an offset that leads nowhere.
pub(super) const BROKEN: &str = "an offset points out of its buffer";

type Found<T> = Result<T, &'static str>;

impl<'a> Buffer<'a> {
    /// The table that a buffer holds.
    pub(super) fn root(bytes: &'a [u8]) -> Found<Table<'a>> {
        let buffer = Self(bytes);
        buffer.table(buffer.follow(0)?)
    }

    fn bytes<const N: usize>(self, at: usize) -> Found<[u8; N]> {
        let end = at.checked_add(N).ok_or(BROKEN)?;
        self.0.get(at..end).and_then(|bytes| bytes.try_into().ok()).ok_or(BROKEN)
    }

    fn short(self, at: usize) -> Found<usize> {
        Ok(usize::from(u16::from_le_bytes(self.bytes(at)?)))
    }

    fn count(self, at: usize) -> Found<usize> {
        Ok(u32::from_le_bytes(self.bytes(at)?) as usize)
    }

    /// Where an offset leads.
    fn follow(self, at: usize) -> Found<usize> {
        at.checked_add(self.count(at)?).ok_or(BROKEN)
    }

    fn table(self, at: usize) -> Found<Table<'a>> {
        let back = i64::from(i32::from_le_bytes(self.bytes(at)?));
        let fields = usize::try_from(at as i64 - back).map_err(|_| BROKEN)?;
        Ok(Table { buffer: self, at, fields, length: self.short(fields)? })
    }

    /// The items of a vector, of so many bytes each.
    fn vector(self, at: usize, size: usize) -> Found<&'a [u8]> {
        let length = self.count(at)?.checked_mul(size).ok_or(BROKEN)?;
        self.0[at + 4..].get(..length).ok_or(BROKEN)
    }
}

impl<'a> Table<'a> {
    /// Where a field is, if the table has it.
    fn field(self, number: usize) -> Found<Option<usize>> {
        let entry = 4 + 2 * number;
        if entry + 2 > self.length {
            return Ok(None);
        }
        let place = self.buffer.short(self.fields + entry)?;
        Ok((place > 0).then_some(self.at + place))
    }

    /// A number of one byte, zero where there is none.
    pub(super) fn byte(self, number: usize) -> Found<u8> {
        self.field(number)?.map_or(Ok(0), |at| Ok(self.buffer.bytes::<1>(at)?[0]))
    }

    /// A number of two bytes, where there is one.
    pub(super) fn short(self, number: usize) -> Found<Option<u16>> {
        self.field(number)?.map(|at| Ok(u16::from_le_bytes(self.buffer.bytes(at)?))).transpose()
    }

    /// A number of four bytes, zero where there is none.
    pub(super) fn int(self, number: usize) -> Found<i32> {
        self.field(number)?.map_or(Ok(0), |at| Ok(i32::from_le_bytes(self.buffer.bytes(at)?)))
    }

    /// A number of eight bytes, zero where there is none.
    pub(super) fn long(self, number: usize) -> Found<u64> {
        self.field(number)?.map_or(Ok(0), |at| Ok(u64::from_le_bytes(self.buffer.bytes(at)?)))
    }

    /// A vector of items of so many bytes, empty where there is none.
    pub(super) fn vector(self, number: usize, size: usize) -> Found<&'a [u8]> {
        match self.field(number)? {
            Some(at) => self.buffer.vector(self.buffer.follow(at)?, size),
            None => Ok(&[]),
        }
    }

    /// A text, where there is one.
    pub(super) fn text(self, number: usize) -> Found<Option<String>> {
        let bytes = self.vector(number, 1)?;
        Ok(self.field(number)?.map(|_| String::from_utf8_lossy(bytes).into_owned()))
    }

    /// A table inside of this one, where there is one.
    pub(super) fn table(self, number: usize) -> Found<Option<Self>> {
        self.field(number)?.map(|at| self.buffer.table(self.buffer.follow(at)?)).transpose()
    }

    /// The tables of a vector, none where there is no vector.
    pub(super) fn tables(self, number: usize) -> Found<impl Iterator<Item = Found<Self>>> {
        let first = self.field(number)?.map_or(Ok(0), |at| self.buffer.follow(at))?;
        let count = self.vector(number, 4)?.len() / 4;
        Ok((0..count).map(move |i| self.buffer.table(self.buffer.follow(first + 4 + 4 * i)?)))
    }
}

/// Writes a buffer from front to back: a table first, then what it points to.
#[derive(Debug, Default)]
pub(super) struct Builder(Vec<u8>);

/// Where the fields of a table that is written are.
pub(super) struct Fields(Vec<usize>);

impl Fields {
    /// Where a field is.
    pub(super) fn at(&self, number: usize) -> usize {
        self.0[number]
    }
}

/// The bytes of a field that points to something.
pub(super) const OFFSET: u8 = 4;

impl Builder {
    /// Begins a buffer with its length and the offset of its table.
    pub(super) fn begin(&mut self) {
        self.0.clear();
        self.0.resize(8, 0);
    }

    /// The place that points to the first table.
    pub(super) const ROOT: usize = 4;

    /// Makes what comes so many bytes later begin at a multiple of the size.
    fn align(&mut self, size: usize, after: usize) {
        while !(self.0.len() + after).is_multiple_of(size) {
            self.0.push(0);
        }
    }

    /// Makes an offset lead to what follows.
    fn point(&mut self, from: usize) {
        let distance = (self.0.len() - from) as u32;
        self.put(from, &distance.to_le_bytes());
    }

    /// Gives a field its value.
    pub(super) fn put(&mut self, at: usize, bytes: &[u8]) {
        self.0[at..at + bytes.len()].copy_from_slice(bytes);
    }

    /// Writes a table whose fields have so many bytes each, none where a field is left out. Their values follow by [`Self::put`].
    pub(super) fn table(&mut self, from: usize, sizes: &[u8]) -> Fields {
        self.shared(&[from], sizes)
    }

    /// Writes a table that several places point to.
    pub(super) fn shared(&mut self, from: &[usize], sizes: &[u8]) -> Fields {
        let length = 4 + 2 * sizes.len();
        // The table begins at a multiple of eight, so that places in it are as aligned as those in the buffer.
        self.align(8, length);
        let fields = self.0.len();
        let mut at = 4;
        let places: Vec<usize> = sizes
            .iter()
            .map(|&size| {
                let size = usize::from(size);
                if size == 0 {
                    return 0;
                }
                let place = usize::next_multiple_of(at, size);
                at = place + size;
                place
            })
            .collect();
        for number in [length, at].into_iter().chain(places.iter().copied()) {
            self.0.extend((number as u16).to_le_bytes());
        }
        from.iter().for_each(|&from| self.point(from));
        let table = self.0.len();
        self.0.extend(((table - fields) as i32).to_le_bytes());
        self.0.resize(table + at, 0);
        Fields(places.into_iter().map(|place| table + place).collect())
    }

    /// Begins a vector of so many items of a size; they follow by [`Self::push`].
    pub(super) fn vector(&mut self, from: usize, count: usize, size: usize) {
        self.align(size.max(4), 4);
        self.point(from);
        self.push(&(count as u32).to_le_bytes());
    }

    /// Appends an item of a vector.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    /// Begins a vector of tables, and tells the places that point to them.
    pub(super) fn tables(&mut self, from: usize, count: usize) -> impl Iterator<Item = usize> + use<> {
        self.vector(from, count, 4);
        let first = self.0.len();
        self.0.resize(first + 4 * count, 0);
        (0..count).map(move |i| first + 4 * i)
    }

    /// Writes a text.
    pub(super) fn text(&mut self, from: usize, text: &str) {
        self.vector(from, text.len(), 1);
        self.push(text.as_bytes());
        self.push(&[0]);
    }

    /// The whole buffer, with its length before it, up to a multiple of eight bytes.
    pub(super) fn finish(&mut self) -> &[u8] {
        self.align(8, 0);
        let length = (self.0.len() - 4) as u32;
        self.put(0, &length.to_le_bytes());
        &self.0
    }
}
