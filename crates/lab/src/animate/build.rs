//! Constructions step by step: flips (Guibas, Knuth & Sharir 1992, §3), conflict lists (Clarkson & Shor 1989), hints
//! (Devillers 2011, §3).

use std::collections::{BTreeMap, BTreeSet};

use delone::{Change, Delaunay2, Error, HintOrder, Hints2, Imprecise, Inserted, Location2, VertexId};
use delone_generators::{Random, moved};
use delone_io::picture::{Mark, Sketch, Tone};

use super::scene::{Seen, corners, mesh};

/// A triangle by its vertices, the smallest first, counter-clockwise.
type Corners = [VertexId; 3];

fn turned(mut corners: Corners) -> Corners {
    let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
    corners.rotate_left(least);
    corners
}

fn triangles(d: &Delaunay2) -> BTreeSet<Corners> {
    d.triangles().map(turned).collect()
}

fn sides([a, b, c]: Corners) -> [[VertexId; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn shuffled(points: &[[f64; 2]], seed: u64) -> Vec<[f64; 2]> {
    let mut points = points.to_vec();
    Random::new(seed).shuffle(&mut points);
    points
}

/// Insertions by flips: the triangle that holds the point is split in three, then each triangle in conflict across an edge
/// of the new point's star joins the star by a flip.
pub(super) fn flips(points: &[[f64; 2]], seed: u64, most: usize) -> Result<Vec<Sketch>, Error> {
    let points = shuffled(points, seed);
    let mut d = Delaunay2::new();
    let mut sketches = Vec::new();
    for (i, &p) in points.iter().enumerate() {
        if sketches.len() >= most {
            break;
        }
        let found = d.locate(p)?;
        let before = d.clone();
        let inserted = d.insert(p)?;
        let first = match found {
            Location2::Triangle(t) => before.mesh().corners(t),
            Location2::Edge(e) => before.mesh().corners(e.triangle()),
            _ => continue,
        };
        if matches!(inserted, Inserted::Existing(_)) || first.iter().any(|v| v.is_ghost()) {
            continue;
        }
        let after = triangles(&d);
        let mut doomed: BTreeSet<Corners> = triangles(&before).difference(&after).copied().collect();
        let caption = |what: &str| format!("point {} of {}: {what}", i + 1, points.len());
        let base = mesh(&before, Tone::Faint);
        let mut star = vec![turned(first)];
        doomed.remove(&star[0]);
        let mut marks = base.clone();
        marks.push(Mark::Area(corners(&before, first), Tone::Seen));
        marks.push(Mark::Dot(p, Tone::Goal));
        sketches.push(Sketch { marks, caption: caption("its triangle"), ..Sketch::default() });
        loop {
            let border = border(&star);
            // What is next across an edge of the star, and in conflict.
            let next =
                doomed.iter().copied().find(|&t| sides(t).iter().any(|&[u, v]| border.contains(&[v, u])));
            let mut marks = Vec::new();
            for &[u, v] in &border {
                marks.push(Mark::Area(vec![before.point(u), before.point(v), p], Tone::New));
            }
            if let Some(next) = next {
                marks.push(Mark::Area(corners(&before, next), Tone::Old));
            }
            marks.extend(base.iter().filter(|mark| !is_inside(mark, &star, &before)).cloned());
            for &[u, _] in &border {
                marks.push(Mark::Line([p, before.point(u)], Tone::Plain));
            }
            if let Some(ring) = next.and_then(|t| ring(&before, t)) {
                marks.push(ring);
            }
            marks.push(Mark::Dot(p, Tone::Goal));
            let caption = match (next, star.len()) {
                (Some(_), 1) => caption("split, and a triangle in conflict"),
                (Some(_), _) => caption("flipped, and another one in conflict"),
                (None, _) => caption("no conflict is left"),
            };
            sketches.push(Sketch { marks, caption, ..Sketch::default() });
            let Some(next) = next else { break };
            doomed.remove(&next);
            star.push(next);
        }
    }
    Ok(sketches)
}

/// The directed edges around some triangles.
fn border(triangles: &[Corners]) -> Vec<[VertexId; 2]> {
    let all: BTreeSet<[VertexId; 2]> = triangles.iter().flat_map(|&t| sides(t)).collect();
    all.iter().copied().filter(|&[u, v]| !all.contains(&[v, u])).collect()
}

/// Whether a mark is an edge that is gone inside of a star.
fn is_inside(mark: &Mark, star: &[Corners], d: &Delaunay2) -> bool {
    let Mark::Line(ends, _) = mark else { return false };
    let all: BTreeSet<[VertexId; 2]> = star.iter().flat_map(|&t| sides(t)).collect();
    all.iter().any(|&[u, v]| all.contains(&[v, u]) && [d.point(u), d.point(v)] == *ends)
}

/// The circle of a triangle.
fn ring(d: &Delaunay2, [a, b, c]: Corners) -> Option<Mark> {
    let t = d.mesh().triangles().find(|&t| turned(d.mesh().corners(t)) == [a, b, c])?;
    let center = d.circumcenter(t)?;
    let p = d.point(a);
    Some(Mark::Ring(center, (p[0] - center[0]).hypot(p[1] - center[1]), Tone::Goal))
}

/// The points to come in the colors of their triangles, insertion by insertion.
pub(super) fn lists(points: &[[f64; 2]], seed: u64, most: usize) -> Result<Vec<Sketch>, Error> {
    let points = shuffled(points, seed);
    let mut d = Delaunay2::new();
    let mut sketches = Vec::new();
    let mut homes: BTreeMap<usize, Corners> = BTreeMap::new();
    let every = points.len().div_ceil(most.max(1)).max(1);
    for (i, &p) in points.iter().enumerate() {
        let v = d.insert(p)?.vertex();
        if (i + 1) % every != 0 && i + 1 != points.len() {
            continue;
        }
        let mut marks = Vec::new();
        let number = |t: Corners| t.iter().fold(0, |sum, v| 31 * sum + v.index());
        for t in triangles(&d) {
            marks.push(Mark::Patch(corners(&d, t), number(t)));
        }
        marks.extend(mesh(&d, Tone::Plain));
        let mut changed = 0;
        for (j, &q) in points.iter().enumerate().skip(i + 1) {
            let home = match d.locate(q)? {
                Location2::Triangle(t) => Some(d.mesh().corners(t)),
                Location2::Edge(e) => Some(d.mesh().corners(e.triangle())),
                _ => None,
            };
            match home.filter(|home| home.iter().all(|v| !v.is_ghost())).map(turned) {
                Some(home) => {
                    marks.push(Mark::Spot(q, number(home)));
                    changed += usize::from(homes.insert(j, home) != Some(home));
                }
                None => marks.push(Mark::Dot(q, Tone::Faint)),
            }
        }
        marks.push(Mark::Dot(d.point(v), Tone::Goal));
        let caption =
            format!("{} inserted, {} to come, {changed} of them in other lists", i + 1, points.len() - i - 1);
        sketches.push(Sketch { marks, caption, ..Sketch::default() });
    }
    Ok(sketches)
}

/// An instance inserted in the order of its hints: each point is found from the instance of its hint.
pub(super) fn hints(centers: &[[f64; 2]], radius: f64, seed: u64, most: usize) -> Result<Vec<Sketch>, Error> {
    let instance = moved(centers, radius, &mut Random::new(seed));
    let mut hints = Hints2::from_points(centers, HintOrder::Random { seed })?;
    let mut seen = Seen::default();
    hints.triangulate_observed(&instance, &mut seen)?;
    let order: Vec<usize> = hints.order().collect();
    let from: Vec<usize> = hints.hints().collect();
    // What was seen before each insertion, from the last one backwards: the first ones have no walk.
    let parts: Vec<_> = std::iter::once(0)
        .chain(seen.insertions.iter().copied())
        .zip(&seen.insertions)
        .map(|(start, &end)| &seen.sights[start..end])
        .collect();
    let unseen = order.len().saturating_sub(parts.len());
    let mut d = Delaunay2::new();
    let mut sketches = Vec::new();
    for (k, &i) in order.iter().enumerate() {
        if sketches.len() >= most {
            break;
        }
        if let Some(sights) = k.checked_sub(unseen).map(|k| parts[k]).filter(|sights| !sights.is_empty()) {
            let mut marks: Vec<Mark> = sights.iter().filter_map(|(_, t)| triangle(t, Tone::Seen)).collect();
            marks.extend(centers.iter().map(|&c| Mark::Ring(c, radius, Tone::Faint)));
            marks.extend(mesh(&d, Tone::Plain));
            marks.push(Mark::Ring(centers[i], radius, Tone::Goal));
            marks.push(Mark::Line([instance[from[k]], instance[i]], Tone::Goal));
            marks.push(Mark::Dot(instance[i], Tone::Goal));
            let caption = format!("{k} inserted, visited from the hint: {}", sights.len());
            sketches.push(Sketch { marks, caption, ..Sketch::default() });
        }
        d.insert_observed(instance[i], &mut ())?;
    }
    Ok(sketches)
}

/// A triangle that was seen; a ghost has no area.
pub(super) fn triangle(corners: &[[f64; 2]], tone: Tone) -> Option<Mark> {
    (corners.len() == 3).then(|| Mark::Area(corners.to_vec(), tone))
}

/// A radius with which disks are disjoint: half of the least distance.
pub(super) fn half_of_the_nearest(centers: &[[f64; 2]]) -> Result<f64, Error> {
    let d = Delaunay2::from_points(centers)?;
    let mut least = f64::INFINITY;
    for &p in centers {
        if let [_, near] = d.k_nearest(p, 2)?[..] {
            let q = d.point(near);
            least = least.min((p[0] / 2.0 - q[0] / 2.0).hypot(p[1] / 2.0 - q[1] / 2.0));
        }
    }
    Ok(if least.is_finite() { least } else { 0.0 })
}
