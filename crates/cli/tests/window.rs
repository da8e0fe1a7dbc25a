//! Outputs of a folder of tiles: a part is that part of the whole, an overview has the points that it should, neighbors know each
//! other.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use delone::Delaunay2;

use crate::place::Place;

type Triangle = [[u64; 2]; 3];

fn key(corners: [[f64; 2]; 3]) -> Triangle {
    let mut bits = corners.map(|p| p.map(f64::to_bits));
    bits.sort_unstable();
    bits
}

/// The points and triangles of an OFF file.
fn off(place: &Place, name: &str) -> (Vec<[f64; 2]>, BTreeSet<Triangle>) {
    let text = fs::read_to_string(place.path(name)).expect("written");
    let mut numbers = text.split_whitespace().skip(1).map(|x| x.parse::<f64>().expect("a number"));
    let mut next = || numbers.next().expect("more");
    let (points, triangles, _) = (next() as usize, next() as usize, next());
    let points: Vec<[f64; 2]> = (0..points)
        .map(|_| {
            let p = [next(), next()];
            next();
            p
        })
        .collect();
    let triangle = |_| {
        next();
        key([0, 1, 2].map(|_| points[next() as usize]))
    };
    let triangles = (0..triangles).map(triangle).collect();
    (points, triangles)
}

#[test]
fn a_part_is_that_of_the_whole() {
    let place = Place::new();
    for (kind, size) in [("uniform", 3000), ("grid", 2500), ("clusters", 2000)] {
        place.succeed(&format!("-q generate {kind} -n {size} --seed 3 -o p.csv"));
        place.succeed("-q tiles p.csv -o t --tile 200");
        place.succeed("-q window t -o all.off");
        let (points, all) = off(&place, "all.off");
        let d = Delaunay2::from_points(&points).expect("finite");
        let expected: BTreeSet<Triangle> = d.triangles().map(|t| key(t.map(|v| d.point(v)))).collect();
        assert_eq!(all, expected, "{kind}");
        let range = |k: usize| {
            let all = points.iter().map(|p| p[k]);
            [all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max)]
        };
        let ([x, x2], [y, y2]) = (range(0), range(1));
        for (from, to) in [(0.4, 0.6), (0.0, 0.2), (-1.0, 2.0), (0.5, 0.5), (2.0, 3.0)] {
            let at = |low: f64, high: f64, part: f64| low + part * (high - low);
            let (low, high) = ([at(x, x2, from), at(y, y2, from)], [at(x, x2, to), at(y, y2, to)]);
            let given = [low, high].as_flattened().iter().map(f64::to_string).collect::<Vec<_>>().join(",");
            place.succeed(&format!("-q window t --box {given} -o part.off"));
            let meets = |t: &&Triangle| {
                (0..2).all(|k| {
                    let sides = t.map(|p| f64::from_bits(p[k]));
                    sides.iter().any(|&x| x >= low[k]) && sides.iter().any(|&x| x <= high[k])
                })
            };
            let expected: BTreeSet<Triangle> = all.iter().filter(meets).copied().collect();
            let (_, part) = off(&place, "part.off");
            assert_eq!(part, expected, "{kind} {given}");
            assert!(from > 1.0 || !part.is_empty(), "{kind} {given}");
        }
        fs::remove_dir_all(place.path("t")).expect("removed");
    }
}

/// The rows of three numbers of a file.
fn rows(place: &Place, name: &str) -> Vec<[u64; 3]> {
    let file = std::io::BufReader::new(fs::File::open(place.path(name)).expect("written"));
    delone_io::read_triangles(Box::new(file), delone_io::Format::Npy).expect("rows")
}

