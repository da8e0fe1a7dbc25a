//! The line of help below an error of a file: it is about the format that the file is of.

use std::fs;
use std::path::Path;

use delone_io::{Contents, Direction, Format};

use crate::place::{Place, text};

/// Files that begin as their extension says, and are wrong further on.
fn broken() -> Vec<(&'static str, Vec<u8>)> {
    const XML: &str = "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 q 1</DataArray></Points></Piece>";
    let texts = [
        ("csv", "x,y\n1,2\n3,abc\n"),
        ("pts", "2\n1 2 3\n4 q 6\n"),
        ("node", "2 2 0 0\n1 0 0\n2 q 1\n"),
        ("poly", "2 2 0 0\n1 0 0\n2 1 1\n1 0\n1 1 q\n0\n"),
        ("ptx", "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 q 1 0.5\n"),
        (
            "ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 q\n",
        ),
        (
            "lammpstrj",
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS x y z\n0 q 0\n",
        ),
        ("extxyz", "1\nProperties=species:S:1:pos:R:3\nH 0 q 0\n"),
        ("obj", "v 0 0 0\nv 1 q 2\n"),
        ("off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 q 0\n3 0 1 2\n"),
        ("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 q\nendloop\nendfacet\nendsolid a\n"),
        ("vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0\n1 q 1\n"),
        (
            "pcd",
            "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n0 q 0\n",
        ),
        ("geojson", "{\"type\":\"Point\",\"coordinates\":[1,\"q\"]}"),
        (
            "geojsonl",
            "{\"type\":\"Point\",\"coordinates\":[1,2]}\n{\"type\":\"Point\",\"coordinates\":[1,]}\n",
        ),
        ("ept", "{\"bounds\":[0,0,0,1,1,1]}"),
        ("wkt", "POINT (1 2)\nPOINT (1 q)\n"),
        ("gpx", "<gpx xmlns=\"http://www.topografix.com/GPX/1/1\"><wpt lat=\"47.5\" lon=\"q\"/></gpx>"),
        ("asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 q\n"),
        ("msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 q 0 0\n$EndNodes\n"),
        ("mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n1\n0 q 0\nEnd\n"),
        ("su2", "NDIME= 2\nNPOIN= 1\n0 q 0\n"),
        ("dxf", "0\nSECTION\n2\nENTITIES\n0\nPOINT\n10\n1.0\n20\nq\n0\nENDSEC\n0\nEOF\n"),
        ("gpkg", "SQLite format 3\0, and no pages"),
    ];
    let mut files: Vec<_> = texts.iter().map(|&(name, text)| (name, text.as_bytes().to_vec())).collect();
    for (name, kind) in [("vtu", "UnstructuredGrid"), ("vtp", "PolyData")] {
        let piece = "<Piece NumberOfPoints=\"2\" NumberOfCells=\"0\">";
        files
            .push((name, format!("<VTKFile type=\"{kind}\"><{kind}>{piece}{XML}</{kind}></VTKFile>").into()));
    }
    let rubbish = [0xf5; 500];
    for (name, head) in [
        ("las", &b"LASF"[..]),
        ("npz", b"PK\x03\x04"),
        ("e57", b"ASTM-E57"),
        ("fgb", b"fgb\x03fgb\x00"),
        ("shp", b"\0\0\x27\x0a"),
        ("tif", b"II*\0\x08\0\0\0"),
        ("wkb", b"\x01\x63\0\0\0"),
        ("npy", b"\x93NUMPY\x01\0\x10\0{'descr': '<f9'}"),
    ] {
        files.push((name, [head, &rubbish].concat()));
    }
    files.push(("bin", vec![1; 17]));
    files
}

/// The error of a file, and its help.
fn said(place: &Place, file: &str) -> (String, String) {
    let output = place.run(&format!("triangulate {file} -o out.npy"));
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{file}: {said}");
    let (error, help) = said.split_once("\nhelp: ").unwrap_or_else(|| panic!("{file}: {said}"));
    (error.to_owned(), help.trim_end().to_owned())
}

#[test]
fn it_is_about_the_format_of_the_file() {
    let place = Place::new();
    let files = broken();
    for format in Format::all().filter(|format| format.holds(Contents::Points, Direction::Read)) {
        let is_there = |name: &&str| files.iter().any(|file| file.0 == *name);
        let is_compiled = format != Format::GeoPackage || cfg!(feature = "geopackage");
        // Of well-known text in one collection no extension is.
        let has_none = format == Format::WktCollection;
        assert!(has_none || !is_compiled || format.names()[0].iter().any(is_there), "no file of {format}");
    }
    for (name, content) in &files {
        if *name == "gpkg" && !cfg!(feature = "geopackage") {
            continue;
        }
        place.file(&format!("a.{name}"), content);
        let (error, help) = said(&place, &format!("a.{name}"));
        assert!(!help.contains("--from"), "{error}: {help}");
        assert_eq!(help.contains("--columns"), *name == "csv", "{error}: {help}");
        if error.contains(": line ") {
            assert!(help.starts_with("correct that line"), "{error}: {help}");
        }
    }
}

