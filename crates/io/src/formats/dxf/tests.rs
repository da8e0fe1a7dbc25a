//! Drawings with entities of all kinds, blocks in blocks, and what is broken.

use std::io::Cursor;

use crate::formats::shapes::Purpose;
use crate::{Error, Graph, ReadOptions};

/// A drawing of blocks and entities, whose groups are apart by blanks: `10=1.5`.
fn drawing(blocks: &str, entities: &str) -> String {
    let groups = |text: &str| {
        text.split_whitespace()
            .map(|group| {
                let (code, value) = group.split_once('=').unwrap_or(("0", group));
                format!("{code:>3}\r\n{value}\r\n")
            })
            .collect::<String>()
    };
    groups(&format!(
        "SECTION 2=HEADER 9=$ACADVER 1=AC1015 ENDSEC SECTION 2=BLOCKS {blocks} ENDSEC SECTION 2=ENTITIES {entities} ENDSEC EOF"
    ))
}

fn read(text: String) -> Result<Graph, Error> {
    let options = ReadOptions { attributes: true, ..ReadOptions::default() };
    super::read(Box::new(Cursor::new(text)), &options, Purpose::Lines)?.graph()
}

fn layers(graph: &Graph) -> Vec<String> {
    let table = &graph.cloud.features.table;
    let row = |i: usize| {
        graph.cloud.features.row(i).map(|row| table.row(row).map(|cell| cell.1).collect::<String>())
    };
    (0..graph.cloud.xy.len()).map(|i| row(i).unwrap_or_default()).collect()
}

#[test]
fn entities_of_all_kinds() {
    let entities = "POINT 8=a 10=1 20=2 30=3 LINE 8=b 10=0 20=0 30=1 11=5 21=5 31=2 \
        LWPOLYLINE 8=c 90=3 70=1 38=7 10=0 20=0 10=4 20=0 42=0 10=0 20=4 \
        POLYLINE 8=d 66=1 70=8 10=0 20=0 30=0 VERTEX 8=d 10=1 20=1 30=9 VERTEX 8=d 10=2 20=1 30=8 SEQEND 8=d \
        POLYLINE 8=e 70=0 30=6 VERTEX 10=1 20=1 30=0 VERTEX 10=2 20=2 30=0 VERTEX 70=16 10=9 20=9 SEQEND \
        3DFACE 8=f 10=0 20=0 30=0 11=1 21=0 31=1 12=0 22=1 32=2 13=0 23=1 33=2 \
        HATCH 8=g 10=0 20=0 40=1 HATCH 10=no TEXT 1=x LINE 67=1 10=0 20=0 11=1 21=1 \
        LWPOLYLINE 10=1 20=2 210=0 220=0 230=-1 10=2 20=2 LWPOLYLINE 10=1 20=2 230=0.5 POLYLINE 70=64 VERTEX 10=1 20=1 SEQEND";
    let graph = read(drawing("", entities)).expect("a drawing");
    let z = |i: usize| graph.cloud.z.as_ref().map(|z| z[i]);
    assert_eq!(graph.cloud.z, None, "the mirrored polyline has no height");
    assert_eq!(z(0), None);
    assert_eq!(graph.cloud.xy[0], [1.0, 2.0]);
    assert_eq!(graph.cloud.xy[3..7], [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [0.0, 0.0]]);
    assert_eq!(graph.cloud.xy[11..15], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]);
    assert_eq!(graph.cloud.xy[15..], [[-1.0, 2.0], [-2.0, 2.0]]);
    assert_eq!(layers(&graph)[..4], ["\"a\"", "\"b\"", "\"b\"", "\"c\""]);
    assert_eq!((graph.segments.len(), graph.rings.len()), (1 + 3 + 1 + 1 + 3 + 1, 0));
    let losses = graph.cloud.losses.join("; ");
    let left = "2 HATCH, 1 LINE on paper, 1 LWPOLYLINE in a tilted plane, 1 POLYLINE that is a mesh, 1 TEXT";
    assert!(losses.contains(left), "{losses}");
    let high = "POINT 10=1 20=2 30=3 POLYLINE 70=0 30=6 VERTEX 10=1 20=1 VERTEX 10=2 20=2 SEQEND";
    assert_eq!(read(drawing("", high)).expect("heights").cloud.z, Some(vec![3.0, 6.0, 6.0]));
    let closed = drawing("", "LWPOLYLINE 70=1 10=0 20=0 10=4 20=0 10=0 20=4 LINE 10=0 20=0 11=1 21=1");
    let rings = super::read(Box::new(Cursor::new(closed)), &ReadOptions::default(), Purpose::Polygons)
        .expect("a ring")
        .rings()
        .rings;
    assert_eq!(rings, [vec![[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]]);
}

