//! Connected components, and the least radius at which a shape has few of them.
//!
//! Source of the second: the question of CGAL's `find_optimal_alpha`; here the simplices come one by one in the order of the filtration, so
//! that the answer is the least value that has what is asked for, though the number of parts goes up and down.

use super::facing::{NONE, across};
use super::{Alpha, Faces};
use crate::ids::VertexId;
use crate::sets::Sets;

/// Simplices that are joined across sides.
pub(super) fn joined<const N: usize>(across: &[[u32; N]]) -> Sets {
    let mut sets = Sets::new(across.len());
    for (i, beyond) in across.iter().enumerate() {
        for &j in beyond.iter().filter(|&&j| j != NONE) {
            sets.join(i as u32, j);
        }
    }
    sets
}

impl<const D: usize> Alpha<D> {
    /// The components of a complex: for each id the number of its component, which count from 0 by their least vertices; `None` for what is no
    /// vertex there. O(n) nearly.
    pub fn components(&self, alpha: f64) -> Vec<Option<usize>> {
        let complex = self.complex(alpha);
        let mut sets = Sets::new(self.points.len());
        for [v, w] in complex.edges {
            sets.join(v.index() as u32, w.index() as u32);
        }
        let mut labels = vec![None; self.points.len()];
        complex.vertices.iter().for_each(|[v]| labels[v.index()] = Some(0));
        let mut count = 0;
        for i in 0..labels.len() {
            if labels[i].is_some() {
                // The least one comes first.
                let least = sets.find(i as u32) as usize;
                labels[i] = if least == i { Some(count) } else { labels[least] };
                count += usize::from(least == i);
            }
        }
        labels
    }

    /// For each simplex of the highest dimension in [`Self::complex`] the number of its part: parts hang together across sides, and count from 0
    /// by their first simplices. O(k log k) for k simplices, and O(n).
    pub fn parts(&self, alpha: f64) -> Vec<usize> {
        if D == 2 {
            self.numbered(self.triangles.until(alpha))
        } else {
            self.numbered(self.tetrahedra.until(alpha))
        }
    }

    fn numbered<const N: usize>(&self, simplices: &[[VertexId; N]]) -> Vec<usize> {
        let mut sets = joined(&across(self.points.len(), simplices));
        let (mut numbers, mut count) = (Vec::with_capacity(simplices.len()), 0);
        for i in 0..simplices.len() {
            let least = sets.find(i as u32) as usize;
            let number = if least == i { count } else { numbers[least] };
            count += usize::from(least == i);
            numbers.push(number);
        }
        numbers
    }

    /// The least value at which the simplices of the highest dimension have every vertex as a corner and are at most so many parts, where
    /// parts hang together across sides. `None` for no parts, and where points span less than the whole. O(n) nearly, and memory for
    /// the sides of all simplices.
    ///
    /// ```
    /// use delone::Delaunay2;
    /// let points = [[0, 0], [2, 0], [0, 2], [20, 0], [22, 0], [20, 2]];
    /// let alpha = Delaunay2::from_points(&points)?.alpha();
    /// assert_eq!(alpha.optimal(2), Some(2.0));
    /// // One part has to reach across.
    /// assert!(alpha.optimal(1).is_some_and(|value| value > 81.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn optimal(&self, parts: usize) -> Option<f64> {
        if D == 2 { self.least(&self.triangles, parts) } else { self.least(&self.tetrahedra, parts) }
    }

    fn least<const N: usize>(&self, simplices: &Faces<N>, parts: usize) -> Option<f64> {
        let (corners, values) = (&simplices.corners, &simplices.values);
        let across = across(self.points.len(), corners);
        let mut sets = Sets::new(corners.len());
        let mut is_free = vec![true; self.points.len()];
        let (mut free, mut count) = (self.vertices.corners.len(), 0);
        for i in 0..corners.len() {
            let corner = |v: &VertexId| usize::from(std::mem::take(&mut is_free[v.index()]));
            free -= corners[i].iter().map(corner).sum::<usize>();
            count += 1;
            for &j in across[i].iter().filter(|&&j| j != NONE && (j as usize) < i) {
                count -= usize::from(sets.join(i as u32, j));
            }
            // With all that have the same value.
            let is_last = values.get(i + 1) != Some(&values[i]);
            if is_last && free == 0 && count <= parts {
                return Some(values[i]);
            }
        }
        None
    }
}
