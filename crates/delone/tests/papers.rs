//! The papers' figures, as counts: seeds are fixed and no clock is asked.

use delone::{
    Algorithm2, Ask, Change, Counters, Delaunay2, Delaunay3, Hierarchy, JumpAndWalk, Locate, Nearest, Phase,
    Tally, VertexId, Work,
};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::exact;

fn uniform(n: usize) -> Vec<[f64; 2]> {
    Kind::Uniform.points(n, 12)
}

fn located(n: usize, locate: Locate) -> Delaunay2 {
    let mut d = Delaunay2::from_points(&uniform(n)).expect("finite");
    d.set_strategy(locate).expect("in range");
    d
}

/// Mean work of random queries away from the border.
fn mean(d: &Delaunay2, of: impl Fn(&Work) -> u64) -> f64 {
    let mut random = Random::new(77);
    let mut work = Work::default();
    let queries = 4_000;
    for _ in 0..queries {
        let q = [random.between(0.1, 0.9), random.between(0.1, 0.9)];
        d.find_observed(q, &mut work).expect("finite");
    }
    of(&work) as f64 / f64::from(queries)
}

#[track_caller]
fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() <= tolerance, "{value} is not {expected} up to {tolerance}");
}

/// Devroye, Mücke & Zhu 1998: a walk of length l crosses 2.16 l sqrt(n) edges and starts at the nearest of m; their
/// own implementation visited about 36 and 50 triangles, ours fewer.
#[test]
fn jump_and_walk_with_32_samples() {
    for (n, paper) in [(3_200, 36.0), (32_000, 50.0)] {
        let d = located(n, Locate::JumpAndWalk(JumpAndWalk::default().sample(32)));
        let visited = mean(&d, |work| work.visited);
        // Two more than crossings: the triangles turned through at the start, two and a half, where less is crossed.
        near(visited, 2.16 * (n as f64).sqrt() / (2.0 * 33f64.sqrt()) + 2.0, 0.1);
        assert!(visited < paper);
        assert!((mean(&d, |work| work.compared) - 32.0).abs() < 1e-9);
    }
}

/// The same: the sum of sample and walk is O(n^(1/3)) for a sample of n^(1/3), and near its minimum there.
#[test]
fn jump_and_walk_grows_with_the_cube_root() {
    let cost = |n: usize, sample| {
        let d = located(n, Locate::JumpAndWalk(JumpAndWalk::default().sample(sample)));
        mean(&d, |work| work.visited + work.compared)
    };
    for n in [1_000, 8_000, 64_000] {
        near(cost(n, None) / (n as f64).cbrt(), 2.2, 0.1);
    }
    // m + 2.16 sqrt(n) / (2 sqrt(m + 1)) is 117, 83 and 335 for these.
    let costs = [5, 40, 320].map(|m| cost(64_000, Some(m)));
    assert!(costs[1] < 0.75 * costs[0] && costs[1] < 0.3 * costs[2], "{costs:?}");
}

/// The same, remark 2: near the border a walk is half as long again. Remark 7: in space the cost is O(n^(1/4)).
#[test]
fn jump_and_walk_at_the_border_and_in_space() {
    let d = located(30_000, Locate::JumpAndWalk(JumpAndWalk::default()));
    let mut random = Random::new(5);
    let mut work = Work::default();
    for _ in 0..4_000 {
        d.find_observed([random.between(0.1, 0.9), random.between(0.0, 0.01)], &mut work).expect("finite");
    }
    near(work.visited as f64 / 4_000.0 / mean(&d, |work| work.visited), 1.42, 0.12);
    for n in [1_000, 16_000] {
        let mut d = Delaunay3::from_points(&Kind3::Cube.points(n, 3)).expect("finite");
        d.set_strategy(Locate::JumpAndWalk(JumpAndWalk::default())).expect("in range");
        let mut work = Work::default();
        for _ in 0..2_000 {
            let q = [(); 3].map(|()| random.between(0.1, 0.9));
            d.find_observed(q, &mut work).expect("finite");
        }
        let cost = (work.visited + work.compared) as f64 / 2_000.0;
        near(cost / (n as f64).powf(0.25), 3.5, 0.1);
    }
}

