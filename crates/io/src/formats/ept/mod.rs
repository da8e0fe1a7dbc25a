//! Entwine Point Tiles: `ept.json` tells of an octree, whose nodes lie in files of their own beside it.
//!
//! Source: the specification of EPT 1.1.0 (entwine.io). The hierarchy (`hierarchy.rs`) tells how many points each node has; a node is a LAZ
//! file, or records as the schema says (`records.rs`). All nodes are read, by depth and then by place along x, y and z; where a box is
//! wanted, those alone whose cubes meet it.
//!
//! Memory is for the hierarchy, for the nodes that are decoded at once, and for the points that are kept.

mod about;
mod hierarchy;
mod records;

use std::io::{Seek, SeekFrom};

use rayon::prelude::*;

use super::las::{Kept, Key, Tile, Wanted};
use super::poly::Beside;
use crate::chunks::Chunks;
use crate::{Cloud, Crs, Error, ReadOptions, Source, guard};
use about::{About, DataType, wrong};
use records::Fields;

/// The name of the file that tells of the others.
pub(crate) const NAME: &str = "ept.json";

/// Points of the nodes that are decoded at once, but for the last of them. Whoever takes chunks has little memory.
const AT_ONCE: u64 = 1 << 20;

/// And their files: systems allow some hundreds to be open.
const FILES: usize = 64;

/// Reads the points of all nodes that may be wanted.
pub(crate) fn read(
    source: Box<dyn Source>,
    options: &ReadOptions,
    beside: Option<Beside>,
    takers: &mut Chunks,
) -> Result<Cloud, Error> {
    let about = About::read(source)?;
    let open = beside.ok_or_else(|| wrong("its points are in files beside it, which are not known"))?;
    let within = options.las.within;
    let nodes = hierarchy::read(&about, within, open)?;
    let fields = if about.data == DataType::Laszip { None } else { Some(Fields::of(&about, options)?) };
    let read = |source, count| match &fields {
        None => of_laszip(source, count, options),
        Some(fields) => Ok((records::read(source, count, &about, fields)?, None)),
    };
    let mut kept = Kept::with_capacity(0, options);
    let (mut rest, mut bytes, mut crs) = (&nodes.found[..], 0_u64, about.crs.clone());
    let most = if takers.is_whole() { AT_ONCE } else { AT_ONCE / 4 };
    while !rest.is_empty() {
        let mut batch = Vec::new();
        let mut points = 0_u64;
        while let Some((&(key, count), others)) =
            rest.split_first().filter(|_| batch.is_empty() || points < most && batch.len() < FILES)
        {
            let mut source = open(&about.path(key)).map_err(|error| of_node(key, error))?;
            bytes += length(&mut source)?;
            batch.push((key, count, source));
            points = points.saturating_add(count);
            rest = others;
        }
        let decode = |(key, count, source)| {
            guard::decode("EPT", || read(source, count)).map_err(|error| of_node(key, error))
        };
        for part in batch.into_par_iter().map(decode).collect::<Vec<_>>() {
            let (part, system) = part?;
            crs = crs.or(system);
            kept.cloud.add_dimensions(&part.cloud.dimensions);
            kept.append(part);
        }
        takers.offer(&mut kept.cloud)?;
    }
    if within.is_some() {
        let (count, all) = (nodes.found.len(), nodes.seen);
        kept.cloud.remarks.push(format!("{count} of at least {all} nodes are read, with {bytes} bytes"));
    } else if nodes.points < about.points {
        let (points, told) = (nodes.points, about.points);
        kept.cloud.losses.push(format!("its nodes have {points} points, {told} are told of"));
    }
    Ok(kept.finish(crs, options))
}

/// Reads a node that is a LAZ file, and the system that it names.
fn of_laszip(
    source: Box<dyn Source>,
    count: u64,
    options: &ReadOptions,
) -> Result<(Kept, Option<Crs>), Error> {
    let tile = Tile::open(source)?;
    if tile.total != count {
        return Err(wrong(format!("it has {} points, {count} by the hierarchy", tile.total)));
    }
    let (crs, wanted) = (tile.crs(), Wanted::of(options, &tile.dimensions)?);
    Ok((tile.read(&wanted, &mut Chunks::default())?, crs))
}

/// The bytes of a source, which is read from its begin on.
fn length(source: &mut Box<dyn Source>) -> Result<u64, Error> {
    let length = source.seek(SeekFrom::End(0))?;
    source.rewind()?;
    Ok(length)
}

/// An error with the node that it is of.
fn of_node(key: Key, error: Error) -> Error {
    match error {
        Error::Content(what) => Error::Content(format!("node {key}: {what}")),
        Error::Truncated(place) => Error::Content(format!("node {key}: the file ends {place}")),
        other => other,
    }
}
