//! The house rules of language: names of constants, openings of comments, lengths of sentences, the glossary.

use std::fs;
use std::path::{Path, PathBuf};

/// Names of constants that say neither what is counted nor what happens on both sides.
const EMPTY_CONSTANTS: [&str; 9] =
    ["FEW", "MANY", "MOST", "SMALL", "LARGE", "NEAR", "AHEAD", "USUAL", "ENOUGH"];

/// Openings of comments that put a riddle in the place of a noun.
const RIDDLES: [&str; 4] = ["What ", "Those ", "The same ", "So many "];

/// How many comments open with a riddle, at most.
const MAX_RIDDLES: usize = 10;

/// Words in a sentence, on the pages for readers: on average, and at most.
const MEAN_WORDS: f64 = 18.0;
const MAX_WORDS: usize = 35;

/// Words of ours that need an entry in the glossary wherever they name something in the library.
const COINED: [&str; 21] = [
    "arena",
    "band",
    "border",
    "canonical",
    "cut",
    "domain",
    "fingerprint",
    "ghost",
    "ground",
    "hidden",
    "hint",
    "hole",
    "join",
    "kernel",
    "layer",
    "leaf",
    "pencil",
    "place",
    "scaffold",
    "spot",
    "tally",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// All files below a folder with such an extension; nothing that a build has made.
fn files(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            let is_ours = !["target", "node_modules"].contains(&&*name) && !name.starts_with('.');
            if is_ours {
                files(&path, extension, found);
            }
        } else if path.extension().is_some_and(|given| given == extension) {
            found.push(path);
        }
    }
}

fn sources() -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for folder in ["crates", "bindings", "compare"] {
        files(&root().join(folder), "rs", &mut found);
    }
    assert!(found.len() > 500, "only {} files", found.len());
    found.into_iter().map(|path| (path.clone(), fs::read_to_string(path).expect("readable"))).collect()
}

#[test]
fn constants_say_what_they_bound() {
    for (path, text) in sources() {
        for (i, line) in text.lines().enumerate() {
            let Some((_, rest)) = line.split_once("const ") else { continue };
            let name = rest.split(':').next().unwrap_or_default().trim();
            assert!(!EMPTY_CONSTANTS.contains(&name), "{}:{}: {name}", path.display(), i + 1);
        }
    }
}

#[test]
fn comments_open_with_a_noun() {
    let mut riddles = Vec::new();
    for (path, text) in sources() {
        let mut is_inside = false;
        for (i, line) in text.lines().enumerate() {
            let comment = ["//! ", "/// "].iter().find_map(|mark| line.trim_start().strip_prefix(mark));
            let opens = comment.is_some_and(|text| RIDDLES.iter().any(|riddle| text.starts_with(riddle)));
            if !is_inside && opens {
                riddles.push(format!("{}:{}: {}", path.display(), i + 1, line.trim()));
            }
            is_inside = comment.is_some();
        }
    }
    assert!(riddles.len() <= MAX_RIDDLES, "{} comments:\n{}", riddles.len(), riddles.join("\n"));
}

/// The numbers of words of the sentences of a page, without code, tables and headings.
fn sentences(page: &str) -> Vec<Vec<&str>> {
    let mut sentences = vec![Vec::new()];
    let mut is_code = false;
    for line in page.lines() {
        let text = line.trim_start();
        let is_fence = text.starts_with("```");
        is_code ^= is_fence;
        let is_numbered = text.split_once(". ").is_some_and(|(number, _)| number.parse::<u32>().is_ok());
        let is_skipped = is_code || is_fence || text.starts_with(['|', '#']);
        if is_skipped || is_numbered || text.is_empty() || text.starts_with(['-', '*']) {
            sentences.push(Vec::new());
        }
        if is_skipped {
            continue;
        }
        for word in text.split_whitespace() {
            sentences.last_mut().expect("one at least").push(word);
            if word.trim_end_matches([')', '"', '*', '`']).ends_with(['.', '!', '?', ':', ';']) {
                sentences.push(Vec::new());
            }
        }
    }
    sentences.retain(|sentence| sentence.len() > 2);
    sentences
}

#[test]
fn sentences_are_short() {
    let root = root();
    let mut pages = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(|name| root.join(name)).to_vec();
    files(&root.join("docs"), "md", &mut pages);
    for path in pages {
        let page = fs::read_to_string(&path).expect("readable");
        let sentences = sentences(&page);
        let words: usize = sentences.iter().map(Vec::len).sum();
        let mean = words as f64 / sentences.len().max(1) as f64;
        assert!(mean <= MEAN_WORDS, "{}: {mean:.1} words a sentence", path.display());
        if let Some(longest) = sentences.iter().max_by_key(|sentence| sentence.len()) {
            let count = longest.len();
            assert!(count <= MAX_WORDS, "{}: {count} words: {}", path.display(), longest.join(" "));
        }
    }
}

#[test]
fn sentences_are_told_apart() {
    let page = "# Title of words\n\nOne two three. Four five six:\n\n- seven eight nine\n\n```\nno words of code here\n```\n| a | b |\nten\neleven twelve";
    let lengths: Vec<usize> = sentences(page).iter().map(Vec::len).collect();
    assert_eq!(lengths, [3, 3, 4, 3]);
}

/// Whether a text has a word, as a whole or as a part of an identifier.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_ascii_lowercase());
    text.match_indices(word).any(|(at, _)| {
        !is_part(text[..at].chars().next_back()) && !is_part(text[at + word.len()..].chars().next())
    })
}

#[test]
fn the_glossary_has_the_words_in_use() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("readable");
    let (_, glossary) = page.split_once("## Words").expect("a glossary");
    let rows = glossary.lines().filter_map(|line| line.strip_prefix("| ")?.split(" |").next());
    let words: Vec<&str> =
        rows.flat_map(|row| row.split(", ")).filter(|word| !["word", "---"].contains(word)).collect();
    assert!(words.len() > 20, "{words:?}");
    let library: Vec<String> = {
        let mut found = Vec::new();
        files(&root().join("crates/delone/src"), "rs", &mut found);
        found.iter().map(|path| fs::read_to_string(path).expect("readable").to_lowercase()).collect()
    };
    let uses = |word: &str| library.iter().filter(|text| has_word(text, word)).count();
    for word in &words {
        let everywhere = sources().iter().any(|(_, text)| has_word(&text.to_lowercase(), word));
        assert!(everywhere, "nothing is called {word}");
    }
    for word in COINED {
        assert!(uses(word) < 3 || words.contains(&word), "{word} is not in the glossary");
    }
}
