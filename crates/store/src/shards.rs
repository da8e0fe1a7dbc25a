//! The shards of a folder that is done, read by whoever checks them or makes something of them.

use std::collections::BTreeMap;
use std::io::BufReader;
use std::path::Path;

use delone::tiles::{Cuts, Node};
use delone_io::{Cloud, Format, ReadOptions, Source};

use crate::error::Error;
use crate::own;
use crate::places::place;

/// The points of a tile, with heights if it has some.
pub(crate) fn points(folder: &Path, node: Node) -> Result<Cloud, Error> {
    read(&place(folder, "points", node, "npy"), |source| {
        delone_io::read_points(source, Format::Npy, &ReadOptions::default())
    })
}

/// The indices in the input of the points of a tile: far below 2^53, so these numbers are exact.
pub(crate) fn ids(folder: &Path, node: Node) -> Result<Vec<f64>, Error> {
    read(&place(folder, "ids", node, "npy"), |source| delone_io::read_numbers(source, Format::Npy))
}

/// The rows of three numbers of a file: triangles or a seam.
pub(crate) fn triangles(path: &Path) -> Result<Vec<[u64; 3]>, Error> {
    read(path, |source| delone_io::read_triangles(source, Format::Npy))
}

/// Data of the corners of seams, by their names: each tile is asked once for its points.
pub(crate) fn corners<T: Copy>(
    path: &Path,
    cuts: &Cuts,
    seams: &[[u64; 3]],
    of_tile: impl Fn(Node) -> Result<Vec<T>, Error>,
) -> Result<BTreeMap<u64, T>, Error> {
    let mut names: Vec<u64> = seams.iter().flatten().copied().collect();
    names.sort_unstable();
    names.dedup();
    let mut corners = BTreeMap::new();
    for own in names.chunk_by(|a, b| a >> 32 == b >> 32) {
        let node = Node::new((own[0] >> 32) as u32).filter(|&node| cuts.is_tile(node));
        let known = of_tile(node.ok_or_else(|| Error::changed(path, format!("{} is of no tile", own[0])))?)?;
        for &name in own {
            let corner = known.get((name & u64::from(u32::MAX)) as usize);
            let foreign = || Error::changed(path, format!("{name} is no point of its tile"));
            corners.insert(name, *corner.ok_or_else(foreign)?);
        }
    }
    Ok(corners)
}

fn read<T>(
    path: &Path,
    content: impl Fn(Box<dyn Source>) -> Result<T, delone_io::Error>,
) -> Result<T, Error> {
    let open = || content(Box::new(BufReader::new(own::open(path)?)));
    open().map_err(|error| Error::changed(path, error))
}
