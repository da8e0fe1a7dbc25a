//! The supervision: wrong answers, panics, hangs, runaways and deaths are reported with their case, and shrunk.

use std::process::{Command, Output};

fn run(arguments: &[&str]) -> (Option<i32>, String) {
    let Output { status, stdout, .. } =
        Command::new(env!("CARGO_BIN_EXE_delone-fuzz")).args(arguments).output().expect("the program starts");
    (status.code(), String::from_utf8_lossy(&stdout).into_owned())
}

/// Runs a mode that is wrong on purpose where 13 is among its numbers.
fn broken(mode: &str, expected: &str) {
    let (status, text) = run(&[mode, "--seconds", "5", "--limit", "1", "--memory", "600"]);
    assert_eq!(status, Some(1), "{text}");
    assert!(text.contains(&format!("{mode}: FINDING in case 0x")), "{text}");
    assert!(text.contains(expected), "{text}");
    assert!(text.contains("1 of 20 items:\n    13,\n"), "not shrunk: {text}");
    // The command that it names shows the same again, and nothing without the item that matters.
    let again = text.lines().find_map(|line| line.strip_prefix("again: cargo run -p delone-fuzz -- "));
    let mut arguments: Vec<&str> = again.expect("a command").split(' ').collect();
    arguments.extend(["--limit", "1", "--memory", "600"]);
    let (status, text) = run(&arguments);
    assert_eq!(status, Some(1), "{text}");
    assert!(text.contains(expected), "{text}");
    let keep = arguments.iter().position(|argument| *argument == "13").expect("the item that matters");
    arguments[keep] = "0-12,14-19";
    let (status, text) = run(&arguments);
    assert_eq!(status, Some(0), "{text}");
    assert!(text.contains("no finding"), "{text}");
}

#[test]
fn wrong_answers_are_reported() {
    broken("broken-answer", "13 is wrong");
}

#[test]
fn panics_are_reported() {
    broken("broken-panic", "13 is unlucky");
}

#[test]
fn hangs_are_reported() {
    broken("broken-hang", "hangs: not done after");
}

#[test]
fn runaways_of_memory_are_reported() {
    broken("broken-memory", "memory allocation of");
}

#[test]
fn stack_overflows_are_reported() {
    broken("broken-stack", "overflowed its stack");
}

#[test]
fn without_a_finding_the_cases_are_counted() {
    let (status, text) = run(&["sound", "--seconds", "0.2", "--seed", "9"]);
    assert_eq!(status, Some(0), "{text}");
    assert!(text.starts_with("sound: ") && text.trim_end().ends_with("seed 9, no finding"), "{text}");
    let cases: u64 = text.split(' ').nth(1).and_then(|number| number.parse().ok()).expect("a number");
    assert!(cases > 10, "{text}");
}

#[test]
fn the_same_seed_makes_the_same_cases() {
    let first = || {
        let (_, text) = run(&["broken-answer", "--seed", "5"]);
        text.lines().next().expect("a line").to_owned()
    };
    assert_eq!(first(), first());
    assert_ne!(first(), run(&["broken-answer", "--seed", "6"]).1.lines().next().expect("a line"));
}
