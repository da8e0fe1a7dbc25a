//! Files to begin with: one of each kind that readers know, and those that broke readers once.

use std::io::{Cursor, Write};
use std::sync::OnceLock;

use delone::Delaunay2;
use delone::surface::Grid;
use delone_generators::Kind;
use delone_io::{Compression, Crs, Format, Mesh, RasterInfo, RasterWriter, Sample, picture};

use super::{ARRAYS, E57, JSON, LAS, MAPS, MESHES, PART, PLY, TEXT};

pub(super) type Seeds = Vec<(Format, Vec<u8>)>;

/// Points of a file.
const POINTS: usize = 40;

/// Files that broke readers once.
const HOSTILE: [(Format, &[u8]); 11] = [
    (Format::Las, include_bytes!("../../../../../data/hostile/f_3000000_0_3000007.laz")),
    (Format::Las, include_bytes!("../../../../../data/hostile/f_3000000_1_3000051.laz")),
    (Format::Las, include_bytes!("../../../../../data/hostile/f_3000000_2_3000064.las")),
    (Format::Las, include_bytes!("../../../../../data/hostile/f_3000000_3_3000152.las")),
    (Format::Las, include_bytes!("../../../../../data/hostile/f_3000000_4_3000206.laz")),
    (Format::Las, include_bytes!("../../../../../data/hostile/f_3000000_5_3002539.laz")),
    (Format::Ply, include_bytes!("../../../../../data/hostile/hang_before40.ply")),
    (Format::Ply, include_bytes!("../../../../../data/hostile/xlist.ply")),
    (Format::Ply, include_bytes!("../../../../../data/hostile/xuchar.ply")),
    (Format::Npy, include_bytes!("../../../../../data/hostile/hdrlen.npy")),
    (Format::Text, include_bytes!("../../../../../data/hostile/cr.csv")),
];

/// GeoTIFF as GDAL writes it: masks, tiles that are left out, overviews, all compressions.
const RASTERS: [&[u8]; 7] = [
    include_bytes!("../../../../../data/rasters/mask_deflate.tif"),
    include_bytes!("../../../../../data/rasters/mask_tiled.tif"),
    include_bytes!("../../../../../data/rasters/sparse.tif"),
    include_bytes!("../../../../../data/rasters/zstd.tif"),
    include_bytes!("../../../../../data/rasters/zstd_tiled.tif"),
    include_bytes!("../../../../../data/rasters/overviews_lzw.tif"),
    include_bytes!("../../../../../data/rasters/packbits_big.tif"),
];

/// The files of a group.
pub(super) fn of(group: usize) -> &'static Seeds {
    static ALL: [OnceLock<Seeds>; 8] = [const { OnceLock::new() }; 8];
    ALL[group].get_or_init(|| {
        let mut seeds = match group {
            TEXT => texts(),
            JSON => documents(),
            ARRAYS => arrays(),
            LAS => tiles(),
            PLY => polygons(),
            MESHES => meshes(),
            MAPS => super::maps::all(),
            _ => scans(),
        };
        let formats: Vec<Format> = seeds.iter().map(|seed| seed.0).collect();
        let broken = HOSTILE.iter().filter(|seed| formats.contains(&seed.0));
        seeds.extend(broken.map(|&(format, bytes)| (format, bytes.to_vec())));
        seeds
    })
}

pub(super) fn points() -> Vec<[f64; 2]> {
    Kind::Uniform.points(POINTS, 1)
}

fn in_space() -> Vec<[f64; 3]> {
    points().iter().map(|&[x, y]| [1000.0 * x, 1000.0 * y, 100.0 * x * y]).collect()
}

/// A file of some points by a writer of ours.
pub(super) fn written(format: Format) -> (Format, Vec<u8>) {
    let mut bytes = Vec::new();
    let outcome = delone_io::write_points(&mut bytes, format, &in_space());
    assert!(outcome.is_ok(), "{format} is written");
    (format, bytes)
}

