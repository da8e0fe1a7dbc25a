//! Reads meshes of Gmsh, as text, of versions 2 and 4.1: points, and lines, triangles or tetrahedra. Quadrilaterals are two triangles. Points are in the order of
//! their numbers, which may have gaps. Other sections are passed over, and named.

use super::groups::Groups;
use crate::error::excerpt;
use crate::formats::lines::{Line, Lines};
use crate::formats::quads::Quads;
use crate::formats::triangle::RESERVED_ROWS;
use crate::{Attributes, Cloud, Error, Graph, Source};

/// Reads the points.
pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mesh = Mesh::<2>::read(source)?;
    let mut cloud = mesh.cloud(false);
    if mesh.markers.iter().any(|&marker| marker != 0) {
        cloud.losses.push("physical groups of lines are left out".to_owned());
    }
    Ok(cloud)
}

/// Reads the points, and the lines between them as segments, which are borders; the number of the physical group is the marker.
/// Names of groups of lines are those of boundaries, names of groups of surfaces those of regions.
pub(crate) fn read_graph(source: Box<dyn Source>) -> Result<Graph, Error> {
    let mesh = Mesh::<2>::read(source)?;
    let (cloud, names) = (mesh.cloud(true), mesh.groups.names()?);
    let ends = |side: [u64; 2]| side.map(|end| end as usize);
    let segments: Vec<[usize; 2]> = mesh.simplices.unwrap_or_default().into_iter().map(ends).collect();
    let markers = mesh.markers.iter().any(|&marker| marker != 0).then_some(mesh.markers);
    Ok(Graph { is_border: vec![true; segments.len()], segments, markers, names, ..Graph::of_points(cloud) })
}

/// Whether there is a line in it.
pub(crate) fn has_lines(source: Box<dyn Source>) -> bool {
    Mesh::<2>::read(source).is_ok_and(|mesh| mesh.simplices.is_some_and(|sides| !sides.is_empty()))
}

/// Reads the triangles (N = 3) or tetrahedra (N = 4), of any order by their corners, as indices of the points. Elements of
/// fewer corners are passed over, and so are tetrahedra where triangles are wanted.
pub(crate) fn read_simplices<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    Mesh::read(source)?.simplices.ok_or_else(|| Error::content("MSH: it has no $Elements"))
}

/// How many quadrilaterals are read as two triangles.
pub(crate) fn count_quads(source: Box<dyn Source>) -> Result<usize, Error> {
    Ok(Mesh::<3>::read(source)?.quads)
}

/// Reads the physical groups of the triangles; nothing if none is in any.
pub(crate) fn read_groups(source: Box<dyn Source>) -> Result<Attributes, Error> {
    let mesh = Mesh::<3>::read(source)?;
    let is_known = mesh.markers.iter().any(|&group| group != 0);
    let values = mesh.markers.into_iter().filter(|_| is_known).map(|group| group as f64).collect();
    Ok(Attributes { width: usize::from(is_known), values })
}

/// Nodes, and elements of N corners.
struct Mesh<const N: usize> {
    nodes: Nodes,
    /// Where there are elements.
    simplices: Option<Vec<[u64; N]>>,
    /// The physical group of each; 0 if it is in none.
    markers: Vec<i64>,
    /// Of triangles: how many quadrilaterals are two of them.
    quads: usize,
    groups: Groups,
}

impl<const N: usize> Mesh<N> {
    fn read(source: Box<dyn Source>) -> Result<Self, Error> {
        let (nodes, mut groups, mut reader) = Reader::start(source)?.nodes()?;
        let tags: Vec<u64> = nodes.iter().map(|node| node.0).collect();
        let mut rows = Rows { tags: &tags, simplices: Vec::new(), quads: Quads::default() };
        let mut has_elements = false;
        while let Some(section) = reader.section()? {
            if section == "Elements" && !std::mem::replace(&mut has_elements, true) {
                match reader.version {
                    Version::Two => reader.listed(&mut rows)?,
                    Version::Four => reader.in_blocks(&mut rows, &groups)?,
                }
                reader.end("Elements")?;
            } else {
                groups.read(section, &mut reader)?;
            }
        }
        let place = |i: u64| [0, 1].map(|k| nodes[i as usize].1[k]);
        let all = rows.quads.among("MSH", rows.simplices, place)?;
        let quads = rows.quads.len();
        let (simplices, markers) = all.into_iter().unzip();
        Ok(Self { simplices: has_elements.then_some(simplices), markers, quads, nodes, groups })
    }