/// The positions of a drawing, and how far each end of its arcs is from their centers.
fn arcs(blocks: &str, entities: &str) -> (Graph, Vec<f64>) {
    let graph = read(drawing(blocks, entities)).expect("a drawing");
    let radii = graph.arcs.iter().flat_map(|&(segment, center)| {
        let ends = graph.segments[segment].map(|i| graph.cloud.xy[i]);
        ends.map(|p| (p[0] - center[0]).hypot(p[1] - center[1]))
    });
    let radii = radii.collect();
    (graph, radii)
}

#[test]
fn arcs_are_chords_with_centers() {
    // The number of chords, the center and the radius, the first and the last position, and one in between.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let cases = [
        ("CIRCLE 10=1 20=2 40=3", 32, [1.0, 2.0], 3.0, [[4.0, 2.0], [4.0, 2.0], [-2.0, 2.0]]),
        ("ARC 10=0 20=0 40=1 50=0 51=90", 8, [0.0; 2], 1.0, [[1.0, 0.0], [0.0, 1.0], [half, half]]),
        ("ARC 10=0 20=0 40=1 50=270 51=0", 8, [0.0; 2], 1.0, [[0.0, -1.0], [1.0, 0.0], [half, -half]]),
        ("ARC 10=0 20=0 40=1 50=90 51=90", 32, [0.0; 2], 1.0, [[0.0, 1.0], [0.0, 1.0], [0.0, -1.0]]),
        // Seen from below.
        (
            "ARC 10=5 20=0 40=1 50=0 51=90 230=-1",
            8,
            [-5.0, 0.0],
            1.0,
            [[-6.0, 0.0], [-5.0, 1.0], [-5.0 - half, half]],
        ),
        // Half a circle to the right of the way, and to the left; three quarters; a flat one.
        ("LWPOLYLINE 10=0 20=0 42=1 10=2 20=0", 16, [1.0, 0.0], 1.0, [[0.0; 2], [2.0, 0.0], [1.0, -1.0]]),
        ("LWPOLYLINE 10=0 20=0 42=-1 10=2 20=0", 16, [1.0, 0.0], 1.0, [[0.0; 2], [2.0, 0.0], [1.0, 1.0]]),
        (
            "LWPOLYLINE 10=1 20=0 42=2.414213562373095 10=0 20=-1",
            32,
            [0.0; 2],
            1.0,
            [[1.0, 0.0], [0.0, -1.0], [-half, half]],
        ),
        (
            "POLYLINE VERTEX 10=0 20=0 42=0.01 VERTEX 10=1 20=0 SEQEND",
            1,
            [0.5, 24.9975],
            25.0025,
            [[0.0; 2], [1.0, 0.0], [0.0; 2]],
        ),
        (
            "LWPOLYLINE 70=1 10=0 20=0 42=1 10=2 20=0 42=1",
            32,
            [1.0, 0.0],
            1.0,
            [[0.0; 2], [0.0; 2], [2.0, 0.0]],
        ),
    ];
    for (entities, count, center, radius, [first, last, middle]) in cases {
        let (graph, radii) = arcs("", entities);
        let xy = &graph.cloud.xy;
        assert_eq!(
            (graph.arcs.len(), graph.segments.len(), xy.len()),
            (count, count, count + 1),
            "{entities}"
        );
        let near = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-14 * (1.0 + radius);
        assert!(graph.arcs.iter().all(|arc| near(arc.1, center)), "{entities}: {:?}", graph.arcs);
        assert!(radii.iter().all(|r| (r - radius).abs() < 1e-14 * (1.0 + radius)), "{entities}: {radii:?}");
        assert!(
            near(xy[0], first) && near(xy[count], last) && near(xy[count / 2], middle),
            "{entities}: {xy:?}"
        );
        assert_eq!(graph.cloud.losses, [""; 0], "{entities}");
        assert!(graph.cloud.remarks[0].contains("11.25 degrees"), "{entities}");
    }
    // Those of blocks are turned and scaled; stretched, they are no arcs of circles.
    let block = "BLOCK 2=b ARC 10=1 20=0 40=1 50=0 51=90 ENDBLK";
    let (graph, radii) = arcs(block, "INSERT 2=b 10=10 20=0 41=2 42=2 50=90");
    assert_eq!(
        (graph.cloud.xy[0], graph.cloud.xy[8], graph.arcs[0].1),
        ([10.0, 4.0], [8.0, 2.0], [10.0, 2.0])
    );
    assert!(radii.iter().all(|r| (r - 2.0).abs() < 1e-14));
    let (graph, _) = arcs(block, "INSERT 2=b 10=10 20=0 41=2 42=3");
    assert!(graph.arcs.is_empty() && graph.cloud.xy.len() == 9);
    assert_eq!(graph.cloud.losses, ["arcs that blocks stretch are chords alone: 1"]);
    // A line before shifts the numbers of segments.
    let (graph, _) = arcs("", "LINE 10=9 20=9 11=8 21=8 CIRCLE 10=0 20=0 40=1 POINT 10=7 20=7");
    assert_eq!((graph.arcs[0].0, graph.arcs[31].0, graph.segments.len()), (1, 32, 33));
    let (graph, _) =
        arcs("", "CIRCLE 10=0 20=0 CIRCLE 10=0 20=0 40=-1 LWPOLYLINE 10=0 20=0 42=1e-320 10=1 20=0");
    assert!(graph.arcs.is_empty() && graph.segments.len() == 1);
    assert!(graph.cloud.losses[0].contains("2 CIRCLE without a radius"), "{:?}", graph.cloud.losses);
}

