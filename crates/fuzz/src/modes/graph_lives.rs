//! Lives of constrained triangulations: points and segments come and go, and after each event it is what the definition says.

use delone::{Constrained2, Error, Inserted, SegmentId, VertexId};
use delone_generators::Random;
use delone_oracle::crossings::crossing_pairs;
use delone_oracle::exact::orient2d;

use super::graphs::judge;
use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};

type Point = [f64; 2];

/// See the module.
pub(crate) struct GraphLives;

/// One event; vertices and segments are counted among those that are there, around and around.
#[derive(Clone, Debug)]
pub(crate) enum Event {
    Insert(Point),
    Remove(usize),
    Join(usize, usize),
    Part(usize),
}

/// The expected points and segments, by id.
#[derive(Default)]
struct Model {
    places: Vec<Option<Point>>,
    segments: Vec<Option<[usize; 2]>>,
}

impl Model {
    fn alive(&self) -> Vec<usize> {
        (0..self.places.len()).filter(|&i| self.places[i].is_some()).collect()
    }

    /// Points and segments by index; those that were removed are away.
    fn graph(&self) -> (Vec<Point>, Vec<[usize; 2]>) {
        let alive = self.alive();
        let index = |v: usize| alive.iter().position(|&i| i == v).expect("alive");
        let segments = self.segments.iter().flatten().map(|ends| ends.map(index)).collect();
        (self.places.iter().flatten().copied().collect(), segments)
    }

    fn crosses(&self, new: [usize; 2]) -> bool {
        let (points, mut segments) = self.graph();
        let alive = self.alive();
        segments.push(new.map(|v| alive.iter().position(|&i| i == v).expect("alive")));
        !crossing_pairs(&points, &segments).is_empty()
    }

    /// Whether a vertex can go: no segment ends there, and those through it have one direction.
    fn can_go(&self, v: usize) -> bool {
        let place = |v: usize| self.places[v].expect("alive");
        let p = place(v);
        let between = |[a, b]: [Point; 2]| {
            orient2d(a, b, p) == 0 && (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
        };
        let through: Vec<[Point; 2]> = self
            .segments
            .iter()
            .flatten()
            .map(|ends| ends.map(place))
            .filter(|ends| between(*ends))
            .collect();
        let ends = self.segments.iter().flatten().any(|ends| ends.contains(&v));
        !ends
            && through
                .windows(2)
                .all(|pair| pair[1].iter().all(|&q| orient2d(pair[0][0], pair[0][1], q) == 0))
    }

    fn apply(&mut self, c: &mut Constrained2, event: &Event) -> Judgement {
        let alive = self.alive();
        match event {
            Event::Insert(p) => {
                let known = self.places.iter().position(|place| *place == Some(*p));
                let expected = known.map_or(Inserted::New(VertexId::new(self.places.len())), |i| {
                    Inserted::Existing(VertexId::new(i))
                });
                let found = c.insert(*p);
                if found != Ok(expected) {
                    return Err(format!("{found:?} instead of {expected:?}"));
                }
                if known.is_none() {
                    self.places.push(Some(*p));
                }
            }
            Event::Remove(_) | Event::Join(..) if alive.is_empty() => {}
            Event::Remove(k) => {
                let v = alive[k % alive.len()];
                match (c.remove(VertexId::new(v)), self.can_go(v)) {
                    (Ok(()), true) => self.places[v] = None,
                    (Err(Error::ConstraintsEnd { .. }), false) => {}
                    (found, can_go) => return Err(format!("{found:?}, but it can go: {can_go}")),
                }
            }
            Event::Join(j, k) => {
                let ends = [j, k].map(|i| alive[i % alive.len()]);
                match c.insert_segment(VertexId::new(ends[0]), VertexId::new(ends[1])) {
                    Err(Error::NoLength { .. }) if ends[0] == ends[1] => {}
                    Err(Error::SegmentsCross { .. }) if self.crosses(ends) => {}
                    Ok(s)
                        if ends[0] != ends[1] && s.index() == self.segments.len() && !self.crosses(ends) =>
                    {
                        self.segments.push(Some(ends));
                    }
                    found => return Err(format!("{found:?} from {} to {}", ends[0], ends[1])),
                }
            }
            Event::Part(k) => {
                let there: Vec<usize> =
                    (0..self.segments.len()).filter(|&s| self.segments[s].is_some()).collect();
                if there.is_empty() {
                    return Ok(());
                }
                let s = there[k % there.len()];
                c.remove_segment(SegmentId::new(s)).map_err(|error| error.to_string())?;
                self.segments[s] = None;
            }
        }
        let (points, segments) = self.graph();
        judge(c, &points, &segments)
    }
}

impl Attack for GraphLives {
    type Item = Event;

    fn make(random: &mut Random) -> Vec<Event> {
        // Few different places: what is inserted was there before.
        let places = {
            let mut places = nasty::points::<2>(random, 24);
            places.push(nasty::query(random, &places));
            places
        };
        let count = 1 + random.below(60);
        let event = |r: &mut Random| match r.below(10) {
            0..4 if once_in(r, 6) => Event::Insert(nasty::query(r, &places)),
            0..4 => Event::Insert(places[r.below(places.len())]),
            4 | 5 => Event::Remove(r.below(1000)),
            6..9 => Event::Join(r.below(1000), r.below(1000)),
            _ => Event::Part(r.below(1000)),
        };
        (0..count).map(|_| event(random)).collect()
    }

    fn judge(events: &[Event], _: u64) -> Judgement {
        let (mut c, mut model) = (Constrained2::new(), Model::default());
        for (i, event) in events.iter().enumerate() {
            model.apply(&mut c, event).map_err(|message| format!("event {i}, {event:?}: {message}"))?;
        }
        Ok(())
    }
}
