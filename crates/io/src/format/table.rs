//! The table of formats: a row for each.

use super::Contents::{
    Answers, Cells, Contours, Edges, Filtrations, Indices, Lines, Numbers, Patches, Pictures, Points,
    Polyhedra, Quads, Rasters, SecondOrder, Surfaces, Tetrahedra, Triangles,
};
use super::readers::{OF_GEOJSON, OF_MEDIT, OF_MSH, OF_POLY, OF_SU2, OF_VTK, OF_WKT};
use super::{Contents, Format, Readers};
use crate::formats::{
    dxf, e57, ept, extxyz, flatgeobuf, geopackage, gpx, lammps, las, list, npy, obj, off, pairs, pcd, ply,
    poly, ptx, raw, shapefile, stl, text, triangle, vtk, wkb,
};
use crate::raster;

/// A format: how it is called, and what it holds.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) format: Format,
    /// In a few words.
    pub(super) title: &'static str,
    /// Names and extensions; the first is the one it prints.
    pub(super) names: &'static [&'static str],
    /// Other names that are understood.
    pub(super) also: &'static [&'static str],
    pub(super) readers: Readers,
    pub(super) writes: &'static [Contents],
}

/// Contents that pictures show.
const DRAWN: &[Contents] =
    &[Triangles, SecondOrder, Tetrahedra, Surfaces, Cells, Polyhedra, Patches, Contours, Pictures];

