//! Six ideas, a picture each: `cargo run --example ideas` leaves `lifting.svg`, `visibility.svg`, `hidden.svg`, `graphs.svg`,
//! `furthest.svg` and `stolen.svg`. The book shows them (`docs/learn/pictures.md`).
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod drawing;

use delone::{Constrained2, Delaunay2, Graph, Region2, Regular2};
use delone_generators::Kind;
use delone_predicates::circumcenter;
use drawing::{BLUE, Drawing, GREEN, GREY, ORANGE};

type Done = Result<(), Box<dyn std::error::Error>>;

fn scattered(count: usize, seed: u64) -> Vec<[f64; 2]> {
    Kind::Uniform.points(count, seed)
}

fn main() -> Done {
    lifting()?;
    visibility()?;
    hidden()?;
    graphs()?;
    furthest()?;
    stolen()
}

/// Triangles below, and above each of their corners its point on the paraboloid: the lower hull there has the same triangles.
fn lifting() -> Done {
    let d = Delaunay2::from_points(&scattered(40, 4))?;
    // Seen from above and from the side, twice: x to the right, y to the back, heights up.
    let at = |[x, y]: [f64; 2], height: f64| [x + 0.42 * y, 0.36 * y + height];
    let lifted = |p: [f64; 2]| at(p, 0.5 + 1.4 * ((p[0] - 0.5).powi(2) + (p[1] - 0.5).powi(2)));
    let mut drawing = Drawing::new([-0.06, -0.08], [1.5, 1.7]);
    for v in d.vertices() {
        drawing.lines(&[at(d.point(v), 0.0), lifted(d.point(v))], false, GREY, 0.6);
    }
    for corners in d.triangles() {
        let points = corners.map(|v| d.point(v));
        drawing.lines(&points.map(|p| at(p, 0.0)), true, BLUE, 1.2);
        drawing.area(&points.map(lifted), ORANGE, 0.12);
        drawing.lines(&points.map(lifted), true, ORANGE, 1.2);
    }
    Ok(drawing.save("lifting.svg")?)
}

/// A segment, and a triangle beside it whose circle holds a point that the segment hides from it.
fn visibility() -> Done {
    let points = [[0.0, 1.0], [4.0, 1.1], [1.2, 2.0], [2.8, 2.2], [2.1, 0.4], [0.8, -0.2], [3.4, -0.1]];
    let d = Constrained2::from_parts(&points, &[[0, 1]])?;
    let mut drawing = Drawing::new([-0.4, -0.8], [4.4, 3.2]);
    let triangle = d
        .triangles()
        .map(|t| t.map(|v| d.point(v)))
        .find(|t| t.contains(&points[0]) && t.contains(&points[1]) && t.iter().any(|p| p[1] > 1.5));
    let corners @ [a, b, c] = triangle.ok_or("the segment has a triangle above it")?;
    let center = circumcenter(a, b, c).ok_or("the triangle is not flat")?;
    drawing.area(&corners, BLUE, 0.25);
    drawing.circle(center, (a[0] - center[0]).hypot(a[1] - center[1]), GREY);
    for t in d.triangles() {
        drawing.lines(&t.map(|v| d.point(v)), true, BLUE, 1.2);
    }
    drawing.lines(&points[..2], false, "black", 4.0);
    for p in points {
        let is_inside =
            (p[0] - center[0]).hypot(p[1] - center[1]) < (a[0] - center[0]).hypot(a[1] - center[1]);
        drawing.dot(p, if is_inside && !corners.contains(&p) { ORANGE } else { BLUE });
    }
    Ok(drawing.save("visibility.svg")?)
}

