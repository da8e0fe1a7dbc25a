//! Attributes of features: a table with a named column for each attribute and a row for each feature.
//!
//! Cells are kept as JSON has them, which knows texts, numbers with all their digits, and whether there is a value. A row takes memory for
//! the cells that it has, however many columns there are.

use std::borrow::Cow;
use std::collections::HashMap;

/// The row of a point that belongs to no feature.
const NO_ROW: u32 = u32::MAX;

/// The attributes of points, by way of the features that these belong to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// The attributes: a row for each feature, and none where they were not asked for ([`crate::ReadOptions::attributes`]).
    pub table: Table,
    /// The row of each point; nothing where no point has one.
    rows: Vec<u32>,
    /// The heights of the points are a column of the table.
    pub(crate) has_heights: bool,
}

impl Features {
    /// The features of points whose rows are these, in the order of the points.
    pub(crate) fn new(table: Table, rows: Vec<u32>) -> Self {
        Self { table, rows, has_heights: false }
    }

    /// A table with a row for each point.
    pub fn of_points(table: Table) -> Self {
        let rows = (0..table.len() as u32).collect();
        Self { table, rows, has_heights: false }
    }

    /// The row of a point, if there is one.
    pub fn row(&self, point: usize) -> Option<usize> {
        self.rows.get(point).filter(|&&row| row != NO_ROW).map(|&row| row as usize)
    }

    /// The features with the height of each point, in a column `z`, or `z_2` and so on where there is one of that name; as they are where a
    /// column has the heights already.
    #[must_use]
    pub fn with_heights(&self, heights: &[f64]) -> Self {
        const NAME: &str = "z";
        if self.has_heights {
            return self.clone();
        }
        let mut table = Table::default();
        self.table.names.iter().for_each(|name| _ = table.column(name));
        let is_taken = |name: &str| self.table.places.contains_key(name);
        let name = if is_taken(NAME) { numbered(NAME, is_taken) } else { NAME.to_owned() };
        let column = table.column(&name);
        for (point, &number) in heights.iter().enumerate() {
            table.begin();
            let row = self.row(point).into_iter().flat_map(|row| self.table.row(row));
            row.for_each(|(column, cell)| table.put(column, Value::Json(cell)));
            table.put(column, Value::Number(number));
        }
        Self { has_heights: true, ..Self::of_points(table) }
    }

    /// Appends the features of `more` other points to those of `count`.
    pub(crate) fn join(&mut self, count: usize, other: &Self, more: usize) {
        let have_both = self.has_heights && (other.has_heights || more == 0);
        self.has_heights = if count == 0 { other.has_heights } else { have_both };
        let shift = self.table.len() as u32;
        self.table.append(&other.table);
        if self.rows.is_empty() && other.rows.is_empty() {
            return;
        }
        self.rows.resize(count, NO_ROW);
        self.rows.extend(other.rows.iter().map(|&row| if row == NO_ROW { row } else { row + shift }));
        self.rows.resize(count + more, NO_ROW);
    }
}

/// Named columns, and rows of cells.
///
/// ```
/// use delone_io::{Table, Value};
///
/// let mut table = Table::default();
/// table.begin();
/// table.set("name", Value::Text("Oslo"));
/// table.set("people", Value::Integer(709_037));
/// assert_eq!(table.names(), ["name", "people"]);
/// assert_eq!(table.row(0).map(|(_, cell)| cell).collect::<Vec<_>>(), [r#""Oslo""#, "709037"]);
/// assert_eq!(table.value(0, 1), Value::Integer(709_037));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Table {
    names: Vec<String>,
    places: HashMap<String, u32>,
    /// The cells of all rows as JSON, and where each ends.
    text: String,
    ends: Vec<usize>,
    /// The column of each cell.
    columns: Vec<u32>,
    /// Where each row begins among the cells.
    begins: Vec<usize>,
}

impl PartialEq for Table {
    fn eq(&self, other: &Self) -> bool {
        let row = |table: &Self, i| table.row(i).map(|(k, cell)| (k, cell.to_owned())).collect::<Vec<_>>();
        self.names == other.names
            && self.len() == other.len()
            && (0..self.len()).all(|i| row(self, i) == row(other, i))
    }
}

/// The value of a cell.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value<'a> {
    /// There is none.
    Null,
    /// True or false.
    Bool(bool),
    /// A whole number of 64 bits.
    Integer(i64),
    /// Another number.
    Number(f64),
    /// A text.
    Text(&'a str),
    /// A text that is its own.
    Owned(String),
    /// A list or an object, as JSON.
    Json(&'a str),
}

/// The type of a column: that of all its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColumnType {
    /// True or false.
    Bool,
    /// Whole numbers of 64 bits.
    Integer,
    /// Numbers.
    Number,
    /// Texts, or values of several types.
    Text,
}

