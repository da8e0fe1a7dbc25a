//! Folders stand for the point clouds in them, and patterns for the files that are like them.

use std::fs;

use crate::place::Place;

/// A LAS file of three points of a class.
pub(crate) fn scan(shift: i32, class: u8) -> Vec<u8> {
    let mut file = vec![0_u8; 227];
    file[..4].copy_from_slice(b"LASF");
    file[24..26].copy_from_slice(&[1, 2]);
    file[94..96].copy_from_slice(&227_u16.to_le_bytes());
    file[96..100].copy_from_slice(&227_u32.to_le_bytes());
    file[105..107].copy_from_slice(&20_u16.to_le_bytes());
    file[107..111].copy_from_slice(&3_u32.to_le_bytes());
    (0..3).for_each(|k| file[131 + 8 * k..139 + 8 * k].copy_from_slice(&1.0_f64.to_le_bytes()));
    for [x, y, z] in [[0, 0, 1], [4, 0, 2], [0, 4, 3]] {
        file.extend([x + shift, y, z].into_iter().flat_map(i32::to_le_bytes));
        file.extend([0, 0, 0, class, 0, 0, 0, 0]);
    }
    file
}

#[test]
fn folders_and_patterns_stand_for_files() {
    let place = Place::new();
    fs::create_dir_all(place.path("survey/west/old")).expect("room");
    place.file("survey/a.las", scan(0, 2));
    place.file("survey/west/b.las", scan(10, 2));
    place.file("survey/west/old/c.las", scan(20, 1));
    place.file("survey/west/notes.txt", "no points\n");
    for (line, points) in [
        ("triangulate survey", 9),
        ("triangulate survey/west", 6),
        ("triangulate survey/*.las", 3),
        ("triangulate survey/**/?.las", 9),
        ("voronoi survey --to geojson", 9),
        ("alpha survey --alpha 100", 9),
    ] {
        place.succeed(
            &format!("-q {line} -o o.ply --stats s.json")
                .replace("voronoi survey --to geojson -o o.ply", "voronoi survey -o o.geojson"),
        );
        let stats: serde_json::Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
        assert_eq!(stats["points"], points, "{line}");
    }
    // A tile without ground is no end among others.
    place.succeed("-q dtm survey --cell 1 -o d.npy --stats s.json");
    place.succeed("-q info survey");
    place.fail("triangulate survey/*.laz -o o.ply", 1, "no file is like that");
    place.fail("triangulate [[[*.las -o o.ply", 1, "invalid range pattern");
    fs::create_dir(place.path("empty")).expect("room");
    place.fail("triangulate empty -o o.ply", 1, "is a folder, with no las or laz file in it");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(place.path("survey"), place.path("survey/west/back")).expect("a link");
        place.succeed("-q triangulate survey -o o.ply --stats s.json");
        assert!(place.read("s.json").contains("\"points\": 9"));
    }
}
