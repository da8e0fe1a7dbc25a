//! Formats of solvers besides Gmsh's and Abaqus's: judged by small parsers of what their manuals say, and by our readers, against the
//! triangulation.

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::{Scene, sorted, source, written};
use delone_generators::Graph;
use delone_io::{
    Constraints, Format, Mesh, Names, ReadOptions, holds_lines, picture, read_graph,
    read_triangle_attributes, read_triangles, write_mesh,
};
use delone_predicates::{Sign, orient2d};

/// A point by its coordinates, because points without triangles are left out.
type Place = [u64; 2];

/// Triangles with their regions, and sides with their markers.
#[derive(Debug, Default, PartialEq)]
struct Seen {
    triangles: Vec<([Place; 3], i64)>,
    sides: Vec<([Place; 2], i64)>,
}

fn place([x, y]: [f64; 2]) -> Place {
    // Zero has no sign here.
    [x + 0.0, y + 0.0].map(f64::to_bits)
}

impl Seen {
    fn add_triangle(&mut self, corners: [[f64; 2]; 3], region: i64) {
        let [a, b, c] = corners;
        assert_eq!(orient2d(a, b, c), Sign::Positive);
        let mut places = corners.map(place);
        let least = (0..3).min_by_key(|&k| places[k]).expect("three");
        places.rotate_left(least);
        self.triangles.push((places, region));
    }

    fn add_side(&mut self, ends: [[f64; 2]; 2], marker: i64) {
        let mut places = ends.map(place);
        places.sort_unstable();
        self.sides.push((places, marker));
    }

    fn sorted(mut self) -> Self {
        self.triangles.sort_unstable();
        self.sides.sort_unstable();
        self
    }

    /// The content of a scene, with numbers as a format has them.
    fn of(scene: &Scene, number: fn(&[f64]) -> BTreeMap<u64, i64>) -> Self {
        let mut seen = Self::default();
        let regions: Vec<f64> = scene.triangles().iter().map(|triangle| triangle.1).collect();
        let numbers = number(&regions);
        for (corners, region) in scene.triangles() {
            seen.add_triangle(corners.map(|i| scene.points[i]), numbers[&(region + 0.0).to_bits()]);
        }
        let sides = scene.edge_markers().into_iter().filter(|edge| edge.1.1);
        let sides: Vec<_> = sides.map(|(ends, (marker, _))| (ends, marker as f64)).collect();
        let numbers = number(&sides.iter().map(|side| side.1).collect::<Vec<_>>());
        for (ends, marker) in sides {
            seen.add_side(ends.map(|i| scene.points[i]), numbers[&marker.to_bits()]);
        }
        seen.sorted()
    }
}

/// Numbers by their bits: those that are permitted as they are, the others the least ones from 1 that are free.
fn numbered(numbers: &[f64], is_permitted: fn(f64) -> bool) -> BTreeMap<u64, i64> {
    let mut all: Vec<f64> = numbers.iter().map(|number| number + 0.0).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let is_kept =
        |number: &f64| number.fract() == 0.0 && number.abs() < f64::from(i32::MAX) && is_permitted(*number);
    let positive: Vec<i64> = all
        .iter()
        .filter(|number| number.fract() == 0.0 && **number < 1e9)
        .map(|number| *number as i64)
        .collect();
    let mut free = (1..).filter(|number| !positive.contains(number));
    // Every number that is not positive takes a free one, whether it is used or not.
    let mut numbered = BTreeMap::new();
    for number in all {
        let tag = if number.fract() == 0.0 && number > 0.0 && number < 1e9 {
            number as i64
        } else {
            free.next().expect("one")
        };
        numbered.insert(number.to_bits(), if is_kept(&number) { number as i64 } else { tag });
    }
    numbered
}

fn whole(numbers: &[f64]) -> BTreeMap<u64, i64> {
    numbered(numbers, |_| true)
}

