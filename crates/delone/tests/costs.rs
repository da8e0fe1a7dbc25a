//! Steps, counted: what a query and a change cost on every kind of points, by the default strategy. Counters are functions
//! of the input, so that bounds can be asserted; each is about twice what is counted today.

use delone::{Ask, Change, Delaunay2, Hierarchy, Inserted, JumpAndWalk, Locate, VertexId, Walk, Work};
use delone_generators::{Kind, Random};

/// Sets between whose points triangles are long and thin, by name.
fn shapes(n: usize) -> Vec<(String, Vec<[f64; 2]>)> {
    let mut random = Random::new(7);
    // Multiples of 2^-20, so that points are on their lines exactly.
    let mut share = || random.below(1 << 20) as f64 / f64::from(1 << 20);
    let mut make = |name: &str, shape: &dyn Fn(f64, f64) -> [f64; 2]| {
        let points = (0..n).map(|i| shape(share(), (i % 2) as f64)).collect();
        (name.to_owned(), points)
    };
    let angle = |x: f64| (std::f64::consts::TAU * x).sin_cos();
    vec![
        make("two sloped lines", &|x, k| [x, k + x / 4.0]),
        make("two vertical lines", &|x, k| [k, x]),
        make("cross", &|x, k| if k == 0.0 { [x - 0.5, x - 0.5] } else { [x - 0.5, 0.5 - x] }),
        make("parabola", &|x, _| [x - 0.5, (x - 0.5) * (x - 0.5)]),
        make("two circles", &|x, k| <[f64; 2]>::from(angle(x)).map(|c| c * (1.0 + k / 4.0))),
        make("two parabolas", &|x, k| [x, (2.0 * k - 1.0) * (x * x + 0.1)]),
    ]
}

fn all(n: usize) -> Vec<(String, Vec<[f64; 2]>)> {
    let kinds = Kind::ALL.iter().map(|kind| (kind.name().to_owned(), kind.points(n, 3)));
    kinds.chain(shapes(n)).collect()
}

/// Averages and the largest of counts.
#[derive(Default)]
struct Counts {
    sum: u64,
    most: u64,
    count: u64,
}

impl Counts {
    fn add(&mut self, count: u64) {
        self.sum += count;
        self.most = self.most.max(count);
        self.count += 1;
    }

    /// Holds them to bounds.
    fn hold(&self, what: &str, average: f64, most: u64) {
        let found = self.sum as f64 / self.count.max(1) as f64;
        assert!(
            found <= average && self.most <= most,
            "{what}: {found:.1} on average, {} at most",
            self.most
        );
    }
}

/// Queries beside points that are nearly on a line, and far from them along it, have nothing but slivers between: there a
/// query may visit many, if seldom.
fn beside_a_line(name: &str, n: usize) -> u64 {
    if ["near-line", "two parabolas"].contains(&name) { n as u64 } else { 0 }
}

/// Counts of one operation.
fn counted(operation: impl FnOnce(&mut Work)) -> Work {
    let mut work = Work::default();
    operation(&mut work);
    work
}

/// A triangulation that has been asked so often that it has made whatever it makes for queries.
fn asked(points: &[[f64; 2]]) -> Delaunay2 {
    let d = Delaunay2::from_points(points).expect("finite");
    let mut random = Random::new(2);
    for _ in 0..4000 {
        d.find(between(points, &mut random)).expect("finite");
    }
    d
}

/// The middle of two of the points.
fn between(points: &[[f64; 2]], random: &mut Random) -> [f64; 2] {
    let [p, q] = [(); 2].map(|()| points[random.below(points.len())]);
    [0, 1].map(|k| p[k] / 2.0 + q[k] / 2.0)
}

/// Queries among so many points of each kind.
fn queries_visit_few_triangles(n: usize) {
    for (name, points) in all(n) {
        let calm = ["uniform", "grid"].contains(&&*name);
        // Where walks are long, levels are made after some.
        let d = if calm { Delaunay2::from_points(&points).expect("finite") } else { asked(&points) };
        let mut random = Random::new(1);
        let (mut visited, mut compared) = (Counts::default(), Counts::default());
        for _ in 0..2000 {
            let middle = between(&points, &mut random);
            visited.add(counted(|work| _ = d.find_observed(middle, work).expect("finite")).visited);
            compared.add(counted(|work| _ = d.nearest_observed(middle, work).expect("finite")).compared);
        }
        let average = if calm { 6.0 } else { 400.0_f64.max(beside_a_line(&name, n) as f64 / 20.0) };
        let straight = ["two sloped lines", "two vertical lines", "cross", "parabola", "two circles"];
        let most = if calm {
            40
        } else if straight.contains(&&*name) {
            600
        } else {
            4000
        };
        visited.hold(
            &format!("{name}, {n} points: triangles of a query"),
            average,
            most.max(beside_a_line(&name, n)),
        );
        compared.hold(
            &format!("{name}, {n} points: comparisons for the nearest"),
            if calm { 12.0 } else { n as f64 },
            u64::MAX,
        );
    }
}

