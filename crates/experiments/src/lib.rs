//! The experiments of the papers that Delone implements, with the papers' figures beside.
//!
//! An experiment is a file. It makes its sets from seeds, counts or times what a paper counted or timed, and leaves tables
//! and plots ([`Findings`]). Counts depend on the seed alone and are the same on every machine. `docs/papers.md` says which
//! experiment shows what.

mod appear;
mod brownian;
mod conflicts;
mod delaunay_tree;
mod deletion;
mod disks;
mod growth;
mod hierarchy;
mod history;
mod hull;
mod imprecise;
mod jump_and_walk;
mod order;
mod order_k;
mod phases;
mod plot;
mod radial;
mod scopes;
mod space;
mod table;
mod trials;
mod tuning;

use std::sync::Arc;
use std::time::Instant;

use rayon::ThreadPool;

pub use plot::Plot;
pub use table::{Table, Watch};

/// The findings of an experiment.
#[derive(Debug, Default)]
pub struct Findings {
    /// Tables, at least one, none of them empty.
    pub tables: Vec<Table>,
    /// Plots.
    pub plots: Vec<Plot>,
}

/// Why an experiment found nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The limit asked for is below the smallest set.
    #[error("--largest {largest} is below {smallest}, the smallest set of this experiment")]
    TooSmall {
        /// The largest set allowed.
        largest: usize,
        /// The smallest set of the experiment.
        smallest: usize,
    },
    /// Trials take the seeds that follow this one, and there would be none.
    #[error("--seed {0} is above 2^63: trials take the seeds that follow it")]
    LargeSeed(u64),
    /// The experiment needs points in space.
    #[error("this experiment needs the points of a scanned model")]
    NoModel,
    /// The model has too few points.
    #[error("{0} points are too few for an experiment")]
    SmallModel(usize),
    /// The model is so large that sums of distances, or points with noise, are not finite.
    #[error("the model is too large for noise around its points: scale it down")]
    WideModel,
    /// The library refused.
    #[error(transparent)]
    Library(#[from] delone::Error),
    /// A table without a row: a bug.
    #[error("the table {0} is empty")]
    EmptyTable(String),
}

/// How large and how often.
#[derive(Debug)]
pub struct Options<'a> {
    /// The largest set.
    pub largest: usize,
    /// How often each count or time is taken, from other points and other seeds; tables give mean and standard error.
    pub trials: usize,
    /// Seed of points and orders.
    pub seed: u64,
    /// The points of a scanned model.
    pub model: &'a [[f64; 3]],
    /// All threads that may be used, by the one experiment that does.
    pub threads: &'a ThreadPool,
    /// Who is told of each row as soon as it is there.
    pub watch: Option<Arc<dyn Watch>>,
}

impl Options<'_> {
    /// A table without a row.
    fn table(&self, name: &str, title: &str, heads: &[&str]) -> Table {
        Table::new(name, title, heads, self.watch.clone())
    }

    /// The seeds of the trials.
    fn seeds(&self) -> std::ops::Range<u64> {
        self.seed..self.seed + self.trials as u64
    }

    /// The smallest set, which is soon counted again, and the largest up to `most`.
    fn ends(&self, smallest: usize, most: usize) -> impl Iterator<Item = usize> {
        let largest = self.largest.min(most);
        std::iter::once(smallest).chain((largest > smallest).then_some(largest))
    }
}

type Run = fn(&Options<'_>) -> Result<Findings, Error>;

/// An experiment by its name.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Its name.
    pub name: &'static str,
    /// A line about it.
    pub about: &'static str,
    /// The smallest `largest` with which no table is empty.
    pub smallest: usize,
    run: Run,
}