#[test]
fn what_is_across_an_edge_is_known() {
    let place = Place::new();
    for (kind, size, tile) in
        [("uniform", 2000, 200), ("grid", 1600, 100), ("uniform", 300, 1000), ("circle", 200, 30)]
    {
        place.succeed(&format!("-q generate {kind} -n {size} --seed 3 -o p.csv"));
        place.succeed(&format!("-q tiles p.csv -o t --tile {tile}"));
        // Of tiles that are done, and again.
        place.succeed(&format!("-q tiles p.csv -o t --tile {tile} --resume --neighbors"));
        place.succeed(&format!("-q tiles p.csv -o t --tile {tile} --resume --neighbors"));
        let manifest: serde_json::Value =
            serde_json::from_slice(&fs::read(place.path("t/tiles.json")).expect("written")).expect("JSON");
        // By name: corners, and what is across, the outline as nothing.
        let mut all: BTreeMap<u64, ([u64; 3], [Option<u64>; 3])> = BTreeMap::new();
        for node in manifest["nodes"].as_array().expect("nodes") {
            let node = node["node"].as_u64().expect("a number");
            let triangles = format!("t/triangles-{node:05}.npy");
            if place.path(&triangles).exists() {
                let beside = rows(&place, &format!("t/neighbors-{node:05}.npy"));
                for (row, (t, beside)) in rows(&place, &triangles).into_iter().zip(beside).enumerate() {
                    let beside =
                        beside.map(|next| (next != u64::from(u32::MAX)).then_some(node << 32 | next));
                    all.insert(node << 32 | row as u64, (t.map(|v| node << 32 | v), beside));
                }
                for [row, corner, other] in rows(&place, &format!("t/across-{node:05}.npy")) {
                    let known = &mut all.get_mut(&(node << 32 | row)).expect("a triangle").1[corner as usize];
                    assert_eq!(known.replace(other), None);
                }
            } else {
                let beside = rows(&place, &format!("t/neighbors-{node:05}.npy"));
                let seam = rows(&place, &format!("t/seam-{node:05}.npy"));
                assert_eq!(seam.len(), beside.len());
                for (row, (t, beside)) in seam.into_iter().zip(beside).enumerate() {
                    let beside = beside.map(|next| (next != u64::MAX).then_some(next));
                    all.insert(node << 32 | row as u64, (t, beside));
                }
            }
        }
        assert_eq!(Some(all.len() as u64), manifest["triangles"].as_u64());
        let mut outline = 0;
        for (&name, (corners, beside)) in &all {
            for k in 0..3 {
                let Some(other) = beside[k] else {
                    outline += 1;
                    continue;
                };
                let (far, back) = &all[&other];
                let j = back.iter().position(|&next| next == Some(name)).expect("both know each other");
                assert_eq!(corners[(k + 1) % 3], far[(j + 2) % 3]);
                assert_eq!(corners[(k + 2) % 3], far[(j + 1) % 3]);
            }
        }
        assert_eq!(Some(outline), manifest["hull"].as_u64(), "{kind}");
        place.succeed("check t");
        fs::remove_dir_all(place.path("t")).expect("removed");
    }
}

#[test]
fn overviews_and_pictures() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 5000 --seed 3 -o p.csv");
    place.succeed("-q tiles p.csv -o t --tile 500");
    place.succeed("-q window t --points 500 -o few.off --stats stats.json");
    let (points, triangles) = off(&place, "few.off");
    assert!((500..=520).contains(&points.len()) && triangles.len() > 900, "{}", points.len());
    let stats: serde_json::Value =
        serde_json::from_slice(&fs::read(place.path("stats.json")).expect("written")).expect("JSON");
    assert_eq!(
        (stats["points"].as_u64(), stats["simplices"].as_u64()),
        (Some(5000), Some(triangles.len() as u64))
    );
    place.succeed("-q window t --tiles -o tiles.svg -o tiles.png");
    assert!(fs::read_to_string(place.path("tiles.svg")).expect("written").contains("<svg"));
}

#[test]
fn what_cannot_be_is_refused() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 500 --seed 3 -o p.csv");
    place.succeed("-q tiles p.csv -o t --tile 100");
    fs::create_dir(place.path("empty")).expect("made");
    for (arguments, status, what) in [
        ("window empty -o a.off", 1, "without tiles.json"),
        ("window nowhere -o a.off", 1, "without tiles.json"),
        ("window t --box 1,2,3 -o a.off", 2, "--box takes four numbers"),
        ("window t --box 3,3,1,1 -o a.off", 2, "first corner is not the least"),
        ("window t --box nan,0,1,1 -o a.off", 2, "--box takes four numbers"),
        ("window t --points 0 -o a.off", 2, "invalid value"),
        ("window t -o a.las", 2, "las"),
        ("window t", 2, "--output"),
    ] {
        place.fail(arguments, status, what);
        assert!(!place.path("a.off").exists(), "{arguments}");
    }
    let shards = fs::read_dir(place.path("t")).expect("readable").map(|e| e.expect("readable").path());
    for path in shards.filter(|path| path.to_string_lossy().contains("triangles-")) {
        fs::remove_file(path).expect("removed");
    }
    place.fail("window t -o a.off", 1, "triangles-");
}