#[test]
fn queries_visit_few_triangles_on_any_points() {
    queries_visit_few_triangles(20_000);
}

#[test]
#[ignore = "long: .ci/run --long"]
fn queries_visit_few_triangles_on_many_points() {
    queries_visit_few_triangles(100_000);
}

/// Beyond one of the points, seen from another one: mostly outside.
fn beyond(points: &[[f64; 2]], random: &mut Random) -> [f64; 2] {
    let [p, q] = [(); 2].map(|()| points[random.below(points.len())]);
    [0, 1].map(|k| (3.0 * p[k] - 2.0 * q[k]).clamp(f64::MIN, f64::MAX))
}

/// Neither to the nearest hull edge nor to the nearest vertex.
#[test]
fn queries_outside_do_not_follow_the_hull() {
    for (name, points) in all(20_000) {
        let d = Delaunay2::from_points(&points).expect("finite");
        let mut random = Random::new(1);
        let (mut visited, mut compared) = (Counts::default(), Counts::default());
        // The vertex that all others of a hub are at is a neighbor of each, and has to be left by all of its edges.
        let rounds = if name == "hub" { 200 } else { 4000 };
        for round in 0..rounds {
            let q = beyond(&points, &mut random);
            let found = counted(|work| _ = d.find_observed(q, work).expect("finite"));
            let nearest = counted(|work| _ = d.nearest_observed(q, work).expect("finite"));
            // By then there are levels, if they are needed.
            if round >= rounds / 2 {
                visited.add(found.visited);
                compared.add(nearest.compared);
            }
        }
        let [find, near] = match &*name {
            "two sloped lines" => [500.0, 2700.0],
            "two parabolas" => [6000.0, 12_000.0],
            "near-line" => [300.0, 700.0],
            "hub" => [300.0, 22_000.0],
            _ => [300.0, 200.0],
        };
        visited.hold(&format!("{name}: triangles and hull edges"), find, u64::MAX);
        compared.hold(&format!("{name}: comparisons for the nearest"), near, u64::MAX);
    }
}

#[test]
fn changes_visit_few_triangles_on_any_points() {
    for (name, points) in all(20_000) {
        let mut d = Delaunay2::new();
        let (mut visited, mut created) = (Counts::default(), Counts::default());
        for &p in &points {
            let work = counted(|work| _ = d.insert_observed(p, work).expect("finite"));
            visited.add(work.visited);
            created.add(work.created);
        }
        let most = 2000.max(beside_a_line(&name, points.len()));
        visited.hold(&format!("{name}: triangles of an insertion"), 200.0, most);
        created.hold(&format!("{name}: new triangles of an insertion"), 20.0, u64::MAX);
        let mut tests = Counts::default();
        for i in (0..points.len()).step_by(7) {
            let v = VertexId::new(i);
            if d.mesh().contains(v) {
                let work = counted(|work| d.remove_observed(v, work).expect("a vertex"));
                tests.add(work.in_circles + work.orientations + work.created);
            }
        }
        tests.hold(&format!("{name}: tests and triangles of a removal"), 60.0, u64::MAX);
    }
}

/// A star of d triangles becomes a hole, which takes two less; what is left of a triangle is a line of two ghosts.
#[test]
fn removals_count_what_they_take_and_make() {
    for degree in [3, 6, 24, 25, 40] {
        let mut points = vec![[0.1, 0.05]];
        points.extend((0..degree).map(|i| {
            let (y, x) = (f64::from(i) * std::f64::consts::TAU / f64::from(degree)).sin_cos();
            [x, y]
        }));
        let mut d = Delaunay2::from_points(&points).expect("finite");
        let work = counted(|work| d.remove_observed(VertexId::new(0), work).expect("a vertex"));
        let degree = degree as u64;
        assert_eq!((work.destroyed, work.created), (degree, degree - 2));
    }
    for n in [3, 7] {
        let mut points = vec![[1.0, 1.0]];
        points.extend((0..n).map(|i| [f64::from(i), 0.0]));
        let mut d = Delaunay2::from_points(&points).expect("finite");
        let work = counted(|work| d.remove_observed(VertexId::new(0), work).expect("a vertex"));
        assert_eq!(work.created, 2 * n as u64 - 2);
    }
}

