//! The parent process: starts workers, reports what they find or how they die, and has the input shrunk.

use std::env;
use std::io::{BufRead, BufReader, IsTerminal, Read};
use std::process::{Command, ExitCode, Stdio};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crate::args::{Mode, Options, indices, written};
use crate::cases::case;
use crate::shrink;

/// How long an input is shrunk at most.
const SHRINKING: Duration = Duration::from_secs(90);
/// A part of an input hangs after this share of the limit.
const IMPATIENCE: f64 = 0.25;

/// The end of a worker.
#[derive(Debug, Default)]
struct Outcome {
    /// The number and the seed of the last case begun.
    last: Option<(u64, u64)>,
    finding: Option<String>,
}

/// Runs the modes asked for.
pub(crate) fn run(options: &Options) -> ExitCode {
    let one = [options.mode];
    let modes: &[Mode] = if options.mode == Mode::All { &Mode::REAL } else { &one };
    let (next, sound) = (AtomicUsize::new(0), AtomicBool::new(true));
    let work = || {
        while let Some(&mode) = modes.get(next.fetch_add(1, Ordering::Relaxed)) {
            let options = Options { mode, ..options.clone() };
            let found_nothing = match options.case {
                Some(seed) => again(&options, seed),
                None => attack(&options),
            };
            sound.fetch_and(found_nothing, Ordering::Relaxed);
        }
    };
    thread::scope(|scope| (0..options.jobs.max(1)).for_each(|_| drop(scope.spawn(work))));
    if sound.into_inner() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// One case once more. Says whether all is well.
fn again(options: &Options, seed: u64) -> bool {
    let outcome = watch(options);
    if let Some(message) = outcome.finding {
        report(options, seed, &message, "");
        return false;
    }
    println!("{}: case {seed:#018x}, no finding", options.mode.name());
    true
}

/// Cases until the time is over or something was found. Says whether nothing was.
fn attack(options: &Options) -> bool {
    let start = Instant::now();
    let (mut cases, mut findings) = (0, 0);
    loop {
        let left = options.seconds - start.elapsed().as_secs_f64();
        if left <= 0.0 {
            break;
        }
        let outcome = watch(&Options { first: cases, seconds: left, ..options.clone() });
        let Some(message) = outcome.finding else {
            cases = outcome.last.map_or(cases, |(number, _)| number + 1);
            break;
        };
        findings += 1;
        let Some((number, seed)) = outcome.last else {
            println!("{}: FINDING before the first case: {message}", options.mode.name());
            break;
        };
        report(options, seed, &message, &format!(" (number {number} of seed {})", options.seed));
        cases = number + 1;
        if !options.go_on {
            break;
        }
    }
    let found = if findings == 0 { "no finding".to_owned() } else { format!("{findings} found") };
    println!(
        "{}: {cases} cases in {:.0} seconds, seed {}, {found}",
        options.mode.name(),
        start.elapsed().as_secs_f64(),
        options.seed
    );
    findings == 0
}

/// Prints a finding with its input, as small as it gets, and how to see it again.
fn report(options: &Options, seed: u64, message: &str, number: &str) {
    let name = options.mode.name();
    let finding = format!("{name}: FINDING in case {seed:#018x}{number}: {message}");
    let input = case(options.mode, seed);
    let keep = match options.keep.as_deref().map(indices) {
        Some(Ok(keep)) => keep,
        Some(Err(_)) => return println!("{finding}"),
        None => shrunk(options, seed, message, input.len()),
    };
    let items = format!("{} of {} items:\n{}", keep.len(), input.len(), input.show(&keep));
    let short = |list: String| if list.is_empty() { "''".to_owned() } else { list };
    // At once, so that other modes do not come between.
    println!(
        "{finding}\n{items}\nagain: cargo run -p delone-fuzz -- {name} --case {seed:#018x} --keep {}",
        short(written(&keep))
    );
}

/// The items of a case that are enough to find something.
fn shrunk(options: &Options, seed: u64, message: &str, count: usize) -> Vec<usize> {
    let end = Instant::now() + SHRINKING;
    let limit = options.limit * IMPATIENCE;
    let mut last = None;
    let keep = shrink::smallest(
        count,
        || Instant::now() > end,
        |keep| {
            let part = Some(written(keep));
            let finding = watch(&Options { case: Some(seed), keep: part, limit, ..options.clone() }).finding;
            let found = finding.is_some();
            last = finding.or(last.take());
            found
        },
    );
    if let Some(last) = last.filter(|last| last != message) {
        println!("the smaller input: {last}");
    }
    keep
}

/// Runs a worker to its end.
fn watch(options: &Options) -> Outcome {
    let mut outcome = Outcome::default();
    let child = env::current_exe().and_then(|program| {
        let mut command = Command::new(program);
        command.arg(options.mode.name()).arg("--worker");
        command.args(["--seed", &options.seed.to_string(), "--first", &options.first.to_string()]);
        command.args(["--seconds", &options.seconds.to_string(), "--limit", &options.limit.to_string()]);
        command.args(["--memory", &options.memory.to_string()]);
        if let Some(seed) = options.case {
            command.args(["--case", &seed.to_string()]);
        }
        if let Some(keep) = &options.keep {
            command.args(["--keep", keep]);
        }
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()
    });
    let mut child = match child {
        Ok(child) => child,
        Err(error) => {
            outcome.finding = Some(format!("the worker cannot be started: {error}"));
            return outcome;
        }
    };
    // What the runtime says before it aborts; read aside, so that the worker never waits for a reader.
    let complaints = child.stderr.take().map(|mut pipe| {
        thread::spawn(move || {
            let mut text = String::new();
            let _ = pipe.read_to_string(&mut text);
            text
        })
    });
    if let Some(pipe) = child.stdout.take() {
        let mut progress = Progress::new(options);
        for line in BufReader::new(pipe).lines().map_while(Result::ok) {
            if let Some(message) = line.strip_prefix("finding ") {
                outcome.finding.get_or_insert_with(|| message.to_owned());
            } else if let Some((number, seed)) =
                line.strip_prefix("case ").and_then(|rest| rest.split_once(' '))
            {
                outcome.last = number.parse().ok().zip(seed.parse().ok());
                progress.show(number);
            }
        }
        progress.clear();
    }
    let complaints = complaints.and_then(|reader| reader.join().ok()).unwrap_or_default();
    match child.wait() {
        Ok(status) if status.success() => {}
        Ok(status) => {
            let said = complaints.split_whitespace().collect::<Vec<_>>().join(" ");
            outcome.finding.get_or_insert_with(|| format!("the process died ({status}) {said}"));
        }
        Err(error) => {
            outcome.finding.get_or_insert_with(|| format!("the worker cannot be waited for: {error}"));
        }
    }
    outcome
}

/// A line that tells how far it is, on a terminal only.
struct Progress {
    name: String,
    wanted: bool,
    shown: Instant,
}

impl Progress {
    fn new(options: &Options) -> Self {
        let wanted = options.case.is_none() && std::io::stderr().is_terminal();
        Self { name: options.mode.name(), wanted, shown: Instant::now() }
    }

    fn show(&mut self, number: &str) {
        if self.wanted && self.shown.elapsed() > Duration::from_millis(200) {
            self.shown = Instant::now();
            eprint!("\r{}: {number} cases", self.name);
        }
    }

    fn clear(&self) {
        if self.wanted {
            eprint!("\r\x1b[K");
        }
    }
}
