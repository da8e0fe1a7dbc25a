//! Terrain models against planes, against their own parts, and every refusal.

use std::io::Cursor;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use delone::Bounds;
use delone::surface::{Border, Grid};
use delone_io::{Cloud, Crs, Format, Graph, ReadOptions, read_graph, read_raster};
use delone_terrain::{
    Cells, Clip, Error, Files, Lines, Method, Options, Product, Remark, Surface, Terrain, read_clip,
    read_place,
};

/// Points of no pattern in a square of side 20, with heights.
fn cloud(count: u32, height: impl Fn([f64; 2]) -> f64) -> Cloud {
    let number = |i: u32, k: u32| f64::from((i * k) % 9973) / 9973.0 * 20.0;
    let mut xy: Vec<[f64; 2]> = (0..count).map(|i| [number(i, 7919), number(i, 6007)]).collect();
    xy.extend([[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]]);
    let z = Some(xy.iter().map(|&p| height(p)).collect());
    Cloud { xy, z, ..Cloud::default() }
}

fn hill([x, y]: [f64; 2]) -> f64 {
    (x / 3.0).sin() * 4.0 + (y / 5.0).cos() * 3.0
}

fn geojson(text: &str) -> Graph {
    let options = ReadOptions::default();
    read_graph(Box::new(Cursor::new(text.to_owned())), Format::GeoJson, &options, None).expect("GeoJSON")
}

fn go_on(_: usize) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn planes_stay_planes_by_every_method() {
    let plane = |[x, y]: [f64; 2]| 2.0 * x - y + 7.0;
    let cloud = cloud(500, plane);
    for method in Method::ALL {
        assert_eq!(method.name().parse(), Ok(method));
        let options = Options::new().method(method);
        let cells = Cells::new().size(0.7);
        let terrain = Terrain::new(&cloud, Lines::new(), &cells, &options).expect("a surface");
        let grid = terrain.grid();
        let values = terrain.values().expect("heights");
        assert_eq!(values.len(), 29 * 29);
        let mut known = 0;
        for (k, value) in values.iter().enumerate().filter(|value| !value.1.is_nan()) {
            let expected = plane(grid.center(k % grid.columns(), k / grid.columns()));
            let tolerance = if method == Method::Nearest { 8.0 } else { 1e-6 };
            assert!((value - expected).abs() < tolerance, "{method}: {value} for {expected}");
            known += 1;
        }
        assert_eq!(known, values.len(), "{method}");
        let rows: Vec<f64> =
            (0..grid.rows()).flat_map(|row| terrain.rows(row..row + 1).expect("a row")).collect();
        assert!(rows.iter().zip(&values).all(|(a, b)| a.to_bits() == b.to_bits()), "{method}");
    }
    assert!("cubic".parse::<Method>().is_err());
}

