//! Limits of a run: memory, points, content of compressed files, cells of a raster.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::place::Place;

/// A file of 82 kB that holds five million points, all at the origin.
fn bomb() -> Vec<u8> {
    let mut header =
        b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (5000000, 2), }"
            .to_vec();
    header.resize(127, b' ');
    header.push(b'\n');
    let mut file = GzEncoder::new(Vec::new(), Compression::best());
    file.write_all(&header).expect("memory");
    let zeros = vec![0; 1 << 20];
    (0..=80_000_000 / zeros.len()).for_each(|_| file.write_all(&zeros).expect("memory"));
    file.finish().expect("memory")
}

#[test]
fn compressed_content_is_bounded() {
    let place = Place::new();
    place.file("bomb.npy.gz", bomb());
    let what = "bomb.npy.gz: its compressed content is more than 1,000 times as long as the file";
    place.fail("-q triangulate bomb.npy.gz -o t.npy", 1, what);
    place.fail("-q info bomb.npy.gz", 1, what);
    // Who allows memory allows it for that too.
    place.fail("-q --max-memory 60M info bomb.npy.gz", 1, "more memory than --max-memory allows (60 MiB)");
    let told = place.succeed("-q --max-memory 2G info bomb.npy.gz");
    assert!(told.contains("5,000,000") || told.contains("5000000"), "{told}");
}

#[test]
fn memory_is_limited() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 200000 -o p.npy");
    let what = "more memory than --max-memory allows (16 MiB)";
    for command in ["triangulate p.npy -o t.npy", "voronoi p.npy -o c.geojson", "mesh p.npy -o m.vtu"] {
        place.fail(&format!("-q --max-memory 16M {command}"), 1, what);
        place.fail(&format!("-q --threads 4 --max-memory 16M {command}"), 1, what);
    }
    place.succeed("-q --max-memory 1G triangulate p.npy -o t.npy");
    place.fail("-q --max-memory some info p.npy", 2, "a size is a number of bytes");
}

/// A device that never ends does not fill the memory of the machine.
#[cfg(unix)]
#[test]
fn endless_input_ends() {
    let place = Place::new();
    for format in ["xyz", "npy", "geojson", "las", "bin"] {
        place.fail(
            &format!("-q --max-memory 64M info /dev/zero --from {format}"),
            1,
            "--max-memory allows (64 MiB)",
        );
    }
}

#[test]
fn points_are_limited() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 1000 -o p.csv");
    place.succeed("-q --max-points 1000 triangulate p.csv -o t.npy");
    let what = "p.csv: 1,000 points so far, and --max-points allows 999";
    for command in
        ["triangulate p.csv -o u.npy", "mesh p.csv -o m.vtu", "nearest p.csv --queries p.csv -o n.csv"]
    {
        place.fail(&format!("-q --max-points 999 {command}"), 1, what);
    }
    let what = "2,000 points so far, and --max-points allows 1,500";
    place.fail("-q --max-points 1500 triangulate p.csv p.csv -o u.npy", 1, what);
    let tiles = place.run("-q --max-points 999 tiles p.csv -o folder");
    assert_eq!(tiles.status.code(), Some(1));
}

#[test]
fn output_is_limited() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 2000 -o p.npy");
    let what = "more is written than the limit of output allows";
    for outputs in ["-o t.ply", "-o t.npy -o t.ply -o t.vtu", "-o t.ply.gz", "-o - --to ply"] {
        place.fail(&format!("-q --max-output 20K triangulate p.npy {outputs}"), 1, what);
    }
    place.fail("-q --max-output 20K voronoi p.npy -o c.geojson", 1, what);
    place.fail("-q --max-output 20K draw p.npy -o d.svg", 1, what);
    place.succeed("-q --max-output 2M triangulate p.npy -o t.npy -o t.ply -o t.vtu");
}

#[test]
fn a_far_point_makes_no_huge_raster() {
    let place = Place::new();
    let near = (0..30).map(|i| format!("{} {} {i}\n", i % 6, i / 6)).collect::<String>();
    place.file("p.xyz", near + "3 1e18 0\n");
    place.fail("-q dtm p.xyz -o t.tif", 1, "for 31 points, of which some are far from the others");
    place.succeed("-q dtm p.xyz -o t.tif --cell 1e17");
}
