//! `docs/papers.md` says what the committed results say, names tests that exist and experiments that run.
//!
//! A number of ours is a link to its table, with row and column as the title: `[2.79 ± 0.03](results/t.csv "row :: column")`.
//! A row is named by its first cells, separated by `; `. `BLESS=1 cargo test -p delone-experiments --test page` writes the
//! numbers of new results into the pages.

#[path = "claims/csv.rs"]
mod csv;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use csv::fields;
use delone_experiments::EXPERIMENTS;

const PAGES: [&str; 2] = ["papers.md", "experiments.md"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page(name: &str) -> String {
    fs::read_to_string(root().join("docs").join(name)).expect("a page")
}

/// The fields of the lines of a table.
fn table(name: &str) -> Result<Vec<Vec<String>>, String> {
    let text = fs::read_to_string(root().join("docs/results").join(name));
    Ok(text.map_err(|_| format!("there is no {name}"))?.lines().map(fields).collect())
}

/// A number of a page: where it is in the text, and where it comes from.
struct Number<'a> {
    text: &'a str,
    start: usize,
    /// Where the link ends.
    end: usize,
    file: &'a str,
    row: &'a str,
    column: &'a str,
}

fn numbers(page: &str) -> Vec<Number<'_>> {
    const LINK: &str = "](results/";
    let mut numbers = Vec::new();
    for (at, _) in page.match_indices(LINK) {
        let start = page[..at].rfind('[').expect("a link") + 1;
        let inside = at + LINK.len();
        let link = &page[inside..];
        let name = link.find([' ', ')']).expect("the end of a name");
        if link[name..].starts_with(')') {
            continue; // a link to a whole table
        }
        let length = link.find("\")").expect("the end of a title");
        let title = link[name..length].strip_prefix(" \"").expect("a title");
        let (row, column) = title.rsplit_once(" :: ").expect("row :: column");
        let end = inside + length + 2;
        numbers.push(Number { text: &page[start..at], start, end, file: &link[..name], row, column });
    }
    numbers
}

/// The number in the results.
fn result(number: &Number<'_>) -> Result<String, String> {
    let table = table(number.file)?;
    let column = table[0].iter().position(|head| head == number.column).ok_or("no such column")?;
    let keys: Vec<&str> = number.row.split("; ").collect();
    let is_named = |row: &&Vec<String>| row.iter().zip(&keys).all(|(cell, key)| cell == key);
    let row = table[1..].iter().find(is_named).ok_or("no such row")?;
    row.get(column).cloned().ok_or("the row is short".to_owned())
}

#[test]
fn numbers_are_those_of_the_results() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut wrong = Vec::new();
    for name in PAGES {
        let text = page(name);
        let mut blessed = text.clone();
        for number in numbers(&text).iter().rev() {
            match result(number) {
                Ok(value) if value == number.text => {}
                Ok(value) if bless => {
                    blessed.replace_range(number.start..number.start + number.text.len(), &value);
                }
                Ok(value) => wrong.push(format!("{name}: {} is {value} in {}", number.text, number.file)),
                Err(why) => {
                    wrong.push(format!("{name}: {}: {} | {}: {why}", number.file, number.row, number.column));
                }
            }
        }
        if blessed != text {
            fs::write(root().join("docs").join(name), blessed).expect("written");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(numbers(&page(PAGES[0])).len() > 100, "the page of the papers has numbers");
}

/// In tables with a column "ours" no number stands there that is no link.
#[test]
fn no_number_of_ours_is_typed() {
    let mut typed = Vec::new();
    for name in PAGES {
        let mut text = page(name);
        let links: Vec<_> = numbers(&text).iter().map(|number| number.start - 1..number.end).collect();
        links.into_iter().rev().for_each(|link| text.replace_range(link, ""));
        let mut column = None;
        for line in text.lines() {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            if !line.starts_with('|') {
                column = None;
            } else if let Some(k) = cells.iter().position(|cell| *cell == "ours") {
                column = Some(k);
            } else if let Some(cell) = column.and_then(|k| cells.get(k))
                && cell.contains(|c: char| c.is_ascii_digit())
            {
                typed.push(format!("{name}: {line}"));
            }
        }
    }
    assert!(typed.is_empty(), "{}", typed.join("\n"));
}

/// Every row with a number of ours, or a claim, names a test; what no test can assert says what it is.
#[test]
fn every_row_is_held() {
    const NO_COUNT: [&str; 3] = ["time", "cachegrind", "picture"];
    let mut columns = None;
    let mut held = 0;
    for line in page(PAGES[0]).lines() {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let place = |head: &str| cells.iter().position(|cell| *cell == head);
        if !line.starts_with('|') {
            columns = None;
        } else if let (Some(ours), Some(test)) = (place("ours"), place("test")) {
            columns = Some((ours, test));
        } else if let Some((ours, test)) = columns
            && cells[ours] != "---"
        {
            held += 1;
            assert!(!cells[ours].is_empty(), "{line}");
            assert!(cells[test].contains(".rs::") || NO_COUNT.contains(&cells[test]), "{line}");
            // A count is no time.
            let of_times = ["seconds", "ns\"", "-times", "rivals", "to build: ns a point"];
            assert!(
                cells[test] != "time" || of_times.iter().any(|times| cells[ours].contains(times)),
                "{line}"
            );
        }
    }
    assert!(held > 100, "the page has rows");
}

/// The words in backticks.
fn quoted(page: &str) -> BTreeSet<&str> {
    page.split('`').skip(1).step_by(2).collect()
}

/// Tests are named as `file.rs::name`.
#[test]
fn tests_exist() {
    let mut sources = Vec::new();
    let mut folders = vec![root().join("crates")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("readable") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                sources.push(path);
            }
        }
    }
    let text = page(PAGES[0]);
    let mut named = 0;
    for (file, test) in quoted(&text).into_iter().filter_map(|name| name.split_once(".rs::")) {
        named += 1;
        let (file, head) = (format!("{file}.rs"), format!("fn {test}("));
        let holds = |path: &PathBuf| {
            path.ends_with(&file) && fs::read_to_string(path).is_ok_and(|code| code.contains(&head))
        };
        assert!(sources.iter().any(holds), "there is no test {test} in {file}");
    }
    assert!(named > 10, "the page names tests");
}

#[test]
fn experiments_are_all_on_the_page() {
    let text = page(PAGES[0]);
    for experiment in EXPERIMENTS {
        let command = format!("delone-lab experiment {}", experiment.name);
        assert!(text.contains(&command), "{command} is not on the page");
    }
    for name in
        text.split("delone-lab experiment ").skip(1).filter_map(|rest| rest.split([' ', '`', '\n']).next())
    {
        assert!(
            EXPERIMENTS.iter().any(|experiment| experiment.name == name),
            "there is no experiment {name}"
        );
    }
}
