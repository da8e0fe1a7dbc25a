//! Sets of thousands of points, mixed of kinds at several scales: the same for all algorithms, orders and threads.

use std::marker::PhantomData;

use delone::Inserted;
use delone_generators::{Kind, Kind3, Random};

use crate::attack::{Attack, Judgement};
use crate::engine::{Engine, THREADS, pools, strategies};
use crate::nasty::{once_in, pick, power};

/// See the module.
pub(crate) struct Mixtures<E, const D: usize>(PhantomData<E>);

/// Points of a named kind.
fn named<const D: usize>(random: &mut Random, count: usize) -> Vec<[f64; D]> {
    let seed = random.bits();
    if D == 2 {
        let kind = pick(random, Kind::ALL);
        let count = if kind.is_extreme() { count.min(300) } else { count };
        kind.points(count, seed).into_iter().map(|p| std::array::from_fn(|k| p[k])).collect()
    } else {
        let kind = pick(random, Kind3::ALL);
        // Linked circles have a tetrahedron for each pair; magnitudes of all sizes are slow.
        let slow = matches!(kind, Kind3::Linked | Kind3::HugeSpan3);
        kind.points(if slow { count.min(150) } else { count }, seed)
            .into_iter()
            .map(|p| std::array::from_fn(|k| p[k]))
            .collect()
    }
}

/// A few shapes that the named kinds do not have.
fn shape<const D: usize>(random: &mut Random, count: usize) -> Vec<[f64; D]> {
    let axis = random.below(D);
    match random.below(6) {
        // A cross of lines through the origin.
        0 => (0..count)
            .map(|_| {
                let mut p = [0.0; D];
                p[random.below(D)] = random.below(2 * count) as f64 - count as f64;
                p
            })
            .collect(),
        // A hub, and a circle around it.
        1 => (0..count.min(1500))
            .map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / count as f64;
                let mut p = [0.0; D];
                if i > 0 {
                    (p[axis], p[(axis + 1) % D]) = (angle.cos(), angle.sin());
                }
                p
            })
            .collect(),
        // A parabola.
        2 => (0..count.min(1500))
            .map(|i| {
                let x = i as f64 - 500.0;
                let mut p = [x; D];
                p[axis] = x * x;
                p
            })
            .collect(),
        // Ever further away.
        3 => (0..count.min(400))
            .map(|i| [(); D].map(|()| random.between(-1.0, 1.0) * 2_f64.powi(i as i32 - 200)))
            .collect(),
        // On one side of the box, and one point on the other.
        4 => (0..count)
            .map(|i| {
                let mut p = [(); D].map(|()| random.below(1000) as f64);
                p[axis] = if i == 0 { 1e9 } else { 0.0 };
                p
            })
            .collect(),
        // A lattice with the least numbers mixed in; so few that most parts of the set have none.
        _ => {
            let rare = pick(random, &[50, count, 3 * count]);
            let tiny = pick(random, &[5e-324, 1e-310]);
            (0..count)
                .map(|_| {
                    [(); D].map(|()| if once_in(random, rare) { tiny } else { random.below(40) as f64 * 2.0 })
                })
                .collect()
        }
    }
}

impl<E: Engine<D> + Send, const D: usize> Attack for Mixtures<E, D> {
    type Item = [f64; D];

    fn make(random: &mut Random) -> Vec<[f64; D]> {
        let most = if D == 2 { 19_000 } else { 3_000 };
        let count = 1000 + random.below(most) / (1 + random.below(8));
        let parts = 1 + random.below(4);
        let mut points: Vec<[f64; D]> = Vec::new();
        for _ in 0..parts {
            let share = count / parts;
            let part = if once_in(random, 3) { shape(random, share) } else { named(random, share) };
            let factor = if once_in(random, 2) { 1.0 } else { power(random, -40, 40) };
            let shift = if once_in(random, 3) { power(random, -10, 30) } else { 0.0 };
            points.extend(part.into_iter().map(|p| p.map(|x| x * factor + shift)));
        }
        if once_in(random, 3) {
            for far in [1e18, -1e30, 1e300] {
                if once_in(random, 2) {
                    points.push(std::array::from_fn(|k| far * (k as f64 + 1.0)));
                }
            }
        }
        points.retain(|p| p.iter().all(|x| x.is_finite()));
        random.shuffle(&mut points);
        points
    }

    fn judge(points: &[[f64; D]], seed: u64) -> Judgement {
        let text = |error: delone::Error| error.to_string();
        let mut random = Random::new(seed);
        let first = pools()[0].install(|| E::build(points)).map_err(text)?;
        first.is_sound()?;
        let (expected, span) = (first.points_of_simplices(), first.span());
        let agrees = |made: &E, name: &str| {
            let found = made.points_of_simplices();
            if made.span() == span && found == expected {
                return Ok(());
            }
            let extra = found
                .iter()
                .find(|s| expected.binary_search_by(|t| t.partial_cmp(s).expect("finite")).is_err());
            Err(format!("{name} differs: {} simplices instead of {}, {extra:?}", found.len(), expected.len()))
        };
        for (pool, threads) in pools().iter().zip(THREADS).skip(1) {
            agrees(
                &pool.install(|| E::build(points)).map_err(text)?,
                &format!("built on {threads} threads"),
            )?;
        }
        for (name, made) in E::others(points, seed) {
            agrees(&made.map_err(text)?, &name)?;
        }
        let locate = strategies(seed)[random.below(E::STRATEGIES)];
        // A walk from the last point takes as long as there is to go.
        if points.len() < 3000 || !matches!(locate, delone::Locate::Walk(_)) {
            agrees(&E::located(points, locate, seed).map_err(text)?, &format!("{locate:?}"))?;
        }
        let mut shuffled = points.to_vec();
        random.shuffle(&mut shuffled);
        agrees(&E::build(&shuffled).map_err(text)?, "shuffled")?;
        // Half of them at once, the others one by one, and a few of them away again.
        let (old, new) = shuffled.split_at(shuffled.len().saturating_sub(200));
        let mut grown = E::build(old).map_err(text)?;
        for p in new {
            if let Inserted::New(v) = grown.insert_observed(*p, &mut ()).map_err(text)?
                && once_in(&mut random, 4)
            {
                grown.remove_observed(v, &mut ()).map_err(text)?;
                grown.insert_observed(*p, &mut ()).map_err(text)?;
            }
        }
        agrees(&grown, "grown")
    }
}