    fn cloud(&self, takes_names: bool) -> Cloud {
        let mut cloud = Cloud::with_capacity(self.nodes.len(), true);
        self.nodes.iter().for_each(|&(_, [x, y, z])| cloud.push([x, y], z));
        cloud.losses = self.groups.losses(takes_names);
        cloud
    }
}

#[derive(Clone, Copy)]
enum Version {
    Two,
    Four,
}

/// Numbers and coordinates of nodes, by increasing number.
type Nodes = Vec<(u64, [f64; 3])>;

pub(super) struct Reader {
    lines: Lines,
    version: Version,
}

impl Reader {
    /// Reads the section that begins a file.
    fn start(source: Box<dyn Source>) -> Result<Self, Error> {
        let mut reader = Self { lines: Lines::new(source), version: Version::Four };
        loop {
            match reader.section()?.as_deref() {
                Some("MeshFormat") => break,
                Some("Comments") => reader.pass("Comments")?,
                _ => return Err(Error::content("MSH: it does not begin with $MeshFormat")),
            }
        }
        let line = reader.line("in $MeshFormat")?;
        let mut words = line.text.split_whitespace();
        let version = words.next().unwrap_or_default();
        if line.number::<u32>(words.next(), "the type of the file")? != 0 {
            return Err(line.error("a binary file: save it as text (ASCII)"));
        }
        reader.version = match version.split_once('.').unwrap_or((version, "")) {
            ("2", _) => Version::Two,
            ("4", "1") => Version::Four,
            _ => {
                let version = excerpt(version);
                return Err(line.error(format!("version {version:?} is not read: save it as 4.1 or as 2.2")));
            }
        };
        reader.end("MeshFormat")?;
        Ok(reader)
    }

