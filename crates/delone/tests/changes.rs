//! Insertions, removals and moves in any order: what is left is the triangulation of what is left.

use delone::{
    Algorithm2, Ask, Delaunay2, Dimension, Error, Hierarchy, Inserted, JumpAndWalk, Locate, Nearest,
    VertexId, Walk,
};
use delone_generators::{Kind, Random};
use delone_oracle::{all_cases, brute};
use proptest::prelude::*;

fn triangles(d: &Delaunay2) -> Vec<[[f64; 2]; 3]> {
    brute::normalized(d.triangles().map(|corners| corners.map(|v| d.point(v))))
}

/// Strategies under which vertices can go.
fn strategies() -> [Locate; 8] {
    [
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::Walk(Walk::Straight),
        Locate::JumpAndWalk(JumpAndWalk::default()),
        Locate::Hierarchy(Hierarchy::default().ratio(2.5).smallest_level(3)),
        Locate::Hierarchy(Hierarchy::only_levels().nearest(Nearest::Exact).ratio(4.0)),
        Locate::Hierarchy(Hierarchy::default().ratio(1.25).smallest_level(0).walk(Walk::Visibility)),
        Locate::DelaunayTree,
    ]
}

/// A triangulation and what should be in it.
struct Twin {
    d: Delaunay2,
    living: Vec<(VertexId, [f64; 2])>,
}

impl Twin {
    fn insert(&mut self, p: [f64; 2]) {
        match self.d.insert(p).expect("finite") {
            Inserted::New(v) => {
                assert_eq!(v.index() + 1, self.d.points().len(), "ids count up");
                self.living.push((v, p));
            }
            Inserted::Existing(v) => {
                let there = self.living.iter().find(|(w, _)| *w == v).expect("a living vertex");
                assert_eq!(there.1, p);
            }
        }
    }

    fn remove(&mut self, at: usize) {
        let (v, _) = self.living.swap_remove(at);
        assert_eq!(self.d.remove(v), Ok(()));
        assert_eq!(self.d.remove(v), Err(Error::NoSuchVertex { vertex: v }));
    }

    fn relocate(&mut self, at: usize, p: [f64; 2]) {
        let (v, old) = self.living[at];
        match self.d.move_to(v, p) {
            Ok(()) => self.living[at].1 = p,
            Err(Error::Occupied { vertex }) => {
                assert_eq!(self.d.point(vertex), p);
                assert_eq!(self.d.point(v), old);
            }
            Err(error) => panic!("{error}"),
        }
    }

    /// One random operation; `grows` in ten of those that change the number are insertions.
    fn step(&mut self, random: &mut Random, source: &[[f64; 2]], grows: usize) {
        let p = source[random.below(source.len())];
        match random.below(14) {
            0..4 if !self.living.is_empty() => {
                let at = random.below(self.living.len());
                self.relocate(at, p);
            }
            i if i >= 4 && i - 4 < grows || self.living.is_empty() => self.insert(p),
            _ => {
                let at = random.below(self.living.len());
                self.remove(at);
            }
        }
    }

    fn verify(&self, what: &str) {
        assert_eq!(self.d.check(), Ok(()), "{what}");
        assert_eq!(self.d.vertex_count(), self.living.len(), "{what}");
        for &(v, p) in &self.living {
            assert!(self.d.mesh().contains(v) && self.d.point(v) == p, "{what}");
        }
        let points: Vec<_> = self.living.iter().map(|(_, p)| *p).collect();
        let expected = Delaunay2::from_points(&points).expect("finite");
        assert!(triangles(&self.d) == triangles(&expected), "{what}");
        assert_eq!(self.d.dimension(), expected.dimension(), "{what}");
    }
}

#[test]
fn small_sets_are_checked_after_every_change() {
    for &kind in Kind::ALL {
        for (i, locate) in strategies().into_iter().enumerate() {
            let mut random = Random::new(100 + i as u64);
            let source = kind.points(24, 7 + i as u64);
            let mut twin =
                Twin { d: Delaunay2::with_strategy(locate).expect("in range"), living: Vec::new() };
            for step in 0..150 {
                // Up to the plane and down to nothing, several times.
                let grows = if step / 25 % 2 == 0 { 7 } else { 2 };
                twin.step(&mut random, &source, grows);
                twin.verify(&format!("{} {locate:?} step {step}", kind.name()));
            }
        }
    }
}