/// A file of a triangulation by a writer of ours.
pub(super) fn mesh(format: Format) -> (Format, Vec<u8>) {
    let crs = Crs::of_epsg(25_832);
    let mut bytes = Vec::new();
    let points = points();
    let triangulation = Delaunay2::from_points(&points).unwrap_or_default();
    let mesh = Mesh { crs: Some(&crs), base: 1, ..Mesh::new(&triangulation, &points) };
    let outcome = delone_io::write_mesh(&mut bytes, format, &mesh, &picture::Options::default());
    assert!(outcome.is_ok(), "{format} is written");
    (format, bytes)
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

fn texts() -> Seeds {
    let plain = written(Format::Text);
    let texts = [
        "id,X_COORD,Y_COORD,Z_VAL\n1,1.5,2,3\n2,4,5.25,6\n3,7,8,9e3\n",
        "# by hand\n1 2 3\n4 5 6\n7 8 10 # the last\n",
        "name;x;y\n\"a; b\";1,5;2\n\"c \"\"d\"\"\";3;4,25\n\"two\nlines\";5;6\n",
        "id,wkt\n1,POINT (1 2)\n2,\"MULTIPOINT ((3 4), (5 6))\"\n3,\"POLYGON ((0 0, 1 0, 0 1, 0 0))\"\n",
        "lat\tlon\televation\r\n1\t2\t3\r\n4\t5\t6\r\n",
        "\u{feff}x,y\n1,2\n3,4\n",
    ];
    let mut seeds: Seeds = texts.iter().map(|text| (Format::Text, text.as_bytes().to_vec())).collect();
    seeds.push((Format::Text, gzip(&plain.1)));
    seeds.push(plain);
    seeds.push((Format::Pts, b"3\n1 2 3 -5 0 0 0\n4 5 6 -5 0 0 0\n7 8 10 -5 1 2 3\n".to_vec()));
    let dump: &[u8] = b"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp ff\n-1 7 2\n0 5 -1\n0 4 .5\nITEM: ATOMS id xs ys zs r\n7 .5 1 2 3\n3 2 5 4 .5\n";
    let frame: &[u8] = b"2\nLattice=\"5 0 0 1 4 0 0 0 3\" Properties=species:S:1:pos:R:3:fixed:L:1 pbc=\"T F T\"\nSi 1 2 3 T\nO 4 5 6 F\n1\n\nH 1 2 3\n";
    seeds.extend([(Format::Lammps, dump.to_vec()), (Format::ExtXyz, frame.to_vec())]);
    seeds.push(written(Format::Raw));
    seeds
}

fn documents() -> Seeds {
    let all = r#"{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},
"features":[{"type":"Feature","properties":{"a":[1,{"b":null}]},"geometry":{"type":"Polygon","coordinates":
[[[0,0],[4,0],[0,4],[0,0]],[[1,1],[1,2],[2,1],[1,1]]]}},{"type":"Feature","properties":null,"geometry":null},
{"type":"Feature","properties":{},"geometry":{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":
[1.5,2,3]},{"type":"MultiLineString","coordinates":[[[1,2],[3,4]],[[5,6],[7,8]]]},{"type":"MultiPolygon","coordinates":
[[[[0,0],[1,0],[0,1],[0,0]]]]}]}}]}"#;
    let sequence = "\u{1e}{\"type\":\"Point\",\"coordinates\":[1,2]}\n\u{1e}{\"type\":\"Point\",\"coordinates\":[3,4]}\n";
    let mut seeds = vec![written(Format::GeoJson), mesh(Format::GeoJson)];
    seeds.extend([all, sequence].map(|text| (Format::GeoJson, text.as_bytes().to_vec())));
    seeds.push((Format::GeoJson, gzip(all.as_bytes())));
    seeds.push((Format::GeoJson, b"[[[0,0],[4,0,1],[0,4]],[[1,1],[1,2],[2,1]]]".to_vec()));
    seeds.extend([written(Format::Wkt), mesh(Format::Wkt), written(Format::Wkb), mesh(Format::Wkb)]);
    let walk = "<gpx xmlns=\"http://www.topografix.com/GPX/1/1\"><wpt lat=\"47.5\" lon=\"8\"/><trk><trkseg>\n\
        <trkpt lat=\"1\" lon=\"2\"><ele>3</ele></trkpt><trkpt lat=\"4\" lon=\"5.5\"><ele>6e0</ele></trkpt></trkseg></trk></gpx>";
    seeds.push((Format::Gpx, walk.as_bytes().to_vec()));
    let geometries = [Format::Wkt, Format::Wkt, Format::Wkt, Format::Wkb].into_iter().zip(GEOMETRIES);
    seeds.extend(geometries.map(|(format, text)| (format, text.as_bytes().to_vec())));
    seeds
}

