//! Files of Triangle beyond points and triangles: second order, attributes, markers, Voronoi diagrams.

use std::collections::BTreeMap;

use crate::scene::{Scene, least_first, sorted, source, written};
use delone::{Delaunay2, Triangulation};
use delone_generators::Kind;
use delone_io::{
    Attributes, Error, Format, Mesh, ReadOptions, read_graph, read_triangles, write_voronoi_edge,
    write_voronoi_node,
};

/// The numbers on each line but the first.
fn table(text: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| line.split(' ').map(|word| word.parse().expect("a number")).collect();
    text.lines().skip(1).map(row).collect()
}

#[test]
fn nodes_opposite_to_corners() {
    for scene in Scene::all() {
        let name = &scene.name;
        let (nodes, triangles) = (scene.written(Format::Node, true), scene.written(Format::Ele, true));
        let count = scene.points.len();
        let edges = scene.edge_markers();
        assert!(nodes.starts_with(&format!("{} 2 2 1\n", count + edges.len())), "{name}");
        assert!(triangles.starts_with(&format!("{} 6 1\n", scene.triangles().len())), "{name}");
        let (nodes, triangles) = (table(&nodes), table(&triangles));
        for (i, row) in nodes[..count].iter().enumerate() {
            let [x, y] = scene.points[i];
            let values = scene.attributes.row(i);
            assert_eq!(
                row[..],
                [i as f64, x, y, values[0], values[1], scene.point_markers[i] as f64],
                "{name}"
            );
        }
        let mut met = Vec::new();
        let mut middles = BTreeMap::new();
        for row in &triangles {
            let corner = |k: usize| row[k] as usize;
            let [a, b, c] = [corner(1), corner(2), corner(3)];
            met.push((least_first([a, b, c]), row[7]));
            for (node, ends) in [(corner(4), [b, c]), (corner(5), [c, a]), (corner(6), [a, b])] {
                assert_eq!(*middles.entry(sorted(ends)).or_insert(node), node, "{name}");
            }
        }
        met.sort_by_key(|triangle| triangle.0);
        assert_eq!(met, scene.triangles(), "{name}");
        assert!(middles.keys().eq(edges.keys()), "{name}");
        for (ends, &node) in &middles {
            let [x, y] = scene.middle(*ends);
            let [p, q] = ends.map(|i| scene.attributes.row(i));
            let mean = [0, 1].map(|k| f64::midpoint(p[k], q[k]));
            let marker = edges[ends].0 as f64;
            assert_eq!(nodes[node][..], [node as f64, x, y, mean[0], mean[1], marker], "{name}");
        }
        // The corners are read, the middles passed over.
        let read = read_triangles(source(scene.written(Format::Ele, true).as_bytes()), Format::Ele)
            .expect("triangles");
        assert_eq!(read.len(), triangles.len(), "{name}");
        // A graph has no middles, and edges none either.
        for format in [Format::Poly, Format::Edge, Format::Neigh] {
            assert_eq!(scene.written(format, true), scene.written(format, false), "{name}: {format}");
        }
        for row in table(&scene.written(Format::Edge, true)) {
            if let Some(edge) = edges.get(&sorted([row[1] as usize, row[2] as usize])) {
                assert_eq!(row[3], edge.0 as f64, "{name}");
            }
        }
    }
}

#[test]
fn attributes_and_markers_are_read_again() {
    for scene in Scene::all().filter(|scene| !scene.points.is_empty()) {
        for format in [Format::Node, Format::Poly] {
            let text = scene.written(format, false);
            let graph =
                read_graph(source(text.as_bytes()), format, &ReadOptions::default(), None).expect("a graph");
            assert_eq!(graph.cloud.xy, scene.points, "{}", scene.name);
            assert_eq!(graph.attributes, scene.attributes, "{}", scene.name);
            assert_eq!(graph.point_markers.as_ref(), Some(&scene.point_markers), "{}", scene.name);
            assert!(
                format == Format::Node || graph.markers.as_ref() == Some(&scene.markers),
                "{}",
                scene.name
            );
        }
    }
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let d = Delaunay2::from_points(&points).expect("finite");
    let plain = Mesh { heights: Some(&[5.0, 6.0, 7.0]), ..Mesh::new(&d, &points) };
    let text = |mesh: &Mesh<Delaunay2>| String::from_utf8(written(Format::Node, mesh)).expect("text");
    assert_eq!(text(&plain), "3 2 1 0\n0 0.0 0.0 5.0\n1 1.0 0.0 6.0\n2 0.0 1.0 7.0\n");
    // No attributes are none; what is too short is filled.
    let none = Attributes::default();
    let marked = Mesh { attributes: Some(&none), point_markers: Some(&[4, 3]), ..plain };
    assert_eq!(text(&marked), "3 2 1 1\n0 0.0 0.0 5.0 4\n1 1.0 0.0 6.0 3\n2 0.0 1.0 7.0 0\n");
    let short = Attributes { width: 1, values: vec![9.0] };
    let both = Mesh { attributes: Some(&short), second_order: true, base: 1, ..marked };
    let middles = "4 0.5 0.0 4.5 1\n5 0.0 0.5 4.5 1\n6 0.5 0.5 0.0 1\n";
    assert_eq!(text(&both), format!("6 2 1 1\n1 0.0 0.0 9.0 4\n2 1.0 0.0 0.0 3\n3 0.0 1.0 0.0 0\n{middles}"));
}

