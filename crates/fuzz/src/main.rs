//! Random attack on the engine, judged by definitions over big integers that share nothing with it.
//!
//! A case is a list of items (points, changes, tuples) and one more random number, all from one 64-bit seed. A worker
//! process runs cases, and says which before it begins; its parent reports what it found or how it died, and shrinks the
//! list. So a crash, a hang and a runaway of memory are findings like a wrong answer.

mod args;
mod attack;
mod cases;
mod engine;
mod modes;
mod nasty;
mod oracle;
mod shrink;
mod supervise;
mod worker;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let options = args::Options::parse();
    if options.worker { worker::run(&options) } else { supervise::run(&options) }
}
