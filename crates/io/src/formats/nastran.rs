//! Bulk data of Nastran (`.bdf`, `.nas`): `GRID*` with coordinates in fields of 16 characters, `CTRIA3`, `CTRIA6`, `CQUAD4` and `CTETRA` with the number of
//! their region as the property, and `SET1` with the nodes of each marker. Nodes are numbered as their points, from 1.
//!
//! A coordinate is the decimal number nearest to it of the most digits that 16 characters hold: 15 digits for positive numbers from 0.1 to 10^15,
//! 14 for negative ones, 10 for all others up to 10^300. So it is right up to 5e-15, 5e-14 and 5e-10 of itself. A number of fewer digits is exact.
//!
//! Names are comments that HyperMesh and those who read its files know: `$HMNAME PROP` for regions, `$HMNAME SET` for markers. Properties themselves
//! are for the user, who knows the material.

use std::io::{self, Write};

use delone::Triangulation;

use crate::elements::Elements;
use crate::names::{Rule, together, told};
use crate::{Mesh, Remark};

/// Characters of a large field.
const LARGE_FIELD: usize = 16;

/// The largest number of a small field, which has eight characters.
const SMALL_FIELD_NUMBER: usize = 99_999_999;

/// Decimal digits that tell all doubles apart.
const ALL_DIGITS: usize = 17;

pub(crate) fn write<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let names = elements.names(Rule::TEXT);
    let is_used = elements.is_used();
    let largest = elements.positions.len().max(elements.cell_count());
    let card = if largest > SMALL_FIELD_NUMBER { Card::OF_16_CHARACTERS } else { Card::OF_8_CHARACTERS };
    writeln!(out, "$ {} elements\nCEND\nBEGIN BULK", elements.cell_count())?;
    let mut rounded = Rounded::default();
    for (i, position) in elements.positions.iter().enumerate().filter(|&(i, _)| is_used[i]) {
        let [x, y, z] = position.map(|x| rounded.field(x));
        writeln!(out, "GRID*   {:>16}{:16}{x:>16}{y:>16}*\n*       {z:>16}", i + 1, "")?;
    }
    let kind = |nodes: usize| match (elements.dimension, nodes) {
        (3, _) => "CTETRA",
        (_, 3) => "CTRIA3",
        (_, 4) => "CQUAD4",
        _ => "CTRIA6",
    };
    let mut number = 0;
    for (group, name) in elements.cells.iter().zip(&names.cells) {
        writeln!(out, "$HMNAME PROP {:>19}\"{name}\"", group.tag)?;
        for nodes in group.rows() {
            number += 1;
            let head = [number, group.tag as usize];
            card.write(out, kind(nodes.len()), head.into_iter().chain(nodes.iter().map(|node| node + 1)))?;
        }
    }
    for (group, name) in elements.sides.iter().zip(&names.sides) {
        writeln!(out, "$HMNAME SET {:>20}\"{name}\"", group.tag)?;
        let nodes = group.nodes();
        card.write(
            out,
            "SET1",
            std::iter::once(group.tag as usize).chain(nodes.iter().map(|node| node + 1)),
        )?;
    }
    writeln!(out, "ENDDATA")?;
    Ok(together([
        rounded.remark(),
        elements.retagged_cells(),
        elements.retagged_sides(),
        told(&names.changed),
    ]))
}

/// How integers are written.
struct Card {
    /// Follows the name of the card, and begins lines that go on.
    sign: &'static str,
    width: usize,
    /// Fields of a line.
    fields: usize,
}

impl Card {
    const OF_8_CHARACTERS: Self = Self { sign: "", width: 8, fields: 8 };
    const OF_16_CHARACTERS: Self = Self { sign: "*", width: LARGE_FIELD, fields: 4 };

    fn write(&self, out: &mut dyn Write, name: &str, numbers: impl Iterator<Item = usize>) -> io::Result<()> {
        let (width, sign) = (self.width, self.sign);
        write!(out, "{:<8}", format!("{name}{sign}"))?;
        for (k, number) in numbers.enumerate() {
            if k > 0 && k % self.fields == 0 {
                // A sign at both ends tells that the card goes on.
                let sign = if sign.is_empty() { "+" } else { sign };
                write!(out, "{sign:<8}\n{sign:<8}")?;
            }
            write!(out, "{number:>width$}")?;
        }
        writeln!(out)
    }
}

/// Counts the coordinates that 16 characters do not hold.
#[derive(Default)]
struct Rounded {
    count: usize,
    /// The largest error as a part of the coordinate.
    worst: f64,
}