#[test]
fn long_mixes_end_in_the_triangulation_of_what_is_left() {
    for (i, &kind) in Kind::ALL.iter().enumerate() {
        let hard = kind.is_extreme();
        let (n, steps) = match (hard, all_cases()) {
            (true, _) => (400, 2_000),
            (false, true) => (20_000, 100_000),
            (false, false) => (6_000, 30_000),
        };
        let source = kind.points(n, 3);
        let locate = if i % 2 == 0 { Locate::Tree } else { Locate::Hierarchy(Hierarchy::default()) };
        let mut twin = Twin { d: Delaunay2::with_strategy(locate).expect("in range"), living: Vec::new() };
        let mut random = Random::new(5);
        for _ in 0..steps {
            twin.step(&mut random, &source, 7);
        }
        twin.verify(kind.name());
        // And down to the last.
        while twin.living.len() > 3 {
            let at = random.below(twin.living.len());
            twin.remove(at);
            if twin.living.len() % 5_000 == 3 {
                twin.verify(kind.name());
            }
        }
        twin.verify(kind.name());
    }
}

#[test]
fn bulk_sets_can_be_changed() {
    for &kind in Kind::ALL {
        let n = if kind.is_extreme() { 200 } else { 3_000 };
        let source = kind.points(n, 4);
        for algorithm in [Algorithm2::DivideAndConquer, Algorithm2::ConflictLists { seed: 1 }] {
            let d = Delaunay2::with_algorithm(&source, algorithm).expect("finite");
            let living = d.vertices().map(|v| (v, d.point(v))).collect();
            let mut twin = Twin { d, living };
            let mut random = Random::new(6);
            for _ in 0..n / 2 {
                twin.step(&mut random, &kind.points(50, 8), 4);
            }
            twin.verify(kind.name());
        }
    }
}

#[test]
fn adding_in_bulk_is_inserting() {
    for &kind in Kind::ALL {
        let n = if kind.is_extreme() { 100 } else { 2_000 };
        let source = kind.points(n, 4);
        let mut d = Delaunay2::from_points(&source[..n / 3]).expect("finite");
        assert_eq!(d.extend(&source[n / 3..], 9), Ok(n / 3..n));
        assert_eq!(d.check(), Ok(()), "{}", kind.name());
        let whole = Delaunay2::from_points(&source).expect("finite");
        assert!(triangles(&d) == triangles(&whole), "{}", kind.name());
        assert!(d.duplicates().eq(whole.duplicates()), "{}", kind.name());
        assert!(d.vertices().eq(whole.vertices()), "{}", kind.name());
    }
}

#[test]
fn a_vertex_of_large_degree_is_removed() {
    // A wheel, with and without the rim going all around, and with every rim point on one line.
    let rim: Vec<_> = (0..2_000).map(|i| f64::from(i) * 0.003).map(|a| [a.cos(), a.sin()]).collect();
    for (hub, rim) in [
        ([0.0, 0.0], rim.clone()),
        ([0.0, 0.0], rim[..900].to_vec()),
        ([500.5, 40.0], (0..1_000).map(|i| [f64::from(i), 0.0]).collect()),
        ([500.5, 1e6], (0..1_000).map(|i| [f64::from(i), f64::from(i % 2)]).collect()),
    ] {
        let mut points = rim.clone();
        points.push(hub);
        let mut d = Delaunay2::from_points(&points).expect("finite");
        let v = VertexId::new(rim.len());
        assert!(d.mesh().star(v).count() > 500);
        assert_eq!(d.remove(v), Ok(()));
        assert_eq!(d.check(), Ok(()));
        assert_eq!(triangles(&d), triangles(&Delaunay2::from_points(&rim).expect("finite")));
    }
}

