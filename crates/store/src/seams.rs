//! Seams: borders are joined up the tree, as many at once as memory allows.

use std::path::Path;

use delone::tiles::{Cuts, Node, join};
use delone_io::write_array;

use crate::budget::Budget;
use crate::error::Error;
use crate::node::{self, Done};
use crate::places::place;
use crate::sums::Sums;
use crate::watch::Phase;

/// Cuts that one join goes over, where memory allows: points along long cuts are then triangulated once in four levels.
const LEVELS: u32 = 4;

/// Joins that are going on.
pub(crate) struct Joins<'a> {
    pub(crate) folder: &'a Path,
    pub(crate) cuts: &'a Cuts,
    pub(crate) budget: &'a Budget,
    /// All points, for messages.
    pub(crate) count: u64,
    pub(crate) phase: Phase<'a>,
}

impl Joins<'_> {
    /// Finishes a node and all below it. Tiles are done.
    pub(crate) fn settle(&self, node: Node) -> Result<Done, Error> {
        if let Some(done) = Done::find(self.folder, node)? {
            return Ok(done);
        }
        let Some(halves) = self.cuts.halves(node) else {
            let path = place(self.folder, "border", node, "bin");
            return Err(Error::Missing { path });
        };
        let parts: Vec<Done> =
            self.parts(node, LEVELS)?.into_iter().map(|part| self.settle(part)).collect::<Result<_, _>>()?;
        let points = |parts: &[Done]| parts.iter().map(|part| part.border).sum::<u64>();
        if self.budget.can_join(points(&parts)) {
            return self.join(node, &parts);
        }
        // Fewer at once: what is half way may be final.
        let halves = [self.settle_alone(halves[0], &parts)?, self.settle_alone(halves[1], &parts)?];
        if self.budget.can_join(points(&halves)) {
            return self.join(node, &halves);
        }
        Err(self.budget.cannot_join(node.number(), points(&halves), self.count))
    }

    /// Finishes a half whose parts are done.
    fn settle_alone(&self, half: Node, parts: &[Done]) -> Result<Done, Error> {
        match parts.iter().find(|part| part.node == half) {
            Some(done) => Ok(done.clone()),
            None => self.settle(half),
        }
    }

    /// The nodes below one that make it: those that are done, tiles, and those some levels below.
    fn parts(&self, node: Node, levels: u32) -> Result<Vec<Node>, Error> {
        let mut parts = Vec::new();
        for half in self.cuts.halves(node).into_iter().flatten() {
            let is_whole = levels == 1 || self.cuts.halves(half).is_none();
            if is_whole || Done::find(self.folder, half)?.is_some() {
                parts.push(half);
            } else {
                parts.extend(self.parts(half, levels - 1)?);
            }
        }
        Ok(parts)
    }

    fn join(&self, node: Node, parts: &[Done]) -> Result<Done, Error> {
        let borders =
            parts.iter().map(|part| node::border(self.folder, part.node)).collect::<Result<Vec<_>, _>>()?;
        let seam = join(&borders, &self.cuts.region(node)).map_err(|error| Error::Join {
            node: node.number(),
            parts: numbers(parts),
            error: Box::new(error),
        })?;
        drop(borders);
        let mut sums = Sums::default();
        sums.write(&place(self.folder, "seam", node, "npy"), |out| {
            let triangles = &seam.triangles;
            Ok(write_array(out, &[triangles.len(), 3], triangles.as_flattened().iter().copied())?)
        })?;
        let border = seam.border.points.len() as u64;
        let done = Done { node, vertices: 0, duplicates: 0, fingerprint: seam.fingerprint, border, sums };
        done.write(self.folder, &seam.border)?;
        self.phase.advance()?;
        Ok(done)
    }
}

fn numbers(parts: &[Done]) -> Vec<u32> {
    parts.iter().map(|part| part.node.number()).collect()
}
