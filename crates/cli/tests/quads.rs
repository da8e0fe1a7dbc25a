//! Quadrilaterals in files, as a user meets them.

use std::collections::BTreeSet;

use crate::mesh::PLAN;
use crate::place::{Place, text};

#[test]
fn quadrilaterals_are_cells_of_their_own() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.succeed("-q mesh plan.poly --edge 0.5 --quads -o q.su2 -o q.vtu -o q.msh -o q.png");
    place.succeed("-q mesh plan.poly --edge 0.5 -o t.su2");
    let count = |name: &str, kind: &str| {
        let text = place.read(name);
        let cells = text.lines().skip_while(|line| !line.starts_with("NELEM")).skip(1);
        cells.take_while(|line| !line.starts_with("NPOIN")).filter(|line| line.starts_with(kind)).count()
    };
    let [quads, triangles, all] = [count("q.su2", "9 "), count("q.su2", "5 "), count("t.su2", "5 ")];
    assert_eq!(2 * quads + triangles, all);
    assert!(quads > 4 * triangles, "{quads} and {triangles}");
    // Boundary layers are quadrilaterals.
    place.succeed("-q mesh plan.poly --edge 0.5 --layer-height 0.01 --layer-count 3 --quads -o l.su2");
    assert!(count("l.su2", "9 ") > 4 * count("l.su2", "5 "));
    for format in ["stl", "geojson", "xdmf", "ele"] {
        place.fail(&format!("mesh plan.poly --quads -o q.{format}"), 2, "quadrilaterals");
    }
    place.fail("mesh plan.poly --quads --second-order -o q.msh", 2, "--second-order");
}

/// The corners of the cells of a kind in a file of SU2.
fn cells(place: &Place, name: &str, kind: &str) -> Vec<Vec<usize>> {
    let text = place.read(name);
    let lines = text.lines().skip_while(|line| !line.starts_with("NELEM")).skip(1);
    let cells = lines.take_while(|line| !line.starts_with("NPOIN"));
    let numbers = |line: &str| line.split(' ').map(|word| word.parse().expect("a number")).collect();
    let rows = cells.filter(|line| line.starts_with(kind)).map(numbers);
    rows.map(|row: Vec<usize>| row[1..row.len() - 1].to_vec()).collect()
}

#[test]
fn all_cells_are_quadrilaterals() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.succeed("-q mesh plan.poly --edge 0.5 --quads -o q.su2 -o q.msh --stats q.json");
    let said = place.run("mesh plan.poly --edge 0.5 --all-quads -o a.su2 -o a.msh -o a.png --stats a.json");
    assert!(!cells(&place, "q.su2", "5 ").is_empty() && cells(&place, "a.su2", "5 ").is_empty());
    let [pairs, left, all] =
        [("q.su2", "9 "), ("q.su2", "5 "), ("a.su2", "9 ")].map(|(n, k)| cells(&place, n, k));
    assert_eq!(all.len(), 4 * pairs.len() + 3 * left.len());
    // Each side is there once in each direction, or it is one of the border.
    let sides: Vec<[usize; 2]> =
        all.iter().flat_map(|q| [0, 1, 2, 3].map(|k| [q[k], q[(k + 1) % 4]])).collect();
    let there: BTreeSet<[usize; 2]> = sides.iter().copied().collect();
    assert_eq!(there.len(), sides.len());
    let border = sides.iter().filter(|[v, w]| !there.contains(&[*w, *v])).count();
    let counts = |name: &str| -> Vec<(String, usize)> {
        let text = place.read(name);
        let part = |part: &str| {
            let (name, rest) = part.split_once("\nMARKER_ELEMS= ").expect("a count");
            (name.to_owned(), rest.lines().next().expect("a count").parse().expect("a number"))
        };
        text.split("MARKER_TAG= ").skip(1).map(part).collect()
    };
    let doubled: Vec<_> = counts("q.su2").into_iter().map(|(name, count)| (name, 2 * count)).collect();
    assert_eq!(counts("a.su2"), doubled);
    let inside =
        counts("a.su2").iter().filter(|marker| marker.0 == "-4").map(|marker| marker.1).sum::<usize>();
    assert_eq!(border + inside, counts("a.su2").iter().map(|marker| marker.1).sum::<usize>());
    let stats: [serde_json::Value; 2] =
        ["q.json", "a.json"].map(|name| serde_json::from_str(&place.read(name)).expect("JSON"));
    let number = |stats: &serde_json::Value, name: &str| stats["quads"][name].as_f64().expect("a number");
    for (stats, [count, triangles]) in stats.iter().zip([[pairs.len(), left.len()], [all.len(), 0]]) {
        assert_eq!((number(stats, "count"), number(stats, "triangles")), (count as f64, triangles as f64));
        assert!(number(stats, "smallest_angle") > 30.0 && number(stats, "largest_angle") < 150.0);
    }
    let line = format!("; {} quadrilaterals of ", all.len());
    let said = text(&said.stderr);
    assert!(said.replace(',', "").contains(&line), "{said}");
    // Heights of middles are means.
    place.succeed("-q mesh plan.poly --edge 0.5 --all-quads -o h.2dm");
    for node in place.read("h.2dm").lines().filter(|line| line.starts_with("ND ")) {
        let [x, y, z] =
            [2, 3, 4].map(|k| node.split(' ').nth(k).expect("four").parse::<f64>().expect("a number"));
        assert!((z - (2.0 * x + y + 5.0)).abs() < 1e-9, "{node}");
    }
    place.fail("mesh plan.poly --all-quads -o q.stl", 2, "quadrilaterals");
    place.fail("mesh plan.poly --all-quads --second-order -o q.msh", 2, "--second-order");
}