/// All formats, in the order in which they are listed.
pub(super) const TABLE: &[Row] = &[
    Row {
        format: Format::Text,
        title: "columns of numbers",
        names: &["csv", "xyz", "txt", "tsv", "dat"],
        also: &[],
        readers: Readers {
            points: Some(text::read),
            pieces: Some(text::read_in),
            lines: Some(|source, options, _| text::read_graph(source, options)),
            has_lines: Some(text::has_geometries),
            segments: Some(pairs::read),
            polygons: Some(text::read_rings),
            numbers: Some(list::read),
            ..Readers::NONE
        },
        writes: &[Points, Numbers, Indices, Answers, Cells, Polyhedra, Edges, Patches, Filtrations],
    },
    Row {
        format: Format::Pts,
        title: "counted lists of points",
        names: &["pts"],
        also: &[],
        readers: Readers { points: Some(|source, _| text::read_pts(source)), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::Npy,
        title: "NumPy arrays",
        names: &["npy"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| npy::read_points(source)),
            pieces: Some(|source, _, pieces| npy::read_in(source, pieces)),
            segments: Some(npy::read_pairs),
            numbers: Some(npy::read_list),
            triangles: Some(npy::read_simplices),
            tetrahedra: Some(npy::read_simplices),
            rasters: Some(raster::read_npy),
            ..Readers::NONE
        },
        writes: &[Points, Numbers, Indices, Triangles, Tetrahedra, Polyhedra, Edges, Patches, Rasters],
    },
    Row {
        format: Format::Npz,
        title: "NumPy archives",
        names: &["npz"],
        also: &[],
        readers: Readers { points: Some(|source, _| npy::read_archive(source)), ..Readers::NONE },
        writes: &[Filtrations],
    },
    Row {
        format: Format::Raw,
        title: "raw numbers, little-endian float64",
        names: &["bin"],
        also: &[],
        readers: Readers {
            points: Some(|source, options| raw::read(source, options.dimension)),
            pieces: Some(|source, options, pieces| raw::read_in(source, options.dimension, pieces)),
            ..Readers::NONE
        },
        writes: &[Points],
    },
    Row {
        format: Format::Node,
        title: "Triangle's points",
        names: &["node"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| triangle::read_node(source)),
            attributed: Some(triangle::read_graph),
            ..Readers::NONE
        },
        writes: &[Points, Triangles, SecondOrder, Tetrahedra],
    },
    Row {
        format: Format::Poly,
        title: "Triangle's graphs, and polygons of Osmosis",
        names: &["poly"],
        also: &[],
        readers: OF_POLY,
        writes: &[Lines, Triangles, SecondOrder],
    },
    Row {
        format: Format::Area,
        title: "Triangle's largest areas of triangles",
        names: &["area"],
        also: &[],
        readers: Readers { areas: Some(poly::read_areas), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::Ele,
        title: "Triangle's and TetGen's simplices",
        names: &["ele"],
        also: &[],
        readers: Readers {
            triangles: Some(|source| Ok(triangle::read_ele(source, false)?.0)),
            tetrahedra: Some(|source| Ok(triangle::read_ele(source, false)?.0)),
            ..Readers::NONE
        },
        writes: &[Triangles, SecondOrder, Tetrahedra],
    },
    Row {
        format: Format::Neigh,
        title: "Triangle's neighbors",
        names: &["neigh"],
        also: &[],
        readers: Readers::NONE,
        writes: &[Triangles, SecondOrder, Tetrahedra],
    },
    Row {
        format: Format::Edge,
        title: "Triangle's edges",
        names: &["edge"],
        also: &[],
        readers: Readers { segments: Some(poly::read_edges), ..Readers::NONE },
        writes: &[Triangles, SecondOrder, Tetrahedra],
    },
    Row {
        format: Format::Las,
        title: "LAS, LAZ and COPC point clouds",
        names: &["las", "laz"],
        also: &[],
        readers: Readers { points: Some(las::read), pieces: Some(las::read_in), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::Ept,
        title: "Entwine Point Tiles, by their ept.json",
        names: &["ept"],
        also: &[],
        readers: Readers { parts: Some(ept::read), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::E57,
        title: "E57 scans",
        names: &["e57"],
        also: &[],
        readers: Readers { points: Some(|source, _| e57::read(source)), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::Ptx,
        title: "scans as text",
        names: &["ptx"],
        also: &[],
        readers: Readers { points: Some(|source, _| ptx::read(source)), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::Lammps,
        title: "LAMMPS dumps of atoms in a box",
        names: &["lammpstrj"],
        also: &["dump"],
        readers: Readers { points: Some(lammps::read), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::ExtXyz,
        title: "extended XYZ, atoms in a lattice",
        names: &["extxyz"],
        also: &[],
        readers: Readers { points: Some(extxyz::read), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::Ply,
        title: "Stanford polygons",
        names: &["ply"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| ply::read_points(source)),
            triangles: Some(ply::read_triangles),
            ..Readers::NONE
        },
        writes: &[Points, Triangles, Tetrahedra, Surfaces, Polyhedra, Patches],
    },
    Row {
        format: Format::Obj,
        title: "Wavefront objects",
        names: &["obj"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| obj::read_points(source)),
            lines: Some(|source, _, _| obj::read_graph(source)),
            has_lines: Some(obj::has_lines),
            triangles: Some(obj::read_triangles),
            ..Readers::NONE
        },
        writes: &[Points, Triangles, Tetrahedra, Surfaces, Polyhedra, Patches],
    },
    Row {
        format: Format::Off,
        title: "Geomview objects",
        names: &["off"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| off::read_points(source)),
            triangles: Some(off::read_triangles),
            ..Readers::NONE
        },
        writes: &[Triangles],
    },
    Row {
        format: Format::Stl,
        title: "stereolithography",
        names: &["stl"],
        also: &[],
        readers: Readers { points: Some(|source, _| stl::read_points(source)), ..Readers::NONE },
        writes: &[Triangles, Tetrahedra, Surfaces, Patches],
    },
    Row {
        format: Format::Vtu,
        title: "VTK's unstructured grids",
        names: &["vtu"],
        also: &[],
        readers: OF_VTK,
        writes: &[Triangles, SecondOrder, Quads, Tetrahedra, Surfaces, Polyhedra, Patches],
    },
    Row {
        format: Format::Vtp,
        title: "VTK's surfaces",
        names: &["vtp"],
        also: &[],
        readers: Readers { tetrahedra: None, ..OF_VTK },
        writes: &[],
    },
    Row {
        format: Format::Vtk,
        title: "VTK's legacy files",
        names: &["vtk"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| vtk::read_legacy(source)),
            lines: Some(|source, _, _| vtk::read_legacy_graph(source)),
            has_lines: Some(vtk::has_legacy_lines),
            triangles: Some(vtk::read_legacy_simplices),
            tetrahedra: Some(vtk::read_legacy_simplices),
            ..Readers::NONE
        },
        writes: &[],
    },
    Row {
        format: Format::Pcd,
        title: "clouds of the Point Cloud Library",
        names: &["pcd"],
        also: &[],
        readers: Readers { points: Some(|source, _| pcd::read(source)), ..Readers::NONE },
        writes: &[],
    },
    Row {
        format: Format::GeoJson,
        title: "GeoJSON",
        names: &["geojson"],
        also: &["json"],
        readers: OF_GEOJSON,
        writes: &[Points, Lines, Answers, Triangles, Cells, Edges, Patches, Contours],
    },
    Row {
        format: Format::GeoJsonLines,
        title: "GeoJSON, a feature a line",
        names: &["geojsonl"],
        also: &["geojsons", "ndjson"],
        readers: OF_GEOJSON,
        writes: &[],
    },
    Row {
        format: Format::Json,
        title: "cells of space as JSON; other `.json` files are GeoJSON",
        names: &["json"],
        also: &[],
        readers: Readers::NONE,
        writes: &[Polyhedra],
    },
    Row {
        format: Format::FlatGeobuf,
        title: "FlatGeobuf",
        names: &["fgb"],
        also: &["flatgeobuf"],
        readers: Readers {
            shapes: Some(|source, options, _, _| flatgeobuf::read(source, options)),
            ..Readers::NONE
        },
        writes: &[Points, Lines, Answers, Triangles, Cells, Edges, Patches, Contours],
    },
    Row {
        format: Format::GeoPackage,
        title: "GeoPackage",
        names: &["gpkg"],
        also: &["geopackage"],
        readers: Readers {
            shapes: Some(|source, options, _, _| geopackage::read(source, options)),
            ..Readers::NONE
        },
        writes: &[Points, Lines, Answers, Triangles, Cells, Edges, Patches, Contours],
    },
    Row {
        format: Format::Shapefile,
        title: "shapefiles, with their .dbf, .cpg and .prj files",
        names: &["shp"],
        also: &["shapefile"],
        readers: Readers {
            shapes: Some(|source, options, beside, _| shapefile::read(source, options, beside)),
            ..Readers::NONE
        },
        writes: &[],
    },
    Row {
        format: Format::Dxf,
        title: "drawings, as text",
        names: &["dxf"],
        also: &[],
        readers: Readers {
            shapes: Some(|source, options, _, purpose| dxf::read(source, options, purpose)),
            ..Readers::NONE
        },
        writes: &[],
    },
    Row {
        format: Format::Wkt,
        title: "well-known text, a geometry a line",
        names: &["wkt"],
        also: &["ewkt"],
        readers: OF_WKT,
        writes: &[Points, Lines, Triangles, Cells, Patches],
    },
    Row {
        format: Format::WktCollection,
        title: "well-known text, one collection",
        names: &[],
        also: &[],
        readers: OF_WKT,
        writes: &[Points, Lines, Triangles, Cells, Patches],
    },
    Row {
        format: Format::Wkb,
        title: "well-known binary",
        names: &["wkb"],
        also: &["ewkb"],
        readers: Readers {
            shapes: Some(|source, options, _, _| wkb::read(source, options)),
            ..Readers::NONE
        },
        writes: &[Points, Triangles, Cells, Patches],
    },
    Row {
        format: Format::Gpx,
        title: "tracks, routes and waypoints of GPS receivers",
        names: &["gpx"],
        also: &[],
        readers: Readers {
            points: Some(|source, options| Ok(gpx::read(source, options)?.cloud())),
            lines: Some(|source, options, _| gpx::read(source, options)?.graph()),
            ..Readers::NONE
        },
        writes: &[],
    },
    Row {
        format: Format::Tiff,
        title: "GeoTIFF rasters",
        names: &["tif"],
        also: &["tiff"],
        readers: Readers {
            points: Some(|source, _| Ok(raster::read_tiff(source)?.into_points())),
            rasters: Some(raster::read_tiff),
            ..Readers::NONE
        },
        writes: &[Rasters],
    },
    Row {
        format: Format::Asc,
        title: "ESRI ASCII grids",
        names: &["asc"],
        also: &[],
        readers: Readers {
            points: Some(|source, _| Ok(raster::read_asc(source)?.into_points())),
            rasters: Some(raster::read_asc),
            ..Readers::NONE
        },
        writes: &[Rasters],
    },
    Row {
        format: Format::Msh,
        title: "Gmsh meshes",
        names: &["msh"],
        also: &[],
        readers: OF_MSH,
        writes: &[Triangles, SecondOrder, Quads, Tetrahedra],
    },
    Row {
        format: Format::Inp,
        title: "Abaqus meshes",
        names: &["inp"],
        also: &[],
        readers: Readers::NONE,
        writes: &[Triangles, SecondOrder, Quads, Tetrahedra],
    },
    Row {
        format: Format::Medit,
        title: "Medit meshes, of FreeFEM and MMG",
        names: &["mesh"],
        also: &["medit"],
        readers: OF_MEDIT,
        writes: &[Triangles, Quads, Tetrahedra],
    },
    Row {
        format: Format::Su2,
        title: "SU2 meshes",
        names: &["su2"],
        also: &[],
        readers: OF_SU2,
        writes: &[Triangles, Quads, Tetrahedra],
    },
    Row {
        format: Format::Sms,
        title: "SMS meshes",
        names: &["2dm"],
        also: &["sms"],
        readers: Readers::NONE,
        writes: &[Triangles, SecondOrder, Quads],
    },
    Row {
        format: Format::Adcirc,
        title: "ADCIRC grids",
        names: &["14"],
        also: &["grd", "adcirc"],
        readers: Readers::NONE,
        writes: &[Triangles],
    },
    Row {
        format: Format::Nastran,
        title: "Nastran bulk data",
        names: &["bdf", "nas"],
        also: &["nastran"],
        readers: Readers::NONE,
        writes: &[Triangles, SecondOrder, Quads, Tetrahedra],
    },
    Row {
        format: Format::Xdmf,
        title: "XDMF, with all numbers in it",
        names: &["xdmf"],
        also: &["xmf"],
        readers: Readers::NONE,
        writes: &[Triangles, SecondOrder, Tetrahedra],
    },
    Row {
        format: Format::Svg,
        title: "vector pictures",
        names: &["svg"],
        also: &[],
        readers: Readers::NONE,
        writes: DRAWN,
    },
    Row {
        format: Format::Png,
        title: "pixel pictures",
        names: &["png"],
        also: &[],
        readers: Readers::NONE,
        writes: DRAWN,
    },
];
