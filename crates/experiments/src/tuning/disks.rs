//! Lemmas 2 and 4: how many points have a given one in their disk (Devillers 1998, §3).
//!
//! A point q of a set, and the vertex of a random sample that is nearest to it, span two disks: one of which they are a diameter,
//! and one around q with that vertex on its circle. Whatever the set, a given point w is in less than 4 and less than 6 times the
//! ratio of them, in expectation over samples. Here each point of a set is the given one, and means over many samples stand for
//! the expectation; the point with the most of them is shown.

use delone::Delaunay2;
use delone_generators::{Kind, Random};

use super::SETS;
use crate::table::short;
use crate::{Error, Findings, Options};

/// Points of a set, and samples of it.
const POINTS: usize = 500;
const SAMPLES: usize = 30;

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = format!(
        "Points that have a given one in the disk between them and their nearest in a sample, and in the disk around them: means of \
         {SAMPLES} samples of {POINTS} points (Devillers 1998, Lemmas 2 and 4)"
    );
    let heads = [
        "set",
        "ratio",
        "between, mean",
        "between, most",
        "Lemma 2",
        "around, mean",
        "around, most",
        "Lemma 4",
    ];
    let mut table = options.table("tuning-disks", &title, &heads);
    for (kind, name) in SETS {
        for ratio in [4.0, 30.0] {
            let counts = count(kind, ratio, options.seed)?;
            let mut cells = vec![name.to_owned(), ratio.to_string()];
            for (held, factor) in counts.into_iter().zip([4.0, 6.0]) {
                let mean = held.iter().sum::<f64>() / held.len() as f64;
                let most = held.iter().copied().fold(0.0, f64::max);
                cells.extend([short(mean), short(most), (factor * ratio).to_string()]);
            }
            table.row(cells);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// For each point the mean number of disks of both kinds that hold it.
fn count(kind: Kind, ratio: f64, seed: u64) -> Result<[Vec<f64>; 2], Error> {
    let points = kind.points(POINTS, seed);
    let d = Delaunay2::from_points(&points)?;
    let mut random = Random::new(seed);
    let mut held = [vec![0.0; POINTS], vec![0.0; POINTS]];
    for _ in 0..SAMPLES {
        let sample: Vec<usize> = (0..POINTS).filter(|_| random.unit() * ratio < 1.0).collect();
        let places: Vec<[f64; 2]> = sample.iter().map(|&i| points[i]).collect();
        let above = Delaunay2::from_points(&places)?;
        for (i, &q) in points.iter().enumerate() {
            // Points of the sample have no disk: they are their own nearest.
            let Some(v) =
                above.nearest(q)?.map(|v| above.point(v)).filter(|_| sample.binary_search(&i).is_err())
            else {
                continue;
            };
            let radius = (q[0] - v[0]).hypot(q[1] - v[1]);
            let middle = [0, 1].map(|k| f64::midpoint(q[k], v[k]));
            for (held, (center, radius)) in held.iter_mut().zip([(middle, radius / 2.0), (q, radius)]) {
                d.within(center, radius)?.iter().for_each(|w| held[w.index()] += 1.0 / SAMPLES as f64);
            }
        }
    }
    Ok(held)
}
