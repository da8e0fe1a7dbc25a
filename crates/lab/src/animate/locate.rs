//! Location step by step: walks, jumps, the levels of a hierarchy.

use delone::{Ask, Delaunay2, Error, Hierarchy, JumpAndWalk, Locate, Walk};
use delone_generators::Random;
use delone_io::picture::{Mark, Sketch, Tone};

use super::build::triangle;
use super::motion::window;
use super::scene::{Seen, mesh};
use crate::args::Show;

/// The ratio of sizes of two levels: small, so that few points have several levels.
const RATIO: f64 = 4.0;

/// Searches for random points: what each saw, sight by sight.
pub(super) fn descents(
    points: &[[f64; 2]],
    show: Show,
    seed: u64,
    most: usize,
) -> Result<Vec<Sketch>, Error> {
    let strategy = match show {
        Show::Jump => Locate::JumpAndWalk(JumpAndWalk::default().seed(seed)),
        Show::Levels => Locate::Hierarchy(Hierarchy::only_levels().seed(seed).ratio(RATIO).smallest_level(4)),
        _ => Locate::Walk(Walk::Straight),
    };
    let mut d = Delaunay2::from_points(points)?;
    d.set_strategy(strategy)?;
    let base = mesh(&d, Tone::Faint);
    let [low, high] = window(points);
    let mut random = Random::new(seed);
    let mut sketches = Vec::new();
    while sketches.len() < most && d.vertex_count() > 2 {
        let q = [0, 1].map(|k| {
            let share = random.unit();
            low[k] * (1.0 - share) + high[k] * share
        });
        let mut seen = Seen::default();
        d.find_observed(q, &mut seen)?;
        sketches.extend(search(&base, &seen, q, show));
        if seen.sights.is_empty() {
            break;
        }
    }
    Ok(sketches)
}

/// The pictures of one search.
fn search(base: &[Mark], seen: &Seen, q: [f64; 2], show: Show) -> Vec<Sketch> {
    let square = |p: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    let mut below = Vec::new();
    let mut above: Vec<Mark> = Vec::new();
    let mut nearest: Option<[f64; 2]> = None;
    let mut sketches = Vec::new();
    let mut visited = 0;
    for (level, sight) in &seen.sights {
        let mut current = Vec::new();
        if let &[p] = &sight[..] {
            above.push(Mark::Dot(p, Tone::Seen));
            nearest = nearest.into_iter().chain([p]).min_by(|a, b| square(*a).total_cmp(&square(*b)));
            current.push(Mark::Dot(p, Tone::Goal));
        } else {
            visited += 1;
            if show == Show::Levels {
                if sight.len() == 3 {
                    below.push(Mark::Patch(sight.clone(), *level));
                }
                let sides = (0..sight.len()).map(|k| [sight[k], sight[(k + 1) % sight.len()]]);
                current.extend(sides.map(|side| Mark::Line(side, Tone::Goal)));
            } else {
                below.extend(triangle(sight, Tone::Seen));
                current.extend(triangle(sight, Tone::Old));
            }
        }
        let mut marks = below.clone();
        marks.extend(current.iter().filter(|mark| matches!(mark, Mark::Area(..))).cloned());
        marks.extend(base.iter().cloned());
        marks.extend(above.iter().cloned());
        if let Some(p) = nearest.filter(|_| visited > 0) {
            marks.push(Mark::Line([p, q], Tone::Seen));
        }
        marks.extend(current.into_iter().filter(|mark| !matches!(mark, Mark::Area(..))));
        marks.push(Mark::Dot(q, Tone::Goal));
        let caption = match (show, visited) {
            (Show::Jump, 0) => "vertices drawn at random".to_owned(),
            (Show::Levels, _) => format!("level {level}, triangles visited: {visited}"),
            _ => format!("triangles visited: {visited}"),
        };
        sketches.push(Sketch { marks, caption, ..Sketch::default() });
    }
    sketches
}
