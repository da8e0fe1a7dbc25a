//! Meshes with constraints and regions: what each format keeps of them.

use std::io::Cursor;

use delone::{Delaunay2, RegionSeed2, Triangulation, VertexId};
use delone_io::{
    Constraints, Format, Mesh, ReadOptions, Source, Trim, picture, read_graph, read_points,
    read_triangle_attributes, read_triangles, write_mesh,
};

fn source(content: &[u8]) -> Box<dyn Source> {
    Box::new(Cursor::new(content.to_vec()))
}

/// A grid of 4 x 4 points, with its middle square as constraints, two regions and a hole.
struct Scene {
    points: Vec<[f64; 2]>,
    triangulation: Delaunay2,
    edges: Vec<[VertexId; 2]>,
    regions: Vec<f64>,
    trim: Trim,
}

const MARKERS: [i64; 4] = [5, 6, 7, -8];

impl Scene {
    fn new() -> Self {
        let points: Vec<[f64; 2]> = (0..16).map(|i| [f64::from(i % 4), f64::from(i / 4)]).collect();
        let triangulation = Delaunay2::from_points(&points).expect("finite");
        let edges = [[5, 6], [10, 6], [9, 10], [5, 9]].map(|ends| ends.map(VertexId::new)).to_vec();
        let middle = |t| {
            triangulation.corners(t).iter().fold([0.0; 2], |m, v| {
                let p = points[v.index()];
                [m[0] + p[0], m[1] + p[1]]
            })
        };
        let mut regions = vec![0.0; triangulation.slot_count()];
        for t in triangulation.triangle_ids() {
            regions[t.index()] = if middle(t)[0] < 4.5 { 1.5 } else { -2.0 };
        }
        let in_hole = |t| middle(t).iter().all(|x| (3.0..6.0).contains(x));
        let trim = Trim::keeping(&triangulation, |t| !in_hole(t));
        Self { points, triangulation, edges, regions, trim }
    }

    fn written(&self, format: Format) -> Vec<u8> {
        let seeds = [RegionSeed2::new([0.5, 0.5]).attribute(1.5)];
        let constraints = Constraints {
            edges: &self.edges,
            markers: Some(&MARKERS),
            holes: &[[1.5, 1.5]],
            regions: &seeds,
            ..Constraints::default()
        };
        let mesh = Mesh {
            base: 1,
            trim: Some(&self.trim),
            constraints: Some(&constraints),
            regions: Some(&self.regions),
            ..Mesh::new(&self.triangulation, &self.points)
        };
        let options = picture::Options { size: 400, outside: true, ..picture::Options::default() };
        let mut bytes = Vec::new();
        write_mesh(&mut bytes, format, &mesh, &options).expect("memory takes it");
        bytes
    }

    fn text(&self, format: Format) -> String {
        String::from_utf8(self.written(format)).expect("text")
    }
}

#[test]
fn regions_are_kept() {
    let scene = Scene::new();
    let left = scene.triangulation.triangle_ids().filter(|t| scene.regions[t.index()] > 0.0).count();
    // Two triangles are the hole.
    assert_eq!((scene.trim.count(), scene.triangulation.triangle_count(), left), (2, 18, 9));
    let ele = scene.written(Format::Ele);
    let triangles = read_triangles(source(&ele), Format::Ele).expect("triangles");
    let attributes = read_triangle_attributes(source(&ele), Format::Ele).expect("attributes");
    assert_eq!((triangles.len(), attributes.width, attributes.values.len()), (16, 1, 16));
    for (corners, &region) in triangles.iter().zip(&attributes.values) {
        let x: f64 = corners.iter().map(|&i| scene.points[i as usize][0]).sum();
        assert_eq!(region, if x < 4.5 { 1.5 } else { -2.0 });
    }
    let json: serde_json::Value = serde_json::from_slice(&scene.written(Format::GeoJson)).expect("JSON");
    let features = json["features"].as_array().expect("features");
    let values: Vec<f64> = features.iter().filter_map(|f| f["properties"]["region"].as_f64()).collect();
    assert_eq!(values, attributes.values);
    // The region of a face follows its three corners.
    let ply = scene.written(Format::Ply);
    assert_eq!(read_triangles(source(&ply), Format::Ply).expect("triangles"), triangles);
    let text = str::from_utf8(&ply).expect("text");
    let faces =
        text.lines().filter_map(|line| line.strip_prefix("3 ").filter(|rest| rest.split(' ').count() == 4));
    let regions = faces
        .map(|rest| rest.rsplit(' ').next().and_then(|word| word.parse::<f64>().ok()).expect("a number"));
    assert!(regions.eq(attributes.values.iter().copied()));
    let vtu = scene.written(Format::Vtu);
    assert_eq!(
        read_points(source(&vtu), Format::Vtu, &ReadOptions::default()).expect("points").xy,
        scene.points
    );
    let last: Vec<u8> = attributes.values.iter().flat_map(|value| value.to_le_bytes()).collect();
    // Sides follow the triangles, in no region.
    assert!(
        vtu.windows(last.len() + 8).any(|window| window[..last.len()] == last && window.ends_with(&[0; 8]))
    );
    assert!(
        String::from_utf8_lossy(&vtu).contains("<CellData Scalars=\"region\"><DataArray type=\"Float64\"")
    );
}

