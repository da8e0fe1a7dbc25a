//! Well-known text of geometries: the positions in it.

/// What geometries are called.
const KINDS: [&str; 7] =
    ["POINT", "MULTIPOINT", "LINESTRING", "MULTILINESTRING", "POLYGON", "MULTIPOLYGON", "GEOMETRYCOLLECTION"];

/// Whether a text begins like a geometry.
pub(super) fn is_geometry(text: &str) -> bool {
    let text = without_system(text);
    let word = text.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
    KINDS.iter().any(|kind| word.eq_ignore_ascii_case(kind))
}

fn without_system(text: &str) -> &str {
    let text = text.trim();
    match text.split_once(';') {
        Some((system, rest)) if system.to_ascii_uppercase().starts_with("SRID=") => rest.trim_start(),
        _ => text,
    }
}

/// All positions of a geometry in their order; the last of a ring, which is the first again, is left out.
pub(super) fn positions(text: &str) -> Result<Vec<Vec<f64>>, String> {
    let text = without_system(text);
    if !is_geometry(text) {
        return Err(format!("{:?} is no geometry such as POINT (1 2)", crate::error::excerpt(text)));
    }
    let closed = text.to_ascii_uppercase().contains("POLYGON");
    let mut all = Vec::new();
    for list in text.split('(').skip(1) {
        let list = list.split(')').next().unwrap_or_default();
        let position =
            |entry: &str| entry.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>();
        let mut ring = Vec::new();
        for entry in list.split(',').filter(|entry| !entry.trim().is_empty()) {
            // Between the parts of a collection there are names.
            if is_geometry(entry) {
                continue;
            }
            match position(entry) {
                Ok(numbers) if numbers.len() >= 2 => ring.push(numbers),
                _ => return Err(format!("{:?} is no position", crate::error::excerpt(entry.trim()))),
            }
        }
        if closed && ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        all.append(&mut ring);
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::{is_geometry, positions};

    #[test]
    fn geometries_of_all_kinds() {
        for (text, expected) in [
            ("POINT (1 2)", vec![vec![1.0, 2.0]]),
            ("point z(1 2 3)", vec![vec![1.0, 2.0, 3.0]]),
            ("SRID=4326;POINT(7.5 -3e1)", vec![vec![7.5, -30.0]]),
            ("MULTIPOINT ((1 2), (3 4))", vec![vec![1.0, 2.0], vec![3.0, 4.0]]),
            ("MULTIPOINT (1 2, 3 4)", vec![vec![1.0, 2.0], vec![3.0, 4.0]]),
            ("POLYGON ((0 0, 1 0, 0 1, 0 0))", vec![vec![0.0, 0.0], vec![1.0, 0.0], vec![0.0, 1.0]]),
            ("GEOMETRYCOLLECTION (POINT (1 2), POINT (3 4))", vec![vec![1.0, 2.0], vec![3.0, 4.0]]),
            ("POINT EMPTY", vec![]),
        ] {
            assert_eq!(positions(text), Ok(expected), "{text}");
        }
        for text in ["POINT (1)", "POINT (a b)", "CIRCLE (1 2)", "", "("] {
            assert!(positions(text).is_err(), "{text}");
        }
        assert!(!is_geometry("points"));
    }
}
