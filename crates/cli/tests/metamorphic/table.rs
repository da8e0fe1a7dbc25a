//! The commands that give geometry, each with what there is to compare of it.

use super::given::{Given, Point, Row, Shape, compare, drawn};

/// A triangulation of the plane with heights.
fn triangles(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("triangulate p.csv {options} -o t.obj"));
    g.obj("t.obj")
}

/// Of each cell, after its sites, how many rings there are and the area; and apart from that the rings.
fn cells_with_areas(g: &Given, options: &str) -> (Vec<Shape>, Vec<Shape>) {
    g.run(&format!("voronoi p.csv {options} -o c.geojson"));
    let (mut areas, mut all) = (Vec::new(), Vec::new());
    for (about, rings) in g.features("c.geojson") {
        let sites = about["sites"].as_array().cloned().unwrap_or_else(|| vec![about["site"].clone()]);
        let sites: Vec<f64> = sites.iter().map(|site| site.as_f64().expect("an index")).collect();
        let sites = g.corners(&sites);
        let area = g.length_back(about["area"].as_f64().expect("an area"), 2);
        areas.push([&sites[..], &[rings.len() as f64, area]].concat());
        all.extend(rings.into_iter().map(|ring| [sites.clone(), g.ring(ring)].concat()));
    }
    (areas, all)
}

fn cells(g: &Given, options: &str) -> Vec<Shape> {
    cells_with_areas(g, options).1
}

fn areas(g: &Given, options: &str) -> Vec<Shape> {
    cells_with_areas(g, options).0
}

/// The edges of a graph with their lengths.
fn edges(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("graph p.csv {options} -o e.csv"));
    let row = |row: &Vec<f64>| [g.corners(&row[..2]), vec![g.length_back(row[2], 1)]].concat();
    g.table("e.csv").iter().map(row).collect()
}

/// All faces with their values.
fn filtration(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("alpha p.csv {options} --filtration f.csv"));
    let row = |row: &Vec<f64>| [g.corners(&row[1..]), vec![g.length_back(row[0], 2)]].concat();
    g.table("f.csv").iter().map(row).collect()
}

/// The outline of a shape, its triangles, and its squared radius.
fn outline(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("alpha p.csv {options} -o a.geojson -o a.csv --stats s.json"));
    let mut shapes: Vec<Shape> =
        g.features("a.geojson").into_iter().flat_map(|(_, rings)| rings).map(|ring| g.ring(ring)).collect();
    shapes.extend(facets(g, "a.csv"));
    shapes.push(vec![g.length_back(g.json("s.json")["alpha"].as_f64().expect("a number"), 2)]);
    shapes
}

/// Rows of corners by index, with their side.
fn facets(g: &Given, name: &str) -> Vec<Shape> {
    let facet = |row: &Vec<f64>| g.cycle(row.iter().map(|&i| g.point(i)).collect());
    g.table(name).iter().map(facet).collect()
}

/// Answers by index, each after its query.
fn answers(g: &Given, line: &str, shape: impl Fn(&[f64]) -> Shape) -> Vec<Shape> {
    g.run(&format!("{line} --queries q.csv -o a.csv"));
    let shapes = g.set.queries.iter().zip(g.table("a.csv"));
    // The place of the query is before its answer.
    let shape = |row: &[f64]| if row[0] < 0.0 { Vec::new() } else { shape(row) };
    shapes.map(|(q, row)| [q.to_vec(), shape(&row[q.len()..])].concat()).collect()
}

/// A mesh over segments, some of which cross.
fn mesh(g: &Given, options: &str) -> Vec<Shape> {
    g.segments("s.csv", 5);
    let common = "--segments s.csv --crossings split --fill all --max-vertices 2000 -o m.obj --stats s.json";
    g.run(&format!("mesh p.csv {options} {common}"));
    let mut shapes = g.obj("m.obj");
    shapes.push(vec![g.json("s.json")["smallest_angle"].as_f64().expect("an angle")]);
    shapes
}

/// A mesh of quadrilaterals over segments.
fn quads(g: &Given, options: &str) -> Vec<Shape> {
    g.segments("s.csv", 5);
    let common = "--segments s.csv --crossings split --fill all --max-vertices 2000 -o m.2dm --stats s.json";
    g.run(&format!("mesh p.csv --min-angle 25 {options} {common}"));
    let mut shapes = g.sms("m.2dm");
    let angle = |name: &str| g.json("s.json")["quads"][name].as_f64().expect("an angle");
    shapes.push(vec![angle("smallest_angle").round(), angle("largest_angle").round()]);
    shapes
}