impl Table {
    /// The names of the columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The names that the columns have beside others: one that has the name of another gets a number after it.
    pub(crate) fn names_beside(&self, others: &[&str]) -> Vec<String> {
        let is_taken = |name: &str| others.contains(&name) || self.places.contains_key(name);
        let beside = |name: &String| {
            if others.contains(&name.as_str()) { numbered(name, is_taken) } else { name.clone() }
        };
        self.names.iter().map(beside).collect()
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.begins.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.begins.is_empty()
    }

    /// The cells of a row that have a value, as JSON, each with its column.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, &str)> {
        let begin = self.begins.get(row).copied().unwrap_or(self.ends.len());
        let end = self.begins.get(row + 1).copied().unwrap_or(self.ends.len());
        (begin..end).map(|cell| (self.columns[cell] as usize, self.cell(cell)))
    }

    /// Whether a number is infinite, which GeoJSON has no word for.
    ///
    /// ```
    /// use delone_io::{Table, Value};
    ///
    /// let mut table = Table::default();
    /// table.begin();
    /// table.set("depth", Value::Number(f64::INFINITY));
    /// assert!(table.has_infinities());
    /// ```
    pub fn has_infinities(&self) -> bool {
        (0..self.ends.len()).any(|cell| is_infinite(self.cell(cell)))
    }

    fn cell(&self, cell: usize) -> &str {
        let begin = if cell == 0 { 0 } else { self.ends[cell - 1] };
        &self.text[begin..self.ends[cell]]
    }

    /// The value in a row and a column.
    pub fn value(&self, row: usize, column: usize) -> Value<'_> {
        let cell = self.row(row).find(|cell| cell.0 == column);
        cell.map_or(Value::Null, |(_, cell)| Value::of(cell))
    }

    /// The fields of a row in a table of text, one for each column.
    pub(crate) fn fields(&self, row: Option<usize>) -> Vec<String> {
        let mut fields = vec![String::new(); self.names.len()];
        let cells = row.into_iter().flat_map(|row| self.row(row));
        cells.for_each(|(column, cell)| fields[column] = Value::of(cell).field());
        fields
    }

    /// The types of all columns.
    pub fn types(&self) -> Vec<ColumnType> {
        let mut types: Vec<Option<ColumnType>> = vec![None; self.names.len()];
        for (&column, cell) in self.columns.iter().zip(0..) {
            let own = match Value::of(self.cell(cell)) {
                Value::Null => continue,
                Value::Bool(_) => ColumnType::Bool,
                Value::Integer(_) => ColumnType::Integer,
                Value::Number(_) => ColumnType::Number,
                _ => ColumnType::Text,
            };
            let known = &mut types[column as usize];
            *known = Some(match (*known, own) {
                (None, own) => own,
                (Some(known), own) if known == own => own,
                (
                    Some(ColumnType::Integer | ColumnType::Number),
                    ColumnType::Integer | ColumnType::Number,
                ) => ColumnType::Number,
                _ => ColumnType::Text,
            });
        }
        types.into_iter().map(|known| known.unwrap_or(ColumnType::Text)).collect()
    }

    /// The numbers of a column by row, NaN where there is none; nothing where there are other values, or whole numbers that are none of
    /// double precision.
    pub(crate) fn numbers(&self, column: usize) -> Option<Vec<f64>> {
        let number = |row| match self.value(row, column) {
            Value::Null => Some(f64::NAN),
            Value::Number(number) => Some(number),
            Value::Integer(whole) => Some(whole as f64).filter(|&number| number as i128 == i128::from(whole)),
            _ => None,
        };
        (0..self.len()).map(number).collect()
    }

    /// The place of a column, which is added if there is none of this name.
    pub fn column(&mut self, name: &str) -> usize {
        if let Some(&place) = self.places.get(name) {
            return place as usize;
        }
        let place = self.names.len();
        self.names.push(name.to_owned());
        self.places.insert(name.to_owned(), place as u32);
        place
    }

    /// Begins a row.
    pub fn begin(&mut self) {
        self.begins.push(self.ends.len());
    }

    /// Gives the last row a value in the column of this name.
    pub fn set(&mut self, name: &str, value: Value) {
        let column = self.column(name);
        self.put(column, value);
    }

    /// Gives the last row a value in a column.
    pub fn put(&mut self, column: usize, value: Value) {
        match value {
            Value::Null => return,
            Value::Bool(is_so) => self.text.push_str(if is_so { "true" } else { "false" }),
            Value::Integer(number) => self.text.push_str(&number.to_string()),
            Value::Number(number) if number.is_nan() => return,
            // JSON has no word for it, and takes a number beyond all doubles, which readers round to it.
            Value::Number(number) if number.is_infinite() => {
                self.text.push_str(if number > 0.0 { BEYOND } else { MINUS_BEYOND });
            }
            Value::Number(number) => self.text.push_str(&format!("{number:?}")),
            Value::Text(text) => self.text.push_str(&quoted(text)),
            Value::Owned(text) => self.text.push_str(&quoted(&text)),
            Value::Json(json) => self.text.push_str(json),
        }
        self.ends.push(self.text.len());
        self.columns.push(column as u32);
    }

    /// Takes the last row back.
    pub(crate) fn take_back(&mut self) {
        let begin = self.begins.pop().unwrap_or_default();
        self.ends.truncate(begin);
        self.columns.truncate(begin);
        self.text.truncate(self.ends.last().copied().unwrap_or_default());
    }

    /// Makes columns of numbers and texts columns of texts: where all values come as texts, one that is no number tells that none is.
    pub(crate) fn unify(&mut self) {
        let is_text: Vec<bool> = self.types().iter().map(|&own| own == ColumnType::Text).collect();
        let is_mixed =
            |cell: usize| is_text[self.columns[cell] as usize] && !self.cell(cell).starts_with('"');
        if !(0..self.ends.len()).any(is_mixed) {
            return;
        }
        let mut text = String::with_capacity(self.text.len());
        let mut ends = Vec::with_capacity(self.ends.len());
        for cell in 0..self.ends.len() {
            let own = self.cell(cell);
            text.push_str(&if is_mixed(cell) { Cow::Owned(quoted(own)) } else { Cow::Borrowed(own) });
            ends.push(text.len());
        }
        (self.text, self.ends) = (text, ends);
    }

    /// Appends the rows of another table; columns of one name are one.
    pub(crate) fn append(&mut self, other: &Self) {
        let places: Vec<u32> = other.names.iter().map(|name| self.column(name) as u32).collect();
        let (shift, cells) = (self.text.len(), self.ends.len());
        self.begins.extend(other.begins.iter().map(|begin| begin + cells));
        self.ends.extend(other.ends.iter().map(|end| end + shift));
        self.columns.extend(other.columns.iter().map(|&column| places[column as usize]));
        self.text.push_str(&other.text);
    }
}

