//! The parameters of strategies of location on the command line: they arrive, they change no answer, and what does not fit is refused.

use crate::place::Place;

/// The visited triangles that a command wrote to `s.json`.
fn visited(place: &Place) -> u64 {
    let text = std::fs::read_to_string(place.path("s.json")).expect("statistics");
    let (_, after) = text.split_once("\"visited\": ").expect("a count");
    after.chars().take_while(char::is_ascii_digit).collect::<String>().parse().expect("a number")
}

const VARIANTS: &[&str] = &[
    "walk --walk visibility",
    "walk --walk stochastic --seed 3",
    "walk --walk straight",
    "jump-and-walk --sample 2",
    "jump-and-walk --rho 3",
    "jump-and-walk --rho 3 --with-replacement",
    "hierarchy --ratio 3",
    "hierarchy --ratio 3 --smallest-level 3",
    "hierarchy --ratio 3 --smallest-level 3 --levels 2",
    "hierarchy --ratio 3 --smallest-level 1e2 --smallest-sampled never",
    "hierarchy --ratio 3 --smallest-level 100 --rho 0.2",
    "hierarchy --ratio 3 --phase3 exact",
    "hierarchy --ratio 3 --phase3 in-circle",
    "hierarchy --ratio 3 --walk stochastic",
];

/// No two variants do the same work, but all give the same answers.
#[test]
fn parameters_change_the_work_alone() {
    let place = Place::new();
    place.succeed("generate uniform -n 2000 --seed 1 -o p.csv");
    place.succeed("generate uniform -n 300 --seed 2 -o q.csv");
    let expected = place.succeed("locate p.csv --queries q.csv -o - --to csv");
    let nearest = place.succeed("nearest p.csv --queries q.csv -o - --to csv");
    let mut counts = Vec::new();
    for variant in VARIANTS {
        let found = place.succeed(&format!(
            "locate p.csv --queries q.csv -o - --to csv --locate {variant} --stats s.json"
        ));
        assert_eq!(found, expected, "{variant}");
        counts.push(visited(&place));
        let found = place.succeed(&format!("nearest p.csv --queries q.csv -o - --to csv --locate {variant}"));
        assert_eq!(found, nearest, "{variant}");
    }
    let mut distinct = counts.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(distinct.len(), counts.len(), "{counts:?}");
}

#[test]
fn constructions_and_changes_take_them_too() {
    let place = Place::new();
    place.succeed("generate uniform -n 3000 --seed 1 -o p.npy");
    place.succeed("triangulate p.npy -o expected.npy");
    let mut counts = Vec::new();
    for variant in ["hierarchy", "hierarchy --ratio 5 --phase3 exact", "walk --walk straight"] {
        place.succeed(&format!(
            "triangulate p.npy -o t.npy --algorithm incremental --locate {variant} --check --stats s.json"
        ));
        counts.push(visited(&place));
    }
    assert!(counts[0] != counts[1] && counts[2] > 2 * counts[0], "{counts:?}");
    place.succeed("generate ball -n 500 -o b.csv");
    let line =
        "locate b.csv --dim 3 --queries b.csv -o - --to csv --locate hierarchy --ratio 4 --walk visibility";
    assert_eq!(place.succeed(line).lines().count(), 501);
}

#[test]
fn what_a_strategy_does_not_have_is_named() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n1,1\n0.4,0.2\n");
    place.file("b.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
    for (line, message) in [
        ("--locate tree --ratio 3", "--ratio is no parameter of --locate tree"),
        ("--ratio 3", "--ratio is no parameter of --locate tree"),
        ("--locate walk --levels 3", "--levels"),
        ("--locate jump-and-walk --smallest-level 3", "--smallest-level"),
        ("--locate jump-and-walk --smallest-sampled 3", "--smallest-sampled"),
        ("--locate history --rho 3", "--rho"),
        ("--locate hierarchy --sample 3", "--sample"),
        ("--locate walk --with-replacement", "--with-replacement"),
        ("--locate jump-and-walk --phase3 exact", "--phase3"),
        ("--locate jump-and-walk --walk straight", "--walk"),
        ("--locate hierarchy --ratio 1", "--ratio is 1; it must be at least 1.25"),
        ("--locate hierarchy --ratio -3", "--ratio is -3"),
        ("--locate hierarchy --ratio nan", "--ratio is NaN"),
        ("--locate hierarchy --ratio wide", "--ratio"),
        ("--locate hierarchy --levels 0", "--levels is 0"),
        ("--locate hierarchy --levels -1", "-1"),
        ("--locate hierarchy --smallest-sampled seldom", "--smallest-sampled"),
        ("--locate hierarchy --rho 0", "--rho is 0"),
        ("--locate jump-and-walk --rho inf", "--rho is inf"),
        ("--locate jump-and-walk --sample 0", "--sample is 0"),
        ("--locate jump-and-walk --sample 3 --rho 1", "--rho"),
        ("--locate hierarchy --phase3 fuzzy", "--phase3"),
        ("--locate walk --walk random", "--walk"),
    ] {
        place.fail(&format!("locate p.csv --queries p.csv -o t.csv {line}"), 2, message);
        place.fail(&format!("nearest p.csv --queries p.csv -o t.csv {line}"), 2, message);
        if line.starts_with("--locate") {
            let incremental = format!("triangulate p.csv -o t.ply --algorithm incremental {line}");
            place.fail(&incremental, 2, message);
        }
    }
    for (line, message) in [
        ("triangulate p.csv -o t.ply --ratio 3", "--ratio is no parameter of divide and conquer"),
        ("triangulate p.csv -o t.ply --algorithm incremental --ratio 3", "of --locate spatial"),
        (
            "triangulate p.csv -o t.ply --algorithm incremental --locate conflict --rho 3",
            "of --locate conflict",
        ),
        ("triangulate p.csv -o t.ply --hints p.csv --walk straight", "--walk is no parameter of --hints"),
        ("triangulate p.csv -o t.ply --hint-order random", "--hint-order is for --hints"),
        ("triangulate p.csv -o t.ply --hints p.csv --hint-order wild", "--hint-order"),
        (
            "triangulate b.csv -o t.ply --dim 3 --locate hierarchy --walk straight",
            "--walk straight is for the plane",
        ),
        (
            "locate b.csv --dim 3 --queries b.csv -o t.csv --locate walk --walk stochastic",
            "--walk stochastic is for",
        ),
        (
            "locate b.csv --dim 3 --queries b.csv -o t.csv --locate hierarchy --phase3 in-circle",
            "--phase3 in-circle",
        ),
        ("locate b.csv --dim 3 --queries b.csv -o t.csv --locate history", "for the plane"),
    ] {
        place.fail(line, 2, message);
    }
}

/// The order is a choice, and what was counted stands where other commands have it.
#[test]
fn hints_in_either_order() {
    let place = Place::new();
    place.succeed("generate uniform -n 1000 --seed 1 -o p.npy");
    place.succeed("generate uniform -n 1000 --seed 1 -o c.npy");
    let count = |order: &str| {
        place.succeed(&format!("triangulate p.npy --hints c.npy {order} -o t.npy --check --stats s.json"));
        visited(&place)
    };
    let [default, spatial, random] = ["", "--hint-order spatial", "--hint-order random"].map(count);
    assert!(default == spatial && random != spatial && random > 1000, "{default} {spatial} {random}");
}