impl Rounded {
    fn field(&mut self, x: f64) -> String {
        let (field, value) = field(x);
        if value != x {
            self.count += 1;
            self.worst = self.worst.max(((value - x) / x).abs());
        }
        field
    }

    fn remark(&self) -> Remark {
        let Self { count, worst } = self;
        (*count > 0).then(|| {
            format!("{count} coordinates have more digits than 16 characters hold: they are rounded, by {worst:.1e} of themselves at most")
        })
    }
}

/// A number in a large field, and its value: of the most digits, as `.ddd` with zeros or as a mantissa and an exponent without a letter.
fn field(x: f64) -> (String, f64) {
    let sign = if x < 0.0 { "-" } else { "" };
    // The shortest digits that are read as this number, or else as many as fit.
    let cut = (1..=ALL_DIGITS).rev().map(|digits| format!("{:.*e}", digits - 1, x.abs()));
    for text in std::iter::once(format!("{:e}", x.abs())).chain(cut) {
        let Some((mantissa, exponent)) = text.split_once('e') else { break };
        let Ok(exponent) = exponent.parse::<i32>() else { break };
        let mantissa: String = mantissa.chars().filter(|&c| c != '.').collect();
        let mantissa = mantissa.trim_end_matches('0');
        let shortest = layouts(mantissa, exponent).min_by_key(String::len);
        if let Some(layout) = shortest.filter(|layout| sign.len() + layout.len() <= LARGE_FIELD) {
            let value: f64 = text.parse().unwrap_or(x.abs());
            // The largest numbers are not rounded up to infinity.
            if value.is_finite() {
                return (format!("{sign}{layout}"), value.copysign(x));
            }
        }
    }
    ("0.".to_owned(), 0.0)
}

/// The ways to write digits with the first one at a power of ten.
fn layouts(digits: &str, exponent: i32) -> impl Iterator<Item = String> {
    let count = digits.len() as i32;
    // Zeros on either side of the digits.
    let plain = match exponent {
        _ if digits.is_empty() => Some("0.".to_owned()),
        0.. if exponent + 1 >= count && exponent < LARGE_FIELD as i32 => {
            Some(format!("{digits}{}.", "0".repeat((exponent + 1 - count) as usize)))
        }
        0.. if exponent + 1 < count => {
            let (whole, part) = digits.split_at((exponent + 1) as usize);
            Some(format!("{whole}.{part}"))
        }
        _ if (-(LARGE_FIELD as i32)..0).contains(&exponent) => {
            Some(format!(".{}{digits}", "0".repeat((-exponent - 1) as usize)))
        }
        _ => None,
    };
    let shifted = (0..=digits.len()).filter(|_| !digits.is_empty()).map(move |point| {
        let (whole, part) = digits.split_at(point);
        format!("{whole}.{part}{:+}", exponent + 1 - point as i32)
    });
    plain.into_iter().chain(shifted)
}

#[cfg(test)]
mod tests {
    use super::field;

    /// A field as Nastran reads it.
    fn read(text: &str) -> f64 {
        let at = text[1..].find(['+', '-']).map(|at| at + 1);
        let number = at.map_or(text.to_owned(), |at| format!("{}e{}", &text[..at], &text[at..]));
        number.parse().expect("a number")
    }

    #[test]
    fn fields_lose_as_little_as_they_can() {
        for (x, text) in [
            (0.0, "0."),
            (-0.0, "0."),
            (0.5, ".5"),
            (-1234.25, "-1234.25"),
            (1e15, ".1+16"),
            (123_456.0, "123456."),
            (0.1 + 0.2, ".3"),
            (1.0 / 3.0, ".333333333333333"),
            (-1.0 / 3.0, "-.33333333333333"),
            (5e-324, ".5-323"),
            (f64::MAX, ".179769313+309"),
        ] {
            assert_eq!(field(x).0, text, "{x:?}");
        }
        let mut x = 1.234_567_890_123_456_7;
        for exponent in -300..300 {
            x = -x;
            let y = x * 10_f64.powi(exponent);
            let (text, value) = field(y);
            assert!(text.len() <= 16 && text.contains('.'), "{text}");
            assert_eq!(read(&text), value, "{text} of {y:?}");
            let bound = match (exponent, y > 0.0) {
                (-1..15, true) => 5e-15,
                (-1..14, false) => 5e-14,
                _ => 5e-10,
            };
            assert!(((value - y) / y).abs() <= bound, "{text} of {y:?}");
        }
    }
}
