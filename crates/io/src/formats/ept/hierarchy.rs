//! The hierarchy: which nodes there are, and how many points each has. Large ones lie in several files, which name each other.

use std::collections::{BTreeMap, HashSet};

use super::about::{About, json, wrong};
use crate::Error;
use crate::error::excerpt;
use crate::formats::las::Key;
use crate::formats::poly::Beside;

/// Where the rest of the hierarchy is in a file of its own.
const ELSEWHERE: i64 = -1;

/// A hierarchy.
pub(super) struct Nodes {
    /// The nodes that may have wanted points, with how many they have, in order.
    pub(super) found: Vec<(Key, u64)>,
    /// How many nodes with points were seen. Parts that cannot have wanted points are not looked at.
    pub(super) seen: usize,
    /// The points of all that were found.
    pub(super) points: u64,
}

/// Reads the files of a hierarchy that may have nodes with wanted points.
pub(super) fn read(about: &About, within: Option<[f64; 4]>, open: Beside) -> Result<Nodes, Error> {
    let mut pending = vec![Key::ROOT];
    let mut files = HashSet::from([Key::ROOT]);
    let mut found = BTreeMap::new();
    let (mut seen, mut points) = (0, 0_u64);
    while let Some(file) = pending.pop() {
        let name = format!("ept-hierarchy/{file}.json");
        let all = json(open(&name)?, &name)?;
        let entries = all.as_object().ok_or_else(|| wrong(format!("{name} is no object")))?;
        for (text, count) in entries {
            let short = excerpt(text);
            let key: Key = text.parse().map_err(|()| wrong(format!("{name}: {short:?} is no node")))?;
            let is_met = about.cubes.meet(key, within);
            match count.as_i64() {
                Some(0) => {}
                Some(ELSEWHERE) if !is_met => {}
                Some(ELSEWHERE) => {
                    if !files.insert(key) {
                        return Err(wrong(format!("{name} leads to the hierarchy of {key} again")));
                    }
                    pending.push(key);
                }
                Some(count @ 1..) => {
                    seen += 1;
                    if is_met {
                        points = points.saturating_add(count as u64);
                        if found.insert(key, count as u64).is_some() {
                            return Err(wrong(format!("{name}: the node {key} is in the hierarchy twice")));
                        }
                    }
                }
                _ => return Err(wrong(format!("{name}: {key} has no number of points"))),
            }
        }
    }
    Ok(Nodes { found: found.into_iter().collect(), seen, points })
}
