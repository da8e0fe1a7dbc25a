//! How many rows there is room for.
//!
//! Between two ribs is a column. Its outline, made higher by a part of the length of its sides, is a convex polygon; it keeps apart from
//! those of other columns and from constraints and vertices, decided exactly, or else both columns lose a row. Neighbors have at most one row
//! more; between them is a triangle. Rows only become fewer, so it ends.
//!
//! Cost: O(n log n) for n columns and constraints, as many times as rows are lost at one place.

use crate::error::Error;
use crate::ids::Place;

use super::super::mesher::Mesher;
use super::chains::Chains;
use super::polygon::{are_apart, is_convex, leads_away};
use super::ribs::Ribs;
use crate::plane::boxes::{Boxes, span};

/// The space that columns keep before themselves, in lengths of sides: half of what is between two, so that an edge there is 0.6 long.
const BEFORE_COLUMNS: f64 = 0.3;
/// The space before constraints without rows.
const BEFORE_CONSTRAINTS: f64 = 0.6;

/// A column between two ribs, each a wedge with the index of its rib: the one on the left of who looks along the border comes last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub(super) tail: (usize, usize),
    pub(super) head: (usize, usize),
}

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) chains: Chains,
    pub(super) ribs: Vec<Ribs>,
    pub(super) columns: Vec<Column>,
    /// The distances of lines from the border, 0 first.
    pub(super) heights: Vec<f64>,
    /// The rows at each wedge.
    pub(super) rows: Vec<usize>,
}

impl Plan {
    /// As many rows as were asked for.
    pub(super) fn new(chains: Chains, heights: Vec<f64>) -> Self {
        let most = heights.len() - 1;
        let last = heights[most] - heights[most.saturating_sub(1)];
        let ribs = super::ribs::all(&chains, heights[most], last);
        let rows = ribs.iter().map(|ribs| if ribs.steps.is_empty() { 0 } else { most }).collect();
        let mut columns = Vec::new();
        for run in &chains.runs {
            let [tail, head] = run.wedges;
            columns.push(Column { tail: (tail, ribs[tail].steps.len().saturating_sub(1)), head: (head, 0) });
        }
        for (wedge, ribs) in ribs.iter().enumerate() {
            let fan = (1..ribs.steps.len()).map(|rib| Column { tail: (wedge, rib - 1), head: (wedge, rib) });
            columns.extend(fan);
        }
        let mut plan = Self { chains, ribs, columns, heights, rows };
        plan.even_out();
        plan
    }

    /// A place on a rib, at a distance from the border.
    fn on(&self, (wedge, rib): (usize, usize), height: f64) -> [f64; 2] {
        let at = self.chains.wedges[wedge].at;
        match self.ribs[wedge].steps.get(rib) {
            Some(step) if height > 0.0 => [0, 1].map(|k| at[k] + height * step[k]),
            _ => at,
        }
    }

    /// The place of a line between rows on a rib.
    pub(super) fn line_on(&self, rib: (usize, usize), line: usize) -> [f64; 2] {
        self.on(rib, self.heights[line])
    }

    /// The base, then the places at which ribs end, with so much more space before them; without what is there twice.
    fn outline(&self, column: &Column, space: f64) -> Vec<[f64; 2]> {
        let top = |rib: (usize, usize)| match self.rows[rib.0] {
            0 => self.on(rib, 0.0),
            rows => self.on(rib, self.heights[rows] + space * self.chains.spacing(rib.0)),
        };
        let [tail, head] = [column.tail, column.head];
        let mut corners = vec![self.on(tail, 0.0), self.on(head, 0.0), top(head), top(tail)];
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        corners
    }

    /// How many rows a column has.
    fn rows_of(&self, column: &Column) -> usize {
        self.rows[column.tail.0].max(self.rows[column.head.0])
    }