/// Hints are as good at any scale.
#[test]
fn queries_at_any_scale_visit_as_many() {
    let points = Kind::Uniform.points(20_000, 1);
    for exponent in [-900, -400, -160, 0, 160, 400, 900] {
        let scaled = |p: [f64; 2]| p.map(|x| x * 2f64.powi(exponent));
        let d =
            Delaunay2::from_points(&points.iter().map(|&p| scaled(p)).collect::<Vec<_>>()).expect("finite");
        let mut random = Random::new(1);
        let mut visited = Counts::default();
        for _ in 0..2000 {
            let q = scaled([random.unit(), random.unit()]);
            visited.add(counted(|work| _ = d.find_observed(q, work).expect("finite")).visited);
        }
        visited.hold(&format!("2^{exponent}: triangles of a query"), 6.0, 300);
    }
}

/// Levels are made when long walks have taken as many steps as there are vertices: that is all that it costs to wait for them.
#[test]
fn waiting_for_levels_costs_as_many_steps_as_there_are_vertices() {
    let n = 20_000;
    for (name, points) in all(n) {
        let d = Delaunay2::from_points(&points).expect("finite");
        let mut random = Random::new(1);
        let mut ask = || {
            let mut work = Work::default();
            for _ in 0..2000 {
                d.find_observed(between(&points, &mut random), &mut work).expect("finite");
            }
            work.visited
        };
        // The last walk may be across everything.
        let (cold, warm) = (ask(), ask());
        assert!(cold <= warm + 4 * n as u64, "{name}: {cold} and then {warm}");
    }
}

/// Points of a line, in three orders.
fn orders_of_a_line(n: usize) -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let along: Vec<[f64; 2]> = (0..n).map(|i| [i as f64, 3.0 * i as f64]).collect();
    let mut mixed = along.clone();
    let mut random = Random::new(5);
    (1..n).rev().for_each(|i| mixed.swap(i, random.below(i + 1)));
    let inwards = (0..n).map(|i| along[if i % 2 == 0 { i / 2 } else { n - 1 - i / 2 }]).collect();
    let backwards = along.iter().rev().copied().collect();
    vec![("along", along), ("backwards", backwards), ("mixed", mixed), ("inwards", inwards)]
}

/// Whatever strategy there is: the vertices of a line are in a tree.
#[test]
fn points_of_a_line_are_found_in_few_steps() {
    let n = 20_000;
    let strategies = [
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::JumpAndWalk(JumpAndWalk::default()),
        Locate::Hierarchy(Hierarchy::default()),
        Locate::Hierarchy(Hierarchy::only_levels()),
        Locate::DelaunayTree,
    ];
    for locate in strategies {
        for (name, points) in orders_of_a_line(n) {
            let mut d = Delaunay2::new();
            d.set_strategy(locate).expect("in range");
            let what = format!("{locate:?}, {name}");
            let mut steps = Counts::default();
            for &p in &points {
                steps.add(counted(|work| _ = d.insert_observed(p, work).expect("finite")).visited);
            }
            // Each level of a hierarchy has a tree: three of them, and what is found in each is inserted above.
            let most = if matches!(locate, Locate::Hierarchy(_)) { 90.0 } else { 40.0 };
            steps.hold(&format!("{what}: vertices of an insertion"), most, 250);
            let mut steps = Counts::default();
            for p in &points[..2000] {
                for q in [*p, p.map(|x| x + 0.25), [p[0] + 0.25, p[1] + 0.75]] {
                    steps.add(counted(|work| _ = d.find_observed(q, work).expect("finite")).visited);
                }
            }
            steps.hold(&format!("{what}: vertices of a query"), most, 250);
            for i in (0..n).step_by(2) {
                d.remove(VertexId::new(i)).expect("a vertex");
            }
            let mut steps = Counts::default();
            for (i, p) in points.iter().enumerate().take(2000) {
                let is_new = matches!(d.insert(*p).expect("finite"), Inserted::New(_));
                assert_eq!(is_new, i % 2 == 0, "{what}");
                steps.add(counted(|work| _ = d.find_observed(*p, work).expect("finite")).visited);
            }
            steps.hold(&format!("{what}: vertices of a query after removals"), most, 250);
        }
    }
}

/// Samples of points that nearly all are on one line are on that line. They lead all the same.
#[test]
fn levels_on_a_line_lead_to_what_is_beside_it() {
    let n = 16_000;
    for (name, line) in orders_of_a_line(n) {
        for options in [Hierarchy::default(), Hierarchy::only_levels()] {
            let what = format!("{name}, {options:?}");
            let apexes = [[0.0, 64_000.0], [8000.0, 64_000.0]];
            let mut d = Delaunay2::from_points(&apexes).expect("finite");
            d.set_strategy(Locate::Hierarchy(options)).expect("in range");
            let mut visited = Counts::default();
            for [x, _] in &line {
                visited.add(counted(|work| _ = d.insert_observed([*x, 0.0], work).expect("finite")).visited);
            }
            visited.hold(&format!("{what}: triangles of an insertion"), 80.0, 500);
            let mut visited = Counts::default();
            let mut random = Random::new(3);
            for _ in 0..2000 {
                let q = [n as f64 * random.unit(), random.unit()];
                visited.add(counted(|work| _ = d.find_observed(q, work).expect("finite")).visited);
            }
            visited.hold(&format!("{what}: triangles of a query"), 80.0, 300);
        }
    }
}

