//! `replay`: operations in the plane and in space.

use crate::place::Place;

#[test]
fn operations_are_replayed() {
    let place = Place::new();
    let operations =
        "# a square\n+ 0 0\n+ 4 0\n+ 0 4\n+ 4 4\n? 1 1\n+ 4 0\n> 3 5 5\n@ 9 9\n? 9 0\n? 2 0\n- 0\n? 0 0\n";
    place.file("ops.txt", operations);
    for locate in ["tree", "walk", "jump-and-walk", "hierarchy", "delaunay-tree"] {
        let answers = place.succeed(&format!("replay ops.txt -o t.npy -o t.svg --check --locate {locate}"));
        let lines: Vec<_> = answers.lines().collect();
        assert_eq!(lines[..4], ["+ 0", "+ 1", "+ 2", "+ 3"], "{locate}");
        assert!(lines[4].starts_with("? triangle 0 1"), "{locate}: {}", lines[4]);
        assert_eq!(lines[5..], ["= 1", "@ 3", "? outside 1 3", "? edge 0 1", "? outside 2 1"], "{locate}");
    }
    let told = place.run("replay ops.txt -o - --to ele --quiet");
    let lines = |bytes: &[u8]| String::from_utf8_lossy(bytes).lines().map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(lines(&told.stdout)[0], "1 3 0", "the file is alone");
    assert_eq!(lines(&told.stderr)[..4], ["+ 0", "+ 1", "+ 2", "+ 3"]);
    place.file("bad.txt", "+ 0 0\n- 0\n- 0\n");
    place.fail("replay bad.txt -o t2.npy", 1, "line 3: 0 is no vertex");
    place.file("bad.txt", "+ 0 0\n+ 1\n");
    place.fail("replay bad.txt -o t2.npy", 1, "line 2: + takes 2 values, not 1");
    place.file("bad.txt", "-\n");
    place.fail("replay bad.txt -o t2.npy", 1, "line 1: - takes 1 value, not 0");
    place.file("bad.txt", "+ 0 inf\n");
    place.fail("replay bad.txt -o t2.npy", 1, "line 1: the y coordinate inf is not finite");
    place.file("bad.txt", "insert 0 0\n");
    place.fail("replay bad.txt -o t2.npy", 1, "line 1: \"insert\" is no operation");
    place.file("bad.txt", "+ 0 0\n- 0\n");
    place.fail("replay bad.txt -o t2.npy --locate history", 1, "cannot lose vertices");
    place.fail("replay bad.txt -o t2.npy --locate spatial", 2, "building in bulk");
    place.file("bad.txt", [0xff, 0xfe, 0x00]);
    place.fail("replay bad.txt -o t2.npy", 1, "is not text");
    place.fail("replay nothing.txt -o t2.npy", 1, "nothing.txt");
}

#[test]
fn operations_in_space() {
    let place = Place::new();
    place.file(
        "ops.txt",
        "+ 0 0 0\n+ 1 0 0\n+ 0 1 0\n? .2 .2 0\n+ 0 0 1\n+ 0 0 1\n? .2 .2 .2\n? 5 5 5\n? 0.5 0 0\n@ 1 1 1\n> 3 0 0 2\n- 0\n? .2 .2 .2\n",
    );
    let said = place.succeed("replay ops.txt --dim 3 -o end.npy -o end.svg --check -q");
    let expected = "+ 0\n+ 1\n+ 2\n? facet 0 1 2\n+ 3\n= 3\n? tetrahedron 0 1 2 3\n? outside 1 2 3\n? edge 0 1\n@ 3\n? nowhere\n";
    assert_eq!(said, expected);
    place.file("bad.txt", "+ 0 0\n");
    place.fail("replay bad.txt --dim 3 -o x.npy", 1, "line 1: + takes 3 values, not 2");
}

#[test]
fn strategies_take_their_parameters() {
    let place = Place::new();
    place.file("ops.txt", "+ 0 0\n+ 4 0\n+ 0 4\n? 1 1\n+ 1 1\n- 0\n@ 0 0\n");
    let plain = place.succeed("replay ops.txt -o t2.npy --check");
    let line = "replay ops.txt -o t3.npy --check --locate hierarchy --ratio 1.25 --smallest-level 0";
    assert_eq!(place.succeed(line), plain);
    for (line, message) in [
        ("--locate tree --ratio 3", "--ratio is no parameter of --locate tree"),
        ("--locate history --rho 3", "--rho"),
        ("--locate hierarchy --ratio 1", "--ratio is 1; it must be at least 1.25"),
        ("--locate jump-and-walk --sample 0", "--sample is 0"),
    ] {
        place.fail(&format!("replay none.txt -o t.npy {line}"), 2, message);
    }
}
