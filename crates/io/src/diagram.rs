//! Voronoi diagrams to be written: cells of sites, or of sets of the nearest ones.

use std::io::{self, Write};

use delone::{Cells2, LineCells2, OrderCells2, OrderK2, OrderRegion2, Ring, Triangulation, VertexId};

use crate::{Crs, Features, Rows, Table, rings};

/// Clipped cells, with the triangulation of their sites.
#[derive(Debug)]
pub struct Diagram<'a, T> {
    /// The sites.
    pub triangulation: &'a T,
    /// Their cells.
    pub cells: &'a Cells2,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// The attributes of the sites, which their cells have in GeoJSON, FlatGeobuf, GeoPackage and CSV; one that is called `site` or `area` is `site_2` or `area_2`
    /// there.
    pub features: Option<&'a Features>,
}

/// Clipped cells of lines.
#[derive(Debug)]
pub struct LineDiagram<'a> {
    /// The cells.
    pub cells: &'a LineCells2,
    /// How many lines there are.
    pub count: usize,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// The attributes of the lines, as those of sites in [`Diagram`].
    pub features: Option<Rows<'a>>,
}

/// Clipped regions of a diagram of higher order.
#[derive(Debug)]
pub struct OrderDiagram<'a> {
    /// The regions.
    pub diagram: &'a OrderK2<'a>,
    /// The clipped cells.
    pub cells: &'a OrderCells2,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
}

/// A diagram to be written: polygons that tile, each of a site or a set of sites.
pub(crate) trait Tiles {
    /// The id of a polygon.
    type Tile: Copy;

    /// All of them, those of which nothing is left too.
    fn tiles(&self) -> impl Iterator<Item = Self::Tile>;

    /// The rings of one.
    fn rings(&self, tile: Self::Tile) -> impl Iterator<Item = Ring<'_>> + Clone;

    /// The area of one.
    fn area(&self, tile: Self::Tile) -> f64;

    /// The name of the property that tells the site or sites.
    fn property(&self) -> &'static str;

    /// Writes what one is of, as a value of JSON.
    fn write_value(&self, out: &mut dyn Write, tile: Self::Tile) -> io::Result<()>;

    /// The site or sites in words, for people and for columns.
    fn title(&self, tile: Self::Tile) -> String;

    /// The sites, each with the tile that it is drawn on.
    fn sites(&self) -> impl Iterator<Item = (Self::Tile, [f64; 2])>;

    /// The system of coordinates.
    fn crs(&self) -> Option<&Crs>;

    /// The attributes of the sites, where they are known.
    fn table(&self) -> Option<&Table> {
        None
    }

    /// The row of one in that table.
    fn row(&self, _: Self::Tile) -> Option<usize> {
        None
    }

    /// Polygons that are not empty.
    fn present(&self) -> impl Iterator<Item = Self::Tile> {
        self.tiles().filter(|&tile| self.rings(tile).next().is_some())
    }

    /// The rings of one as polygons: each an outer ring, counter-clockwise, and its holes.
    fn polygons(&self, tile: Self::Tile) -> Vec<Vec<Ring<'_>>> {
        let rings: Vec<Ring> = self.rings(tile).collect();
        if rings.len() < 2 {
            return rings.into_iter().map(|ring| vec![ring]).collect();
        }
        let closed: Vec<rings::Ring> =
            rings.iter().map(|ring| rings::Ring::of(ring.points().collect())).collect();
        let polygons = rings::polygons(&closed, |i| !closed[i].is_counter_clockwise());
        polygons.into_iter().map(|all| all.into_iter().map(|i| rings[i]).collect()).collect()
    }

    /// The corners of all tiles, and all sites.
    fn corners(&self) -> impl Iterator<Item = [f64; 2]> {
        let corners = self.tiles().flat_map(|tile| self.rings(tile)).flat_map(Ring::points);
        corners.chain(self.sites().map(|(_, p)| p))
    }
}