#[test]
fn paraview_sees_six_nodes() {
    let scene = Scene::new(delone_generators::Graph::Comb, 30);
    let constraints = scene.constraints();
    let heights: Vec<f64> = scene.points.iter().map(|p| p[0] + p[1]).collect();
    let mesh = Mesh { heights: Some(&heights), ..scene.mesh(&constraints, true) };
    let bytes = written(Format::Vtu, &mesh);
    let begins = b"encoding=\"raw\">\n_";
    let at = bytes.windows(begins.len()).position(|window| window == begins).expect("data") + begins.len();
    let mut rest = &bytes[at..];
    let mut array = || {
        let (length, more) = rest.split_first_chunk::<8>().expect("a length");
        let (array, more) = more.split_at(u64::from_le_bytes(*length) as usize);
        rest = more;
        array
    };
    let words = |array: &[u8]| -> Vec<[u8; 8]> { array.as_chunks::<8>().0.to_vec() };
    let numbers = |array: &[u8]| -> Vec<f64> { words(array).into_iter().map(f64::from_le_bytes).collect() };
    let positions = numbers(array());
    let values = numbers(array());
    let nodes: Vec<usize> =
        words(array()).into_iter().map(|word| u64::from_le_bytes(word) as usize).collect();
    let ends: Vec<u64> = words(array()).into_iter().map(u64::from_le_bytes).collect();
    let kinds = array();
    let triangles = scene.triangles().len();
    let asked: Vec<_> = scene.edge_markers().into_iter().filter(|edge| edge.1.1).collect();
    // Sides with their middles follow the triangles.
    assert_eq!(kinds, [vec![22; triangles], vec![21; asked.len()]].concat());
    let widths = std::iter::repeat_n(6, triangles).chain(std::iter::repeat_n(3, asked.len()));
    assert!(ends.iter().copied().eq(widths.scan(0, |end, width| {
        *end += width;
        Some(*end)
    })));
    assert_eq!(array().len(), 8 * ends.len(), "a region for each");
    let markers: Vec<i64> = words(array()).into_iter().map(i64::from_le_bytes).collect();
    assert!(markers[..triangles].iter().all(|&marker| marker == 0));
    let (nodes, lines) = nodes.split_at(6 * triangles);
    let mut met: Vec<_> =
        lines.chunks(3).map(|row| sorted([row[0], row[1]])).zip(markers[triangles..].to_vec()).collect();
    met.sort_unstable();
    assert_eq!(met, asked.iter().map(|&(ends, (marker, _))| (ends, marker)).collect::<Vec<_>>());
    assert_eq!(values.len(), scene.points.len() + scene.edge_markers().len());
    let text = String::from_utf8_lossy(&bytes[..at]).into_owned();
    assert!(text.contains(&format!("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", values.len(), ends.len())));
    let position = |i: usize| &positions[3 * i..3 * i + 3];
    for row in nodes.chunks(6) {
        for (node, i, j) in [(3, 0, 1), (4, 1, 2), (5, 2, 0)] {
            let (p, q) = (position(row[i]), position(row[j]));
            let middle: Vec<f64> = p.iter().zip(q).map(|(x, y)| x.midpoint(*y)).collect();
            assert_eq!(position(row[node]), middle);
            assert_eq!(values[row[node]], middle[2]);
        }
    }
}

/// The files of a Voronoi diagram, as tables.
fn voronoi<T: Triangulation<Point = [f64; 2]>>(mesh: &Mesh<T>) -> [(String, Vec<Vec<f64>>); 2] {
    let (mut nodes, mut edges) = (Vec::new(), Vec::new());
    write_voronoi_node(&mut nodes, mesh).expect("near centers");
    write_voronoi_edge(&mut edges, mesh).expect("memory takes it");
    [nodes, edges].map(|bytes| {
        let text = String::from_utf8(bytes).expect("text");
        (text.lines().next().unwrap_or_default().to_owned(), table(&text))
    })
}

