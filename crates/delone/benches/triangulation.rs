//! The engine alone, in Divan's way: `cargo bench -p delone`. Beside other software: `compare/`.

use std::hint::black_box;

use delone::{Delaunay2, Delaunay3, Region2};
use delone_generators::{Kind, Kind3};
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// Points in the plane, in space, and of a triangulation that is asked and changed.
const PLANE: usize = 100_000;
const SPACE: usize = 20_000;

#[divan::bench(args = ["uniform", "clusters", "grid", "circle"], sample_count = 10)]
fn build_plane(bencher: Bencher<'_, '_>, name: &str) {
    let points = Kind::named(name).expect("a kind").points(PLANE, 1);
    let bencher = bencher.counter(ItemsCount::new(PLANE)).with_inputs(|| points.clone());
    bencher.bench_values(Delaunay2::from_vec);
}

#[divan::bench(sample_count = 10)]
fn build_space(bencher: Bencher<'_, '_>) {
    let points = Kind3::Cube.points(SPACE, 1);
    let bencher = bencher.counter(ItemsCount::new(SPACE)).with_inputs(|| points.clone());
    bencher.bench_values(Delaunay3::from_vec);
}

/// A triangulation, and endless queries.
fn scene() -> (Delaunay2, impl Iterator<Item = [f64; 2]>) {
    let d = Delaunay2::from_points(&Kind::Uniform.points(PLANE, 1)).expect("finite");
    (d, Kind::Uniform.points(10_000, 2).into_iter().cycle())
}

#[divan::bench]
fn locate(bencher: Bencher<'_, '_>) {
    let (d, mut queries) = scene();
    bencher.bench_local(|| black_box(d.locate(queries.next().expect("endless"))).is_ok());
}

#[divan::bench]
fn nearest(bencher: Bencher<'_, '_>) {
    let (d, mut queries) = scene();
    bencher.bench_local(|| d.nearest(queries.next().expect("endless")));
}

#[divan::bench]
fn insert_and_remove(bencher: Bencher<'_, '_>) {
    let (mut d, mut queries) = scene();
    bencher.bench_local(|| {
        let v = d.insert(queries.next().expect("endless")).expect("finite").vertex();
        d.remove(v)
    });
}

#[divan::bench(sample_count = 10)]
fn clip_all_cells(bencher: Bencher<'_, '_>) {
    let (d, _) = scene();
    let square = Region2::rectangle([0.0, 0.0], [1.0, 1.0]).expect("a square");
    bencher.bench_local(|| d.voronoi().clip(&square));
}
