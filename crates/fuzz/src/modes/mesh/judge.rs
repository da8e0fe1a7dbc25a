//! The judge of meshes, over integers. Where the engine rounds what it measures (areas, lengths, cosines) a few units in
//! the last place are left to it; topology, counts and what is kept are judged without any.

use std::collections::{BTreeMap, BTreeSet};

use delone::{Constrained2, EdgeId, Error, Fill, Keep, Reason, Refined2, SegmentId, TriangleId, VertexId};
use delone_oracle::certificate::certify;
use delone_oracle::exact::{angle, compare_lengths, is_angle_at_least};
use num_bigint::BigInt;

use super::wish::Wish;
use crate::attack::Judgement;
use crate::oracle::exact::{Vector, determinant, dot, integers, minus};

type Point = [f64; 2];

/// For vertices on constraints the ends of these, as they were before the first refinement.
pub(super) type Lines = BTreeMap<VertexId, [VertexId; 2]>;

/// A refinement that is judged.
pub(super) struct Case<'a> {
    pub(super) before: &'a Constrained2,
    pub(super) after: &'a Constrained2,
    pub(super) wish: &'a Wish,
    pub(super) fill: Fill<'a>,
    /// The lines of the vertices from before.
    pub(super) lines: &'a Lines,
    /// The segments of before that only kept triangles, and may be gone.
    pub(super) kept: &'a [SegmentId],
}

/// The part of a mesh that must not depend on the order of the input: triangles inside, and those left with reasons.
type Said = (Vec<[Point; 3]>, Vec<([Point; 3], Reason)>, [usize; 3], [u64; 2]);

pub(super) fn said(c: &Constrained2, refined: &Refined2) -> Said {
    let inside = c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
    let inside = delone_oracle::brute::normalized(inside.map(|t| corners(c, t)));
    let report = &refined.report;
    let one = |t| delone_oracle::brute::normalized([corners(c, t)])[0];
    let mut left: Vec<([Point; 3], Reason)> =
        report.left.iter().map(|left| (one(left.triangle), left.reason)).collect();
    left.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
    let counts = [report.inside, report.on_constraints, report.triangles];
    (inside, left, counts, [report.smallest_angle, report.largest_angle].map(f64::to_bits))
}

fn corners(c: &Constrained2, t: TriangleId) -> [Point; 3] {
    c.mesh().corners(t).map(|v| c.point(v))
}

/// The edges of a mesh that are constraints, by increasing ids.
fn edges(c: &Constrained2) -> BTreeSet<[VertexId; 2]> {
    c.constraints().collect()
}

/// Whether it is the constrained Delaunay triangulation of the vertices and constraints that it has.
pub(super) fn is_valid(c: &Constrained2) -> Judgement {
    c.check().map_err(|flaw| format!("check: {flaw:?}"))?;
    let vertices: Vec<VertexId> = c.vertices().collect();
    let index = |v: VertexId| vertices.binary_search(&v).expect("a vertex");
    let points: Vec<Point> = vertices.iter().map(|&v| c.point(v)).collect();
    let rows: Vec<[usize; 3]> = c.triangles().map(|t| t.map(index)).collect();
    let mut constraints: Vec<[usize; 2]> = c.constraints().map(|ends| ends.map(index)).collect();
    constraints.sort_unstable();
    match certify(&points, &constraints, &rows) {
        Err(flaw) => Err(format!("certificate: {flaw:?}")),
        Ok(found) if found != constraints => Err(format!("constraints {constraints:?} are {found:?}")),
        Ok(_) => Ok(()),
    }
}

/// A unit in the last place of the largest coordinate.
fn unit(c: &Constrained2) -> f64 {
    let largest = c.points().iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    largest - largest.next_down()
}

fn product(p: &[Vector], [a, b, q]: [usize; 3]) -> BigInt {
    determinant(&[minus(&p[b], &p[a]), minus(&p[q], &p[a])])
}

