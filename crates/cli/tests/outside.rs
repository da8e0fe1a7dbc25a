//! `delone interpolate --outside`: what there is beyond the hull.

use crate::place::{Place, answers};

/// Values at places, by what there is beyond the hull.
fn values(place: &Place, command: &str, outside: &str) -> Vec<f64> {
    let text = place.succeed(&format!("-q interpolate {command} --outside {outside} -o - --to csv"));
    answers(&text, 1).concat()
}

#[test]
fn beyond_the_hull_there_is_what_was_asked_for() {
    let place = Place::new();
    // A linear function, whose values beyond are known: x + 2 y at the nearest place.
    place.file("p.csv", "x,y,a\n0,0,0\n4,0,4\n4,4,12\n0,4,8\n");
    place.file("q.csv", "x,y\n1,1\n1,-3\n6,3\n9,9\n4,2\n");
    for method in ["linear", "natural", "laplace", "smooth", "farin"] {
        let command = format!("p.csv --value a --queries q.csv --method {method}");
        assert_eq!(values(&place, &command, "hull"), [3.0, 1.0, 10.0, 12.0, 8.0], "{method}");
        assert_eq!(values(&place, &command, "nearest")[1..4], [0.0, 12.0, 12.0], "{method}");
        let nothing = values(&place, &command, "nothing");
        assert_eq!((nothing[0], nothing[4]), (3.0, 8.0), "{method}");
        assert!(nothing[1..4].iter().all(|value| value.is_nan()), "{method}");
    }
    place.file("s.csv", "x,y,z,a\n0,0,0,0\n4,0,0,4\n0,4,0,8\n0,0,4,12\n");
    place.file("t.csv", "x,y,z\n1,1,-5\n-1,-1,2\n");
    let command = "s.csv --dim 3 --value a --queries t.csv --method linear";
    assert_eq!(values(&place, command, "hull"), [3.0, 6.0]);
    place.fail(
        "-q interpolate p.csv --value a --queries q.csv -o v.npy --outside far",
        2,
        "nothing, nearest, hull",
    );
}