#[test]
fn lines_are_edges_and_water_is_level() {
    let cloud = cloud(800, hill);
    let ridge = geojson(r#"{"type": "LineString", "coordinates": [[2, 10.05, 100], [18, 10.05, 100]]}"#);
    let lake =
        r#"{"type": "Polygon", "coordinates": [[[3, 2, 5], [9, 2, 6], [9, 7, 5], [3, 7, 5], [3, 2, 5]]]}"#;
    for method in [Method::Linear, Method::Natural] {
        let mut lines = Lines::new();
        lines.breaklines(&ridge).expect("a line");
        let remarks = lines.level(&geojson(lake)).expect("a polygon");
        assert_eq!(remarks, [Remark::SeveralLevels { polygon: 0, low: 5.0, high: 6.0 }]);
        assert!(remarks[0].is_warning());
        let grid = Grid::new([0.0, 20.0], [0.1, -0.1], 200, 200).expect("a raster");
        let options = Options::new().method(method);
        let surface = Surface::new(&cloud, lines, &grid, &options).expect("a surface");
        let values = surface.values(&grid).expect("heights");
        let at = |x: f64, y: f64| values[(((20.0 - y) / 0.1) as usize) * 200 + (x / 0.1) as usize];
        assert!((at(10.0, 10.05) - 100.0).abs() < 1e-9, "{method}: {}", at(10.0, 10.05));
        assert_eq!(at(6.0, 5.0).to_bits(), 5.0_f64.to_bits(), "{method}");
        assert_ne!(at(6.0, 9.0).to_bits(), 5.0_f64.to_bits());
        let added = surface.remarks().iter().any(|remark| matches!(remark, Remark::Added { .. }));
        assert_eq!(added, method == Method::Natural);
    }
}

#[test]
fn nothing_is_outside_of_polygons_or_in_long_triangles() {
    let mut cloud = cloud(800, hill);
    let cells = Cells::new().size(0.5).extent(Bounds { low: [0.0, 0.0], high: [20.0, 20.0] });
    let known = |terrain: &Terrain| terrain.values().expect("heights").iter().filter(|z| !z.is_nan()).count();
    let all = Terrain::new(&cloud, Lines::new(), &cells, &Options::new()).expect("a surface");
    assert_eq!(known(&all), 1600);
    let square = vec![vec![[5.0, 5.0], [10.0, 5.0], [10.0, 10.0], [5.0, 10.0]]];
    assert_eq!(known(&all.clipped(Clip::new(vec![square])).expect("no system")), 100);
    cloud.xy.push([40.0, 10.0]);
    cloud.z.as_mut().expect("heights").push(0.0);
    let cells = Cells::new().size(0.5);
    let wide = Terrain::new(&cloud, Lines::new(), &cells, &Options::new()).expect("a surface");
    let options = Options::new().border(Border::long_edges(Some(6.0)));
    let short = Terrain::new(&cloud, Lines::new(), &cells, &options).expect("a surface");
    assert!(known(&wide) > known(&short) && known(&short) > 1500, "{}", known(&short));
}

#[test]
fn cells_are_those_that_were_asked_for() {
    let points = Bounds { low: [0.0, 0.0], high: [100.0, 50.0] };
    let grid = Cells::new().grid(&points, 5000).expect("cells");
    assert_eq!((grid.step(), grid.columns(), grid.rows()), ([1.0, -1.0], 100, 50));
    let cells = Cells::new().size(1000.0);
    let large = cells.grid(&points, 10).expect("one cell");
    assert!(matches!(cells.remark(&points, &large), Some(Remark::LargeCell { .. })));
    let other = Grid::new([7.0, 9.0], [3.0, -2.0], 4, 5).expect("a raster");
    let like = Cells::new().like(other).expect("north is up");
    assert_eq!(like.grid(&points, 10).expect("cells"), other);
    let south = Grid::new([7.0, 9.0], [3.0, 2.0], 4, 5).expect("a raster");
    assert!(matches!(Cells::new().like(south), Err(Error::NotNorthUp)));
    assert!(matches!(Cells::new().size(0.0).grid(&points, 10), Err(Error::Cells(_))));
    let many = Cells::new().size(1e-4).grid(&points, 10);
    assert!(matches!(many, Err(Error::TooManyCells { columns: 1_000_000, rows: 500_000, .. })));
    let far = Bounds { low: [0.0, 0.0], high: [1e9, 1.0] };
    assert!(matches!(Cells::new().grid(&far, 10), Err(Error::FarPoints { points: 10, .. })));
}

#[test]
fn refusals_name_what_is_wrong() {
    let refuse = |cloud: &Cloud| {
        Terrain::new(cloud, Lines::new(), &Cells::new(), &Options::new()).expect_err("no surface")
    };
    let with =
        |xy: &[[f64; 2]], z: &[f64]| Cloud { xy: xy.to_vec(), z: Some(z.to_vec()), ..Cloud::default() };
    assert!(matches!(refuse(&Cloud::default()), Error::NoPoints));
    let flat = Cloud { xy: vec![[0.0; 2]; 3], ..Cloud::default() };
    assert!(matches!(refuse(&flat), Error::NoHeights));
    let line = with(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], &[1.0; 3]);
    assert!(matches!(refuse(&line), Error::OneLine));
    let error = refuse(&with(&[[0.0, 0.0], [1.0, 0.0]], &[1.0, f64::NAN]));
    assert_eq!(error.to_string(), "point 1 has the height NaN, which is not finite");
    let error = refuse(&with(&[[0.0, 0.0], [1.0, f64::INFINITY]], &[1.0, 2.0]));
    assert!(matches!(error, Error::Points(delone::Error::NotFinite { index: 1, axis: 1, .. })));
    let point = geojson(r#"{"type": "Point", "coordinates": [1, 2]}"#);
    assert!(matches!(Lines::new().breaklines(&point), Err(Error::NoLine)));
    assert!(matches!(Lines::new().level(&point), Err(Error::NoLine)));
    let mut line = geojson(r#"{"type": "LineString", "coordinates": [[1, 2], [3, 4]]}"#);
    assert!(matches!(Lines::new().level(&line), Err(Error::NoPolygon)));
    assert!(matches!(Clip::of(&line), Err(Error::NoPolygon)));
    let mut cloud = cloud(50, hill);
    (cloud.crs, line.cloud.crs) = (Some(Crs::of_epsg(25832)), Some(Crs::of_epsg(25833)));
    let mut lines = Lines::new();
    lines.breaklines(&line).expect("a line");
    let error = Terrain::new(&cloud, lines, &Cells::new(), &Options::new()).expect_err("two systems");
    assert!(matches!(error, Error::Systems { .. }), "{error}");
    let terrain = Terrain::new(&cloud, Lines::new(), &Cells::new(), &Options::new()).expect("a surface");
    assert!(matches!(terrain.contours(Some(0.0)), Err(Error::Levels(_))));
    let error = Files::new(["no such.laz"]).read().expect_err("no file").to_string();
    assert!(error.starts_with("no such.laz: "), "{error}");
    assert!(matches!(read_place(Path::new("x.unknown")), Err(Error::In { .. })));
}

#[test]
fn files_are_whole_or_not_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let mut cloud = cloud(400, hill);
    cloud.crs = Some(Crs::of_epsg(25832));
    let terrain =
        Terrain::new(&cloud, Lines::new(), &Cells::new().size(0.5), &Options::new()).expect("a surface");
    let file =
        |name: &str| -> (PathBuf, Format) { (path(name), Format::of(Path::new(name)).expect("a format")) };
    let files = ["a.tif", "a.npy", "a.asc", "a.png", "a.geojson"].map(file);
    std::fs::write(path("a.prj"), "old").expect("room");
    std::fs::write(path("a.tif.aux.xml"), "old").expect("room");
    let stopped = terrain.write(&files, &Product::new(), |_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(Error::Stopped)));
    assert!(!path("a.geojson").exists() && !path("a.npy").exists());
    let mut rows = Vec::new();
    let known = terrain.write(&files, &Product::new(), |row| {
        rows.push(row);
        go_on(row)
    });
    assert_eq!((known.expect("written"), rows), (1600, vec![40]));
    assert!(!path("a.tif.aux.xml").exists() && path("a.pgw").exists());
    let (grid, crs) = read_place(&path("a.tif")).expect("a raster");
    let same = |grid: &Grid| (grid.corner(), grid.step(), grid.columns(), grid.rows());
    assert_eq!((same(&grid), crs.and_then(|crs| crs.epsg)), (same(terrain.grid()), Some(25832)));
    let nameless = Crs { name: Some("ours".to_owned()), ..Crs::default() };
    let losses = terrain.losses(&files);
    assert!(losses.len() == 1 && losses[0].contains("a.asc: "), "{losses:?}");
    let values = terrain.values().expect("heights");
    let terrain = terrain.with_crs(Some(nameless));
    assert_eq!(terrain.losses(&files).len(), 3);
    let (source, format) = delone_io::open(&path("a.npy")).expect("a raster");
    assert_eq!(read_raster(source, format).expect("a raster").values, values);
    let error = terrain.write(&[file("a.csv")], &Product::new(), go_on).expect_err("no raster");
    assert!(error.to_string().contains("a.csv: "), "{error}");
}

#[test]
fn polygons_of_files_clip() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("room");
        path
    };
    let line = write("a.geojson", r#"{"type": "LineString", "coordinates": [[1, 2], [3, 4]]}"#);
    assert!(matches!(read_clip(&line), Err(Error::In { .. })));
    let ring = read_clip(&write("b.csv", "0,0\n4,0\n4,4\n")).expect("a ring");
    let grid = Grid::new([0.0, 4.0], [1.0, -1.0], 4, 4).expect("a raster");
    let mut values = vec![1.0; 16];
    ring.apply(&grid, &mut values);
    assert_eq!(values.iter().filter(|z| z.is_nan()).count(), 6);
}
