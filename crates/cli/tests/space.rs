//! The commands with `--dim 3`.

use crate::place::{Place, answers};
use serde_json::Value;

fn json(place: &Place, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(place.path(name)).expect("stats")).expect("JSON")
}

#[test]
fn points_become_tetrahedra_in_every_format() {
    let place = Place::new();
    place.succeed("generate ball -n 500 --seed 2 -o ball.npy");
    let formats = "-o t.npy -o t.ele -o t.neigh -o t.node -o t.edge -o t.vtu -o t.msh -o t.inp -o t.mesh -o t.su2 -o t.bdf -o t.xdmf -o h.ply -o h.obj -o h.stl -o p.svg -o p.png";
    place.succeed(&format!("triangulate ball.npy --dim 3 {formats} --check --stats s.json -q"));
    let stats = json(&place, "s.json");
    let (cells, hull) =
        (stats["simplices"].as_u64().expect("a count"), stats["hull"].as_u64().expect("a count"));
    assert_eq!(
        (&stats["points"], &stats["duplicates"], &stats["vertices"]),
        (&500.into(), &0.into(), &500.into())
    );
    assert_eq!(stats["dimension"], "space");
    let text = |name: &str| std::fs::read_to_string(place.path(name)).expect("text");
    assert!(text("t.ele").starts_with(&format!("{cells} 4 0\n")));
    assert_eq!(text("t.neigh").lines().count() as u64, cells + 1);
    assert!(text("t.node").starts_with("500 3 0 0\n"));
    // Two facets of the hull meet at each of its edges.
    assert_eq!(
        text("t.edge").lines().skip(1).filter(|line| line.ends_with(" 1")).count() as u64,
        3 * hull / 2
    );
    assert_eq!(text("h.obj").matches("f ").count() as u64, hull);
    assert_eq!(std::fs::metadata(place.path("h.stl")).expect("written").len(), 84 + 50 * hull);
    for mesh in ["t.npy", "t.ele", "t.msh", "t.mesh", "t.su2"] {
        let verdict = place.succeed(&format!("check ball.npy {mesh} --dim 3"));
        assert_eq!(verdict, format!("Delaunay, and the canonical triangulation: {cells} tetrahedra\n"));
    }
    // The same tetrahedra, whatever the strategy.
    for (k, locate) in ["tree", "walk", "jump-and-walk", "hierarchy", "history", "delaunay-tree", "spatial"]
        .into_iter()
        .enumerate()
    {
        place.succeed(&format!("triangulate ball.npy --dim 3 --locate {locate} --seed 3 -o l{k}.ele -q"));
        let lines = |name: &str| {
            let mut cells: Vec<Vec<u64>> = text(name).lines().skip(1).map(corners).collect();
            cells.sort();
            cells
        };
        assert_eq!(lines(&format!("l{k}.ele")), lines("t.ele"), "{locate}");
    }
}

/// The corners on a line of an `.ele` file, in order.
fn corners(line: &str) -> Vec<u64> {
    let mut numbers: Vec<u64> =
        line.split_whitespace().skip(1).map(|word| word.parse().expect("a number")).collect();
    numbers.sort_unstable();
    numbers
}

#[test]
fn instances_are_triangulated_by_hints() {
    let place = Place::new();
    for (kind, dim) in [("disks", 2), ("balls", 3)] {
        place.succeed(&format!("generate {kind} -n 400 --seed 1 -o centers.npy"));
        place.succeed(&format!("generate {kind} -n 400 --seed 2 -o other.npy"));
        for instance in ["centers.npy", "other.npy"] {
            let out = format!("-o hinted.ply --check --stats s.json -q --dim {dim}");
            place.succeed(&format!("triangulate {instance} --hints centers.npy {out}"));
            place.succeed(&format!("triangulate {instance} --dim {dim} -o plain.ply -q --stats p.json"));
            let (hinted, plain) = (json(&place, "s.json"), json(&place, "p.json"));
            assert_eq!((&hinted["simplices"], &hinted["hull"]), (&plain["simplices"], &plain["hull"]));
            assert_eq!(hinted["algorithm"], "hints");
            let visited = hinted["visited_triangles"].as_u64().expect("a count");
            assert!(instance == "other.npy" || visited < 400 * 5, "{kind}: {visited}");
        }
        // The same at once: a file for each instance, and totals.
        let several = "triangulate centers.npy other.npy --hints centers.npy -q --stats all.json";
        place.succeed(&format!("{several} -o all-{{}}.ply --dim {dim}"));
        let all = json(&place, "all.json");
        assert_eq!(all["points"], 800);
        assert_eq!(all["instances"][1]["simplices"], json(&place, "s.json")["simplices"]);
        assert_eq!(all["instances"][1]["visited_triangles"], json(&place, "s.json")["visited_triangles"]);
        let bytes = |name: &str| std::fs::read(place.path(name)).expect("written");
        assert!(bytes("all-other.ply") == bytes("hinted.ply"), "{kind}");
        place.fail(&format!("{several} -o x.ply --dim {dim}"), 2, "one output for 2 instances");
        place.fail(&format!("{several} -o {{}}.csv --dim {dim}"), 2, "csv");
    }
    place.fail(
        "triangulate centers.npy other.npy -o x-{}.npy",
        2,
        "{} in the name of an output is for instances",
    );
    place.fail("triangulate centers.npy centers.npy --hints other.npy -o {}-x.npy", 2, "would overwrite");
    place.file("few.csv", "0,0\n1,1\n");
    place.fail("triangulate few.csv --hints centers.npy -o x.npy", 1, "2 points for 400 centers");
    place.fail("triangulate few.csv --hints centers.npy --locate tree -o x.npy", 2, "cannot be used");
}

