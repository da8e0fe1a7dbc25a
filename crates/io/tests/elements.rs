//! The formats of finite elements: judged by small parsers of what their manuals say, against the triangulation.

use std::collections::{BTreeMap, BTreeSet};

use crate::meshes;
use crate::scene::{Scene, least_first, sorted, source, written};
use delone::{Delaunay2, Delaunay3};
use delone_generators::{Graph, Kind3};
use delone_io::{
    Contents, Drawable, Error, Format, Mesh, ReadOptions, picture, read_points, read_tetrahedra,
    read_triangles, write_mesh,
};
use delone_predicates::{Sign, orient2d};

/// A file as a solver sees it.
#[derive(Debug, Default)]
struct Seen {
    nodes: BTreeMap<usize, [f64; 3]>,
    /// By kind, name of the group, and nodes.
    elements: Vec<(String, String, Vec<usize>)>,
    /// Nodes by the name of their set.
    sets: BTreeMap<String, BTreeSet<usize>>,
    /// Elements with the numbers of their sides, by the name of their surface.
    surfaces: BTreeMap<String, Vec<(usize, usize)>>,
}

/// The words of a section.
fn section<'a>(text: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    let (_, rest) = text.split_once(&format!("${name}\n")).expect("the section begins");
    let (section, _) = rest.split_once(&format!("$End{name}\n")).expect("it ends");
    section.split_whitespace()
}

/// Parses version 4.1 of Gmsh's format, and checks what its parts say of one another.
fn gmsh(text: &str) -> Seen {
    fn next<T: std::str::FromStr>(words: &mut impl Iterator<Item = impl AsRef<str>>) -> T {
        let word = words.next().expect("a word");
        word.as_ref().parse().unwrap_or_else(|_| panic!("{} is a number", word.as_ref()))
    }
    let mut seen = Seen::default();
    assert!(section(text, "MeshFormat").eq(["4.1", "0", "8"]));
    let mut words = section(text, "PhysicalNames");
    let mut names = BTreeMap::new();
    for _ in 0..next::<usize>(&mut words) {
        let key: (usize, i32) = (next(&mut words), next(&mut words));
        let name = words.next().expect("a name");
        let name = name.strip_prefix('"').and_then(|name| name.strip_suffix('"')).expect("quotes");
        assert!(key.1 > 0 && names.insert(key, name).is_none(), "{key:?}");
    }
    assert_eq!(words.next(), None);
    assert_eq!(names.values().collect::<BTreeSet<_>>().len(), names.len(), "names differ");
    let mut words = section(text, "Entities");
    let counts: [usize; 4] = [(); 4].map(|()| next(&mut words));
    assert_eq!(counts[0], 0);
    let mut entities = BTreeMap::new();
    for dimension in 1..4 {
        for _ in 0..counts[dimension] {
            let tag: i32 = next(&mut words);
            let bounds: [f64; 6] = [(); 6].map(|()| next(&mut words));
            assert_eq!(next::<usize>(&mut words), 1);
            let name = names[&(dimension, next::<i32>(&mut words))];
            assert_eq!(next::<usize>(&mut words), 0);
            assert!(entities.insert((dimension, tag), (bounds, name)).is_none());
        }
    }
    assert_eq!((words.next(), entities.len()), (None, names.len()));
    let mut words = section(text, "Nodes");
    let [blocks, count, least, most]: [usize; 4] = [(); 4].map(|()| next(&mut words));
    for _ in 0..blocks {
        assert!(entities.contains_key(&(next(&mut words), next(&mut words))));
        assert_eq!(next::<usize>(&mut words), 0);
        let tags: Vec<usize> = (0..next(&mut words)).map(|_| next(&mut words)).collect();
        for tag in tags {
            let position = [(); 3].map(|()| next(&mut words));
            assert!(seen.nodes.insert(tag, position).is_none(), "node {tag}");
        }
    }
    assert_eq!((words.next(), seen.nodes.len()), (None, count));
    let bounds = (seen.nodes.keys().next().copied(), seen.nodes.keys().last().copied());
    assert_eq!(bounds, if count > 0 { (Some(least), Some(most)) } else { (None, None) });
    let mut words = section(text, "Elements");
    let [blocks, count, least, most]: [usize; 4] = [(); 4].map(|()| next(&mut words));
    assert_eq!((least, most), (count.min(1), count));
    let nodes_of = BTreeMap::from([(1, (1, 2)), (8, (1, 3)), (2, (2, 3)), (9, (2, 6)), (4, (3, 4))]);
    let mut tags = 1..;
    for _ in 0..blocks {
        let (dimension, entity, kind): (usize, i32, usize) =
            (next(&mut words), next(&mut words), next(&mut words));
        let (bounds, name) = entities[&(dimension, entity)];
        assert_eq!(nodes_of[&kind].0, dimension);
        let mut met = [
            f64::INFINITY,
            f64::INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        ];
        for _ in 0..next(&mut words) {
            assert_eq!(tags.next(), Some(next(&mut words)));
            let nodes: Vec<usize> = (0..nodes_of[&kind].1).map(|_| next(&mut words)).collect();
            for p in nodes.iter().map(|node| seen.nodes[node]) {
                for k in 0..3 {
                    (met[k], met[k + 3]) = (met[k].min(p[k]), met[k + 3].max(p[k]));
                }
            }
            seen.elements.push((kind.to_string(), name.to_owned(), nodes));
        }
        assert_eq!(met, bounds, "{name}");
    }
    assert_eq!((words.next(), seen.elements.len()), (None, count));
    seen
}