    /// Whether all cells of a column are convex.
    fn has_cells(&self, column: &Column) -> bool {
        let [low, high] = self.rows_between(column);
        let corners = |line: usize| [column.tail, column.head].map(|rib| self.line_on(rib, line));
        let is_whole = (0..low).all(|line| {
            let ([a, b], [d, c]) = (corners(line), corners(line + 1));
            if a == b { is_convex(&[a, c, d]) } else { is_convex(&[a, b, c, d]) }
        });
        let is_last = |line: usize| {
            let ([a, b], [d, c]) = (corners(line), corners(line + 1));
            is_convex(&[a, b, if self.rows[column.tail.0] > low { d } else { c }])
        };
        is_whole && (low == high || is_last(low))
    }

    /// The rows that both ribs of a column have, and that one has.
    pub(super) fn rows_between(&self, column: &Column) -> [usize; 2] {
        let rows = [column.tail, column.head].map(|rib| self.rows[rib.0]);
        [rows[0].min(rows[1]), rows[0].max(rows[1])]
    }

    /// Takes rows until each wedge has at most one more than its neighbors.
    pub(super) fn even_out(&mut self) {
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        // From few rows to many.
        order.sort_unstable_by_key(|&wedge| self.rows[wedge]);
        let mut rest: Vec<usize> = order.into_iter().rev().collect();
        while let Some(wedge) = rest.pop() {
            for is_after in [false, true] {
                let Some((next, _)) = self.chains.beyond(wedge, is_after) else { continue };
                if self.rows[next] > self.rows[wedge] + 1 {
                    self.rows[next] = self.rows[wedge] + 1;
                    rest.push(next);
                }
            }
        }
    }

    /// Takes a row from the ribs of some columns.
    pub(super) fn take_from(&mut self, columns: &[usize]) {
        let mut wedges: Vec<usize> =
            columns.iter().flat_map(|&k| [self.columns[k].tail.0, self.columns[k].head.0]).collect();
        wedges.sort_unstable();
        wedges.dedup();
        wedges.into_iter().for_each(|wedge| self.rows[wedge] = self.rows[wedge].saturating_sub(1));
        self.even_out();
    }

    /// Takes rows until all have room, and there are at most so many vertices.
    pub(super) fn fit(&mut self, mesher: &Mesher, most: usize) -> Result<(), Error> {
        let obstacles = Obstacles::of(mesher);
        loop {
            mesher.rules.go_on(mesher.count)?;
            let narrow = self.narrow(&obstacles);
            if narrow.is_empty() {
                break;
            }
            self.take_from(&narrow);
        }
        while self.vertex_count() > most {
            let limit = self.rows.iter().copied().max().unwrap_or(0).saturating_sub(1);
            self.rows.iter_mut().for_each(|rows| *rows = (*rows).min(limit));
        }
        Ok(())
    }

    fn vertex_count(&self) -> usize {
        let each = self.rows.iter().zip(&self.ribs).map(|(rows, ribs)| rows.saturating_mul(ribs.steps.len()));
        each.fold(0, usize::saturating_add)
    }

    /// The columns without room.
    fn narrow(&self, obstacles: &Obstacles) -> Vec<usize> {
        let mut narrow = vec![false; self.columns.len()];
        let with_rows: Vec<usize> =
            (0..self.columns.len()).filter(|&k| self.rows_of(&self.columns[k]) > 0).collect();
        let mut outlines = Vec::new();
        for &k in &with_rows {
            let column = &self.columns[k];
            let [near, far] = [BEFORE_COLUMNS, BEFORE_CONSTRAINTS].map(|space| self.outline(column, space));
            narrow[k] = !self.has_cells(column)
                || !is_convex(&near)
                || !self.is_within_followed(column)
                || self.meets(column, if is_convex(&far) { &far } else { &near }, obstacles);
            outlines.push(near);
        }
        let boxes = Boxes::new(outlines.iter().map(|outline| span(outline)).collect());
        let is_good = |outline: &[[f64; 2]]| outline.iter().flatten().all(|x| x.is_finite());
        for (i, &k) in with_rows.iter().enumerate().filter(|(i, _)| is_good(&outlines[*i])) {
            boxes.each(&span(&outlines[i]), |j| {
                let l = with_rows[j];
                if j > i
                    && is_good(&outlines[j])
                    && !self.are_neighbors(k, l)
                    && !are_apart(&outlines[i], &outlines[j])
                {
                    (narrow[k], narrow[l]) = (true, true);
                }
            });
        }
        (0..narrow.len()).filter(|&k| narrow[k]).collect()
    }

