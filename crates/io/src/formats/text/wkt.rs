//! Well-known text of geometries: the positions in it.

use crate::error::excerpt;

/// What geometries are called.
const KINDS: [&str; 7] =
    ["POINT", "MULTIPOINT", "LINESTRING", "MULTILINESTRING", "POLYGON", "MULTIPOLYGON", "GEOMETRYCOLLECTION"];

/// No geometry has more lists in lists.
const DEEPEST: usize = 16;

/// Whether a text begins like a geometry: its kind, and a list or the word that there is none.
pub(super) fn is_geometry(text: &str) -> bool {
    Reader { rest: without_system(text) }.kind().is_some()
}

fn without_system(text: &str) -> &str {
    let text = text.trim();
    match text.split_once(';') {
        Some((system, rest)) if system.to_ascii_uppercase().starts_with("SRID=") => rest.trim_start(),
        _ => text,
    }
}

/// All positions of a geometry in their order, without measures; the last of a ring, which is the first again, is left
/// out.
pub(super) fn positions(text: &str) -> Result<Vec<Vec<f64>>, String> {
    let mut reader = Reader { rest: without_system(text) };
    let mut all = Vec::new();
    let complete = reader.geometry(&mut all, 0).is_some() && reader.rest.trim().is_empty();
    complete
        .then_some(all)
        .ok_or_else(|| format!("{:?} is no geometry such as POINT (1 2)", excerpt(text.trim())))
}

/// A kind of geometry.
#[derive(Clone, Copy)]
struct Kind {
    collects: bool,
    closed: bool,
    /// The last number of a position is a measure.
    measured: bool,
}

/// What is left of a text. A part that is not as it should be is `None`.
struct Reader<'a> {
    rest: &'a str,
}

impl Reader<'_> {
    fn word(&mut self) -> String {
        let rest = self.rest.trim_start();
        let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        self.rest = rest[end..].trim_start();
        rest[..end].to_ascii_uppercase()
    }

    fn sign(&mut self, sign: char) -> Option<()> {
        self.rest = self.rest.trim_start().strip_prefix(sign)?.trim_start();
        Some(())
    }

    fn kind(&mut self) -> Option<(Kind, bool)> {
        let word = self.word();
        let dimensions = ["ZM", "Z", "M", ""].into_iter().find_map(|end| {
            let kind = word.strip_suffix(end)?;
            KINDS.contains(&kind).then_some((kind.to_owned(), end.to_owned()))
        });
        let (kind, mut dimensions) = dimensions?;
        let mut empty = false;
        if !self.rest.starts_with('(') {
            match self.word().as_str() {
                "EMPTY" => empty = true,
                word @ ("Z" | "M" | "ZM") => {
                    word.clone_into(&mut dimensions);
                    empty = !self.rest.starts_with('(') && self.word() == "EMPTY";
                }
                _ => return None,
            }
        }
        (empty || self.rest.starts_with('(')).then_some(())?;
        let measured = dimensions.ends_with('M');
        let kind =
            Kind { collects: kind == "GEOMETRYCOLLECTION", closed: kind.ends_with("POLYGON"), measured };
        Some((kind, empty))
    }

    fn geometry(&mut self, all: &mut Vec<Vec<f64>>, depth: usize) -> Option<()> {
        let (kind, empty) = self.kind()?;
        if empty {
            return Some(());
        }
        if !kind.collects {
            return self.list(kind, all, depth);
        }
        (depth < DEEPEST).then_some(())?;
        self.sign('(')?;
        loop {
            self.geometry(all, depth + 1)?;
            if self.sign(',').is_none() {
                return self.sign(')');
            }
        }
    }

    /// Positions, or lists of them.
    fn list(&mut self, kind: Kind, all: &mut Vec<Vec<f64>>, depth: usize) -> Option<()> {
        (depth < DEEPEST).then_some(())?;
        self.sign('(')?;
        let first = all.len();
        loop {
            if self.rest.starts_with('(') {
                self.list(kind, all, depth + 1)?;
            } else {
                let end = self.rest.find([',', '(', ')'])?;
                let numbers: Vec<f64> =
                    self.rest[..end].split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
                let least = if kind.measured { 3 } else { 2 };
                (least..=4).contains(&numbers.len()).then_some(())?;
                let kept = numbers.len() - usize::from(kind.measured);
                all.push(numbers[..kept.min(3)].to_vec());
                self.rest = &self.rest[end..];
            }
            if self.sign(',').is_none() {
                break;
            }
        }
        if kind.closed && all.len() > first + 1 && all.get(first) == all.last() {
            all.pop();
        }
        self.sign(')')
    }
}

#[cfg(test)]
mod tests {
    use super::{is_geometry, positions};

    #[test]
    fn geometries_of_all_kinds() {
        for (text, expected) in [
            ("POINT (1 2)", vec![vec![1.0, 2.0]]),
            ("point z(1 2 3)", vec![vec![1.0, 2.0, 3.0]]),
            ("POINTZ (1 2 3)", vec![vec![1.0, 2.0, 3.0]]),
            ("POINT M (1 2 3)", vec![vec![1.0, 2.0]]),
            ("POINTZM(1 2 3 4)", vec![vec![1.0, 2.0, 3.0]]),
            ("SRID=4326;POINT(7.5 -3e1)", vec![vec![7.5, -30.0]]),
            ("MULTIPOINT ((1 2), (3 4))", vec![vec![1.0, 2.0], vec![3.0, 4.0]]),
            ("MULTIPOINT (1 2, 3 4)", vec![vec![1.0, 2.0], vec![3.0, 4.0]]),
            ("POLYGON ((0 0, 1 0, 0 1, 0 0))", vec![vec![0.0, 0.0], vec![1.0, 0.0], vec![0.0, 1.0]]),
            ("GEOMETRYCOLLECTION (POINT (1 2), POINT (3 4))", vec![vec![1.0, 2.0], vec![3.0, 4.0]]),
            ("POINT EMPTY", vec![]),
        ] {
            assert_eq!(positions(text), Ok(expected), "{text}");
        }
        for text in [
            "POINT (1)",
            "POINT (a b)",
            "CIRCLE (1 2)",
            "",
            "(",
            "POINT 1 2",
            "POINT ()",
            "MULTIPOINT ((((",
            "POLYGON ((0 0, 5 0, 5 5",
            "POINT (1 2))",
            "POINT(1 2 )x",
            "LINESTRING (1 2,, 3 4)",
            "POINT (1 2) POINT (3 4)",
            "GEOMETRYCOLLECTION(GEOMETRYCOLLECTION(",
        ] {
            assert!(positions(text).is_err(), "{text}");
        }
        assert!(positions(&"GEOMETRYCOLLECTION(".repeat(100_000)).is_err());
        assert!(positions(&format!("POINT {}", "(".repeat(100_000))).is_err());
        for text in ["points", "Point", "Point Number", "POINT_X", "Polygon"] {
            assert!(!is_geometry(text), "{text}");
        }
    }
}