fn arrays() -> Seeds {
    let plain = written(Format::Npy);
    let mut columns = plain.1.clone();
    if let Some(at) = columns.windows(5).position(|word| word == b"False") {
        columns[at..at + 5].copy_from_slice(b"True ");
    }
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for name in ["points.npy", "ids.npy"] {
        _ = archive.start_file(name, zip::write::SimpleFileOptions::default());
        _ = archive.write_all(&plain.1);
    }
    let archive = archive.finish().map(Cursor::into_inner).unwrap_or_default();
    let mut seeds: Seeds = RASTERS.iter().map(|&bytes| (Format::Tiff, bytes.to_vec())).collect();
    seeds.extend([
        raster(Format::Tiff, Sample::F32),
        raster(Format::Tiff, Sample::F64),
        raster(Format::Tiff, Sample::U8),
        raster(Format::Asc, Sample::F32),
        raster(Format::Npy, Sample::F64),
        (Format::Npy, columns),
        (Format::Npz, archive),
        (Format::Npy, gzip(&plain.1)),
        plain,
        mesh(Format::Npy),
    ]);
    seeds
}

/// A raster of several strips, with all that files say of it.
fn raster(format: Format, sample: Sample) -> (Format, Vec<u8>) {
    let write = || -> Result<Vec<u8>, delone_io::Error> {
        let grid = Grid::new([500.0, 900.0], [2.0, -2.0], 9, 150).map_err(std::io::Error::other)?;
        let crs = Crs { vertical: Some(7837), ..Crs::of_epsg(25_832) };
        let compression = if sample == Sample::F64 { Compression::Lzw } else { Compression::Deflate };
        let info = RasterInfo {
            crs: Some(crs),
            nodata: Some(-9999.0),
            sample,
            compression,
            ..RasterInfo::new(grid)
        };
        let mut writer = RasterWriter::create(Cursor::new(Vec::new()), format, &info)?;
        let height = |i: usize| if i.is_multiple_of(11) { f64::NAN } else { (i * i % 250) as f64 };
        writer.write_rows(&(0..9 * 150).map(height).collect::<Vec<_>>())?;
        Ok(writer.finish()?.into_inner())
    };
    let written = write();
    assert!(written.is_ok(), "{format} is written");
    (format, written.unwrap_or_default())
}

/// Tiles of all point formats, plain and compressed.
fn tiles() -> Seeds {
    let mut seeds = Vec::new();
    for (number, compressed) in (0..=10).flat_map(|number| [(number, false), (number, true)]) {
        // Waveforms are not compressed by the crate that writes here.
        if compressed && [4, 5, 9, 10].contains(&number) {
            continue;
        }
        let tile = tile(number, compressed);
        assert!(tile.is_ok(), "a tile of format {number} is written: {:?}", tile.err());
        seeds.extend(tile.into_iter().map(|bytes| (Format::Las, bytes)));
    }
    seeds.extend(TREES.map(|tree| (Format::Las, tree.to_vec())));
    let join = |[about, node]: [&[u8]; 2]| [about, b"{\"0-0-0-0\": 40}", node].join(PART);
    seeds.extend(NODES.map(|files| (Format::Ept, join(files))));
    seeds
}

/// Files with an octree of points, or with extra bytes.
const TREES: [&[u8]; 2] = [
    include_bytes!("../../../../../data/lidar/small.copc.laz"),
    include_bytes!("../../../../../data/lidar/small.laz"),
];

/// Octrees in many files: what tells of all, and one node of 40 points.
const NODES: [[&[u8]; 2]; 3] = [
    [
        include_bytes!("../../../../../data/lidar/laszip/ept.json"),
        include_bytes!("../../../../../data/lidar/laszip/ept-data/0-0-0-0.laz"),
    ],
    [
        include_bytes!("../../../../../data/lidar/binary/ept.json"),
        include_bytes!("../../../../../data/lidar/binary/ept-data/0-0-0-0.bin"),
    ],
    [
        include_bytes!("../../../../../data/lidar/zstandard/ept.json"),
        include_bytes!("../../../../../data/lidar/zstandard/ept-data/0-0-0-0.zst"),
    ],
];

