//! Runs: points become tiles on disk.
//!
//! Two passes over the input: one counts and draws the sample that the cuts are taken from, one puts each point into the bucket of its
//! tile. Then tiles, by several workers, then seams. Every file gets its name when it is whole, and the border of a node is written
//! last, so whatever has a border is done, and a run that was killed goes on from there.

use std::fs;
use std::path::{Path, PathBuf};

use delone::surface::Duplicates;
use delone::tiles::{Cuts, Fingerprint, Node};
use delone_io::{Cloud, TemporaryFolder, followed, sync_folder};

use crate::buckets::{self, Buckets};
use crate::budget::Budget;
use crate::error::{Difference, Error};
use crate::input::{Files, Input};
use crate::manifest::{self, Manifest, Outcome};
use crate::node::{self, Done};
use crate::seams::Joins;
use crate::store::Store;
use crate::sums::Written;
use crate::watch::{Phase, Watch};
use crate::{neighbors, triangulate, trust};

/// The memory that a run may take, if nobody says: one gibibyte.
const MEMORY: u64 = 1 << 30;

/// A run that makes a folder of tiles, or goes on with one.
///
/// ```
/// use delone_store::{Build, Files};
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("points.csv");
/// std::fs::write(&path, "0,0\n4,0\n4,4\n0,4\n2,1\n")?;
/// let tiles = folder.path().join("tiles");
/// let (store, _) = Build::new().memory(64 << 20).run(&Files::new([&path])?, &tiles, &())?;
/// assert_eq!((store.summary().points, store.summary().triangles), (5, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg_attr(feature = "parquet", expect(clippy::struct_excessive_bools, reason = "each is an option"))]
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Build {
    /// The bytes that may be taken, from 64 MiB on: they decide how many tiles there are.
    pub memory: u64,
    /// The tiles that are triangulated at once, each on its share of threads and memory; as many as threads, if nobody says.
    pub workers: Option<usize>,
    /// Whether the heights of the points are kept.
    pub heights: bool,
    /// Which height counts where points are equal.
    pub duplicates: Duplicates,
    /// The most points of a tile, instead of as many as memory allows.
    pub tile: Option<usize>,
    /// Whether a run that was stopped goes on.
    pub resume: bool,
    /// Whether the triangles across each edge are written too.
    pub neighbors: bool,
    /// Whether tables in Parquet are written too.
    #[cfg(feature = "parquet")]
    pub tables: bool,
    /// Files that must not be in the folder, beside those of the input.
    pub apart: Vec<PathBuf>,
}

impl Default for Build {
    fn default() -> Self {
        Self {
            memory: MEMORY,
            workers: None,
            heights: false,
            duplicates: Duplicates::First,
            tile: None,
            resume: false,
            neighbors: false,
            #[cfg(feature = "parquet")]
            tables: false,
            apart: Vec::new(),
        }
    }
}

impl Build {
    /// A new folder, in one gibibyte, without heights.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets [`Self::memory`].
    #[must_use]
    pub fn memory(self, memory: u64) -> Self {
        Self { memory, ..self }
    }

    /// Sets [`Self::workers`].
    #[must_use]
    pub fn workers(self, workers: impl Into<Option<usize>>) -> Self {
        Self { workers: workers.into(), ..self }
    }

    /// Sets [`Self::heights`].
    #[must_use]
    pub fn heights(self, heights: bool) -> Self {
        Self { heights, ..self }
    }

    /// Sets [`Self::duplicates`].
    #[must_use]
    pub fn duplicates(self, duplicates: Duplicates) -> Self {
        Self { duplicates, ..self }
    }

    /// Sets [`Self::tile`].
    #[must_use]
    pub fn tile(self, tile: impl Into<Option<usize>>) -> Self {
        Self { tile: tile.into(), ..self }
    }

    /// Sets [`Self::resume`].
    #[must_use]
    pub fn resume(self, resume: bool) -> Self {
        Self { resume, ..self }
    }

    /// Sets [`Self::neighbors`].
    #[must_use]
    pub fn neighbors(self, neighbors: bool) -> Self {
        Self { neighbors, ..self }
    }

    /// Sets [`Self::tables`].
    #[cfg(feature = "parquet")]
    #[must_use]
    pub fn tables(self, tables: bool) -> Self {
        Self { tables, ..self }
    }

    /// Sets [`Self::apart`].
    #[must_use]
    pub fn apart(self, apart: Vec<PathBuf>) -> Self {
        Self { apart, ..self }
    }