fn positive(numbers: &[f64]) -> BTreeMap<u64, i64> {
    numbered(numbers, |number| number > 0.0)
}

#[test]
fn medit_and_su2_are_read_back() {
    for scene in Scene::all() {
        for format in [Format::Medit, Format::Su2] {
            let text = scene.written(format, false);
            let bytes = text.as_bytes();
            let graph = read_graph(source(bytes), format, &ReadOptions::default(), None).expect("a graph");
            let triangles = read_triangles(source(bytes), format).expect("triangles");
            let attributes = read_triangle_attributes(source(bytes), format).expect("regions");
            let mut expected = Seen::of(&scene, whole);
            let mut seen = Seen::default();
            let at = |i: usize| graph.cloud.xy[i];
            for (row, corners) in triangles.iter().enumerate() {
                let region = attributes.row(row).first().map_or(0, |&region| region as i64);
                seen.add_triangle(corners.map(|i| at(i as usize)), region);
            }
            if format == Format::Su2 {
                expected.triangles.iter_mut().for_each(|triangle| triangle.1 = 0);
            }
            let markers = graph.markers.clone().unwrap_or_else(|| vec![0; graph.segments.len()]);
            for (ends, marker) in graph.segments.iter().zip(markers) {
                seen.add_side(ends.map(at), marker);
            }
            assert_eq!(seen.sorted(), expected, "{} {format}", scene.name);
            let used: BTreeSet<Place> = expected.triangles.iter().flat_map(|triangle| triangle.0).collect();
            assert_eq!(graph.cloud.xy.len(), used.len(), "{} {format}: each point once", scene.name);
            assert_eq!(holds_lines(source(bytes), format), !expected.sides.is_empty());
        }
    }
}

/// Parses a mesh of SMS: triangles by their corners, and the sides along strings, by the number that calls them.
fn sms(text: &str, second_order: bool) -> Seen {
    let mut nodes = BTreeMap::new();
    let (mut elements, mut strings) = (Vec::new(), Vec::new());
    let mut string: Vec<usize> = Vec::new();
    assert!(text.starts_with("MESH2D\nNUM_MATERIALS_PER_ELEM 1\n"));
    for line in text.lines().skip(2) {
        let words: Vec<&str> = line.split(' ').collect();
        let numbers = || words[1..].iter().map(|word| word.parse::<i64>().expect("a number"));
        match words[0] {
            "ND" => {
                let [x, y, z] = [2, 3, 4].map(|k| words[k].parse::<f64>().expect("a number"));
                assert_eq!((words[1], z), (&(nodes.len() + 1).to_string()[..], 0.0));
                nodes.insert(nodes.len() + 1, [x, y]);
            }
            "NS" => {
                for word in &words[1..] {
                    let number: i64 = word.parse().expect("a number");
                    if string.last() == Some(&0) {
                        string.pop();
                        strings.push((std::mem::take(&mut string), number));
                    } else {
                        string.push(number.unsigned_abs() as usize);
                        string.extend((number < 0).then_some(0));
                    }
                }
                assert!(words.len() <= 12);
            }
            card => {
                assert_eq!(card, if second_order { "E6T" } else { "E3T" });
                let row: Vec<i64> = numbers().collect();
                assert_eq!(row[0], elements.len() as i64 + 1);
                elements.push(row);
            }
        }
    }
    let mut seen = Seen::default();
    let step = if second_order { 2 } else { 1 };
    let mut middles: BTreeMap<usize, [usize; 2]> = BTreeMap::new();
    for row in &elements {
        let corner = |k: usize| row[1 + step * k] as usize;
        seen.add_triangle([0, 1, 2].map(|k| nodes[&corner(k)]), row[1 + 3 * step]);
        for k in (0..3).filter(|_| second_order) {
            let ends = sorted([corner(k), corner((k + 1) % 3)]);
            let middle = [0, 1].map(|k| f64::midpoint(nodes[&ends[0]][k], nodes[&ends[1]][k]));
            let number = row[2 + 2 * k] as usize;
            assert_eq!(nodes[&number], middle);
            assert_eq!(*middles.entry(number).or_insert(ends), ends);
        }
    }
    for (string, marker) in strings {
        for part in string.windows(step + 1).step_by(step) {
            let ends = [part[0], part[step]];
            assert!(!second_order || middles[&part[1]] == sorted(ends));
            seen.add_side(ends.map(|node| nodes[&node]), marker);
        }
    }
    seen.sorted()
}

