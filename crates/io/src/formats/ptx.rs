//! Scans of Leica's text format (`.ptx`): one or several, each in a system of its own with a matrix that leads to the common one.
//!
//! Columns, rows, the place of the scanner, its axes, and a matrix of four rows by which points are multiplied as rows from the left; then
//! `x y z intensity` and perhaps colors for each cell of the scan. A cell at the scanner itself has no measurement.
//!
//! Source: Leica Geosystems, "PTX format". Coordinates are rounded by 8 units in the last place of the largest term at most.

use super::lines::{Line, Lines};
use crate::{Cloud, Error, Source};

/// Reads the measurements of all scans.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let mut cloud = Cloud::with_capacity(0, true);
    let mut empty = 0_usize;
    let (mut has_intensities, mut has_colors) = (false, false);
    while let Some(line) = lines.next()? {
        let columns: u64 = line.number(line.text.split_whitespace().next(), "the number of columns")?;
        let [rows] = numbers::<1>(&mut lines, "the number of rows")?;
        // The scanner and its axes are in the matrix too.
        for _ in 0..4 {
            numbers::<3>(&mut lines, "the place of the scanner")?;
        }
        let mut matrix = [[0.0; 4]; 4];
        for row in &mut matrix {
            *row = numbers(&mut lines, "the matrix of the scan")?;
        }
        let wrong = || Error::content(format!("PTX: a scan of {columns} columns and {rows} rows"));
        let cells = if rows.fract() == 0.0 { columns.checked_mul(rows as u64) } else { None };
        for _ in 0..cells.ok_or_else(wrong)? {
            let line = lines.next()?.ok_or_else(|| Error::Truncated("before a measurement".to_owned()))?;
            let p: [f64; 3] = first(&line, "a measurement")?;
            if !(has_intensities && has_colors) {
                let more = line.text.split_whitespace().count() - p.len();
                has_intensities |= more > 0;
                has_colors |= more > 1;
            }
            if p == [0.0; 3] {
                empty += 1;
                continue;
            }
            let axis =
                |k: usize| p[0] * matrix[0][k] + p[1] * matrix[1][k] + p[2] * matrix[2][k] + matrix[3][k];
            cloud.push([axis(0), axis(1)], axis(2));
        }
    }
    let values = [("intensity", has_intensities), ("color", has_colors)];
    cloud.lose_values(values.into_iter().filter(|value| value.1).map(|value| value.0));
    if empty > 0 {
        cloud.remarks.push(format!("{empty} cells without a measurement are left out"));
    }
    Ok(cloud)
}

/// The numbers at the beginning of the next line.
fn numbers<const N: usize>(lines: &mut Lines, what: &str) -> Result<[f64; N], Error> {
    first(&lines.next()?.ok_or_else(|| Error::Truncated(format!("before {what}")))?, what)
}

/// The numbers at the beginning of a line.
fn first<const N: usize>(line: &Line, what: &str) -> Result<[f64; N], Error> {
    let mut words = line.text.split_whitespace();
    let mut all = [0.0; N];
    for number in &mut all {
        *number = line.number(words.next(), what)?;
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::read;

    const SCAN: &str =
        "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n1 2 3 0.5\n0 0 0 0.5\n";

    #[test]
    fn scans_are_turned_and_moved() {
        let of = |text: String| read(Box::new(Cursor::new(text)));
        let cloud =
            of(format!("{SCAN}{}", SCAN.replace("1 2 3 0.5", "4 5 6 0.1 255 0 0"))).expect("two scans");
        assert_eq!(cloud.xy, [[8.0, 21.0], [5.0, 24.0]]);
        assert_eq!(cloud.z, Some(vec![33.0, 36.0]));
        assert_eq!(cloud.remarks, ["2 cells without a measurement are left out"]);
        assert_eq!(cloud.losses, ["values of points are left out: intensity, color"]);
        for (text, error) in [
            (SCAN.replace("0 0 0 0.5\n", ""), "the file ends before a measurement"),
            (SCAN.replace("2\n1\n", "2\nx\n"), "line 2: the number of rows"),
            (SCAN.replace("2\n1\n", "2\n0.5\n"), "PTX: a scan of 2 columns and 0.5 rows"),
            (SCAN.replace("1 2 3 0.5", "1 2 up 0.5"), "line 11: a measurement is \"up\""),
        ] {
            let found = of(text).map(|_| ()).map_err(|error| error.to_string());
            assert!(found.as_ref().is_err_and(|found| found.contains(error)), "{found:?}");
        }
        assert_eq!(of(String::new()).expect("nothing").xy.len(), 0);
    }
}
