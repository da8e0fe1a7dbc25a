//! The engine alone, in Criterion's way: `cargo bench -p delone`. Beside other software: `compare/`.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use delone::{Delaunay2, Delaunay3, Region2};
use delone_generators::{Kind, Kind3};

fn build(c: &mut Criterion) {
    let mut group = c.benchmark_group("build");
    group.sample_size(10);
    for kind in [Kind::Uniform, Kind::Clusters, Kind::Grid, Kind::Circle] {
        let points = kind.points(100_000, 1);
        group.throughput(Throughput::Elements(points.len() as u64));
        group.bench_function(BenchmarkId::new("plane", kind.name()), |b| {
            b.iter_batched(|| points.clone(), Delaunay2::from_vec, BatchSize::LargeInput);
        });
    }
    let points = Kind3::Cube.points(20_000, 1);
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function(BenchmarkId::new("space", "cube"), |b| {
        b.iter_batched(|| points.clone(), Delaunay3::from_vec, BatchSize::LargeInput);
    });
    group.finish();
}

fn change_and_ask(c: &mut Criterion) {
    let d = Delaunay2::from_points(&Kind::Uniform.points(100_000, 1)).expect("finite");
    let mut queries = Kind::Uniform.points(10_000, 2).into_iter().cycle();
    let mut group = c.benchmark_group("of 100000 points");
    group.bench_function("locate", |b| b.iter(|| d.locate(queries.next().expect("endless"))));
    group.bench_function("nearest", |b| b.iter(|| d.nearest(queries.next().expect("endless"))));
    let mut changing = d.clone();
    group.bench_function("insert and remove", |b| {
        b.iter(|| {
            let v = changing.insert(queries.next().expect("endless")).expect("finite").vertex();
            changing.remove(v)
        });
    });
    let square = Region2::rectangle([0.0, 0.0], [1.0, 1.0]).expect("a square");
    group.sample_size(10);
    group.bench_function("clip all cells", |b| b.iter(|| d.voronoi().clip(&square)));
    group.finish();
}

criterion_group!(benches, build, change_and_ask);
criterion_main!(benches);