#[test]
fn sms_sees_materials_and_strings() {
    for scene in Scene::all() {
        for second_order in [false, true] {
            let seen = sms(&scene.written(Format::Sms, second_order), second_order);
            let expected = Seen::of(&scene, positive);
            assert_eq!(seen.triangles, expected.triangles, "{}", scene.name);
            assert_eq!(seen.sides, Seen::of(&scene, whole).sides, "{}", scene.name);
        }
    }
}

/// The places of nodes by the number of their set.
type Sets = BTreeMap<i64, BTreeSet<Place>>;

/// Parses bulk data of Nastran in fields: triangles by their corners, and sets of nodes.
fn nastran(text: &str) -> (Seen, Sets, BTreeMap<usize, [f64; 2]>) {
    let number = |field: &str| -> f64 {
        let field = field.trim();
        let exponent = field.get(1..).and_then(|rest| rest.find(['+', '-'])).map(|at| at + 1);
        let plain = exponent.map(|at| format!("{}e{}", &field[..at], &field[at..]));
        plain.unwrap_or_else(|| field.to_owned()).parse().expect("a number")
    };
    let index = |field: &str| field.trim().parse::<usize>().expect("an index");
    let (mut seen, mut sets, mut nodes) = (Seen::default(), BTreeMap::new(), BTreeMap::new());
    let (_, bulk) = text.split_once("BEGIN BULK\n").expect("bulk data");
    let mut lines = bulk.lines().filter(|line| !line.starts_with('$')).peekable();
    while let Some(line) = lines.next().filter(|&line| line != "ENDDATA") {
        assert!(line.len() <= 80 && line.is_ascii(), "{line}");
        if line.starts_with("GRID*") {
            let more = lines.next().expect("a second line");
            assert!(line.ends_with('*') && more.starts_with('*') && number(&more[8..24]) == 0.0);
            nodes.insert(index(&line[8..24]), [number(&line[40..56]), number(&line[56..72])]);
            continue;
        }
        let mut fields: Vec<String> = Vec::new();
        let mut rest = line.to_owned();
        loop {
            let end = rest.len().min(72);
            fields.extend(
                rest.as_bytes()[8..end].chunks(8).map(|field| String::from_utf8_lossy(field).into_owned()),
            );
            match lines.next_if(|next| next.starts_with('+')) {
                Some(next) => next.clone_into(&mut rest),
                None => break,
            }
        }
        let fields: Vec<usize> = fields.iter().map(|field| index(field)).collect();
        if line.starts_with("SET1 ") {
            let places = fields[1..].iter().map(|node| place(nodes[node])).collect();
            assert!(sets.insert(fields[0] as i64, places).is_none());
        } else {
            assert!(line.starts_with(if fields.len() == 5 { "CTRIA3 " } else { "CTRIA6 " }));
            assert_eq!(fields[0], seen.triangles.len() + 1);
            seen.add_triangle([2, 3, 4].map(|k| nodes[&fields[k]]), fields[1] as i64);
        }
    }
    (seen.sorted(), sets, nodes)
}