/// Contour lines, or areas between heights, after their heights.
fn lines(g: &Given, name: &str) -> Vec<Shape> {
    let shape = |(about, lines): (serde_json::Value, Vec<Vec<Point>>)| {
        let bound = |name: &str| about[name].as_f64().map_or(f64::INFINITY, |z| g.height_back(z));
        let bounds = ["elevation", "lower", "upper"].map(bound);
        let is_band = about["elevation"].is_null();
        let line = |line: Vec<Point>| {
            let shape = if is_band || line.first() == line.last() { g.ring(line) } else { g.line(line) };
            [bounds.to_vec(), shape].concat()
        };
        lines.into_iter().map(line).collect::<Vec<_>>()
    };
    g.features(name).into_iter().flat_map(shape).collect()
}

/// A raster of heights, with contours.
fn terrain(g: &Given, options: &str) -> Vec<Shape> {
    let interval = g.height(0.25 * g.set.steep);
    let cell = g.part(CELL, 1);
    g.run(&format!("dtm p.csv --cell {cell} --interval {interval} {options} -o d.npy -o d.geojson"));
    let mut shapes = g.raster("d.npy", CELL);
    shapes.extend(lines(g, "d.geojson"));
    shapes
}

/// The side of cells of rasters, in units.
const CELL: f64 = 0.0625;

/// Values at queries.
fn values(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("interpolate p.csv {options} --queries q.csv -o v.csv"));
    let rows = g.table("v.csv").into_iter();
    let value = |row: &[f64]| row.iter().map(|&z| g.height_back(z)).collect::<Vec<_>>();
    g.set.queries.iter().zip(rows).map(|(q, row)| [q.to_vec(), value(&row[q.len()..])].concat()).collect()
}

/// A surface of few points, which are left of the others.
fn thinned(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("simplify p.csv {options} -o t.obj --kept k.csv"));
    let mut shapes = g.obj("t.obj");
    shapes.extend(g.table("k.csv").iter().map(|row| g.point(row[0]).to_vec()));
    shapes
}

