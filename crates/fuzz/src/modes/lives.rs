//! Lives of triangulations: vertices come, go and move, and after each change everything is asked for.

use std::marker::PhantomData;

use delone::{Error, Inserted, VertexId};
use delone_generators::Random;

use super::builds::compare;
use super::queries;
use crate::attack::{Attack, Judgement};
use crate::engine::{Engine, strategies};
use crate::nasty::{self, once_in, pick};
use crate::oracle::delaunay::{delaunay, span};

/// Vertices, up to which every triangulation is compared with the definition; a larger one with a triangulation made anew.
const DEFINED_VERTICES: usize = 9;

/// See the module.
pub(crate) struct Lives<E, const D: usize>(PhantomData<E>);

/// One event; vertices are counted among those that are there, around and around.
#[derive(Clone, Debug)]
pub(crate) enum Event<const D: usize> {
    Insert([f64; D]),
    Remove(usize),
    Move(usize, [f64; D]),
    Extend(Vec<[f64; D]>),
    Strategy(usize),
    Ask { q: [f64; D], other: [f64; D], radius: f64, k: usize },
}

/// The expected vertices: for each id given its place, if it is a vertex.
struct Model<const D: usize> {
    places: Vec<Option<[f64; D]>>,
}

impl<const D: usize> Model<D> {
    fn alive(&self) -> Vec<usize> {
        (0..self.places.len()).filter(|&i| self.places[i].is_some()).collect()
    }

    fn at(&self, p: [f64; D]) -> Option<usize> {
        self.places.iter().position(|place| *place == Some(p))
    }

    fn points(&self) -> Vec<[f64; D]> {
        self.places.iter().flatten().copied().collect()
    }

    fn apply<E: Engine<D>>(&mut self, engine: &mut E, event: &Event<D>, seed: u64) -> Judgement {
        let alive = self.alive();
        match event {
            Event::Insert(p) => {
                let expected = self.at(*p).map_or(Inserted::New(VertexId::new(self.places.len())), |i| {
                    Inserted::Existing(VertexId::new(i))
                });
                let found = engine.insert_observed(*p, &mut ());
                if found != Ok(expected) {
                    return Err(format!("insert: {found:?} instead of {expected:?}"));
                }
                if matches!(expected, Inserted::New(_)) {
                    self.places.push(Some(*p));
                }
            }
            Event::Remove(_) | Event::Move(..) if alive.is_empty() => {}
            Event::Remove(k) => {
                let i = alive[k % alive.len()];
                match engine.remove_observed(VertexId::new(i), &mut ()) {
                    Ok(()) => self.places[i] = None,
                    Err(Error::InsertOnly) => {}
                    Err(error) => return Err(format!("remove: {error}")),
                }
                let again = engine.remove_observed(VertexId::new(i), &mut ());
                if self.places[i].is_none() && !matches!(again, Err(Error::NoSuchVertex { .. })) {
                    return Err(format!("remove a second time: {again:?}"));
                }
            }
            Event::Move(k, p) => {
                let i = alive[k % alive.len()];
                let found = engine.move_to(VertexId::new(i), *p);
                match (&found, self.at(*p)) {
                    (Err(Error::InsertOnly), _) => {}
                    (Ok(()), None) => self.places[i] = Some(*p),
                    (Ok(()), Some(j)) if i == j => {}
                    (Err(Error::Occupied { vertex }), Some(j)) if i != j && vertex.index() == j => {}
                    _ => return Err(format!("move of {i} to {p:?}: {found:?}")),
                }
            }
            Event::Extend(points) => {
                let first = self.places.len();
                let found = engine.extend(points, seed);
                if found != Ok(first..first + points.len()) {
                    return Err(format!("extend: {found:?}"));
                }
                for p in points {
                    let place = if self.at(*p).is_some() { None } else { Some(*p) };
                    self.places.push(place);
                }
            }
            Event::Strategy(k) => {
                let locate = strategies(seed)[k % E::STRATEGIES];
                return engine.set_strategy(locate).map_err(|error| format!("set_strategy: {error}"));
            }
            Event::Ask { q, other, radius, k } => {
                let sites: Vec<(VertexId, [f64; D])> =
                    alive.iter().filter_map(|&i| Some((VertexId::new(i), self.places[i]?))).collect();
                return queries::judge(engine, &sites, *q, *other, *radius, *k);
            }
        }
        self.compare(engine)
    }

    /// The vertices, their places, and the triangulation.
    fn compare<E: Engine<D>>(&self, engine: &E) -> Judgement {
        let alive: Vec<usize> = engine.vertices().map(|v| v.index()).collect();
        if alive != self.alive() {
            return Err(format!("the vertices are {alive:?} instead of {:?}", self.alive()));
        }
        if let Some(i) = alive.into_iter().find(|&i| engine.position(VertexId::new(i)) != self.places[i]) {
            return Err(format!("vertex {i} is at {:?}", engine.position(VertexId::new(i))));
        }
        let points = self.points();
        let expected = if points.len() <= DEFINED_VERTICES {
            delaunay(&points)
        } else {
            E::build(&points).map_err(|error| error.to_string())?.points_of_simplices()
        };
        compare(engine, span(&points), &expected, "after it")
    }
}

impl<E: Engine<D>, const D: usize> Attack for Lives<E, D> {
    type Item = Event<D>;

    fn make(random: &mut Random) -> Vec<Event<D>> {
        let most = if D == 2 { 40 } else { 24 };
        // Few different places: what is inserted was there before, and moves meet others.
        let mut places = nasty::points::<D>(random, most);
        places.push(nasty::query(random, &places));
        let count = 1 + random.below(60);
        let event = |r: &mut Random| {
            let p = if once_in(r, 4) { nasty::query(r, &places) } else { places[r.below(places.len())] };
            match r.below(13) {
                0..4 => Event::Insert(p),
                4 | 5 => Event::Remove(r.below(1000)),
                6 | 7 => Event::Move(r.below(1000), p),
                9 if once_in(r, 4) => Event::Strategy(r.below(100)),
                8 => Event::Extend((0..r.below(12)).map(|_| places[r.below(places.len())]).collect()),
                _ => {
                    let (q, other) = (nasty::query(r, &places), nasty::query(r, &places));
                    let reach = (q[0] - other[0]).abs();
                    let radius = pick(r, &[0.0, 1.0, reach, reach.next_up(), 5e-324, 1e-160, 1e300, -1.0]);
                    Event::Ask {
                        q,
                        other,
                        radius: if radius.is_finite() { radius } else { 1e308 },
                        k: r.below(8),
                    }
                }
            }
        };
        (0..count).map(|_| event(random)).collect()
    }

    fn judge(events: &[Event<D>], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let locate = strategies(seed)[random.below(E::STRATEGIES)];
        let mut engine = E::build(&[]).map_err(|error| error.to_string())?;
        engine.set_strategy(locate).map_err(|error| error.to_string())?;
        let mut model = Model { places: Vec::new() };
        for (i, event) in events.iter().enumerate() {
            model
                .apply(&mut engine, event, seed)
                .map_err(|message| format!("{locate:?}, event {i}, {event:?}: {message}"))?;
        }
        Ok(())
    }
}
