//! Formats as other programs write them: columns of geometries, lines of objects, polygons by the same extension.

use std::io::Cursor;

use delone_io::{
    Error, Format, Graph, ReadOptions, Source, holds_lines, read_graph, read_points, read_rings,
};

fn source(content: impl AsRef<[u8]>) -> Box<dyn Source> {
    Box::new(Cursor::new(content.as_ref().to_vec()))
}

fn graph(format: Format, content: impl AsRef<[u8]>) -> Result<Graph, Error> {
    read_graph(source(content), format, &ReadOptions::default(), None)
}

fn good(format: Format, content: impl AsRef<[u8]>) -> Graph {
    graph(format, content).unwrap_or_else(|error| panic!("{format}: {error}"))
}

#[test]
fn a_column_of_geometries_is_a_graph() {
    let text = "id;WKT;name\n1;\"SRID=25832;POLYGON ((0 0, 4 0, 4 4, 0 0), (1 0.5, 2 0.5, 2 1, 1 0.5))\";a\n\
        2;LINESTRING (5 5, 6 5);b\n3;POINT (7 7);c\n4;0101000000000000000000f03f0000000000000040;d\n";
    let graph = good(Format::Text, text);
    assert_eq!(graph.segments, [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [6, 7]]);
    assert_eq!(
        graph.rings.iter().map(|ring| (ring.polygon, ring.ring)).collect::<Vec<_>>(),
        [(0, 0), (0, 1)]
    );
    assert_eq!(graph.cloud.xy[8..], [[7.0, 7.0], [1.0, 2.0]]);
    assert_eq!(graph.cloud.crs.as_ref().and_then(|crs| crs.epsg), Some(25832));
    assert_eq!(graph.is_border[5..], [true, false]);
    let cloud = read_points(source(text), Format::Text, &ReadOptions::default()).expect("points");
    assert_eq!((cloud.xy, cloud.crs), (graph.cloud.xy, graph.cloud.crs));
    assert!(cloud.remarks.iter().any(|remark| remark.starts_with("the corners of 2 lines and polygons")));
    assert_eq!(read_rings(source(text), Format::Text).expect("rings").rings.len(), 2);
    // Without such a column a file is of points, and they are one ring.
    let plain = "x,y\n0,0\n1,0\n0,1\n";
    assert_eq!(good(Format::Text, plain).segments, [[0; 2]; 0]);
    assert_eq!(
        read_rings(source(plain), Format::Text).expect("a ring").rings,
        [[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]
    );
    for (text, holds) in
        [(text, true), (plain, false), ("POINT (1 2)\n", true), ("# x y\n1 2\n", false), ("", false)]
    {
        assert_eq!(holds_lines(source(text), Format::Text), holds, "{text}");
    }
    let mixed = text.replace("LINESTRING (5 5, 6 5)", "\"SRID=25833;LINESTRING (5 5, 6 5)\"");
    let error =
        read_graph(source(&mixed), Format::Text, &ReadOptions::default(), None).expect_err("two systems");
    assert_eq!(error.to_string(), "line 3: its coordinates are EPSG:25833, those before it EPSG:25832");
}

#[test]
fn lines_of_objects_are_segments() {
    let text = "l 1 2 3/7 1\nv 0 0 0\nv 4 0 1\nv 4 4 2\nv 0 4 3\nl -1 -2\nf 1 2 3\np 4\n";
    let graph = good(Format::Obj, text);
    assert_eq!(graph.segments, [[0, 1], [1, 2], [2, 0], [3, 2]]);
    assert_eq!((graph.is_border, graph.cloud.z), (vec![false; 4], Some(vec![0.0, 1.0, 2.0, 3.0])));
    assert!(
        holds_lines(source(text), Format::Obj)
            && !holds_lines(source("v 1 2 3\n# l\nf 1 1 1\n"), Format::Obj)
    );
    for (text, message) in [
        ("v 0 0 0\nl 1 2\nv 1 1\n", "line 3: z is missing"),
        ("v 0 0 0\n\nl 1 2\n", "line 3: there is no vertex 2"),
        ("v 0 0 0\nl 1 0\n", "line 2: there is no vertex 0"),
        ("v 0 0 0\nl 1 -2\n", "line 2: there is no vertex -2"),
        ("v 0 0 0\nl 1 x\n", "line 2: a corner is \"x\", not a number of the kind expected"),
    ] {
        let error = read_graph(source(text), Format::Obj, &ReadOptions::default(), None).expect_err(text);
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn polys_are_read_as_programs_write_them() {
    let plain = good(
        Format::Poly,
        "4 2 0 1\n1 0 0 1\n2 4.5 0 1\n3 4 4 1\n4 0 4 1\n2 1\n1 1 2 7\n2 2 3 8\n1\n1 1 1\n",
    );
    for text in [
        "4, 2, 0, 1\n\n1, 0, 0, 1\n2, 4.5, 0, 1\n3, 4, 4, 1\n4, 0, 4, 1\n2, 1\n1, 1, 2, 7\n2, 2, 3, 8\n1\n1, 1, 1\n",
        "4 2 0 1\n1.0 0.0D0 0 1.0\n2.0 0.45d+1 0 1\n3 4 4E0 1\n4 0 4.000 1\n\n2 1\n1 1. 2.00 7.0\n2 2 3 8\n1\n1 1 1\n",
    ] {
        assert_eq!(good(Format::Poly, text), plain, "{text}");
    }
    for text in ["1 2\n1 0 D\n", "1 2\n1.5 0 0\n", "1 2\n1 0 1x0\n", "1 2\n1 0 d0\n"] {
        assert!(graph(Format::Poly, text).is_err(), "{text}");
    }
}

#[test]
fn polys_of_osmosis_are_polygons() {
    let text = "island\n1\n  1.0E+00 2.0\n 5 2\n 5 6\n 1 2\nEND\n!lake\n 3 3\n 4 3\n 4 4\nEND\n2\n 9 9\n 10 9\n 9 10\nEND\nEND\n";
    let graph = good(Format::Poly, text);
    let rings: Vec<_> =
        graph.rings.iter().map(|ring| (ring.polygon, ring.ring, ring.segments.len())).collect();
    assert_eq!(rings, [(0, 0, 3), (0, 1, 3), (1, 0, 3)]);
    assert_eq!(graph.cloud.crs.as_ref().and_then(|crs| crs.epsg), Some(4326));
    assert_eq!(
        read_points(source(text), Format::Poly, &ReadOptions::default()).expect("points"),
        graph.cloud
    );
    let borders = read_rings(source(text), Format::Poly).expect("rings").rings;
    assert_eq!(borders.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3, 3]);
    assert_eq!(borders[1], [[3.0, 3.0], [4.0, 3.0], [4.0, 4.0]]);
    // A hole need not follow the polygon that it is in, and one in none is told.
    let late = "all\n1\n 1 2\n 5 2\n 5 6\nEND\n2\n 9 9\n 10 9\n 9 10\nEND\n!3\n 3 3\n 4 3\n 4 4\nEND\n!4\n 0 0\n 1 0\n 0 1\nEND\nEND\n";
    let graph = good(Format::Poly, late);
    let rings: Vec<_> = graph.rings.iter().map(|ring| (ring.polygon, ring.ring)).collect();
    assert_eq!(rings, [(0, 0), (0, 1), (1, 0)]);
    assert_eq!(graph.cloud.losses, ["1 holes are left out: no polygon is around them"]);
    let plain = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n0 0\n0\n";
    assert_eq!(read_rings(source(plain), Format::Poly).expect("a ring").rings.len(), 1);
    for (text, message) in [
        ("island\n1\n 1 2\n", "the file ends inside a polygon, without END"),
        ("island\n1\n 1 2\nEND\n", "the file ends without the last END"),
        (
            "island\n1\n 1 north\nEND\nEND\n",
            "line 3: the latitude is \"north\", not a number of the kind expected",
        ),
    ] {
        let error = read_graph(source(text), Format::Poly, &ReadOptions::default(), None).expect_err(text);
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn lines_of_gmsh() {
    let head =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n7 1 1 0\n9 0 1 0\n$EndNodes\n";
    let elements =
        "$Elements\n4\n1 1 2 1 1 1 2\n2 8 2 1 1 2 7 9\n3 3 2 1 1 1 2 7 9\n4 15 2 1 1 1\n$EndElements\n";
    let graph = good(Format::Msh, format!("{head}{elements}"));
    assert_eq!((&graph.segments[..], &graph.is_border[..]), (&[[0, 1], [1, 2]][..], &[true; 2][..]));
    assert!(holds_lines(source(format!("{head}{elements}")), Format::Msh));
    assert!(!holds_lines(source(head), Format::Msh));
    assert_eq!(good(Format::Msh, head).cloud.xy.len(), 4);
    // Physical groups are markers, and what else there is is told.
    assert_eq!(graph.markers, Some(vec![1, 1]));
    let groups = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"inlet\"\n1 9 \"wall\"\n$EndPhysicalNames\n\
        $Entities\n1 3 0 0\n5 0 0 0 0\n1 0 0 0 1 0 0 1 -7 2 1 2\n2 0 0 0 1 0 0 0 2 1 2\n3 0 0 0 1 0 0 2 9 7 2 1 2\n$EndEntities\n\
        $Nodes\n1 3 1 3\n0 5 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n\
        $Elements\n3 3 1 3\n1 1 1 1\n1 1 2\n1 2 1 1\n2 2 3\n1 3 1 1\n3 3 1\n$EndElements\n$NodeData\n0\n$EndNodeData\n";
    let graph = good(Format::Msh, groups);
    assert_eq!((graph.segments.len(), graph.markers), (3, Some(vec![7, 0, 9])));
    let losses =
        ["sections are left out: NodeData", "1 curves are in several physical groups: the first is taken"];
    assert_eq!(graph.cloud.losses, losses);
    assert_eq!(graph.names.boundaries(), [(7, "inlet".to_owned()), (9, "wall".to_owned())]);
    // Points have no names.
    let cloud = read_points(source(groups), Format::Msh, &ReadOptions::default()).expect("points");
    assert_eq!(cloud.losses[0], "names of physical groups are left out: 7 \"inlet\", 9 \"wall\"");
}