#[test]
fn constraints_are_kept() {
    let scene = Scene::new();
    let poly = read_graph(source(&scene.written(Format::Poly)), Format::Poly, &ReadOptions::default(), None);
    let poly = poly.expect("a graph");
    assert_eq!((poly.cloud.xy, poly.cloud.base), (scene.points.clone(), 1));
    assert_eq!(poly.segments, [[5, 6], [10, 6], [9, 10], [5, 9]]);
    assert_eq!((poly.markers, poly.holes), (Some(MARKERS.to_vec()), vec![[1.5, 1.5]]));
    assert_eq!((poly.regions[0].attribute, poly.regions[0].max_area), (1.5, None));
    // Markers of constraints, 1 on the border (of the hole too), 0 elsewhere.
    for line in scene.text(Format::Edge).lines().skip(1) {
        let numbers: Vec<i64> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
        let mut ends = [numbers[1] - 1, numbers[2] - 1];
        ends.sort_unstable();
        let is_hull = [0, 3].iter().any(|&side| ends.iter().all(|i| i % 4 == side))
            || [0, 3].iter().any(|&side| ends.iter().all(|i| i / 4 == side));
        let expected = match ends {
            [5, 6] => 5,
            [6, 10] => 6,
            [9, 10] => 7,
            [5, 9] => -8,
            _ => i64::from(is_hull),
        };
        assert_eq!(numbers[3], expected, "{line}");
    }
    // Without constraints the border is written as segments.
    let mesh = Mesh::new(&scene.triangulation, &scene.points);
    let mut bytes = Vec::new();
    write_mesh(&mut bytes, Format::Poly, &mesh, &picture::Options::default()).expect("memory takes it");
    let hull = read_graph(source(&bytes), Format::Poly, &ReadOptions::default(), None).expect("a graph");
    assert_eq!((hull.segments.len(), hull.markers), (12, Some(vec![1; 12])));
}

#[test]
fn geometries_are_those_of_geojson() {
    let scene = Scene::new();
    let triangles = |format: Format| {
        let graph = read_graph(source(&scene.written(format)), format, &ReadOptions::default(), None);
        let graph = graph.unwrap_or_else(|error| panic!("{format}: {error}"));
        (graph.cloud.xy, graph.segments, graph.rings)
    };
    let json = triangles(Format::GeoJson);
    assert_eq!((json.0.len(), json.2.len()), (48, 16));
    assert_eq!(triangles(Format::Wkt), json);
    assert_eq!(triangles(Format::WktCollection), json);
    assert_eq!(triangles(Format::Wkb), json);
    // Heights, systems and points go there and back.
    let heights: Vec<f64> = scene.points.iter().map(|p| p[0] * 0.1).collect();
    let crs = delone_io::Crs::of_epsg(25_832);
    let mesh =
        Mesh { heights: Some(&heights), crs: Some(&crs), ..Mesh::new(&scene.triangulation, &scene.points) };
    for format in [Format::Wkt, Format::WktCollection, Format::Wkb] {
        let mut bytes = Vec::new();
        write_mesh(&mut bytes, format, &mesh, &picture::Options::default()).expect("memory takes it");
        let cloud = read_points(source(&bytes), format, &ReadOptions::default()).expect("points");
        let z = cloud.z.expect("heights");
        assert!(cloud.xy.iter().zip(&z).all(|(p, &z)| z == p[0] * 0.1), "{format}");
        assert_eq!(cloud.crs.is_some(), format == Format::Wkb, "plain text names no system");
        let points = [[0.1, -1e-300, 1e300], [2.0, 3.0, 4.0]];
        for count in [0, 2] {
            let mut bytes = Vec::new();
            delone_io::write_points(&mut bytes, format, &points[..count]).expect("memory takes it");
            let cloud = read_points(source(&bytes), format, &ReadOptions::default()).expect("points");
            assert_eq!(
                (cloud.xy.len(), cloud.z.map(|z| z.len())),
                (count, (count > 0).then_some(2)),
                "{format}"
            );
            assert!(cloud.xy.iter().zip(&points).all(|(p, q)| p[..] == q[..2]), "{format}");
        }
    }
    let none = Delaunay2::from_points::<[f64; 2]>(&[]).expect("nothing");
    for format in [Format::Wkt, Format::WktCollection, Format::Wkb] {
        let mut bytes = Vec::new();
        write_mesh(&mut bytes, format, &Mesh::new(&none, &[]), &picture::Options::default())
            .expect("memory takes it");
        assert!(read_points(source(&bytes), format, &ReadOptions::default()).expect("nothing").xy.is_empty());
    }
}

#[test]
fn pictures_show_constraints_and_regions() {
    let scene = Scene::new();
    let svg = scene.text(Format::Svg);
    // Two regions, two colors; the lines of constraints are heavier than all others.
    let fills: std::collections::BTreeSet<&str> =
        svg.match_indices("<path fill=\"#").map(|(at, _)| &svg[at + 12..at + 19]).collect();
    let triangles = svg.lines().filter(|line| line.starts_with("<path fill=\"#"));
    assert_eq!((fills.len(), triangles.map(|line| line.matches('z').count()).sum::<usize>()), (2, 16));
    let width = |line: &str| -> f64 {
        let (_, rest) = line.split_once("stroke-width=\"").expect("a width");
        rest.split('"').next().and_then(|width| width.parse().ok()).expect("a number")
    };
    let count = |line: &str| line.split_once(" d=").map_or(0, |(_, path)| path.matches('m').count());
    let lines: Vec<&str> = svg.lines().filter(|line| line.contains("fill=\"none\" stroke=\"#")).collect();
    let (heavy, others) = lines.split_last().expect("lines");
    assert!(heavy.contains("#212121") && count(heavy) == 4, "{heavy}");
    assert!(others.iter().all(|line| width(line) < width(heavy)));
    // Six edges of the two triangles that are left out, one of them twice, are faint.
    assert_eq!(count(lines[0]), 6);
    let decoder = |bytes: &[u8]| bytes.starts_with(b"\x89PNG") && bytes.len() > 1000;
    assert!(decoder(&scene.written(Format::Png)));
}
