//! Voronoi and power cells of space to be written: convex polyhedra, each around a site.

use std::ops::Range;

use delone::{Across3, AcrossPeriodic3, Cells3, CellularKind, DecimalGrid, PeriodicCells3, VertexId};

use crate::{Crs, Cut, Features, Solid, picture};

/// The cells of all points of an input, in its order. Those of points that have no cell have no faces: of points that equal an earlier one,
/// of hidden sites, and where nothing is left in the region.
#[derive(Debug)]
pub struct Polyhedra<'a> {
    /// The points.
    pub(crate) sites: &'a [[f64; 3]],
    /// The corners of all cells, each used. Cells in a region share them; cells that repeat have their own.
    pub(crate) vertices: Vec<[f64; 3]>,
    pub(crate) cells: Vec<Cell>,
    faces: Vec<Face>,
    corners: Vec<u32>,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// Which faces count as those of neighbors: CSV, JSON and VTU have their number if this is told.
    pub least: Option<LeastFace>,
    /// Of pictures, the plane beyond which cells are taken away, and how to draw what is left.
    pub cut: Option<Cut>,
    /// See [`Self::cut`].
    pub picture: picture::Options,
    /// The attributes of the points, which their cells have in CSV, JSON and, if they are numbers, VTU.
    pub features: Option<&'a Features>,
}

/// How large a face between two cells must be, so that these are neighbors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeastFace {
    /// In coordinate units squared.
    pub area: f64,
    /// As a part of the surface of the cell.
    pub part: f64,
}

/// Measures of a cell, and its faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    pub(crate) volume: f64,
    pub(crate) area: f64,
    pub(crate) centroid: Option<[f64; 3]>,
    /// The end of its faces.
    end: usize,
}

/// A face, and its corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    pub(crate) beyond: Beyond,
    pub(crate) area: f64,
    /// The end of its corners.
    end: usize,
}

/// The other side of a face.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Beyond {
    Wall(usize),
    Site(usize),
    /// A copy of a site, so many axes of the lattice away.
    Copy(usize, [i64; 3]),
}

impl<'a> Polyhedra<'a> {
    fn new(sites: &'a [[f64; 3]]) -> Self {
        let (vertices, cells, faces, corners) =
            (Vec::new(), Vec::with_capacity(sites.len()), Vec::new(), Vec::new());
        Self {
            sites,
            vertices,
            cells,
            faces,
            corners,
            crs: None,
            least: None,
            cut: None,
            picture: picture::Options::default(),
            features: None,
        }
    }

