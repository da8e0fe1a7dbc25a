//! The shards of a folder that is done, read by whoever checks them or makes something of them.

use std::collections::BTreeMap;
use std::io::BufReader;
use std::path::Path;

use delone::tiles::{Cuts, Node};
use delone_io::{Cloud, Format, ReadOptions, Source};

use super::manifest::place;
use super::own;
use crate::message::Failure;

const HELP: &str = "files of the folder were changed or lost: start again in another folder";

/// The failure of a file that nobody should have changed.
pub(super) fn wrong(path: &Path, what: impl std::fmt::Display) -> Failure {
    Failure::new(format!("{}: {what}", path.display()), HELP)
}

/// The points of a tile, with heights if it has some.
pub(super) fn points(folder: &Path, node: Node) -> Result<Cloud, Failure> {
    read(&place(folder, "points", node, "npy"), |source| {
        delone_io::read_points(source, Format::Npy, &ReadOptions::default())
    })
}

/// The indices in the input of the points of a tile: far below 2^53, so these numbers are exact.
pub(super) fn ids(folder: &Path, node: Node) -> Result<Vec<f64>, Failure> {
    read(&place(folder, "ids", node, "npy"), |source| delone_io::read_numbers(source, Format::Npy))
}

/// The rows of three numbers of a file: triangles or a seam.
pub(super) fn triangles(path: &Path) -> Result<Vec<[u64; 3]>, Failure> {
    read(path, |source| delone_io::read_triangles(source, Format::Npy))
}

/// Data of the corners of seams, by their names: each tile is asked once for its points.
pub(super) fn corners<T: Copy>(
    path: &Path,
    cuts: &Cuts,
    seams: &[[u64; 3]],
    of_tile: impl Fn(Node) -> Result<Vec<T>, Failure>,
) -> Result<BTreeMap<u64, T>, Failure> {
    let mut names: Vec<u64> = seams.iter().flatten().copied().collect();
    names.sort_unstable();
    names.dedup();
    let mut corners = BTreeMap::new();
    for own in names.chunk_by(|a, b| a >> 32 == b >> 32) {
        let node = Node::new((own[0] >> 32) as u32).filter(|&node| cuts.is_tile(node));
        let known = of_tile(node.ok_or_else(|| wrong(path, format!("{} is of no tile", own[0])))?)?;
        for &name in own {
            let corner = known.get((name & u64::from(u32::MAX)) as usize);
            let foreign = || wrong(path, format!("{name} is no point of its tile"));
            corners.insert(name, *corner.ok_or_else(foreign)?);
        }
    }
    Ok(corners)
}

fn read<T>(
    path: &Path,
    content: impl Fn(Box<dyn Source>) -> Result<T, delone_io::Error>,
) -> Result<T, Failure> {
    let open = || content(Box::new(BufReader::new(own::open(path)?)));
    open().map_err(|error| wrong(path, error))
}
