//! Points that move by leaps: collapses, exchanges of places, spheres. An item is the path of one point.

use delone::{Delaunay2, Delaunay3, HintOrder, Hints2, Hints3, Moving2, Moving3};
use delone_generators::Random;

use super::builds::compare;
use crate::attack::{Attack, Judgement};
use crate::engine::Engine;
use crate::nasty::{self, nudged, once_in, pick};
use crate::oracle::delaunay::{delaunay, span};

/// Points, up to which all instances are compared with the definition; more of them with a construction.
const DEFINED_POINTS: usize = 9;

/// See the module.
pub(crate) struct Motion<const D: usize>;

/// The positions of one point, step by step.
type Path<const D: usize> = Vec<[f64; D]>;

/// Positions at first: a nasty set, or points on a sphere with its center.
fn start<const D: usize>(random: &mut Random) -> Vec<[f64; D]> {
    let most = if D == 2 { 60 } else { 40 };
    match random.below(3) {
        0 => nasty::points(random, most),
        1 => {
            let count = 4 + random.below(most);
            let mut points: Vec<[f64; D]> = (0..count)
                .map(|_| {
                    let v = [(); D].map(|()| random.normal());
                    let size = v.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
                    v.map(|x| x / size)
                })
                .collect();
            points[0] = [0.0; D];
            points
        }
        _ => (0..4 + random.below(most)).map(|_| [(); D].map(|()| random.unit())).collect(),
    }
}

/// The next positions.
fn moved<const D: usize>(random: &mut Random, now: &[[f64; D]], first: &[[f64; D]]) -> Vec<[f64; D]> {
    let n = now.len();
    let mut next = now.to_vec();
    if n == 0 {
        return next;
    }
    match random.below(10) {
        0 => next.fill(now[random.below(n)]),
        1 => {
            // Onto a plane, or a line.
            let axes = 1 + random.below(D - 1);
            let value = pick(random, &[0.0, 1.0, 5e-324]);
            next.iter_mut().for_each(|p| p[..axes].fill(value));
        }
        2..5 => {
            for _ in 0..=random.below(4) {
                next.swap(random.below(n), random.below(n));
            }
        }
        5 => {
            let amount = pick(random, &[1e-9, 0.01, 0.3, 10.0]);
            for p in &mut next {
                *p = p.map(|x| x + amount * random.normal() * x.abs().clamp(1e-300, 1.0));
            }
        }
        6 => {
            for _ in 0..=random.below(3) {
                next[random.below(n)] = nasty::query(random, now);
            }
        }
        7 => next.iter_mut().for_each(|p| *p = p.map(|x| nudged(random, x))),
        8 => next.rotate_left(random.below(n)),
        _ => next.copy_from_slice(first),
    }
    if next.as_flattened().iter().all(|x| x.is_finite()) { next } else { first.to_vec() }
}

fn paths<const D: usize>(random: &mut Random) -> Vec<Path<D>> {
    let first = start::<D>(random);
    let mut frames = vec![first.clone()];
    for _ in 0..=random.below(6) {
        let next = moved(random, &frames[frames.len() - 1], &first);
        frames.push(next);
        if once_in(random, 5) {
            let again = frames[random.below(frames.len())].clone();
            frames.push(again);
        }
    }
    (0..first.len()).map(|i| frames.iter().map(|frame| frame[i]).collect()).collect()
}

/// Compares what a way gave for an instance.
fn judged<E: Engine<D>, const D: usize>(found: &E, frame: &[[f64; D]], name: &str, step: usize) -> Judgement {
    let expected = if frame.len() <= DEFINED_POINTS {
        delaunay(frame)
    } else {
        E::build(frame).map_err(|error| error.to_string())?.points_of_simplices()
    };
    compare(found, span(frame), &expected, &format!("{name}, step {step}"))?;
    let twins: Vec<_> = found.duplicates().map(|d| (d.point, d.vertex.index())).collect();
    let right = twins.iter().all(|&(i, j)| frame[i] == frame[j]);
    let count = frame.len() - found.vertex_count();
    if right && twins.len() == count {
        Ok(())
    } else {
        Err(format!("{name}, step {step}: duplicates {twins:?}"))
    }
}

macro_rules! motion {
    ($d:literal, $engine:ty, $hints:ty, $moving:ty) => {
        impl Attack for Motion<$d> {
            type Item = Path<$d>;

            fn make(random: &mut Random) -> Vec<Self::Item> {
                paths(random)
            }

            fn judge(paths: &[Self::Item], seed: u64) -> Judgement {
                let steps = paths.first().map_or(1, Vec::len);
                let frames: Vec<Vec<[f64; $d]>> =
                    (0..steps).map(|step| paths.iter().map(|path| path[step]).collect()).collect();
                let text = |error: delone::Error| error.to_string();
                let mut moving = <$moving>::from_points(&frames[0]).map_err(text)?;
                let spatial = <$hints>::from_points(&frames[0], HintOrder::Spatial { seed }).map_err(text)?;
                let random = <$hints>::from_points(&frames[0], HintOrder::Random { seed }).map_err(text)?;
                let (mut followed, mut near, mut shuffled) = (spatial.clone(), spatial, random);
                for (step, frame) in frames.iter().enumerate() {
                    if step > 0 {
                        moving.step(frame).map_err(text)?;
                    }
                    judged::<$engine, $d>(moving.triangulation(), frame, "moving", step)?;
                    judged::<$engine, $d>(
                        followed.follow(frame).map_err(text)?,
                        frame,
                        "hints that follow",
                        step,
                    )?;
                    judged::<$engine, $d>(near.triangulate(frame).map_err(text)?, frame, "hints", step)?;
                    judged::<$engine, $d>(
                        shuffled.triangulate(frame).map_err(text)?,
                        frame,
                        "hints, shuffled",
                        step,
                    )?;
                }
                Ok(())
            }
        }
    };
}

motion!(2, Delaunay2, Hints2, Moving2);
motion!(3, Delaunay3, Hints3, Moving3);
