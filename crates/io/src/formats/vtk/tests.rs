use std::io::Cursor;

use super::{
    has_legacy_lines, has_xml_lines, read_legacy, read_legacy_graph, read_legacy_simplices, read_xml,
    read_xml_graph, read_xml_simplices,
};
use crate::{Cloud, Source};

fn expect(cloud: Result<Cloud, crate::Error>) {
    let cloud = cloud.expect("valid");
    assert_eq!((cloud.xy, cloud.z), (vec![[1.0, 2.0], [4.0, 5.0]], Some(vec![3.0, 6.0])));
}

#[test]
fn legacy_files() {
    let head = "# vtk DataFile Version 3.0\ntitle\n";
    let text = format!("{head}ASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 3 4\n5 6\nVERTICES 0 0\n");
    expect(read_legacy(Box::new(Cursor::new(text))));
    let mut binary = format!("{head}BINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 double\n").into_bytes();
    binary.extend((1..=6).flat_map(|x| f64::from(x).to_be_bytes()));
    expect(read_legacy(Box::new(Cursor::new(binary.clone()))));
    binary.pop();
    let error = read_legacy(Box::new(Cursor::new(binary))).expect_err("short");
    assert_eq!(error.to_string(), "the file ends after 1 of 2 points");
    assert!(read_legacy(Box::new(Cursor::new("# vtk DataFile\n"))).is_err());
}

#[test]
fn xml_as_text_and_in_base64() {
    use base64::Engine;
    let file = |attributes: &str, array: &str| {
        format!(
            "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" {attributes}><PolyData><Piece><Points>\
             <DataArray type=\"Float32\" NumberOfComponents=\"3\" {array}</DataArray></Points></Piece></PolyData></VTKFile>"
        )
    };
    expect(read_xml(Box::new(Cursor::new(file("", "format=\"ascii\">1 2 3\n4 5 6")))));
    let numbers: Vec<u8> = (1..=6).flat_map(|x| (x as f32).to_le_bytes()).collect();
    let encode = |bytes: &[u8]| base64::engine::general_purpose::STANDARD.encode(bytes);
    let plain = [&24_u32.to_le_bytes()[..], &numbers].concat();
    expect(read_xml(Box::new(Cursor::new(file("", &format!("format=\"binary\">{}", encode(&plain)))))));
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    std::io::Write::write_all(&mut encoder, &numbers).expect("memory");
    let packed = encoder.finish().expect("memory");
    let lengths: Vec<u8> =
        [1_u64, 24, 24, packed.len() as u64].iter().flat_map(|x| x.to_le_bytes()).collect();
    let array = format!("format=\"binary\">{}{}", encode(&lengths), encode(&packed));
    let attributes = "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";
    expect(read_xml(Box::new(Cursor::new(file(attributes, &array)))));
    let other = file("compressor=\"vtkLZ4DataCompressor\"", "format=\"ascii\">");
    assert!(read_xml(Box::new(Cursor::new(other))).is_err_and(|error| error.to_string().contains("zlib")));
}

fn source(bytes: &[u8]) -> Box<dyn Source> {
    Box::new(Cursor::new(bytes.to_vec()))
}

/// A square with a diagonal that bends: a triangle, a chain of three points, a segment, a vertex.
const GRID: &str = "POINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n";

#[test]
fn legacy_cells_of_both_versions() {
    let old = format!(
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n0\n{GRID}\
         CELLS 4 13\n3 0 1 2\n3 0 2 3\n2 3 1\n1 0\nCELL_TYPES 4\n5\n4\n3\n1\nCELL_DATA 4\n"
    );
    let new = format!(
        "# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n{GRID}METADATA\nINFORMATION 0\n\n\
         CELLS 5 9\nOFFSETS vtktypeint64\n0 3 6 8 9\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3 3 1 0\n\
         CELL_TYPES 4\n5 4 3 1\n"
    );
    let drawn = format!(
        "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\n{GRID}VERTICES 1 2\n1 0\nLINES 2 7\n3 0 2 3\n2 3 1\n\
         POLYGONS 1 4\n3 0 1 2\n"
    );
    for text in [old, new, drawn] {
        let graph = read_legacy_graph(source(text.as_bytes())).expect(&text);
        assert_eq!(graph.segments, [[0, 2], [2, 3], [3, 1]], "{text}");
        let triangles = read_legacy_simplices::<3>(source(text.as_bytes())).expect(&text);
        assert_eq!(triangles, [[0, 1, 2]], "{text}");
    }
}

#[test]
fn binary_cells() {
    let mut file = b"# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n".to_vec();
    file.extend((0..9).flat_map(|x| (x as f32).to_be_bytes()));
    file.extend(b"\nLINES 1 4\n");
    file.extend([3, 2, 1, 0].iter().flat_map(|x: &i32| x.to_be_bytes()));
    assert_eq!(read_legacy_graph(source(&file)).expect("valid").segments, [[2, 1], [1, 0]]);
    // Indices of VTK's own kind have 32 bits, offsets 64.
    let mut offsets = b"# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n".to_vec();
    offsets.extend((0..9).flat_map(|x| (x as f32).to_be_bytes()));
    offsets.extend(b"\nLINES 2 3\nOFFSETS vtktypeint64\n");
    offsets.extend([0, 3].iter().flat_map(|x: &i64| x.to_be_bytes()));
    offsets.extend(b"\nCONNECTIVITY vtkIdType\n");
    offsets.extend([2, 1, 0].iter().flat_map(|x: &i32| x.to_be_bytes()));
    assert_eq!(read_legacy_graph(source(&offsets)).expect("valid").segments, [[2, 1], [1, 0]]);
    for cut in 60..file.len() {
        // No panic; lines are all there or the file is refused.
        let lines = read_legacy_graph(source(&file[..cut])).map(|graph| graph.segments.len());
        assert!(lines.as_ref().is_err() || matches!(lines, Ok(0)), "{cut}: {lines:?}");
    }
}

