//! The program in the plane.

use std::path::Path;

use delone::verify::{Objection2, verify_weighted2, verify2};
use delone::{Algorithm2, Counters, Delaunay2, Graph, Hints2, Regular2, Verdict, VertexId};
use delone_io::{Cloud, Format, Source};
use delone_predicates::{in_circle_with_ties, orient2d};

use super::{Objection, Plan, Room, WITH_WEIGHTS, Words, located};
use crate::args::{AlgorithmName, LocateName, StrategyArgs};
use crate::message::Failure;
use crate::stats::Stats;

impl Room for Delaunay2 {
    const WORDS: Words = Words {
        simplex: ["triangle", "triangles"],
        tied: "cocircular",
        negative: ["clockwise", "clockwise"],
        other: ["other_diagonals", "of its cocircular diagonals are the other one"],
    };
    type Algorithm = Algorithm2;
    const FASTEST: Algorithm2 = Algorithm2::DivideAndConquer;
    type Hints = Hints2;
    type Row = [u64; 3];

    fn take_points(cloud: &mut Cloud, _: &Path) -> Result<Vec<[f64; 2]>, Failure> {
        Ok(std::mem::take(&mut cloud.xy))
    }

    fn plan(algorithm: Option<AlgorithmName>, strategy: &StrategyArgs) -> Result<Plan<Algorithm2>, Failure> {
        let name = algorithm.unwrap_or(AlgorithmName::DivideConquer);
        if name == AlgorithmName::DivideConquer {
            if strategy.locate.is_some() {
                return Err(Failure::usage(
                    "--locate is for the incremental algorithm",
                    "add --algorithm incremental",
                ));
            }
            strategy.refuse("divide and conquer")?;
            return Ok(Plan { algorithm: Self::FASTEST, name, locate: None });
        }
        let (locate, seed) = (strategy.name_or(LocateName::Spatial), strategy.seed);
        let algorithm = match (located::<Self>(strategy, LocateName::Spatial)?, locate) {
            (Some(locate), _) => Algorithm2::Located { locate, seed },
            (None, LocateName::Conflict) => Algorithm2::ConflictLists { seed },
            (None, _) => Algorithm2::Incremental { seed },
        };
        Ok(Plan { algorithm, name, locate: Some(locate) })
    }

    fn build(points: &[[f64; 2]], algorithm: Algorithm2) -> Result<Self, delone::Error> {
        Self::with_algorithm(points, algorithm)
    }

    fn graph(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, delone::Error> {
        self.graph(graph)
    }

    fn counters(&self) -> Counters {
        self.counters()
    }

    type Regular = Regular2;

    type RegularAlgorithm = ();

    fn plan_regular(strategy: &StrategyArgs) -> Result<(), Failure> {
        if strategy.locate.is_some() {
            return Err(Failure::usage(
                "with weights --locate is for space",
                "leave --weights and --radii out, or --locate",
            ));
        }
        strategy.refuse(WITH_WEIGHTS)
    }

    fn regular(points: &[[f64; 2]], weights: &[f64], (): ()) -> Result<Regular2, delone::Error> {
        Regular2::from_parts(points, weights)
    }

    fn is_tie(simplex: &[[f64; 2]], q: [f64; 2]) -> bool {
        matches!(*simplex, [a, b, c] if in_circle_with_ties(a, b, c, q).is_zero())
    }

    fn describe(&self, line: &mut impl FnMut(&str, String), stats: &mut Stats) {
        let area: f64 = self.triangle_ids().map(|t| self.area(t)).fold(0.0, |sum, area| sum + area);
        let density = self.points().len() as f64 / area;
        line("area of the hull", format!("{area:.6}, {density:.6} points on a unit"));
        stats.set("area", area);
        stats.set("density", density);
        let hull: Vec<_> = self.hull_vertices().map(|v| self.point(v)).collect();
        let h = hull.len();
        let is_straight = |&i: &usize| orient2d(hull[i], hull[(i + 1) % h], hull[(i + 2) % h]).is_zero();
        let straight = (0..h).filter(is_straight).count();
        line("hull vertices", format!("{h}, {straight} of them inside a straight side"));
        stats.set("straight_hull_vertices", straight);
    }

    fn read_simplices(source: Box<dyn Source>, format: Format) -> Result<Vec<[u64; 3]>, delone_io::Error> {
        delone_io::read_triangles(source, format)
    }

    fn verify(
        points: &[[f64; 2]],
        weights: Option<&[f64]>,
        triangles: &[[u64; 3]],
    ) -> Result<Verdict, Objection> {
        let verdict = match weights {
            Some(weights) => verify_weighted2(points, weights, triangles),
            None => verify2(points, triangles),
        };
        verdict.map_err(|objection| match objection {
            Objection2::Points(error) => Objection::Points(error),
            other => Objection::Simplices(other.to_string()),
        })
    }
}
