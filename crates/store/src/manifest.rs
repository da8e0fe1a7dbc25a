//! `tiles.json`: what a folder of tiles is made of, how far the work is, and what came out.
//!
//! It is written whole at the end of each stage: planned (points are counted, the plane is cut), distributed (every point is in its
//! bucket), done. What is finished between shows in the folder, where every file has its name when it is whole.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use delone::tiles::{Cut, Cuts, Fingerprint, Node};
use delone_io::{Crs, sync_folder};
use serde_json::{Value, json};

use crate::buckets::Filled;
use crate::error::Error;
use crate::node::Done;
use crate::own;
use crate::sums::Written;

/// The name of the file in a folder of tiles that describes them.
pub const NAME: &str = "tiles.json";

/// The name of the format, with its version beside.
const FORMAT: &str = "delone tiles";
const VERSION: u64 = 2;

/// The plan of a run.
#[derive(Debug)]
pub(crate) struct Manifest {
    /// The files, as they were when they were read, and how.
    pub(crate) input: Value,
    /// The number of points of all files.
    pub(crate) count: u64,
    pub(crate) has_heights: bool,
    pub(crate) cuts: Cuts,
    /// The system of coordinates, by the name that files give it, where one does.
    pub(crate) system: Option<String>,
    /// The content of each tile's bucket, once all points are in theirs.
    pub(crate) buckets: Option<BTreeMap<Node, Filled>>,
    /// Points that were left out because they equal the only one of their tile.
    pub(crate) left_out: u64,
    /// The outcome, once all is done.
    pub(crate) outcome: Option<Outcome>,
}

/// The sums of all tiles and seams.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) fingerprint: Fingerprint,
    pub(crate) vertices: u64,
    pub(crate) duplicates: u64,
    pub(crate) hull: u64,
    /// The record of each node.
    pub(crate) nodes: Vec<Value>,
}

impl Outcome {
    pub(crate) fn triangles(&self) -> u64 {
        self.fingerprint.count()
    }

    /// Takes in the hashes of what was written when all was done.
    pub(crate) fn extend(&mut self, mut written: Written) {
        for value in &mut self.nodes {
            let Some(mut done) = Done::parse(value) else { continue };
            done.sums.extend(written.remove(&done.node).unwrap_or_default());
            *value = done.describe();
        }
    }

    /// Whether it is what its nodes have together, and these are all tiles and perhaps seams; none if a node cannot be read.
    fn adds_up(&self, cuts: &Cuts, count: u64, left_out: u64) -> Option<bool> {
        let mut nodes: Vec<Done> = self.nodes.iter().map(Done::parse).collect::<Option<_>>()?;
        nodes.sort_unstable_by_key(|done| done.node);
        let are_one = nodes.is_sorted_by(|one, other| one.node < other.node);
        let (tiles, seams): (Vec<Node>, Vec<Node>) =
            nodes.iter().map(|done| done.node).partition(|&node| cuts.is_tile(node));
        let are_known =
            tiles == sorted(cuts.tiles()) && seams.iter().all(|&node| cuts.halves(node).is_some());
        let vertices = nodes.iter().try_fold(0, |sum: u64, done| sum.checked_add(done.vertices))?;
        let duplicates = nodes.iter().try_fold(left_out, |sum, done| sum.checked_add(done.duplicates))?;
        let fingerprint: Fingerprint = nodes.iter().map(|done| done.fingerprint).sum();
        Some(
            are_one
                && are_known
                && (vertices, duplicates) == (self.vertices, self.duplicates)
                && vertices.checked_add(duplicates) == Some(count)
                && fingerprint == self.fingerprint,
        )
    }
}

impl Manifest {
    /// The system of coordinates, where it is known.
    pub(crate) fn crs(&self) -> Option<Crs> {
        self.system.as_deref().and_then(Crs::of_name)
    }

