//! Layers of everything that is written, with the properties that GeoJSON has.

use delone::{Coordinates, Triangulation, VertexId};

use super::{Column, Form, Geometry, Kind, Layer, Take, beside, cells};
use crate::diagram::Tiles;
use crate::formats::graphs::Pieces;
use crate::formats::in_space;
use crate::{
    Answers, ColumnType, ContourMap, Crs, Edges, Error, Found, Graph, Mesh, Patches, Shape, Table, Value,
};

/// A number that is written, where it is one.
fn finite(number: f64) -> Value<'static> {
    if number.is_finite() { Value::Number(number) } else { Value::Null }
}

/// Values of columns, in the order of these.
fn in_order<const N: usize>(values: [Value; N]) -> impl Iterator<Item = (usize, Value)> {
    values.into_iter().enumerate()
}

/// Cells of a diagram, with what they are of and their areas.
pub(crate) struct Cells<'a, T>(pub(crate) &'a T);

impl<T: Tiles> Layer for Cells<'_, T> {
    fn name(&self) -> &'static str {
        "cells"
    }

    fn columns(&self) -> Vec<Column> {
        let kind = if self.0.property() == "site" { ColumnType::Integer } else { ColumnType::Text };
        let ours = vec![Column::new(self.0.property(), kind), Column::new("area", ColumnType::Number)];
        beside(ours, self.0.table())
    }

    fn form(&self) -> Option<Form> {
        // Two rings are two polygons or one with a hole.
        let is_multiple = self.0.tiles().any(|tile| self.0.polygons(tile).len() > 1);
        Some(Form { kind: Kind::Polygon, is_multiple })
    }

    fn is_high(&self) -> bool {
        false
    }

    fn crs(&self) -> Option<&Crs> {
        self.0.crs()
    }

    fn count(&self) -> usize {
        self.0.tiles().count()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let mut geometry = Geometry::default();
        let mut json = Vec::new();
        for tile in self.0.tiles() {
            geometry.clear(Kind::Polygon);
            for polygon in self.0.polygons(tile) {
                for ring in polygon {
                    geometry.positions.extend(ring.points().map(|[x, y]| [x, y, 0.0]));
                    geometry.end_ring();
                }
                geometry.end_polygon();
            }
            json.clear();
            self.0.write_value(&mut json, tile)?;
            let own = Value::of(str::from_utf8(&json).unwrap_or_default());
            let ours = in_order([own, finite(self.0.area(tile))]);
            take(&geometry, &mut ours.chain(cells(self.0.table(), self.0.row(tile), 2)))?;
        }
        Ok(())
    }
}

/// Triangles, with their corners and the value that each has.
pub(crate) struct Triangles<'a, S> {
    shape: &'a S,
    /// The name of the values, and their type.
    value: (&'static str, ColumnType),
}

impl<'a, T: Triangulation<Point = [f64; 2]>> Triangles<'a, Mesh<'a, T>> {
    /// The triangles of a triangulation, with their regions.
    pub(crate) fn of_mesh(shape: &'a Mesh<'a, T>) -> Self {
        Self { shape, value: ("region", ColumnType::Number) }
    }
}

impl<'a> Triangles<'a, Patches> {
    /// The triangles of polygons, with the number of their polygon.
    pub(crate) fn of_patches(shape: &'a Patches) -> Self {
        Self { shape, value: ("polygon", ColumnType::Integer) }
    }
}

impl<S: Shape> Layer for Triangles<'_, S> {
    fn name(&self) -> &'static str {
        "triangles"
    }

    fn columns(&self) -> Vec<Column> {
        let mut columns = vec![Column::new("vertices", ColumnType::Text)];
        if self.shape.region_values().is_some() {
            columns.push(Column::new(self.value.0, self.value.1));
        }
        beside(columns, self.shape.table())
    }

    fn form(&self) -> Option<Form> {
        Some(Form { kind: Kind::Polygon, is_multiple: false })
    }

    fn is_high(&self) -> bool {
        self.shape.heights().is_some()
    }

    fn crs(&self) -> Option<&Crs> {
        self.shape.crs()
    }

    fn count(&self) -> usize {
        self.shape.triangles().count()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let positions: Vec<_> = self.shape.positions().collect();
        let (mut values, mut rows) = (self.shape.region_values(), self.shape.rows());
        let first = 1 + usize::from(values.is_some());
        let mut geometry = Geometry::default();
        for triangle in self.shape.triangles() {
            geometry.clear(Kind::Polygon);
            geometry.positions.extend(triangle.map(|i| positions[i]));
            geometry.end_ring();
            geometry.end_polygon();
            let vertices = format!("{triangle:?}");
            let value = values.as_mut().and_then(Iterator::next).map(|value| match self.value.1 {
                ColumnType::Integer => Value::Integer(value as i64),
                _ => finite(value),
            });
            let ours = [Value::Json(&vertices)].into_iter().chain(value).enumerate();
            let theirs = cells(self.shape.table(), rows.next().flatten(), first);
            take(&geometry, &mut ours.chain(theirs))?;
        }
        Ok(())
    }
}