#[test]
fn errors_change_nothing() {
    let mut d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]).expect("finite");
    assert!(matches!(d.insert([0.0, f64::NAN]), Err(Error::Coordinate { axis: 1, .. })));
    assert!(matches!(
        d.move_to(VertexId::new(0), [f64::INFINITY, 0.0]),
        Err(Error::Coordinate { axis: 0, .. })
    ));
    assert!(matches!(d.locate([f64::NAN, 0.0]), Err(Error::Coordinate { axis: 0, .. })));
    let duplicate = VertexId::new(3);
    for id in [duplicate, VertexId::new(4), VertexId::new(100), VertexId::GHOST] {
        assert_eq!(d.remove(id), Err(Error::NoSuchVertex { vertex: id }));
        assert_eq!(d.move_to(id, [5.0, 5.0]), Err(Error::NoSuchVertex { vertex: id }));
    }
    assert_eq!(d.move_to(VertexId::new(0), [0.0, 1.0]), Err(Error::Occupied { vertex: VertexId::new(2) }));
    let bad = d.extend(&[[2.0, 2.0], [f64::NAN, 0.0]], 0);
    assert!(matches!(bad, Err(Error::NotFinite { index: 1, axis: 0, .. })));
    assert_eq!((d.vertex_count(), d.points().len(), d.duplicates().count()), (3, 4, 1));
    assert_eq!(d.check(), Ok(()));

    let mut d = Delaunay2::with_strategy(Locate::History).expect("in range");
    let v = d.insert([1.0, 1.0]).expect("finite").vertex();
    assert_eq!(d.remove(v), Err(Error::InsertOnly));
    assert_eq!(d.move_to(v, [2.0, 1.0]), Err(Error::InsertOnly));
    assert_eq!(d.vertex_count(), 1);
}

#[test]
fn parameters_out_of_range_are_refused() {
    let hierarchy = Hierarchy::default();
    for (locate, name) in [
        (Locate::Hierarchy(hierarchy.ratio(1.0)), "ratio"),
        (Locate::Hierarchy(hierarchy.ratio(f64::NAN)), "ratio"),
        (Locate::Hierarchy(hierarchy.levels(0)), "levels"),
        (Locate::Hierarchy(hierarchy.rho(0.0)), "rho"),
        (Locate::JumpAndWalk(JumpAndWalk::default().rho(-1.0)), "rho"),
        (Locate::JumpAndWalk(JumpAndWalk::default().sample(0)), "sample"),
    ] {
        let error = Delaunay2::with_strategy(locate).map(|_| ()).expect_err("out of range");
        assert!(error.to_string().starts_with(name), "{error}");
        let bulk = Delaunay2::with_algorithm(&[[0.0, 0.0]], Algorithm2::Located { locate, seed: 0 });
        assert!(matches!(bulk, Err(Error::Parameter { .. })));
    }
}

#[test]
fn down_through_the_dimensions_and_up_again() {
    let mut d = Delaunay2::new();
    assert_eq!(d.dimension(), Dimension::Empty);
    for round in 0..3 {
        let ids: Vec<_> = [[0.0, 0.0], [2.0, 2.0], [1.0, 1.0], [3.0, 0.0]]
            .map(|p| d.insert(p).expect("finite"))
            .into_iter()
            .map(|inserted| match inserted {
                Inserted::New(v) => v,
                Inserted::Existing(v) => panic!("{v:?} should have been removed"),
            })
            .collect();
        assert_eq!(ids[0].index(), 4 * round);
        let mut seen = vec![d.dimension()];
        for v in ids.into_iter().rev() {
            d.remove(v).expect("a vertex");
            assert_eq!(d.check(), Ok(()));
            seen.push(d.dimension());
        }
        let [empty, point, line, plane] =
            [Dimension::Empty, Dimension::Point, Dimension::Line, Dimension::Plane];
        assert_eq!(seen, [plane, line, line, point, empty]);
    }
}

#[derive(Clone, Debug)]
enum Op {
    Insert([i8; 2]),
    Remove(usize),
    Move(usize, [i8; 2]),
}