/// Parses an input file of Abaqus.
fn abaqus(text: &str) -> Seen {
    let mut seen = Seen::default();
    let mut keyword: Vec<&str> = Vec::new();
    let mut numbers = 1..;
    for line in text.lines() {
        assert!(line.len() < 256, "{line}");
        if let Some(words) = line.strip_prefix('*') {
            keyword = words.split(", ").collect();
            continue;
        }
        let value = |name: &str| {
            let word = keyword.iter().find_map(|word| word.strip_prefix(name)).expect("a parameter");
            assert!(word.starts_with(|c: char| c.is_ascii_alphabetic()), "{word}");
            assert!(
                word.len() <= 80 && word.chars().all(|c| c.is_ascii_alphanumeric() || "_-".contains(c)),
                "{word}"
            );
            word.to_owned()
        };
        let words: Vec<&str> = line.split(", ").collect();
        let index = |word: &&str| word.parse::<usize>().expect("an index");
        match keyword[0] {
            "HEADING" => {}
            "NODE" => {
                let number = |k: usize| words.get(k).map_or(0.0, |word| word.parse().expect("a number"));
                assert!(seen.nodes.insert(index(&words[0]), [1, 2, 3].map(number)).is_none());
            }
            "ELEMENT" => {
                assert_eq!(numbers.next(), Some(index(&words[0])));
                let nodes = words[1..].iter().map(index).collect();
                seen.elements.push((value("TYPE="), value("ELSET="), nodes));
            }
            "NSET" => {
                assert!(words.len() <= 16, "{line}");
                let set = seen.sets.entry(value("NSET=")).or_default();
                assert!(words.iter().map(index).all(|node| set.insert(node)));
            }
            "SURFACE" => {
                assert_eq!(keyword[1], "TYPE=ELEMENT");
                let side = words[1].strip_prefix('S').expect("a side").parse().expect("its number");
                seen.surfaces.entry(value("NAME=")).or_default().push((index(&words[0]), side));
            }
            other => panic!("{other} is no keyword"),
        }
    }
    seen
}

fn region_name(region: f64) -> String {
    format!("region_{}", if region == 2.5 { "2p5".to_owned() } else { region.to_string() })
}