    /// Writes it, whole.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Error> {
        let stage = match (&self.buckets, &self.outcome) {
            (_, Some(_)) => "done",
            (Some(_), None) => "distributed",
            (None, None) => "planned",
        };
        let cut = |(node, cut): (Node, Cut)| {
            // Exact bits, beside what can be read.
            json!({ "node": node.number(), "axis": cut.axis, "at": cut.at, "bits": format!("{:016x}", cut.at.to_bits()) })
        };
        let mut all = json!({
            "format": FORMAT,
            "version": VERSION,
            "stage": stage,
            "count": self.count,
            "heights": self.has_heights,
            "left_out": self.left_out,
            "input": self.input,
            "cuts": self.cuts.cuts().into_iter().map(cut).collect::<Vec<_>>(),
        });
        if let Some(system) = &self.system {
            all["system"] = json!(system);
        }
        if let Some(buckets) = &self.buckets {
            let entry = |(node, filled): (&Node, &Filled)| {
                json!([node.number(), filled.points, format!("{:016x}", filled.sum)])
            };
            all["buckets"] = buckets.iter().map(entry).collect();
        }
        if let Some(outcome) = &self.outcome {
            all["triangles"] = json!(outcome.triangles());
            all["fingerprint"] = json!(outcome.fingerprint.to_string());
            all["vertices"] = json!(outcome.vertices);
            all["duplicates"] = json!(outcome.duplicates);
            all["hull"] = json!(outcome.hull);
            all["nodes"] = json!(outcome.nodes);
        }
        let text = format!("{all:#}\n");
        // What it says is on the disk before it, and it is when this returns.
        let sync = || sync_folder(folder).map_err(|error| Error::write(folder, error));
        sync()?;
        own::write(&folder.join(NAME), |out| Ok(out.write_all(text.as_bytes())?))?;
        sync()
    }

    /// Reads that of a folder, if there is one.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, Error> {
        let path = folder.join(NAME);
        let text = match own::open(&path).and_then(std::io::read_to_string) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Error::read(&path, error)),
        };
        let wrong = |what: &str| Error::Manifest { path: path.clone(), what: what.to_owned() };
        let all: Value = serde_json::from_str(&text).map_err(|_| wrong("it is not JSON"))?;
        if all["format"] != FORMAT {
            return Err(wrong("it does not describe tiles"));
        }
        match all["version"].as_u64() {
            Some(VERSION) => {}
            Some(found) => return Err(Error::Version { path, found, known: VERSION }),
            None => return Err(wrong("it has no version")),
        }
        Self::parse(&all)
            .ok_or_else(|| wrong("something is missing in it, or wrong"))?
            .map(Some)
            .map_err(|error| wrong(&error.to_string()))
    }

    fn parse(all: &Value) -> Option<Result<Self, delone::Error>> {
        let node = |value: &Value| Node::new(u32::try_from(value.as_u64()?).ok()?);
        let cut = |value: &Value| {
            let bits = u64::from_str_radix(value["bits"].as_str()?, 16).ok()?;
            let axis = usize::try_from(value["axis"].as_u64()?).ok()?;
            Some((node(&value["node"])?, Cut { axis, at: f64::from_bits(bits) }))
        };
        let cuts: Vec<(Node, Cut)> = all["cuts"].as_array()?.iter().map(cut).collect::<Option<_>>()?;
        let cuts = match Cuts::from_cuts(cuts) {
            Ok(cuts) => cuts,
            Err(error) => return Some(Err(error)),
        };
        let buckets: Option<BTreeMap<Node, Filled>> = match &all["buckets"] {
            Value::Null => None,
            counts => {
                // Those of a folder that is done are gone, and older ones have no hash.
                let sum = |sum: &Value| u64::from_str_radix(sum.as_str().unwrap_or("0"), 16).ok();
                let filled =
                    |entry: &Value| Some(Filled { points: entry[1].as_u64()?, sum: sum(&entry[2])? });
                let entry = |entry: &Value| Some((node(&entry[0])?, filled(entry)?));
                Some(counts.as_array()?.iter().map(entry).collect::<Option<_>>()?)
            }
        };
        if buckets.as_ref().is_some_and(|buckets| !buckets.keys().copied().eq(sorted(cuts.tiles()))) {
            return None;
        }
        let outcome = match all["stage"].as_str()? {
            "done" => Some(Outcome {
                fingerprint: all["fingerprint"].as_str()?.parse().ok()?,
                vertices: all["vertices"].as_u64()?,
                duplicates: all["duplicates"].as_u64()?,
                hull: all["hull"].as_u64()?,
                nodes: all["nodes"].as_array()?.clone(),
            }),
            "planned" | "distributed" => None,
            _ => return None,
        };
        let (count, left_out) = (all["count"].as_u64()?, all["left_out"].as_u64()?);
        if let Some(buckets) = &buckets {
            let sum = buckets.values().try_fold(left_out, |sum, filled| sum.checked_add(filled.points));
            (sum == Some(count)).then_some(())?;
        }
        if let Some(outcome) = &outcome {
            let is_sum =
                all["triangles"] == outcome.triangles() && outcome.adds_up(&cuts, count, left_out)?;
            is_sum.then_some(())?;
        }
        Some(Ok(Self {
            input: all["input"].clone(),
            count,
            has_heights: all["heights"].as_bool()?,
            cuts,
            system: all["system"].as_str().map(str::to_owned),
            buckets,
            left_out,
            outcome,
        }))
    }
}

/// That of a folder, and what came out; an error if it is not done.
pub(crate) fn finished(folder: &Path) -> Result<(Manifest, Outcome), Error> {
    let mut plan = Manifest::read(folder)?.ok_or_else(|| no_tiles(folder))?;
    let Some(outcome) = plan.outcome.take() else {
        return Err(Error::Unfinished { folder: folder.to_owned() });
    };
    Ok((plan, outcome))
}

/// A folder without.
pub(crate) fn no_tiles(folder: &Path) -> Error {
    Error::NoTiles { folder: folder.to_owned() }
}

/// Nodes by their numbers.
fn sorted(mut nodes: Vec<Node>) -> Vec<Node> {
    nodes.sort_unstable();
    nodes
}
