//! Points with weights as a user meets them.

use crate::place::{Place, text};

/// Four disks around a fifth, which they hide; and around a sixth, which they do not.
const DISKS: &str = "x,y,r,name\n0,0,3,a\n4,0,3,b\n4,4,3,c\n0,4,3,d\n2,2,0.5,e\n2,3,2,f\n";

#[test]
fn weights_come_from_a_file_or_a_column() {
    let place = Place::new();
    place.file("disks.csv", DISKS);
    place.file("radii.txt", "3\n3\n3\n3\n0.5\n2\n");
    place.file("weights.csv", "weight\n9\n9\n9\n9\n0.25\n4\n");
    let triangles = |what: &str| {
        place.succeed(&format!("-q triangulate disks.csv --columns x,y {what} --check -o t.ele"));
        place.read("t.ele")
    };
    let expected = triangles("--radii r");
    for what in ["--radii 3", "--radii radii.txt", "--weights weights.csv"] {
        assert_eq!(triangles(what), expected, "{what}");
    }
    // The fifth is in no triangle; without weights it is.
    let corners = |text: &str| -> Vec<String> {
        text.lines().skip(1).flat_map(|line| line.split_whitespace().skip(1).map(str::to_owned)).collect()
    };
    assert!(!corners(&expected).contains(&"4".to_owned()) && corners(&expected).contains(&"5".to_owned()));
    assert!(corners(&triangles("")).contains(&"4".to_owned()));
    let told = place.run("triangulate disks.csv --columns x,y --radii r -o t.npy --stats s.json");
    assert!(text(&told.stderr).contains("1 site is hidden"));
    assert!(place.read("s.json").contains("\"hidden\": 1"));
}

#[test]
fn what_is_wrong_with_weights_is_named() {
    let place = Place::new();
    place.file("disks.csv", DISKS);
    place.file("p.npy", "");
    place.file("few.csv", "1\n2\n");
    place.file("wrong.csv", "1\n2\n3\nx\n5\n6\n");
    place.file("inf.csv", "1\n2\n3\ninf\n5\n6\n");
    let fail = |what: &str, status, word: &str| {
        place.fail(&format!("triangulate disks.csv --columns x,y {what} -o t.npy"), status, word);
    };
    fail("--weights few.csv", 1, "2 weights for 6 points");
    fail("--weights wrong.csv", 1, "line 4");
    fail("--weights inf.csv", 1, "point 3 has the weight inf");
    place.file("large.csv", "1\n2\n3\n4\n1e200\n6\n");
    place.file("negative.csv", "1\n2\n3\n4\n5\n-4\n");
    fail("--radii inf.csv", 1, "point 3 has the radius inf, which is not finite");
    fail("--radii large.csv", 1, "point 4 has the radius 1e200, whose square is too large");
    fail("--radii negative.csv", 1, "point 5 has the radius -4.0, which is negative");
    fail("--weights name", 1, "name is no file");
    fail("--weights q", 1, "there is no column");
    fail("--weights r --radii r", 2, "cannot be used with");
    fail("--weights r --algorithm incremental", 2, "weights are for the default algorithm");
    fail("--weights r --fill all", 2, "weights are for the default algorithm");
    fail("--weights r --ratio 3", 2, "--ratio");
    fail("--weights r --locate history", 2, "with weights --locate is for space");
    place.fail("triangulate p.npy --weights r -o t.npy", 2, "no columns to look for it in");
}

#[test]
fn power_cells_are_written() {
    let place = Place::new();
    place.file("disks.csv", DISKS);
    place
        .succeed("-q voronoi disks.csv --columns x,y --radii r -o cells.geojson -o cells.svg --stats s.json");
    let stats = place.read("s.json");
    assert!(stats.contains("\"cells\": 5") && stats.contains("\"area\": 16.0"), "{stats}");
    assert!(!place.read("cells.geojson").contains("\"site\":4,"));
    place.succeed("-q voronoi disks.csv --columns x,y --radii r --clip hull -o c.svg");
    place.fail(
        "voronoi disks.csv --columns x,y --radii r --relax 2 -o d.svg",
        2,
        "--relax is for sites without weights",
    );
}