pub(super) const PLANE: &[Row] = &[
    ("triangulate", |g| triangles(g, "")),
    ("triangulate --max-edge", |g| triangles(g, &format!("--max-edge {}", g.part(0.2, 1)))),
    ("triangulate --drop-slivers", |g| triangles(g, "--drop-slivers 0.125")),
    ("triangulate --weights", |g| triangles(g, "--weights w")),
    ("triangulate --radii", |g| triangles(g, "--radii r")),
    ("triangulate --segments", |g| {
        g.segments("s.csv", 5);
        triangles(g, "--segments s.csv --crossings split")
    }),
    ("triangulate --hints", |g| triangles(g, "--hints p.csv")),
    ("triangulate polygons", |g| {
        g.geometry("g.geojson", "Polygon", &[STAR, HOLE]);
        g.run("triangulate g.geojson --fill nonzero --crossings split -o t.obj");
        g.obj("t.obj")
    }),
    ("polygons", |g| {
        g.geometry("g.geojson", "Polygon", &[STAR, HOLE]);
        g.run("polygons g.geojson --crossings split -o t.obj");
        g.obj("t.obj")
    }),
    ("hull", |g| {
        g.run("hull p.csv -o h.csv");
        vec![g.cycle(g.table("h.csv").iter().map(|row| g.point(row[0])).collect())]
    }),
    ("voronoi", |g| cells(g, "")),
    ("voronoi --box", |g| cells(g, &format!("--box={}", g.rectangle(0.125, 1.25)))),
    ("voronoi --clip hull", |g| cells(g, "--clip hull")),
    ("voronoi --clip", |g| {
        g.geometry("g.geojson", "Polygon", &[BAY]);
        cells(g, "--clip g.geojson")
    }),
    ("voronoi --order", |g| cells(g, "--order 2")),
    ("voronoi --weights", |g| cells(g, "--weights w")),
    ("voronoi --radii", |g| cells(g, "--radii r --clip hull")),
    ("voronoi: areas", |g| areas(g, "")),
    ("voronoi: areas of --order", |g| areas(g, "--order 2 --clip hull")),
    ("voronoi: areas of --weights", |g| areas(g, "--weights w")),
    ("voronoi --areas", |g| cells(g, "--areas equal")),
    ("voronoi --relax", |g| {
        cells(g, &format!("--relax 2 --tolerance {} --sites s.csv", g.part(1e-3, 1)));
        // Points that are there twice go the same way.
        let rows = g.table("s.csv").into_iter().zip(g.points());
        let mut moved: Vec<Shape> =
            rows.map(|(row, p)| [p.to_vec(), g.back([row[0], row[1], 0.0]).to_vec()].concat()).collect();
        moved.sort_by(|p, q| compare(p, q));
        moved.dedup();
        moved
    }),
    ("graph --kind gabriel", |g| edges(g, "--kind gabriel")),
    ("graph --kind relative-neighbors", |g| edges(g, "--kind relative-neighbors")),
    ("graph --kind spanning-tree", |g| edges(g, "--kind spanning-tree")),
    ("graph --kind beta", |g| edges(g, "--kind beta --beta 1.5")),
    ("graph --kind nearest", |g| edges(g, "--kind nearest -k 3")),
    ("alpha --filtration", |g| filtration(g, "")),
    ("alpha --filtration --weights", |g| filtration(g, "--weights w")),
    ("alpha --alpha", |g| outline(g, &format!("--alpha {}", g.part(0.005, 2)))),
    ("alpha --radius", |g| outline(g, &format!("--radius {} --radii r", g.part(0.07, 1)))),
    ("alpha --optimal", |g| outline(g, "--optimal 2")),
    ("locate", |g| answers(g, "locate p.csv", |row| g.cycle(row.iter().map(|&i| g.point(i)).collect()))),
    ("nearest", |g| answers(g, "nearest p.csv", |row| g.point(row[0]).to_vec())),
    ("furthest", |g| {
        let mut shapes = answers(g, "furthest p.csv --stats s.json", |row| g.point(row[0]).to_vec());
        let circle = &g.json("s.json")["enclosing_circle"];
        let number = |value: &serde_json::Value| value.as_f64().expect("a number");
        let center = g.back([number(&circle["center"][0]), number(&circle["center"][1]), 0.0]);
        shapes.push([center.to_vec(), vec![g.length_back(number(&circle["radius"]), 1)]].concat());
        let support = circle["support"].as_array().expect("a list");
        shapes.push(g.corners(&support.iter().map(number).collect::<Vec<_>>()));
        shapes
    }),
    ("mesh --min-angle", |g| mesh(g, "--min-angle 25")),
    ("mesh --max-edge", |g| mesh(g, &format!("--max-edge {}", g.part(0.0625, 1)))),
    ("mesh --max-area", |g| mesh(g, &format!("--max-area {} --smooth 1", g.part(0.002, 2)))),
    ("mesh --layer-height", |g| {
        mesh(g, &format!("--max-edge {} --layer-height {}", g.part(0.125, 1), g.part(0.015_625, 1)))
    }),
    ("mesh --quads", |g| quads(g, "--quads")),
    ("mesh --all-quads", |g| quads(g, "--all-quads")),
    ("mesh --conforming", |g| mesh(g, "--conforming --min-angle 20")),
    ("mesh --size", |g| {
        g.sizes("size.csv");
        mesh(g, "--size size.csv --size-columns x,y,size")
    }),
    ("mesh --triangle", |g| {
        g.geometry("g.geojson", "Polygon", &[BAY]);
        g.run("mesh g.geojson --triangle q30 -o m.obj");
        g.obj("m.obj")
    }),
    ("mesh --refine", |g| {
        g.prepare("triangulate p.csv -o t.ele");
        let count = g.place.read("t.ele").lines().count() - 1;
        let rows: String = (0..count).map(|i| format!("{i} {}\n", g.part(0.002, 2))).collect();
        g.place.file("t.area", format!("{count}\n{rows}"));
        g.run("mesh p.csv --refine t.ele --areas t.area -o m.obj");
        g.obj("m.obj")
    }),
    ("contours", |g| {
        g.run(&format!("contours p.csv --interval {} -o c.geojson", g.height(0.25 * g.set.steep)));
        lines(g, "c.geojson")
    }),
    ("contours --bands", |g| {
        let [low, high] = [0.25, 0.5].map(|z| g.height(z * g.set.steep));
        let edge = g.part(0.3, 1);
        g.run(&format!("contours p.csv --bands --levels {low},{high} --max-edge {edge} -o c.geojson"));
        lines(g, "c.geojson")
    }),
    ("simplify --max-error", |g| thinned(g, &format!("--max-error {}", g.height(0.3 * g.set.steep)))),
    ("simplify --points", |g| {
        g.segments("s.csv", 21);
        thinned(g, &format!("--points 40 --segments s.csv --max-edge {}", g.part(0.6, 1)))
    }),
    ("dtm", |g| terrain(g, "")),
    ("dtm in tiles", |g| {
        g.run(&format!("dtm p.csv --cell {} --memory 64M --tile 20 -o d.npy", g.part(CELL, 1)));
        g.raster("d.npy", CELL)
    }),
    ("dtm --method natural", |g| terrain(g, "--method natural")),
    ("dtm --method laplace", |g| terrain(g, &format!("--method laplace --max-edge {}", g.part(0.3, 1)))),
    ("dtm --method nearest", |g| terrain(g, "--method nearest")),
    ("dtm --method smooth", |g| {
        terrain(g, &format!("--method smooth --max-edge-anywhere {}", g.part(0.3, 1)))
    }),
    ("dtm --method farin", |g| terrain(g, "--method farin")),
    ("dtm with lines", |g| {
        let z = g.set.steep / 2.0;
        g.geometry("b.geojson", "MultiLineString", &[&[[0.03, 0.47, z], [0.96, 0.53, 0.0]]]);
        g.geometry(
            "f.geojson",
            "Polygon",
            &[&[[0.6, 0.1, 0.0], [0.9, 0.15, 0.0], [0.7, 0.4, 0.0], [0.6, 0.1, 0.0]]],
        );
        g.geometry("c.geojson", "Polygon", &[BAY]);
        terrain(g, "--breaklines b.geojson --flat f.geojson --clip c.geojson")
    }),
    ("interpolate --method linear", |g| values(g, "--method linear --value z --outside hull")),
    ("interpolate --method natural", |g| values(g, "--value z --outside nearest")),
    ("interpolate --method laplace", |g| values(g, "--method laplace --value z --value 3")),
    ("interpolate --method nearest", |g| values(g, "--method nearest")),
    ("interpolate --method smooth", |g| values(g, "--method smooth --outside hull")),
    ("interpolate --method farin", |g| values(g, "--method farin")),
    ("interpolate --grid", |g| {
        g.run(&format!("interpolate p.csv --grid {} -o v.npy", g.part(CELL, 1)));
        g.raster("v.npy", CELL)
    }),
    ("tiles", |g| {
        g.run("tiles p.csv -o t --tile 20 --heights");
        g.prepare("window t -o all.obj");
        g.obj("all.obj")
    }),
    ("window --box", |g| {
        g.prepare("tiles p.csv -o t --tile 20");
        g.run(&format!("window t --box={} -o part.obj", g.rectangle(0.25, 0.5)));
        g.obj("part.obj")
    }),
    ("window --points", |g| {
        g.prepare("tiles p.csv -o t --tile 20 --heights");
        g.run("window t --points 40 -o some.obj");
        g.obj("some.obj")
    }),
    ("draw", |g| {
        g.segments("s.csv", 8);
        g.run("draw p.csv --segments s.csv --crossings split -o d.svg");
        drawn(g, "d.svg")
    }),
    ("draw --certain", |g| {
        g.run(&format!("draw p.csv --disks {} --certain -o d.svg", g.part(0.01, 1)));
        drawn(g, "d.svg")
    }),
];

