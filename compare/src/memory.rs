//! Peak memory of one engine on one set: a fresh process builds once and compares its resident peak with what
//! was resident before (Linux).

use std::fs;
use std::process::Command;

use delone_oracle::generate::Kind;

use crate::engines::ENGINES;

/// The variable that makes the program a measuring child.
pub const CHILD: &str = "DELONE_COMPARE_CHILD";

fn status(field: &str) -> Option<f64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with(field))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// The child: `engine kind n`; prints bytes per point above the input.
pub fn child(task: &str) -> Option<()> {
    let mut words = task.split(' ');
    let engine = ENGINES.iter().find(|e| Some(e.name) == words.clone().next())?;
    words.next();
    let kind = Kind::named(words.next()?)?;
    let n: usize = words.next()?.parse().ok()?;
    let points = kind.points(n, 1);
    fs::write("/proc/self/clear_refs", "5").ok()?;
    let before = status("VmRSS")?;
    (engine.run)(&points, false).ok()?;
    let peak = status("VmHWM")?;
    println!("{}", (peak - before) / n as f64);
    Some(())
}

/// Bytes per point above the engine's own copy of the input, or nothing where that cannot be measured.
pub fn peak(engine: &str, kind: Kind, n: usize) -> Option<f64> {
    let program = std::env::current_exe().ok()?;
    let output = Command::new(program).env(CHILD, format!("{engine} {} {n}", kind.name())).output().ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}
