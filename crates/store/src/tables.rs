//! Tables: the folder once more as tables, for programs that read Parquet.
//!
//! Points are GeoParquet: x and y once more as places, with the system of coordinates where it can be said.
//! Names count over all tiles here, so all files of a kind are one table: `read_parquet('tiles/triangles-*.parquet')`.
//!
//! Cost: O(n); memory for the largest tile, some 120 bytes a point.

use std::path::Path;

use delone::tiles::Node;
use delone_io::{Column, Crs, write_columns};

use crate::error::Error;
use crate::manifest::{Manifest, Outcome};
use crate::node::Done;
use crate::places::place;
use crate::shards;
use crate::sums::{Sums, Written};
use crate::watch::{Phase, Watch};

/// Writes the tables of all nodes.
pub(crate) fn write(
    folder: &Path,
    plan: &Manifest,
    outcome: &Outcome,
    watch: &dyn Watch,
) -> Result<Written, Error> {
    let mut written = Written::new();
    let crs = plan.crs();
    let nodes: Vec<Node> = outcome.nodes.iter().filter_map(Done::parse).map(|done| done.node).collect();
    let phase = Phase::count(watch, "writing tables", nodes.len() as u64);
    for node in nodes {
        let sums = written.entry(node).or_default();
        if plan.cuts.is_tile(node) {
            points(folder, node, crs.as_ref(), sums)?;
            triangles(folder, "triangles", node, sums, |v| node.id(v as u32))?;
        } else {
            triangles(folder, "seam", node, sums, |v| v)?;
        }
        phase.advance()?;
    }
    Ok(written)
}

fn points(folder: &Path, node: Node, crs: Option<&Crs>, sums: &mut Sums) -> Result<(), Error> {
    let cloud = shards::points(folder, node)?;
    let rows: Vec<i64> = shards::ids(folder, node)?.into_iter().map(|row| row as i64).collect();
    if rows.len() != cloud.xy.len() {
        let path = place(folder, "points", node, "npy");
        return Err(Error::changed(&path, "it has not as many points as there are ids"));
    }
    let names: Vec<i64> = (0..cloud.xy.len()).map(|v| node.id(v as u32) as i64).collect();
    let [x, y] = [0, 1].map(|k| cloud.xy.iter().map(|p| p[k]).collect::<Vec<f64>>());
    let mut columns = vec![
        ("vertex", Column::Integers(&names)),
        ("row", Column::Integers(&rows)),
        ("x", Column::Numbers(&x)),
        ("y", Column::Numbers(&y)),
    ];
    columns.extend(cloud.z.as_ref().map(|z| ("z", Column::Numbers(z))));
    columns.push(("geometry", Column::Places { xy: &cloud.xy, z: cloud.z.as_deref(), crs }));
    sums.write(&place(folder, "points", node, "parquet"), |out| write_columns(out, &columns))
}

fn triangles(
    folder: &Path,
    kind: &str,
    node: Node,
    sums: &mut Sums,
    name: impl Fn(u64) -> u64,
) -> Result<(), Error> {
    let triangles = shards::triangles(&place(folder, kind, node, "npy"))?;
    let corner = |k: usize| triangles.iter().map(|t| name(t[k]) as i64).collect::<Vec<i64>>();
    let [a, b, c] = [0, 1, 2].map(corner);
    let columns = [("a", Column::Integers(&a)), ("b", Column::Integers(&b)), ("c", Column::Integers(&c))];
    sums.write(&place(folder, "triangles", node, "parquet"), |out| write_columns(out, &columns))
}
