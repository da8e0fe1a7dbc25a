//! Readers of files: mutations of good files and of those that broke readers once. A reader may refuse what it cannot read,
//! in a sentence; it may not panic, hang, or take memory that the file does not justify.

mod corpus;
mod maps;
mod mutation;

use std::fs;
use std::io::Cursor;

use delone_generators::Random;
use delone_io::{Beside, Cloud, Format, Graph, LasFilter, ReadOptions, Source, decompressed};

pub(crate) use self::mutation::{Mutation, some};
use crate::attack::{Attack, Judgement};

/// Groups of formats that are attacked together.
pub(crate) const TEXT: usize = 0;
pub(crate) const JSON: usize = 1;
pub(crate) const ARRAYS: usize = 2;
pub(crate) const LAS: usize = 3;
pub(crate) const PLY: usize = 4;
pub(crate) const MESHES: usize = 5;
pub(crate) const E57: usize = 6;
pub(crate) const MAPS: usize = 7;
/// How many there are.
pub(crate) const GROUPS: usize = 8;

/// Memory that a reader may take: for its buffers and threads, and for each byte of the file.
const ROOM: u64 = 256 << 20;
const ROOM_A_BYTE: u64 = 100;

/// The separator between the files of a seed of several.
pub(super) const PART: &[u8] = b"\n--\n";

/// No message is longer: users read them.
const LONGEST_MESSAGE: usize = 600;

/// The readers of a group.
pub(crate) struct Files<const GROUP: usize>;

impl<const GROUP: usize> Attack for Files<GROUP> {
    type Item = Mutation;

    fn make(random: &mut Random) -> Vec<Mutation> {
        some(random)
    }

    fn judge(mutations: &[Mutation], seed: u64) -> Judgement {
        let (format, bytes) = mutated(GROUP, mutations, seed);
        let room = ROOM + ROOM_A_BYTE * bytes.len() as u64;
        within(room, || read(format, &bytes)).map_err(|what| format!("{format}: {what}"))
    }
}

/// A file of a group, changed.
pub(crate) fn mutated(group: usize, mutations: &[Mutation], seed: u64) -> (Format, Vec<u8>) {
    let seeds = corpus::of(group);
    let (format, mut bytes) = seeds[Random::new(seed).below(seeds.len())].clone();
    let others = seeds.iter().map(|(_, other)| other.as_slice()).collect::<Vec<_>>();
    mutations.iter().for_each(|mutation| mutation.apply(&mut bytes, &others));
    (format, bytes)
}

/// Reads a file in all ways that its format has.
fn read(format: Format, bytes: &[u8]) -> Judgement {
    let own = if format == Format::Ept { part_of(bytes, 0) } else { bytes };
    let source = || decompressed(Box::new(Cursor::new(own.to_vec())) as Box<dyn Source>, format);
    let options = |dimension, classes| {
        ReadOptions::default()
            .dimension(dimension)
            .las(LasFilter::default().classes(classes))
            .attributes(dimension == 2)
    };
    // What a file has beside it may be as broken as the file.
    let mut beside = |name: &str| {
        let part = |bytes: &[u8]| Ok(Box::new(Cursor::new(bytes.to_vec())) as Box<dyn Source>);
        match name.split('/').next() {
            Some("dbf") => part(table_of(bytes)),
            Some("ept-hierarchy") => part(part_of(bytes, 1)),
            Some("ept-data") => part(part_of(bytes, 2)),
            _ => source(),
        }
    };
    let mut ways = vec![options(2, vec![]), options(3, vec![2])];
    if matches!(format, Format::Las | Format::Ept) {
        let within = Some([0.0, 0.0, 1060.0, 2060.0]);
        ways.push(
            options(2, vec![])
                .las(LasFilter::default().within(within).withheld(true))
                .columns(["x", "y", "Reflectance"])
                .dimensions(["intensity", "Pulse", "Normal[1]"]),
        );
    }
    let mut said = Vec::new();
    for options in ways {
        let whole =
            source().and_then(|source| delone_io::read_points_beside(source, format, &options, &mut beside));
        in_chunks(source(), format, &options, &whole, &mut beside)?;
        match whole {
            Ok(cloud) if cloud.z.as_ref().is_some_and(|z| z.len() != cloud.xy.len()) => {
                return Err(format!("{} points and {:?} heights", cloud.xy.len(), cloud.z.map(|z| z.len())));
            }
            Ok(cloud) => said.extend(cloud.remarks),
            Err(error) => said.push(error.to_string()),
        }
    }
    let graph = source()
        .and_then(|source| delone_io::read_graph(source, format, &options(2, vec![]), Some(&mut beside)));
    match graph {
        Ok(graph) if !is_sound(&graph) => return Err("a graph whose lists do not fit".to_owned()),
        Ok(graph) => said.extend(graph.cloud.remarks),
        Err(error) => said.push(error.to_string()),
    }
    let message = |outcome: Result<(), delone_io::Error>| outcome.err().map(|error| error.to_string());
    let triangles = source().and_then(|source| delone_io::read_triangles(source, format));
    if let Ok(triangles) = &triangles {
        // Each quadrilateral is two of them.
        match source().and_then(|source| delone_io::count_quads(source, format)) {
            Ok(count) if 2 * count > triangles.len() => {
                return Err("more quadrilaterals than halves".to_owned());
            }
            outcome => said.extend(message(outcome.map(|_| ()))),
        }
    }
    said.extend(message(triangles.map(|_| ())));
    said.extend(message(source().and_then(|source| delone_io::read_tetrahedra(source, format).map(|_| ()))));
    said.extend(message(source().and_then(|source| delone_io::read_rings(source, format).map(|_| ()))));
    said.extend(message(source().and_then(|source| delone_io::read_segments(source, format).map(|_| ()))));
    said.extend(message(source().and_then(|source| delone_io::read_areas(source, format).map(|_| ()))));
    let attributes =
        source().and_then(|source| delone_io::read_triangle_attributes(source, format).map(|_| ()));
    said.extend(message(attributes));
    match source().and_then(|source| delone_io::read_raster(source, format)) {
        Ok(raster) if raster.values.len() as f64 != raster.grid.cells() => {
            return Err(format!(
                "a raster of {} cells with {} values",
                raster.grid.cells(),
                raster.values.len()
            ));
        }
        other => said.extend(message(other.map(|_| ()))),
    }
    match said.iter().find(|text| text.len() > LONGEST_MESSAGE) {
        Some(text) => Err(format!("a message of {} bytes", text.len())),
        None => Ok(()),
    }
}

