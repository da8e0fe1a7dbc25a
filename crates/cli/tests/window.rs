//! A part of a folder of tiles is that part of the whole, and an overview has the points that it should.

use std::collections::BTreeSet;
use std::fs;

use delone::Delaunay2;

mod place;

use place::Place;

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
        ("window t --box 3,3,1,1 -o a.off", 2, "--box takes four numbers"),
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