fn tile(number: u8, compressed: bool) -> Result<Vec<u8>, las::Error> {
    let mut about = las::Builder::from((1, 4));
    about.point_format = las::point::Format::new(number)?;
    about.point_format.is_compressed = compressed;
    about.point_format.extra_bytes = u16::from(number % 3);
    let format = about.point_format;
    let mut header = about.into_header()?;
    header.set_wkt_crs(b"PROJCS[\"ours\",AUTHORITY[\"EPSG\",\"25832\"]]".to_vec())?;
    let mut writer = las::Writer::new(Cursor::new(Vec::new()), header)?;
    for (i, [x, y, z]) in in_space().into_iter().enumerate() {
        writer.write_point(las::Point {
            x,
            y,
            z,
            return_number: 1,
            number_of_returns: 1,
            gps_time: format.has_gps_time.then_some(i as f64),
            color: format.has_color.then(las::Color::default),
            nir: format.has_nir.then_some(7),
            waveform: format.has_waveform.then(Default::default),
            extra_bytes: vec![1; usize::from(format.extra_bytes)],
            ..las::Point::default()
        })?;
    }
    Ok(writer.into_inner()?.into_inner())
}

fn polygons() -> Seeds {
    let ascii = "ply\nformat ascii 1.0\ncomment crs EPSG:25832\nelement camera 1\nproperty float f\nelement vertex 3\n\
        property double x\nproperty float y\nproperty uchar z\nproperty list uchar int more\nelement face 1\n\
        property list uchar uint vertex_indices\nend_header\n1.5\n0 0 0 0\n1 0 1 2 7 8\n0 1 2 0\n3 0 1 2\n";
    let mut big = b"ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty short x\nproperty int y\nend_header\n".to_vec();
    big.extend([0, 1, 0, 0, 0, 2, 0, 3, 0, 0, 0, 4]);
    let mut seeds = vec![written(Format::Ply), mesh(Format::Ply)];
    seeds.extend([
        (Format::Ply, ascii.as_bytes().to_vec()),
        (Format::Ply, big),
        (Format::Ply, gzip(ascii.as_bytes())),
    ]);
    seeds
}

fn meshes() -> Seeds {
    let solid = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let off = "OFF\n# by hand\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let mut seeds: Seeds = [Format::Obj, Format::Stl, Format::Node, Format::Ele].map(mesh).into();
    seeds.push((Format::Stl, solid.as_bytes().to_vec()));
    seeds.push((Format::Obj, b"v 0 0 1\nv 4 0 1\nv 4 4 2\nl 1 2/5 3 1\nl -1 -3\nf 1 2 3\n".to_vec()));
    let island = "island\n1\n  1.0E+00 2.0\n 5 2\n 5 6\nEND\n!lake\n 3 3\n 4 3\n 4 4\nEND\nEND\n";
    seeds.push((Format::Poly, island.as_bytes().to_vec()));
    seeds.push((Format::Off, off.as_bytes().to_vec()));
    seeds.push(written(Format::Node));
    seeds.extend(GRAPHS.map(|(format, text)| (format, text.as_bytes().to_vec())));
    seeds
        .extend([Format::Poly, Format::Edge, Format::Vtu, Format::Msh, Format::Medit, Format::Su2].map(mesh));
    seeds.push((Format::Msh, OLD_GMSH.as_bytes().to_vec()));
    seeds.extend(NAMED.map(|(format, text)| (format, text.as_bytes().to_vec())));
    let legacy = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 3 4\n5 6\n";
    seeds.push((Format::Vtk, legacy.as_bytes().to_vec()));
    let xml = "<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece><Points>\
        <DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">AQAAAAAAAAAYAAAAAAAAABgAAAAAAAAAHwAAAAAAAAA=\
        eJxjYGiwZ2BgcABhIHYAYkcgdgJiZyB2AWJXAEGnBCM=</DataArray></Points></Piece></PolyData></VTKFile>";
    seeds.push((Format::Vtu, xml.as_bytes().to_vec()));
    let cloud = "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n";
    seeds.push((Format::Pcd, format!("{cloud}DATA ascii\n1 2 3 0\n4 5 6 0\n").into_bytes()));
    seeds.push((Format::Pcd, [format!("{cloud}DATA binary\n").as_bytes(), &[7; 32]].concat()));
    let packed = [&[5, 0, 0, 0, 32, 0, 0, 0, 0, 7, 7 << 5, 22, 0], &[0; 4][..]].concat();
    seeds.push((Format::Pcd, [format!("{cloud}DATA binary_compressed\n").as_bytes(), &packed].concat()));
    seeds
}

