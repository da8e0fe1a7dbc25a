//! The triangulation of points alone, with a height for each vertex.

use delone::surface::Duplicates;
use delone::{Delaunay2, Surround};
use delone_io::Cloud;

use crate::error::Error;

/// Triangulates points alone. Vertices are numbered along a curve, so that what is near in the plane is near in memory.
pub(crate) fn of_points(cloud: &Cloud, rule: Duplicates) -> Result<(Delaunay2, Vec<f64>), Error> {
    let (d, order) = Delaunay2::along_curve(&cloud.xy).map_err(Error::Points)?;
    let mut given = cloud.z.clone().unwrap_or_default();
    if order.len() < cloud.xy.len() {
        let mut is_vertex = vec![false; cloud.xy.len()];
        order.iter().for_each(|&i| is_vertex[i as usize] = true);
        let mut pairs = Vec::new();
        let mut near = None;
        for point in (0..cloud.xy.len()).filter(|&i| !is_vertex[i]) {
            let found = d.find_near(near, cloud.xy[point]).map_err(Error::Points)?;
            near = found.simplex.or(near);
            pairs.extend(found.face().first().map(|v| (point, order[v.index()] as usize)));
        }
        rule.settle(&mut given, pairs);
    }
    let heights = order.iter().map(|&i| given[i as usize]).collect();
    Ok((d, heights))
}