/// Devillers 1998, §4: levels shrink by the ratio, a level costs about 2 sqrt(4 ratio / pi) triangles and the turn at
/// its start at most, and the memory is ratio / (ratio - 1) of the triangulation's.
#[test]
fn the_hierarchy_is_shallow_and_small() {
    for ratio in [8.0, 30.0, 60.0_f64] {
        let n = 100_000;
        let d = located(n, Locate::Hierarchy(Hierarchy::default().ratio(ratio)));
        let footprint = d.footprint();
        let depth = (n as f64).ln() / ratio.ln();
        let levels = footprint.levels.len() as f64;
        assert!((levels - depth).abs() <= 1.5, "{levels} levels, log n is {depth}");
        for (i, &size) in footprint.levels.iter().enumerate() {
            let expected = n as f64 / ratio.powi(i as i32 + 1);
            if expected > 500.0 {
                near(size as f64, expected, 0.15);
            }
        }
        let total: usize = n + footprint.levels.iter().sum::<usize>();
        assert!(total as f64 <= n as f64 * (ratio / (ratio - 1.0) + 0.05));
        let bytes = (footprint.base + footprint.strategy) as f64 / footprint.base as f64;
        assert!(bytes <= ratio / (ratio - 1.0) + 0.05, "{bytes} at ratio {ratio}");
        let per_level = mean(&d, |work| work.visited) / (levels + 1.0);
        let bound = 4.0 + 2.0 * (4.0 * ratio / std::f64::consts::PI).sqrt();
        assert!(per_level > 2.0 && per_level < bound, "{per_level} triangles a level, bound {bound}");
    }
}

/// The same: from 10,000 points on the hierarchy beats sampling alone, and both beat a plain walk.
#[test]
fn the_four_modes_rank_as_in_the_paper() {
    for kind in [Kind::Uniform, Kind::Ellipse2] {
        let visited = |options| {
            let points = kind.points(20_000, 3);
            let algorithm = Algorithm2::Located { locate: Locate::Hierarchy(options), seed: 1 };
            match Delaunay2::with_algorithm(&points, algorithm).expect("finite").counters() {
                Counters::Incremental(work) => (work.visited + work.compared) as f64 / 20_000.0,
                other => panic!("{other:?}"),
            }
        };
        let [walk, sample, levels, both] = [
            Hierarchy::only_walk(),
            Hierarchy::only_sample(),
            Hierarchy::only_levels(),
            Hierarchy::default(),
        ]
        .map(visited);
        // By their times at 5,000 points the factors are 1.6 and more, and 1.1 and more.
        assert!(walk > 1.6 * sample && sample > 1.1 * levels, "{kind:?}: {walk} {sample} {levels}");
        near(both, levels, 0.35);
    }
}

/// The same, §5.4: the highest level that is used has twenty vertices or more, so that there is something to sample.
#[test]
fn the_sample_at_the_top_saves_a_walk() {
    let visited = |options| {
        let algorithm = Algorithm2::Located { locate: Locate::Hierarchy(options), seed: 1 };
        let d = Delaunay2::with_algorithm(&uniform(50_000), algorithm).expect("finite");
        d.counters().work().map_or(f64::NAN, |work| work.visited as f64 / 50_000.0)
    };
    let [levels, both] = [Hierarchy::only_levels(), Hierarchy::default()].map(visited);
    assert!(both < 0.9 * levels, "{both} with the sample, {levels} without");
}

/// Counts by phase: sample, turn, walk, nearest.
#[derive(Default)]
struct Phases {
    phase: usize,
    counts: [Work; 4],
}

impl Tally for Phases {
    fn visited(&mut self) {
        self.counts[self.phase].visited();
    }

    fn orientation(&mut self) {
        self.counts[self.phase].orientation();
    }