/// Graphs of Triangle, with all that they can have, and what lies beside them.
const GRAPHS: [(Format, &str); 4] = [
    (
        Format::Poly,
        "# by hand\n4 2 2 1\n1 0 0 1 2 9\n2 4 0 1 2 9\n3 4 4 1 2\n4 0 4 1 2 9\n4 1\n1 1 2 5\n2 2 3 5\n3 3 4\n4 4 1 6\n1\n\
         1 3 1\n2\n1 1 2 7 0.5\n2 1 3 0.25\n",
    ),
    (Format::Poly, "0 2 0 0\n2 0\n0 0 1\n1 1 2\n0\n"),
    (Format::Area, "3\n1 0.5\n2 -1\n3 1e9\n"),
    (Format::Ele, "2 6 1\n1 1 2 3 4 5 6 0.5\n2 2 3 4 5 6 7 1.5\n"),
];

/// A file of Gmsh from before it had entities.
const OLD_GMSH: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"plate\"\n$EndPhysicalNames\n$Nodes\n4\n\
    10 0 0 0\n20 1 0 0.5\n30 1 1 0\n25 0 1 0\n$EndNodes\n$Elements\n4\n1 15 2 0 1 10\n2 1 2 0 1 10 20\n3 2 2 5 1 10 20 30\n\
    4 4 2 0 1 10 20 30 25\n$EndElements\n";

/// Meshes with names, and with what else their formats have.
const NAMED: [(Format, &str); 5] = [
    (
        Format::Poly,
        "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n1 1\n1 1 2 2\n0\n# boundary 2 in # let\n#region 1e0 \"steel\"\n",
    ),
    (
        Format::Medit,
        "MeshVersionFormatted 1\n\nDimension\n3\nVertices 3 0 0 1 7\n4 0 2 7\n0 3 3.5 7\nCorners\n1\n2\n\
         Edges\n1\n1 2 -5\nTriangles\n1\n1 2 3 4\nEnd\n",
    ),
    (
        Format::Su2,
        "% by hand\nNDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3 3\n0 0 0\n4 0 1\n0 3 2\nNMARK= 2\n\
         MARKER_TAG= inlet % west\nMARKER_ELEMS= 1\n3 0 2\nMARKER_TAG= 1\nMARKER_ELEMS= 1\n3 0 1\n",
    ),
    // Quadrilaterals among triangles.
    (Format::Su2, "NDIME= 2\nNELEM= 2\n9 0 1 2 3 0\n5 0 2 4 1\nNPOIN= 5\n0 0\n4 0\n4 3\n1 1\n-1 4\n"),
    (
        Format::Medit,
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n4 0 0\n4 3 0\n0 3 0\nQuadrilaterals\n1\n1 2 3 4 7\nEnd\n",
    ),
];

/// Geometries as text and as bytes.
const GEOMETRIES: [&str; 4] = [
    "SRID=25832;POLYGON ((0 0, 8 0, 8 8, 0 0), (2 2, 3 2, 3 3, 2 2))\n# a line\nLINESTRING ZM (0 0 1 2, 1e9 -1 2 3)\n",
    "TIN Z (((0 0 1, 1 0 2, 0 1 3, 0 0 1)), ((1 0 2, 1 1 4, 0 1 3, 1 0 2)));\nTRIANGLE ((5 5, 6 5, 5 6, 5 5))\n\
     0101000000000000000000F03F0000000000000040\n",
    "GEOMETRYCOLLECTION (MULTIPOINT ((1 2), (3 4)), MULTIPOLYGON (EMPTY, ((0 0, 1 0, 0 1, 0 0))), POINT EMPTY)",
    "0103000020E6640000010000000400000000000000000000000000000000000000000000000000F03F0000000000000000\
     0000000000000000000000000000F03F00000000000000000000000000000000\n",
];

fn scans() -> Seeds {
    debug_assert_eq!(E57, 6);
    let scan = scan();
    assert!(scan.is_ok(), "a scan is written: {:?}", scan.err());
    scan.into_iter().map(|bytes| (Format::E57, bytes)).collect()
}

fn scan() -> e57::Result<Vec<u8>> {
    use e57::{E57Writer, Record, RecordValue};
    let mut file = Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut file, "file")?;
    let fields = vec![Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F32];
    let mut scan = writer.add_pointcloud("scan", fields)?;
    for [x, y, z] in in_space() {
        scan.add_point(vec![RecordValue::Double(x), RecordValue::Double(y), RecordValue::Single(z as f32)])?;
    }
    scan.finalize()?;
    writer.finalize()?;
    drop(writer);
    Ok(file.into_inner())
}
