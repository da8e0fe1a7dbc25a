//! Meshes of Medit and SU2 as others write them, whole and broken.

use crate::scene::{source, written};
use delone::Delaunay3;
use delone_generators::Kind3;
use delone_io::{
    Format, Mesh, ReadOptions, count_quads, read_graph, read_points, read_tetrahedra,
    read_triangle_attributes, read_triangles,
};

#[test]
fn tetrahedra_are_read_back() {
    let points = Kind3::Ball.points(60, 3);
    let d = Delaunay3::from_points(&points).expect("finite");
    let mesh = Mesh::new(&d, &points);
    let cells: Vec<[u64; 4]> =
        read_tetrahedra(source(&written(Format::Msh, &mesh)), Format::Msh).expect("cells");
    for format in [Format::Medit, Format::Su2] {
        let bytes = written(format, &mesh);
        assert_eq!(read_tetrahedra(source(&bytes), format).expect("cells"), cells);
        assert_eq!(
            read_triangles(source(&bytes), format).expect("the border").len(),
            d.hull_facets().count()
        );
        let cloud =
            read_points(source(&bytes), format, &ReadOptions::default().dimension(3)).expect("points");
        assert!(
            cloud
                .xy
                .iter()
                .zip(cloud.z.expect("heights"))
                .map(|(&[x, y], z)| [x, y, z])
                .eq(points.iter().copied())
        );
    }
    let text = String::from_utf8(written(Format::Nastran, &mesh)).expect("text");
    assert_eq!(text.lines().filter(|line| line.starts_with("CTETRA ")).count(), cells.len());
    let text = String::from_utf8(written(Format::Xdmf, &mesh)).expect("text");
    assert!(text.contains(&format!("TopologyType=\"Tetrahedron\" NumberOfElements=\"{}\"", cells.len())));
}

#[test]
fn names_are_tags_of_su2() {
    let text = "% a channel\nNDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3 3\n0 0 0\n4 0 1\n0 3 2\nNMARK= 3\n\
        MARKER_TAG= inlet % west\nMARKER_ELEMS= 1\n3 0 2\nMARKER_TAG= 1\nMARKER_ELEMS= 1\n3 0 1\n\
        MARKER_TAG= outlet\nMARKER_ELEMS= 1\n3 1 2\n";
    let graph =
        read_graph(source(text.as_bytes()), Format::Su2, &ReadOptions::default(), None).expect("a graph");
    assert_eq!(graph.markers, Some(vec![2, 1, 3]));
    assert_eq!(graph.names.boundaries(), [(2, "inlet".to_owned()), (3, "outlet".to_owned())]);
    assert_eq!((graph.cloud.z, graph.cloud.xy.len()), (None, 3));
    for (from, to, message) in [
        ("NDIME= 2", "NDIME= 4", "line 2: NDIME is 2 or 3"),
        ("NDIME= 2\n", "", "NDIME is said after the points"),
        ("5 0 1 2 0", "12 0 1 2 0", "line 4: elements of kind 12"),
        ("5 0 1 2 0", "9 0 1 2 0", "points 0, 1, 2 and 0, counted from 0, crosses itself or is flat"),
        ("5 0 1 2 0", "5 0 1", "line 4: a corner is missing"),
        ("5 0 1 2 0", "5 0 1 3 0", "has corner 3 from 0, but there are 3 points"),
        ("NMARK= 3", "what is this", "where a part begins"),
        ("NMARK= 3", "NCHUNK= 3", "\"NCHUNK\" is no part that is read"),
        ("NPOIN= 3 3", "NPOIN= 30", "is \"NMARK=\""),
        ("NPOIN= 3 3", "NPOIN= q", "npoin is \"q\""),
    ] {
        let text = text.replacen(from, to, 1);
        let error = read_triangles(source(text.as_bytes()), Format::Su2).expect_err(message).to_string();
        assert!(error.contains(message), "{error}, not {message}");
    }
}

#[test]
fn broken_files_of_medit_are_named() {
    let text = "MeshVersionFormatted 2 # as text\n\nDimension\n3\nVertices\n3\n0 0 1 7\n4 0 2 7\n0 3 3.5 7\nCorners\n1\n2\n\
        Edges\n1\n1 2 5\nTriangles\n1\n1 2 3 4\nEnd\nanything\n";
    let graph =
        read_graph(source(text.as_bytes()), Format::Medit, &ReadOptions::default(), None).expect("a graph");
    assert_eq!(
        (graph.segments, graph.markers, graph.cloud.z),
        (vec![[0, 1]], Some(vec![5]), Some(vec![1.0, 2.0, 3.5]))
    );
    assert_eq!(
        read_triangle_attributes(source(text.as_bytes()), Format::Medit).expect("regions").values,
        [4.0]
    );
    for (from, to, message) in [
        ("MeshVersionFormatted 2", "Mesh", "it does not begin with MeshVersionFormatted"),
        ("\n3\nVertices", "\n4\nVertices", "line 4: the dimension is 2 or 3"),
        ("Dimension\n3\n", "", "the dimension is said after the vertices"),
        ("Vertices\n3", "Vertices\n4", "line 10: x is \"Corners\""),
        ("1 2 3 4", "1 2 4 4", "line 18: there is no vertex 4"),
        ("1 2 3 4", "1 0 2 4", "line 18: there is no vertex 0"),
        ("1 2 3 4\nEnd\nanything\n", "1 2", "the file ends where a corner is expected"),
        ("Corners", "Hexahedra", "line 10: \"Hexahedra\" is no list that is read"),
        (
            "Triangles\n1\n1 2 3 4",
            "Quadrilaterals\n1\n1 2 3 3 9",
            "points 0, 1, 2 and 2, counted from 0, crosses itself",
        ),
        (
            "Vertices\n3\n0 0 1 7\n4 0 2 7\n0 3 3.5 7\nCorners\n1\n2\nEdges\n1\n1 2 5\nTriangles\n1\n1 2 3 4\n",
            "",
            "it has no Vertices",
        ),
    ] {
        let text = text.replacen(from, to, 1);
        let error = read_triangles(source(text.as_bytes()), Format::Medit).expect_err(message).to_string();
        assert!(error.contains(message), "{error}, not {message}");
    }
}

#[test]
fn quadrilaterals_of_gmsh_are_read_by_their_corners() {
    // Of first and second order, among triangles, and passed over where tetrahedra are wanted.
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 0.5 2 0\n7 0.25 0.5 0\n$EndNodes\n\
        $Elements\n4\n1 2 2 5 1 3 4 5\n2 3 2 6 1 1 2 3 4\n3 16 2 7 1 1 2 3 7 1 2 3 4\n4 1 2 8 1 1 2\n$EndElements\n";
    let triangles = read_triangles(source(text.as_bytes()), Format::Msh).expect("triangles");
    // The last one has a corner that turns to the other side.
    assert_eq!(triangles[0], [2, 3, 4]);
    assert_eq!(triangles[3..], [[1, 2, 5], [5, 0, 1]]);
    assert!(triangles[1..3].iter().all(|row| row.iter().all(|&corner| corner < 4)));
    assert_eq!(
        read_triangle_attributes(source(text.as_bytes()), Format::Msh).expect("groups").values,
        [5.0, 6.0, 6.0, 7.0, 7.0]
    );
    assert_eq!(count_quads(source(text.as_bytes()), Format::Msh).expect("a count"), 2);
    assert_eq!(read_tetrahedra(source(text.as_bytes()), Format::Msh).expect("none").len(), 0);
}
