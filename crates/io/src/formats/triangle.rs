//! The files of Shewchuk's Triangle, and of TetGen: `.node`, `.ele`, `.neigh`, `.edge`. Read with indices from 0 or from 1,
//! written with the base of the points that were read.

use std::io::{self, Write};

use delone::Triangulation;

use super::lines::Lines;
use crate::{Cloud, Error, Mesh, Source};

/// Points there is room for before they are read: what a header claims is not believed beyond.
const AHEAD: usize = 1 << 16;

/// Points: `count dimension attributes markers`, then `index x y ...` each. A dimension of 3 (as TetGen has it)
/// or else the first attribute gives the height.
pub(crate) fn read_node(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let Some(line) = lines.next()? else {
        return Err(Error::content("the file has no header line"));
    };
    let mut words = line.text.split_whitespace();
    let count: usize = line.number(words.next(), "the number of points")?;
    let dimension: usize = line.number(words.next(), "the dimension")?;
    if !(2..=3).contains(&dimension) {
        return Err(line.error(format!("the dimension is {dimension}, not 2 or 3")));
    }
    let attributes: usize =
        words.next().map_or(Ok(0), |word| line.number(Some(word), "the number of attributes"))?;
    let with_heights = dimension == 3 || attributes > 0;
    let mut cloud = Cloud::with_capacity(count.min(AHEAD), with_heights);
    if dimension == 2 && attributes > 0 {
        cloud.remarks.push(format!("the first of {attributes} attributes was taken as height"));
    }
    for i in 0..count {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {count} points")));
        };
        let mut words = line.text.split_whitespace();
        let index: usize = line.number(words.next(), "the index")?;
        if i == 0 {
            cloud.base = index.min(1);
        }
        if index != cloud.base + i {
            return Err(line.error(format!("the index is {index} where {} follows", cloud.base + i)));
        }
        let xy = [line.number(words.next(), "x")?, line.number(words.next(), "y")?];
        cloud.push(xy, if with_heights { line.number(words.next(), "z")? } else { 0.0 });
    }
    Ok(cloud)
}

/// Triangles: `count corners attributes`, then `index a b c ...` each. The first index tells whether the file
/// counts from 0 or from 1.
pub(crate) fn read_ele<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    let mut lines = Lines::new(source);
    let Some(line) = lines.next()? else {
        return Err(Error::content("the file has no header line"));
    };
    let mut words = line.text.split_whitespace();
    let count: usize = line.number(words.next(), "the number of simplices")?;
    let corners: usize = line.number(words.next(), "the corners of each")?;
    if corners < N {
        return Err(line.error(format!("simplices of {corners} corners, not {N}")));
    }
    let mut triangles = Vec::new();
    let mut base = 0;
    for i in 0..count {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {count} simplices")));
        };
        let mut words = line.text.split_whitespace();
        let index: u64 = line.number(words.next(), "the index")?;
        if i == 0 {
            base = index.min(1);
        }
        let mut corner = || {
            let corner: u64 = line.number(words.next(), "a corner")?;
            corner.checked_sub(base).ok_or_else(|| line.error("corner 0 in a file that counts from 1"))
        };
        let mut corners = [0; N];
        for slot in &mut corners {
            *slot = corner()?;
        }
        triangles.push(corners);
    }
    Ok(triangles)
}

/// Writes points of `columns` coordinates, and their heights if they have some besides; they count from `base`.
pub(crate) fn write_node<P: AsRef<[f64]>>(
    out: &mut dyn Write,
    base: usize,
    columns: usize,
    points: &[P],
    heights: Option<&[f64]>,
) -> io::Result<()> {
    writeln!(out, "{} {columns} {} 0", points.len(), u8::from(heights.is_some()))?;
    for (i, p) in points.iter().enumerate() {
        write!(out, "{}", base + i)?;
        let height = heights.map(|heights| heights.get(i).unwrap_or(&0.0));
        p.as_ref().iter().chain(height).try_for_each(|x| write!(out, " {x:?}"))?;
        writeln!(out)?;
    }
    Ok(())
}

/// Simplices; they and the points count from the base.
pub(crate) fn write_ele<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    writeln!(out, "{} {} 0", mesh.simplex_count(), Mesh::<T>::WIDTH)?;
    for (i, mut corners) in mesh.rows().enumerate() {
        write!(out, "{}", mesh.base + i)?;
        corners.try_for_each(|corner| write!(out, " {}", mesh.base + corner))?;
        writeln!(out)?;
    }
    Ok(())
}

/// Neighbours opposite each corner, numbered as in the `.ele` file; -1 across the border.
pub(crate) fn write_neigh<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    let mut numbers = vec![-1_i64; mesh.triangulation.slot_count()];
    for (i, s) in mesh.simplices().enumerate() {
        numbers[mesh.triangulation.index(s)] = (mesh.base + i) as i64;
    }
    writeln!(out, "{} {}", mesh.simplex_count(), Mesh::<T>::WIDTH)?;
    for (i, s) in mesh.simplices().enumerate() {
        write!(out, "{}", mesh.base + i)?;
        for k in 0..Mesh::<T>::WIDTH {
            let next = mesh.triangulation.across(s, k);
            write!(out, " {}", next.map_or(-1, |next| numbers[mesh.triangulation.index(next)]))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Edges with a marker that is 1 on the border.
pub(crate) fn write_edge<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    writeln!(out, "{} 1", mesh.edges().count())?;
    for (i, (ends, is_border)) in mesh.edges().enumerate() {
        let [from, to] = ends.map(|v| mesh.base + v.index());
        writeln!(out, "{} {from} {to} {}", mesh.base + i, u8::from(is_border))?;
    }
    Ok(())
}
