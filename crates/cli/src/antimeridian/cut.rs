//! Cuts all lines and polygons of a graph, and tells what that did.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use delone_io::Graph;
use serde_json::json;

use super::parts::{Cutting, Part, Pole, Walked, in_strip, longitude};
use super::rebuild::Rebuilt;
use super::turns::{Corner, LARGEST_LONGITUDE_DEGREES, Made, POLE_DEGREES, Piece, Walk};
use super::{are_degrees, name_of, place_of, reduced};
use crate::message::{Failure, grouped, note};
use crate::stats::Stats;

/// Rings that are named; more are counted.
const NAMED: usize = 10;

/// A polygon of a graph.
enum Polygon {
    /// It has places of no number, or none: as it is.
    AsGiven,
    /// Each ring is in one strip.
    Whole(Vec<(Walked, i32)>),
    Cut(Vec<Part>),
}

/// The work on a graph: each line and polygon of it, cut.
struct Work<'a> {
    graph: &'a Graph,
    made: Vec<Made>,
    label: &'a Path,
    by_direction: bool,
    /// Segments that are of no ring, with their pieces, unless they have places of no number.
    lines: Vec<(usize, Option<Vec<Piece>>)>,
    /// Polygons by their numbers, with their rings.
    polygons: Vec<(usize, Vec<usize>, Polygon)>,
    /// Rings around a pole, and rings wider than a turn.
    around: Vec<(usize, Pole)>,
    wide: Vec<usize>,
}

/// The numbers of what was cut.
#[derive(Default)]
struct Counts {
    polygons: usize,
    parts: usize,
    segments: usize,
    /// Segments that bound areas and are of no ring.
    open: usize,
    /// The numbers that second and further parts have.
    numbers: Range<usize>,
}

/// Cuts a graph, if anything in it crosses.
pub(super) fn cut(
    graph: &mut Graph,
    by_direction: bool,
    label: &Path,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let work = Work::on(graph, by_direction, label)?;
    let mut rebuilt = Rebuilt::new(graph, &work.made);
    let counts = work.build(&mut rebuilt);
    if !rebuilt.is_other && counts.polygons == 0 {
        return Ok(());
    }
    let report = json!({
        "polygons": counts.polygons,
        "parts": counts.parts,
        "segments": counts.segments,
        "around_poles": work.around.len(),
        "added_points": rebuilt.added(),
        "moved_points": rebuilt.moved(),
    });
    stats.set("antimeridian", report);
    work.tell(&counts, quiet);
    if rebuilt.moved() > 0 {
        note(
            quiet,
            format_args!("points moved by 360 degrees of longitude: {}", grouped(rebuilt.moved() as u64)),
        );
    }
    let changes = rebuilt.changes();
    let straight = changes.apply(graph);
    let seeds = graph.holes.iter_mut().chain(graph.regions.iter_mut().map(|region| &mut region.at));
    seeds.filter(|at| at[0].abs() <= LARGEST_LONGITUDE_DEGREES).for_each(|at| at[0] = reduced(at[0]).1);
    if straight > 0 {
        note(quiet, format_args!("arcs of what was cut or moved are straight now: {straight}"));
    }
    Ok(())
}

/// The strip beside a piece along the meridian that has the longitude of its first corner.
fn strip_along(graph: &Graph, piece: &Piece) -> i32 {
    let is_west = |i: usize| reduced(graph.cloud.xy[i][0]).1 < 0.0;
    match piece.from.corner {
        Corner::Given(i) if is_west(i) => piece.from.place + 1,
        _ => piece.from.place - 1,
    }
}

impl<'a> Work<'a> {
    fn on(graph: &'a Graph, by_direction: bool, label: &'a Path) -> Result<Self, Failure> {
        let (made, lines, polygons) = (Vec::new(), Vec::new(), Vec::new());
        let (around, wide) = (Vec::new(), Vec::new());
        let mut work = Self { graph, made, label, by_direction, lines, polygons, around, wide };
        work.refuse_far_points()?;
        let mut is_of_ring = vec![false; graph.segments.len()];
        let mut polygons: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (number, ring) in graph.rings.iter().enumerate() {
            is_of_ring[ring.segments.clone()].fill(true);
            polygons.entry(ring.polygon).or_default().push(number);
        }
        for segment in (0..is_of_ring.len()).filter(|&segment| !is_of_ring[segment]) {
            let line = work.line(segment)?;
            work.lines.push((segment, line));
        }
        for (polygon, rings) in polygons {
            let result = work.polygon(&rings)?;
            work.polygons.push((polygon, rings, result));
        }
        Ok(work)
    }