#[test]
fn what_is_of_another_format_is_told() {
    let place = Place::new();
    let files = broken();
    let of = |name: &str| files.iter().find(|file| file.0 == name).expect(name).1.clone();
    let laz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/autzen_trim.laz");
    for (extension, content, told) in [
        ("csv", of("geojson"), "--from geojson"),
        ("geojson", of("wkt"), "--from wkt"),
        ("xyz", of("ply"), "--from ply"),
        ("tif", of("asc"), "--from asc"),
        ("ply", fs::read(laz).expect("a tile"), "--from las"),
        ("xyz", of("extxyz"), "--from extxyz"),
        ("txt", of("lammpstrj"), "--from lammpstrj"),
        ("gpkg", of("gpx"), "--from gpx"),
        ("vtu", of("vtk"), "--from vtk"),
        ("stl", of("off"), "--from off"),
        ("msh", of("mesh"), "--from mesh"),
        ("txt", of("su2"), "--from su2"),
        ("ply", of("csv"), "it does not begin as ply files do"),
        ("las", of("node"), "it does not begin as las files do"),
        ("tif", Vec::new(), "it does not begin as tif files do"),
    ] {
        if extension == "gpkg" && !cfg!(feature = "geopackage") {
            continue;
        }
        place.file(&format!("b.{extension}"), content);
        let (error, help) = said(&place, &format!("b.{extension}"));
        assert!(help.contains(told), "{error}: {help}");
    }
    // A column may be of geometries.
    place.file("c.csv", "POINT (1 2)\nPOINT (3)\n");
    assert!(!said(&place, "c.csv").1.contains("--from"));
}

#[test]
fn formats_that_go_one_way_say_so() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    for row in Format::all().filter(|format| *format != Format::WktCollection) {
        let [names, also] = row.names();
        let is_own = |name: &&&str| name.parse::<Format>().ok() == Some(row);
        for name in names.iter().chain(also).filter(is_own) {
            let (points, written) = (Contents::Points, row.holds(Contents::Points, Direction::Written));
            let output = place.run(&format!("-q generate uniform -n 9 -o a.{name}"));
            let told = text(&output.stderr);
            assert_eq!(output.status.success(), written, "{name}: {told}");
            let is_read = row.holds(points, Direction::Read);
            assert_eq!(
                told.contains(&format!("points are read from {row} files, not written")),
                is_read && !written,
                "{name}: {told}"
            );
            let reads = Contents::ALL.iter().any(|&any| row.holds(any, Direction::Read));
            if !reads {
                place.file(&format!("b.{name}"), "1 2\n");
                let told = text(&place.run(&format!("-q info b.{name}")).stderr);
                assert!(told.contains(&format!("{row} files are written alone")), "{name}: {told}");
            }
        }
    }
    // Pictures of other programs, and folders.
    place.fail("draw p.csv -o p.gif", 2, "p.gif");
    assert!(text(&place.run("draw p.csv -o p.gif").stderr).contains("svg or png"));
    fs::create_dir(place.path("data")).expect("a folder");
    for line in
        ["info data", "triangulate data -o p.ply", "voronoi p.csv --clip data -o p.svg", "check p.csv data"]
    {
        let told = text(&place.run(line).stderr);
        assert!(told.contains("folder") && !told.contains("extension"), "{line}: {told}");
    }
}

#[test]
fn fingerprints_are_of_files_that_could_have_segments_and_have_none() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n2,3\n");
    place.file("p.wkt", "MULTIPOINT((0 0),(1 0),(0 1),(2 3))\n");
    place.file("p.geojson", r#"{"type":"MultiPoint","coordinates":[[0,0],[1,0],[0,1],[2,3]]}"#);
    place.file("l.wkt", "LINESTRING(0 0,1 0,0 1)\n");
    let expected = place.succeed("-q triangulate p.csv --fingerprint");
    for name in ["p.wkt", "p.geojson"] {
        assert_eq!(place.succeed(&format!("-q triangulate {name} --fingerprint")), expected, "{name}");
    }
    place.fail("triangulate l.wkt --fingerprint", 2, "without segments");
}
