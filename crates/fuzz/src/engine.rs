//! Triangulations of the plane and of space by the public traits, and their simplices in a form that can be compared.

use std::sync::OnceLock;

use delone::{
    Algorithm2, Algorithm3, Change, Delaunay2, Delaunay3, Dimension, Error, Hierarchy, JumpAndWalk, Locate,
    Nearest, VertexId, Walk,
};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::oracle::delaunay::Simplices;

/// The numbers of threads that must make no difference.
pub(crate) const THREADS: [usize; 3] = [1, 2, 7];

/// A pool for each of [`THREADS`].
pub(crate) fn pools() -> &'static [ThreadPool] {
    static POOLS: OnceLock<Vec<ThreadPool>> = OnceLock::new();
    POOLS.get_or_init(|| {
        let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        THREADS.into_iter().map(pool).collect()
    })
}

/// Strategies of location; those of space come first.
pub(crate) fn strategies(seed: u64) -> [Locate; 12] {
    let hierarchy = Hierarchy::default();
    let steep = hierarchy.ratio(2.0).smallest_level(2).seed(seed);
    [
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::JumpAndWalk(JumpAndWalk::default().seed(seed)),
        Locate::Hierarchy(hierarchy),
        // Levels even for few vertices.
        Locate::Hierarchy(steep),
        Locate::Hierarchy(steep.ratio(1.25).nearest(Nearest::Exact).with_replacement(true)),
        Locate::DelaunayTree,
        Locate::Walk(Walk::Stochastic { seed }),
        Locate::Walk(Walk::Straight),
        Locate::Hierarchy(steep.nearest(Nearest::InCircle).walk(Walk::Stochastic { seed })),
        Locate::History,
        Locate::Stars,
    ]
}

/// A triangulation of points, by the traits that users have; what no trait has is said for each dimension.
pub(crate) trait Engine<const D: usize>: Change<Point = [f64; D]> {
    /// How many of [`strategies`] there are in this dimension.
    const STRATEGIES: usize;

    /// Inserted one by one.
    fn located(points: &[[f64; D]], locate: Locate, seed: u64) -> Result<Self, Error>;
    /// All other ways to build.
    fn others(points: &[[f64; D]], seed: u64) -> Vec<(String, Result<Self, Error>)>;
    /// The simplices of vertices that span less than space and more than a line; those of the trait have full dimension.
    fn flat_simplices(&self) -> Vec<Vec<VertexId>>;
    fn nearest_neighbor(&self, v: VertexId) -> Option<VertexId>;
    /// `None` where there is no such query.
    fn in_box(&self, low: [f64; D], high: [f64; D]) -> Option<Result<Vec<VertexId>, Error>>;

    fn build(points: &[[f64; D]]) -> Result<Self, Error> {
        Self::from_vec(points.to_vec())
    }

    /// The dimension of what the vertices span; -1 without vertices.
    fn span(&self) -> isize {
        match self.dimension() {
            Dimension::Empty => -1,
            Dimension::Point => 0,
            Dimension::Line => 1,
            Dimension::Plane => 2,
            Dimension::Space => 3,
        }
    }

    /// As the oracle has them.
    fn points_of_simplices(&self) -> Simplices<D> {
        let points = |corners: &[VertexId]| corners.iter().filter_map(|&v| self.position(v)).collect();
        match self.span() {
            span if span == D as isize => sorted(self.simplices().map(|s| points(self.corners(s).as_ref()))),
            2 => sorted(self.flat_simplices().iter().map(|corners| points(corners))),
            _ => sorted(self.edges().map(|e| points(&e))),
        }
    }

    /// The verdict of the triangulation's own check.
    fn is_sound(&self) -> Result<(), String> {
        self.check().map_err(|flaw| format!("check: {flaw:?}"))
    }
}

/// Sorted simplices of sorted points; negative zero made zero.
pub(crate) fn sorted<const D: usize>(simplices: impl Iterator<Item = Vec<[f64; D]>>) -> Simplices<D> {
    let mut all: Simplices<D> = simplices
        .map(|simplex| {
            let mut simplex: Vec<[f64; D]> = simplex.into_iter().map(|p| p.map(|x| x + 0.0)).collect();
            simplex.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
            simplex
        })
        .collect();
    all.sort_by(|s, t| s.partial_cmp(t).expect("finite"));
    all
}

impl Engine<2> for Delaunay2 {
    const STRATEGIES: usize = 12;

    fn located(points: &[[f64; 2]], locate: Locate, seed: u64) -> Result<Self, Error> {
        Self::with_algorithm(points, Algorithm2::Located { locate, seed })
    }

    fn others(points: &[[f64; 2]], seed: u64) -> Vec<(String, Result<Self, Error>)> {
        let all = [Algorithm2::Incremental { seed }, Algorithm2::ConflictLists { seed }];
        all.map(|algorithm| (format!("{algorithm:?}"), Self::with_algorithm(points, algorithm))).into()
    }

    fn flat_simplices(&self) -> Vec<Vec<VertexId>> {
        Vec::new()
    }

    fn nearest_neighbor(&self, v: VertexId) -> Option<VertexId> {
        self.nearest_neighbor(v)
    }

    fn in_box(&self, low: [f64; 2], high: [f64; 2]) -> Option<Result<Vec<VertexId>, Error>> {
        Some(self.in_rectangle(low, high))
    }
}

impl Engine<3> for Delaunay3 {
    const STRATEGIES: usize = 7;

    fn located(points: &[[f64; 3]], locate: Locate, seed: u64) -> Result<Self, Error> {
        Self::with_algorithm(points, Algorithm3::Located { locate, seed })
    }

    fn others(points: &[[f64; 3]], seed: u64) -> Vec<(String, Result<Self, Error>)> {
        [Algorithm3::Incremental { seed }, Algorithm3::Flips { seed }]
            .map(|algorithm| (format!("{algorithm:?}"), Self::with_algorithm(points, algorithm)))
            .into()
    }

    fn flat_simplices(&self) -> Vec<Vec<VertexId>> {
        self.facets().map(|f| self.mesh().facet_corners(f).into()).collect()
    }

    fn nearest_neighbor(&self, v: VertexId) -> Option<VertexId> {
        self.nearest_neighbor(v)
    }

    fn in_box(&self, _: [f64; 3], _: [f64; 3]) -> Option<Result<Vec<VertexId>, Error>> {
        None
    }
}
