//! A case: a list of items and a seed for the rest. Judges work on any part of the list, so that it can be shrunk.

use std::marker::PhantomData;

use delone_generators::Random;

use crate::args::Mode;
use crate::attack::{Attack, Judgement};
use crate::modes::{
    alphas, broken, cells, cells3, files, graph_lives, graphs, hulls, lives, mesh, mixtures, motion, orders,
    outlines, periodic, plane, predicates, program, proximity, space, surfaces, tiles, weights,
};

/// An input of some attack.
pub(crate) trait Case {
    /// How many items it has.
    fn len(&self) -> usize;
    /// Judges the items with these indices.
    fn judge(&self, keep: &[usize]) -> Judgement;
    /// These items as text, one a line.
    fn show(&self, keep: &[usize]) -> String;
}

struct Made<A: Attack> {
    items: Vec<A::Item>,
    seed: u64,
    attack: PhantomData<A>,
}

impl<A: Attack> Made<A> {
    fn kept(&self, keep: &[usize]) -> Vec<A::Item> {
        keep.iter().filter_map(|&i| self.items.get(i).cloned()).collect()
    }
}

impl<A: Attack> Case for Made<A> {
    fn len(&self) -> usize {
        self.items.len()
    }

    fn judge(&self, keep: &[usize]) -> Judgement {
        A::judge(&self.kept(keep), self.seed)
    }

    fn show(&self, keep: &[usize]) -> String {
        self.kept(keep).iter().map(|item| format!("    {item:?},\n")).collect()
    }
}

fn made<A: Attack + 'static>(case: u64) -> Box<dyn Case> {
    let mut random = Random::new(case);
    let items = A::make(&mut random);
    Box::new(Made::<A> { items, seed: random.bits(), attack: PhantomData })
}

/// The seed of a case.
pub(crate) fn seed_of(seed: u64, number: u64) -> u64 {
    Random::new(seed ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(32)).bits()
}

/// The case with a seed of its own.
pub(crate) fn case(mode: Mode, seed: u64) -> Box<dyn Case> {
    // Of the modes for both dimensions a bit of the seed decides which.
    match (mode, seed & 1) {
        (Mode::Plane, _) => made::<plane::Plane>(seed),
        (Mode::Space, _) => made::<space::Space>(seed),
        (Mode::Lives, 0) => made::<lives::Lives<delone::Delaunay2, 2>>(seed),
        (Mode::Lives, _) => made::<lives::Lives<delone::Delaunay3, 3>>(seed),
        (Mode::Motion, 0) => made::<motion::Motion<2>>(seed),
        (Mode::Motion, _) => made::<motion::Motion<3>>(seed),
        (Mode::Cells, _) => made::<cells::Cells>(seed),
        (Mode::Cells3, _) => made::<cells3::Cells3d>(seed),
        (Mode::Graphs, 0) => made::<graphs::Graphs>(seed),
        (Mode::Graphs, _) => made::<graph_lives::GraphLives>(seed),
        (Mode::Outlines, 0) => made::<outlines::Welds>(seed),
        (Mode::Outlines, _) => made::<outlines::Cells>(seed),
        (Mode::Mesh, _) => made::<mesh::Mesh>(seed),
        (Mode::Alphas, 0) => made::<alphas::Planar>(seed),
        (Mode::Alphas, _) => made::<alphas::Spatial>(seed),
        (Mode::Periodic, _) => made::<periodic::Boxes>(seed),
        (Mode::Orders, _) => made::<orders::Orders>(seed),
        (Mode::Hulls, 0) => made::<hulls::Planar>(seed),
        (Mode::Hulls, _) => made::<hulls::Spatial>(seed),
        (Mode::Surfaces, 0) => made::<surfaces::Planar>(seed),
        (Mode::Surfaces, _) => made::<surfaces::Spatial>(seed),
        (Mode::Tiles, 0) => made::<tiles::Planar>(seed),
        (Mode::Tiles, _) => made::<tiles::Spatial>(seed),
        (Mode::Weights, 0) => made::<weights::Planar>(seed),
        (Mode::Weights, _) => made::<weights::Spatial>(seed),
        (Mode::Proximity, 0) => made::<proximity::Planar>(seed),
        (Mode::Proximity, _) => made::<proximity::Spatial>(seed),
        (Mode::Predicates, _) => made::<predicates::Predicates>(seed),
        (Mode::Mixtures, 0) => made::<mixtures::Mixtures<delone::Delaunay2, 2>>(seed),
        (Mode::Mixtures, _) => made::<mixtures::Mixtures<delone::Delaunay3, 3>>(seed),
        (Mode::ReadText, _) => made::<files::Files<{ files::TEXT }>>(seed),
        (Mode::ReadGeojson, _) => made::<files::Files<{ files::JSON }>>(seed),
        (Mode::ReadArrays, _) => made::<files::Files<{ files::ARRAYS }>>(seed),
        (Mode::ReadLas, _) => made::<files::Files<{ files::LAS }>>(seed),
        (Mode::ReadPly, _) => made::<files::Files<{ files::PLY }>>(seed),
        (Mode::ReadMeshes, _) => made::<files::Files<{ files::MESHES }>>(seed),
        (Mode::ReadE57, _) => made::<files::Files<{ files::E57 }>>(seed),
        (Mode::ReadMaps, _) => made::<files::Files<{ files::MAPS }>>(seed),
        (Mode::Program, _) => made::<program::Program>(seed),
        (Mode::BrokenAnswer, _) => made::<broken::Answer>(seed),
        (Mode::BrokenPanic, _) => made::<broken::Panic>(seed),
        (Mode::BrokenHang, _) => made::<broken::Hang>(seed),
        (Mode::BrokenMemory, _) => made::<broken::Memory>(seed),
        (Mode::BrokenStack, _) => made::<broken::Stack>(seed),
        (Mode::Sound | Mode::All, _) => made::<broken::Sound>(seed),
    }
}
