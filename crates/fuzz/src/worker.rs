//! The process that runs cases. It says on standard output which case it begins, what it found, and that it is done;
//! whatever kills it, the parent knows the case.

use std::io::{self, Write};
use std::panic::{self, AssertUnwindSafe};
use std::process::{self, ExitCode};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crate::args::{Options, indices};
use crate::attack::Judgement;
use crate::cases::{Case, case, seed_of};

/// When the case at hand began, in milliseconds after the start, plus one; zero between cases.
static BEGAN: AtomicU64 = AtomicU64::new(0);
/// The message of the first panic of the case.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Runs one case or many.
pub(crate) fn run(options: &Options) -> ExitCode {
    let bytes = options.memory << 20;
    if let Err(error) = rlimit::setrlimit(rlimit::Resource::AS, bytes, bytes) {
        tell(&format!("finding memory cannot be limited: {error}"));
        return ExitCode::FAILURE;
    }
    panic::set_hook(Box::new(|info| {
        let mut first = PANIC.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if first.is_empty() {
            *first = info.to_string();
        }
    }));
    let start = Instant::now();
    let limit = Duration::from_secs_f64(options.limit.max(0.01));
    thread::spawn(move || watch(start, limit));
    if let Some(seed) = options.case {
        let keep = options.keep.as_deref().map(indices).transpose();
        return match keep {
            Ok(keep) => one(options, 0, seed, keep, start),
            Err(error) => {
                tell(&format!("finding --keep {error}"));
                ExitCode::FAILURE
            }
        };
    }
    let mut number = options.first;
    while start.elapsed().as_secs_f64() < options.seconds {
        let status = one(options, number, seed_of(options.seed, number), None, start);
        if status != ExitCode::SUCCESS {
            return status;
        }
        number += 1;
    }
    ExitCode::SUCCESS
}

fn one(options: &Options, number: u64, seed: u64, keep: Option<Vec<usize>>, start: Instant) -> ExitCode {
    tell(&format!("case {number} {seed}"));
    BEGAN.store(start.elapsed().as_millis() as u64 + 1, Ordering::Relaxed);
    let input = case(options.mode, seed);
    let keep = keep.unwrap_or_else(|| (0..input.len()).collect());
    let judgement = judged(&*input, &keep);
    BEGAN.store(0, Ordering::Relaxed);
    match judgement {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            tell(&format!("finding {}", message.replace('\n', " ")));
            ExitCode::FAILURE
        }
    }
}

/// Judges; a panic is a finding.
fn judged(input: &dyn Case, keep: &[usize]) -> Judgement {
    let lock = || PANIC.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    lock().clear();
    panic::catch_unwind(AssertUnwindSafe(|| input.judge(keep))).unwrap_or_else(|_| Err(lock().clone()))
}

/// A case that waits, as for a lock that nobody opens, has so many times the limit.
const WAITING: u32 = 10;

/// Ends the process when a case takes too long: on the clock, and of the processor's time too, which others may have.
fn watch(start: Instant, limit: Duration) {
    let mut before = (0, None);
    loop {
        thread::sleep(limit.min(Duration::from_millis(100)) / 2);
        let began = BEGAN.load(Ordering::Relaxed);
        let now = start.elapsed().as_millis() as u64 + 1;
        if began != before.0 {
            before = (began, processor_time());
        }
        let passed = Duration::from_millis(now.saturating_sub(began));
        let worked = || match (processor_time(), before.1) {
            (Some(now), Some(then)) => now.saturating_sub(then),
            _ => passed,
        };
        if began > 0 && passed > limit && (worked() > limit || passed > WAITING * limit) {
            tell(&format!("finding hangs: not done after {} seconds", limit.as_secs_f64()));
            process::exit(3);
        }
    }
}

/// The processor time of all threads of this process, where the system tells.
fn processor_time() -> Option<Duration> {
    /// Ticks of the system in a second, for all programs that it tells.
    const TICKS: u64 = 100;
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in parentheses, may hold anything. After it come the state and, from the twelfth on, user's and
    // system's time.
    let mut numbers =
        text.rsplit_once(')')?.1.split_whitespace().skip(11).map_while(|word| word.parse::<u64>().ok());
    Some(Duration::from_millis((numbers.next()? + numbers.next()?) * 1000 / TICKS))
}

/// A line to the parent. Without a parent there is nobody to work for.
fn tell(line: &str) {
    let mut out = io::stdout().lock();
    if writeln!(out, "{line}").and_then(|()| out.flush()).is_err() {
        process::exit(4);
    }
}