/// Weights as circles. A site whose power cell is empty is hidden: no vertex.
fn hidden() -> Done {
    let sites: Vec<([f64; 2], f64)> = (0_u32..)
        .map(|i| f64::from(i * 37 % 100) / 100.0)
        .map(|u| 0.03 + 0.13 * u * u)
        .zip(scattered(36, 2))
        .map(|(radius, p)| (p, radius * radius))
        .collect();
    let r = Regular2::from_sites(&sites)?;
    let mut drawing = Drawing::new([-0.15, -0.15], [1.15, 1.15]);
    for t in r.triangles() {
        drawing.lines(&t.map(|v| sites[v.index()].0), true, GREY, 1.2);
    }
    for (i, &(p, weight)) in sites.iter().enumerate() {
        let is_hidden = r.hidden().any(|v| v.index() == i);
        let color = if is_hidden { ORANGE } else { BLUE };
        drawing.circle(p, weight.sqrt(), color);
        drawing.dot(p, color);
    }
    Ok(drawing.save("hidden.svg")?)
}

/// The spanning tree in the relative neighbors in the Gabriel graph in the triangulation.
fn graphs() -> Done {
    let d = Delaunay2::from_points(&scattered(90, 1))?;
    let mut drawing = Drawing::new([-0.03, -0.03], [1.03, 1.03]);
    for t in d.triangles() {
        drawing.lines(&t.map(|v| d.point(v)), true, GREY, 1.0);
    }
    let graphs = [
        (Graph::Gabriel, GREEN, 2.0),
        (Graph::RelativeNeighbors, BLUE, 2.5),
        (Graph::SpanningTree, ORANGE, 3.5),
    ];
    for (graph, color, width) in graphs {
        for edge in d.graph(graph)? {
            drawing.lines(&edge.map(|v| d.point(v)), false, color, width);
        }
    }
    d.vertices().for_each(|v| drawing.dot(d.point(v), "black"));
    Ok(drawing.save("graphs.svg")?)
}

/// Furthest sites: only corners of the hull have cells, each circle holds all points, and the smallest is among them.
fn furthest() -> Done {
    let d = Delaunay2::from_points(&scattered(24, 5))?;
    let furthest = d.furthest();
    let mut drawing = Drawing::new([-0.25, -0.25], [1.25, 1.25]);
    for t in furthest.triangles() {
        drawing.area(&t.map(|v| d.point(v)), BLUE, 0.12);
        drawing.lines(&t.map(|v| d.point(v)), true, BLUE, 1.5);
    }
    let circle = furthest.enclosing_circle().ok_or("there are points")?;
    drawing.circle(circle.center, circle.radius, ORANGE);
    for v in d.vertices() {
        drawing.dot(d.point(v), if furthest.corners().contains(&v) { BLUE } else { GREY });
    }
    Ok(drawing.save("furthest.svg")?)
}

/// Natural neighbors: the cell that a place would have takes an area from each neighbor, and these are the weights.
fn stolen() -> Done {
    let (points, q) = (scattered(30, 3), [0.62, 0.6]);
    let region = Region2::rectangle([0.0, 0.0], [1.0, 1.0])?;
    let before = Delaunay2::from_points(&points)?;
    let mut after = before.clone();
    let new = after.insert(q)?.vertex();
    let stolen = Region2::polygon(&after.voronoi().cell(new, &region))?;
    let mut drawing = Drawing::new([-0.02, -0.02], [1.02, 1.02]);
    let colors = [BLUE, ORANGE, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"];
    let voronoi = before.voronoi();
    let taken = voronoi.clip(&stolen);
    let mut neighbors = 0;
    for v in before.vertices() {
        for ring in voronoi.cell(v, &region) {
            drawing.lines(&ring, true, GREY, 1.2);
        }
        for ring in taken.rings(v) {
            let corners: Vec<[f64; 2]> = ring.points().collect();
            drawing.area(&corners, colors[neighbors % colors.len()], 0.55);
            drawing.dot(before.point(v), colors[neighbors % colors.len()]);
            neighbors += 1;
        }
    }
    for ring in after.voronoi().cell(new, &region) {
        drawing.lines(&ring, true, "black", 2.5);
    }
    drawing.dot(q, "black");
    Ok(drawing.save("stolen.svg")?)
}
