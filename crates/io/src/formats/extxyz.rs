//! Extended XYZ: a number of atoms, a line of `key=value` with `Lattice` and `Properties`, and a row for each atom; then the next frame.
//!
//! `Lattice` has the three axes one after the other, `pbc` tells along which it repeats (all, if it is not there), `Origin` where the box begins, and `Properties` names the columns as
//! `name:type:count`. Without it, as in plain XYZ, they are `species:S:1:pos:R:3`.
//!
//! Source: the specification of libAtoms/extxyz.

use super::atoms::Atoms;
use super::lines::{Line, Lines};
use crate::cell::UnitCell;
use crate::error::{excerpt, listed};
use crate::{Cloud, Error, ReadOptions, Source};

/// The columns where no line names them.
const PLAIN: &str = "species:S:1:pos:R:3";

/// Reads the first frame.
pub(crate) fn read(source: Box<dyn Source>, options: &ReadOptions) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let mut atoms = Atoms::new(options);
    let Some(line) = lines.next_whole()? else { return Ok(atoms.end(None, 0)) };
    let mut words = line.text.split_whitespace();
    let count: u64 = line.number(words.next(), "the number of atoms")?;
    if words.next().is_some() {
        return Err(line.error("the first line of XYZ is the number of atoms alone"));
    }
    let about = lines.next_any()?.ok_or_else(|| Error::Truncated("before the second line".to_owned()))?;
    let pairs = pairs(&about)?;
    let of = |key: &str| pairs.iter().find(|pair| pair.0.eq_ignore_ascii_case(key)).map(|pair| &pair.1[..]);
    columns(&about, of("Properties").unwrap_or(PLAIN), &mut atoms)?;
    let cell = of("Lattice").map(|text| cell(&about, text, of("pbc"), of("Origin"))).transpose()?;
    // Without a box there is nothing that begins.
    let known = ["lattice", "properties", "pbc", "origin"];
    let known = &known[..if cell.is_some() { 4 } else { 3 }];
    let is_known = |key: &str| known.contains(&key.to_lowercase().as_str());
    let others: Vec<&str> = pairs.iter().map(|pair| &pair.0[..]).filter(|key| !is_known(key)).collect();
    let others = (!others.is_empty()).then(|| listed(others.into_iter()));
    for _ in 0..count {
        let line = lines.next_any()?.ok_or_else(|| Error::Truncated("before an atom".to_owned()))?;
        atoms.row(&line, |p| p)?;
    }
    let mut cloud = atoms.end(cell, frames(&mut lines)?);
    cloud.losses.extend(others.map(|names| format!("values of the frame are left out: {names}")));
    Ok(cloud)
}

/// How many frames follow: a last one may be broken.
fn frames(lines: &mut Lines) -> Result<usize, Error> {
    let mut frames = 0;
    while let Some(line) = lines.next_whole()? {
        frames += 1;
        let Ok(count) = line.text.trim().parse::<u64>() else { break };
        for _ in 0..=count {
            if lines.next_any()?.is_none() {
                return Ok(frames);
            }
        }
    }
    Ok(frames)
}

/// The keys of a line with their values, which may be in quotes, brackets or braces; words without a value are remarks.
fn pairs(line: &Line) -> Result<Vec<(String, String)>, Error> {
    const CLOSED: [(char, char); 4] = [('"', '"'), ('\'', '\''), ('{', '}'), ('[', ']')];
    let mut pairs = Vec::new();
    let mut rest = line.text.trim();
    while let Some(end) = rest.find(|c: char| c == '=' || c.is_whitespace()) {
        let (key, behind) = rest.split_at(end);
        let Some(value) = behind.trim_start().strip_prefix('=') else {
            rest = behind.trim_start();
            continue;
        };
        let value = value.trim_start();
        let closing = CLOSED.iter().find(|pair| value.starts_with(pair.0)).map(|pair| pair.1);
        let (value, behind) = match closing {
            Some(closing) => value[1..]
                .split_once(closing)
                .ok_or_else(|| line.error(format!("the value of {:?} is not closed", excerpt(key))))?,
            None => value.split_once(char::is_whitespace).unwrap_or((value, "")),
        };
        pairs.push((key.to_owned(), value.to_owned()));
        rest = behind.trim_start();
    }
    Ok(pairs)
}

/// Names the columns.
fn columns(line: &Line, properties: &str, atoms: &mut Atoms) -> Result<(), Error> {
    /// More columns of one name are no property of an atom.
    const MOST_COLUMNS: usize = 1000;
    let wrong = || line.error(format!("Properties are name:type:count, not {:?}", excerpt(properties)));
    let parts: Vec<&str> = properties.split(':').collect();
    let mut has_places = false;
    for part in parts.chunks(3) {
        let &[name, kind, count] = part else { return Err(wrong()) };
        let count: usize =
            count.trim().parse().ok().filter(|&n| (1..=MOST_COLUMNS).contains(&n)).ok_or_else(wrong)?;
        if !["S", "R", "I", "L"].contains(&kind) {
            return Err(wrong());
        }
        if ["pos", "positions"].contains(&name) && !has_places {
            if count != 3 {
                return Err(line.error(format!("{name} has {count} columns, not 3")));
            }
            has_places = true;
            (0..3).for_each(|axis| atoms.axis(axis));
        } else if count == 1 {
            atoms.attribute(name, kind == "L");
        } else {
            (1..=count).for_each(|k| atoms.attribute(&format!("{name}_{k}"), kind == "L"));
        }
    }
    if has_places { Ok(()) } else { Err(line.error("Properties name no pos")) }
}

