//! The files of Shewchuk's Triangle, and of TetGen: `.node`, `.ele`, `.neigh`, `.edge`. Read with indices from 0 or from 1,
//! written with the base of the points that were read. `.poly` and `.area` have a file of their own.

use std::io::{self, Write};

use delone::{Coordinates, Corners, Triangulation};

use super::lines::Lines;
use crate::middles::Middles;
use crate::{Attributes, Cloud, Error, Graph, Mesh, Source};

/// The largest number of rows that get memory before they are read: headers may claim more.
pub(super) const RESERVED_ROWS: usize = 1 << 16;

/// Points: `count dimension attributes markers`, then `index x y ...` each. A dimension of 3 (as TetGen has it)
/// or else the first attribute gives the height.
pub(crate) fn read_node(source: Box<dyn Source>) -> Result<Cloud, Error> {
    Ok(Nodes::read(&mut Lines::of_triangle(source), false)?.cloud)
}

/// Points with their attributes and markers.
pub(crate) fn read_graph(source: Box<dyn Source>) -> Result<Graph, Error> {
    Ok(Nodes::read(&mut Lines::of_triangle(source), true)?.graph())
}

/// The number that begins a file.
pub(super) fn count(lines: &mut Lines, what: &str) -> Result<usize, Error> {
    let Some(line) = lines.next()? else {
        return Err(Error::content("the file has no header line"));
    };
    line.number(line.text.split_whitespace().next(), &format!("the number of {what}"))
}

/// The points of a file.
pub(super) struct Nodes {
    pub(super) cloud: Cloud,
    pub(super) is_in_space: bool,
    attributes: Attributes,
    markers: Option<Vec<i64>>,
}

impl Nodes {
    /// Reads points, and their attributes and markers if these are wanted. As in Triangle, a marker that is missing is 0.
    pub(super) fn read(lines: &mut Lines, wants_all: bool) -> Result<Self, Error> {
        let Some(line) = lines.next()? else {
            return Err(Error::content("the file has no header line"));
        };
        let mut words = line.text.split_whitespace();
        let count: usize = line.number(words.next(), "the number of points")?;
        let dimension: usize = line.number(words.next(), "the dimension")?;
        if !(2..=3).contains(&dimension) {
            return Err(line.error(format!("the dimension is {dimension}, not 2 or 3")));
        }
        let width: usize =
            words.next().map_or(Ok(0), |word| line.number(Some(word), "the number of attributes"))?;
        let has_markers = wants_all && words.next().is_some_and(|word| word != "0");
        let is_in_space = dimension == 3;
        let with_heights = is_in_space || width > 0;
        let mut cloud = Cloud::with_capacity(count.min(RESERVED_ROWS), with_heights);
        if !is_in_space && width > 0 {
            cloud.remarks.push(format!("the first of {width} attributes was taken as height"));
        }
        let mut values = Vec::new();
        let mut markers = has_markers.then(Vec::new);
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
            let z = if with_heights { line.number(words.next(), "z")? } else { 0.0 };
            cloud.push(xy, z);
            if !wants_all {
                continue;
            }
            let first = usize::from(!is_in_space && width > 0);
            values.extend((first > 0).then_some(z));
            line.more(&mut words, width - first, &mut values)?;
            if let Some(markers) = &mut markers {
                markers.push(words.next().map_or(Ok(0), |word| line.number(Some(word), "the marker"))?);
            }
        }
        let attributes = Attributes { width: if wants_all { width } else { 0 }, values };
        Ok(Self { cloud, is_in_space, attributes, markers })
    }

    pub(super) fn graph(self) -> Graph {
        let Self { cloud, attributes, markers, .. } = self;
        Graph { cloud, attributes, point_markers: markers, ..Graph::default() }
    }
}

/// Simplices, and their attributes: `count corners attributes`, then `index a b c ...` each. The first index tells whether
/// the file counts from 0 or from 1. Attributes are passed over if they are not wanted.
pub(crate) fn read_ele<const N: usize>(
    source: Box<dyn Source>,
    wants_attributes: bool,
) -> Result<(Vec<[u64; N]>, Attributes), Error> {
    let mut lines = Lines::of_triangle(source);
    let Some(line) = lines.next()? else {
        return Err(Error::content("the file has no header line"));
    };
    let mut words = line.text.split_whitespace();
    let count: usize = line.number(words.next(), "the number of simplices")?;
    let corners: usize = line.number(words.next(), "the corners of each")?;
    if corners < N {
        return Err(line.error(format!("simplices of {corners} corners, not {N}")));
    }
    let width = match words.next().filter(|_| wants_attributes) {
        Some(word) => line.number(Some(word), "the number of attributes")?,
        None => 0,
    };
    let mut simplices = Vec::new();
    let mut values = Vec::new();
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
        let mut ends = [0; N];
        for slot in &mut ends {
            *slot = corner()?;
        }
        simplices.push(ends);
        // Points on edges, as curved elements have them, are passed over.
        let mut rest = words.skip(corners - N);
        line.more(&mut rest, width, &mut values)?;
    }
    Ok((simplices, Attributes { width, values }))
}