#[test]
fn queries_in_space() {
    let place = Place::new();
    place.file("p.csv", "0,0,0\n4,0,0\n0,4,0\n0,0,4\n");
    place.file("q.csv", "1,1,1\n9,9,9\n0,0,0\n2,2,0\n");
    let inside = [0.0, 1.0, 2.0, 3.0];
    let located = answers(&place.succeed("locate p.csv --queries q.csv --dim 3 -o - --to csv"), 4);
    assert_eq!(located, [inside, [-1.0; 4], inside, inside]);
    let near = answers(&place.succeed("nearest p.csv --queries q.csv --dim 3 -k 2 -o - --to csv"), 2);
    assert_eq!(near, [[0.0, 3.0], [3.0, 2.0], [0.0, 3.0], [0.0, 2.0]]);
    place.fail("nearest p.csv --queries nowhere.csv --dim 3 -o n.npy", 1, "nowhere.csv");
    place.file("flat.csv", "1,2\n");
    place.fail("locate p.csv --queries flat.csv --dim 3 -o n.npy", 1, "no third coordinate");
    place.fail("locate p.csv --queries q.csv --dim 3 -o n.npy --locate history", 2, "for the plane");
    let info = place.succeed("info p.csv --dim 3");
    assert!(
        info.contains("tetrahedra             1\n") && info.contains("hull facets            4\n"),
        "{info}"
    );
    assert!(
        info.ends_with("edge lengths           4.0 to 5.656854249492381, median 5.656854249492381\n"),
        "{info}"
    );
}

#[test]
fn pictures_in_space() {
    let place = Place::new();
    place.succeed("generate cube -n 200 -o p.csv");
    place.succeed("draw p.csv --dim 3 --view -60,40 --cut 0,0,1,0.5 -o cut.svg -o cut.png --size 300 -q");
    place.succeed("draw p.csv --dim 3 --wireframe -o wire.svg -q");
    place.succeed("draw p.csv --dim 3 -o hull.svg -q");
    let text = |name: &str| std::fs::read_to_string(place.path(name)).expect("text");
    assert!(text("wire.svg").contains("<path fill=\"none\""));
    // Half of what a hull shows is behind it.
    assert!(text("wire.svg").matches("<path").count() > text("hull.svg").matches("<path").count() * 3 / 2);
    assert_ne!(text("cut.svg"), text("hull.svg"));
    place.fail("draw p.csv --dim 3 --cut 1,2,3 -o x.svg", 2, "four numbers");
    place.fail("draw p.csv --dim 3 --view 1 -o x.svg", 2, "two angles");
}

#[test]
fn hostile_points_in_space() {
    let place = Place::new();
    for (name, text, dimension, cells) in [
        ("none", "", "empty", 0),
        ("one", "1,2,3\n1,2,3\n", "point", 0),
        ("line", "0,0,0\n1,1,1\n2,2,2\n", "line", 0),
        ("plane", "0,0,1\n1,0,1\n0,1,1\n1,1,1\n", "plane", 0),
        ("span", "0,0,0\n1e300,0,0\n0,1e-300,0\n0,0,5e-324\n1,1,1\n", "space", 3),
    ] {
        place.file(&format!("{name}.csv"), text);
        let columns = if text.is_empty() { "" } else { " --columns 1,2,3" };
        place.succeed(&format!(
            "triangulate {name}.csv --dim 3{columns} -o t.npy -o t.vtu -o t.stl -o t.png --check -q --stats s.json"
        ));
        let stats = json(&place, "s.json");
        assert_eq!((&stats["dimension"], &stats["simplices"]), (&dimension.into(), &cells.into()), "{name}");
    }
    place.file("nan.csv", "0,0,0\n1,1,nan\n");
    place.fail("triangulate nan.csv --dim 3 -o t.npy", 1, "point 1 has the z coordinate NaN");
    place.file("flat.csv", "0,0\n1,1\n");
    place.fail("triangulate flat.csv --dim 3 -o t.npy", 1, "no third coordinate");
    place.fail("check one.csv t.stl --dim 3", 2, "tetrahedra are not read");
}
