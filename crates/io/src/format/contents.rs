//! Contents of files, and their readers.

use std::fmt;

use crate::chunks::Chunks;
use crate::formats::poly::Beside;
use crate::formats::shapes::{Purpose, Shapes};
use crate::{Cloud, Error, Graph, Raster, ReadOptions, Rings, Source};

/// A kind of thing that a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Contents {
    /// Points of the plane or of space.
    Points,
    /// Points that are read a part at a time, so that they need not fit into memory.
    Pieces,
    /// Points with lines, rings and polygons between them.
    Lines,
    /// Segments as pairs of indices of points.
    Segments,
    /// Polygons.
    Polygons,
    /// A number for each point.
    Numbers,
    /// Rows of indices.
    Indices,
    /// Answers to queries, with the places and the attributes of these.
    Answers,
    /// Triangles between points, or a triangulation of the plane.
    Triangles,
    /// A triangulation of the plane of second order: with a node on each edge.
    SecondOrder,
    /// Triangles of the plane, and quadrilaterals of two triangles each.
    Quads,
    /// The largest area that each triangle may have.
    Areas,
    /// Tetrahedra between points, or a triangulation of space or its border.
    Tetrahedra,
    /// Closed surfaces in space.
    Surfaces,
    /// Voronoi cells.
    Cells,
    /// Voronoi cells of space.
    Polyhedra,
    /// Edges between points, with their lengths.
    Edges,
    /// Triangles of polygons.
    Patches,
    /// Contour lines, and the bands between them.
    Contours,
    /// Faces of all dimensions with their values.
    Filtrations,
    /// Rasters.
    Rasters,
    /// Pictures.
    Pictures,
}

impl Contents {
    /// All kinds.
    pub const ALL: &'static [Self] = &[
        Self::Points,
        Self::Pieces,
        Self::Lines,
        Self::Segments,
        Self::Polygons,
        Self::Numbers,
        Self::Indices,
        Self::Answers,
        Self::Triangles,
        Self::SecondOrder,
        Self::Quads,
        Self::Areas,
        Self::Tetrahedra,
        Self::Surfaces,
        Self::Cells,
        Self::Polyhedra,
        Self::Edges,
        Self::Patches,
        Self::Contours,
        Self::Filtrations,
        Self::Rasters,
        Self::Pictures,
    ];
}

impl fmt::Display for Contents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Points => "points",
            Self::Pieces => "points in pieces",
            Self::Lines => "lines and polygons",
            Self::Segments => "segments",
            Self::Polygons => "polygons",
            Self::Numbers => "numbers",
            Self::Indices => "rows of indices",
            Self::Answers => "answers to queries",
            Self::Triangles => "triangles",
            Self::SecondOrder => "elements of second order",
            Self::Quads => "quadrilaterals",
            Self::Areas => "areas of triangles",
            Self::Tetrahedra => "tetrahedra",
            Self::Surfaces => "surfaces in space",
            Self::Cells => "Voronoi cells",
            Self::Polyhedra => "Voronoi cells in space",
            Self::Edges => "edges",
            Self::Patches => "triangles of polygons",
            Self::Contours => "contours",
            Self::Filtrations => "filtrations",
            Self::Rasters => "rasters",
            Self::Pictures => "pictures",
        })
    }
}

/// Whether a file is read or written. There is no third, so a match may name both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From the file.
    Read,
    /// To the file.
    Written,
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Read => "read from",
            Self::Written => "written to",
        })
    }
}

/// A source that a reader takes whole.
type Whole = Box<dyn Source>;

/// A function that reads, where there is one.
type Reader<T> = Option<fn(Whole) -> Result<T, Error>>;
type PointReader = fn(Whole, &ReadOptions) -> Result<Cloud, Error>;
type PieceReader = fn(Whole, &ReadOptions, &mut Chunks) -> Result<Cloud, Error>;
type PartReader = fn(Whole, &ReadOptions, Option<Beside>, &mut Chunks) -> Result<Cloud, Error>;
type ShapeReader = fn(Whole, &ReadOptions, Option<Beside>, Purpose) -> Result<Shapes, Error>;
type LineReader = fn(Whole, &ReadOptions, Option<Beside>) -> Result<Graph, Error>;

/// The functions that read a format, where it has what they read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Readers {
    /// Of a format of geometries: its points, lines and polygons, read by one function.
    pub(crate) shapes: Option<ShapeReader>,
    /// Of a format whose points are in many files: all of them, or piece by piece.
    pub(crate) parts: Option<PartReader>,
    pub(crate) points: Option<PointReader>,
    pub(crate) pieces: Option<PieceReader>,
    pub(crate) lines: Option<LineReader>,
    /// Of a format that seldom has lines: whether there is one.
    pub(crate) has_lines: Option<fn(Whole) -> bool>,
    /// Points with attributes and markers, which a graph can have and a cloud cannot.
    pub(crate) attributed: Reader<Graph>,
    pub(crate) segments: Reader<Vec<[usize; 2]>>,
    pub(crate) polygons: Reader<Rings>,
    pub(crate) numbers: Reader<Vec<f64>>,
    pub(crate) triangles: Reader<Vec<[u64; 3]>>,
    pub(crate) areas: Reader<Vec<Option<f64>>>,
    pub(crate) tetrahedra: Reader<Vec<[u64; 4]>>,
    pub(crate) rasters: Reader<Raster>,
}

impl Readers {
    /// Of a format that is written alone.
    pub(crate) const NONE: Self = Self {
        shapes: None,
        parts: None,
        points: None,
        pieces: None,
        lines: None,
        has_lines: None,
        attributed: None,
        segments: None,
        polygons: None,
        numbers: None,
        triangles: None,
        areas: None,
        tetrahedra: None,
        rasters: None,
    };

    /// Whether there is one for such contents.
    pub(crate) fn has(&self, contents: Contents) -> bool {
        match contents {
            Contents::Points | Contents::Lines | Contents::Polygons if self.shapes.is_some() => true,
            Contents::Points | Contents::Pieces if self.parts.is_some() => true,
            Contents::Points => self.points.is_some(),
            Contents::Pieces => self.pieces.is_some(),
            Contents::Lines => self.lines.is_some(),
            Contents::Segments => self.segments.is_some(),
            Contents::Polygons => self.polygons.is_some(),
            Contents::Numbers => self.numbers.is_some(),
            Contents::Triangles => self.triangles.is_some(),
            Contents::Areas => self.areas.is_some(),
            Contents::Tetrahedra => self.tetrahedra.is_some(),
            Contents::Rasters => self.rasters.is_some(),
            _ => false,
        }
    }
}
