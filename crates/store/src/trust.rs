//! A resumed run compares each file in its folder with the hash that was written: nothing is trusted because it has a name.
//!
//! Buckets are held to theirs when they are read (`buckets.rs`).
//!
//! Cost: reading all files that are done, once.

use std::path::Path;

use delone::tiles::Node;

use crate::error::Error;
use crate::manifest::Manifest;
use crate::node::{self, Done};
use crate::watch::{Phase, Watch};

/// Checks the files of all nodes that are done.
pub(crate) fn check(folder: &Path, plan: &Manifest, watch: &dyn Watch) -> Result<(), Error> {
    let _phase = Phase::start(watch, "checking what is done");
    if let Some(outcome) = &plan.outcome {
        let nodes = outcome.nodes.iter().filter_map(Done::parse);
        return nodes.into_iter().try_for_each(|done| done.check_files(folder, &plan.cuts));
    }
    if plan.buckets.is_none() {
        return Ok(());
    }
    let mut waiting = vec![Node::ROOT];
    while let Some(node) = waiting.pop() {
        waiting.extend(plan.cuts.halves(node).into_iter().flatten());
        if let Some(done) = Done::find(folder, node)? {
            done.check_files(folder, &plan.cuts)?;
            node::border(folder, node)?;
        }
    }
    Ok(())
}
