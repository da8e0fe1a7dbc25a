//! One measurement in a process of its own: peers crash, some never end, and peak memory is a process's.
//!
//! The folder that the child works in has the input as arrays: `points.npy`, `segments.npy`, `holes.npy`. It prints seconds,
//! bytes of peak memory above the input, vertices and triangles, and how many of these it says are not refined if it says so;
//! or why there is nothing. It leaves `vertices.npy` and `triangles.npy` if it should.

use std::env;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use delone_io::{Format, ReadOptions};

use super::engines::{ENGINES, Engine, Refined, Run, Task};
use super::input::Input;
use super::judge::Mesh;
use crate::memory::{CHILD, above};

/// A measurement.
#[derive(Clone, Copy)]
pub struct Sample {
    pub seconds: f64,
    pub bytes: f64,
    pub vertices: usize,
    pub triangles: usize,
    /// The triangles that the engine says it could not refine.
    pub left: Option<usize>,
}

/// Seconds that runs of a small input are repeated for, in one child.
const MINIMUM: f64 = 0.05;

/// The exit status that says that a peer is not installed.
const NOT_INSTALLED: i32 = 3;

/// Below so many points runs are repeated in one child, and the kernel would be most of the time of some: whether the C library
/// maps and unmaps memory for each run depends on what a process did before. So there it keeps what it has, for all engines.
const KEPT_MEMORY_POINTS: usize = 10_000;

/// How the C library of Linux is told to.
const KEEPING: [(&str, &str); 2] =
    [("MALLOC_MMAP_THRESHOLD_", "1000000000"), ("MALLOC_TRIM_THRESHOLD_", "1000000000")];

/// A folder for the arrays of an input, gone when it is dropped.
pub struct Folder {
    path: PathBuf,
    is_small: bool,
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left of a temporary folder is the system's to clear.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

impl Folder {
    /// With the input in it.
    pub fn of(input: &Input) -> Result<Self, String> {
        let path = env::temp_dir().join(format!("delone-compare-{}", std::process::id()));
        let folder = Self { path, is_small: input.points.len() < KEPT_MEMORY_POINTS };
        std::fs::create_dir_all(&folder.path).map_err(|error| error.to_string())?;
        write_points(&folder.path, "points.npy", &input.points)?;
        write_points(&folder.path, "holes.npy", &input.holes)?;
        write_rows(&folder.path, "segments.npy", &input.segments)?;
        Ok(folder)
    }

    /// Runs an engine for at most so long. What is in brackets is no failure.
    pub fn measure(
        &self,
        engine: &Engine,
        angle: f64,
        is_hull: bool,
        writes: bool,
        python: &Path,
        limit: Duration,
    ) -> Result<Sample, String> {
        let mut command = if engine.run.is_some() {
            let mut command = Command::new(env::current_exe().map_err(|error| error.to_string())?);
            command.env(CHILD, format!("mesh {} {angle} {is_hull} {writes}", engine.name));
            command
        } else {
            let mut command = Command::new(python);
            let script = concat!(env!("CARGO_MANIFEST_DIR"), "/with_triangle_mesh.py");
            let options = if writes { &["--write"] as &[&str] } else { &[] };
            command.args([OsStr::new(script), angle.to_string().as_ref(), MINIMUM.to_string().as_ref()]);
            command.args(options);
            command
        };
        command.current_dir(&self.path).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        if self.is_small {
            command.envs(KEEPING);
        }
        let Ok(mut child) = command.spawn() else { return Err("(not installed)".to_owned()) };
        let status = wait(&mut child, limit)?;
        let mut said = String::new();
        if let Some(mut out) = child.stdout.take() {
            out.read_to_string(&mut said).map_err(|error| error.to_string())?;
        }
        match status.code() {
            Some(0) => sample(&said).ok_or_else(|| said.trim().to_owned()),
            Some(NOT_INSTALLED) if engine.run.is_none() => Err("(not installed)".to_owned()),
            Some(code) => Err(format!("panics or stops (status {code})")),
            None => Err(crash(status)),
        }
    }