/// All experiments.
pub const EXPERIMENTS: &[Experiment] = &[
    Experiment {
        name: "scopes",
        about: "Which triangles, edges and tetrahedra ever appear, by the points in their circles, simulated and computed \
                (Guibas, Knuth & Sharir 1992, §2, §4.2 and §4.3)",
        smallest: 100,
        run: scopes::run,
    },
    Experiment {
        name: "order",
        about: "What the order of insertion does: bad orders, variance, adding to a set, sorting (the same, \
                §2.1, §2.3 and §3)",
        smallest: 100,
        run: order::run,
    },
    Experiment {
        name: "conflicts",
        about: "The equations of the analysis of conflict lists, step by step (lecture notes)",
        smallest: 100,
        run: conflicts::run,
    },
    Experiment {
        name: "history",
        about: "What ever appears in randomized incremental construction, and what locating costs (Guibas, Knuth & Sharir \
                1992, §2 and §3)",
        smallest: 100,
        run: history::run,
    },
    Experiment {
        name: "delaunay-tree",
        about: "The Delaunay tree in the plane and in space: size and searches, also after removals (the same, §3)",
        smallest: 100,
        run: delaunay_tree::run,
    },
    Experiment {
        name: "hull",
        about: "Hulls in space in random order: facets that ever were, and what locating costs (the same, §4.1)",
        smallest: 100,
        run: hull::run,
    },
    Experiment {
        name: "order-k",
        about: "Voronoi diagrams of higher order: regions, circles, k-sets, pairs of sites in one region, time (the same, §4.2)",
        smallest: 100,
        run: order_k::run,
    },
    Experiment {
        name: "history-in-space",
        about: "What ever appears in space, and flips that trace each point through it (the same, §4.3)",
        smallest: 100,
        run: space::run,
    },
    Experiment {
        name: "radial",
        about: "Nearest sites by the history of radial triangles: size, work of a query, time beside other ways (the same, \
                §5)",
        smallest: 1000,
        run: radial::run,
    },
    Experiment {
        name: "hierarchy",
        about: "Build five kinds of sets with the Delaunay hierarchy and its simpler modes (Devillers 1998, §5.5.2)",
        smallest: 5000,
        run: hierarchy::run,
    },
    Experiment {
        name: "tuning",
        about: "What a level of the hierarchy costs, by phase and by the ratio between levels; crossovers; a set that misleads \
                (the same, §3, §4 and appendix)",
        smallest: 1000,
        run: tuning::run,
    },
    Experiment {
        name: "deletion",
        about: "What removing random vertices costs, with and without a hierarchy (the same, §5.1)",
        smallest: 1000,
        run: deletion::run,
    },
    Experiment {
        name: "jump-and-walk",
        about: "Triangles visited by jump-and-walk, and its cost against the sample size (Devroye, Mücke & Zhu 1998)",
        smallest: 1000,
        run: jump_and_walk::run,
    },
    Experiment {
        name: "imprecise",
        about: "Triangulate instances of imprecise points by hints, in the plane and in space (Devillers 2011, §5)",
        smallest: 10_000,
        run: imprecise::run,
    },
    Experiment {
        name: "disks",
        about: "What the analysis of hints counts, and disks that overlap, differ or mislead (the same, §4 and §6)",
        smallest: 1000,
        run: disks::run,
    },
    Experiment {
        name: "brownian",
        about: "Follow points in Brownian motion by the hints of the last step (the same), and automatically",
        smallest: 1000,
        run: brownian::run,
    },
    Experiment {
        name: "scan",
        about: "Add noise to the points of a scanned model, and triangulate by hints (the same); takes a file",
        smallest: 100,
        run: imprecise::scan,
    },
    Experiment {
        name: "growth",
        about: "Time of a construction by the number of points, in the plane on one thread and on all, and in space",
        smallest: 1000,
        run: growth::run,
    },
];

impl Experiment {
    /// The experiment of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        EXPERIMENTS.iter().find(|experiment| experiment.name == name)
    }

    /// Whether it takes the points of a model.
    pub fn takes_model(&self) -> bool {
        self.name == "scan"
    }

    /// Does it.
    pub fn run(&self, options: &Options<'_>) -> Result<Findings, Error> {
        let (largest, smallest) = (options.largest, self.smallest);
        if largest < smallest {
            return Err(Error::TooSmall { largest, smallest });
        }
        if options.seed > 1 << 63 {
            return Err(Error::LargeSeed(options.seed));
        }
        if self.takes_model() && options.model.is_empty() {
            return Err(Error::NoModel);
        }
        let findings = (self.run)(options)?;
        match findings.tables.iter().find(|table| table.is_empty()) {
            Some(table) => Err(Error::EmptyTable(table.name.clone())),
            None => Ok(findings),
        }
    }
}

/// Sizes from `first` on, each three or ten thirds times the one before, up to `largest`.
fn sizes(first: usize, largest: usize) -> impl Iterator<Item = usize> {
    let next = |n: &usize| Some(if n.to_string().starts_with('1') { n * 3 } else { n / 3 * 10 });
    std::iter::successors(Some(first), next).take_while(move |&n| n <= largest)
}

/// Powers of ten from `first` on, up to `largest`.
fn decades(first: usize, largest: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(first), |n| n.checked_mul(10)).take_while(move |&n| n <= largest)
}

/// The result of a piece of work, and its seconds.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}