/// The table that follows a `.shp` file in one of the seeds: where the head of that says that it ends.
fn table_of(bytes: &[u8]) -> &[u8] {
    let words = bytes.get(24..28).and_then(|words| words.try_into().ok()).map_or(0, u32::from_be_bytes);
    bytes.get(2 * words as usize..).unwrap_or_default()
}

/// A part of a seed of several files: `ept.json`, its hierarchy, or a node.
fn part_of(bytes: &[u8], part: usize) -> &[u8] {
    let mut rest = bytes;
    for _ in 0..part {
        let end = rest.windows(PART.len()).position(|word| word == PART);
        rest = end.map_or(&[], |end| &rest[end + PART.len()..]);
    }
    let is_last = part == 2;
    let end = rest.windows(PART.len()).position(|word| word == PART).filter(|_| !is_last);
    &rest[..end.unwrap_or(rest.len())]
}

/// Whether points that are read in chunks are those that are read at once.
fn in_chunks(
    source: Result<Box<dyn Source>, delone_io::Error>,
    format: Format,
    options: &ReadOptions,
    whole: &Result<Cloud, delone_io::Error>,
    beside: Beside,
) -> Judgement {
    let bits = |xy: &[[f64; 2]]| xy.iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
    let (mut xy, mut z) = (Vec::new(), Vec::new());
    let mut take = |points: &[[f64; 2]], heights: Option<&[f64]>| {
        xy.extend(bits(points));
        z.extend(heights.into_iter().flatten().map(|z| z.to_bits()));
        Ok(())
    };
    let found = source
        .and_then(|source| delone_io::read_chunks_beside(source, format, options, 3, &mut take, beside));
    match (whole, found) {
        (_, Err(delone_io::Error::Unsupported { .. })) | (Err(_), Err(_)) => Ok(()),
        (Ok(whole), Ok(_)) => {
            let heights = whole.z.iter().flatten().map(|z| z.to_bits());
            let are_same = bits(&whole.xy) == xy && heights.eq(z.iter().copied());
            if are_same {
                Ok(())
            } else {
                Err(format!("{} points in chunks, {} at once", xy.len(), whole.xy.len()))
            }
        }
        (Ok(_), Err(error)) => Err(format!("read at once, and in chunks: {error}")),
        (Err(error), Ok(_)) => Err(format!("read in chunks, and at once: {error}")),
    }
}

/// Whether all indices are in range and all lists as long as they are to be.
fn is_sound(graph: &Graph) -> bool {
    let (points, segments) = (graph.cloud.xy.len(), graph.segments.len());
    let fits = |markers: &Option<Vec<i64>>, count| markers.as_ref().is_none_or(|all| all.len() == count);
    graph.segments.as_flattened().iter().all(|&i| i < points)
        && graph.is_border.len() == segments
        && fits(&graph.markers, segments)
        && fits(&graph.point_markers, points)
        && graph.attributes.values.len() == points * graph.attributes.width
        && graph
            .rings
            .iter()
            .all(|ring| ring.segments.start <= ring.segments.end && ring.segments.end <= segments)
}

/// Does work with so much more memory than there is already; more ends the process, which is a finding.
fn within(room: u64, work: impl FnOnce() -> Judgement) -> Judgement {
    let (_, hard) = rlimit::getrlimit(rlimit::Resource::AS).map_err(|error| error.to_string())?;
    let statm = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages: Option<u64> = statm.split(' ').next().and_then(|pages| pages.parse().ok());
    // Where the system does not tell, the limit of the whole process stays.
    let soft = pages.map_or(hard, |pages| (4096 * pages + room).min(hard));
    rlimit::setrlimit(rlimit::Resource::AS, soft, hard).map_err(|error| error.to_string())?;
    let judgement = work();
    rlimit::setrlimit(rlimit::Resource::AS, hard, hard).map_err(|error| error.to_string())?;
    judgement
}
