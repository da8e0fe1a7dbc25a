//! Dumps of LAMMPS as text: frames of atoms in a box, which may be tilted.
//!
//! `ITEM: BOX BOUNDS` tells for each axis how it ends (`pp` where it repeats), then the bounds of the box, with tilt factors those of the box around the
//! tilted one; or, for general axes, the axes themselves and an origin. `ITEM: ATOMS` names the columns. Coordinates are `x y z`, unwrapped ones
//! `xu yu zu`, or parts of the axes `xs ys zs` and `xsu ysu zsu`.
//!
//! Source: LAMMPS documentation, "dump command" and "Howto triclinic".

use super::atoms::Atoms;
use super::lines::{Line, Lines};
use crate::cell::UnitCell;
use crate::{Cloud, Error, ReadOptions, Source};

/// Reads the first frame.
pub(crate) fn read(source: Box<dyn Source>, options: &ReadOptions) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let mut atoms = Atoms::new(options);
    let (mut count, mut cell) = (None, None);
    let mut is_empty = true;
    while let Some(line) = lines.next_whole()? {
        is_empty = false;
        let Some(item) = line.text.trim_start().strip_prefix("ITEM:").map(str::trim) else {
            return Err(line.error("a line that begins with ITEM: is expected"));
        };
        if item == "NUMBER OF ATOMS" {
            let line = expect(&mut lines, "the number of atoms")?;
            count = Some(line.number::<u64>(line.text.split_whitespace().next(), "the number of atoms")?);
        } else if let Some(kind) = item.strip_prefix("BOX BOUNDS") {
            let kind = kind.trim().to_owned();
            cell = Some(read_box(&mut lines, &kind)?);
        } else if let Some(names) = item.strip_prefix("ATOMS") {
            let count = count.ok_or_else(|| line.error("the number of atoms is not told before"))?;
            let is_scaled = columns(&line, names, &mut atoms)?;
            let scale = cell.filter(|_| is_scaled);
            if is_scaled && cell.is_none() {
                return Err(line.error("coordinates are parts of a box that is not told before"));
            }
            for _ in 0..count {
                let line = expect(&mut lines, "an atom")?;
                atoms.row(&line, |p| scale.map_or(p, |cell| at(&cell, p)))?;
            }
            let mut frames = 0;
            while let Some(line) = lines.next_whole()? {
                frames += usize::from(line.text.trim_start().starts_with("ITEM: TIMESTEP"));
            }
            return Ok(atoms.end(cell, frames));
        } else {
            // The step, the time, the units: a line each.
            expect(&mut lines, "the line after ITEM:")?;
        }
    }
    if is_empty { Ok(atoms.end(None, 0)) } else { Err(Error::Truncated("before ITEM: ATOMS".to_owned())) }
}

/// Where the parts of the axes lead.
fn at(cell: &UnitCell, parts: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let along = |axis: usize| parts[axis] * cell.axes[axis][k];
        cell.origin[k] + along(0) + along(1) + along(2)
    })
}

/// The next line.
fn expect<'a>(lines: &'a mut Lines, what: &str) -> Result<Line<'a>, Error> {
    lines.next_whole()?.ok_or_else(|| Error::Truncated(format!("before {what}")))
}

/// The box, of the kind that is told in the line before.
fn read_box(lines: &mut Lines, kind: &str) -> Result<UnitCell, Error> {
    let words: Vec<&str> = kind.split_whitespace().collect();
    let is_tilted = words.starts_with(&["xy", "xz", "yz"]);
    let is_general = words.starts_with(&["abc", "origin"]);
    let ends = &words[if is_tilted { 3 } else { 2 * usize::from(is_general) }..];
    // Old dumps tell nothing: the box of LAMMPS repeats unless it is said not to.
    let periodic = std::array::from_fn(|axis| ends.get(axis).is_none_or(|end| *end == "pp"));
    let mut rows = [[0.0; 4]; 3];
    for row in &mut rows {
        let line = expect(lines, "the bounds of the box")?;
        let mut words = line.text.split_whitespace();
        let width = if is_general { 4 } else { 2 + usize::from(is_tilted) };
        for number in &mut row[..width] {
            *number = line.number(words.next(), "a bound of the box")?;
        }
    }
    let [x, y, z] = rows;
    if is_general {
        let axes = [x, y, z].map(|[a, b, c, _]| [a, b, c]);
        return Ok(UnitCell { axes, periodic, origin: [x[3], y[3], z[3]] });
    }
    let [xy, xz, yz] = [x[2], y[2], z[2]];
    // The bounds are those of the box around the tilted one.
    let least = [0.0, xy, xz, xy + xz].into_iter().fold(0.0, f64::min);
    let most = [0.0, xy, xz, xy + xz].into_iter().fold(0.0, f64::max);
    let origin = [x[0] - least, y[0] - yz.min(0.0), z[0]];
    let sides = [x[1] - most - origin[0], y[1] - yz.max(0.0) - origin[1], z[1] - origin[2]];
    let axes = [[sides[0], 0.0, 0.0], [xy, sides[1], 0.0], [xz, yz, sides[2]]];
    Ok(UnitCell { axes, periodic, origin })
}

