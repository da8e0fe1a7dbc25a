//! A folder of tiles that is done, and how far one is that is not.

use std::path::{Path, PathBuf};

use delone::tiles::{Cuts, Fingerprint, Node};
use delone_io::Crs;

use crate::error::Error;
use crate::manifest::{self, Manifest, Outcome};
use crate::node::Done;
use crate::places::place;
use crate::shards;

/// A point with its height, or zero.
pub type Corner = ([f64; 2], f64);

/// The counts of a folder that is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Summary {
    /// The points of the input.
    pub points: u64,
    /// Those that equal an earlier one.
    pub duplicates: u64,
    /// The points that differ.
    pub vertices: u64,
    /// The triangles of tiles and seams.
    pub triangles: u64,
    /// The triangles of seams alone.
    pub of_seams: u64,
    /// The vertices of the hull.
    pub hull: u64,
    /// The fingerprint of the set of triangles.
    pub fingerprint: Fingerprint,
    /// The tiles.
    pub tiles: usize,
    /// The joins of tiles: seams.
    pub joins: usize,
    /// The points of the borders of tiles.
    pub border: u64,
}

/// How far a folder is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum State {
    /// Points are counted, and not in the buckets of their tiles.
    Planned,
    /// Points are in their buckets, and some tiles done.
    Distributed {
        /// The tiles that are done.
        done: usize,
    },
    /// All is done.
    Done(Summary),
}

/// The description of a folder, done or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Description {
    /// The points of the input.
    pub points: u64,
    /// Whether heights are kept.
    pub heights: bool,
    /// The tiles.
    pub tiles: usize,
    /// How far it is.
    pub state: State,
}

/// Tells what a folder has, and how far it is.
///
/// # Errors
/// [`Error::NoTiles`], and those of `tiles.json`.
pub fn describe(folder: &Path) -> Result<Description, Error> {
    let plan = Manifest::read(folder)?.ok_or_else(|| manifest::no_tiles(folder))?;
    let tiles = plan.cuts.tiles();
    let state = match (&plan.outcome, &plan.buckets) {
        (Some(outcome), _) => State::Done(summary(&plan, outcome)),
        (None, Some(_)) => {
            let mut done = 0;
            for &tile in &tiles {
                done += usize::from(Done::find(folder, tile)?.is_some());
            }
            State::Distributed { done }
        }
        (None, None) => State::Planned,
    };
    Ok(Description { points: plan.count, heights: plan.has_heights, tiles: tiles.len(), state })
}

fn summary(plan: &Manifest, outcome: &Outcome) -> Summary {
    let nodes: Vec<Done> = outcome.nodes.iter().filter_map(Done::parse).collect();
    let of_tiles = || nodes.iter().filter(|done| plan.cuts.halves(done.node).is_none());
    let tiles = plan.cuts.tiles().len();
    let in_tiles: u64 = of_tiles().map(|done| done.fingerprint.count()).sum();
    Summary {
        points: plan.count,
        duplicates: outcome.duplicates,
        vertices: outcome.vertices,
        triangles: outcome.triangles(),
        of_seams: outcome.triangles() - in_tiles,
        hull: outcome.hull,
        fingerprint: outcome.fingerprint,
        tiles,
        joins: nodes.len() - tiles,
        border: of_tiles().map(|done| done.border).sum(),
    }
}

/// A folder of tiles that is done.
///
/// ```no_run
/// use delone_store::Store;
///
/// let store = Store::open("tiles")?;
/// store.verify(&())?;
/// for node in store.cuts().tiles() {
///     let (points, triangles) = (store.points(node)?, store.triangles(node)?);
///     assert!(triangles.iter().flatten().all(|&v| (v as usize) < points.len()));
/// }
/// # Ok::<(), delone_store::Error>(())
/// ```
#[derive(Debug)]
pub struct Store {
    pub(crate) folder: PathBuf,
    pub(crate) plan: Manifest,
    pub(crate) outcome: Outcome,
}

impl Store {
    /// Opens a folder.
    ///
    /// # Errors
    /// [`Error::NoTiles`], [`Error::Unfinished`], and those of `tiles.json`.
    pub fn open(folder: impl AsRef<Path>) -> Result<Self, Error> {
        let folder = folder.as_ref();
        let (plan, outcome) = manifest::finished(folder)?;
        Ok(Self { folder: folder.to_owned(), plan, outcome })
    }

    pub(crate) fn of(folder: &Path, mut plan: Manifest) -> Result<Self, Error> {
        let unfinished = || Error::Unfinished { folder: folder.to_owned() };
        let outcome = plan.outcome.take().ok_or_else(unfinished)?;
        Ok(Self { folder: folder.to_owned(), plan, outcome })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Its counts.
    pub fn summary(&self) -> Summary {
        summary(&self.plan, &self.outcome)
    }

    /// The cuts of the plane into tiles.
    pub fn cuts(&self) -> &Cuts {
        &self.plan.cuts
    }

    /// Whether points have heights.
    pub fn has_heights(&self) -> bool {
        self.plan.has_heights
    }

    /// The system of coordinates, where the input told it.
    pub fn crs(&self) -> Option<Crs> {
        self.plan.crs()
    }

    /// The points of a tile, along a curve, with their heights, or zeros.
    ///
    /// # Errors
    /// [`Error::Changed`] if the file is not there or wrong.
    pub fn points(&self, tile: Node) -> Result<Vec<Corner>, Error> {
        let cloud = shards::points(&self.folder, tile)?;
        let heights = cloud.z.unwrap_or_else(|| vec![0.0; cloud.xy.len()]);
        Ok(cloud.xy.into_iter().zip(heights).collect())
    }

    /// The triangles of a tile, counter-clockwise, as indices of its points.
    ///
    /// # Errors
    /// As [`Self::points`].
    pub fn triangles(&self, tile: Node) -> Result<Vec<[u64; 3]>, Error> {
        shards::triangles(&place(&self.folder, "triangles", tile, "npy"))
    }

    /// The nodes that have a file: tiles, and seams.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = Done> {
        self.outcome.nodes.iter().filter_map(Done::parse)
    }
}