#[test]
fn rounding_that_bends_quadrilaterals_is_told() {
    let place = Place::new();
    place.file("tiny.csv", "1,1\n1.0000000000000002,1\n1,1.0000000000000002\n");
    let said = place.run("mesh tiny.csv --min-angle 0 --all-quads -o t.su2");
    let said = text(&said.stderr);
    assert!(said.contains("3 quadrilaterals are not convex"), "{said}");
    place.fail("mesh tiny.csv --min-angle 0 --all-quads --strict -o t.su2", 1, "not convex");
}

#[test]
fn quadrilaterals_are_read_as_two_triangles() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.succeed("-q mesh plan.poly --min-angle 30 --max-area 0.5 -o t.ele -o t.msh");
    for kind in ["msh", "mesh", "su2"] {
        place.succeed(&format!("-q mesh plan.poly --min-angle 30 --max-area 0.5 --quads -o q.{kind}"));
        let line = format!("mesh q.{kind} --refine q.{kind} --min-angle 0 -o again.ele -o again.msh");
        let said = text(&place.run(&line).stderr);
        assert!(said.contains(&format!("note: q.{kind}: ")), "{said}");
        assert!(said.contains(" quadrilaterals are read as two triangles each"), "{said}");
        // The diagonals are those that there were, so nothing is new.
        let triangles = |name: &str| {
            let mut rows: Vec<Vec<usize>> = numbers(&place.read(name));
            rows.iter_mut().for_each(|row| row.sort_unstable());
            rows.sort_unstable();
            rows
        };
        assert!(said.contains("(0 new inside, 0 on constraints)"), "{said}");
        assert_eq!(triangles("again.ele").len(), triangles("t.ele").len(), "{kind}");
        if kind != "su2" {
            // Regions stay: so many triangles are of each.
            let regions = |name: &str| {
                let text = place.read(name);
                let words = text.lines().map(|line| line.split(' ').collect::<Vec<_>>());
                let blocks = words.filter(|words| matches!(words[..], ["2", _, "2", _]));
                blocks.map(|words| words.join(" ")).collect::<Vec<_>>()
            };
            assert_eq!(regions("again.msh"), regions("t.msh"), "{kind}");
        }
    }
    place.file("p.csv", "0,0\n1,0\n1,1\n0,1\n");
    place.succeed("-q mesh p.csv --min-angle 0 --quads -o c.su2");
    assert_eq!(place.read("c.su2").lines().filter(|line| line.starts_with("9 ")).count(), 1);
    let said = place.run("check p.csv c.su2");
    assert!(text(&said.stdout).contains("canonical"), "{}", text(&said.stdout));
    assert!(text(&said.stderr).contains("c.su2: 1 quadrilaterals"), "{}", text(&said.stderr));
    // One that crosses itself is named.
    let crossed = place.read("c.su2");
    let crossed = crossed.lines().map(|line| if line.starts_with("9 ") { "9 0 2 1 3 0" } else { line });
    place.file("x.su2", crossed.collect::<Vec<_>>().join("\n"));
    place.fail(
        "mesh x.su2 --refine x.su2 -o r.ele",
        1,
        "points 0, 2, 1 and 3, counted from 0, crosses itself",
    );
    place.fail("check p.csv x.su2", 1, "crosses itself");
}

/// The rows of an `.ele` file without their numbers and attributes.
fn numbers(text: &str) -> Vec<Vec<usize>> {
    let rows = text.lines().skip(1).filter(|line| !line.starts_with('#'));
    let row =
        |line: &str| line.split_whitespace().map_while(|word| word.parse().ok()).skip(1).take(3).collect();
    rows.map(row).collect()
}
