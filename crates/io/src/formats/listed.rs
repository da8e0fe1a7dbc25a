//! Meshes that list points, and lines, triangles, quadrilaterals and tetrahedra with a number each: what readers of such formats find.

use super::quads::Quads;
use crate::{Attributes, Cloud, Error, Graph, Names};

/// Elements of so many corners, as indices of points from 0, each with its number.
type Rows<const N: usize> = Vec<([u64; N], i64)>;

/// A mesh as its file lists it.
#[derive(Debug, Default)]
pub(crate) struct Listed {
    pub(crate) points: Vec<[f64; 3]>,
    /// Whether the third coordinate is in the file.
    pub(crate) has_heights: bool,
    pub(crate) lines: Rows<2>,
    triangles: Rows<3>,
    pub(crate) quads: Quads,
    pub(crate) tetrahedra: Rows<4>,
    pub(crate) names: Names,
    pub(crate) losses: Vec<String>,
}

impl Listed {
    /// Adds a simplex by its corners, which must be points.
    pub(crate) fn push(&mut self, format: &str, corners: &[u64], number: i64) -> Result<(), Error> {
        self.judge(format, corners)?;
        match *corners {
            [a, b] => self.lines.push(([a, b], number)),
            [a, b, c] => self.triangles.push(([a, b, c], number)),
            [a, b, c, d] => self.tetrahedra.push(([a, b, c, d], number)),
            _ => {}
        }
        Ok(())
    }

    /// Adds a quadrilateral in the same way.
    pub(crate) fn push_quad(&mut self, format: &str, corners: [u64; 4], number: i64) -> Result<(), Error> {
        self.judge(format, &corners)?;
        self.quads.push(self.triangles.len(), corners, number);
        Ok(())
    }

    fn judge(&self, format: &str, corners: &[u64]) -> Result<(), Error> {
        let count = self.points.len();
        if let Some(corner) = corners.iter().find(|&&corner| corner >= count as u64) {
            return Err(Error::content(format!(
                "{format}: an element has corner {corner} from 0, but there are {count} points"
            )));
        }
        Ok(())
    }

    /// The triangles with their numbers, and two for each quadrilateral.
    pub(crate) fn triangles(&mut self, format: &str) -> Result<Rows<3>, Error> {
        let place = |i: u64| [0, 1].map(|k| self.points[i as usize][k]);
        self.quads.among(format, std::mem::take(&mut self.triangles), place)
    }

    /// The points.
    pub(crate) fn cloud(self) -> Cloud {
        let mut cloud = Cloud::with_capacity(self.points.len(), self.has_heights);
        self.points.iter().for_each(|&[x, y, z]| cloud.push([x, y], z));
        cloud.losses = self.losses;
        if self.lines.iter().any(|line| line.1 != 0) {
            cloud.losses.push("markers of lines are left out".to_owned());
        }
        cloud
    }

    /// The points, and the lines between them as segments, which are borders.
    pub(crate) fn graph(mut self) -> Graph {
        let lines = std::mem::take(&mut self.lines);
        let names = std::mem::take(&mut self.names);
        let segments: Vec<[usize; 2]> = lines.iter().map(|line| line.0.map(|end| end as usize)).collect();
        let has_markers = lines.iter().any(|line| line.1 != 0);
        let markers = has_markers.then(|| lines.iter().map(|line| line.1).collect());
        let is_border = vec![true; segments.len()];
        Graph { segments, is_border, markers, names, ..Graph::of_points(self.cloud()) }
    }

    /// The numbers of the triangles; nothing if all are 0.
    pub(crate) fn regions(&mut self, format: &str) -> Result<Attributes, Error> {
        let triangles = self.triangles(format)?;
        let is_known = triangles.iter().any(|triangle| triangle.1 != 0);
        let values = triangles.iter().filter(|_| is_known).map(|triangle| triangle.1 as f64).collect();
        Ok(Attributes { width: usize::from(is_known), values })
    }
}

/// The corners of elements alone.
pub(crate) fn corners<const N: usize>(rows: Rows<N>) -> Vec<[u64; N]> {
    rows.into_iter().map(|row| row.0).collect()
}