/// Names the columns; says whether coordinates are parts of the box.
fn columns(line: &Line, names: &str, atoms: &mut Atoms) -> Result<bool, Error> {
    const KINDS: [([&str; 3], bool); 4] = [
        (["x", "y", "z"], false),
        (["xu", "yu", "zu"], false),
        (["xs", "ys", "zs"], true),
        (["xsu", "ysu", "zsu"], true),
    ];
    let names: Vec<&str> = names.split_whitespace().collect();
    let Some((axes, is_scaled)) = KINDS.iter().find(|kind| kind.0.iter().all(|axis| names.contains(axis)))
    else {
        return Err(line.error("there are no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu"));
    };
    let mut found = [false; 3];
    for name in names {
        match axes.iter().position(|axis| *axis == name).filter(|&axis| !found[axis]) {
            Some(axis) => {
                found[axis] = true;
                atoms.axis(axis);
            }
            None => atoms.attribute(name, false),
        }
    }
    Ok(*is_scaled)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::read;
    use crate::{Cloud, ReadOptions, Value};

    const DUMP: &str = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp ff\n-1 7 2\n0 5 -1\n0 4 0.5\nITEM: ATOMS id type x y z radius\n7 1 0.5 1 2 0.25\n3 2 5 4 3 0.5\n";

    fn of(text: &str) -> Result<Cloud, String> {
        let options = ReadOptions::default().attributes(true);
        read(Box::new(Cursor::new(text.to_owned())), &options).map_err(|error| error.to_string())
    }

    #[test]
    fn tilted_boxes_are_inside_of_their_bounds() {
        let cloud = of(&DUMP.repeat(3)).expect("a dump");
        assert_eq!((cloud.xy, cloud.z), (vec![[0.5, 1.0], [5.0, 4.0]], Some(vec![2.0, 3.0])));
        let cell = cloud.cell.expect("a box");
        // From -1 - min(0, 2, -1, 1) to 7 - max(0, 2, -1, 1); and up to 5 - 0.5.
        assert_eq!(cell.axes, [[5.0, 0.0, 0.0], [2.0, 4.5, 0.0], [-1.0, 0.5, 4.0]]);
        assert_eq!((cell.periodic, cell.origin), ([true, true, false], [0.0; 3]));
        assert_eq!(cloud.features.table.names(), ["id", "type", "radius"]);
        assert_eq!(cloud.features.table.value(1, 2), Value::Number(0.5));
        assert_eq!(cloud.losses, ["the first frame is read, 2 more are left out"]);
        assert!(
            cloud.remarks[0].ends_with("repeats along the first and the second alone"),
            "{:?}",
            cloud.remarks
        );
    }

    #[test]
    fn parts_of_the_box_are_places() {
        let cloud = of(&DUMP.replace(" x y z ", " xs ys zs ").replace("0.5 1 2 0.25", "0.5 1 0.5 0.25"));
        // The origin is at 0, 0, 0.
        assert_eq!(cloud.expect("a dump").xy[0], [0.5 * 5.0 + 2.0 - 0.5, 4.5 + 0.25]);
        let general = DUMP.replace(
            "xy xz yz pp pp ff\n-1 7 2\n0 5 -1\n0 4 0.5",
            "abc origin pp pp pp\n1 2 3 9\n0 1 0 8\n0 0 1 7",
        );
        let cloud = of(&general.replace(" x y z ", " xsu ysu zsu ")).expect("a dump");
        assert_eq!((cloud.xy[0], cloud.z), ([9.5, 10.0], Some(vec![10.5, 25.0])));
        assert_eq!(cloud.cell.expect("a box").origin, [9.0, 8.0, 7.0]);
        let plain = DUMP.replace("xy xz yz pp pp ff\n-1 7 2\n0 5 -1\n0 4 0.5", "\n-1 7\n0 5\n0 4");
        let cell = of(&plain).expect("an old dump").cell.expect("a box");
        assert_eq!(
            (cell.axes, cell.periodic, cell.origin),
            ([[8.0, 0.0, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, 4.0]], [true; 3], [-1.0, 0.0, 0.0])
        );
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, error) in [
            (DUMP.replace("3 2 5 4 3 0.5\n", ""), "the file ends before an atom"),
            (DUMP.replace("3 2 5 4 3 0.5", "3 2 5 4 3"), "line 11: 5 fields where there are 6 columns"),
            (DUMP.replace("5 4 3 0.5", "5 up 3 0.5"), "line 11: y is \"up\""),
            (DUMP.replace(" x y z", " a b c"), "line 9: there are no columns x y z"),
            (DUMP.replace("-1 7 2", "-1 7"), "line 6: a bound of the box is missing"),
            (DUMP.replace("ITEM: NUMBER OF ATOMS\n2\n", ""), "line 7: the number of atoms is not told"),
            (DUMP.replace("OF ATOMS\n2", "OF ATOMS\n-2"), "line 4: the number of atoms is \"-2\""),
            ("x y z\n".to_owned(), "line 1: a line that begins with ITEM:"),
            ("ITEM: TIMESTEP\n0\n".to_owned(), "the file ends before ITEM: ATOMS"),
        ] {
            let found = of(&text).map(|_| ());
            assert!(found.as_ref().is_err_and(|found| found.contains(error)), "{found:?}: {error}");
        }
        assert_eq!(of("").expect("nothing").xy.len(), 0);
    }
}