impl<T: Triangulation<Point = [f64; 2]>> Tiles for Diagram<'_, T> {
    type Tile = VertexId;

    fn tiles(&self) -> impl Iterator<Item = VertexId> {
        self.triangulation.vertices()
    }

    fn rings(&self, tile: VertexId) -> impl Iterator<Item = Ring<'_>> + Clone {
        self.cells.rings(tile)
    }

    fn area(&self, tile: VertexId) -> f64 {
        self.cells.area(tile)
    }

    fn property(&self) -> &'static str {
        "site"
    }

    fn write_value(&self, out: &mut dyn Write, tile: VertexId) -> io::Result<()> {
        write!(out, "{}", tile.index())
    }

    fn title(&self, tile: VertexId) -> String {
        tile.index().to_string()
    }

    fn sites(&self) -> impl Iterator<Item = (VertexId, [f64; 2])> {
        self.tiles().map(|v| (v, self.triangulation.position(v).unwrap_or_default()))
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }

    fn table(&self) -> Option<&Table> {
        self.features.map(|features| &features.table)
    }

    fn row(&self, tile: VertexId) -> Option<usize> {
        self.features?.row(tile.index())
    }
}

impl Tiles for LineDiagram<'_> {
    type Tile = VertexId;

    fn tiles(&self) -> impl Iterator<Item = VertexId> {
        (0..self.count).map(VertexId::new)
    }

    fn rings(&self, tile: VertexId) -> impl Iterator<Item = Ring<'_>> + Clone {
        self.cells.cells.rings(tile)
    }

    fn area(&self, tile: VertexId) -> f64 {
        self.cells.cells.area(tile)
    }

    fn property(&self) -> &'static str {
        "site"
    }

    fn write_value(&self, out: &mut dyn Write, tile: VertexId) -> io::Result<()> {
        write!(out, "{}", tile.index())
    }

    fn title(&self, tile: VertexId) -> String {
        tile.index().to_string()
    }

    fn sites(&self) -> impl Iterator<Item = (VertexId, [f64; 2])> {
        let LineCells2 { lines, sites, .. } = self.cells;
        lines.iter().map(|&line| VertexId::new(line)).zip(sites.iter().copied())
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }

    fn table(&self) -> Option<&Table> {
        self.features.map(|features| features.table)
    }

    fn row(&self, tile: VertexId) -> Option<usize> {
        self.features?.of.get(tile.index()).copied().flatten()
    }
}

impl<'a> Tiles for OrderDiagram<'a> {
    type Tile = OrderRegion2<'a>;

    fn tiles(&self) -> impl Iterator<Item = OrderRegion2<'a>> {
        self.diagram.regions()
    }

    fn rings(&self, tile: OrderRegion2<'a>) -> impl Iterator<Item = Ring<'_>> + Clone {
        self.cells.rings(tile)
    }

    fn area(&self, tile: OrderRegion2<'a>) -> f64 {
        self.cells.area(tile)
    }

    fn property(&self) -> &'static str {
        "sites"
    }

    fn write_value(&self, out: &mut dyn Write, tile: OrderRegion2<'a>) -> io::Result<()> {
        write!(out, "[{}]", joined(tile, ","))
    }

    fn title(&self, tile: OrderRegion2<'a>) -> String {
        joined(tile, " ")
    }

    fn sites(&self) -> impl Iterator<Item = (OrderRegion2<'a>, [f64; 2])> {
        let triangulation = self.diagram.triangulation();
        let points = triangulation.vertices().map(|v| triangulation.point(v));
        points.filter_map(|p| self.diagram.locate(p).ok().map(|region| (region, p)))
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }
}

/// The indices of the sites of a region.
fn joined(region: OrderRegion2, separator: &str) -> String {
    let sites: Vec<String> = region.sites().iter().map(|v| v.index().to_string()).collect();
    sites.join(separator)
}