/// A ring that meets itself, in parts of the unit.
const STAR: &[Point] = &[
    [0.1, 0.3, 0.0],
    [0.9, 0.35, 1.0],
    [0.2, 0.8, 2.0],
    [0.55, 0.05, 0.5],
    [0.75, 0.95, 1.5],
    [0.1, 0.3, 0.0],
];
const HOLE: &[Point] = &[[0.5, 0.4, 0.0], [0.55, 0.5, 1.0], [0.6, 0.42, 0.0], [0.5, 0.4, 0.0]];
/// A polygon with a bay.
const BAY: &[Point] = &[
    [-0.25, -0.125, 0.0],
    [1.25, 0.0, 0.0],
    [1.125, 1.25, 0.0],
    [0.5, 0.45, 0.0],
    [0.0, 1.0, 0.0],
    [-0.25, -0.125, 0.0],
];

/// Commands with three coordinates.
pub(super) const SPACE: &[Row] = &[
    ("triangulate --dim 3", |g| {
        g.run("triangulate p.csv --dim 3 -o t.ele");
        tetrahedra(g, "t.ele")
    }),
    ("triangulate --dim 3 --weights", |g| {
        g.run("triangulate p.csv --dim 3 --weights w -o t.ele");
        tetrahedra(g, "t.ele")
    }),
    ("triangulate --dim 3 --hints", |g| {
        g.run("triangulate p.csv --dim 3 --hints p.csv -o t.ele");
        tetrahedra(g, "t.ele")
    }),
    ("hull --dim 3", |g| {
        g.run("hull p.csv --dim 3 -o h.csv -o h.obj");
        [facets(g, "h.csv"), g.obj("h.obj")].concat()
    }),
    ("voronoi --dim 3", |g| polyhedra(g, "")),
    ("voronoi --dim 3 --radii", |g| polyhedra(g, "--radii r --clip hull")),
    ("graph --dim 3 --kind gabriel", |g| edges(g, "--dim 3 --kind gabriel")),
    ("graph --dim 3 --kind relative-neighbors", |g| edges(g, "--dim 3 --kind relative-neighbors")),
    ("graph --dim 3 --kind spanning-tree", |g| edges(g, "--dim 3 --kind spanning-tree")),
    ("graph --dim 3 --kind nearest", |g| edges(g, "--dim 3 --kind nearest -k 3")),
    ("alpha --dim 3 --filtration", |g| filtration(g, "--dim 3")),
    ("alpha --dim 3 --filtration --radii", |g| filtration(g, "--dim 3 --radii r")),
    ("alpha --dim 3 --optimal", |g| {
        g.run("alpha p.csv --dim 3 --optimal 2 -o a.csv -o a.obj");
        [facets(g, "a.csv"), g.obj("a.obj")].concat()
    }),
    ("alpha --dim 3 --manifold", |g| {
        g.run(&format!("alpha p.csv --dim 3 --alpha {} --manifold -o a.obj", g.part(0.02, 2)));
        g.obj("a.obj")
    }),
    ("locate --dim 3", |g| answers(g, "locate p.csv --dim 3", |row| g.corners(row))),
    ("nearest --dim 3", |g| answers(g, "nearest p.csv --dim 3", |row| g.point(row[0]).to_vec())),
    ("interpolate --dim 3", |g| space_values(g, "--outside nearest")),
    ("interpolate --dim 3 --method linear", |g| space_values(g, "--method linear --outside hull")),
    ("interpolate --dim 3 --method laplace", |g| space_values(g, "--method laplace")),
    ("interpolate --dim 3 --method smooth", |g| space_values(g, "--method smooth")),
    ("draw --dim 3", |g| {
        g.run("draw p.csv --dim 3 -o d.svg");
        drawn(g, "d.svg")
    }),
];