#[test]
fn nastran_sees_properties_and_sets() {
    for mut scene in Scene::all() {
        // Numbers that 16 characters hold.
        scene.points.iter_mut().flatten().for_each(|x| *x = (*x * 1e10).round() / 1e10);
        let (seen, sets, nodes) = nastran(&scene.written(Format::Nastran, false));
        let expected = Seen::of(&scene, positive);
        assert_eq!(seen.triangles, expected.triangles, "{}", scene.name);
        let mut met: BTreeMap<i64, BTreeSet<Place>> = BTreeMap::new();
        expected.sides.iter().for_each(|(ends, marker)| met.entry(*marker).or_default().extend(ends));
        assert_eq!(sets, met, "{}", scene.name);
        for (node, position) in nodes {
            assert_eq!(place(position), place(scene.points[node - 1]));
        }
    }
}

#[test]
fn xdmf_has_points_triangles_and_regions() {
    for scene in Scene::all() {
        let text = scene.written(Format::Xdmf, false);
        let items: Vec<Vec<f64>> = text
            .split("Format=\"XML\">")
            .skip(1)
            .map(|part| part.split('<').next().expect("an end"))
            .map(|part| part.split_whitespace().map(|word| word.parse().expect("a number")).collect())
            .collect();
        let points = items[0].as_chunks::<2>().0;
        let mut seen = Seen::default();
        for (row, region) in items[1].as_chunks::<3>().0.iter().zip(&items[2]) {
            seen.add_triangle(row.map(|i| points[i as usize]), (region * 2.0) as i64);
        }
        let twice = |regions: &[f64]| {
            regions.iter().map(|region| ((region + 0.0).to_bits(), (region * 2.0) as i64)).collect()
        };
        assert_eq!(seen.sorted().triangles, Seen::of(&scene, twice).triangles, "{}", scene.name);
    }
}

/// A boundary of a grid of ADCIRC: whether it is open, its type, its name and its nodes.
type Boundary = (bool, u8, String, Vec<usize>);

/// Parses a grid of ADCIRC: nodes with depths, triangles, and boundaries.
fn adcirc(text: &str) -> (Vec<[f64; 3]>, Vec<[usize; 3]>, Vec<Boundary>) {
    let mut lines = text.lines().skip(1);
    let mut row =
        || -> Vec<String> { lines.next().expect("a line").split_whitespace().map(str::to_owned).collect() };
    let number = |word: &String| word.parse::<usize>().expect("a number");
    let counts = row();
    let nodes = (1..=number(&counts[1]))
        .map(|k| {
            let row = row();
            assert_eq!(number(&row[0]), k);
            [1, 2, 3].map(|k| row[k].parse().expect("a number"))
        })
        .collect();
    let triangles = (1..=number(&counts[0]))
        .map(|k| {
            let row = row();
            assert_eq!((number(&row[0]), &row[1][..]), (k, "3"));
            [2, 3, 4].map(|k| number(&row[k]) - 1)
        })
        .collect();
    let mut boundaries = Vec::new();
    for is_open in [true, false] {
        let (count, all) = (number(&row()[0]), number(&row()[0]));
        let mut sum = 0;
        for _ in 0..count {
            let head = row();
            let name = head.last().expect("a name").clone();
            let nodes: Vec<usize> = (0..number(&head[0])).map(|_| number(&row()[0]) - 1).collect();
            sum += nodes.len();
            boundaries.push((is_open, head[1].parse().expect("a type"), name, nodes));
        }
        assert_eq!(sum, all);
    }
    assert_eq!(lines.next(), None);
    (nodes, triangles, boundaries)
}