/// Points that are written: of so many coordinates, with rows of so many values, and with markers if there are any. What the
/// values and markers lack is 0.
pub(crate) struct NodeRows<'a, P> {
    pub(crate) base: usize,
    pub(crate) columns: usize,
    pub(crate) points: &'a [P],
    pub(crate) width: usize,
    pub(crate) values: &'a [f64],
    pub(crate) markers: Option<&'a [i64]>,
}

impl<'a, P: AsRef<[f64]>> NodeRows<'a, P> {
    /// Bare points.
    pub(crate) fn of(columns: usize, points: &'a [P]) -> Self {
        Self { base: 0, columns, points, width: 0, values: &[], markers: None }
    }

    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self { base, columns, points, width, values, markers } = *self;
        writeln!(out, "{} {columns} {width} {}", points.len(), u8::from(markers.is_some()))?;
        for (i, p) in points.iter().enumerate() {
            write!(out, "{}", base + i)?;
            let row = (i * width..(i + 1) * width).map(|k| values.get(k).unwrap_or(&0.0));
            p.as_ref().iter().chain(row).try_for_each(|x| write!(out, " {x:?}"))?;
            if let Some(markers) = markers {
                write!(out, " {}", markers.get(i).copied().unwrap_or_default())?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}

impl<'a, P: Coordinates> NodeRows<'a, P> {
    /// The points of a mesh. Heights are values where there are no attributes: where there are, the first is the height.
    pub(crate) fn of_mesh<T: Triangulation<Point = P>>(mesh: &Mesh<'a, T>) -> Self {
        let (width, values) = match (mesh.attributes.filter(|attributes| attributes.width > 0), mesh.heights)
        {
            (Some(attributes), _) => (attributes.width, &attributes.values[..]),
            (None, Some(heights)) => (1, heights),
            (None, None) => (0, &[][..]),
        };
        let (base, points, markers) = (mesh.base, mesh.points, mesh.point_markers);
        Self { base, columns: P::COUNT, points, width, values, markers }
    }
}

/// The points of a mesh, and the middles of edges if triangles have them as nodes.
pub(crate) fn write_node<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    let rows = NodeRows::of_mesh(mesh);
    if !mesh.second_order {
        return rows.write(out);
    }
    let middles = Middles::of(mesh);
    let points = middles.points(rows.points);
    let values = middles.values(rows.width, rows.values);
    let markers = rows.markers.map(|markers| middles.markers(markers));
    NodeRows { points: &points, values: &values, markers: markers.as_deref(), ..rows }.write(out)
}

/// Simplices, with the numbers of their regions; they and the points count from the base. Triangles of second order have the
/// middles of their edges after their corners.
pub(crate) fn write_ele<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    let middles = mesh.second_order.then(|| Middles::of(mesh));
    let width = if mesh.second_order { 6 } else { Mesh::<T>::WIDTH };
    writeln!(out, "{} {width} {}", mesh.simplex_count(), u8::from(mesh.regions.is_some()))?;
    let mut regions = mesh.region_values();
    for (i, s) in mesh.simplices().enumerate() {
        let corners = mesh.triangulation.corners(s);
        write!(out, "{}", mesh.base + i)?;
        corners.indices().try_for_each(|corner| write!(out, " {}", mesh.base + corner))?;
        if let Some(middles) = &middles {
            // Each is opposite to a corner, in the order of these.
            let [third, first, second] = middles.of_triangle(corners);
            [first, second, third].iter().try_for_each(|node| write!(out, " {}", mesh.base + node))?;
        }
        if let Some(region) = regions.as_mut().and_then(Iterator::next) {
            write!(out, " {region:?}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Neighbors opposite each corner, numbered as in the `.ele` file; -1 across the border.
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

/// Edges, with a marker unless it is left out: that of the constraint that the edge is, or else 1 on the border.
pub(crate) fn write_edge<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    writeln!(out, "{} {}", mesh.edges().count(), u8::from(mesh.edge_markers))?;
    for (i, (ends, marker)) in mesh.marked_edges().enumerate() {
        let [from, to] = ends.map(|v| mesh.base + v.index());
        write!(out, "{} {from} {to}", mesh.base + i)?;
        if mesh.edge_markers {
            write!(out, " {marker}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
