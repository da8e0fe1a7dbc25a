//! `delone voronoi --order`: where which sites are the nearest ones.

use std::path::PathBuf;

use delone::{Delaunay2, Region2};
use delone_io::{Crs, Format, OrderDiagram};

use crate::clip::not_merged;
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::Stats;

/// The wanted part of a diagram.
pub(crate) struct Clipped<'a> {
    pub(crate) order: usize,
    /// The region that it is clipped to.
    pub(crate) region: &'a Region2,
    /// The length up to which sides are contracted.
    pub(crate) merge: Option<f64>,
    /// The system of coordinates.
    pub(crate) crs: Option<&'a Crs>,
    /// The longer side of pictures.
    pub(crate) size: u32,
}

/// Writes the regions of one order.
pub(crate) fn write(
    wanted: &Clipped,
    triangulation: &Delaunay2,
    outputs: &[(PathBuf, Format)],
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let diagram = {
        let _phase = Phase::start(quiet, "making orders");
        triangulation.order(wanted.order).map_err(|error| match error {
            delone::Error::Parameter { .. } => {
                let count = triangulation.vertex_count();
                let what = format!("--order is {} and there are {count} sites", wanted.order);
                Failure::usage(what, "give a number from 1 to that of the sites, equal ones counted once")
            }
            error => Failure::new(error, "give a lower --order, or fewer sites"),
        })?
    };
    stats.phase("order");
    let cells = {
        let _phase = Phase::start(quiet, "clipping");
        let cells = diagram.cells(wanted.region);
        match wanted.merge {
            Some(length) => cells.merged(length, wanted.region).map_err(not_merged)?,
            None => cells,
        }
    };
    stats.phase("clip");
    stats.triangulation(triangulation, triangulation.counters());
    stats.set("order", wanted.order);
    stats.set("regions", diagram.region_count());
    stats.set("unbounded_regions", diagram.regions().filter(|region| !region.is_bounded()).count());
    stats.set("circles", diagram.circles().count());
    stats.set("cells", diagram.regions().filter(|&region| cells.rings(region).next().is_some()).count());
    stats.set("area", wanted.region.area());
    let _phase = Phase::start(quiet, "writing");
    let diagram = OrderDiagram { diagram: &diagram, cells: &cells, crs: wanted.crs };
    for (path, format) in outputs {
        let crs = files::drawn_system(diagram.crs, *format);
        let diagram = OrderDiagram { crs: crs.as_ref(), ..diagram };
        files::write(path, |out| delone_io::write_orders(out, *format, &diagram, wanted.size))?;
    }
    stats.phase("write");
    Ok(())
}
