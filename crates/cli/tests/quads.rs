//! Quadrilaterals in files, as a user meets them.

use crate::mesh::PLAN;
use crate::place::Place;

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
