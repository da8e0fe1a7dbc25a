//! Headers, separators, quotes, geometries.

use super::read;
use crate::{Cloud, ReadOptions};
use std::io::Cursor;

fn parse(text: &'static str, columns: &[&str]) -> Result<Cloud, String> {
    let columns: Vec<_> = columns.iter().map(ToString::to_string).collect();
    let options = ReadOptions { columns, ..ReadOptions::default() };
    read(Box::new(Cursor::new(text)), &options).map_err(|error| error.to_string())
}

#[test]
fn separators_and_headers() {
    let plain = Cloud { xy: vec![[1.0, 2.0], [3.5, -4.0]], ..Cloud::default() };
    for text in [
        "1,2\n3.5,-4",
        "1 2\n3.5   -4\n\n",
        "x;y\n1;2\n3.5;-4\n",
        "# made by hand\n1\t2\n3.5\t-4",
        "lat,lon\n2,1\n-4,3.5",
        "1,2\r3.5,-4\r",
        "\u{feff}x,y\r\n\"1\",\"2\"\r\n3.5,-4\r\n",
        "name;x;y\n\"a; b\";1;2\nc;3,5;-4,0",
        "1|2\n3.5|-4",
        "id,geom\n1,POINT (1 2)\n2,\"MULTIPOINT (3.5 -4)\"",
        "POINT (1 2)\nPOINT (3.5 -4)",
        "x,y,2020\n1,2,0\n3.5,-4,0\n,,\n",
        "1,2 # the first\n3.5,-4",
        "sep=;\n1;2\n3,5;-4",
        "# lat lon\n2 1\n-4 3.5",
        "#lat,lon\n2,1\n-4,3.5",
        "#,x,y\n7,1,2\n8,3.5,-4",
        "2\n1 2\n3.5 -4\n\u{1a}",
        "//X Y\n2\n1 2\n3.5 -4",
        "\"x\" \"y\"\n\"1\" 1 2\n\"2\" 3.5 -4",
        "\tx\ty\tz\n0\t1\t2\t7\n1\t3.5\t-4\t7",
        "color,x,y\n\"#ff0000\",1,2\n# 2,7,8\nred,3.5,-4",
        "1,2,\n3.5,-4,",
        "x,y\n1,2,\n3.5,-4,",
        "# lat lon (WGS84)\n# made by me\n2 1\n-4 3.5",
        "# columns: lat lon\n2 1\n-4 3.5",
        "geometry\nPOINT (1 2)\nMULTIPOINT (3.5 -4)",
        "wkt\nSRID=4326;MULTIPOINT (1 2,3.5 -4)",
        "MULTIPOINT (1 2, 3.5 -4)",
        "\"n\" \"x\" \"y\"\n\"a\"\"b\" 1 2\n\"c\" 3.5 -4",
        "n,x,y\n5\" pipe,1,2\n\"a\n\nb\",3.5,-4",
    ] {
        let cloud = parse(text, &[]).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        let heights = text.contains('z').then(|| vec![7.0, 7.0]);
        assert_eq!((&cloud.xy, &cloud.z), (&plain.xy, &heights), "{text:?}");
    }
    let high = parse("id,x,y,z\n7,1,2,3", &[]).expect("valid");
    assert_eq!((high.xy, high.z), (vec![[1.0, 2.0]], Some(vec![3.0])));
    assert_eq!(parse("a b c\n1 2 3", &["c", "1"]).expect("valid").xy, [[3.0, 1.0]]);
    assert_eq!(parse("", &[]), Ok(Cloud::default()));
    assert!(parse("nan,1", &[]).expect("the library judges").xy[0][0].is_nan());
}

