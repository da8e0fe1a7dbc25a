//! Names of regions and boundaries: of options, files and features, into files that have room for them.

use crate::place::{Place, text};

/// Two plates side by side; the left border is the inlet, the right one has a marker without a name.
const PLATES: &str = "6 2 0 0\n1 0 0\n2 1 0\n3 2 0\n4 2 1\n5 1 1\n6 0 1\n7 1\n1 1 2 0\n2 2 3 0\n3 3 4 3\n4 4 5 0\n5 5 6 0\n6 6 1 2\n7 2 5 9\n\
    0\n2\n1 0.5 0.5 1 -1\n2 1.5 0.5 2 -1\n# boundary 2 in let\n#region 1 steel # 4\n# boundary of the lake\n# region x y\n";

/// The physical names of a file of Gmsh: dimension, number and name.
fn physical(text: &str) -> Vec<&str> {
    let (_, rest) = text.split_once("$PhysicalNames\n").expect("names");
    rest.split_once("$EndPhysicalNames").expect("their end").0.lines().skip(1).collect()
}

#[test]
fn files_and_options_name() {
    let place = Place::new();
    place.file("two.poly", PLATES);
    let outputs = "-o m.msh -o m.inp -o m.poly -o m.ply -o m.png";
    let told = text(
        &place
            .run(&format!("mesh two.poly --boundary 3=outlet --boundary 7=x --region 5=y {outputs}"))
            .stderr,
    );
    for line in [
        "no boundary has the marker 7 of \"x\": there are 1, 2, 3, 9",
        "no region has the number 5 of \"y\": there are 1, 2",
        "m.inp: names that it does not permit are changed: \"in let\" is in_let, \"steel # 4\" is steel___4",
        "m.ply: names of regions and boundaries are left out",
    ] {
        assert!(told.contains(line), "{told}");
    }
    assert!(!told.contains("m.png"), "{told}");
    let named = [
        "1 1 \"marker_1\"",
        "1 2 \"in let\"",
        "1 3 \"outlet\"",
        "1 9 \"marker_9\"",
        "2 1 \"steel # 4\"",
        "2 2 \"region_2\"",
    ];
    assert_eq!(physical(&place.read("m.msh")), named);
    let inp = place.read("m.inp");
    for keyword in ["ELSET=steel___4", "NSET=in_let", "TYPE=ELEMENT, NAME=in_let", "NSET=outlet"] {
        assert!(inp.contains(keyword), "{inp}");
    }
    // And once more, from what was written.
    for input in ["m.poly", "m.msh --refine m.msh"] {
        place.succeed(&format!("-q mesh {input} -o again.msh"));
        assert_eq!(physical(&place.read("again.msh")), named, "{input}");
    }
    // Triangulations keep them too.
    let told = text(&place.run("triangulate m.poly -o t.msh -o t.off").stderr);
    assert!(told.contains("t.off: names of regions and boundaries are left out"), "{told}");
    assert!(physical(&place.read("t.msh")).contains(&"1 2 \"in let\""));
    // Options go before files.
    place.succeed("-q mesh two.poly --boundary 2=door -o m.msh");
    assert!(physical(&place.read("m.msh")).contains(&"1 2 \"door\""));
    for (options, message) in [
        ("--boundary 3=a --boundary 2=a", "the name \"a\" is that of boundary 2 and of boundary 3"),
        ("--boundary 3=a --boundary 3=b", "boundary 3 is named \"a\" and \"b\""),
        ("--boundary inlet", "it is no number, = and a name"),
        ("--boundary 1.5=inlet", "is no number of that kind"),
        ("--region 1=", "a name has at least one letter"),
    ] {
        place.fail(&format!("mesh two.poly {options} -o m.msh"), 2, message);
    }
    place.fail("-q --strict mesh two.poly -o m.ply", 1, "names of regions and boundaries are left out");
}

#[test]
fn features_name() {
    let square = |name: &str, x: u8| {
        format!(
            "{{\"type\":\"Feature\",\"properties\":{{\"name\":{name},\"code\":{x}}},\"geometry\":{{\"type\":\"Polygon\",\
             \"coordinates\":[[[{x},0],[{},0],[{},1],[{x},1],[{x},0]]]}}}}",
            x + 1,
            x + 1
        )
    };
    let line = |name: &str, from: [u8; 2], to: [u8; 2]| {
        format!(
            "{{\"type\":\"Feature\",\"properties\":{{\"name\":\"{name}\"}},\"geometry\":{{\"type\":\"LineString\",\
             \"coordinates\":[[{},{}],[{},{}]]}}}}",
            from[0], from[1], to[0], to[1]
        )
    };
    let features = [
        square("null", 0),
        square("\"wood\"", 1),
        square("\"wood\"", 4),
        line("inflow", [0, 0], [0, 1]),
        line("wall", [4, 0], [5, 0]),
        line("inflow", [4, 1], [5, 1]),
    ];
    let file = format!("{{\"type\":\"FeatureCollection\",\"features\":[{}]}}", features.join(","));
    let place = Place::new();
    place.file("f.geojson", &file);
    place.file("two.poly", PLATES);
    let told = text(&place.run("mesh f.geojson -o f.msh").stderr);
    assert!(
        told.contains("the attributes of the input are left out: code") && !told.contains("name"),
        "{told}"
    );
    let named = [
        "1 4 \"marker_0\"",
        "1 1 \"marker_1\"",
        "1 2 \"inflow\"",
        "1 3 \"wall\"",
        "2 1 \"region_1\"",
        "2 2 \"wood\"",
    ];
    assert_eq!(physical(&place.read("f.msh")), named);
    place.succeed("-q mesh f.geojson --names code -o f.msh");
    let codes = ["1 2 \"marker_0\"", "1 1 \"marker_1\"", "2 1 \"0\"", "2 2 \"1\"", "2 3 \"4\""];
    assert_eq!(physical(&place.read("f.msh")), codes);
    place.fail("mesh f.geojson --names title -o f.msh", 2, "no feature has the attribute \"title\"");
    place.fail("mesh two.poly --names title -o f.msh", 2, "no feature has the attribute \"title\"");
}

#[test]
fn numbers_that_a_format_does_not_permit_are_told() {
    let place = Place::new();
    place.file(
        "square.poly",
        "4 2 0 0\n0 0 0\n1 3 0\n2 3 3\n3 0 3\n4 1\n0 0 1 5\n1 1 2 5\n2 2 3 -3\n3 3 0 0\n0\n",
    );
    let told = text(&place.run("mesh square.poly -o a.bdf -o a.2dm -o a.mesh -o a.su2").stderr);
    assert!(
        told.contains("note: a.bdf: numbers that it does not permit are changed: marker_-3 is 2\n"),
        "{told}"
    );
    assert_eq!(told.lines().count(), 2, "{told}");
    assert!(place.read("a.2dm").contains(" -3\n") && place.read("a.mesh").contains(" -3\n"));
    place.succeed("-q --strict mesh square.poly -o a.2dm -o a.mesh -o a.su2 -o a.msh -o a.inp");
}
