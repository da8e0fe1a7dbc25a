//! Cells with four corners: pairs of triangles, or parts of all cells.

use delone::{AllQuads2, Constrained2, Quads2, Triangulation as _};
use delone_io::{Constraints, Mesh, Rows, picture};
use serde_json::json;

use super::kept::Kept;
use super::names::Target;
use super::parts::Parts;
use super::{Made, at, write_all};
use crate::message::{Failure, grouped, is_strict, warn};
use crate::stats::Stats;

/// Which cells have four corners, by the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    Nothing,
    Pairs,
    All,
}

impl Wanted {
    pub(super) fn are_wanted(self) -> bool {
        self != Self::Nothing
    }
}

/// The cells of a mesh.
#[derive(Debug)]
pub(super) enum Cells {
    Triangles,
    Pairs(Quads2),
    Parts(AllQuads2),
}

impl Cells {
    /// Rounds of smoothing are for parts alone: pairs stay triangles of a Delaunay triangulation.
    pub(super) fn of(made: &Made, wanted: Wanted, rounds: usize) -> Result<Self, Failure> {
        let c = &made.triangulation;
        let pairs = || Quads2::of(c, &made.refined);
        let cells = match wanted {
            Wanted::Nothing => Self::Triangles,
            Wanted::Pairs => Self::Pairs(pairs()),
            Wanted::All => {
                let mut parts = AllQuads2::of(c, &pairs());
                parts.bend(&made.arc_middles);
                parts.smooth(c, &made.refined, rounds);
                Self::Parts(parts)
            }
        };
        match cells.left().filter(|_| is_strict()) {
            Some(left) => Err(Failure::new(
                left,
                "move the points towards the origin, ask for less, or leave --strict out to write what there is",
            )),
            None => Ok(cells),
        }
    }

    /// How many quadrilaterals are not convex, if there are some.
    fn left(&self) -> Option<String> {
        let Self::Parts(quads) = self else { return None };
        let count = quads.left.len();
        let what = if count == 1 { "quadrilateral is" } else { "quadrilaterals are" };
        (count > 0).then(|| {
            format!("{} {what} not convex: coordinates have too few digits there", grouped(count as u64))
        })
    }

    /// Warns of quadrilaterals that are not convex.
    pub(super) fn tell_left(&self, quiet: bool) {
        if let Some(left) = self.left() {
            warn(quiet, left);
        }
    }

    /// Notes counts and angles for the statistics.
    pub(super) fn count(&self, c: &Constrained2, stats: &mut Stats) {
        let (count, triangles, points, left, angles) = match self {
            Self::Triangles => return,
            Self::Pairs(quads) => (quads.corners.len(), quads.triangles.len(), 0, 0, quads.angles(c)),
            Self::Parts(quads) => {
                (quads.corners.len(), 0, quads.points.len() - quads.first, quads.left.len(), quads.angles())
            }
        };
        let [smallest, largest] = angles.unwrap_or_default();
        let counts = json!({
            "count": count, "triangles": triangles, "points": points, "not_convex": left,
            "smallest_angle": smallest, "largest_angle": largest,
        });
        stats.set("quads", counts);
    }

    /// For each triangle by index the one that it makes a quadrilateral with.
    pub(super) fn partners(&self, c: &Constrained2) -> Option<Vec<Option<usize>>> {
        let Self::Pairs(quads) = self else { return None };
        let mut partners = vec![None; c.slot_count()];
        for [one, other] in &quads.pairs {
            partners[one.index()] = Some(other.index());
            partners[other.index()] = Some(one.index());
        }
        Some(partners)
    }
}

/// Writes the parts of the cells of a mesh: sides are halves of its sides, with their markers, and parts have the regions of their cells.
pub(super) fn write_parts(
    (made, quads): (&Made, &AllQuads2),
    mesh: &Mesh<Kept>,
    targets: &[Target],
    options: &picture::Options,
    quiet: bool,
) -> Result<(), Failure> {
    let parts = Parts::of(mesh.triangulation, quads);
    let given = mesh.constraints.copied().unwrap_or_default();
    let halves: Vec<_> = given.edges.iter().map(|&ends| parts.halves(ends)).collect();
    let edges = halves.concat();
    let markers = given.markers.map(|markers| doubled(&halves, markers));
    let rows = given.features.map(|features| doubled(&halves, features.of));
    let features = given.features.zip(rows.as_ref()).map(|(features, of)| Rows { of, ..features });
    let constraints = Constraints { edges: &edges, markers: markers.as_deref(), features, ..given };
    let regions = mesh.regions.map(|regions| parts.of_cells(regions));
    let rows = mesh.features.map(|features| parts.of_cells(features.of));
    let features = mesh.features.zip(rows.as_ref()).map(|(features, of)| Rows { of, ..features });
    let in_triangles = |p: [f64; 2], values: &[f64]| at(&made.triangulation, p, 1, values)[0];
    let heights = mesh.heights.zip(made.heights.as_ref());
    let heights = heights.map(|(heights, all)| parts.means(heights, |p| in_triangles(p, all)));
    let point_markers = mesh.point_markers.map(|of_points| {
        let mut markers = of_points.to_vec();
        markers.resize(parts.points.len(), 0);
        for (&ends, &marker) in given.edges.iter().zip(given.markers.unwrap_or_default()) {
            if let Some(middle) = parts.middle(ends) {
                markers[middle.index()] = marker;
            }
        }
        markers
    });
    let partners = parts.partners();
    let divided = Mesh {
        heights: heights.as_deref(),
        crs: mesh.crs,
        base: mesh.base,
        constraints: Some(&constraints),
        regions: regions.as_deref(),
        names: mesh.names,
        features,
        point_markers: point_markers.as_deref(),
        edge_markers: mesh.edge_markers,
        partners: Some(&partners),
        element: mesh.element,
        ..Mesh::new(&parts, &parts.points)
    };
    write_all(&divided, targets, options, quiet)
}

/// Values of edges, for each of their halves.
fn doubled<V: Copy>(halves: &[Vec<[delone::VertexId; 2]>], values: &[V]) -> Vec<V> {
    halves.iter().zip(values).flat_map(|(halves, &value)| vec![value; halves.len()]).collect()
}
