//! Columns of numbers: csv, xyz, txt, tsv; with header or without, separated by commas, semicolons, tabs or
//! blanks.
//!
//! The first line that is not all numbers is the header; its names choose the columns. Without names that say
//! x, y and z, the first two or three columns are taken. Every line must have as many fields as the first.

use std::io::{self, Write};

use super::lines::{Line, Lines};
use crate::{Cloud, Error, Source};

/// What headers call coordinates, in order of preference.
const NAMES: [&[&str]; 3] = [
    &["x", "easting", "lon", "lng", "long", "longitude"],
    &["y", "northing", "lat", "latitude"],
    &["z", "height", "elevation", "altitude"],
];

/// Reads points; `columns` are header names or numbers from 1 for x, y and perhaps z, or none to find them.
pub(crate) fn read(source: Box<dyn Source>, columns: &[String]) -> Result<Cloud, Error> {
    if !(columns.is_empty() || (2..=3).contains(&columns.len())) {
        return Err(Error::content("two or three columns are needed, x,y or x,y,z"));
    }
    let mut lines = Lines::new(source);
    let Some(first) = lines.next()? else {
        return Ok(Cloud::default());
    };
    let separator = Separator::of(first.text);
    let fields: Vec<String> =
        separator.split(first.text).map(|field| field.trim_matches('"').to_owned()).collect();
    let width = fields.len();
    let header = fields.iter().any(|field| field.parse::<f64>().is_err());
    let chosen = choose(&fields, header, columns).map_err(|what| first.error(what))?;
    let mut cloud = Cloud::with_capacity(0, chosen.len() == 3);
    if !header {
        push(&mut cloud, &first, separator, &chosen, width)?;
    }
    while let Some(line) = lines.next()? {
        push(&mut cloud, &line, separator, &chosen, width)?;
    }
    Ok(cloud)
}

fn push(
    cloud: &mut Cloud,
    line: &Line,
    separator: Separator,
    chosen: &[usize],
    width: usize,
) -> Result<(), Error> {
    let mut point = [0.0; 3];
    let mut count = 0;
    for (column, field) in separator.split(line.text).enumerate() {
        count += 1;
        if let Some(axis) = chosen.iter().position(|&c| c == column) {
            point[axis] = field
                .parse()
                .map_err(|_| line.error(format!("field {} is {field:?}, not a number", column + 1)))?;
        }
    }
    if count != width {
        return Err(line.error(format!("{count} fields where the first line has {width}")));
    }
    let [x, y, z] = point;
    cloud.push([x, y], z);
    Ok(())
}

/// The columns of x, y and perhaps z.
fn choose(fields: &[String], header: bool, columns: &[String]) -> Result<Vec<usize>, String> {
    let named = |name: &str| fields.iter().position(|field| header && field.eq_ignore_ascii_case(name));
    if !columns.is_empty() {
        let column = |name: &String| {
            let number =
                || name.parse::<usize>().ok().filter(|k| (1..=fields.len()).contains(k)).map(|k| k - 1);
            named(name).or_else(number).ok_or_else(|| format!("there is no column {name:?}"))
        };
        return columns.iter().map(column).collect();
    }
    let known = NAMES.map(|names| names.iter().find_map(|name| named(name)));
    match known {
        [Some(x), Some(y), Some(z)] => Ok(vec![x, y, z]),
        [Some(x), Some(y), None] => Ok(vec![x, y]),
        _ if fields.len() < 2 => Err("a point needs two numbers, x and y".to_owned()),
        _ => Ok((0..fields.len().min(3)).collect()),
    }
}

/// What stands between fields.
#[derive(Clone, Copy)]
enum Separator {
    Sign(char),
    Blank,
}

impl Separator {
    fn of(line: &str) -> Self {
        [',', ';', '\t'].into_iter().find(|&sign| line.contains(sign)).map_or(Self::Blank, Self::Sign)
    }

    fn split(self, line: &str) -> impl Iterator<Item = &str> {
        // One iterator type for both: blanks in a row count once, signs do not.
        line.split(move |c: char| match self {
            Self::Sign(sign) => c == sign,
            Self::Blank => c.is_whitespace(),
        })
        .map(str::trim)
        .filter(move |field| matches!(self, Self::Sign(_)) || !field.is_empty())
    }
}

pub(crate) fn write<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    writeln!(out, "{}", ["x", "y", "z"][..D].join(","))?;
    for p in points {
        for (k, x) in p.iter().enumerate() {
            write!(out, "{}{x:?}", if k > 0 { "," } else { "" })?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Writes rows of integers.
pub(crate) fn write_indices(out: &mut dyn Write, columns: usize, values: &[i64]) -> io::Result<()> {
    for row in values.chunks_exact(columns) {
        for (k, value) in row.iter().enumerate() {
            if k > 0 {
                write!(out, ",")?;
            }
            write!(out, "{value}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::read;
    use crate::Cloud;
    use std::io::Cursor;

    fn parse(text: &'static str, columns: &[&str]) -> Result<Cloud, String> {
        let columns: Vec<_> = columns.iter().map(ToString::to_string).collect();
        read(Box::new(Cursor::new(text)), &columns).map_err(|error| error.to_string())
    }

    #[test]
    fn separators_and_headers() {
        let plain = Cloud { xy: vec![[1.0, 2.0], [3.5, -4.0]], z: None };
        for text in [
            "1,2\n3.5,-4",
            "1 2\n3.5   -4\n\n",
            "x;y\n1;2\n3.5;-4\n",
            "# made by hand\n1\t2\n3.5\t-4",
            "lat,lon\n2,1\n-4,3.5",
        ] {
            assert_eq!(parse(text, &[]), Ok(plain.clone()), "{text:?}");
        }
        let high = parse("id,x,y,z\n7,1,2,3", &[]).expect("valid");
        assert_eq!((high.xy, high.z), (vec![[1.0, 2.0]], Some(vec![3.0])));
        assert_eq!(parse("a b c\n1 2 3", &["c", "1"]).expect("valid").xy, [[3.0, 1.0]]);
        assert_eq!(parse("", &[]), Ok(Cloud::default()));
        assert!(parse("nan,1", &[]).expect("the library judges").xy[0][0].is_nan());
    }

    #[test]
    fn errors_name_the_line() {
        for (text, message) in [
            ("1,2\n3", "line 2: 1 fields where the first line has 2"),
            ("1,2\n\n# comment\n3,x", "line 4: field 2 is \"x\", not a number"),
            ("1,2\n3,", "line 2: field 2 is \"\", not a number"),
            ("1\n2", "line 1: a point needs two numbers, x and y"),
        ] {
            assert_eq!(parse(text, &[]), Err(message.to_owned()), "{text:?}");
        }
        assert_eq!(parse("1,2", &["3", "1"]), Err("line 1: there is no column \"3\"".to_owned()));
    }
}
