//! Who is joined with whom: the neighbours of all vertices in one list, for searches that ask each several times.

use crate::ids::Place;
use crate::parallel;

use super::Sites;

/// The vertices with their neighbours.
pub(super) struct Net<'a, const D: usize> {
    pub(super) points: &'a [[f64; D]],
    /// The places in use.
    pub(super) places: Vec<Place>,
    /// For each place where its neighbours begin; those of the next one follow.
    starts: Vec<usize>,
    joined: Vec<Place>,
}

impl<'a, const D: usize> Net<'a, D> {
    pub(super) fn of(sites: &'a (impl Sites<D> + ?Sized)) -> Self {
        let places: Vec<Place> = sites.inhabited().collect();
        let part = |places: &[Place]| {
            let (mut joined, mut degrees) = (Vec::new(), Vec::with_capacity(places.len()));
            for &v in places {
                let before = joined.len();
                sites.beside(v, |w| joined.push(w));
                degrees.push(joined.len() - before);
            }
            (joined, degrees)
        };
        let parts = in_parts(&places, part);
        let mut starts = vec![0; sites.place_count() + 1];
        let degrees = parts.iter().flat_map(|(_, degrees)| degrees);
        places.iter().zip(degrees).for_each(|(v, &degree)| starts[v.index() + 1] = degree);
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let joined = parts.into_iter().flat_map(|(joined, _)| joined).collect();
        Self { points: sites.points(), places, starts, joined }
    }

    pub(super) fn neighbors(&self, v: Place) -> &[Place] {
        &self.joined[self.starts[v.index()]..self.starts[v.index() + 1]]
    }

    pub(super) fn point(&self, v: Place) -> [f64; D] {
        self.points[v.index()]
    }
}

/// Works on consecutive parts of a list on all threads, and gives the results in their order.
pub(super) fn in_parts<T: Sync, R: Send>(items: &[T], work: impl Fn(&[T]) -> R + Send + Sync) -> Vec<R> {
    parallel::map(parallel::ranges(items.len()), |range| work(&items[range]))
}

/// Places met in a search of few.
#[derive(Default)]
pub(super) struct Met {
    few: Vec<Place>,
    many: std::collections::BTreeSet<Place>,
}

impl Met {
    /// Up to so many, looking through the list is the fastest way to know whether one is in it.
    const FEW: usize = 48;

    pub(super) fn clear(&mut self) {
        self.few.clear();
        self.many.clear();
    }

    /// Whether this is the first time.
    pub(super) fn insert(&mut self, v: Place) -> bool {
        if self.few.contains(&v) {
            return false;
        }
        if self.few.len() < Self::FEW {
            self.few.push(v);
            return true;
        }
        self.many.insert(v)
    }
}
