//! Equal points make equal triangles, whatever format they come from.

use std::io::Cursor;

use delone::Delaunay2;
use delone_generators::Kind3;
use delone_io::{Format, ReadOptions, Solid, picture, read_points, write_points, write_solid};

use crate::numbers::in_all_formats;
use crate::scene::{least_first, source};

/// Points on a fine lattice, so that formats of single precision hold them, and those of whole steps.
fn points() -> Vec<[f64; 3]> {
    Kind3::Cube.points(300, 7).into_iter().map(|p| p.map(|x| (x / STEP).round() * STEP - 0.5)).collect()
}

/// The step of the lattice.
const STEP: f64 = 1.0 / (1 << 20) as f64;

/// A scan of LAS, packed or not.
fn in_steps(points: &[[f64; 3]], packed: bool) -> las::Result<Vec<u8>> {
    let mut header = las::Builder::from((1, 2));
    let step = las::Transform { scale: STEP, offset: -0.5 };
    header.transforms = las::Vector { x: step, y: step, z: step };
    header.point_format.is_compressed = packed;
    let mut writer = las::Writer::new(Cursor::new(Vec::new()), header.into_header()?)?;
    for &[x, y, z] in points {
        writer.write_point(las::Point { x, y, z, ..las::Point::default() })?;
    }
    Ok(writer.into_inner()?.into_inner())
}

/// A scan of E57.
fn in_scan(points: &[[f64; 3]]) -> e57::Result<Vec<u8>> {
    use e57::{E57Writer, Record, RecordValue};
    let mut file = Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut file, "file")?;
    let fields = vec![Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F64];
    let mut scan = writer.add_pointcloud("scan", fields)?;
    for p in points {
        scan.add_point(p.iter().map(|&x| RecordValue::Double(x)).collect())?;
    }
    scan.finalize()?;
    writer.finalize()?;
    drop(writer);
    Ok(file.into_inner())
}

/// Coordinates of 4 bytes each, one after the other.
fn single(points: &[[f64; 3]], bytes: impl Fn(f32) -> [u8; 4]) -> Vec<u8> {
    points.as_flattened().iter().flat_map(|&x| bytes(x as f32)).collect()
}

fn with_head(head: &str, content: &[u8]) -> Vec<u8> {
    [head.as_bytes(), content].concat()
}

/// Points in the binary formats.
fn in_binary_formats(points: &[[f64; 3]]) -> Vec<(&'static str, Format, Vec<u8>)> {
    let n = points.len();
    let little = single(points, f32::to_le_bytes);
    let head = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({n}, 3), }}");
    let mut array = b"\x93NUMPY\x01\x00".to_vec();
    array.extend((head.len() as u16 + 1).to_le_bytes());
    array.extend(format!("{head}\n").bytes());
    array.extend(&little);
    let properties = "property float x\nproperty float y\nproperty float z\n";
    let ply = format!("ply\nformat binary_little_endian 1.0\nelement vertex {n}\n{properties}end_header\n");
    let vtk = format!("# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS {n} float\n");
    let pcd = format!(
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {n}\nHEIGHT 1\nPOINTS {n}\nDATA binary\n"
    );
    // Each corner is in some face.
    let faces = (0..n).map(|i| vec![i, (i + 1) % n, (i + 2) % n]).collect();
    let solid = Solid { points: points.to_vec(), faces, ..Solid::default() };
    let mut stl = Vec::new();
    write_solid(&mut stl, Format::Stl, &solid, &picture::Options::default()).expect("memory takes it");
    let mut all = vec![
        ("npy of single precision", Format::Npy, array),
        ("ply of single precision", Format::Ply, with_head(&ply, &little)),
        ("vtk of single precision", Format::Vtk, with_head(&vtk, &single(points, f32::to_be_bytes))),
        ("pcd of single precision", Format::Pcd, with_head(&pcd, &little)),
        ("stl", Format::Stl, stl),
        ("las", Format::Las, in_steps(points, false).expect("memory takes it")),
        ("laz", Format::Las, in_steps(points, true).expect("memory takes it")),
        ("e57", Format::E57, in_scan(points).expect("memory takes it")),
    ];
    for format in [Format::Npy, Format::Raw, Format::Ply, Format::Wkb] {
        let mut content = Vec::new();
        write_points(&mut content, format, points).expect("memory takes it");
        all.push(("double precision", format, content));
    }
    all
}

#[test]
fn all_formats_give_the_same_triangles() {
    let points = points();
    let triangles = |xy: &[[f64; 2]]| {
        let d = Delaunay2::from_points(xy).expect("finite");
        let corners = d.triangles().map(|t| least_first(t.map(|v| v.index())));
        let mut all: Vec<_> = corners.collect();
        all.sort_unstable();
        all
    };
    let expected = triangles(&points.iter().map(|&[x, y, _]| [x, y]).collect::<Vec<_>>());
    assert!(expected.len() > points.len());
    let words: Vec<_> = points.iter().map(|p| p.map(|x| format!("{x:?}"))).collect();
    let words: Vec<_> = words.iter().map(|row| row.each_ref().map(|word| &**word)).collect();
    let texts =
        in_all_formats(&words).into_iter().map(|(name, format, text)| (name, format, text.into_bytes()));
    for (name, format, content) in texts.chain(in_binary_formats(&points)) {
        let options = ReadOptions::default().dimension(3);
        let cloud = read_points(source(&content), format, &options).expect(name);
        let heights: Vec<f64> = points.iter().map(|p| p[2]).collect();
        assert!(cloud.z == Some(heights), "{name} ({format}): other heights");
        assert!(triangles(&cloud.xy) == expected, "{name} ({format}): other triangles");
    }
}