impl Layer for ContourMap<'_> {
    fn name(&self) -> &'static str {
        "contours"
    }

    fn columns(&self) -> Vec<Column> {
        let used =
            [(!self.lines.is_empty(), &["elevation"][..]), (!self.bands.is_empty(), &["lower", "upper"])];
        let names = used.iter().filter(|used| used.0).flat_map(|used| used.1);
        names.map(|name| Column::new(name, ColumnType::Number)).collect()
    }

    fn form(&self) -> Option<Form> {
        match (self.lines, self.bands) {
            (_, []) => Some(Form { kind: Kind::Line, is_multiple: false }),
            ([], _) => Some(Form { kind: Kind::Polygon, is_multiple: true }),
            _ => None,
        }
    }

    fn is_high(&self) -> bool {
        false
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }

    fn count(&self) -> usize {
        self.lines.len() + self.bands.len()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let flat = |points: &[[f64; 2]]| points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>();
        let mut geometry = Geometry::default();
        for line in self.lines {
            geometry.clear(Kind::Line);
            geometry.positions.extend(flat(&line.points));
            if line.is_closed {
                geometry.end_ring();
            } else {
                geometry.end_line();
            }
            take(&geometry, &mut in_order([finite(line.level)]))?;
        }
        let first = usize::from(!self.lines.is_empty());
        for band in self.bands {
            geometry.clear(Kind::Polygon);
            for polygon in &band.polygons {
                for ring in polygon {
                    geometry.positions.extend(flat(ring));
                    geometry.end_ring();
                }
                geometry.end_polygon();
            }
            let values = in_order([finite(band.lower), finite(band.upper)]);
            take(&geometry, &mut values.map(|(column, value)| (first + column, value)))?;
        }
        Ok(())
    }
}

/// A graph as polygons, lines and points.
pub(crate) struct Graphs<'a> {
    graph: &'a Graph,
    pieces: Pieces,
}

impl<'a> Graphs<'a> {
    pub(crate) fn new(graph: &'a Graph) -> Self {
        Self { graph, pieces: Pieces::of(graph) }
    }

    /// The kinds of geometries, with how many features there are of each.
    fn kinds(&self) -> [(Form, usize); 3] {
        let form = |kind, is_multiple| Form { kind, is_multiple };
        [
            (form(Kind::Polygon, false), self.pieces.polygons.len()),
            (form(Kind::Line, true), usize::from(!self.pieces.lines.is_empty())),
            (form(Kind::Point, true), usize::from(!self.pieces.alone.is_empty())),
        ]
    }
}

impl Layer for Graphs<'_> {
    fn name(&self) -> &'static str {
        "graph"
    }

    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    fn form(&self) -> Option<Form> {
        let mut used = self.kinds().into_iter().filter(|kind| kind.1 > 0).map(|kind| kind.0);
        used.next().filter(|_| used.next().is_none())
    }

    fn is_high(&self) -> bool {
        self.graph.cloud.z.is_some()
    }

    fn crs(&self) -> Option<&Crs> {
        self.graph.cloud.crs.as_ref()
    }

    fn count(&self) -> usize {
        self.kinds().iter().map(|kind| kind.1).sum()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let heights = self.graph.cloud.z.as_deref().unwrap_or_default();
        let position = |&i: &usize| {
            let [x, y] = self.graph.cloud.xy[i];
            [x, y, heights.get(i).copied().unwrap_or_default()]
        };
        let mut geometry = Geometry::default();
        let add = |geometry: &mut Geometry, chain: &[usize]| {
            geometry.positions.extend(chain.iter().map(position));
            geometry.end_line();
        };
        for polygon in &self.pieces.polygons {
            geometry.clear(Kind::Polygon);
            polygon.iter().for_each(|ring| add(&mut geometry, ring));
            geometry.end_polygon();
            take(&geometry, &mut std::iter::empty())?;
        }
        if !self.pieces.lines.is_empty() {
            geometry.clear(Kind::Line);
            self.pieces.lines.iter().for_each(|line| add(&mut geometry, line));
            take(&geometry, &mut std::iter::empty())?;
        }
        if !self.pieces.alone.is_empty() {
            geometry.clear(Kind::Point);
            geometry.positions.extend(self.pieces.alone.iter().map(position));
            take(&geometry, &mut std::iter::empty())?;
        }
        Ok(())
    }
}

/// Edges, with the indices of their ends and their lengths.
pub(crate) struct Edged<'a, 'b, P>(pub(crate) &'a Edges<'b, P>);

