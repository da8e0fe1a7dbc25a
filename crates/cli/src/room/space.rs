//! The program in space.

use std::path::Path;

use delone::verify::{Objection3, verify_weighted3, verify3};
use delone::{Algorithm3, Counters, Delaunay3, Graph, Hints3, Regular3, Verdict, VertexId};
use delone_io::{Cloud, Format, Source};
use delone_predicates::in_sphere_with_ties;

use super::{Objection, Plan, Room, WITH_WEIGHTS, Words, located};
use crate::args::{AlgorithmName, LocateName, StrategyArgs};
use crate::message::Failure;
use crate::stats::Stats;

impl Room for Delaunay3 {
    const WORDS: Words = Words {
        simplex: ["tetrahedron", "tetrahedra"],
        tied: "cospherical",
        negative: ["negative", "in negative order"],
        other: ["other_ties", "ties between neighbors are broken in another way"],
    };
    type Algorithm = Algorithm3;
    const FASTEST: Algorithm3 = Algorithm3::Incremental { seed: 0 };
    type Hints = Hints3;
    type Row = [u64; 4];

    fn take_points(cloud: &mut Cloud, path: &Path) -> Result<Vec<[f64; 3]>, Failure> {
        let xy = std::mem::take(&mut cloud.xy);
        match cloud.z.take() {
            Some(z) => Ok(xy.iter().zip(z).map(|(&[x, y], z)| [x, y, z]).collect()),
            None if xy.is_empty() => Ok(Vec::new()),
            None => Err(Failure::new(
                format!("{}: the points have no third coordinate", path.display()),
                "leave --dim 3 out, or name three columns with --columns",
            )),
        }
    }

    fn plan(algorithm: Option<AlgorithmName>, strategy: &StrategyArgs) -> Result<Plan<Algorithm3>, Failure> {
        if algorithm == Some(AlgorithmName::DivideConquer) {
            return Err(Failure::usage(
                "divide and conquer is for the plane",
                "leave --algorithm out: in space points are inserted one by one in spatial order",
            ));
        }
        let (locate, seed) = (strategy.name_or(LocateName::Spatial), strategy.seed);
        if matches!(locate, LocateName::Conflict | LocateName::Stars) {
            return Err(Failure::usage(
                "location by stars and by conflict lists is for the plane",
                "choose --locate spatial, tree, walk, jump-and-walk, hierarchy, history or delaunay-tree",
            ));
        }
        let algorithm = if locate == LocateName::History {
            strategy.strategy(LocateName::Spatial)?;
            Algorithm3::Flips { seed }
        } else {
            match located::<Self>(strategy, LocateName::Spatial)? {
                Some(locate) => Algorithm3::Located { locate, seed },
                None => Algorithm3::Incremental { seed },
            }
        };
        Ok(Plan { algorithm, name: AlgorithmName::Incremental, locate: Some(locate) })
    }

    fn build(points: &[[f64; 3]], algorithm: Algorithm3) -> Result<Self, delone::Error> {
        Self::with_algorithm(points, algorithm)
    }

    fn graph(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, delone::Error> {
        self.graph(graph)
    }

    fn counters(&self) -> Counters {
        self.counters()
    }

    type Regular = Regular3;

    /// The seed of flips, if it is by them.
    type RegularAlgorithm = Option<u64>;

    fn plan_regular(strategy: &StrategyArgs) -> Result<Option<u64>, Failure> {
        match strategy.locate {
            None => strategy.refuse(WITH_WEIGHTS).map(|()| None),
            Some(LocateName::History) => strategy.strategy(LocateName::History).map(|_| Some(strategy.seed)),
            Some(_) => Err(Failure::usage(
                "points with weights are located by default or by history",
                "choose --locate history, or leave --locate out",
            )),
        }
    }

    fn regular(
        points: &[[f64; 3]],
        weights: &[f64],
        by_flips: Option<u64>,
    ) -> Result<Regular3, delone::Error> {
        match by_flips {
            Some(seed) => Regular3::by_flips(points, weights, seed),
            None => Regular3::from_parts(points, weights),
        }
    }

    fn is_tie(simplex: &[[f64; 3]], q: [f64; 3]) -> bool {
        matches!(*simplex, [a, b, c, d] if in_sphere_with_ties(a, b, c, d, q).is_zero())
    }

    fn describe(&self, line: &mut impl FnMut(&str, String), _: &mut Stats) {
        line("edges", self.edges().count().to_string());
        line("hull facets", self.hull_facets().count().to_string());
    }

    fn read_simplices(source: Box<dyn Source>, format: Format) -> Result<Vec<[u64; 4]>, delone_io::Error> {
        delone_io::read_tetrahedra(source, format)
    }

    fn verify(
        points: &[[f64; 3]],
        weights: Option<&[f64]>,
        tetrahedra: &[[u64; 4]],
    ) -> Result<Verdict, Objection> {
        let verdict = match weights {
            Some(weights) => verify_weighted3(points, weights, tetrahedra),
            None => verify3(points, tetrahedra),
        };
        verdict.map_err(|objection| match objection {
            Objection3::Points(error) => Objection::Points(error),
            other => Objection::Simplices(other.to_string()),
        })
    }
}