/// A wheel of uneven spokes, whose hub is a neighbor of all; a fan, whose hub is on the hull; and hubs that are neighbors.
fn hubs(n: usize) -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let wheel = |from: f64, turn: f64, hub: [f64; 2]| {
        let mut random = Random::new(11);
        let spoke = move |i: usize| {
            let (sin, cos) = (from + turn * i as f64 / n as f64).sin_cos();
            let length = 1.0 + 1e-6 * random.unit();
            [hub[0] + length * cos, hub[1] + length * sin]
        };
        (0..n).map(spoke).chain([hub])
    };
    let tau = std::f64::consts::TAU;
    let pair = wheel(1.0, tau - 2.0, [0.0; 2]).chain(wheel(1.0 + tau / 2.0, tau - 2.0, [1.5, 0.0]));
    vec![
        ("wheel", wheel(0.0, tau, [0.0; 2]).collect()),
        ("fan", wheel(0.1, 1.3, [0.0; 2]).collect()),
        ("two wheels", pair.collect()),
    ]
}

/// After the search in a history no star is walked around. (A Delaunay tree ends at any triangle in conflict with the query, which at a hub
/// are many.)
#[test]
fn histories_end_where_the_query_is() {
    for (name, points) in hubs(5000) {
        for locate in [Locate::History, Locate::Stars] {
            let mut d = Delaunay2::from_points(&points).expect("finite");
            d.set_strategy(locate).expect("in range");
            let mut random = Random::new(4);
            let mut visited = Counts::default();
            for round in 0..2000 {
                let hub = points[points.len() - 1];
                let near = [0, 1].map(|k| hub[k] + 0.5 * (random.unit() - 0.5));
                let q = if round % 2 == 0 { near } else { between(&points, &mut random) };
                visited.add(counted(|work| _ = d.find_observed(q, work).expect("finite")).visited);
            }
            visited.hold(&format!("{name}, {locate:?}: triangles of a query"), 90.0, 200);
        }
    }
}

/// A corner that all others are joined to, far from an arc of them.
#[test]
fn the_furthest_vertex_is_found_in_few_comparisons_at_a_hub() {
    let n = 16_384;
    let mut points: Vec<[f64; 2]> = vec![[0.0, 10.0]];
    points.extend((0..n).map(|i| {
        let (sin, cos) = (2.0 * f64::from(i) / f64::from(n) - 1.0).sin_cos();
        [sin, -cos]
    }));
    let furthest = Delaunay2::from_points(&points).expect("finite").furthest();
    let at_hub = furthest.triangles().filter(|t| t.contains(&VertexId::new(0))).count();
    assert!(at_hub > 8000, "{at_hub} triangles");
    let mut random = Random::new(1);
    let mut compared = Counts::default();
    for round in 0..4000 {
        let size = [1.0, 5.0, 100.0][round % 3];
        let q = [0, 1].map(|_| size * (random.unit() - 0.5));
        let q = if round % 2 == 0 { q } else { [q[0] / 10.0, q[1] - 5.0] };
        compared.add(counted(|work| _ = furthest.furthest_observed(q, work).expect("finite")).compared);
    }
    compared.hold("comparisons of a query", 200.0, 400);
}

/// Nor are those compared one by one that are all as far away: the points of whole numbers on a circle.
#[test]
fn the_least_of_many_furthest_vertices_is_found_in_few_comparisons() {
    let radius = 5 * 13 * 17 * 29_i32;
    let squares = |x: i32| {
        let y = f64::from(radius).powi(2) - f64::from(x).powi(2);
        let y = y.sqrt();
        (y.fract() == 0.0).then_some(y)
    };
    let on_circle = (-radius..=radius).filter_map(|x| Some([f64::from(x), squares(x)?]));
    let points: Vec<[f64; 2]> = on_circle.flat_map(|[x, y]| [[x, y], [x, -y]]).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let furthest = d.furthest();
    assert!(furthest.corners().len() > 300);
    let mut work = Work::default();
    let found = furthest.furthest_observed([0.0, 0.0], &mut work).expect("finite").expect("there are points");
    assert_eq!(d.point(found), [-f64::from(radius), 0.0]);
    assert!(work.compared < 60, "{} comparisons", work.compared);
}