    fn in_circle(&mut self) {
        self.counts[self.phase].in_circle();
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

/// The same, §4.1 to §4.3: a level costs three orientations to turn, less than 2 sqrt(ratio / pi) edges to cross, and fewer than
/// eight triangles in phase 3, whichever it is.
#[test]
fn phases_cost_what_the_paper_expects() {
    let queries = Kind::Uniform.points(4_000, 5);
    for (nearest, triangles) in [(Nearest::Corner, 0.0), (Nearest::Exact, 3.4), (Nearest::InCircle, 2.95)] {
        let options = Hierarchy::default().ratio(30.0).levels(3).nearest(nearest);
        let d = located(60_000, Locate::Hierarchy(options));
        let mut phases = Phases::default();
        for &q in &queries {
            d.find_observed(q, &mut phases).expect("finite");
        }
        let each = |count: u64, levels: u64| count as f64 / (levels * queries.len() as u64) as f64;
        let [_, turn, walk, search] = phases.counts;
        near(each(turn.orientations, 3), 3.05, 0.05);
        let crossed = (each(walk.orientations, 3) - 1.0) / 2.0;
        assert!(
            crossed > 3.5 && crossed < 2.0 * (30.0 / std::f64::consts::PI).sqrt(),
            "{crossed} edges crossed"
        );
        let found = each(search.visited, 2);
        assert!((found - triangles).abs() < 0.4, "{found} triangles, {nearest:?}");
        assert_eq!(search.in_circles > 0, nearest == Nearest::InCircle);
    }
}

/// The same, appendix: the modified phase 3 leads to a hub of linear degree; so does the exact one by angles, and by circles it does not.
#[test]
fn a_hub_misleads_phase_three() {
    let visited = |n: usize, nearest| {
        let all = Kind::Hub.points(n, 1);
        let is_asked = |i: &usize| *i > 0 && i % 20 == 10;
        let points: Vec<_> = (0..n).filter(|i| !is_asked(i)).map(|i| all[i]).collect();
        let mut d = Delaunay2::from_points(&points).expect("finite");
        assert!(d.neighbors(VertexId::new(0)).count() >= n / 2);
        let mut work = Work::default();
        for seed in 0..4 {
            let options = Hierarchy::only_levels().ratio(2.0).nearest(nearest).seed(seed);
            d.set_strategy(Locate::Hierarchy(options)).expect("in range");
            for i in (0..n).filter(is_asked) {
                d.find_observed(all[i], &mut work).expect("finite");
            }
        }
        work.visited as f64 / (4 * (0..n).filter(is_asked).count()) as f64
    };
    let growth = |nearest| visited(1_600, nearest) / visited(200, nearest);
    // Eight times the points.
    let [corner, angles, circles] = [Nearest::Corner, Nearest::Exact, Nearest::InCircle].map(growth);
    assert!(corner > 4.0 && angles > 3.0 && circles < 2.5, "{corner} {angles} {circles}");
}

/// The same, §2.3 and §5.1: a new vertex is located once for all its levels; a random vertex is removed by five to six in-circle tests,
/// and not many more on all its levels.
#[test]
fn changes_are_cheap_on_all_levels() {
    let options = Hierarchy::default().ratio(3.0);
    let mut d = located(20_000, Locate::Hierarchy(options));
    d.find([0.5, 0.5]).expect("finite");
    let sizes = |d: &Delaunay2| d.footprint().levels.iter().sum::<usize>() as u64;
    let (before, mut found, mut inserted) = (sizes(&d), Work::default(), Work::default());
    for p in Kind::Uniform.points(3_000, 8) {
        d.find_observed(p, &mut found).expect("finite");
        d.insert_observed(p, &mut inserted).expect("finite");
    }
    let lifted = sizes(&d) - before;
    assert!(lifted > 1_000, "{lifted} vertices in samples");
    // A triangle or two on each level, which the descent has found.
    let more = (inserted.visited - found.visited) as f64 / lifted as f64;
    assert!((1.0..2.0).contains(&more), "{more} triangles for each new vertex of a sample");
    let removal = |locate| {
        let mut d = located(20_000, locate);
        d.find([0.5, 0.5]).expect("finite");
        let mut work = Work::default();
        let mut vertices: Vec<_> = d.vertices().collect();
        Random::new(3).shuffle(&mut vertices);
        vertices[..5_000].iter().for_each(|&v| d.remove_observed(v, &mut work).expect("a vertex"));
        work.in_circles as f64 / 5_000.0
    };
    let plain = removal(Locate::Tree);
    near(plain, 5.45, 0.03);
    near(removal(Locate::Hierarchy(options)), plain * 1.5, 0.05);
    near(removal(Locate::Hierarchy(Hierarchy::default())), plain * 30.0 / 29.0, 0.03);
}

/// Guibas, Knuth & Sharir 1992: a new point of a random order creates about six triangles (at most 22 by their bound),
/// with intermediate ones nine; it is traced once, in O(log n), by two orientations at a split and one at a flip.
#[test]
fn what_a_random_order_creates() {
    let mut traced = Vec::new();
    for n in [1_000, 10_000, 100_000] {
        let by = |locate| Algorithm2::Located { locate, seed: 4 };
        let work = |d: &Delaunay2| d.counters().work().expect("incremental");
        let d = Delaunay2::with_algorithm(&uniform(n), by(Locate::History)).expect("finite");
        let by_history = work(&d);
        near(by_history.created as f64 / n as f64, 9.0, 0.06);
        assert_eq!(by_history.created + 1, d.footprint().versions as u64);
        // A split is undone by none, and each flip makes as many as it takes.
        assert_eq!(by_history.created - by_history.destroyed, 2 * n as u64);
        traced.push(by_history.visited as f64 / n as f64 / (n as f64).ln());
        let orientations = by_history.orientations as f64 / by_history.visited as f64;
        assert!((1.0..1.5).contains(&orientations), "{orientations} a triangle");
        let cavities = Delaunay2::with_algorithm(&uniform(n), by(Locate::Tree)).expect("finite");
        near(work(&cavities).created as f64 / n as f64, 6.0, 0.05);
    }
    for per_log in traced {
        near(per_log, 3.5, 0.25);
    }
}

/// Versions beside a triangulation that changes: they go on where a search has ended.
#[test]
fn versions_go_on_as_points_come() {
    let (mut points, new) = (uniform(3_000), Kind::Uniform.points(2_000, 99));
    let mut d = Delaunay2::with_algorithm(&points, Algorithm2::Located { locate: Locate::History, seed: 4 })
        .expect("finite");
    for &q in &new {
        d.insert(q).expect("finite");
    }
    points.extend(&new);
    let sorted = |d: &Delaunay2| {
        let mut triangles: Vec<_> = d
            .triangles()
            .map(|mut t| {
                t.sort_unstable();
                t
            })
            .collect();
        triangles.sort_unstable();
        triangles
    };
    assert_eq!(sorted(&d), sorted(&Delaunay2::from_points(&points).expect("finite")));
    near(d.footprint().versions as f64 / points.len() as f64, 9.0, 0.06);
    // The triangle found has the vertex, so that there is nothing to walk.
    let mut work = Work::default();
    for (i, &q) in points.iter().enumerate() {
        assert_eq!(d.find_observed(q, &mut work).expect("finite").face(), [VertexId::new(i)]);
    }
    near(work.visited as f64 / points.len() as f64 / (points.len() as f64).ln(), 4.0, 0.25);
}

/// The same, the unlucky site of §3: most sites are on a line, and one comes in between two others high above it. The trace is
/// linear in the number of sites, as the paper says, and with binary search in the versions it is not.
#[test]
fn an_unlucky_site_is_traced_long_and_searched_fast() {
    let work = |locate, n: usize| {
        let mut d = Delaunay2::with_strategy(locate).expect("in range");
        d.locate([0.0, 0.0]).expect("finite");
        let mut bottom: Vec<f64> = (1..=n).map(|i| -(i as f64)).collect();
        Random::new(7).shuffle(&mut bottom);
        d.insert([1.0, 1.0]).expect("finite");
        for x in bottom {
            d.insert([x, 0.0]).expect("finite");
        }
        d.insert([0.0, 1.0]).expect("finite");
        let mut work = Work::default();
        d.find_observed([0.5, 1.0 - 1e-9], &mut work).expect("finite");
        work.visited + work.orientations
    };
    for n in [500, 2000] {
        assert!(work(Locate::History, n) > n as u64 / 2, "{n}: {}", work(Locate::History, n));
        let log = (n as f64).ln();
        assert!((work(Locate::Stars, n) as f64) < 2.0 * log * log, "{n}: {}", work(Locate::Stars, n));
    }
}

/// Conflict lists: fewer than 12 (H_n - 1) moves a point, and O(log n) of them.
#[test]
fn conflict_lists_move_a_point_log_n_times() {
    for n in [1_000_u32, 10_000, 100_000] {
        let algorithm = Algorithm2::ConflictLists { seed: 2 };
        let d = Delaunay2::with_algorithm(&uniform(n as usize), algorithm).expect("finite");
        let Counters::ConflictLists { moved, work } = d.counters() else { panic!("conflict lists") };
        let per_point = moved as f64 / f64::from(n);
        let harmonic: f64 = (1..=n).map(|i| 1.0 / f64::from(i)).sum();
        assert!(per_point < 12.0 * (harmonic - 1.0));
        near(per_point / f64::from(n).ln(), 3.0, 0.25);
        // Each split makes two more triangles, each flip none.
        assert_eq!(work.created - work.destroyed, 2 * u64::from(n));
    }
}

/// A hint is a few triangles away, whatever the number of points.
#[test]
fn the_hint_tree_starts_next_door() {
    let tree = located(100_000, Locate::Tree);
    let visited = mean(&tree, |work| work.visited);
    assert!(visited < 4.5, "{visited} triangles from the hint");
    let jump = located(100_000, Locate::JumpAndWalk(JumpAndWalk::default()));
    assert!(visited < mean(&jump, |work| work.visited) / 8.0);
}

/// Lecture notes: of all triangulations the Delaunay triangulation has the largest least angle. Flips lead to all of them.
#[test]
fn the_least_angle_is_the_largest() {
    let angle = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        let (u, v) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
        (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1])
    };
    for seed in 0..40 {
        let points = Kind::Uniform.points(9, seed);
        let d = Delaunay2::from_points(&points).expect("finite");
        let mut triangles: Vec<[usize; 3]> = d.triangles().map(|t| t.map(VertexId::index)).collect();
        let least = |triangles: &[[usize; 3]]| {
            let corners = triangles.iter().flat_map(|&[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]]);
            corners
                .map(|t| t.map(|i| points[i]))
                .map(|[p, q, r]| angle(p, q, r))
                .fold(f64::INFINITY, f64::min)
        };
        let best = least(&triangles);
        let mut random = Random::new(seed);
        for _ in 0..300 {
            // An edge from u to v on the left of a triangle; across it from v to u, if it is no hull edge.
            let t = random.below(triangles.len());
            triangles[t].rotate_left(random.below(3));
            let [u, v, w] = triangles[t];
            let across =
                |t: &[usize; 3]| (0..3).find(|&k| t[k] == v && t[(k + 1) % 3] == u).map(|k| t[(k + 2) % 3]);
            let Some((s, x)) = (0..triangles.len()).find_map(|s| Some((s, across(&triangles[s])?))) else {
                continue;
            };
            let turns = |a: usize, b: usize, c: usize| exact::orient2d(points[a], points[b], points[c]) > 0;
            if turns(w, u, x) && turns(x, v, w) {
                (triangles[t], triangles[s]) = ([w, u, x], [x, v, w]);
                assert!(least(&triangles) <= best + 1e-12, "seed {seed}: {triangles:?}");
            }
        }
    }
}
