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