#[test]
fn arcs_over_other_segments_are_divided() {
    // A flat arc and the line below it, as one polyline and as two; a lens; the same arc twice; a line beside.
    for (entities, segments, count) in [
        ("LWPOLYLINE 70=1 10=0 20=0 42=0.02 10=1 20=0", 3, 2),
        ("LINE 10=1 20=0 11=0 21=0 LWPOLYLINE 10=0 20=0 42=0.02 10=1 20=0 LINE 10=5 20=5 11=6 21=5", 4, 2),
        ("LWPOLYLINE 70=1 10=0 20=0 42=0.02 10=1 20=0 42=0.02", 4, 4),
        ("LWPOLYLINE 10=0 20=0 42=0.02 10=1 20=0 LWPOLYLINE 10=1 20=0 42=-0.02 10=0 20=0", 2, 2),
        ("LWPOLYLINE 10=0 20=0 42=0.02 10=1 20=0 LINE 10=1 20=0 11=2 21=0", 2, 1),
    ] {
        let (graph, radii) = arcs("", entities);
        assert_eq!((graph.segments.len(), graph.arcs.len()), (segments, count), "{entities}");
        assert!(radii.iter().all(|r| (r - radii[0]).abs() < 1e-13), "{entities}: {radii:?}");
        let at = |i: usize| graph.cloud.xy[i];
        let is_chain = graph.arcs.iter().all(|(s, _)| {
            let [p, q] = graph.segments[*s].map(at);
            count == 1 || ((p[0] - q[0]).abs() - if segments == 2 { 1.0 } else { 0.5 }).abs() < 1e-15
        });
        assert!(is_chain, "{entities}: {:?}", graph.cloud.xy);
        assert!(graph.cloud.features.row(graph.cloud.xy.len() - 1).is_some(), "{entities}");
    }
}

#[test]
fn circles_out_of_range_are_told() {
    for circle in ["10=0 20=0 40=1e200", "10=0 20=0 40=1e-200", "10=1e17 20=0 40=0.1"] {
        let (graph, _) = arcs("", &format!("CIRCLE {circle}"));
        assert!(graph.arcs.is_empty(), "{circle}");
        assert!(graph.cloud.losses.iter().any(|loss| loss.ends_with("are straight: 1")), "{circle}");
    }
}

#[test]
fn bulges_that_are_none_are_told() {
    for (bulge, count) in [("nan", 1), ("inf", 1), ("-1e300", 1), ("1e-320", 0), ("0", 0), ("1e-9", 0)] {
        let (graph, _) = arcs("", &format!("LWPOLYLINE 10=0 20=0 42={bulge} 10=1 20=0 10=2 20=2"));
        let told = graph.cloud.losses.iter().filter(|loss| loss.ends_with("are straight: 1"));
        assert_eq!(told.count(), count, "{bulge}: {:?}", graph.cloud.losses);
    }
}