impl<'a> Value<'a> {
    /// The value of a cell that is JSON.
    pub(crate) fn of(cell: &'a str) -> Self {
        match cell.as_bytes().first() {
            None | Some(b'n') => Self::Null,
            Some(b't') => Self::Bool(true),
            Some(b'f') => Self::Bool(false),
            Some(b'[' | b'{') => Self::Json(cell),
            Some(b'"') if cell.len() >= 2 && !cell.contains('\\') => Self::Text(&cell[1..cell.len() - 1]),
            Some(b'"') => serde_json::from_str(cell).map_or(Self::Json(cell), Self::Owned),
            Some(_) => match (cell.parse(), cell.parse()) {
                (Ok(integer), _) => Self::Integer(integer),
                (_, Ok(number)) => Self::Number(number),
                _ => Self::Json(cell),
            },
        }
    }

    /// A whole number: as near as numbers come where it is beyond the whole ones.
    pub(crate) fn of_whole(number: u64) -> Self {
        i64::try_from(number).map_or(Self::Number(number as f64), Self::Integer)
    }

    /// The value that a text of JSON stands for; the text itself where it is none.
    pub(crate) fn of_json(text: &'a str) -> Self {
        // A raw value is judged, and not taken apart.
        let json = serde_json::from_str::<&serde_json::value::RawValue>(text);
        json.map_or(Self::Text(text), |json| Self::of(json.get()))
    }

    /// Bytes, as a text of hexadecimal digits.
    pub(crate) fn of_bytes(bytes: &[u8]) -> Self {
        Self::Owned(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
    }

    /// The value that a field of a text stands for: a number if it is written as JSON writes one, and 64 bits hold it.
    pub(crate) fn of_field(field: &'a str) -> Self {
        if field.is_empty() {
            return Self::Null;
        }
        let is_whole = field.bytes().all(|byte| byte.is_ascii_digit() || byte == b'-');
        let is_number = is_json_number(field) && (!is_whole || field.parse::<i64>().is_ok());
        if is_number { Self::Json(field) } else { Self::Text(field) }
    }

    /// The value as a field of a table of text, in quotes where these are needed; an empty one where there is none.
    pub(crate) fn field(&self) -> String {
        let text = self.text().unwrap_or_default();
        if text.contains(['"', ',', '\n', '\r']) || text.trim().len() < text.len() {
            return format!("\"{}\"", text.replace('"', "\"\""));
        }
        text.into_owned()
    }

    /// The value as a text, where there is one.
    pub fn text(&self) -> Option<Cow<'a, str>> {
        Some(match self {
            Self::Null => return None,
            Self::Bool(is_so) => Cow::Borrowed(if *is_so { "true" } else { "false" }),
            Self::Integer(number) => Cow::Owned(number.to_string()),
            Self::Number(number) => Cow::Owned(format!("{number:?}")),
            Self::Text(text) | Self::Json(text) => Cow::Borrowed(*text),
            Self::Owned(text) => Cow::Owned(text.clone()),
        })
    }
}

