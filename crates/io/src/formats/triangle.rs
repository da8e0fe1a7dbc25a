//! The files of Shewchuk's Triangle: `.node`, `.ele`, `.neigh`, `.edge`. Read with indices from 0 or from 1,
//! written with the base of the points that were read.

use std::io::{self, Write};

use delone::TriangleId;

use super::lines::Lines;
use crate::{Cloud, Error, Shape, Source, Surface};

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

pub(crate) fn write_node(out: &mut dyn Write, surface: &Surface) -> io::Result<()> {
    let attributes = usize::from(surface.heights.is_some());
    writeln!(out, "{} 2 {attributes} 0", surface.triangulation.points().len())?;
    for (i, [x, y, z]) in surface.positions().enumerate() {
        write!(out, "{} {x:?} {y:?}", surface.base + i)?;
        if attributes == 1 {
            write!(out, " {z:?}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

pub(crate) fn write_points<const D: usize>(
    out: &mut dyn Write,
    base: usize,
    points: &[[f64; D]],
) -> io::Result<()> {
    writeln!(out, "{} {D} 0 0", points.len())?;
    for (i, p) in points.iter().enumerate() {
        write!(out, "{}", base + i)?;
        p.iter().try_for_each(|x| write!(out, " {x:?}"))?;
        writeln!(out)?;
    }
    Ok(())
}

/// Writes simplices of N corners; they and the points count from `base`.
pub(crate) fn write_ele<const N: usize>(
    out: &mut dyn Write,
    base: usize,
    simplices: impl Iterator<Item = [usize; N]>,
) -> io::Result<()> {
    let simplices: Vec<[usize; N]> = simplices.collect();
    writeln!(out, "{} {N} 0", simplices.len())?;
    for (i, corners) in simplices.iter().enumerate() {
        write!(out, "{}", base + i)?;
        corners.iter().try_for_each(|corner| write!(out, " {}", base + corner))?;
        writeln!(out)?;
    }
    Ok(())
}

/// Neighbours opposite corners 0, 1 and 2, numbered as in the `.ele` file; -1 across the border.
pub(crate) fn write_neigh(out: &mut dyn Write, surface: &Surface) -> io::Result<()> {
    let mesh = surface.triangulation.mesh();
    let mut numbers = vec![-1_i64; mesh.slot_count()];
    for (i, t) in surface.cells().enumerate() {
        numbers[t.index()] = (surface.base + i) as i64;
    }
    writeln!(out, "{} 3", surface.triangle_count())?;
    for (i, t) in surface.cells().enumerate() {
        // The neighbour opposite corner k is across the edge that leaves the next corner.
        let [across_0, across_1, across_2] = mesh.adjacent(t).map(|t: TriangleId| numbers[t.index()]);
        writeln!(out, "{} {across_1} {across_2} {across_0}", surface.base + i)?;
    }
    Ok(())
}

/// Edges with a marker that is 1 on the border.
pub(crate) fn write_edge(out: &mut dyn Write, surface: &Surface) -> io::Result<()> {
    writeln!(out, "{} 1", surface.edges().count())?;
    for (i, e) in surface.edges().enumerate() {
        let [from, to] = surface.ends(e).map(|v| surface.base + v.index());
        writeln!(out, "{} {from} {to} {}", surface.base + i, u8::from(surface.is_border(e)))?;
    }
    Ok(())
}
