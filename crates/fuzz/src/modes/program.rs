//! The whole program on mutated files, with little memory and few threads, some runs killed at a random moment. It ends with 0, 1 or 2 and, where
//! it fails, with one error, one line of help and no output; it leaves its inputs alone; what a killed run left under the name of an
//! output is a whole output; nothing else stays in the folder once another run has ended.
//!
//! The program is `delone` beside this one, as `cargo test --workspace` leaves it, or the one that `DELONE` names.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Duration;

use delone_generators::Random;

use super::files::{self, GROUPS, Mutation};
use crate::attack::{Attack, Judgement};

/// Virtual memory of a run, in KiB: 400 MB hold all that 40 points need, and threads.
const MEMORY: u32 = 400_000;
/// One run in so many is killed.
const KILLED: usize = 8;
/// The longest wait before, in microseconds: a run on 40 points takes 3 to 30 milliseconds.
const LONGEST_WAIT: usize = 30_000;

/// Commands, IN for the input.
const COMMANDS: [&str; 20] = [
    "info IN",
    "triangulate IN -o OUT.npy -o OUT.ply",
    "triangulate IN --dim 3 -o OUT.vtu",
    "voronoi IN -o OUT.geojson",
    "mesh IN -o OUT.vtu --max-vertices 1000",
    "polygons IN -o OUT.geojson",
    "check IN IN",
    "dtm IN --all-classes -o OUT.tif -o OUT.asc",
    "dtm IN --memory 64M -o OUT.tif",
    "contours IN -o OUT.geojson",
    "simplify IN --max-vertices 10 -o OUT.ply",
    "alpha IN -o OUT.ply",
    "hull IN -o OUT.csv",
    "graph IN --kind gabriel -o OUT.csv",
    "nearest IN --queries IN -o OUT.csv",
    "locate IN --queries IN -o OUT.npy",
    "voronoi IN --clip IN -o OUT.wkb",
    "draw IN -o OUT.svg",
    "tiles IN -o OUT",
    "furthest IN --queries IN -o OUT.csv",
];

pub(crate) struct Program;

impl Attack for Program {
    type Item = Mutation;

    fn make(random: &mut Random) -> Vec<Mutation> {
        files::some(random)
    }

    fn judge(mutations: &[Mutation], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let group = random.below(GROUPS);
        let (format, bytes) = files::mutated(group, mutations, random.bits());
        let line = COMMANDS[random.below(COMMANDS.len())];
        let threads = 1 + random.below(3);
        let wait =
            (random.below(KILLED) == 0).then(|| Duration::from_micros(random.below(LONGEST_WAIT) as u64));
        let folder = Folder::new()?;
        let input = format!("in.{format}");
        fs::write(folder.0.join(&input), &bytes).map_err(|error| error.to_string())?;
        let line = format!("-q --threads {threads} {}", line.replace("IN", &input).replace("OUT", "out"));
        judge(&folder.0, &input, &bytes, &line, wait).map_err(|what| format!("delone {line}: {what}"))
    }
}

fn judge(folder: &Path, input: &str, bytes: &[u8], line: &str, wait: Option<Duration>) -> Judgement {
    let mut killed = Vec::new();
    if let Some(wait) = wait {
        let mut child = start(folder, line)?.spawn().map_err(|error| error.to_string())?;
        thread::sleep(wait);
        // It may have ended by itself.
        _ = child.kill();
        child.wait().map_err(|error| error.to_string())?;
        killed = contents(folder)?;
        for (name, _) in killed.iter().filter(|(name, _)| name == "out" && folder.join(name).is_dir()) {
            fs::remove_dir_all(folder.join(name)).map_err(|error| error.to_string())?;
        }
    }
    let output = start(folder, line)?.output().map_err(|error| error.to_string())?;
    let is_done = ended(&output)?;
    let after = contents(folder)?;
    let found = |name: &str| after.iter().find(|entry| entry.0 == name).map(|entry| &entry.1);
    if found(input).is_none_or(|now| now != bytes) {
        return Err("the input is not what it was".to_owned());
    }
    // Of a killed run there are whole outputs or none; a run that fails leaves those of the runs before.
    for (name, before) in killed.iter().filter(|(name, _)| name.starts_with("out.")) {
        if is_done && found(name) != Some(before) {
            return Err(format!("a killed run left a part of {name}"));
        }
    }
    // A folder of tiles stays, for --resume.
    let may_stay = |name: &str| {
        let is_output = name == "out" || is_done && name.starts_with("out.");
        name == input || is_output || killed.iter().any(|entry| entry.0 == name)
    };
    match after.iter().find(|entry| !may_stay(&entry.0)) {
        Some((name, _)) => Err(format!("{name} is left")),
        None => Ok(()),
    }
}

/// Whether a run did what it was asked for; or what is wrong with its end.
fn ended(output: &Output) -> Result<bool, String> {
    let told = String::from_utf8_lossy(&output.stderr);
    let end = || told.chars().rev().take(300).collect::<String>().chars().rev().collect::<String>();
    match output.status.code() {
        Some(0) if told.contains("panicked") => Err(format!("a panic: {}", end())),
        Some(0) => Ok(true),
        Some(1 | 2) => {
            let lines: Vec<&str> = told
                .lines()
                .filter(|line| !line.starts_with("note: ") && !line.starts_with("warning: "))
                .collect();
            let is_told = matches!(lines[..], [error, help] if error.starts_with("error: ") && help.starts_with("help: "));
            if is_told { Ok(false) } else { Err(format!("it fails and says {:?}", end())) }
        }
        _ => Err(format!("{}: {}", output.status, end())),
    }
}

fn start(folder: &Path, line: &str) -> Result<Command, String> {
    let program = match env::var_os("DELONE") {
        Some(named) => PathBuf::from(named),
        None => env::current_exe().map_err(|error| error.to_string())?.with_file_name("delone"),
    };
    if !program.is_file() {
        return Err(format!("there is no {}: build it, or name another one in DELONE", program.display()));
    }
    let mut command = Command::new("sh");
    command.arg("-c").arg(format!("ulimit -v {MEMORY}; exec \"$0\" {line}")).arg(program);
    command.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    Ok(command)
}

/// The files of a folder and what they hold; folders hold nothing.
fn contents(folder: &Path) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| error.to_string())? {
        let path = entry.map_err(|error| error.to_string())?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes =
            if path.is_dir() { Vec::new() } else { fs::read(&path).map_err(|error| error.to_string())? };
        all.push((name, bytes));
    }
    Ok(all)
}

/// A folder that goes with all that is in it.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, String> {
        let path = env::temp_dir().join(format!("delone-fuzz-{}", std::process::id()));
        // What an earlier case of this process left when it was given up.
        _ = fs::remove_dir_all(&path);
        fs::create_dir(&path).map_err(|error| error.to_string())?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.0);
    }
}