    pub(super) fn line(&mut self, place: &str) -> Result<Line<'_>, Error> {
        self.lines.next()?.ok_or_else(|| Error::Truncated(place.to_owned()))
    }

    /// The name of the section that begins here; nothing at the end of the file.
    fn section(&mut self) -> Result<Option<String>, Error> {
        let Some(line) = self.lines.next()? else { return Ok(None) };
        match line.text.strip_prefix('$') {
            Some(name) if !name.starts_with("End") => Ok(Some(name.to_owned())),
            _ => Err(line.error(format!("{:?} where a section begins", excerpt(line.text)))),
        }
    }

    /// Passes over the rest of a section.
    pub(super) fn pass(&mut self, section: &str) -> Result<(), Error> {
        loop {
            let line = self.line(&format!("in ${}", excerpt(section)))?;
            if line.text.strip_prefix("$End") == Some(section) {
                return Ok(());
            }
        }
    }

    pub(super) fn end(&mut self, section: &str) -> Result<(), Error> {
        let line = self.line(&format!("in ${section}"))?;
        if line.text.strip_prefix("$End") == Some(section) {
            return Ok(());
        }
        Err(line.error(format!("{:?} where ${section} ends by its counts", excerpt(line.text))))
    }

    /// Reads the nodes and the groups before them, and returns what follows.
    fn nodes(mut self) -> Result<(Nodes, Groups, Self), Error> {
        let mut groups = Groups::default();
        while let Some(section) = self.section()? {
            match &section[..] {
                "Nodes" => {
                    let mut nodes = match self.version {
                        Version::Two => self.listed_nodes()?,
                        Version::Four => self.nodes_in_blocks()?,
                    };
                    self.end("Nodes")?;
                    nodes.sort_by_key(|node| node.0);
                    if let Some(pair) = nodes.windows(2).find(|pair| pair[0].0 == pair[1].0) {
                        return Err(Error::content(format!("MSH: node {} is there twice", pair[0].0)));
                    }
                    return Ok((nodes, groups, self));
                }
                "Elements" => return Err(Error::content("MSH: $Elements is before $Nodes")),
                _ => groups.read(section, &mut self)?,
            }
        }
        Err(Error::content("MSH: it has no $Nodes"))
    }

    /// Version 2: `count`, then `number x y z` each.
    fn listed_nodes(&mut self) -> Result<Nodes, Error> {
        let line = self.line("in $Nodes")?;
        let count: usize = line.number(line.text.split_whitespace().next(), "the number of nodes")?;
        let mut nodes = Vec::with_capacity(count.min(RESERVED_ROWS));
        for i in 0..count {
            let line = self.line_of("nodes", i, count)?;
            let mut words = line.text.split_whitespace();
            let tag = line.number(words.next(), "the number of the node")?;
            nodes.push((tag, position(&line, words)?));
        }
        Ok(nodes)
    }

    /// Version 4.1: `blocks count least most`, then for each block `dimension entity parametric count`, the numbers in a line
    /// each, and `x y z` each.
    fn nodes_in_blocks(&mut self) -> Result<Nodes, Error> {
        let (blocks, count) = self.heading("nodes")?;
        let mut nodes = Vec::with_capacity(count.min(RESERVED_ROWS));
        for _ in 0..blocks {
            let line = self.line("in $Nodes")?;
            let more: usize = line.number(line.text.split_whitespace().nth(3), "the nodes of the block")?;
            let start = nodes.len();
            if more > count - start {
                return Err(line.error(format!("{more} nodes after {start} of {count}")));
            }
            for i in start..start + more {
                let line = self.line_of("nodes", i, count)?;
                let tag = line.number(Some(line.text), "the number of the node")?;
                nodes.push((tag, [0.0; 3]));
            }
            for (i, node) in nodes.iter_mut().enumerate().skip(start) {
                let line = self.line_of("nodes", i, count)?;
                node.1 = position(&line, line.text.split_whitespace())?;
            }
        }
        if nodes.len() < count {
            return Err(Error::content(format!("MSH: {} nodes in all blocks, not {count}", nodes.len())));
        }
        Ok(nodes)
    }

    /// Version 2: `count`, then `number kind tags tag ... node ...` each.
    fn listed<const N: usize>(&mut self, rows: &mut Rows<N>) -> Result<(), Error> {
        let line = self.line("in $Elements")?;
        let count: usize = line.number(line.text.split_whitespace().next(), "the number of elements")?;
        for i in 0..count {
            let line = self.line_of("elements", i, count)?;
            let mut words = line.text.split_whitespace().skip(1);
            let kind = line.number(words.next(), "the kind of the element")?;
            let tags: usize = line.number(words.next(), "the number of tags")?;
            let wanted = wanted::<N>(&line, kind)?;
            if wanted != Wanted::Nothing {
                let group =
                    if tags > 0 { line.number(words.clone().next(), "the physical group")? } else { 0 };
                rows.push(&line, words.skip(tags), wanted, group)?;
            }
        }
        Ok(())
    }

    /// Version 4.1: `blocks count least most`, then for each block `dimension entity kind count` and `number node ...` each.
    fn in_blocks<const N: usize>(&mut self, rows: &mut Rows<N>, groups: &Groups) -> Result<(), Error> {
        let (blocks, count) = self.heading("elements")?;
        let mut done = 0;
        for _ in 0..blocks {
            let line = self.line("in $Elements")?;
            let mut words = line.text.split_whitespace().skip(1);
            let entity = line.number(words.next(), "the entity of the elements")?;
            let kind = line.number(words.next(), "the kind of the elements")?;
            let more: usize = line.number(words.next(), "the elements of the block")?;
            if more > count - done {
                return Err(line.error(format!("{more} elements after {done} of {count}")));
            }
            let wanted = wanted::<N>(&line, kind)?;
            let group = groups.of(N - 1, entity);
            for i in done..done + more {
                let line = self.line_of("elements", i, count)?;
                if wanted != Wanted::Nothing {
                    rows.push(&line, line.text.split_whitespace().skip(1), wanted, group)?;
                }
            }
            done += more;
        }
        if done < count {
            return Err(Error::content(format!("MSH: {done} elements in all blocks, not {count}")));
        }
        Ok(())
    }

    /// The number of blocks of a section, and of things in all of them.
    fn heading(&mut self, what: &str) -> Result<(usize, usize), Error> {
        let line = self.line(&format!("before the number of {what}"))?;
        let mut words = line.text.split_whitespace();
        let blocks = line.number(words.next(), "the number of blocks")?;
        Ok((blocks, line.number(words.next(), &format!("the number of {what}"))?))
    }

    /// A line with what follows a number sign, which a name may have.
    pub(super) fn whole_line_of(&mut self, what: &str, i: usize, count: usize) -> Result<Line<'_>, Error> {
        self.lines.next_whole()?.ok_or_else(|| Error::Truncated(format!("after {i} of {count} {what}")))
    }

    pub(super) fn line_of(&mut self, what: &str, i: usize, count: usize) -> Result<Line<'_>, Error> {
        self.lines.next()?.ok_or_else(|| Error::Truncated(format!("after {i} of {count} {what}")))
    }
}