#[test]
fn blocks_are_where_they_are_inserted() {
    let blocks = "BLOCK 8=0 2=Arm 10=1 20=0 30=0 LINE 8=0 10=1 20=0 11=3 21=0 POINT 8=own 10=1 20=0 ENDBLK 8=0 \
        BLOCK 2=pair 10=0 20=0 INSERT 8=0 2=arm 10=10 20=0 50=90 ENDBLK";
    let entities = "INSERT 8=top 2=PAIR 10=100 20=0 41=2 INSERT 8=row 2=arm 10=0 20=50 70=2 71=2 44=5 45=7 INSERT 2=gone 10=0 20=0";
    let graph = read(drawing(blocks, entities)).expect("a drawing");
    let expected = [[120.0, 0.0], [120.0, 2.0], [120.0, 0.0]];
    assert_eq!(graph.cloud.xy[..3], expected);
    assert_eq!(layers(&graph)[..3], ["\"top\"", "\"top\"", "\"own\""]);
    let starts: Vec<_> = graph.cloud.xy[3..].iter().step_by(3).copied().collect();
    assert_eq!(starts, [[0.0, 50.0], [5.0, 50.0], [0.0, 57.0], [5.0, 57.0]]);
    // Seen from below, columns go to the left.
    let below = "INSERT 2=arm 10=1 20=50 70=2 71=2 44=5 45=7 230=-1";
    let xy = read(drawing(blocks, below)).expect("a drawing").cloud.xy;
    let starts: Vec<_> = xy.iter().step_by(3).copied().collect();
    assert_eq!(starts, [[-1.0, 50.0], [-6.0, 50.0], [-1.0, 57.0], [-6.0, 57.0]]);
    assert!(graph.cloud.losses[0].contains("1 INSERT of what is no block"), "{:?}", graph.cloud.losses);
}

#[test]
fn blocks_without_end_are_refused() {
    let own = drawing("BLOCK 2=a INSERT 2=a 10=0 20=0 ENDBLK", "INSERT 2=a 10=0 20=0");
    assert!(read(own).expect_err("a block in itself").to_string().contains("in each other"));
    let many: String = (0..20)
        .map(|i| format!("BLOCK 2=b{i} {} ENDBLK ", format!("INSERT 2=b{} 10=0 20=0 ", i + 1).repeat(20)))
        .collect();
    let error = read(drawing(&many, "INSERT 2=b0 10=0 20=0")).expect_err("more than any memory");
    assert!(matches!(error, Error::Expands), "{error}");
    let array = drawing("BLOCK 2=a ENDBLK", "INSERT 2=a 10=0 20=0 70=4000000000 71=4000000000");
    assert!(matches!(read(array).expect_err("an endless array"), Error::Expands));
}

#[test]
fn broken_drawings_are_named() {
    for (text, what) in [
        ("AutoCAD Binary DXF\r\n\u{1a}\0".to_owned(), "binary"),
        ("  0\nLINE\n".to_owned(), "does not begin with a section"),
        ("zero\nLINE\n".to_owned(), "\"zero\" stands where the code"),
        ("  0\nSECTION\n  2".to_owned(), "between a code and its value"),
        (drawing("", "POINT 10=x"), "\"x\" of POINT is no number"),
        (drawing("", "").replace("EOF", "END"), "before the group that ends it"),
        (String::new(), "before the group that ends it"),
    ] {
        let error = read(text).expect_err(what);
        assert!(error.to_string().contains(what), "{error}");
    }
    let whole = drawing("BLOCK 2=a POINT 10=0 20=0 ENDBLK", "INSERT 2=a 10=0 20=0 POLYLINE VERTEX 10=1 20=1");
    assert_eq!(read(whole.clone()).expect("two entities").cloud.xy, [[0.0, 0.0], [1.0, 1.0]]);
    for length in 0..whole.len() - 5 {
        assert!(read(whole[..length].to_owned()).is_err(), "cut to {length}");
    }
}

