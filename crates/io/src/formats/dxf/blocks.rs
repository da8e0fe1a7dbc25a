//! Blocks, and what they are where they are inserted: scaled, turned and moved, again and again. A drawing can insert blocks in blocks so
//! that they are more than any memory holds: what comes of them is bounded as compressed content is.

use std::collections::HashMap;

use super::curves::{Path, cosine_and_sine};
use super::entity::{Entity, Insert, Item};
use crate::Error;
use crate::input::most_inflated;

/// Blocks may be in each other so deep.
const DEEPEST: usize = 32;

/// The items of a block, from its base point.
pub(super) struct Block {
    name: String,
    base: [f64; 3],
    pub(super) items: Vec<Item>,
}

/// All blocks of a drawing.
#[derive(Default)]
pub(super) struct Blocks {
    all: HashMap<String, Block>,
    /// The bytes that have come of inserted blocks, and those that may.
    taken: u64,
    most: u64,
}

impl Block {
    pub(super) fn new(entity: &mut Entity) -> Self {
        let name = std::mem::take(&mut entity.name).to_lowercase();
        Self { name, base: entity.base(), items: Vec::new() }
    }
}

/// Takes an item with its layer, along its path; nothing where a block is inserted that is none.
pub(super) type Draw<'a> = &'a mut dyn FnMut(&str, Option<&Item>, &Path);

impl Blocks {
    pub(super) fn add(&mut self, block: Block) {
        self.all.insert(block.name.clone(), block);
    }

    /// Lets as much come of blocks as is justified by so many bytes of the file.
    pub(super) fn allow(&mut self, bytes: u64) {
        self.most = most_inflated(bytes);
    }

    /// Gives an item, or all items of what it inserts.
    pub(super) fn expand(&mut self, item: &Item, draw: Draw) -> Result<(), Error> {
        let mut expansion = Expansion { all: &self.all, taken: self.taken, most: self.most, draw };
        let outcome = expansion.item(item, item.layer(), &mut Vec::new());
        self.taken = expansion.taken;
        outcome
    }
}

/// The blocks that are being inserted.
struct Expansion<'a, 'b> {
    all: &'a HashMap<String, Block>,
    taken: u64,
    most: u64,
    draw: Draw<'b>,
}

impl<'a> Expansion<'a, '_> {
    fn item(&mut self, item: &'a Item, layer: &str, placed: &mut Vec<Placement>) -> Result<(), Error> {
        // What is in a block on layer 0 is on the layer of the block.
        let own = item.layer();
        let layer = if !placed.is_empty() && own == "0" { layer } else { own };
        let mut path = match item {
            Item::Point { at, .. } => Path::straight(vec![*at]),
            Item::Line { path, .. } => path.clone(),
            Item::Insert { insert, .. } => return self.insert(insert, layer, placed),
        };
        if !placed.is_empty() {
            self.count(size_of_val(path.points.as_slice()) + size_of_val(path.centers.as_slice()))?;
        }
        for placement in placed.iter().rev() {
            placement.put(&mut path);
        }
        (self.draw)(layer, Some(item), &path);
        Ok(())
    }

    fn insert(&mut self, insert: &'a Insert, layer: &str, placed: &mut Vec<Placement>) -> Result<(), Error> {
        let Some(block) = self.all.get(&insert.name.to_lowercase()) else {
            (self.draw)(layer, None, &Path::default());
            return Ok(());
        };
        if placed.len() == DEEPEST {
            return Err(Error::content(format!("DXF: more than {DEEPEST} blocks in each other")));
        }
        for row in 0..insert.counts[1] {
            for column in 0..insert.counts[0] {
                self.count(size_of::<Placement>())?;
                placed.push(Placement::new(insert, block.base, [column, row]));
                for item in &block.items {
                    self.item(item, layer, placed)?;
                }
                placed.pop();
            }
        }
        Ok(())
    }

    /// Counts what has come.
    fn count(&mut self, bytes: usize) -> Result<(), Error> {
        self.taken += bytes as u64;
        if self.taken > self.most { Err(Error::Expands) } else { Ok(()) }
    }
}

/// How a block is put into its place.
struct Placement {
    base: [f64; 3],
    scale: [f64; 3],
    /// The cosine and the sine of its angle.
    turn: [f64; 2],
    /// The step of the column and the row.
    step: [f64; 2],
    at: [f64; 3],
}

impl Placement {
    fn new(insert: &Insert, base: [f64; 3], place: [u32; 2]) -> Self {
        let turn = cosine_and_sine(insert.angle);
        let step = [0, 1].map(|k| insert.steps[k] * f64::from(place[k]));
        Self { base, scale: insert.scale, turn, step, at: insert.at }
    }

    /// Puts a path of the block into its place. Arcs that are stretched are circular no longer.
    fn put(&self, path: &mut Path) {
        path.points.iter_mut().for_each(|point| *point = self.of(*point));
        if self.scale[0].abs() == self.scale[1].abs() {
            path.centers.iter_mut().for_each(|(_, center)| *center = self.of(*center));
        } else {
            path.centers.clear();
        }
    }

    /// Where a point of the block is.
    fn of(&self, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = [0, 1, 2].map(|k| (p[k] - self.base[k]) * self.scale[k]);
        let ([x, y], [cosine, sine]) = ([x + self.step[0], y + self.step[1]], self.turn);
        [self.at[0] + cosine * x - sine * y, self.at[1] + sine * x + cosine * y, self.at[2] + z]
    }
}