    /// Makes the folder, or goes on with it. Returns the store, and the remarks of the files, which are
    /// empty where a resumed run did not read them again.
    ///
    /// # Errors
    /// Those of the request, of files and of points. Whatever was done by then is found by a resumed run.
    pub fn run(&self, files: &Files, folder: &Path, watch: &dyn Watch) -> Result<(Store, Cloud), Error> {
        let workers = self.workers.unwrap_or_else(rayon::current_num_threads);
        let budget = Budget::new(self.memory, workers, self.tile)?;
        let input = Input::new(files, self.heights, watch)?;
        let _lock = lock(folder)?;
        let begun = begin(folder, self.resume)?;
        keep_out(folder, files.paths.iter().chain(&self.apart).map(PathBuf::as_path))?;
        let run = Run { folder, budget, rule: self.duplicates, watch };
        let mut about = Cloud::default();
        let mut plan = if let Some(plan) = begun {
            check_input(&plan, &input, folder)?;
            trust::check(folder, &plan, watch)?;
            plan
        } else {
            let (plan, told) = run.survey(&input)?;
            about = told;
            plan
        };
        watch.stage("read");
        if plan.outcome.is_none() {
            if plan.buckets.is_none() {
                run.distribute(&mut plan, &input)?;
            }
            watch.stage("distribute");
            run.triangulate(&plan)?;
            watch.stage("build");
            run.finish(&mut plan)?;
            watch.stage("join");
        } else {
            watch.was_done();
        }
        clean(folder, &plan);
        if self.neighbors {
            add(folder, &mut plan, watch, neighbors::write)?;
            watch.stage("neighbors");
        }
        #[cfg(feature = "parquet")]
        if self.tables {
            add(folder, &mut plan, watch, crate::tables::write)?;
            watch.stage("tables");
        }
        Ok((Store::of(folder, plan)?, about))
    }
}

/// Writes more files of all nodes, and then what is known of them.
fn add(
    folder: &Path,
    plan: &mut Manifest,
    watch: &dyn Watch,
    write: impl Fn(&Path, &Manifest, &Outcome, &dyn Watch) -> Result<Written, Error>,
) -> Result<(), Error> {
    let Some(mut outcome) = plan.outcome.take() else { return Ok(()) };
    let written = write(folder, plan, &outcome, watch)?;
    outcome.extend(written);
    plan.outcome = Some(outcome);
    plan.write(folder)
}

/// Keeps other runs out of a folder, where its file system can: two would write the same buckets. It ends with the process.
fn lock(folder: &Path) -> Result<Option<fs::File>, Error> {
    _ = fs::create_dir_all(folder);
    if !folder.is_dir() {
        return Ok(None);
    }
    let Ok(file) = fs::File::open(folder) else { return Ok(None) };
    match file.try_lock() {
        Err(fs::TryLockError::WouldBlock) => Err(Error::Locked { folder: folder.to_owned() }),
        _ => Ok(Some(file)),
    }
}

/// Refuses other files in a folder of tiles: they might be files of it, or become some.
///
/// # Errors
/// [`Error::Inside`] with the first that is.
pub fn keep_out<'a>(folder: &Path, others: impl IntoIterator<Item = &'a Path>) -> Result<(), Error> {
    let place = |folder: &Path| {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        folder.canonicalize().ok()
    };
    let here = place(folder);
    let inside = |path: &&Path| {
        let path = followed(path).unwrap_or_else(|_| path.to_path_buf());
        here.is_some() && path.parent().and_then(place) == here && path != Path::new("-")
    };
    match others.into_iter().find(inside) {
        Some(path) => Err(Error::Inside { path: path.to_owned() }),
        None => Ok(()),
    }
}

/// Makes the folder, or finds what is in it.
fn begin(folder: &Path, resume: bool) -> Result<Option<Manifest>, Error> {
    let failed = |error: std::io::Error| Error::Folder { folder: folder.to_owned(), error };
    fs::create_dir_all(folder).map_err(failed)?;
    // Its own name too, where the folder that it is in may be read.
    let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty());
    _ = sync_folder(parent.unwrap_or(Path::new(".")));
    if resume {
        // What a run that was killed had half written goes.
        _ = TemporaryFolder::create(folder);
    }
    let is_empty = fs::read_dir(folder).map_err(failed)?.next().is_none();
    if is_empty {
        return Ok(None);
    }
    let plan = Manifest::read(folder)?;
    let folder = folder.to_owned();
    match (resume, plan) {
        (false, None) => Err(Error::NotEmpty { folder }),
        (false, Some(_)) => Err(Error::HasTiles { folder }),
        (true, None) => Err(Error::NothingToResume { folder }),
        (true, Some(plan)) => Ok(Some(plan)),
    }
}

/// Refuses to go on with other files, or with the same ones read in another way.
fn check_input(plan: &Manifest, input: &Input, folder: &Path) -> Result<(), Error> {
    let now = input.describe()?;
    if now == plan.input {
        return Ok(());
    }
    let difference = if now["files"] == plan.input["files"] {
        Difference::Options
    } else if names(&now["files"]) == names(&plan.input["files"]) {
        Difference::Changed
    } else {
        Difference::Files
    };
    Err(Error::OtherInput { difference, folder: folder.to_owned() })
}

fn names(files: &serde_json::Value) -> Vec<&serde_json::Value> {
    files.as_array().into_iter().flatten().map(|file| &file["file"]).collect()
}

/// A run in a folder.
struct Run<'a> {
    folder: &'a Path,
    budget: Budget,
    /// Which height counts where points are equal.
    rule: Duplicates,
    watch: &'a dyn Watch,
}