#[test]
fn errors_name_the_line() {
    for (text, message) in [
        ("1,2\n3", "line 2: 1 fields where the first line has 2"),
        ("1,2\n\n# comment\n3,x", "line 4: field 2 is \"x\", not a number"),
        ("1,2\n3,", "line 2: field 2 is \"\", not a number"),
        ("1\n2", "line 2: a point needs two numbers, x and y"),
        ("3\n1 2\n3 4\n", "the file ends after 2 of 3 points"),
        (
            "x,y,n\n1,2,\"5\" pipe\"\n3,4,\"6\" pipe\"",
            "line 2: a quotation mark inside of quotes is not doubled",
        ),
        ("x,y,z\n1,2,3,4", "line 2: 4 fields where the first line has 3"),
        ("x,y\n\"1,000\",2", "line 2: field 1 is \"1,000\", not a number"),
        (
            "color,wkt\n#ff0000,POINT (1 2)",
            "line 2: it may be a remark or a row: put its first field in quotes, or a blank after its sign",
        ),
        (
            "name x y\n#1 1 2",
            "line 2: it may be a remark or a row: put its first field in quotes, or a blank after its sign",
        ),
        ("wkt\nPOINT (1 2)\nPOINT Z (1 2 3)", "line 3: a position with height after some without"),
        ("1\n", "line 1: a point needs two numbers, x and y"),
        ("NA,NA\n1,2", "line 1: field 1 is \"NA\", not a number"),
        ("0.1D+01,0.2D+01\n1,2", "line 1: field 1 is \"0.1D+01\", not a number"),
        ("50N,7E\n1,2", "line 1: field 1 is \"50N\", not a number"),
        ("x,y\n1.#INF,2", "line 2: field 1 is \"1.#INF\", not a number"),
        (
            "1,5000,1000,100.5,TP",
            "line 1: without names it cannot be told which of 5 columns are x and y, one of which is \"TP\"",
        ),
        ("Breite,Wert\n1,2", "line 1: none of the columns Breite, Wert is called x or y"),
        ("x,y,n\n1,2,\"a\n3,4,b\n", "line 2: a quotation mark is not closed"),
        (
            "id,x,y\n1,2,3\n#2,7,8",
            "line 3: it may be a remark or a row: put its first field in quotes, or a blank after its sign",
        ),
        ("x;wkt\n1;POINT 1 2", "line 2: \"POINT 1 2\" is no geometry such as POINT (1 2)"),
        ("N/A,1\n2,3", "line 1: field 1 is \"N/A\", not a number"),
        ("id,foo,bar\n1,2,3", "line 1: none of the columns id, foo, bar is called x or y"),
        ("1.5;1,234.5", "line 1: field 2 is \"1,234.5\", not a number"),
        ("id,wkt\n1,POINT (1)", "line 2: \"POINT (1)\" is no geometry such as POINT (1 2)"),
        ("1,2\0", "line 1: it is not text"),
    ] {
        assert_eq!(parse(text, &[]), Err(message.to_owned()), "{text:?}");
    }
    assert_eq!(
        parse("1,2", &["3", "1"]),
        Err("line 1: there is no column \"3\" among 2 without names".to_owned())
    );
}

#[test]
fn rows_without_coordinates_are_left_out_where_that_is_asked_for() {
    let text = "name,x,y\na,1,2\nb,,5\nc,NA,6\nd,7,n/a\ne,3.5,-4\n";
    let failed = parse(text, &[]).expect_err("a field is empty");
    assert!(failed.contains("line 3"), "{failed}");
    let options = ReadOptions::default().skip_missing(true).attributes(true);
    let cloud = read(Box::new(Cursor::new(text)), &options).expect("the others are whole");
    assert_eq!(cloud.xy, [[1.0, 2.0], [3.5, -4.0]]);
    assert!(
        cloud.remarks.iter().any(|told| told == "3 rows without coordinates left out: lines 3, 4, 5"),
        "{:?}",
        cloud.remarks
    );
    // What is no number and not missing is a fault still, and so is a row that is too short.
    for text in ["x,y\n1,2\n3,zwei\n", "x,y\n1,2\n3\n"] {
        assert!(read(Box::new(Cursor::new(text)), &options).is_err());
    }
    let heights = read(Box::new(Cursor::new("x,y,z\n1,2,3\n4,5,null\n")), &options.columns(["x", "y", "z"]));
    assert_eq!(heights.expect("one row").z, Some(vec![3.0]));
}