/// The triangles of a file are those that stay, in their regions, counter-clockwise; each middle is that of its edge.
fn judge_triangles(scene: &Scene, seen: &Seen, kind: &str, second_order: bool) {
    let name = &scene.name;
    let mut triangles = Vec::new();
    let mut middles: BTreeMap<usize, [usize; 2]> = BTreeMap::new();
    for (_, group, nodes) in seen.elements.iter().filter(|element| element.0 == kind) {
        let [a, b, c] = [nodes[0] - 1, nodes[1] - 1, nodes[2] - 1];
        let corners = [a, b, c].map(|i| scene.points[i]);
        assert_eq!(orient2d(corners[0], corners[1], corners[2]), Sign::Positive, "{name}");
        triangles.push((least_first([a, b, c]), group.clone()));
        assert_eq!(nodes.len(), if second_order { 6 } else { 3 });
        for (&node, ends) in nodes[3..].iter().zip([[a, b], [b, c], [c, a]]) {
            let [x, y] = scene.middle(ends);
            assert_eq!(seen.nodes[&node], [x, y, 0.0], "{name}");
            assert!(node > scene.points.len(), "{name}");
            assert_eq!(
                *middles.entry(node).or_insert(sorted(ends)),
                sorted(ends),
                "{name}: one middle an edge"
            );
        }
    }
    triangles.sort();
    let expected: Vec<_> =
        scene.triangles().into_iter().map(|(corners, region)| (corners, region_name(region))).collect();
    assert_eq!(triangles, expected, "{name}");
    let edges = scene.edge_markers().len();
    assert_eq!(middles.len(), if second_order { edges } else { 0 }, "{name}");
    // All nodes that are used, and no others.
    let used: BTreeSet<usize> = seen.elements.iter().flat_map(|element| &element.2).copied().collect();
    assert!(used.iter().eq(seen.nodes.keys()), "{name}");
    let is_point = |(&node, position): (&usize, &[f64; 3])| {
        node > scene.points.len() || position[..2] == scene.points[node - 1] && position[2] == 0.0
    };
    assert!(seen.nodes.iter().all(is_point), "{name}");
}

#[test]
fn gmsh_sees_triangles_and_sides() {
    let mut count = [0; 2];
    for scene in Scene::all() {
        for second_order in [false, true] {
            let text = scene.written(Format::Msh, second_order);
            let seen = gmsh(&text);
            let kinds = if second_order { ["8", "9"] } else { ["1", "2"] };
            judge_triangles(&scene, &seen, kinds[1], second_order);
            let mut sides = Vec::new();
            for (_, group, nodes) in seen.elements.iter().filter(|element| element.0 == kinds[0]) {
                let ends = [nodes[0] - 1, nodes[1] - 1];
                sides.push((sorted(ends), group.clone()));
                let middle = nodes.get(2).map(|node| seen.nodes[node]);
                let [x, y] = scene.middle(ends);
                assert_eq!(middle, second_order.then_some([x, y, 0.0]), "{}", scene.name);
            }
            sides.sort();
            let asked = scene.edge_markers().into_iter().filter(|edge| edge.1.1);
            let asked: Vec<_> = asked.map(|(ends, (marker, _))| (ends, format!("marker_{marker}"))).collect();
            assert_eq!(sides, asked, "{}", scene.name);
            count[0] += sides.len();
            count[1] += seen.elements.len() - sides.len();
            // And our reader sees what the other one sees: points by number, triangles by their places.
            let cloud =
                read_points(source(text.as_bytes()), Format::Msh, &ReadOptions::default()).expect("points");
            let z = cloud.z.expect("heights");
            let read = cloud.xy.iter().zip(&z).map(|(&[x, y], &z)| [x, y, z]);
            assert!(read.eq(seen.nodes.values().copied()), "{}", scene.name);
            let triangles = read_triangles(source(text.as_bytes()), Format::Msh).expect("triangles");
            let tags: Vec<usize> = seen.nodes.keys().copied().collect();
            let triangles = triangles.iter().map(|corners| corners.map(|i| tags[i as usize]));
            let given = seen.elements.iter().filter(|element| element.0 == kinds[1]);
            assert!(
                triangles.eq(given.map(|(_, _, nodes)| [nodes[0], nodes[1], nodes[2]])),
                "{}",
                scene.name
            );
        }
    }
    assert!(count.iter().all(|&count| count > 500), "{count:?}");
}

#[test]
fn markers_and_regions_are_tags() {
    let scene = Scene::new(Graph::Star, 60);
    let text = scene.written(Format::Msh, false);
    let names: BTreeSet<&str> = text.lines().filter(|line| line.ends_with('"')).collect();
    let expected = [
        "1 1 \"marker_1\"",
        "1 2 \"marker_2\"",
        "1 3 \"marker_-8\"",
        "1 4 \"marker_1099511627776\"",
        "1 7 \"marker_7\"",
        "2 1 \"region_1\"",
        "2 2 \"region_-4\"",
        "2 3 \"region_3\"",
        "2 4 \"region_0\"",
        "2 5 \"region_2p5\"",
    ];
    assert_eq!(names, expected.into());
    // Without regions, markers and constraints: one of each.
    let mesh = Mesh::new(&scene.triangulation, &scene.points);
    let seen = gmsh(&String::from_utf8(written(Format::Msh, &mesh)).expect("text"));
    let groups: BTreeSet<&str> = seen.elements.iter().map(|element| &element.1[..]).collect();
    assert_eq!(groups, ["marker_1", "region_0"].into());
}