#[test]
fn voronoi_edges_are_dual_to_edges() {
    for scene in Scene::all() {
        let name = &scene.name;
        let constraints = scene.constraints();
        let mesh = Mesh { base: 1, ..scene.mesh(&constraints, false) };
        let [(head, nodes), (edges_head, edges)] = voronoi(&mesh);
        assert_eq!(head, format!("{} 2 2 0", nodes.len()), "{name}");
        assert_eq!(edges_head, format!("{} 0", edges.len()), "{name}");
        let text = |format: Format| String::from_utf8(written(format, &mesh)).expect("text");
        let triangles = table(&text(Format::Ele));
        assert_eq!(nodes.len(), triangles.len(), "{name}");
        let point = |number: f64| scene.points[number as usize - 1];
        for (node, triangle) in nodes.iter().zip(&triangles) {
            assert_eq!(node[0], triangle[0], "{name}");
            let distance =
                |k: usize| (point(triangle[k])[0] - node[1]).hypot(point(triangle[k])[1] - node[2]);
            let radius = distance(1);
            assert!([2, 3].iter().all(|&k| (distance(k) - radius).abs() <= 1e-9 * radius), "{name}");
            // The first attribute is linear in the place, so it is at the center what it is anywhere.
            let expected = 2.0 * node[1] - 3.0 * node[2] + 1.0;
            let size = node[1].abs() + node[2].abs() + radius + 1.0;
            assert!((node[3] - expected).abs() <= 1e-6 * size, "{name}: {} is not {expected}", node[3]);
        }
        let plain = table(&text(Format::Edge));
        if triangles.is_empty() {
            assert!(edges.is_empty(), "{name}");
            continue;
        }
        assert_eq!(edges.len(), plain.len(), "{name}");
        for (dual, edge) in edges.iter().zip(&plain) {
            assert_eq!(dual[0], edge[0], "{name}");
            let has = |triangle: &Vec<f64>, end: f64| triangle[1..4].contains(&end);
            let beside: Vec<&Vec<f64>> = triangles
                .iter()
                .filter(|triangle| has(triangle, edge[1]) && has(triangle, edge[2]))
                .collect();
            if beside.len() == 2 {
                let mut ends = dual[1..].to_vec();
                ends.sort_by(f64::total_cmp);
                assert_eq!(ends, [beside[0][0], beside[1][0]], "{name}");
                continue;
            }
            assert_eq!((beside.len(), dual[1], dual[2]), (1, beside[0][0], -1.0), "{name}");
            // Counter-clockwise the triangle is on the left of its edge, and the ray goes to the right.
            let corners = &beside[0][1..4];
            let k =
                (0..3).find(|&k| corners[k] != edge[1] && corners[k] != edge[2]).expect("the third corner");
            let [from, to] = [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(point);
            assert_eq!(dual[3..], [to[1] - from[1], from[0] - to[0]], "{name}");
            assert!(dual[3] != 0.0 || dual[4] != 0.0, "{name}");
        }
    }
}

#[test]
fn voronoi_diagrams_at_the_limits() {
    let far = [[-1e200, 0.0], [1e200, 0.0], [0.0, 1e-20]];
    let d = Delaunay2::from_points(&far).expect("finite");
    let mesh = Mesh { base: 1, ..Mesh::new(&d, &far) };
    let mut bytes = Vec::new();
    assert!(matches!(write_voronoi_node(&mut bytes, &mesh), Err(Error::FarCenter { triangle: 1 })));
    assert!(bytes.is_empty());
    // A ray across an edge that is longer than any number.
    let long = [[-1.5e308, 0.0], [1.5e308, 0.0], [0.0, 1e308]];
    let d = Delaunay2::from_points(&long).expect("finite");
    let mut bytes = Vec::new();
    write_voronoi_edge(&mut bytes, &Mesh::new(&d, &long)).expect("memory takes it");
    let rows = table(&String::from_utf8(bytes).expect("text"));
    assert!(rows.iter().any(|row| row[3..] == [0.0, -1.5e308]), "{rows:?}");
    // Values of flat triangles are numbers all the same.
    for &kind in Kind::ALL {
        let points = kind.points(50, 1);
        let d = Delaunay2::from_points(&points).expect("finite");
        let attributes = Attributes { width: 1, values: vec![1.0; points.len()] };
        let mesh = Mesh { attributes: Some(&attributes), ..Mesh::new(&d, &points) };
        let mut bytes = Vec::new();
        if write_voronoi_node(&mut bytes, &mesh).is_ok() {
            let rows = table(&String::from_utf8(bytes).expect("text"));
            assert!(rows.iter().all(|row| (row[3] - 1.0).abs() < 1e-3), "{kind:?}");
        }
    }
}
