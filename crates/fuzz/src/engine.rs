//! The engine of the plane and that of space under one name, and what they made in a form that can be compared.

use std::sync::OnceLock;

use delone::{
    Algorithm2, Algorithm3, Delaunay2, Delaunay3, Dimension, Error, FacetId, Hierarchy, Inserted,
    JumpAndWalk, Locate, Location2, Location3, Nearest, VertexId, Walk,
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

/// Where a point falls, by the corners of what it is inside of.
#[derive(Clone, Debug)]
pub(crate) enum Place<const D: usize> {
    Inside(Vec<[f64; D]>),
    /// Beyond this facet of the hull.
    Outside(Vec<[f64; D]>),
    /// In nothing, because all is flat.
    Nowhere,
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

/// The operations of both engines.
pub(crate) trait Engine<const D: usize>: Clone + Sized {
    const STRATEGIES: usize;

    fn build(points: &[[f64; D]]) -> Result<Self, Error>;
    fn located(points: &[[f64; D]], locate: Locate, seed: u64) -> Result<Self, Error>;
    /// All other ways to build.
    fn others(points: &[[f64; D]], seed: u64) -> Vec<(String, Result<Self, Error>)>;
    fn use_strategy(&mut self, locate: Locate) -> Result<(), Error>;
    fn span(&self) -> isize;
    /// As the oracle has them.
    fn simplices(&self) -> Simplices<D>;
    /// The verdict of the engine's own check.
    fn is_sound(&self) -> Result<(), String>;
    fn twins(&self) -> Vec<(usize, usize)>;
    fn alive(&self) -> Vec<VertexId>;
    fn at(&self, v: VertexId) -> [f64; D];
    fn add(&mut self, p: [f64; D]) -> Result<Inserted, Error>;
    fn take(&mut self, v: VertexId) -> Result<(), Error>;
    fn shift(&mut self, v: VertexId, p: [f64; D]) -> Result<(), Error>;
    fn add_all(&mut self, points: &[[f64; D]], seed: u64) -> Result<std::ops::Range<usize>, Error>;
    fn place(&self, q: [f64; D]) -> Result<Place<D>, Error>;
    fn near(&self, q: [f64; D]) -> Result<Option<VertexId>, Error>;
    fn neighbor(&self, v: VertexId) -> Option<VertexId>;
    fn some_near(&self, q: [f64; D], k: usize) -> Result<Vec<VertexId>, Error>;
    fn ball(&self, q: [f64; D], radius: f64) -> Result<Vec<VertexId>, Error>;
    /// `None` where there is no such query.
    fn rectangle(&self, low: [f64; D], high: [f64; D]) -> Option<Result<Vec<VertexId>, Error>>;
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

fn span_of(dimension: Dimension) -> isize {
    match dimension {
        Dimension::Empty => -1,
        Dimension::Point => 0,
        Dimension::Line => 1,
        Dimension::Plane => 2,
        Dimension::Space => 3,
    }
}

macro_rules! shared {
    ($d:literal) => {
        fn build(points: &[[f64; $d]]) -> Result<Self, Error> {
            Self::from_points(points)
        }

        fn use_strategy(&mut self, locate: Locate) -> Result<(), Error> {
            self.set_strategy(locate)
        }

        fn span(&self) -> isize {
            span_of(self.dimension())
        }

        fn is_sound(&self) -> Result<(), String> {
            self.check().map_err(|flaw| format!("check: {flaw:?}"))
        }

        fn twins(&self) -> Vec<(usize, usize)> {
            self.duplicates().map(|d| (d.point, d.vertex.index())).collect()
        }

        fn alive(&self) -> Vec<VertexId> {
            self.vertices().collect()
        }

        fn at(&self, v: VertexId) -> [f64; $d] {
            self.point(v)
        }

        fn add(&mut self, p: [f64; $d]) -> Result<Inserted, Error> {
            self.insert(p)
        }

        fn take(&mut self, v: VertexId) -> Result<(), Error> {
            self.remove(v)
        }

        fn shift(&mut self, v: VertexId, p: [f64; $d]) -> Result<(), Error> {
            self.move_to(v, p)
        }

        fn add_all(&mut self, points: &[[f64; $d]], seed: u64) -> Result<std::ops::Range<usize>, Error> {
            self.extend(points, seed)
        }

        fn near(&self, q: [f64; $d]) -> Result<Option<VertexId>, Error> {
            self.nearest(q)
        }

        fn neighbor(&self, v: VertexId) -> Option<VertexId> {
            self.nearest_neighbor(v)
        }

        fn some_near(&self, q: [f64; $d], k: usize) -> Result<Vec<VertexId>, Error> {
            self.k_nearest(q, k)
        }

        fn ball(&self, q: [f64; $d], radius: f64) -> Result<Vec<VertexId>, Error> {
            self.within(q, radius)
        }
    };
}

impl Engine<2> for Delaunay2 {
    const STRATEGIES: usize = 12;

    shared!(2);

    fn located(points: &[[f64; 2]], locate: Locate, seed: u64) -> Result<Self, Error> {
        Self::with_algorithm(points, Algorithm2::Located { locate, seed })
    }

    fn others(points: &[[f64; 2]], seed: u64) -> Vec<(String, Result<Self, Error>)> {
        let all = [Algorithm2::Incremental { seed }, Algorithm2::ConflictLists { seed }];
        all.map(|algorithm| (format!("{algorithm:?}"), Self::with_algorithm(points, algorithm))).into()
    }

    fn simplices(&self) -> Simplices<2> {
        if self.dimension() == Dimension::Plane {
            sorted(self.triangles().map(|t| t.map(|v| self.point(v)).into()))
        } else {
            sorted(self.edges().map(|e| e.map(|v| self.point(v)).into()))
        }
    }

    fn place(&self, q: [f64; 2]) -> Result<Place<2>, Error> {
        let ends = |e| self.segment(e).to_vec();
        Ok(match self.locate(q)? {
            Location2::Triangle(t) => Place::Inside(self.mesh().corners(t).map(|v| self.point(v)).into()),
            Location2::Edge(e) => Place::Inside(ends(e)),
            Location2::Vertex(v) => Place::Inside(vec![self.point(v)]),
            Location2::Outside(e) => Place::Outside(ends(e)),
            Location2::LowerDimensional(_) => Place::Nowhere,
        })
    }

    fn rectangle(&self, low: [f64; 2], high: [f64; 2]) -> Option<Result<Vec<VertexId>, Error>> {
        Some(self.in_rectangle(low, high))
    }
}

impl Engine<3> for Delaunay3 {
    const STRATEGIES: usize = 7;

    shared!(3);

    fn located(points: &[[f64; 3]], locate: Locate, seed: u64) -> Result<Self, Error> {
        Self::with_algorithm(points, Algorithm3::Located { locate, seed })
    }

    fn others(points: &[[f64; 3]], seed: u64) -> Vec<(String, Result<Self, Error>)> {
        [Algorithm3::Incremental { seed }, Algorithm3::Flips { seed }]
            .map(|algorithm| (format!("{algorithm:?}"), Self::with_algorithm(points, algorithm)))
            .into()
    }

    fn simplices(&self) -> Simplices<3> {
        match self.dimension() {
            Dimension::Space => sorted(self.tetrahedra().map(|t| t.map(|v| self.point(v)).into())),
            Dimension::Plane => {
                sorted(self.facets().map(|f| self.mesh().facet_corners(f).map(|v| self.point(v)).into()))
            }
            _ => sorted(self.edges().map(|e| e.map(|v| self.point(v)).into())),
        }
    }

    fn place(&self, q: [f64; 3]) -> Result<Place<3>, Error> {
        let corners = |f: FacetId| self.mesh().facet_corners(f).map(|v| self.point(v)).to_vec();
        Ok(match self.locate(q)? {
            Location3::Tetrahedron(t) => Place::Inside(self.mesh().corners(t).map(|v| self.point(v)).into()),
            Location3::Facet(f) => Place::Inside(corners(f)),
            Location3::Edge(ends) => Place::Inside(ends.map(|v| self.point(v)).into()),
            Location3::Vertex(v) => Place::Inside(vec![self.point(v)]),
            Location3::Outside(f) => Place::Outside(corners(f)),
            Location3::LowerDimensional(_) => Place::Nowhere,
        })
    }

    fn rectangle(&self, _: [f64; 3], _: [f64; 3]) -> Option<Result<Vec<VertexId>, Error>> {
        None
    }
}
