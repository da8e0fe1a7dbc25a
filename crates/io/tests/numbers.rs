//! Numbers in files: every reader of text gives the double that is nearest to what is written, every writer writes what reads back as
//! the same bits, and the same points make the same triangles from every format.

use delone::surface::Grid;
use delone::{Delaunay2, Delaunay3};
use delone_generators::Random;
use delone_io::{
    Contents, Format, Graph, Mesh, RasterInfo, RasterWriter, ReadOptions, Sample, picture, read_areas,
    read_graph, read_numbers, read_points, read_raster, write_graph, write_mesh, write_points,
};
use delone_oracle::share;
use num_bigint::BigUint;

use crate::meshes;
use crate::scene::{source, written};

/// A number as text, and the double nearest to it.
type Number = (String, f64);

/// A finite double of any size: its bits are random.
fn any(random: &mut Random) -> f64 {
    loop {
        let number = f64::from_bits(random.bits());
        if number.is_finite() {
            return number;
        }
    }
}

/// A number of any kind.
fn number(random: &mut Random) -> Number {
    let (text, nearest) = match random.below(8) {
        0 => subnormal(random),
        // As programs write coordinates: 15 to 17 digits, of which the standard library is the judge.
        1 | 2 => {
            let digits = 9 + random.below(6);
            let text = format!("{:.digits$}", random.between(0.0, 360.0));
            let nearest = text.parse().expect("digits");
            (text, nearest)
        }
        3 => shortest(random),
        _ => beside_a_half(random),
    };
    if random.below(2) == 0 { (format!("-{text}"), -nearest) } else { (text, nearest) }
}

fn subnormal(random: &mut Random) -> Number {
    let number = f64::from_bits(random.bits() >> (12 + random.below(52)));
    (format!("{number:e}"), number)
}

/// The shortest digits that tell a double from others, with an exponent or with all zeros.
fn shortest(random: &mut Random) -> Number {
    let number = any(random).abs();
    (if random.below(2) == 0 { format!("{number:e}") } else { format!("{number}") }, number)
}

/// The number halfway between two doubles, exactly: it is rounded to the even one. Or it is one unit of its last digit, which may
/// be the 800th, more or less.
fn beside_a_half(random: &mut Random) -> Number {
    let low = any(random).abs().min(f64::MAX.next_down());
    let bits = low.to_bits();
    let (fraction, exponent) = (bits & ((1 << 52) - 1), (bits >> 52) as i32);
    let (whole, power) =
        if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    // Twice as fine: (2 whole + 1) 2^(power - 1), as digits and a power of ten.
    let half = BigUint::from(2 * whole + 1);
    let (digits, ten) = match power - 1 {
        up @ 0.. => (half << up, 0),
        down => (half * BigUint::from(5_u32).pow(down.unsigned_abs()), down),
    };
    let even = if whole % 2 == 0 { low } else { low.next_up() };
    let more = [1, 20, 800][random.below(3)];
    let fine = &digits * BigUint::from(10_u32).pow(more);
    let fine_ten = ten - more as i32;
    match random.below(3) {
        0 => (format!("{digits}e{ten}"), even),
        1 => (format!("{}e{fine_ten}", fine + 1_u32), low.next_up()),
        _ => (format!("{}e{fine_ten}", fine - 1_u32), low),
    }
}

/// `count` points of numbers of any kind, and of numbers at the ends of the range.
fn rows(random: &mut Random, count: usize) -> Vec<[Number; 3]> {
    let mut rows: Vec<_> = (0..count).map(|_| [(); 3].map(|()| number(random))).collect();
    let ends = [
        ("1.79769313486231580793728971405303415e308", f64::MAX),
        ("2.4703282292062327208299439634110765e-324", 0.0),
        ("2.4703282292062327208299439634110764e-324", 0.0),
        ("2.5e-324", f64::from_bits(1)),
        ("2.2250738585072011e-308", f64::from_bits(0x000f_ffff_ffff_ffff)),
        ("9007199254740993", 9_007_199_254_740_992.0),
        ("18446744073709551617", 18_446_744_073_709_551_616.0),
        ("0.98456", 0.98456),
        ("-0.0", -0.0),
    ];
    for (k, (text, nearest)) in ends.into_iter().enumerate() {
        let [a, b] = [0.25, k as f64].map(|x: f64| (format!("{x:?}"), x));
        rows.push([(text.to_owned(), nearest), a, b]);
    }
    rows
}