/// The box, by its lattice, along which axes that repeats, and where it begins.
fn cell(line: &Line, lattice: &str, pbc: Option<&str>, origin: Option<&str>) -> Result<UnitCell, Error> {
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| c.is_whitespace() || ",[]".contains(c))
            .filter(|w| !w.is_empty())
            .map(str::to_owned)
            .collect()
    };
    let numbers = words(lattice);
    if numbers.len() != 9 {
        return Err(line.error(format!("a Lattice has 9 numbers, not {}", numbers.len())));
    }
    let mut axes = [[0.0; 3]; 3];
    for (number, word) in axes.as_flattened_mut().iter_mut().zip(&numbers) {
        *number = line.number(Some(word), "a number of the Lattice")?;
    }
    let mut periodic = [true; 3];
    if let Some(pbc) = pbc {
        let flags = words(pbc);
        if flags.len() != 3 {
            return Err(line.error("pbc has three flags, T or F"));
        }
        for (along, flag) in periodic.iter_mut().zip(&flags) {
            *along = match flag.to_lowercase().as_str() {
                "t" | "true" | "1" => true,
                "f" | "false" | "0" => false,
                _ => return Err(line.error("pbc has three flags, T or F")),
            };
        }
    }
    let mut begins = [0.0; 3];
    if let Some(origin) = origin {
        let numbers = words(origin);
        if numbers.len() != 3 {
            return Err(line.error(format!("an Origin has 3 numbers, not {}", numbers.len())));
        }
        for (number, word) in begins.iter_mut().zip(&numbers) {
            *number = line.number(Some(word), "a number of the Origin")?;
        }
    }
    Ok(UnitCell { axes, periodic, origin: begins })
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::read;
    use crate::{Cloud, ReadOptions, Value};

    const FRAME: &str = "2\nLattice=\"5 0 0 1 4 0 0 0 3\" Properties=species:S:1:pos:R:3:radius:R:1:force:R:2:fixed:L:1 energy=-1.5 pbc=\"T F T\"\nSi 0.5 1 2 0.25 0 1 T\nO 5 4 3 0.5 2 3 F\n";

    fn of(text: &str) -> Result<Cloud, String> {
        let options = ReadOptions::default().attributes(true);
        read(Box::new(Cursor::new(text.to_owned())), &options).map_err(|error| error.to_string())
    }

    #[test]
    fn frames_have_a_lattice_and_properties() {
        let cloud = of(&FRAME.repeat(2)).expect("frames");
        assert_eq!((cloud.xy, cloud.z), (vec![[0.5, 1.0], [5.0, 4.0]], Some(vec![2.0, 3.0])));
        let cell = cloud.cell.expect("a box");
        assert_eq!(cell.axes, [[5.0, 0.0, 0.0], [1.0, 4.0, 0.0], [0.0, 0.0, 3.0]]);
        assert_eq!((cell.periodic, cell.origin), ([true, false, true], [0.0; 3]));
        assert!(
            cloud.remarks[0].ends_with("repeats along the first and the third alone"),
            "{:?}",
            cloud.remarks
        );
        let moved = of(&FRAME.replace("energy=-1.5", "Origin=\"-1 0.5 2\"")).expect("a frame");
        assert_eq!((moved.cell.expect("a box").origin, moved.losses.len()), ([-1.0, 0.5, 2.0], 0));
        assert!(moved.remarks[0].contains(", begins at (-1.0, 0.5, 2.0) and repeats"), "{:?}", moved.remarks);
        let table = &cloud.features.table;
        assert_eq!(table.names(), ["species", "radius", "force_1", "force_2", "fixed"]);
        assert_eq!((table.value(1, 0), table.value(0, 4)), (Value::Text("O"), Value::Bool(true)));
        assert_eq!(
            cloud.losses,
            ["the first frame is read, one more is left out", "values of the frame are left out: energy"]
        );
        // Plain XYZ, with a remark or none.
        for second in ["water, made by hand", ""] {
            let cloud = of(&format!("1\n{second}\nH 1 2 3\n")).expect("a frame");
            assert_eq!((cloud.xy.len(), cloud.cell, cloud.losses.len()), (1, None, 0));
        }
        assert_eq!(of("").expect("nothing").xy.len(), 0);
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, error) in [
            (FRAME.replace("O 5 4 3 0.5 2 3 F\n", ""), "the file ends before an atom"),
            (FRAME.replace("O 5 4 3 0.5 2 3 F", "O 5 4 3"), "line 4: 4 fields where there are 8 columns"),
            (FRAME.replace("O 5 4", "O 5 up"), "line 4: y is \"up\""),
            (FRAME.replace("3 F\n", "3 x\n"), "line 4: \"x\" is neither T nor F"),
            (FRAME.replace("0 0 3\" ", "0 0\" "), "line 2: a Lattice has 9 numbers, not 8"),
            (FRAME.replace("pos:R:3", "pos:R:2"), "line 2: pos has 2 columns"),
            (FRAME.replace("pos:R:3", "place:R:3"), "line 2: Properties name no pos"),
            (FRAME.replace("species:S:1", "species:S"), "line 2: Properties are name:type:count"),
            (FRAME.replace("\"T F T\"", "\"T F\""), "line 2: pbc has three flags"),
            (FRAME.replace("energy", "Origin"), "line 2: an Origin has 3 numbers, not 1"),
            (FRAME.replace("T F T\"", "T F T"), "line 2: the value of \"pbc\" is not closed"),
            ("2 3\n".to_owned(), "line 1: the first line of XYZ"),
            ("2\n".to_owned(), "the file ends before the second line"),
        ] {
            let found = of(&text).map(|_| ());
            assert!(found.as_ref().is_err_and(|found| found.contains(error)), "{found:?}: {error}");
        }
    }
}