    /// Makes the new segments.
    fn build(&self, rebuilt: &mut Rebuilt) -> Counts {
        let graph = self.graph;
        let mut counts = Counts::default();
        for (segment, pieces) in &self.lines {
            let Some(pieces) = pieces else {
                rebuilt.keep(*segment);
                continue;
            };
            if pieces.len() > 1 {
                counts.segments += 1;
                counts.open += usize::from(graph.is_border.get(*segment).copied().unwrap_or(true));
            }
            for piece in pieces {
                let strip = piece.strip.unwrap_or_else(|| strip_along(graph, piece));
                let ends = [piece.from, piece.to];
                let ends = ends.map(|end| (end.corner, longitude(graph, end.corner, end.side(strip))));
                rebuilt.add_line(ends, *segment);
            }
        }
        for (_, rings, polygon) in &self.polygons {
            let rings = rings.iter().map(|&ring| &graph.rings[ring]);
            match polygon {
                Polygon::AsGiven => rings.for_each(|ring| rebuilt.keep_ring(ring)),
                Polygon::Whole(walked) => {
                    for (ring, (walked, strip)) in rings.zip(walked) {
                        let outline = in_strip(graph, &walked.pieces, *strip);
                        rebuilt.add_ring(&outline, ring.polygon, ring.ring, ring.segments.start);
                    }
                }
                Polygon::Cut(_) => {}
            }
        }
        let first_new = self.polygons.last().map_or(0, |polygon| polygon.0 + 1);
        counts.numbers = first_new..first_new;
        for (number, rings, polygon) in &self.polygons {
            let Polygon::Cut(parts) = polygon else { continue };
            counts.polygons += 1;
            counts.parts += parts.len();
            for (k, part) in parts.iter().enumerate() {
                let number = if k == 0 { *number } else { counts.numbers.end };
                counts.numbers.end += usize::from(k > 0);
                for (ring, outline) in part.rings.iter().enumerate() {
                    rebuilt.add_ring(outline, number, ring, graph.rings[rings[0]].segments.start);
                }
            }
        }
        for (i, &[x, _]) in graph.cloud.xy.iter().enumerate() {
            if x.is_finite() {
                rebuilt.move_point(i, reduced(x).1);
            }
        }
        counts
    }

    /// Tells what was cut.
    fn tell(&self, counts: &Counts, quiet: bool) {
        let Range { start, end } = counts.numbers;
        let [polygons, parts, segments] =
            [counts.polygons, counts.parts, counts.segments].map(|count| grouped(count as u64));
        let numbers =
            if start < end { format!("; further parts are polygons from {start} on") } else { String::new() };
        if counts.polygons > 0 {
            let what = format_args!(
                "polygons cut at the meridian of 180 degrees: {polygons}, into parts: {parts}{numbers}"
            );
            note(quiet, what);
        }
        if counts.segments > 0 {
            note(quiet, format_args!("segments of lines cut at the meridian of 180 degrees: {segments}"));
        }
        if counts.open > 0 {
            let what = "of these bound areas without being rings, so that nothing closes them there";
            note(quiet, format_args!("{what}: {}", counts.open));
        }
        let around = self
            .around
            .iter()
            .map(|(ring, pole)| (*ring, format!("goes around {pole} and is closed along it")));
        self.tell_rings(around, quiet);
        let wide = "is wider than 360 degrees; where it covers itself twice is outside of it";
        self.tell_rings(self.wide.iter().map(|&ring| (ring, wide.to_owned())), quiet);
    }

    /// Tells something of rings.
    fn tell_rings(&self, rings: impl ExactSizeIterator<Item = (usize, String)>, quiet: bool) {
        let more = rings.len().saturating_sub(NAMED);
        for (k, (ring, what)) in rings.take(NAMED).enumerate() {
            let rest = if k + 1 == NAMED && more > 0 {
                format!(", and so it is with {more} more")
            } else {
                String::new()
            };
            note(quiet, format_args!("{} {what}{rest}", name_of(&self.graph.rings[ring])));
        }
    }