    /// The cells of points in a region. If they were made of integers on a grid, they are in coordinate units again.
    ///
    /// ```
    /// use delone::{Delaunay3, Region3};
    /// use delone_io::{Format, Polyhedra, write_polyhedra};
    ///
    /// let sites = [[0.5, 0.5, 0.5], [1.5, 0.5, 0.5]];
    /// let d = Delaunay3::from_points(&sites)?;
    /// let cells = d.voronoi().clip(&Region3::cuboid([0.0; 3], [2.0, 1.0, 1.0])?);
    /// let mut file = Vec::new();
    /// write_polyhedra(&mut file, Format::Text, &Polyhedra::of_cells(&sites, &cells, None))?;
    /// let header = "site,volume,area,centroid_x,centroid_y,centroid_z";
    /// assert_eq!(String::from_utf8(file)?, format!("{header}\n0,1.0,6.0,0.5,0.5,0.5\n1,1.0,6.0,1.5,0.5,0.5\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_cells(sites: &'a [[f64; 3]], cells: &Cells3, grid: Option<DecimalGrid>) -> Self {
        const UNUSED: u32 = u32::MAX;
        let length = grid.map_or(1.0, DecimalGrid::step);
        let place = |p: [f64; 3]| grid.map_or(p, |grid| p.map(|x| grid.coordinate(x)));
        let mut all = Self::new(sites);
        let mut indices = vec![UNUSED; cells.vertices().len()];
        for site in 0..sites.len() {
            let cell = cells.cell(VertexId::new(site));
            for face in cell.faces() {
                for &i in face.indices() {
                    let index = &mut indices[i as usize];
                    if *index == UNUSED {
                        *index = all.vertices.len() as u32;
                        all.vertices.push(place(cells.vertices()[i as usize]));
                    }
                    all.corners.push(*index);
                }
                let beyond = match face.across() {
                    Across3::Wall(wall) => Beyond::Wall(wall),
                    Across3::Site(other) => Beyond::Site(other.index()),
                };
                all.end_face(beyond, face.area() * length * length);
            }
            let volume = cell.volume() * length * length * length;
            all.end_cell(volume, cell.area() * length * length, cell.centroid().map(place));
        }
        all
    }

    /// The cells of points that repeat, each around its point.
    pub fn of_periodic<T: CellularKind<3, 4>>(sites: &'a [[f64; 3]], cells: &PeriodicCells3<T>) -> Self {
        let mut all = Self::new(sites);
        for site in 0..sites.len() {
            let cell = cells.cell(VertexId::new(site));
            let first = all.vertices.len();
            all.vertices.extend(cell.corners());
            for (face, ring) in cell.faces().zip(cell.rings()) {
                all.corners.extend(ring.into_iter().map(|i| (first + i) as u32));
                let beyond = match face.across() {
                    AcrossPeriodic3::Site((other, offset)) => Beyond::Copy(other.index(), offset),
                    AcrossPeriodic3::Wall { axis, is_end } => Beyond::Wall(2 * axis + usize::from(is_end)),
                };
                all.end_face(beyond, face.area());
            }
            all.end_cell(cell.volume(), cell.area(), cell.centroid());
        }
        all
    }

    /// The surface of all cells together that the cut leaves.
    pub(crate) fn solid(&self) -> Solid {
        let is_left = |site: usize| {
            let middle = self.cells[site].centroid.unwrap_or(self.sites[site]);
            let along = |cut: Cut| (0..3).map(|k| cut.normal[k] * middle[k]).sum::<f64>();
            self.cut.is_none_or(|cut| along(cut) <= cut.offset)
        };
        let left: Vec<bool> = (0..self.cells.len()).map(is_left).collect();
        let mut solid = Solid { points: self.vertices.clone(), ..Solid::default() };
        for site in self.present().filter(|&site| left[site]) {
            for (face, corners) in self.faces(site) {
                // Copies are not drawn.
                let beyond = match face.beyond {
                    Beyond::Site(other) | Beyond::Copy(other, [0, 0, 0]) => Some(other),
                    Beyond::Copy(..) | Beyond::Wall(_) => None,
                };
                if beyond.is_none_or(|other| !left[other]) {
                    solid.faces.push(corners.iter().map(|&i| i as usize).collect());
                    solid.laid_open.push(beyond.is_some());
                }
            }
        }
        solid
    }

    fn end_face(&mut self, beyond: Beyond, area: f64) {
        self.faces.push(Face { beyond, area, end: self.corners.len() });
    }

    fn end_cell(&mut self, volume: f64, area: f64, centroid: Option<[f64; 3]>) {
        self.cells.push(Cell { volume, area, centroid, end: self.faces.len() });
    }

    /// The number of cells that have faces.
    pub fn count(&self) -> usize {
        self.present().count()
    }

    /// The sum of all volumes.
    pub fn volume(&self) -> f64 {
        self.cells.iter().map(|cell| cell.volume).sum()
    }

    /// The points whose cells have faces.
    pub(crate) fn present(&self) -> impl Iterator<Item = usize> + Clone {
        (0..self.cells.len()).filter(|&site| !self.range(site).is_empty())
    }

    fn range(&self, site: usize) -> Range<usize> {
        let begin = if site == 0 { 0 } else { self.cells[site - 1].end };
        begin..self.cells[site].end
    }

    /// The faces of the cell of a point, with their corners, counter-clockwise seen from outside.
    pub(crate) fn faces(&self, site: usize) -> impl ExactSizeIterator<Item = (&Face, &[u32])> + Clone {
        self.range(site).map(|i| {
            let begin = if i == 0 { 0 } else { self.faces[i - 1].end };
            (&self.faces[i], &self.corners[begin..self.faces[i].end])
        })
    }

    /// The number of faces of all cells.
    pub(crate) fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The number of corners of all faces.
    pub(crate) fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// The corners of the cell of a point, each once, by increasing index.
    pub(crate) fn corners(&self, site: usize) -> Vec<u32> {
        let mut corners: Vec<u32> = self.faces(site).flat_map(|face| face.1).copied().collect();
        corners.sort_unstable();
        corners.dedup();
        corners
    }

    /// How many neighbors a cell has, if it is told what they are.
    pub(crate) fn neighbors(&self, site: usize) -> Option<usize> {
        let LeastFace { area, part } = self.least?;
        let least = area.max(part * self.cells[site].area);
        let is_one =
            |face: &Face| !matches!(face.beyond, Beyond::Wall(_)) && face.area > 0.0 && face.area >= least;
        Some(self.faces(site).filter(|(face, _)| is_one(face)).count())
    }

    /// The row of the attributes of a point.
    pub(crate) fn row(&self, site: usize) -> Option<usize> {
        self.features?.row(site)
    }

    /// How many points without a cell have attributes.
    pub(crate) fn rows_without_cells(&self) -> usize {
        let Some(Features { table, .. }) = self.features else { return 0 };
        let has_any = |&site: &usize| self.row(site).is_some_and(|row| table.row(row).next().is_some());
        (0..self.cells.len()).filter(|&site| self.range(site).is_empty()).filter(has_any).count()
    }

    /// Volume, area and centroid of a cell: NaN where there is none.
    pub(crate) fn measures(&self, site: usize) -> [f64; 5] {
        let Cell { volume, area, centroid, .. } = self.cells[site];
        let [x, y, z] = centroid.unwrap_or([f64::NAN; 3]);
        [volume, area, x, y, z]
    }
}