impl<P: Coordinates> Layer for Edged<'_, '_, P> {
    fn name(&self) -> &'static str {
        "edges"
    }

    fn columns(&self) -> Vec<Column> {
        let of_all = [Column::new("vertices", ColumnType::Text), Column::new("length", ColumnType::Number)];
        let width = self.0.widths.map(|_| Column::new("width", ColumnType::Number));
        of_all.into_iter().chain(width).collect()
    }

    fn form(&self) -> Option<Form> {
        Some(Form { kind: Kind::Line, is_multiple: false })
    }

    fn is_high(&self) -> bool {
        P::COUNT > 2
    }

    fn crs(&self) -> Option<&Crs> {
        self.0.crs
    }

    fn count(&self) -> usize {
        self.0.pairs.len()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let mut geometry = Geometry::default();
        for (k, (edge, length)) in self.0.pairs.iter().zip(self.0.lengths()).enumerate() {
            geometry.clear(Kind::Line);
            geometry.positions.extend(edge.map(|i| in_space(&self.0.points[i])));
            geometry.end_line();
            let vertices = format!("{edge:?}");
            let (of_all, width) =
                ([Value::Json(&vertices), finite(length)], self.0.widths.map(|of| finite(of[k])));
            match width {
                Some(width) => take(&geometry, &mut in_order([of_all[0].clone(), of_all[1].clone(), width]))?,
                None => take(&geometry, &mut in_order(of_all))?,
            }
        }
        Ok(())
    }
}

/// The edges of a triangulation that are on lines with attributes, and these.
pub(crate) struct LinesOf<'a, T: Triangulation> {
    mesh: &'a Mesh<'a, T>,
    edges: Vec<([VertexId; 2], usize)>,
}

impl<'a, T: Triangulation> LinesOf<'a, T> {
    pub(crate) fn new(mesh: &'a Mesh<'a, T>) -> Self {
        Self { mesh, edges: mesh.lines() }
    }

    fn table(&self) -> Option<&Table> {
        Some(self.mesh.constraints?.features?.table)
    }
}

impl<T: Triangulation> Layer for LinesOf<'_, T> {
    fn name(&self) -> &'static str {
        "lines"
    }

    fn columns(&self) -> Vec<Column> {
        beside(vec![Column::new("vertices", ColumnType::Text)], self.table())
    }

    fn form(&self) -> Option<Form> {
        Some(Form { kind: Kind::Line, is_multiple: false })
    }

    fn is_high(&self) -> bool {
        self.mesh.heights.is_some()
    }

    fn crs(&self) -> Option<&Crs> {
        self.mesh.crs
    }

    fn count(&self) -> usize {
        self.edges.len()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let positions: Vec<_> = self.mesh.positions().collect();
        let mut geometry = Geometry::default();
        for &(edge, row) in &self.edges {
            let edge = edge.map(|v| v.index());
            geometry.clear(Kind::Line);
            geometry.positions.extend(edge.map(|i| positions[i]));
            geometry.end_line();
            let vertices = format!("{edge:?}");
            let theirs = cells(self.table(), Some(row), 1);
            take(&geometry, &mut in_order([Value::Json(&vertices)]).chain(theirs))?;
        }
        Ok(())
    }
}

/// Answers to queries, a point each with its attributes.
pub(crate) struct Answered<'a, 'b, P>(pub(crate) &'a Answers<'b, P>);

impl<P: AsRef<[f64]>> Layer for Answered<'_, '_, P> {
    fn name(&self) -> &'static str {
        "answers"
    }

    fn columns(&self) -> Vec<Column> {
        let kind = match self.0.found {
            Found::Indices(_) => ColumnType::Integer,
            Found::Numbers(_) => ColumnType::Number,
        };
        let ours = self.0.names.iter().map(|name| Column::new(name, kind)).collect();
        beside(ours, Some(&self.0.features.table))
    }

    fn form(&self) -> Option<Form> {
        Some(Form { kind: Kind::Point, is_multiple: false })
    }

    fn is_high(&self) -> bool {
        self.0.queries.first().is_some_and(|query| query.as_ref().len() > 2)
    }

    fn crs(&self) -> Option<&Crs> {
        self.0.crs
    }

    fn count(&self) -> usize {
        self.0.queries.len()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let mut geometry = Geometry::default();
        for (i, query) in self.0.queries.iter().enumerate() {
            geometry.clear(Kind::Point);
            geometry.positions.push(in_space(query));
            let ours = self.0.own(i).map(|at| match self.0.found {
                Found::Indices(all) => Value::Integer(all[at]),
                Found::Numbers(all) => finite(all[at]),
            });
            let theirs = cells(Some(&self.0.features.table), self.0.features.row(i), self.0.names.len());
            take(&geometry, &mut ours.enumerate().chain(theirs))?;
        }
        Ok(())
    }
}

/// Bare points, a feature each.
pub(crate) struct Points<'a, const D: usize>(pub(crate) &'a [[f64; D]]);

impl<const D: usize> Layer for Points<'_, D> {
    fn name(&self) -> &'static str {
        "points"
    }

    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    fn form(&self) -> Option<Form> {
        Some(Form { kind: Kind::Point, is_multiple: false })
    }

    fn is_high(&self) -> bool {
        D > 2
    }

    fn crs(&self) -> Option<&Crs> {
        None
    }

    fn count(&self) -> usize {
        self.0.len()
    }

    fn each(&self, take: Take) -> Result<(), Error> {
        let mut geometry = Geometry::default();
        for point in self.0 {
            geometry.clear(Kind::Point);
            geometry.positions.push(in_space(point));
            take(&geometry, &mut std::iter::empty())?;
        }
        Ok(())
    }
}