#[test]
fn abaqus_sees_triangles_and_sets() {
    for scene in Scene::all() {
        for second_order in [false, true] {
            let seen = abaqus(&scene.written(Format::Inp, second_order));
            judge_triangles(&scene, &seen, if second_order { "CPE6" } else { "CPS3" }, second_order);
            let mut sets: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
            let mut surfaces: BTreeMap<String, Vec<[usize; 2]>> = BTreeMap::new();
            let middles: BTreeMap<[usize; 2], usize> = seen
                .elements
                .iter()
                .filter(|_| second_order)
                .flat_map(|(_, _, n)| {
                    [[0, 1, 3], [1, 2, 4], [2, 0, 5]].map(|[i, j, k]| (sorted([n[i], n[j]]), n[k]))
                })
                .collect();
            for (ends, (marker, is_side)) in scene.edge_markers() {
                let ends = ends.map(|i| i + 1);
                if is_side {
                    let set = sets.entry(format!("marker_{marker}")).or_default();
                    set.extend(ends.iter().chain(middles.get(&ends)));
                    surfaces.entry(format!("marker_{marker}")).or_default().push(ends);
                }
            }
            assert_eq!(seen.sets, sets, "{}", scene.name);
            let ends = |&(element, side): &(usize, usize)| {
                let nodes = &seen.elements[element - 1].2;
                sorted([nodes[side - 1], nodes[side % 3]])
            };
            let mut met: BTreeMap<String, Vec<[usize; 2]>> = BTreeMap::new();
            for (name, sides) in &seen.surfaces {
                met.insert(name.clone(), sides.iter().map(ends).collect());
            }
            met.values_mut().chain(surfaces.values_mut()).for_each(|sides| sides.sort_unstable());
            assert_eq!(met, surfaces, "{}", scene.name);
        }
    }
    // With heights they are shells.
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let d = Delaunay2::from_points(&points).expect("finite");
    for (second_order, kind) in [(false, "S3"), (true, "STRI65")] {
        let mesh = Mesh { heights: Some(&[1.0, 2.0, 4.0]), second_order, ..Mesh::new(&d, &points) };
        let seen = abaqus(&String::from_utf8(written(Format::Inp, &mesh)).expect("text"));
        assert_eq!((&seen.elements[0].0[..], seen.surfaces.len()), (kind, 0));
        let heights: Vec<f64> = seen.nodes.values().map(|p| p[2]).collect();
        assert_eq!(heights, [1.0, 2.0, 4.0, 1.5, 2.5, 3.0][..if second_order { 6 } else { 3 }]);
    }
}