    fn refused(&self, place: &str, problem: &str) -> Failure {
        let help = "repair it, or leave --antimeridian cut out";
        Failure::new(format!("{}: {place}: {problem}", self.label.display()), help)
    }

    /// Refuses longitudes that one turn does not bring into [-180, 180].
    fn refuse_far_points(&self) -> Result<(), Failure> {
        let graph = self.graph;
        let is_far = |p: &[f64; 2]| p[0].is_finite() && p[0].abs() > LARGEST_LONGITUDE_DEGREES;
        let Some(point) = graph.cloud.xy.iter().position(is_far) else { return Ok(()) };
        let segment = graph.segments.iter().position(|ends| ends.contains(&point));
        let place = segment.map_or_else(|| format!("point {point}"), |segment| place_of(graph, segment));
        let x = graph.cloud.xy[point][0];
        Err(self.refused(&place, &format!("the longitude {x} is not within 540 degrees of 0")))
    }

    /// Refuses latitudes beyond the poles, where something is cut.
    fn refuse_latitudes(&self, segment: usize) -> Result<(), Failure> {
        let places = self.graph.segments[segment].map(|i| self.graph.cloud.xy[i]);
        match places.iter().find(|p| !are_degrees(p)) {
            None => Ok(()),
            Some([_, y]) => {
                let problem = format!("the latitude {y} is beyond {POLE_DEGREES} degrees");
                Err(self.refused(&place_of(self.graph, segment), &problem))
            }
        }
    }

    fn is_finite(&self, segment: usize) -> bool {
        self.graph.segments[segment].iter().all(|&i| self.graph.cloud.xy[i].iter().all(|x| x.is_finite()))
    }

    /// The pieces of a segment that is of no ring; `None` if it has places of no number.
    fn line(&mut self, segment: usize) -> Result<Option<Vec<Piece>>, Failure> {
        if !self.is_finite(segment) {
            return Ok(None);
        }
        let mut walk = Walk::from(self.graph, self.graph.segments[segment][0]);
        walk.go(segment, &mut self.made);
        if walk.pieces.len() > 1 {
            self.refuse_latitudes(segment)?;
        }
        Ok(Some(walk.pieces))
    }

    /// Cuts the polygon of these rings.
    fn polygon(&mut self, rings: &[usize]) -> Result<Polygon, Failure> {
        let graph = self.graph;
        let all = || rings.iter().map(|&ring| &graph.rings[ring]);
        if !all().flat_map(|ring| ring.segments.clone()).all(|segment| self.is_finite(segment)) {
            return Ok(Polygon::AsGiven);
        }
        let walked: Vec<Walked> =
            all().map(|ring| Walked::of(graph, &ring.segments, &mut self.made)).collect();
        let strips: Option<Vec<i32>> = walked.iter().map(Walked::only_strip).collect();
        if let Some(strips) = strips {
            return Ok(Polygon::Whole(walked.into_iter().zip(strips).collect()));
        }
        let mut poles = [false; 2];
        let mut of_shell = None;
        for (&number, ring) in rings.iter().zip(&walked) {
            let given = &graph.rings[number];
            given.segments.clone().try_for_each(|segment| self.refuse_latitudes(segment))?;
            if ring.winding.abs() > 1 {
                let problem = format!("it goes {} times around the world", ring.winding.abs());
                return Err(self.refused(&name_of(given), &problem));
            }
            if ring.is_wide(graph) {
                self.wide.push(number);
            }
            if ring.winding != 0 {
                let is_shell = given.ring == 0;
                // A hole is inside of its shell.
                let pole = of_shell.unwrap_or_else(|| ring.pole(graph, is_shell, self.by_direction));
                of_shell = of_shell.or(is_shell.then_some(pole));
                poles[pole as usize] ^= true;
                self.around.push((number, pole));
            }
        }
        let mut cutting = Cutting::new(graph, &mut self.made);
        for (&number, ring) in rings.iter().zip(&walked) {
            cutting.take(ring, graph.rings[number].ring == 0);
        }
        Ok(Polygon::Cut(cutting.parts(poles)))
    }
}