#[test]
fn adcirc_sees_the_border_in_order() {
    let mut names = Names::default();
    names.name_boundary(7, "Ocean_west").expect("new");
    names.name_boundary(2, "shore").expect("new");
    for scene in Scene::all() {
        let heights: Vec<f64> = scene.points.iter().map(|p| p[0] - p[1]).collect();
        let constraints = scene.constraints();
        let mesh = Mesh { names: Some(&names), heights: Some(&heights), ..scene.mesh(&constraints, false) };
        let text = String::from_utf8(written(Format::Adcirc, &mesh)).expect("text");
        let (nodes, triangles, boundaries) = adcirc(&text);
        let mut seen = Seen::default();
        assert!(nodes.iter().all(|&[x, y, depth]| depth == y - x));
        let at = |i: usize| [nodes[i][0], nodes[i][1]];
        triangles.iter().for_each(|row| seen.add_triangle(row.map(at), 0));
        let mut directed: BTreeSet<[usize; 2]> = BTreeSet::new();
        triangles.iter().for_each(|&[a, b, c]| directed.extend([[a, b], [b, c], [c, a]]));
        let mut open = Seen::default();
        let mut sides = Vec::new();
        for (is_open, kind, name, nodes) in &boundaries {
            assert_eq!(*is_open, name == "Ocean_west", "{}", scene.name);
            assert!(*kind == 0 || !is_open && nodes.first() == nodes.last());
            for side in nodes.windows(2) {
                let (from, to) = (side[0], side[1]);
                assert!(directed.contains(&[from, to]) && !directed.contains(&[to, from]), "{}", scene.name);
                sides.push([from, to]);
                if *is_open {
                    open.add_side([at(from), at(to)], 7);
                }
            }
        }
        sides.sort_unstable();
        let border: Vec<[usize; 2]> =
            directed.iter().copied().filter(|&[a, b]| !directed.contains(&[b, a])).collect();
        assert_eq!(sides, border, "{}: each side of the border once", scene.name);
        let mut expected = Seen::of(&scene, |numbers| {
            numbers.iter().map(|number| (number.to_bits(), *number as i64)).collect()
        });
        expected.triangles.iter_mut().for_each(|triangle| triangle.1 = 0);
        let is_border = |side: &([Place; 2], i64)| {
            let of = |places: [Place; 2]| places;
            border.iter().any(|ends| {
                let mut places = ends.map(|i| place(at(i)));
                places.sort_unstable();
                places == of(side.0)
            })
        };
        expected.sides.retain(|side| side.1 == 7 && is_border(side));
        assert_eq!(
            seen.sorted().triangles,
            {
                let mut t = expected.triangles;
                t.sort_unstable();
                t
            },
            "{}",
            scene.name
        );
        assert_eq!(open.sorted().sides, expected.sides, "{}", scene.name);
    }
}

#[test]
fn rings_around_holes_are_islands() {
    let scene = Scene::new(Graph::Star, 20);
    let text = scene.written(Format::Adcirc, false);
    let outer: Vec<Boundary> = adcirc(&text).2;
    assert!(outer.iter().all(|boundary| !boundary.0 && boundary.1 == 0));
    // A square with a square hole.
    let points =
        [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [3.0, 3.0], [6.0, 3.0], [6.0, 6.0], [3.0, 6.0]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    let c = delone::Constrained2::from_parts(&points, &segments).expect("a ring");
    let inside = c.domains(&delone::Fill::EvenOdd).expect("borders");
    let trim = delone_io::Trim::keeping(&c, |t| inside.is_inside(t));
    let edges: Vec<_> = c.constraints().collect();
    let constraints = Constraints { edges: &edges, ..Constraints::default() };
    let mesh = Mesh { trim: Some(&trim), constraints: Some(&constraints), ..Mesh::new(&c, &points) };
    let mut bytes = Vec::new();
    let remark =
        write_mesh(&mut bytes, Format::Adcirc, &mesh, &picture::Options::default()).expect("written");
    assert_eq!(remark.as_deref(), Some("there are no heights: all depths are 0"));
    let boundaries = adcirc(str::from_utf8(&bytes).expect("text")).2;
    let kinds: Vec<(u8, &[usize])> =
        boundaries.iter().map(|boundary| (boundary.1, &boundary.3[..])).collect();
    assert_eq!(kinds, [(0, &[0, 1, 2, 3, 0][..]), (1, &[4, 7, 6, 5, 4][..])]);
}
