//! Meshes that list points, and lines, triangles and tetrahedra with a number each: what readers of such formats find.

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
    pub(crate) triangles: Rows<3>,
    pub(crate) tetrahedra: Rows<4>,
    pub(crate) names: Names,
    pub(crate) losses: Vec<String>,
}

impl Listed {
    /// Adds an element by its corners, which must be points.
    pub(crate) fn push(&mut self, format: &str, corners: &[u64], number: i64) -> Result<(), Error> {
        let count = self.points.len();
        if let Some(corner) = corners.iter().find(|&&corner| corner >= count as u64) {
            return Err(Error::content(format!(
                "{format}: an element has corner {corner} from 0, but there are {count} points"
            )));
        }
        match *corners {
            [a, b] => self.lines.push(([a, b], number)),
            [a, b, c] => self.triangles.push(([a, b, c], number)),
            [a, b, c, d] => self.tetrahedra.push(([a, b, c, d], number)),
            _ => {}
        }
        Ok(())
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
    pub(crate) fn regions(&self) -> Attributes {
        let is_known = self.triangles.iter().any(|triangle| triangle.1 != 0);
        let values = self.triangles.iter().filter(|_| is_known).map(|triangle| triangle.1 as f64).collect();
        Attributes { width: usize::from(is_known), values }
    }
}

/// The corners of elements alone.
pub(crate) fn corners<const N: usize>(rows: Rows<N>) -> Vec<[u64; N]> {
    rows.into_iter().map(|row| row.0).collect()
}
