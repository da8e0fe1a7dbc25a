//! Segments as text: two indices of points from 0 in each line, separated by commas, semicolons, tabs or blanks. A first line
//! without a number is passed over, and so are remarks after `#`.

use super::lines::Lines;
use crate::error::excerpt;
use crate::{Error, Source};

/// Reads all pairs.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Vec<[usize; 2]>, Error> {
    let mut lines = Lines::new(source);
    let mut pairs = Vec::new();
    let mut is_first = true;
    while let Some(line) = lines.next()? {
        let separates = |c: char| c.is_whitespace() || c == ',' || c == ';';
        let words: Vec<&str> = line.text.split(separates).filter(|word| !word.is_empty()).collect();
        let is_header =
            std::mem::take(&mut is_first) && words.iter().all(|word| word.parse::<f64>().is_err());
        if is_header {
            continue;
        }
        let &[from, to] = &words[..] else {
            return Err(line.error(format!("{} fields where a segment has two indices", words.len())));
        };
        let index = |word: &str| {
            word.parse::<usize>().map_err(|_| {
                line.error(format!("{:?} is no index: the points are numbered from 0", excerpt(word)))
            })
        };
        pairs.push([index(from)?, index(to)?]);
    }
    Ok(pairs)
}
