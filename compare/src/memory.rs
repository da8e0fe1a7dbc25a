//! Peak memory of one engine on one set: a fresh process builds once and compares its resident peak with what
//! was resident before (Linux).

use std::fs;
use std::process::Command;

use delone_generators::{Kind, Kind3};

use crate::engines::ENGINES;

/// The variable that makes the program a measuring child.
pub const CHILD: &str = "DELONE_COMPARE_CHILD";

/// Bytes that are resident now.
pub fn resident() -> Option<f64> {
    status("VmRSS")
}

/// The most bytes that were since the last [`forget`].
pub fn most() -> Option<f64> {
    status("VmHWM")
}

/// Forgets the most.
pub fn forget() -> Option<()> {
    fs::write("/proc/self/clear_refs", "5").ok()
}

fn status(field: &str) -> Option<f64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with(field))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// The child: `engine kind n`; prints bytes per point above the input. In space the engine is `space/NAME`. Meshes have a
/// protocol of their own.
pub fn child(task: &str) -> Option<()> {
    if let Some(task) = task.strip_prefix("mesh ") {
        return crate::mesh::child(task);
    }
    let words: Vec<&str> = task.split(' ').collect();
    let &[name, kind, n] = words.as_slice() else { return None };
    let n: usize = n.parse().ok()?;
    if let Some(name) = name.strip_prefix("space/") {
        let points = Kind3::named(kind)?.points(n, 1);
        return measured(n, || crate::space::build(name, points));
    }
    let engine = ENGINES.iter().find(|e| e.name == name)?;
    let points = Kind::named(kind)?.points(n, 1);
    measured(n, || (engine.run)(&points, false).ok().map(drop))
}

fn measured(n: usize, work: impl FnOnce() -> Option<()>) -> Option<()> {
    let (done, bytes) = above(work)?;
    done?;
    println!("{}", bytes / n as f64);
    Some(())
}

/// The result of the work, and its peak of memory in bytes above the memory resident before.
pub fn above<T>(work: impl FnOnce() -> T) -> Option<(T, f64)> {
    forget()?;
    let before = resident()?;
    let result = work();
    Some((result, most()? - before))
}

/// Bytes per point above the engine's own copy of the input, or nothing where that cannot be measured.
pub fn peak(engine: &str, kind: &str, n: usize) -> Option<f64> {
    let program = std::env::current_exe().ok()?;
    let output = Command::new(program).env(CHILD, format!("{engine} {kind} {n}")).output().ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}