    /// Whether two columns have a vertex of the border in common. What parts them there are ribs or constraints.
    fn are_neighbors(&self, k: usize, l: usize) -> bool {
        let bases = |k: usize| {
            let column = &self.columns[k];
            [column.tail.0, column.head.0].map(|wedge| self.chains.wedges[wedge].base)
        };
        bases(k).iter().any(|base| bases(l).contains(base))
    }

    /// Whether ribs on a constraint end before it does, with space.
    fn is_within_followed(&self, column: &Column) -> bool {
        [column.tail, column.head].into_iter().all(|(wedge, rib)| {
            let own = &self.chains.wedges[wedge];
            if !self.ribs[wedge].follows || self.rows[wedge] == 0 {
                return true;
            }
            let end = own.beyond[usize::from(own.sides[1].is_none())];
            let high = self.heights[self.rows[wedge]] + BEFORE_CONSTRAINTS * self.chains.spacing(wedge);
            super::length(own.at, self.on((wedge, rib), high)) < super::length(own.at, end)
        })
    }

    /// Whether a polygon of a column meets constraints or vertices.
    fn meets(&self, column: &Column, polygon: &[[f64; 2]], obstacles: &Obstacles) -> bool {
        let base = [column.tail.0, column.head.0].map(|wedge| self.chains.wedges[wedge].base);
        let followed = [column.tail.0, column.head.0].map(|wedge| {
            let own = &self.chains.wedges[wedge];
            own.beside.filter(|_| self.ribs[wedge].follows && self.rows[wedge] > 0).map(|end| [own.base, end])
        });
        let is_own = |[v, w]: [Place; 2]| {
            let all = followed.iter().flatten().chain([&base]);
            all.into_iter().any(|own| *own == [v, w] || *own == [w, v])
        };
        let mut is_met = false;
        obstacles.boxes.each(&span(polygon), |k| {
            let (ends, places) = &obstacles.all[k];
            if is_met || is_own(*ends) {
                return;
            }
            let [one, other] = [base.contains(&ends[0]), base.contains(&ends[1])];
            is_met = match (one, other) {
                (true, true) => false,
                (true, false) => !leads_away(polygon, places[0], places[1]),
                (false, true) => !leads_away(polygon, places[1], places[0]),
                (false, false) if ends[0] == ends[1] => !are_apart(polygon, &places[..1]),
                (false, false) => !are_apart(polygon, places),
            };
        });
        is_met
    }
}

/// Constraints, and vertices without any, which have one place twice.
struct Obstacles {
    all: Vec<([Place; 2], [[f64; 2]; 2])>,
    boxes: Boxes,
}

impl Obstacles {
    fn of(mesher: &Mesher) -> Self {
        let mesh = &mesher.layer.mesh;
        let constraints = mesh.fixed_edges().map(|e| [mesh.tail(e), mesh.head(e)]);
        let is_alone = |p: &Place| !mesh.spokes(*p).any(|e| mesh.is_fixed(e));
        let ends = constraints.chain(mesh.inhabited().filter(is_alone).map(|p| [p; 2]));
        let all: Vec<_> = ends.map(|ends| (ends, ends.map(|p| mesher.point(p)))).collect();
        let boxes = Boxes::new(all.iter().map(|obstacle| span(&obstacle.1)).collect());
        Self { all, boxes }
    }
}
