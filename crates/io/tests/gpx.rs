//! Tracks, routes and waypoints.

use std::io::Cursor;

use delone_io::{Cloud, Error, Format, Graph, ReadOptions, read_graph, read_points};

fn graph(text: &str) -> Result<Graph, Error> {
    read_graph(Box::new(Cursor::new(text.to_owned())), Format::Gpx, &ReadOptions::default(), None)
}

fn points(text: &str) -> Result<Cloud, Error> {
    read_points(Box::new(Cursor::new(text.to_owned())), Format::Gpx, &ReadOptions::default())
}

const WALK: &str = r#"<?xml version="1.0"?>
<gpx version="1.1" creator="us" xmlns="http://www.topografix.com/GPX/1/1">
<wpt lat="47.5" lon="8.25"><ele>410.5</ele><name>start</name></wpt>
<rte><rtept lat="47" lon="8"><ele>1</ele></rtept><rtept lat="48" lon="8"><ele>2</ele></rtept></rte>
<trk><name>a</name><trkseg>
<trkpt lat="47.1" lon="8.1"><ele>3</ele></trkpt><trkpt lat="47.2" lon="8.1"><ele>4</ele></trkpt>
<trkpt lat="47.2" lon="8.2"><ele> 5 </ele></trkpt></trkseg><trkseg><trkpt lat="1" lon="2"><ele>6</ele></trkpt></trkseg></trk>
</gpx>"#;

#[test]
fn tracks_are_lines() {
    let graph = graph(WALK).expect("a file");
    assert_eq!(graph.cloud.xy[..3], [[8.25, 47.5], [8.0, 47.0], [8.0, 48.0]]);
    assert_eq!(graph.cloud.z, Some(vec![410.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    assert_eq!(graph.segments, [[1, 2], [3, 4], [4, 5]]);
    assert_eq!(graph.is_border, [false; 3]);
    assert_eq!(graph.cloud.crs.and_then(|crs| crs.epsg), Some(4326));
    let cloud = points(WALK).expect("a file");
    assert_eq!((cloud.xy.len(), cloud.remarks.len()), (7, 1));
}

#[test]
fn heights_of_some_are_said_to_be_left_out() {
    let cloud = points(&WALK.replace("<ele>410.5</ele>", "")).expect("a file");
    assert!(cloud.z.is_none() && cloud.losses.iter().any(|loss| loss.contains("heights are left out")));
}

#[test]
fn errors_have_their_line() {
    for (from, to, error) in [
        ("lat=\"47\"", "lat=\"north\"", "line 4: lat of a point is not a number: \"north\""),
        (" lon=\"8.25\"", "", "line 3: lon of a point is not a number: \"\""),
        ("<ele> 5 </ele>", "<ele/>", "line 7: ele of a point is not a number: \"\""),
        ("gpx", "kml", "GPX: its root is not gpx"),
        ("</gpx>", "", "XML: the root node was opened but never closed"),
    ] {
        assert_eq!(graph(&WALK.replace(from, to)).expect_err("broken").to_string(), error);
    }
    assert!(graph("").is_err());
    assert_eq!(graph("<gpx/>").expect("an empty file"), graph("<gpx version='1.1'/>").expect("another"));
}