/// By flips the tetrahedra are the same, and the history is counted.
#[test]
fn sites_in_space_are_located_by_history() {
    let place = Place::new();
    place.succeed("-q generate ball -n 300 -o q.csv");
    let weights: String = (0..300).map(|i| format!("{}\n", 0.1 * f64::from(i % 7))).collect();
    place.file("w.csv", weights);
    place.succeed("-q triangulate q.csv --dim 3 --weights w.csv -o c.npy --stats c.json");
    place.succeed(
        "-q triangulate q.csv --dim 3 --weights w.csv --locate history --seed 5 --check -o f.npy --stats f.json",
    );
    let number = |stats: &str, key: &str| -> u64 {
        let rest = stats.split_once(&format!("\"{key}\": ")).expect(key).1;
        rest.chars().take_while(char::is_ascii_digit).collect::<String>().parse().expect("a number")
    };
    let [by_cavities, by_flips] = ["c.json", "f.json"].map(|name| place.read(name));
    assert_eq!(number(&by_cavities, "simplices"), number(&by_flips, "simplices"));
    assert_eq!(number(&by_cavities, "hidden"), number(&by_flips, "hidden"));
    assert!(number(&by_flips, "hidden") > 100, "{by_flips}");
    assert!(by_flips.contains("\"locate\": \"history\""), "{by_flips}");
    assert!(number(&by_flips, "created") > number(&by_cavities, "created"), "{by_flips} {by_cavities}");
    let fail = |what: &str, word: &str| {
        place.fail(&format!("triangulate q.csv --dim 3 --weights w.csv {what} -o t.npy"), 2, word);
    };
    fail("--locate hierarchy", "by default or by history");
    fail("--locate history --ratio 3", "--ratio");
    fail("--ratio 3", "--ratio");
}

#[test]
fn equal_radii_are_none() {
    let place = Place::new();
    place.succeed("-q generate grid -n 400 -o p.csv");
    place.succeed("-q generate ball -n 300 -o q.csv");
    place.file("one.csv", "2.5\n".repeat(400));
    place.file("two.csv", "-1e3\n".repeat(300));
    for (points, weights) in [("p.csv", "--radii one.csv"), ("q.csv", "--dim 3 --weights two.csv")] {
        let (dim, _) = weights.split_once("--weights").unwrap_or_default();
        place.succeed(&format!("-q triangulate {points} {dim} -o plain.npy"));
        place.succeed(&format!("-q triangulate {points} {weights} -o w.npy --stats s.json"));
        let count = |name: &str| std::fs::metadata(place.path(name)).expect("written").len();
        assert_eq!(count("plain.npy"), count("w.npy"), "{points}");
        place.succeed(&format!("-q check {points} w.npy {dim}"));
    }
}

#[test]
fn triangles_of_points_with_weights_are_judged() {
    let place = Place::new();
    place.file("disks.csv", DISKS);
    place.succeed("-q triangulate disks.csv --columns x,y --radii r -o t.npy");
    let said = place.succeed("check disks.csv t.npy --columns x,y --radii r --stats s.json");
    assert!(said.starts_with("Regular, and the canonical triangulation"), "{said}");
    assert!(place.read("s.json").contains("\"regular\": true"));
    place.fail("check disks.csv t.npy --columns x,y", 1, "point 4 is not a corner");
    place.succeed("-q triangulate disks.csv --columns x,y -o plain.npy");
    place.fail("check disks.csv plain.npy --columns x,y --radii r", 1, "not regular: triangle");
    place.fail(
        "check disks.csv t.npy --columns x,y --radii r --segments disks.csv",
        2,
        "cannot be used with",
    );
    place.succeed("-q generate ball -n 300 -o q.csv");
    place.file("w.csv", "1\n3\n1.5\n".repeat(100));
    place.succeed("-q triangulate q.csv --dim 3 --weights w.csv -o t.npy");
    let said = place.succeed("check q.csv t.npy --dim 3 --weights w.csv");
    assert!(said.contains("canonical"), "{said}");
}

#[test]
fn cells_have_the_areas_that_were_asked_for() {
    let place = Place::new();
    place.file("sites.csv", "x,y,customers\n0.2,0.2,1\n0.8,0.3,2\n0.4,0.9,5\n");
    let told = place
        .run("voronoi sites.csv --columns x,y --areas customers --box 0,0,1,1 -o c.geojson --stats s.json");
    assert!(text(&told.stderr).contains("steps"), "{}", text(&told.stderr));
    for area in ["\"area\":0.12", "\"area\":0.2", "\"area\":0.62"] {
        assert!(place.read("c.geojson").contains(area), "{area}");
    }
    place.succeed("-q voronoi sites.csv --columns x,y --areas equal --box 0,0,1,1 -o c.geojson");
    assert_eq!(place.read("c.geojson").matches("\"area\":0.33333333").count(), 3);
    let fail = |what: &str, status, word: &str| {
        place.fail(&format!("voronoi sites.csv --columns x,y {what} -o d.svg"), status, word);
    };
    fail("--areas equal --box 0,0,0.1,0.1", 1, "site 1 has no cell in the region");
    fail("--areas x --order 2", 2, "cannot be used with");
    fail("--areas equal --relax 2", 2, "--relax is for sites without weights");
    fail("--areas q", 1, "there is no column");
    place.file("zero.csv", "1\n0\n1\n");
    fail("--areas zero.csv --box 0,0,1,1", 1, "zero.csv: site 1 is to have the area 0");
    fail("--areas equal --box=-1e200,-1e200,1e200,1e200", 1, "the area of the region");
}
