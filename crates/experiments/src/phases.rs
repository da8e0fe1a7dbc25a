//! Steps of searches in a hierarchy, by level and phase.

use delone::{Phase, Tally, Work};

/// Counts of each phase on each level.
#[derive(Clone, Debug, Default)]
pub(crate) struct Phases {
    level: usize,
    phase: usize,
    /// For each level from the triangulation itself on: sample, turn, walk, nearest vertex.
    counts: Vec<[Work; 4]>,
}

impl Phases {
    /// The phases of a level; nothing of a level where nothing was done.
    pub(crate) fn on(&self, level: usize) -> [Work; 4] {
        self.counts.get(level).copied().unwrap_or_default()
    }

    /// The number of levels.
    pub(crate) fn levels(&self) -> usize {
        self.counts.len()
    }

    /// Everything.
    pub(crate) fn total(&self) -> Work {
        let mut total = Work::default();
        self.counts.iter().flatten().for_each(|work| total.add(work));
        total
    }

    fn here(&mut self) -> &mut Work {
        if self.counts.len() <= self.level {
            self.counts.resize(self.level + 1, [Work::default(); 4]);
        }
        &mut self.counts[self.level][self.phase]
    }
}

impl Tally for Phases {
    fn visited(&mut self) {
        self.here().visited();
    }

    fn compared(&mut self) {
        self.here().compared();
    }

    fn orientation(&mut self) {
        self.here().orientation();
    }

    fn in_circle(&mut self) {
        self.here().in_circle();
    }

    fn level(&mut self, level: usize) {
        self.level = level;
    }

    fn phase(&mut self, phase: Phase) {
        self.phase = match phase {
            Phase::Sample => 0,
            Phase::Turn => 1,
            Phase::Nearest => 3,
            _ => 2,
        };
    }
}

/// Floating-point operations as Devillers 1998 counts them (§4.4), of so many searches: an orientation with the query and the
/// vertex where its walk began takes 4, after 5 for each walk; any other 7; a distance 5. Along a straight line every second
/// test of a walk is of the first kind, and the last is not.
pub(crate) fn operations(phases: &Phases, queries: usize) -> f64 {
    let levels = (0..phases.levels()).map(|level| {
        let [sample, turn, walk, nearest] = phases.on(level);
        let walks = queries.min(walk.orientations as usize) as f64;
        let (turning, walking) = (turn.orientations as f64, walk.orientations as f64);
        let distances = (sample.compared + nearest.compared) as f64;
        5.0 * walks
            + 4.0 * (turning + (walking - walks) / 2.0)
            + 7.0 * (walking + walks) / 2.0
            + 5.0 * distances
    });
    levels.sum::<f64>() / queries as f64
}