/// Numbers that are rounded to the infinities.
const BEYOND: &str = "1e999";
const MINUS_BEYOND: &str = "-1e999";

/// Whether a value as JSON is a number that is rounded to one of the infinities; without an exponent these have many digits.
pub(crate) fn is_infinite(cell: &str) -> bool {
    let may_be =
        !cell.starts_with('"') && (cell.len() > f64::MAX_10_EXP as usize || cell.contains(['e', 'E']));
    may_be && cell.parse().is_ok_and(f64::is_infinite)
}

/// A name with the least number from 2 after it that nothing has.
pub(crate) fn numbered(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut own = (2_u64..).map(|number| format!("{name}_{number}"));
    own.find(|own| !is_taken(own)).unwrap_or_default()
}

/// Whether a text is a number by the grammar of JSON.
fn is_json_number(text: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let text = text.strip_prefix('-').unwrap_or(text);
    let (mantissa, exponent) = text.split_once(['e', 'E']).map_or((text, None), |(m, e)| (m, Some(e)));
    let (whole, part) = mantissa.split_once('.').map_or((mantissa, None), |(w, p)| (w, Some(p)));
    digits(whole)
        && (whole.len() == 1 || !whole.starts_with('0'))
        && part.is_none_or(digits)
        && exponent.is_none_or(|e| digits(e.strip_prefix(['+', '-']).unwrap_or(e)))
}

/// A text as JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::{ColumnType, Features, Table, Value};

    #[test]
    fn fields_are_what_they_are_written_as() {
        for number in ["0", "-7", "0.10", "1e5", "-1.5E-3", "9223372036854775807"] {
            assert_eq!(Value::of_field(number), Value::Json(number));
        }
        for text in ["007", "+1", "1.", ".5", "NaN", "0x10", "9223372036854775808", "1-2", "a", "--1", "1e"] {
            assert_eq!(Value::of_field(text), Value::Text(text));
        }
        assert_eq!(Value::of_field(""), Value::Null);
    }

    #[test]
    fn cells_come_back() {
        let mut table = Table::default();
        table.begin();
        for (name, value) in [
            ("null", Value::Null),
            ("bool", Value::Bool(true)),
            ("whole", Value::Integer(i64::MIN)),
            ("number", Value::Number(0.1)),
            ("text", Value::Text("plain")),
            ("other", Value::Owned("\"q\"\n".to_owned())),
            ("list", Value::Json("[1,2]")),
        ] {
            table.set(name, value.clone());
            let column = table.column(name);
            assert_eq!(table.value(0, column), value, "{name}");
        }
        assert_eq!((table.len(), table.names().len()), (1, 7));
    }

    #[test]
    fn a_text_among_numbers_makes_texts() {
        let mut table = Table::default();
        for (id, size) in [("12", "1"), ("007", "2.50"), ("", "3")] {
            table.begin();
            table.set("id", Value::of_field(id));
            table.set("size", Value::of_field(size));
        }
        table.unify();
        assert_eq!(table.types(), [ColumnType::Text, ColumnType::Number]);
        let ids: Vec<_> = (0..3).map(|row| table.value(row, 0)).collect();
        assert_eq!(ids, [Value::Text("12"), Value::Text("007"), Value::Null]);
        assert_eq!(table.row(1).map(|cell| cell.1).collect::<Vec<_>>(), ["\"007\"", "2.50"]);
    }

    #[test]
    fn tables_join() {
        let table = |name: &str, value: i64| {
            let mut table = Table::default();
            table.begin();
            table.set(name, Value::Integer(value));
            table
        };
        let mut both = Features::of_points(table("a", 1));
        both.join(1, &Features::default(), 2);
        both.join(3, &Features::of_points(table("b", 2)), 1);
        both.join(4, &Features::of_points(table("a", 3)), 1);
        assert_eq!((0..5).map(|i| both.row(i)).collect::<Vec<_>>(), [Some(0), None, None, Some(1), Some(2)]);
        assert_eq!(both.table.names(), ["a", "b"]);
        assert_eq!((both.table.value(2, 0), both.table.value(1, 0)), (Value::Integer(3), Value::Null));
        let mut none = Features::default();
        none.join(2, &Features::default(), 3);
        assert_eq!(none, Features::default());
    }
}