/// The faces of cells, after the site on either side.
fn polyhedra(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("voronoi p.csv --dim 3 {options} -o c.json"));
    let list = |value: &serde_json::Value| value.as_array().cloned().expect("a list");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let mut shapes = Vec::new();
    for cell in list(&g.json("c.json")) {
        let vertices: Vec<Point> =
            list(&cell["vertices"]).iter().map(|p| g.back([0, 1, 2].map(|k| number(&p[k])))).collect();
        for face in list(&cell["faces"]) {
            let sites = [&cell["site"], &face["neighbor"]].into_iter().filter_map(serde_json::Value::as_f64);
            let ring = list(&face["corners"]).iter().map(|i| vertices[number(i) as usize]).collect();
            shapes.push(sites.flat_map(|site| g.point(site)).chain(g.cycle(ring)).collect());
        }
    }
    shapes
}

/// Values that are radii.
fn space_values(g: &Given, options: &str) -> Vec<Shape> {
    g.run(&format!("interpolate p.csv --dim 3 --value r {options} --queries q.csv -o v.csv"));
    let value = |row: &[f64]| row.iter().map(|&r| g.length_back(r, 1)).collect::<Vec<_>>();
    let rows = g.table("v.csv");
    g.set.queries.iter().zip(rows).map(|(q, row)| [q.to_vec(), value(&row[q.len()..])].concat()).collect()
}

/// The rows of an .ele file, each in the order of its corners.
fn tetrahedra(g: &Given, name: &str) -> Vec<Shape> {
    let text = g.place.read(name);
    let row = |line: &str| {
        let corners: Vec<f64> =
            line.split_whitespace().skip(1).map(|word| word.parse().expect("an index")).collect();
        g.corners(&corners)
    };
    text.lines().skip(1).map(row).collect()
}