#[test]
fn values_are_told_as_left_out() {
    let points = "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\">0 0 0</DataArray></Points>";
    let values = "<PointData><DataArray type=\"Float32\" Name=\"t\">1</DataArray></PointData><CellData><DataArray Name=\"p\"/></CellData>";
    let file = |values: &str| {
        format!("<VTKFile><UnstructuredGrid><Piece>{points}{values}</Piece></UnstructuredGrid></VTKFile>")
    };
    let losses = |text: String| read_xml(source(text.as_bytes())).expect("valid").losses;
    assert_eq!(losses(file(values)), ["values of points and cells are left out: p, t"]);
    assert!(losses(file("<PointData/>")).is_empty());
    let legacy = |rest: &str| {
        let text = format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n{GRID}{rest}");
        read_legacy(source(text.as_bytes())).expect("valid").losses
    };
    assert_eq!(legacy("POINT_DATA 4\nSCALARS t float\n"), ["values of points and cells are left out"]);
    assert!(legacy("VERTICES 1 2\n1 0\n").is_empty());
}

#[test]
fn cells_of_all_pieces() {
    let piece = |kinds: &str, ends: &str, corners: &str| {
        let array = |name: &str, numbers: &str| {
            format!("<DataArray type=\"Int64\" Name=\"{name}\" format=\"ascii\">{numbers}</DataArray>")
        };
        format!(
            "<Piece><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 0 0 1 0 1 1 1</DataArray></Points>\
             <Cells>{}{}{}</Cells></Piece>",
            array("connectivity", corners),
            array("offsets", ends),
            array("types", kinds)
        )
    };
    let file = |pieces: &[String]| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>{}</UnstructuredGrid></VTKFile>",
            pieces.concat()
        )
    };
    let two = file(&[piece("10 3", "4 6", "0 1 2 3 0 3"), piece("5 21", "3 6", "2 1 0 3 1 2")]);
    let two = two.as_bytes();
    assert_eq!(read_xml_simplices::<4>(source(two)).expect("valid"), [[0, 1, 2, 3]]);
    assert_eq!(read_xml_simplices::<3>(source(two)).expect("valid"), [[6, 5, 4]]);
    assert_eq!(read_xml_graph(source(two)).expect("valid").segments, [[0, 3], [7, 5]]);
    assert!(has_xml_lines(source(two)));
    let marked = |numbers: &str| {
        let array = format!(
            "</Cells><CellData><DataArray type=\"Int64\" Name=\"marker\">{numbers}</DataArray></CellData>"
        );
        let text =
            file(&[piece("10 3", "4 6", "0 1 2 3 0 3").replace("</Cells>", &array), piece("3", "2", "1 0")]);
        let graph = read_xml_graph(source(text.as_bytes())).expect("valid");
        (graph.markers, graph.cloud.losses)
    };
    assert_eq!(marked("0 -7"), (Some(vec![-7, 0]), Vec::new()));
    assert_eq!(marked("5 0"), (None, Vec::new()));
    let lost = vec!["values of points and cells are left out: marker".to_owned()];
    assert_eq!((marked("0 1.5"), marked("1")), ((None, lost.clone()), (None, lost)));
    for (kinds, ends, corners, what) in [
        ("5", "3", "0 1 4", "corner 4"),
        ("5", "4", "0 1 2", "outside of the list"),
        ("5 5", "3 2", "0 1 2", "outside of the list"),
        ("5", "3 3", "0 1 2", "1 kinds of 2 cells"),
        ("8", "4", "0 1 2 3", "kind 8, with 4 points"),
        ("9", "3", "0 1 2", "too few corners"),
        ("9", "4", "0 1 1 0", "crosses itself or is flat"),
        ("5", "2", "0 1", "too few corners"),
    ] {
        let error = read_xml_simplices::<3>(source(file(&[piece(kinds, ends, corners)]).as_bytes()));
        let error = error.expect_err(what).to_string();
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn strings_of_a_field_are_passed_over() {
    let long = "x".repeat(70);
    let text = format!(
        "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nFIELD FieldData 2\nwho 1 2 string\n{long}\nb\n\
         time 1 1 double\n0\nPOINTS 2 float\n1 2 3 4 5 6\n"
    );
    expect(read_legacy(source(text.as_bytes())));
    let mut binary =
        b"# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nFIELD FieldData 1\nwho 1 2 string\n"
            .to_vec();
    // 70 in 14 bits after 10, and 1 in 6 bits after 11.
    binary.extend([0x80, 70]);
    binary.extend(long.as_bytes());
    binary.extend([0xC1, b'b']);
    binary.extend(b"\nPOINTS 2 float\n");
    binary.extend((1..=6).flat_map(|x| (x as f32).to_be_bytes()));
    expect(read_legacy(source(&binary)));
    for end in 100..binary.len() {
        assert!(read_legacy(source(&binary[..end])).is_err(), "{end}");
    }
}

/// Points alone would be read without a word of the lines.
#[test]
fn broken_lines_are_for_the_reader_of_lines() {
    let text = "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 3 4 5 6\n\
                LINES 2 2\nOFFSETS vtkIdType\n0 2\nCONNECTIVITY vtkIdType\n0 9\n";
    assert!(has_legacy_lines(source(text.as_bytes())));
    assert!(read_legacy_graph(source(text.as_bytes())).is_err());
}