/// Whether a point is at most so far from a line through two others, and less than twice that where the line is diagonal.
fn is_near(q: Point, [a, b]: [Point; 2], distance: f64) -> bool {
    let p = integers(&[a, b, q, [distance, 0.0]]);
    let along: BigInt = minus(&p[1], &p[0]).iter().map(|x| BigInt::from(x.magnitude().clone())).sum();
    BigInt::from(product(&p, [0, 1, 2]).magnitude().clone()) <= along * &p[3][0]
}

/// Whether the way from `p` to `q` leads forward along `a` to `b`.
fn is_forward([p, q]: [Point; 2], [a, b]: [Point; 2]) -> bool {
    let i = integers(&[p, q, a, b]);
    dot(&minus(&i[1], &i[0]), &minus(&i[3], &i[2])) > BigInt::ZERO
}

/// Twice an area is at most twice another one.
fn is_area_at_most([a, b, c]: [Point; 3], most: f64) -> bool {
    let p = integers(&[a, b, c, [1.0, most]]);
    product(&p, [0, 1, 2]) <= 2 * &p[3][0] * &p[3][1]
}

fn sides([a, b, c]: [Point; 3]) -> [[Point; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Whether the squares of sides are what can be calculated with.
fn is_measurable(t: [Point; 3]) -> bool {
    let square = |[p, q]: [Point; 2]| (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2);
    sides(t).into_iter().all(|side| (1e-280..1e280).contains(&square(side)))
}

/// Compares angles with a bound; `slack` allows for the rounding of a cosine.
fn has_angles([a, b, c]: [Point; 3], degrees: f64, slack: f64) -> bool {
    let cosine = degrees.to_radians().cos();
    let bound = cosine * cosine * (1.0 + slack);
    [(a, b, c), (b, c, a), (c, a, b)].into_iter().all(|(o, p, q)| is_angle_at_least(o, p, q, bound))
}

impl Case<'_> {
    /// Judges what was said, and what there is. Gives the lines of all vertices.
    pub(super) fn judge(&self, answer: &Result<Refined2, Error>) -> Result<Lines, String> {
        is_valid(self.after)?;
        for v in self.before.vertices() {
            if !self.after.vertices().any(|w| w == v) || self.after.point(v) != self.before.point(v) {
                return Err(format!("{v:?} is lost"));
            }
        }
        let along = self.chains()?;
        let line = |ends: &[VertexId; 2]| *ends.iter().find_map(|end| self.lines.get(end)).unwrap_or(ends);
        let mut lines: Lines = along.iter().map(|(&v, ends)| (v, line(ends))).collect();
        lines.extend(self.lines);
        match answer {
            Ok(refined) => self.judge_mesh(refined, along.len(), &lines)?,
            Err(Error::Stopped) if self.wish.stop.is_some() => {}
            Err(Error::Size { value, .. }) if self.wish.none_beyond.is_some() && value.is_nan() => {}
            Err(Error::Seed { .. }) if self.before.domains(&self.fill).is_err() => {
                if edges(self.before) != edges(self.after) || self.before.points() != self.after.points() {
                    return Err("a wrong seed, and yet a change".to_owned());
                }
            }
            Err(error) => return Err(format!("error: {error}")),
        }
        Ok(lines)
    }

    /// Every segment is covered as before, by edges that lead from end to end of each edge of before, near to it. Gives for each
    /// new vertex on constraints the ends of the edge that it is on.
    fn chains(&self) -> Result<Lines, String> {
        let (c, unit) = (self.after, unit(self.after));
        let constraints = edges(c);
        let sorted = |v: VertexId, w: VertexId| [v.min(w), v.max(w)];
        let (mut along, mut covered) = (BTreeMap::new(), BTreeSet::new());
        let before: BTreeMap<_, _> = self.before.segments().collect();
        for (s, ends) in c.segments() {
            let chain = c.chain(s).ok_or(format!("{s:?} has no chain"))?;
            let old = match before.get(&s) {
                Some(_) => self.before.chain(s).ok_or(format!("{s:?} had no chain"))?,
                None => ends.into(),
            };
            let mut rest = chain.iter().copied().peekable();
            if rest.next() != old.first().copied() {
                return Err(format!("{s:?} begins elsewhere"));
            }
            for link in old.windows(2) {
                let line = [link[0], link[1]].map(|v| c.point(v));
                let mut from = link[0];
                loop {
                    let to = rest.next().ok_or(format!("{s:?} lost {:?}", link[1]))?;
                    if !constraints.contains(&sorted(from, to)) {
                        return Err(format!("{s:?}: no constraint from {from:?} to {to:?}"));
                    }
                    covered.insert(sorted(from, to));
                    if !is_forward([from, to].map(|v| c.point(v)), line) {
                        return Err(format!("{s:?}: back from {from:?} to {to:?}"));
                    }
                    if to == link[1] {
                        break;
                    }
                    if to.index() < self.before.points().len() {
                        return Err(format!("{s:?} goes through {to:?} now"));
                    }
                    if !is_near(c.point(to), line, BEND * unit) {
                        return Err(format!("{to:?} {:?} is far from {line:?}", c.point(to)));
                    }
                    along.insert(to, sorted(link[0], link[1]));
                    from = to;
                }
            }
            if rest.next().is_some() {
                return Err(format!("{s:?} is too long"));
            }
        }
        if covered != constraints {
            return Err("constraints that are of no segment".to_owned());
        }
        if before.len() - self.kept.len() > c.segments().count() {
            return Err("segments are lost".to_owned());
        }
        Ok(along)
    }

    fn judge_mesh(&self, refined: &Refined2, on: usize, lines: &Lines) -> Judgement {
        let (c, report, wish) = (self.after, &refined.report, self.wish);
        let added = c.vertex_count() - self.before.vertex_count();
        if added > wish.most || [report.inside, report.on_constraints] != [added - on, on] {
            return Err(format!(
                "{added} vertices, {on} on constraints, not {} and {}",
                report.inside, report.on_constraints
            ));
        }
        self.judge_kept(refined)?;
        self.judge_area(refined)?;
        let inside = c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        let (layers, inside): (Vec<TriangleId>, Vec<TriangleId>) =
            inside.partition(|&t| refined.domains.is_layer(t));
        if report.layers.triangles != layers.len() {
            return Err(format!("{} triangles of layers, {:?}", layers.len(), report.layers));
        }
        let left: BTreeMap<TriangleId, Reason> =
            report.left.iter().map(|left| (left.triangle, left.reason)).collect();
        if report.triangles != inside.len() + layers.len() || report.left.len() != left.len() {
            return Err(format!("{} triangles, {} said, or left twice", inside.len(), report.triangles));
        }
        if let Some(t) = left.keys().find(|t| !inside.contains(t)) {
            return Err(format!("{t:?} is left, but not inside"));
        }
        for &t in &inside {
            self.judge_triangle(refined, t, left.get(&t).copied(), added, lines)
                .map_err(|what| format!("{:?}, {:?}: {what}", corners(c, t), left.get(&t)))?;
        }
        let measured: Vec<TriangleId> =
            inside.iter().copied().filter(|&t| is_measurable(corners(c, t))).collect();
        let counted = [report.smallest_angles.iter().sum(), report.angles.iter().sum::<usize>() / 3];
        if counted != [measured.len(); 2] {
            return Err(format!("{counted:?} in the histograms instead of {}", measured.len()));
        }
        for angle in [report.smallest_angle - 1e-9, report.smallest_angle + 1e-9] {
            // Near zero a cosine says too little.
            let all = || measured.iter().all(|&t| has_angles(corners(c, t), angle, 0.0));
            if angle > 1.0 && all() != (angle < report.smallest_angle) {
                return Err(format!("the smallest angle is not {}", report.smallest_angle));
            }
        }
        Ok(())
    }

    /// Whether an edge of before is a constraint only to keep triangles.
    fn only_keeps(&self, ends: [VertexId; 2]) -> bool {
        !self.kept.is_empty()
            && self
                .before
                .segments()
                .all(|(s, of)| of.iter().any(|v| !ends.contains(v)) || self.kept.contains(&s))
    }

    /// Judges that everything to be kept is there.
    fn judge_kept(&self, refined: &Refined2) -> Judgement {
        let is_split = |e: &[VertexId; 2]| !self.after.constraints().any(|edge| edge == *e);
        if self.wish.keep == Keep::Constraints
            && (refined.report.on_constraints > 0
                || edges(self.before).iter().filter(|e| !self.only_keeps(**e)).any(is_split))
        {
            return Err("constraints are split".to_owned());
        }
        if self.wish.keep == Keep::Border {
            let (c, mesh) = (self.before, self.before.mesh());
            let domains = c.domains(&self.fill).map_err(|error| error.to_string())?;
            let is_between =
                |e: EdgeId| domains.is_inside(e.triangle()) && domains.is_inside(mesh.twin(e).triangle());
            let ends = |e: EdgeId| {
                let [v, w] = [mesh.origin(e), mesh.destination(e)];
                [v.min(w), v.max(w)]
            };
            let border = c.constraint_edges().filter(|&e| !is_between(e)).map(ends);
            let border = border.filter(|e| !self.only_keeps(*e));
            if let Some(edge) = border.into_iter().find(is_split) {
                return Err(format!("{edge:?} of the border is split"));
            }
        }
        Ok(())
    }

    /// As much is inside as before, but for what a bend of borders makes.
    fn judge_area(&self, refined: &Refined2) -> Judgement {
        let c = self.after;
        let domains = self.before.domains(&self.fill).map_err(|error| error.to_string())?;
        let kind = |part: &delone::Part2| (part.is_inside, part.winding, part.region);
        let kinds = |parts: &[delone::Part2]| parts.iter().map(kind).collect::<Vec<_>>();
        let (old_parts, new_parts) = (domains.parts(), refined.domains.parts());
        let more = new_parts.get(old_parts.len()..).ok_or("fewer parts")?;
        if kinds(old_parts) != kinds(&new_parts[..old_parts.len()])
            || !more.iter().all(|part| part.is_layer && kinds(old_parts).contains(&kind(part)))
        {
            return Err("other parts".to_owned());
        }
        // The vertices of before are here, too.
        let mut points = c.points().to_vec();
        points.push([1e-9, 1.0]);
        points.push([BEND * unit(c), 0.0]);
        let exact = integers(&points);
        let ([part, one], bend) =
            ([0, 1].map(|k| &exact[c.points().len()][k]), &exact[c.points().len() + 1][0]);
        let length = |e: EdgeId| {
            let [v, w] = [c.mesh().origin(e), c.mesh().destination(e)].map(|v| &exact[v.index()]);
            minus(v, w).iter().map(|x| BigInt::from(x.magnitude().clone())).sum::<BigInt>()
        };
        let border: BigInt = c.constraint_edges().map(length).sum();
        // Layers are parts of their own, of the same kind as the part around them.
        let is_layered = !more.is_empty();
        let twice = |c: &Constrained2, domains: &delone::Domains2| {
            let mut areas = BTreeMap::new();
            for t in c.triangle_ids() {
                let Some(part) = domains.part(t) else { continue };
                let own = (if is_layered { 0 } else { part }, kind(&domains.parts()[part]));
                let area = product(&exact, c.mesh().corners(t).map(|v| v.index()));
                *areas.entry(own).or_insert_with(BigInt::default) += area;
            }
            areas
        };
        let (mut old, new) = (twice(self.before, &domains), twice(c, &refined.domains));
        for key in new.keys() {
            old.entry(*key).or_default();
        }
        for (key, old) in &old {
            let new = new.get(key).cloned().unwrap_or_default();
            let off = BigInt::from((old - &new).magnitude().clone());
            if off * one > old * part + 2 * bend * &border * one {
                return Err(format!("part {key:?} had {old} and has {new}"));
            }
        }
        Ok(())
    }

    /// A triangle is as it was asked for, or left, and then it is not.
    fn judge_triangle(
        &self,
        refined: &Refined2,
        t: TriangleId,
        left: Option<Reason>,
        added: usize,
        lines: &Lines,
    ) -> Judgement {
        let (wish, points) = (self.wish, corners(self.after, t));
        let is_certainly = |slack: f64| {
            has_angles(points, wish.min_angle, slack)
                && self.is_small(points, wish.area_of(refined.domains.region(t)), slack)
                && (!wish.conforming || !self.is_encroached(refined, t))
        };
        match left {
            None if !is_measurable(points) => Err("is not measured, and not left".to_owned()),
            None if !is_certainly(ROUNDED) => Err("is not left".to_owned()),
            Some(Reason::Precision) if !is_measurable(points) => Ok(()),
            Some(_) if is_certainly(-ROUNDED) => Err("is left for nothing".to_owned()),
            Some(Reason::Budget) if added < wish.most => Err(format!("only {added} of {}", wish.most)),
            Some(Reason::Kept) if wish.keep == Keep::Nothing && refined.report.layers.triangles == 0 => {
                Err("nothing is to be kept".to_owned())
            }
            Some(Reason::InputAngle) if !self.is_forced(t, lines) => Err("no angle of the input".to_owned()),
            _ => Ok(()),
        }
    }

    /// Whether a triangle has the area and the edges that were asked for, with some slack.
    fn is_small(&self, points: [Point; 3], area: Option<f64>, slack: f64) -> bool {
        let longest = |length: f64| {
            let most = length * (1.0 + slack);
            most > 0.0
                && (most.is_infinite()
                    || sides(points)
                        .into_iter()
                        .all(|side| compare_lengths(side, [[0.0; 2], [most, 0.0]]) <= 0))
        };
        // Products of sides are rounded, and the area is their difference.
        let length = |[p, q]: [Point; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
        let rounded = slack * sides(points).map(length).into_iter().fold(0.0, f64::max).powi(2);
        let largest = |area: f64| {
            let most = area * (1.0 + slack) + rounded;
            most > 0.0 && (most.is_infinite() || is_area_at_most(points, most))
        };
        let center = [0, 1].map(|k| points.iter().map(|p| p[k] / 3.0).sum::<f64>());
        // What is asked for at the centroid is asked for at a rounded one.
        let field = |field: super::wish::Field| {
            field.at(center) + 8.0 * slack.signum() * field.slope * unit(self.after)
        };
        self.wish.max_edge.is_none_or(longest)
            && area.is_none_or(largest)
            && self.wish.size.map(field).is_none_or(longest)
            && self.wish.area.map(field).is_none_or(largest)
    }

    /// Whether a constraint, or the last line of a layer, sees the far corner of its triangle inside of its diametral circle.
    fn is_encroached(&self, refined: &Refined2, t: TriangleId) -> bool {
        let (c, mesh) = (self.after, self.after.mesh());
        let is_layer = |e: delone::EdgeId| refined.domains.is_layer(e.triangle());
        let only_keeps = |e| {
            let is_kept = c.covering(e).iter().all(|one| refined.kept.contains(&one.segment));
            is_kept && !is_layer(mesh.twin(e))
        };
        [0, 1, 2].map(|k| t.edge(k)).into_iter().any(|e| {
            let [o, a, b] = [mesh.apex(e), mesh.origin(e), mesh.destination(e)].map(|v| c.point(v));
            c.is_constraint(e) && angle(o, a, b) < 0 && !only_keeps(e)
        })
    }

    /// Whether a shortest edge joins new vertices on two constraints that meet.
    fn is_forced(&self, t: TriangleId, lines: &Lines) -> bool {
        let v = self.after.mesh().corners(t);
        [[v[0], v[1]], [v[1], v[2]], [v[2], v[0]]].into_iter().any(|[p, q]| {
            let (Some(p), Some(q)) = (lines.get(&p), lines.get(&q)) else { return false };
            p != q && p.iter().any(|end| q.contains(end))
        })
    }
}

/// The largest distance of a new vertex from its constraint, in units in the last place of the largest coordinate.
const BEND: f64 = 4.0;
/// The largest rounding error of a quotient of squares.
const ROUNDED: f64 = 1e-13;