/// Coordinates; what follows them are parameters on an entity.
fn position<'a>(line: &Line, mut words: impl Iterator<Item = &'a str>) -> Result<[f64; 3], Error> {
    let mut position = [0.0; 3];
    for (slot, axis) in position.iter_mut().zip(["x", "y", "z"]) {
        *slot = line.number(words.next(), axis)?;
    }
    Ok(position)
}

/// The part of an element that is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Nothing,
    Simplex,
    Quad,
}

/// The part of elements of a kind that is read where N corners are wanted; an error if they are neither simplices nor quadrilaterals.
fn wanted<const N: usize>(line: &Line, kind: u32) -> Result<Wanted, Error> {
    let corners = match kind {
        15 => 1,
        1 | 8 | 26..=28 => 2,
        2 | 9 | 20..=25 => 3,
        4 | 11 | 29..=31 => 4,
        3 | 10 | 16 if N == 3 => return Ok(Wanted::Quad),
        3 | 10 | 16 => 0,
        // No corner of a line, whatever it is.
        _ if N == 2 => 0,
        _ => {
            return Err(
                line.error(format!("elements of kind {kind} are no triangles, quadrilaterals or tetrahedra"))
            );
        }
    };
    Ok(if corners == N { Wanted::Simplex } else { Wanted::Nothing })
}

/// Elements as they are read.
struct Rows<'a, const N: usize> {
    /// The numbers of the nodes, increasing.
    tags: &'a [u64],
    simplices: Vec<([u64; N], i64)>,
    quads: Quads,
}

impl<const N: usize> Rows<'_, N> {
    /// Takes the corners of an element of a group; other nodes follow them.
    fn push<'a>(
        &mut self,
        line: &Line,
        mut words: impl Iterator<Item = &'a str>,
        wanted: Wanted,
        group: i64,
    ) -> Result<(), Error> {
        let mut corners = [0; 4];
        let count = if wanted == Wanted::Quad { 4 } else { N };
        for slot in &mut corners[..count] {
            let tag: u64 = line.number(words.next(), "a corner")?;
            let index =
                self.tags.binary_search(&tag).map_err(|_| line.error(format!("there is no node {tag}")))?;
            *slot = index as u64;
        }
        match wanted {
            Wanted::Quad => self.quads.push(self.simplices.len(), corners, group),
            _ => self.simplices.push((std::array::from_fn(|k| corners[k]), group)),
        }
        Ok(())
    }
}