impl Run<'_> {
    /// Counts the points and cuts the plane; says what the files tell besides.
    fn survey(&self, input: &Input) -> Result<(Manifest, Cloud), Error> {
        let described = input.describe()?;
        let (count, sample, about) = input.survey(self.budget.sample())?;
        let cuts = Cuts::from_sample(&sample, self.budget.tiles(count));
        let cuts = cuts.map_err(|error| Error::points(self.folder, error))?;
        let has_heights = described["heights"] == true;
        let plan = Manifest {
            input: described,
            count,
            has_heights,
            cuts,
            system: about.crs.as_ref().and_then(|crs| crs.known_name().or_else(|| crs.name.clone())),
            buckets: None,
            left_out: 0,
            outcome: None,
        };
        plan.write(self.folder)?;
        Ok((plan, about))
    }

    /// Puts every point into the bucket of its tile.
    fn distribute(&self, plan: &mut Manifest, input: &Input) -> Result<(), Error> {
        let (folder, budget) = (self.folder, &self.budget);
        // An earlier run may have stopped while it filled buckets: its buckets and borders cannot be trusted.
        buckets::remove_all(folder);
        node::remove_all(folder);
        let has_heights = plan.has_heights;
        let buffer = budget.buffer(plan.cuts.tiles().len());
        let mut buckets = Buckets::new(folder, &plan.cuts, Node::ROOT, has_heights, buffer)?;
        let mut count = 0;
        input.read_again("distributing", &mut |_, first, points, heights| {
            count += points.len() as u64;
            buckets.take(first, points, heights)
        })?;
        let mut counts = buckets.finish()?;
        let is_same = input.describe()? == plan.input;
        if count != plan.count && is_same {
            let path = folder.join(manifest::NAME);
            return Err(Error::CountDiffers { path, known: plan.count, count });
        }
        if !is_same {
            return Err(Error::InputChanged { count, before: plan.count });
        }
        let heights = (has_heights, self.rule);
        let (cuts, most) = (&mut plan.cuts, budget.most());
        plan.left_out = buckets::cut_again(folder, cuts, &mut counts, heights, most, buffer)?;
        plan.buckets = Some(counts);
        plan.write(folder)
    }

    /// Triangulates all tiles that are not done.
    fn triangulate(&self, plan: &Manifest) -> Result<(), Error> {
        let folder = self.folder;
        let mut open = Vec::new();
        for (&node, &filled) in plan.buckets.iter().flatten() {
            if let Some(done) = Done::find(folder, node)? {
                done.check_points(folder, filled.points)?;
            } else {
                buckets::check(folder, node, filled.points, plan.has_heights)?;
                open.push((node, filled));
            }
        }
        let Some(&(largest, filled)) = open.iter().max_by_key(|&&(_, filled)| filled.points) else {
            return Ok(());
        };
        let workers = self.budget.workers(filled.points, &buckets::bucket(folder, largest))?;
        triangulate::all(folder, &plan.cuts, &open, (plan.has_heights, self.rule), workers, self.watch)
    }

    /// Joins all borders, and adds up what there is.
    fn finish(&self, plan: &mut Manifest) -> Result<(), Error> {
        let (folder, cuts) = (self.folder, &plan.cuts);
        let phase = Phase::start(self.watch, "joining");
        let joins = Joins { folder, cuts, budget: &self.budget, count: plan.count, phase };
        let root = joins.settle(Node::ROOT)?;
        let mut nodes = Vec::new();
        let mut waiting = vec![Node::ROOT];
        let (mut fingerprint, mut vertices, mut duplicates) = (Fingerprint::default(), 0, plan.left_out);
        while let Some(node) = waiting.pop() {
            waiting.extend(cuts.halves(node).into_iter().flatten().rev());
            let Some(done) = Done::find(folder, node)? else { continue };
            let of_bucket = plan.buckets.as_ref().and_then(|buckets| buckets.get(&node));
            done.check_points(folder, of_bucket.map_or(0, |filled| filled.points))?;
            fingerprint += done.fingerprint;
            vertices += done.vertices;
            duplicates += done.duplicates;
            nodes.push(done.describe());
        }
        let (triangles, hull) = (fingerprint.count(), root.border);
        let is_whole = triangles + hull + 2 == 2 * vertices || triangles == 0 && hull == vertices;
        if vertices + duplicates != plan.count || !is_whole {
            let (folder, points) = (folder.to_owned(), plan.count);
            return Err(Error::NotWhole { folder, vertices, duplicates, triangles, hull, points });
        }
        plan.outcome = Some(Outcome { fingerprint, vertices, duplicates, hull, nodes });
        plan.write(folder)
    }
}

/// Removes what nobody needs any more.
fn clean(folder: &Path, plan: &Manifest) {
    let nodes = plan.outcome.iter().flat_map(|outcome| &outcome.nodes);
    nodes.filter_map(Done::parse).for_each(|done| node::forget(folder, done.node));
    if plan.outcome.is_some() {
        buckets::remove_all(folder);
    }
}