#[test]
fn ellipses_and_splines_are_arcs() {
    let outside = |graph: &Graph, f: &dyn Fn([f64; 2]) -> f64| {
        let worst = graph.cloud.xy.iter().map(|&p| f(p).abs()).fold(0.0, f64::max);
        // Arcs end where the curve is, and their middles are near it.
        assert!(graph.arcs.len() + 1 >= graph.segments.len() && !graph.arcs.is_empty());
        worst
    };
    // Half axes of 3 and 1, whole and a quarter; seen from below a quarter goes the other way.
    let on_ellipse = |p: [f64; 2]| ((p[0] - 5.0) / 3.0).hypot(p[1] - 1.0) - 1.0;
    let (whole, _) =
        arcs("", "ELLIPSE 10=5 20=1 30=0 11=3 21=0 31=0 40=0.3333333333333333 41=0 42=6.283185307179586");
    assert!(outside(&whole, &on_ellipse) < 3.1e-4, "{:?}", whole.cloud.xy);
    assert_eq!(whole.cloud.xy[0], whole.cloud.xy[whole.cloud.xy.len() - 1]);
    assert_eq!(whole.cloud.losses, [""; 0]);
    assert!(
        whole.cloud.remarks[0].ends_with("ten-thousandth of their extent: 1"),
        "{:?}",
        whole.cloud.remarks
    );
    for (up, y) in [("", 2.0), ("230=-1", 0.0)] {
        let quarter = format!(
            "ELLIPSE 10=5 20=1 30=0 11=3 21=0 31=0 40=0.3333333333333333 41=0 42=1.5707963267948966 {up}"
        );
        let (quarter, _) = arcs("", &quarter);
        let [first, last] = [0, quarter.cloud.xy.len() - 1].map(|i| quarter.cloud.xy[i]);
        assert_eq!(first, [8.0, 1.0]);
        assert!((last[0] - 5.0).abs() < 1e-15 && (last[1] - y).abs() < 1e-15, "{last:?}");
        assert!(outside(&quarter, &on_ellipse) < 3.1e-4);
    }
    // A quarter of a circle by weights; a cubic that bends twice; a closed one; a line.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let circle = format!(
        "SPLINE 70=4 71=2 40=0 40=0 40=0 40=1 40=1 40=1 41=1 41={half} 41=1 10=1 20=0 10=1 20=1 10=0 20=1"
    );
    let (circle, radii) = arcs("", &circle);
    assert!(radii.iter().all(|r| (r - 1.0).abs() < 1e-12), "{radii:?}");
    assert!(outside(&circle, &|p| p[0].hypot(p[1]) - 1.0) < 1e-12);
    let cubic =
        "SPLINE 70=8 71=3 40=0 40=0 40=0 40=0 40=1 40=1 40=1 40=1 10=0 20=0 10=1 20=1 10=2 20=-1 10=3 20=0";
    let (cubic, _) = arcs("", cubic);
    // x is 3 t there.
    let off = |p: [f64; 2]| {
        let t = p[0] / 3.0;
        p[1] - 3.0 * t * (1.0 - t) * (1.0 - 2.0 * t)
    };
    assert!(outside(&cubic, &off) < 3e-4 && cubic.cloud.xy.len() > 10);
    let heart = "SPLINE 71=3 40=0 40=0 40=0 40=0 40=1 40=1 40=1 40=1 41=0.3 41=1.7 41=2 41=0.7 10=0.1 20=0.2 10=4 20=3 10=-4 20=3 10=0.1 20=0.2";
    let (heart, _) = arcs("", heart);
    let ends = [heart.cloud.xy[0], heart.cloud.xy[heart.cloud.xy.len() - 1]];
    assert_eq!(ends, [[0.1, 0.2]; 2]);
    let line = "SPLINE 71=1 40=0 40=0 40=1 40=2 40=2 10=0 20=0 10=1 20=1 10=3 20=0";
    let (line, _) = arcs("", line);
    assert_eq!((line.cloud.xy.len(), line.arcs.len()), (5, 0), "{:?}", line.cloud.xy);
    // Without what they need they are counted.
    for (entity, why) in [
        ("SPLINE 71=3 11=0 21=0 11=1 21=1", "SPLINE of fit points"),
        ("SPLINE 71=3 40=0 40=1 10=0 20=0 10=1 20=1", "SPLINE whose knots do not fit"),
        ("SPLINE 71=1 40=0 40=0 40=nan 40=1 10=0 20=0 10=1 20=1", "SPLINE of numbers that are none"),
        ("SPLINE 71=1 40=0 40=0 40=1 40=1 10=0 20=0 30=0 10=1 20=1 30=1", "SPLINE that is not level"),
        ("ELLIPSE 10=0 20=0 11=0 21=0 40=1", "ELLIPSE of numbers that are none"),
        ("ELLIPSE 10=0 20=0 11=1 21=0 31=1 40=1", "ELLIPSE in a tilted plane"),
        ("ELLIPSE 10=0 20=0", "ELLIPSE without a position or an axis"),
    ] {
        let (graph, _) = arcs("", entity);
        assert!(graph.cloud.losses[0].contains(&format!("1 {why}")), "{entity}: {:?}", graph.cloud.losses);
    }
}
