//! Points with segments that fail: fewer segments, then fewer points with the segments that are left between them.

use std::panic::{self, AssertUnwindSafe};

use delone::verify::verify_constrained2;
use delone::{Constrained2, Crossings};
use delone_cli::files;
use delone_cli::message::{Failure, answer, note};
use delone_cli::progress::Phase;
use delone_cli::stats::Stats;
use delone_io::{Cloud, Contents, Direction, Graph};

use super::{Points, from_least, reduce};
use crate::args::ReduceArgs;

type Segments = [[usize; 2]];

pub(super) fn run(args: &ReduceArgs, quiet: bool) -> Result<(), Failure> {
    if args.against.is_some() {
        return Err(Failure::usage("--against judges points", "leave it or the segments out"));
    }
    let mut inputs = args.input.paths();
    inputs.extend(args.segments.as_deref());
    let stats_path = args.input.stats.as_deref();
    let outputs = args.wkt.of(files::outputs(args.output.as_slice(), None, stats_path, &inputs)?)?;
    let mut stats = Stats::start();
    let Graph { cloud, segments, .. } = files::graph(&args.input, args.segments.as_deref(), quiet)?;
    stats.phase("read");
    stats.set("points", cloud.xy.len());
    stats.set("segments", segments.len());
    let first = failure(&cloud.xy, &segments);
    stats.set("fails", first.is_some());
    let Some(first) = first else {
        answer("nothing to reduce: these points and segments do not fail\n")?;
        return stats.write(stats_path);
    };
    note(quiet, format_args!("{} points, {} segments fail: {first}", cloud.xy.len(), segments.len()));
    let (points, segments) = {
        let _phase = Phase::start(quiet, "reducing");
        reduced(cloud.xy, segments, |points, segments| failure(points, segments).is_some())
    };
    stats.phase("build");
    let why = failure(&points, &segments).unwrap_or(first);
    answer(&test(&points, &segments, &why))?;
    stats.set("reduced", points.len());
    stats.set("reduced_segments", segments.len());
    let graph = Graph { segments, cloud: Cloud { xy: points, ..Cloud::default() }, ..Graph::default() };
    for (path, format) in &outputs {
        files::write(path, |out| {
            if format.holds(Contents::Lines, Direction::Written) {
                delone_io::write_graph(out, *format, &graph)
            } else {
                delone_io::write_points(out, *format, &graph.cloud.xy)
            }
        })?;
    }
    stats.phase("write");
    stats.write(stats_path)
}

/// A test that fails as the graph does.
fn test(points: &Points, segments: &Segments, why: &str) -> String {
    let rows: String = points.iter().map(|[x, y]| format!("        [{x:?}, {y:?}],\n")).collect();
    let (n, m) = (points.len(), segments.len());
    format!(
        "// {n} points, {m} segments: {why}
#[test]
fn reduced() {{
    let points: [[f64; 2]; {n}] = [
{rows}    ];
    let segments: [[usize; 2]; {m}] = {segments:?};
    let c = delone::Constrained2::with_crossings(&points, &segments, delone::Crossings::Split).unwrap();
    assert_eq!(c.check(), Ok(()));
}}
"
    )
}

/// A part that fails, no point and no segment of which can be left out. With a point go the segments that end there.
fn reduced(
    points: Vec<[f64; 2]>,
    segments: Vec<[usize; 2]>,
    fails: impl Fn(&Points, &Segments) -> bool,
) -> (Vec<[f64; 2]>, Vec<[usize; 2]>) {
    let segments = reduce(segments, |segments| fails(&points, segments));
    let without = |kept: &[usize]| {
        let rank = |i: &usize| kept.binary_search(i).ok();
        let segments: Vec<[usize; 2]> =
            segments.iter().filter_map(|[i, j]| Some([rank(i)?, rank(j)?])).collect();
        (kept.iter().map(|&i| points[i]).collect::<Vec<_>>(), segments)
    };
    let kept = reduce((0..points.len()).collect(), |kept| {
        let (points, segments) = without(kept);
        fails(&points, &segments)
    });
    let (points, segments) = without(&kept);
    let segments = reduce(segments, |segments| fails(&points, segments));
    (points, segments)
}

/// Why Delone fails, if it does: a panic, a failed check, a judge that objects, or another result of another order.
fn failure(points: &Points, segments: &Segments) -> Option<String> {
    let there = built(points, segments, "");
    let backwards: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    let last = points.len().wrapping_sub(1);
    let turned: Vec<[usize; 2]> = segments.iter().rev().map(|[i, j]| [last - j, last - i]).collect();
    match there.and_then(|there| Ok((there, built(&backwards, &turned, "in reverse order: ")?))) {
        Err(why) => Some(why),
        Ok((there, back)) => (there != back).then(|| "the order of the input makes a difference".to_owned()),
    }
}

/// The triangles by coordinates, sorted, if nothing is wrong with them.
fn built(points: &Points, segments: &Segments, how: &str) -> Result<Vec<[[f64; 2]; 3]>, String> {
    let attempt = panic::catch_unwind(AssertUnwindSafe(|| {
        let c = Constrained2::with_crossings(points, segments, Crossings::Split)?;
        let flaw = c.check().err().map(|flaw| flaw.to_string());
        Ok::<_, delone::Error>((c, flaw))
    }));
    let (c, flaw) = attempt.map_err(|_| format!("{how}it panics"))?.map_err(|error| error.to_string())?;
    if let Some(flaw) = flaw {
        return Err(format!("{how}{flaw}"));
    }
    let pieces: Vec<[usize; 2]> = c.constraints().map(|ends| ends.map(|v| v.index())).collect();
    let corners: Vec<[u64; 3]> = c.triangles().map(|t| t.map(|v| v.index() as u64)).collect();
    match verify_constrained2(c.points(), &pieces, &corners) {
        Err(objection) => return Err(format!("{how}{objection}")),
        Ok(verdict) if !verdict.is_canonical() => return Err(format!("{how}it is not canonical")),
        Ok(_) => {}
    }
    let mut triangles: Vec<_> = c.triangles().map(|t| from_least(t.map(|v| c.point(v)))).collect();
    triangles.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::{failure, reduced, test};
    use delone_generators::Graph;

    #[test]
    fn reduces_to_what_matters() {
        let (points, segments) = Graph::PlanarSubset.parts(300, 1);
        let [a, b] = segments[7].map(|i| points[i]);
        let alone = points[(0..300).find(|i| !segments.as_flattened().contains(i)).expect("some")];
        let (points, segments) = reduced(points, segments, |points, segments| {
            points.contains(&alone) && segments.iter().any(|ends| ends.map(|i| points[i]) == [a, b])
        });
        let mut expected = [a, b, alone];
        let mut found = points.clone();
        expected.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
        found.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
        assert_eq!((found, segments.len()), (expected.to_vec(), 1));
        let text = test(&points, &segments, "why");
        assert!(text.starts_with("// 3 points, 1 segments: why\n") && text.contains("; 1] = [["), "{text}");
    }

    #[test]
    fn delone_does_not_fail() {
        for graph in [Graph::GridSegments, Graph::Crossing, Graph::Koch] {
            let (points, segments) = graph.parts(120, 2);
            assert_eq!(failure(&points, &segments), None);
        }
        assert_eq!(failure(&[], &[]), None);
    }
}
