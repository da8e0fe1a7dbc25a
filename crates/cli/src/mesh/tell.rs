//! The summary of a mesh: counts, angles, and triangles that are not as wanted.

use delone::{Constrained2, Domains2, Reason, RefinementReport2, SegmentId, Shapes2};
use serde_json::{Map, Value, json};

use crate::message::{grouped, say, warn};
use crate::stats::Stats;

/// Characters of the longest bar.
const LONGEST: usize = 50;

/// Notes all for the statistics.
pub(super) fn count(report: &RefinementReport2, points: usize, stats: &mut Stats) {
    let left = Reason::ALL.map(|reason| (key(reason).to_owned(), json!(report.left_for(reason))));
    stats.set("points", points);
    stats.set("simplices", report.triangles);
    stats.set("steiner_inside", report.inside);
    stats.set("steiner_on_constraints", report.on_constraints);
    stats.set("smallest_angle", report.smallest_angle);
    stats.set("largest_angle", report.largest_angle);
    stats.set("histogram", report.angles.to_vec());
    stats.set("smallest_angles", report.smallest_angles.to_vec());
    let layers = &report.layers;
    if layers.places > 0 {
        let rows = json!({
            "triangles": layers.triangles, "vertices": layers.vertices, "rows": layers.rows,
            "places": layers.places, "shortened": layers.shortened,
        });
        stats.set("layers", rows);
    }
    stats.set("left", Value::Object(Map::from_iter(left)));
}

/// Notes how good triangles are for computing.
pub(super) fn shapes(shapes: &Shapes2, stats: &mut Stats) {
    stats.set("quality", json!({ "mean": shapes.quality_mean, "p5": shapes.quality_p5 }));
    stats.set("step", json!({ "p95": shapes.step_p95 }));
}

/// The name of a reason in statistics.
fn key(reason: Reason) -> &'static str {
    match reason {
        Reason::InputAngle => "input_angle",
        Reason::Precision => "precision",
        Reason::Cascade => "cascade",
        Reason::Budget => "budget",
        Reason::Kept => "kept",
        Reason::Short => "short",
        _ => "other",
    }
}

/// How many triangles are left, by reason; nothing if there are none.
pub(super) fn left(report: &RefinementReport2) -> Option<String> {
    let count = report.left.len();
    let reasons = Reason::ALL.iter().filter_map(|&reason| match report.left_for(reason) {
        0 => None,
        count => Some(format!("{} {}", grouped(count as u64), reason.text())),
    });
    let what = if count == 1 { "triangle is" } else { "triangles are" };
    let reasons = reasons.collect::<Vec<_>>().join(", ");
    (count > 0).then(|| format!("{} {what} not as wanted: {reasons}", grouped(count as u64)))
}

/// Warns of a gap that is too narrow to be meant: triangles become as small as it is, if they can.
pub(super) fn gap(c: &Constrained2, inside: &Domains2, quiet: bool) {
    let Some(gap) = c.tiny_gap(inside) else { return };
    let ([one, other], [x, y]) = (gap.segments.map(SegmentId::index), gap.at);
    warn(
        quiet,
        format!(
            "segments {one} and {other} are {} apart near ({x}, {y}): triangles there will be as small, or not as wanted; --weld 1e{} joins them",
            gap.width,
            gap.exponent()
        ),
    );
}

/// Says in a line what was done, and warns of what could not be.
pub(super) fn summary(report: &RefinementReport2, stats: &Stats, quiet: bool) {
    if let Some(left) = left(report) {
        warn(quiet, left);
    }
    let layers = &report.layers;
    if layers.shortened > 0 {
        let [shortened, places] = [layers.shortened, layers.places].map(|count| grouped(count as u64));
        warn(
            quiet,
            format!(
                "{shortened} of {places} vertices of walls have fewer rows than asked for: there is no room"
            ),
        );
    }
    let [points, triangles, inside, on] = ["points", "simplices", "steiner_inside", "steiner_on_constraints"]
        .map(|name| grouped(stats.get(name).as_u64().unwrap_or_default()));
    let angles = if report.largest_angle > 0.0 {
        format!(", angles from {:.2} to {:.2} degrees", report.smallest_angle, report.largest_angle)
    } else {
        String::new() // None was measured.
    };
    let quality = match stats.get("quality")["mean"].as_f64() {
        Some(mean) if mean > 0.0 => format!(", mean quality {mean:.3}"),
        _ => String::new(),
    };
    let quads = quads(&stats.get("quads"));
    let seconds = stats.total();
    say(
        quiet,
        format_args!(
            "{points} points ({inside} new inside, {on} on constraints), {triangles} triangles{angles}{quality}{quads} ({seconds:.2} s)"
        ),
    );
}

/// The part of the line about quadrilaterals, if there are some.
fn quads(counts: &Value) -> String {
    let number = |name: &str| counts[name].as_u64();
    let [Some(quads), Some(left), Some(points)] = ["count", "triangles", "points"].map(number) else {
        return String::new();
    };
    let new = if points > 0 { format!(" ({} more points)", grouped(points)) } else { String::new() };
    let rest = if points > 0 { String::new() } else { format!(" and {} triangles", grouped(left)) };
    let angles = match ["smallest_angle", "largest_angle"].map(|name| counts[name].as_f64()) {
        [Some(low), Some(high)] if quads > 0 => format!(" of {low:.2} to {high:.2} degrees"),
        _ => String::new(),
    };
    format!("; {} quadrilaterals{angles}{rest}{new}", grouped(quads))
}

/// How many angles there are of each size, as bars.
pub(super) fn histogram(report: &RefinementReport2) -> String {
    let most = report.angles.iter().copied().max().unwrap_or_default().max(1);
    let width = 180 / report.angles.len();
    let wide = grouped(most as u64).len();
    let line = |(k, &count): (usize, &usize)| {
        // Whatever there is can be seen.
        let bar = (count * LONGEST).div_ceil(most);
        let text = format!(
            "{:>3} to {:>3} degrees  {:>wide$}  {}",
            k * width,
            (k + 1) * width,
            grouped(count as u64),
            "#".repeat(bar)
        );
        format!("{}\n", text.trim_end())
    };
    report.angles.iter().enumerate().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::{histogram, left};
    use delone::{Constrained2, Refinement};

    #[test]
    fn a_histogram_has_a_bar_for_each_ten_degrees() {
        let mut c = Constrained2::from_parts(&[[0, 0], [1, 0], [0, 1]], &[]).expect("a triangle");
        let refined = Refinement::new().run(&mut c).expect("refined");
        let text = histogram(&refined.report);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 18);
        assert!(
            lines[4] == format!(" 40 to  50 degrees  2  {}", "#".repeat(50)) || lines[4].ends_with('#'),
            "{text}"
        );
        assert_eq!(lines[0], "  0 to  10 degrees  0");
        assert_eq!(left(&refined.report), None);
    }
}