fn joined(rows: &[[&str; 3]], between: &str, open: &str, close: &str, separator: &str) -> String {
    let row = |row: &[&str; 3]| format!("{open}{}{close}", row.join(between));
    rows.iter().map(row).collect::<Vec<_>>().join(separator)
}

/// Points as text in all formats that are read as text.
pub(crate) fn in_all_formats(rows: &[[&str; 3]]) -> Vec<(&'static str, Format, String)> {
    let n = rows.len();
    let lines = |between: &str| joined(rows, between, "", "\n", "");
    let numbered = |first: usize| -> String {
        (first..).zip(rows).map(|(i, row)| format!("{i} {}\n", row.join(" "))).collect()
    };
    let comma = lines(";").replace('.', ",");
    let json = joined(rows, ",", "[", "]", ",");
    let features = joined(
        rows,
        ",",
        r#"{"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":["#,
        "]}}",
        ",",
    );
    let text_lines = joined(rows, ",", r#"{"type":"Point","coordinates":["#, "]}\n", "");
    let wkt = joined(rows, " ", "(", ")", ", ");
    let tags: String = (1..=n).map(|i| format!("{i}\n")).collect();
    let corners = |count: usize| (0..count).map(|i| format!("f {0} {0} {0}\n", i + 1)).collect::<String>();
    let facet = |row: &[&str; 3]| {
        let vertex = format!("vertex {}\n", row.join(" "));
        format!("facet normal 0 0 0\nouter loop\n{vertex}{vertex}{vertex}endloop\nendfacet\n")
    };
    let facets: String = rows.iter().map(facet).collect();
    let ply = format!("element vertex {n}\nproperty double x\nproperty double y\nproperty double z\n");
    let vtu = "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">";
    let piece = format!("<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"0\">");
    let pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n";
    vec![
        ("csv", Format::Text, format!("x,y,z\n{}", lines(","))),
        ("csv with decimal commas", Format::Text, format!("x;y;z\n{comma}")),
        ("csv with quotes", Format::Text, format!("x,y,z\n{}", joined(rows, "\",\"", "\"", "\"\n", ""))),
        ("csv of text", Format::Text, format!("wkt\n{}", joined(rows, " ", "\"POINT Z (", ")\"\n", ""))),
        ("xyz", Format::Text, lines(" ")),
        ("tsv", Format::Text, lines("\t")),
        ("pts", Format::Pts, format!("{n}\n{}", lines(" "))),
        (
            "lammpstrj",
            Format::Lammps,
            format!("ITEM: NUMBER OF ATOMS\n{n}\nITEM: ATOMS x y z\n{}", lines(" ")),
        ),
        ("extxyz", Format::ExtXyz, format!("{n}\nProperties=pos:R:3\n{}", lines(" "))),
        ("geojson", Format::GeoJson, format!(r#"{{"type":"MultiPoint","coordinates":[{json}]}}"#)),
        ("features", Format::GeoJson, format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#)),
        ("geojsonl", Format::GeoJson, text_lines),
        ("json", Format::GeoJson, format!("[{json}]")),
        ("wkt", Format::Wkt, format!("MULTIPOINT Z ({wkt})")),
        ("ewkt", Format::Wkt, format!("SRID=25832;MULTIPOINT Z ({wkt})")),
        ("node", Format::Node, format!("{n} 3 0 0\n{}", numbered(1))),
        ("node with attributes", Format::Node, format!("{n} 2 1 0\n{}", numbered(0))),
        ("poly", Format::Poly, format!("{n} 2 1 0\n{}0 0\n0\n", numbered(1))),
        ("obj", Format::Obj, format!("{}{}", joined(rows, " ", "v ", "\n", ""), corners(n))),
        ("off", Format::Off, format!("OFF\n{n} 0 0\n{}", lines(" "))),
        ("ply", Format::Ply, format!("ply\nformat ascii 1.0\n{ply}end_header\n{}", lines(" "))),
        ("stl", Format::Stl, format!("solid s\n{facets}endsolid s\n")),
        (
            "msh 2",
            Format::Msh,
            format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{n}\n{}$EndNodes\n", numbered(1)),
        ),
        (
            "msh 4",
            Format::Msh,
            format!(
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {n} 1 {n}\n2 1 0 {n}\n{tags}{}$EndNodes\n",
                lines(" ")
            ),
        ),
        (
            "mesh",
            Format::Medit,
            format!(
                "MeshVersionFormatted 2\nDimension 3\nVertices\n{n}\n{}End\n",
                joined(rows, " ", "", " 0\n", "")
            ),
        ),
        ("su2", Format::Su2, format!("NDIME= 3\nNPOIN= {n}\n{}", lines(" "))),
        (
            "vtk",
            Format::Vtk,
            format!(
                "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS {n} double\n{}",
                lines(" ")
            ),
        ),
        (
            "vtu",
            Format::Vtu,
            format!(
                "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>{piece}{vtu}{}</DataArray></Points></Piece></UnstructuredGrid></VTKFile>",
                lines(" ")
            ),
        ),
        ("pcd", Format::Pcd, format!("{pcd}WIDTH {n}\nHEIGHT 1\nPOINTS {n}\nDATA ascii\n{}", lines(" "))),
    ]
}

fn bits(numbers: impl IntoIterator<Item = f64>) -> Vec<u64> {
    numbers.into_iter().map(f64::to_bits).collect()
}

/// All coordinates of a file of points of space.
fn coordinates(content: &[u8], format: Format, name: &str) -> Vec<u64> {
    let options = ReadOptions::default().dimension(3);
    let cloud = read_points(source(content), format, &options).unwrap_or_else(|e| panic!("{name}: {e}"));
    let heights = cloud.z.unwrap_or_else(|| panic!("{name}: no heights"));
    bits(cloud.xy.iter().zip(heights).flat_map(|(&[x, y], z)| [x, y, z]))
}

/// Compares numbers with what is written.
fn expect(name: &str, found: &[u64], rows: &[[Number; 3]]) {
    assert_eq!(found.len(), 3 * rows.len(), "{name}");
    for (&found, (text, nearest)) in found.iter().zip(rows.as_flattened()) {
        assert_eq!(found, nearest.to_bits(), "{name}: {text} is nearest to {nearest:e}");
    }
}

/// Compares number by number, so that a failure names the first that differs.
fn same(name: &str, found: &[u64], expected: &[u64]) {
    assert_eq!(found.len(), expected.len(), "{name}");
    for (i, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(found, expected, "{name}: number {i}, {:e}", f64::from_bits(expected));
    }
}

#[test]
fn readers_of_text_give_the_nearest_double() {
    let mut random = Random::new(1);
    for _ in 0..share(32) {
        let rows = rows(&mut random, 60);
        let texts: Vec<_> = rows.iter().map(|row| row.each_ref().map(|number| &*number.0)).collect();
        for (name, format, text) in in_all_formats(&texts) {
            expect(name, &coordinates(text.as_bytes(), format, name), &rows);
        }
    }
}

/// Numbers that are no coordinates: values, areas, holes, regions, attributes, cells of rasters and their places.
#[test]
fn other_numbers_are_the_nearest_doubles_too() {
    let mut random = Random::new(2);
    let rows = rows(&mut random, share(2000));
    let all: Vec<&Number> = rows.as_flattened().iter().collect();
    let nearest = bits(all.iter().map(|number| number.1));
    let lines: String = all.iter().map(|number| format!("{}\n", number.0)).collect();
    let list = read_numbers(source(lines.as_bytes()), Format::Text).expect("a list");
    same("list", &bits(list), &nearest);

    let (n, numbered) = (all.len(), all.iter().enumerate());
    let areas: String = numbered.map(|(i, number)| format!("{i} {}\n", number.0)).collect();
    let areas = read_areas(source(format!("{n}\n{areas}").as_bytes()), Format::Area).expect("areas");
    for (area, number) in areas.into_iter().zip(&all) {
        assert_eq!(area, Some(number.1).filter(|&area| area > 0.0), "{}", number.0);
    }

    let heading = format!("ncols 3\nnrows {}\nxllcorner 0\nyllcorner 0\ncellsize 1\n", n / 3);
    let raster = read_raster(source(format!("{heading}{lines}").as_bytes()), Format::Asc).expect("a grid");
    same("asc", &bits(raster.values), &nearest);

    for row in &rows {
        let [x, y, v] = row.each_ref().map(|number| &*number.0);
        let poly = format!("1 2 2 0\n0 {x} {y} {v} {x}\n0 0\n1\n0 {x} {y}\n1\n0 {x} {y} {v} {x}\n");
        let none = ReadOptions::default();
        let graph = read_graph(source(poly.as_bytes()), Format::Poly, &none, None).expect("a graph");
        let [x, y, v] = row.each_ref().map(|number| number.1);
        assert_eq!(bits(graph.holes.concat()), bits([x, y]));
        assert_eq!(bits(graph.attributes.values), bits([v, x]));
        let region = graph.regions[0];
        assert_eq!(bits([region.at[0], region.at[1], region.attribute]), bits([x, y, v]));
        assert_eq!(region.max_area, Some(x).filter(|&area| area > 0.0));
    }
    let place = "ncols 1\nnrows 1\nxllcorner 0.98456000000000010001\nyllcorner -0.1\ncellsize 0.1\n7\n";
    let grid = read_raster(source(place.as_bytes()), Format::Asc).expect("a grid").grid;
    assert_eq!(bits([grid.corner()[0], grid.step()[0]]), bits([0.984_560_000_000_000_1, 0.1]));
}

#[test]
fn rings_of_json_and_text_are_the_nearest_doubles() {
    let mut random = Random::new(3);
    let none = ReadOptions::default();
    for _ in 0..share(100) {
        let rows = rows(&mut random, 3);
        let rows = &rows[..3];
        let closed: Vec<_> = [0, 1, 2, 0].iter().map(|&i| rows[i].each_ref().map(|n| &*n.0)).collect();
        let ring = joined(&closed, ",", "[", "]", ",");
        let text = joined(&closed, " ", "", "", ", ");
        let line = format!(r#"{{"type":"LineString","coordinates":[{ring}]}}"#);
        let polygon = format!(r#"{{"type":"Polygon","coordinates":[[{ring}]]}}"#);
        for (format, content) in [
            (Format::GeoJson, line),
            (Format::GeoJson, polygon),
            (Format::GeoJson, format!("[[{ring}]]")),
            (Format::Wkt, format!("LINESTRING Z ({text})")),
            (Format::Wkt, format!("POLYGON Z (({text}))")),
        ] {
            let graph = read_graph(source(content.as_bytes()), format, &none, None).expect("a ring");
            let heights = graph.cloud.z.expect("heights");
            let all = graph.cloud.xy.iter().zip(heights).flat_map(|(&[x, y], z)| [x, y, z]);
            expect(&content, &bits(all.take(9)), rows);
        }
    }
}

/// Distinct points whose bits are random.
fn random_points(random: &mut Random, count: usize) -> Vec<[f64; 3]> {
    let kind = |random: &mut Random| match random.below(4) {
        0 => any(random),
        1 => subnormal(random).1,
        2 => random.between(0.0, 360.0),
        _ => -random.between(0.0, 1e7),
    };
    (0..count).map(|_| [(); 3].map(|()| kind(random))).collect()
}

#[test]
fn writers_of_points_write_what_reads_back() {
    let points = random_points(&mut Random::new(4), share(4000));
    for format in [
        Format::Text,
        Format::Npy,
        Format::Raw,
        Format::Node,
        Format::Ply,
        Format::Obj,
        Format::GeoJson,
        Format::Wkt,
        Format::Wkb,
    ] {
        let mut content = Vec::new();
        write_points(&mut content, format, &points).expect("memory takes it");
        let name = format.to_string();
        same(&name, &coordinates(&content, format, &name), &bits(points.concat()));
    }
}

/// The coordinates of the nodes of an Abaqus file.
fn nodes_of_inp(text: &str) -> Vec<[u64; 3]> {
    let (_, rest) = text.split_once("*NODE\n").expect("nodes");
    let lines = rest.lines().take_while(|line| !line.starts_with('*'));
    let row = |line: &str| -> Vec<f64> {
        line.split(", ").skip(1).map(|word| word.parse().expect("a number")).collect()
    };
    let rows = lines.map(|line| {
        let row = row(line);
        [row[0], row[1], row.get(2).copied().unwrap_or_default()].map(f64::to_bits)
    });
    rows.collect()
}

/// The nodes of a mesh of SMS.
fn nodes_of_sms(text: &str) -> Vec<[u64; 3]> {
    let rows = text.lines().filter_map(|line| line.strip_prefix("ND "));
    let rows = rows.map(|row| row.split(' ').skip(1).map(|word| word.parse().expect("a number")).collect());
    rows.map(|row: Vec<f64>| [0, 1, 2].map(|k| row[k].to_bits())).collect()
}

/// The first numbers of a file of XDMF.
fn nodes_of_xdmf(text: &str) -> Vec<[u64; 3]> {
    let numbers =
        text.split("Format=\"XML\">").nth(1).and_then(|part| part.split('<').next()).expect("points");
    let numbers: Vec<f64> = numbers.split_whitespace().map(|word| word.parse().expect("a number")).collect();
    numbers.as_chunks::<3>().0.iter().map(|row| row.map(f64::to_bits)).collect()
}

/// The triangles of a mesh file, each point once.
fn distinct(content: &[u8], format: Format, name: &str) -> Vec<[u64; 3]> {
    let mut rows = match format {
        Format::Inp => nodes_of_inp(str::from_utf8(content).expect("text")),
        Format::Sms => nodes_of_sms(str::from_utf8(content).expect("text")),
        Format::Xdmf => nodes_of_xdmf(str::from_utf8(content).expect("text")),
        _ => coordinates(content, format, name).as_chunks::<3>().0.to_vec(),
    };
    rows.sort_unstable();
    rows.dedup();
    rows
}

#[test]
fn writers_of_meshes_write_what_reads_back() {
    let points = random_points(&mut Random::new(5), share(1600));
    let mut all: Vec<_> = points.iter().map(|p| p.map(f64::to_bits)).collect();
    all.sort_unstable();
    let (flat, heights): (Vec<_>, Vec<_>) = points.iter().map(|&[x, y, z]| ([x, y], z)).unzip();
    let plane = Delaunay2::from_points(&flat).expect("finite");
    let mesh = Mesh { heights: Some(&heights), ..Mesh::new(&plane, &flat) };
    let corners = plane.triangles().count();
    assert!(corners > points.len(), "every point is a corner");
    let single = [Format::Stl, Format::Svg, Format::Png];
    let indices = [Format::Npy, Format::Ele, Format::Neigh, Format::Edge];
    for format in meshes(Contents::Triangles) {
        // One has no heights, one changes their sign, one has as many digits as fit.
        let changed = [Format::Su2, Format::Adcirc, Format::Nastran];
        if single.contains(&format) || indices.contains(&format) || changed.contains(&format) {
            continue;
        }
        let mut content = Vec::new();
        write_mesh(&mut content, format, &mesh, &picture::Options::default()).expect("memory takes it");
        let name = format.to_string();
        same(&name, distinct(&content, format, &name).as_flattened(), all.as_flattened());
    }
    let space = Delaunay3::from_points(&points).expect("finite");
    for format in
        [Format::Node, Format::Vtu, Format::Msh, Format::Inp, Format::Medit, Format::Su2, Format::Xdmf]
    {
        let content = written(format, &Mesh::new(&space, &points));
        let name = format!("{format} of space");
        same(&name, distinct(&content, format, &name).as_flattened(), all.as_flattened());
    }
}

#[test]
fn graphs_and_rasters_are_written_as_they_are() {
    let points = random_points(&mut Random::new(6), share(800));
    let mut graph = Graph::default();
    graph.cloud.xy = points.iter().map(|&[x, y, _]| [x, y]).collect();
    graph.cloud.z = Some(points.iter().map(|p| p[2]).collect());
    let none = ReadOptions::default();
    for format in [Format::Poly, Format::GeoJson, Format::Wkt] {
        let mut content = Vec::new();
        write_graph(&mut content, format, &graph).expect("memory takes it");
        let again = read_graph(source(&content), format, &none, None).expect("a graph").cloud;
        let name = format.to_string();
        same(&name, &bits(again.xy.concat()), &bits(graph.cloud.xy.concat()));
        same(&name, &bits(again.z.expect("heights")), &bits(points.iter().map(|p| p[2])));
    }

    let grid = Grid::new([0.0, 0.0], [1.0, -1.0], 3, points.len()).expect("a grid");
    for (format, sample) in [
        (Format::Asc, Sample::F64),
        (Format::Tiff, Sample::F64),
        (Format::Asc, Sample::F32),
        (Format::Tiff, Sample::F32),
    ] {
        // Single precision is asked for by name: those are compared as such.
        let single = sample == Sample::F32;
        let fits = |x: &&f64| !single || (**x as f32).is_finite();
        let shown = |x: f64| if single { u64::from((x as f32).to_bits()) } else { x.to_bits() };
        let mut values: Vec<f64> =
            points.as_flattened().iter().map(|x| if fits(&x) { *x } else { 1.5 }).collect();
        values.truncate(3 * points.len());
        let info = RasterInfo { sample, ..RasterInfo::new(grid) };
        let file = std::io::Cursor::new(Vec::new());
        let mut writer = RasterWriter::create(file, format, &info).expect("a raster");
        writer.write_rows(&values).expect("memory takes it");
        let content = writer.finish().expect("memory takes it").into_inner();
        let again = read_raster(source(&content), format).expect("a raster").values;
        let [again, values] = [again, values].map(|list| list.into_iter().map(shown).collect::<Vec<_>>());
        same(&format!("{format} of {sample:?}"), &again, &values);
    }
}