    /// The mesh that the last child left.
    pub fn mesh(&self) -> Result<Mesh, String> {
        let rows = delone_io::read_triangles(open(&self.path, "triangles.npy")?, Format::Npy);
        let rows = rows.map_err(|error| error.to_string())?;
        Ok(Mesh {
            points: read_points(&self.path, "vertices.npy")?,
            triangles: rows.into_iter().map(|t| t.map(|i| i as usize)).collect(),
        })
    }
}

fn sample(said: &str) -> Option<Sample> {
    let words: Vec<f64> = said.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let (&[seconds, bytes, vertices, triangles], left) = words.split_first_chunk()?;
    let left = left.first().map(|&left| left as usize);
    Some(Sample { seconds, bytes, vertices: vertices as usize, triangles: triangles as usize, left })
}

fn wait(child: &mut Child, limit: Duration) -> Result<ExitStatus, String> {
    let start = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(status),
            Ok(None) if start.elapsed() < limit => sleep(Duration::from_millis(5)),
            Ok(None) => {
                child.kill().and_then(|()| child.wait()).map_err(|error| error.to_string())?;
                return Err(format!("does not end in {limit:?}"));
            }
            Err(error) => return Err(error.to_string()),
        }
    }
}

#[cfg(unix)]
fn crash(status: ExitStatus) -> String {
    use std::os::unix::process::ExitStatusExt as _;
    status.signal().map_or_else(String::new, |signal| format!("crashes (signal {signal})"))
}

#[cfg(not(unix))]
fn crash(_: ExitStatus) -> String {
    "crashes".to_owned()
}

/// The child's side: `ENGINE ANGLE IS_HULL WRITES`.
pub fn child(task: &str) -> Option<()> {
    let words: Vec<&str> = task.split(' ').collect();
    let &[name, angle, is_hull, writes] = words.as_slice() else { return None };
    let run = ENGINES.iter().find(|engine| engine.name == name)?.run?;
    let writes: bool = writes.parse().ok()?;
    let task = read_task(Path::new("."), angle.parse().ok()?, is_hull.parse().ok()?).ok()?;
    let said = match crate::engines::POOLS[0].install(|| measured(run, &task)) {
        Err(why) => why,
        Ok((Sample { seconds, bytes, vertices, triangles, left }, mesh)) => {
            if writes {
                write_points(Path::new("."), "vertices.npy", &mesh.points).ok()?;
                write_rows(Path::new("."), "triangles.npy", &mesh.triangles).ok()?;
            }
            let left = left.map_or(String::new(), |left| format!(" {left}"));
            format!("{seconds} {bytes} {vertices} {triangles}{left}")
        }
    };
    println!("{said}");
    Some(())
}

/// Memory is that of the first run, the median of the times counts.
fn measured(run: Run, task: &Task) -> Result<(Sample, Mesh), String> {
    let (refined, bytes) = above(|| run(task)).ok_or("(its memory cannot be measured here)")?;
    let Refined { time, left, mesh } = refined?;
    let mesh = mesh();
    let mut times = vec![time.as_secs_f64()];
    while times.iter().sum::<f64>() < MINIMUM {
        times.push(run(task)?.time.as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    let (vertices, triangles) = (mesh.points.len(), mesh.triangles.len());
    Ok((Sample { seconds: times[times.len() / 2], bytes, vertices, triangles, left }, mesh))
}

fn read_task(folder: &Path, angle: f64, is_hull: bool) -> Result<Task, String> {
    let segments = delone_io::read_segments(open(folder, "segments.npy")?, Format::Npy);
    Ok(Task {
        points: read_points(folder, "points.npy")?,
        segments: segments.map_err(|error| error.to_string())?,
        holes: read_points(folder, "holes.npy")?,
        is_hull,
        angle,
    })
}

fn open(folder: &Path, name: &str) -> Result<Box<BufReader<File>>, String> {
    let file = File::open(folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
    Ok(Box::new(BufReader::new(file)))
}

fn read_points(folder: &Path, name: &str) -> Result<Vec<[f64; 2]>, String> {
    let cloud = delone_io::read_points(open(folder, name)?, Format::Npy, &ReadOptions::default());
    Ok(cloud.map_err(|error| error.to_string())?.xy)
}

fn write_points(folder: &Path, name: &str, points: &[[f64; 2]]) -> Result<(), String> {
    let file = File::create(folder.join(name)).map_err(|error| error.to_string())?;
    let mut out = BufWriter::new(file);
    delone_io::write_points(&mut out, Format::Npy, points).map_err(|error| error.to_string())?;
    out.flush().map_err(|error| error.to_string())
}

fn write_rows<const N: usize>(folder: &Path, name: &str, rows: &[[usize; N]]) -> Result<(), String> {
    let file = File::create(folder.join(name)).map_err(|error| error.to_string())?;
    let mut out = BufWriter::new(file);
    let values: Vec<i64> = rows.as_flattened().iter().map(|&i| i as i64).collect();
    delone_io::write_indices(&mut out, Format::Npy, N, &values).map_err(|error| error.to_string())?;
    out.flush().map_err(|error| error.to_string())
}