#[test]
fn tetrahedra_have_a_border() {
    let points = Kind3::Ball.points(60, 3);
    let d = Delaunay3::from_points(&points).expect("finite");
    let mesh = Mesh::new(&d, &points);
    let text = String::from_utf8(written(Format::Msh, &mesh)).expect("text");
    let seen = gmsh(&text);
    let of = |kind: &str| {
        seen.elements.iter().filter(|element| element.0 == kind).map(|e| &e.2).collect::<Vec<_>>()
    };
    let (triangles, cells) = (of("2"), of("4"));
    assert_eq!((triangles.len(), cells.len()), (d.hull_facets().count(), d.tetrahedron_count()));
    let six_volumes = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let at = |node: usize| seen.nodes[&node];
    let from = |p: [f64; 3], o: [f64; 3]| [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
    let volumes: Vec<f64> = cells
        .iter()
        .map(|n| six_volumes(from(at(n[1]), at(n[0])), from(at(n[2]), at(n[0])), from(at(n[3]), at(n[0]))))
        .collect();
    assert!(volumes.iter().all(|&volume| volume > 0.0));
    // By the divergence theorem, for a border that looks outwards.
    let volume: f64 = volumes.iter().sum();
    let border: f64 = triangles.iter().map(|n| six_volumes(at(n[0]), at(n[1]), at(n[2]))).sum();
    assert!((border - volume).abs() < 1e-9 * volume, "{border}, {volume}");
    let read = read_tetrahedra(source(text.as_bytes()), Format::Msh).expect("tetrahedra");
    assert!(read.iter().map(|n| n.map(|i| i as usize + 1).to_vec()).eq(cells.into_iter().cloned()));
    let inp = abaqus(&String::from_utf8(written(Format::Inp, &mesh)).expect("text"));
    assert!(inp.elements.iter().all(|element| element.0 == "C3D4") && inp.elements.len() == read.len());
    assert_eq!(inp.nodes, seen.nodes);
    // The manual's sides of a tetrahedron: nodes 1 2 3, 1 4 2, 2 4 3 and 3 4 1.
    let sides = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
    let least = |mut nodes: Vec<usize>| {
        nodes.sort_unstable();
        nodes
    };
    let facet = |&(element, side): &(usize, usize)| {
        let nodes: &Vec<usize> = &inp.elements[element - 1].2;
        least(sides[side - 1].map(|i: usize| nodes[i]).to_vec())
    };
    let mut surface: Vec<Vec<usize>> = inp.surfaces["marker_1"].iter().map(facet).collect();
    let mut border: Vec<Vec<usize>> = triangles.iter().map(|nodes| least((*nodes).clone())).collect();
    surface.sort_unstable();
    border.sort_unstable();
    assert_eq!(surface, border);
}

#[test]
fn second_order_is_refused_before_anything_is_written() {
    let scene = Scene::new(Graph::Star, 20);
    let constraints = scene.constraints();
    let mesh = scene.mesh(&constraints, true);
    let mut refused = 0;
    for format in meshes(Contents::Triangles) {
        let mut bytes = Vec::new();
        let outcome = write_mesh(&mut bytes, format, &mesh, &picture::Options::default());
        let holds = <[f64; 2]>::check_second_order(format).is_ok();
        match outcome {
            Ok(_) => assert!(holds && !bytes.is_empty(), "{format}"),
            Err(Error::Unsupported { format: named, contents: Contents::SecondOrder, .. }) => {
                assert!(!holds && named == format && bytes.is_empty(), "{format}");
                refused += 1;
            }
            Err(other) => panic!("{format}: {other}"),
        }
    }
    assert_eq!(refused, 13 + usize::from(cfg!(feature = "geopackage")));
    assert!(matches!(
        <[f64; 2]>::check_second_order(Format::Las),
        Err(Error::Unsupported { format: Format::Las, .. })
    ));
    let points = Kind3::Ball.points(10, 3);
    let d = Delaunay3::from_points(&points).expect("finite");
    for format in meshes(Contents::Tetrahedra) {
        let mesh = Mesh { second_order: true, ..Mesh::new(&d, &points) };
        let mut bytes = Vec::new();
        let outcome = write_mesh(&mut bytes, format, &mesh, &picture::Options::default());
        assert!(
            matches!(outcome, Err(Error::Unsupported { format: named, contents: Contents::SecondOrder, .. }) if named == format)
                && bytes.is_empty()
        );
    }
}

/// A square of two triangles in version 2.2, with what Gmsh puts around it.
const OLD: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"the # plate\"\n$EndPhysicalNames\n$Nodes\n4\n\
    10 0 0 0\n20 1 0 0.5\n30 1 1 0\n25 0 1 0\n$EndNodes\n$Elements\n5\n1 15 2 0 1 10\n2 1 2 0 1 10 20\n3 2 2 5 1 10 20 30\n\
    4 2 0 10 30 25\n5 4 2 0 1 10 20 30 25\n$EndElements\n";

#[test]
fn files_of_gmsh_are_read() {
    let read = |text: &str| read_triangles(source(text.as_bytes()), Format::Msh);
    let points = |text: &str| read_points(source(text.as_bytes()), Format::Msh, &ReadOptions::default());
    let cloud = points(OLD).expect("points");
    // By number: the last is the third.
    assert_eq!(cloud.xy, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    assert_eq!(cloud.z, Some(vec![0.0, 0.5, 0.0, 0.0]));
    assert_eq!(read(OLD).expect("triangles"), [[0, 1, 3], [0, 3, 2]]);
    assert_eq!(read_tetrahedra(source(OLD.as_bytes()), Format::Msh).expect("one"), [[0, 1, 3, 2]]);
    let new = "$MeshFormat\r\n4.1 0 8\r\n$EndMeshFormat\r\n$Nodes\r\n2 3 1 3\r\n0 1 0 1\r\n2\r\n1 0 0\r\n2 1 1 2\r\n1\r\n3\r\n0 0 0 0.5 0.5\r\n\
        0 1 0 1 1\r\n$EndNodes\r\n$Elements\r\n1 1 7 7\r\n2 1 9 1\r\n7 1 2 3 3 2 1\r\n$EndElements\r\n$NodeData\r\nanything\r\n$EndNodeData\r\n";
    assert_eq!(points(new).expect("points").xy, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(read(new).expect("triangles"), [[0, 1, 2]]);
    let start = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    let changed = |from: &str, to: &str| OLD.replacen(from, to, 1);
    for (text, message) in [
        (String::new(), "does not begin with $MeshFormat"),
        ("$NOD\n1\n1 0 0 0\n$ENDNOD\n".to_owned(), "does not begin with $MeshFormat"),
        ("hello\n".to_owned(), "line 1: \"hello\" where a section begins"),
        (changed("2.2 0 8", "2.2 1 8"), "line 2: a binary file: save it as text"),
        (changed("2.2 0 8", "4 0 8"), "line 2: version \"4\" is not read: save it as 4.1 or as 2.2"),
        (changed("2.2 0 8", "2.2"), "line 2: the type of the file is missing"),
        (changed("$Nodes\n4", "$Nodes\nfour"), "line 9: the number of nodes is \"four\""),
        (changed("$Nodes\n4", "$Nodes\n5"), "line 14: the number of the node is \"$EndNodes\""),
        (changed("$Nodes\n4", "$Nodes\n3"), "line 13: \"25 0 1 0\" where $Nodes ends"),
        (changed("20 1 0 0.5", "20 1 0"), "line 11: z is missing"),
        (changed("20 1 0 0.5", "30 1 0 0.5"), "node 30 is there twice"),
        (changed("5 1 10 20 30", "5 1 10 21 30"), "line 19: there is no node 21"),
        (changed("5 1 10 20 30", "5 1 10 20"), "line 19: a corner is missing"),
        (changed("4 2 0 10 30 25", "5 5 0 10 20 30 25"), "line 20: elements of kind 5 are no triangles"),
        (changed("$Elements\n5", "$Elements\n6"), "line 22: the kind of the element is missing"),
        (OLD[..OLD.len() - 35].to_owned(), "the file ends after 4 of 5 elements"),
        (
            format!("{start}$Nodes\n1 9999999999999999 1 2\n2 1 0 1\n1\n"),
            "ends after 0 of 9999999999999999 nodes",
        ),
        (format!("{start}$Nodes\n1 1 1 1\n2 1 0 2\n"), "line 6: 2 nodes after 0 of 1"),
        (format!("{start}$Nodes\n1 2 1 1\n2 1 0 1\n1\n0 0 0\n$EndNodes\n"), "1 nodes in all blocks, not 2"),
        (format!("{start}$Elements\n0 0 0 0\n$EndElements\n"), "$Elements is before $Nodes"),
        (format!("{start}$Nodes\n0 0 0 0\n$EndNodes\n"), "it has no $Elements"),
        (
            format!("{start}$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 2 2\n"),
            "line 9: 2 elements after 0 of 1",
        ),
        (
            format!("{start}$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n0 1 1 1\n"),
            "0 elements in all blocks, not 1",
        ),
        (format!("{start}$Other\n"), "the file ends in $Other"),
        (start.to_owned(), "it has no $Nodes"),
    ] {
        let error = read(&text).expect_err(message).to_string();
        assert!(error.contains(message), "{error}, not {message}");
    }
}

#[test]
fn points_on_a_line_are_no_elements() {
    let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
    let d = Delaunay2::from_points(&points).expect("finite");
    for second_order in [false, true] {
        let mesh = Mesh { second_order, ..Mesh::new(&d, &points) };
        let text = |format: Format| String::from_utf8(written(format, &mesh)).expect("text");
        let seen = [gmsh(&text(Format::Msh)), abaqus(&text(Format::Inp))];
        assert!(
            seen.iter().all(|seen| seen.elements.is_empty() && seen.nodes.is_empty() && seen.sets.is_empty())
        );
        assert!(text(Format::Node).starts_with("3 2 0 0\n") && text(Format::Ele).starts_with("0 "));
    }
}