fn op() -> impl Strategy<Value = Op> {
    let point = || [0_i8..5, 0_i8..5];
    prop_oneof![
        3 => point().prop_map(Op::Insert),
        2 => (0_usize..50).prop_map(Op::Remove),
        1 => (0_usize..50, point()).prop_map(|(i, p)| Op::Move(i, p)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn any_mix_on_a_grid(ops in prop::collection::vec(op(), 0..60), choice in 0_usize..6) {
        let locate = strategies()[choice];
        let mut twin = Twin { d: Delaunay2::with_strategy(locate).unwrap(), living: Vec::new() };
        for op in ops {
            let count = twin.living.len();
            match op {
                Op::Insert(p) => twin.insert(p.map(f64::from)),
                Op::Remove(i) if count > 0 => twin.remove(i % count),
                Op::Move(i, p) if count > 0 => twin.relocate(i % count, p.map(f64::from)),
                _ => {}
            }
            prop_assert_eq!(twin.d.check(), Ok(()));
        }
        let points: Vec<_> = twin.living.iter().map(|(_, p)| *p).collect();
        prop_assert_eq!(triangles(&twin.d), brute::delaunay(&points));
    }
}

/// A sliding window: the youngest points are there, and memory is that of the window, not of all that ever were.
#[test]
fn a_window_that_slides_for_ever_stays_small() {
    let window = 500;
    let mut random = Random::new(4);
    let mut d = Delaunay2::new();
    d.set_strategy(Locate::Hierarchy(Hierarchy::default())).expect("valid");
    let mut alive = std::collections::VecDeque::new();
    let mut most = 0;
    for k in 0..6000 {
        // Some equal others, which takes an id as well.
        let p = if k % 10 == 3 { [0.5, 0.5] } else { [random.unit(), random.unit()] };
        if let Inserted::New(v) = d.insert(p).expect("finite") {
            alive.push_back((v, p));
        }
        if alive.len() > window {
            let (v, _) = alive.pop_front().expect("there are some");
            d.remove(v).expect("a vertex");
        }
        if d.points().len() > 2 * window {
            let ids = d.compact();
            assert_eq!(ids.iter().flatten().count(), alive.len());
            for (v, p) in &mut alive {
                *v = ids[v.index()].expect("it is there");
                assert_eq!(d.point(*v), *p);
            }
            d.check().expect("canonical");
        }
        most = most.max(d.footprint().base);
    }
    assert_eq!(d.strategy(), Locate::Hierarchy(Hierarchy::default()));
    assert!(most < 400 * window, "{most} bytes for {window} points");
    let points: Vec<_> = alive.iter().map(|(_, p)| *p).collect();
    assert_eq!(d.triangle_count(), Delaunay2::from_points(&points).expect("finite").triangle_count());
    assert!(Delaunay2::new().compact().is_empty());
}

/// A duplicate is one as long as its vertex is there.
#[test]
fn duplicates_end_with_their_vertex() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0]];
    let count = |d: &Delaunay2| d.duplicates().map(|d| (d.point, d.vertex.index())).collect::<Vec<_>>();
    let mut d = Delaunay2::from_points(&points).expect("finite");
    assert_eq!(count(&d), [(3, 0), (4, 1)]);
    d.move_to(VertexId::new(0), [-1.0, 0.0]).expect("free");
    assert_eq!(count(&d), [(4, 1)]);
    d.remove(VertexId::new(1)).expect("a vertex");
    assert_eq!(count(&d), []);
}

/// The first layout comes beyond the size of a cache, and moves what a strategy knows.
#[test]
fn strategies_follow_a_layout() {
    let points = Kind::Uniform.points(34_000, 1);
    for locate in [Locate::History, Locate::Hierarchy(Hierarchy::default()), Locate::DelaunayTree] {
        let mut d = Delaunay2::with_strategy(locate).expect("in range");
        d.locate([0.5, 0.5]).expect("finite");
        d.extend(&points, 1).expect("finite");
        let mut work = delone::Work::default();
        for (i, &p) in points.iter().enumerate().step_by(97) {
            let location = d.find_observed(p, &mut work).expect("finite");
            assert_eq!(location.face(), [VertexId::new(i)], "{locate:?}");
        }
        let mean = work.visited as f64 / (points.len() / 97) as f64;
        assert!(mean < 100.0, "{locate:?}: {mean} triangles a query");
    }
}
