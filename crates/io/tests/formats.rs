//! The table of formats says what readers and writers do.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use delone::surface::Grid;
use delone::{Delaunay2, Delaunay3, Region2, Region3};
use delone_io::{
    Contents, ContourMap, Diagram, Direction, Edges, Error, Format, Graph, Mesh, Patches, Polyhedra,
    RasterInfo, RasterWriter, ReadOptions, Solid, Source, picture, read_areas, read_chunks, read_graph,
    read_numbers, read_points, read_raster, read_rings, read_segments, read_tetrahedra, read_triangles,
    write_contours, write_diagram, write_edges, write_filtration, write_graph, write_indices, write_mesh,
    write_patches, write_points, write_polyhedra, write_solid,
};

#[test]
fn names_are_of_one_format_each() {
    let mut seen = Vec::new();
    // JSON of another kind is written alone, where GeoJSON cannot be.
    assert_eq!("json".parse::<Format>().ok(), Some(Format::GeoJson));
    for format in Format::all().filter(|&format| format != Format::Json) {
        assert!(!format.title().is_empty());
        for &name in format.names().into_iter().flatten() {
            assert!(!seen.contains(&name), "{name} is of two formats");
            seen.push(name);
            assert_eq!(name.parse::<Format>().ok(), Some(format));
            assert_eq!(Format::of(Path::new(&format!("a.b.{}.gz", name.to_uppercase()))).ok(), Some(format));
        }
        let parsed = format.to_string().parse::<Format>().expect("what is printed is a name");
        assert!(parsed == format || format == Format::WktCollection);
    }
    assert!(seen.len() > 40);
}

/// Whether a format was refused, not the file.
fn is_refused<T>(outcome: Result<T, Error>, format: Format, contents: Contents) -> bool {
    match outcome {
        Err(Error::Unsupported { format: named, contents: asked, .. }) => {
            assert_eq!((named, asked), (format, contents));
            true
        }
        _ => false,
    }
}

#[test]
fn what_is_read_is_in_the_table() {
    let source = || -> Box<dyn Source> { Box::new(Cursor::new(b"0")) };
    for format in Format::all() {
        let options = ReadOptions::default().dimension(2);
        for &contents in Contents::ALL {
            let refused = match contents {
                Contents::Points => is_refused(read_points(source(), format, &options), format, contents),
                Contents::Pieces => {
                    let outcome = read_chunks(source(), format, &options, 10, &mut |_, _| Ok(()));
                    is_refused(outcome, format, contents)
                }
                // What has points has a graph without segments, and a ring of all.
                Contents::Lines => {
                    let is_one = format.holds(Contents::Points, Direction::Read);
                    assert_eq!(read_is_of_points(read_graph(source(), format, &options, None)), !is_one);
                    continue;
                }
                Contents::Polygons => {
                    let is_one = format.holds(Contents::Points, Direction::Read);
                    assert_eq!(read_is_of_points(read_rings(source(), format)), !is_one);
                    continue;
                }
                Contents::Segments => is_refused(read_segments(source(), format), format, contents),
                Contents::Numbers => is_refused(read_numbers(source(), format), format, contents),
                Contents::Triangles => is_refused(read_triangles(source(), format), format, contents),
                Contents::Areas => is_refused(read_areas(source(), format), format, contents),
                Contents::Tetrahedra => is_refused(read_tetrahedra(source(), format), format, contents),
                Contents::Rasters => is_refused(read_raster(source(), format), format, contents),
                _ => true,
            };
            assert_eq!(refused, !format.holds(contents, Direction::Read), "{contents} from {format}");
        }
    }
}

fn read_is_of_points<T>(outcome: Result<T, Error>) -> bool {
    matches!(outcome, Err(Error::Unsupported { contents: Contents::Points, .. }))
}

#[test]
fn what_is_written_is_in_the_table() {
    let flat = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    let solid = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    let plane = Delaunay2::from_points(&flat).expect("finite");
    let space = Delaunay3::from_points(&solid).expect("finite");
    let cells = plane.voronoi().clip(&Region2::rectangle([0.0; 2], [4.0; 2]).expect("a rectangle"));
    let options = picture::Options { size: 20, ..picture::Options::default() };
    let patches = Patches {
        points: flat.to_vec(),
        triangles: vec![[0, 1, 2]],
        polygons: vec![0],
        ..Patches::default()
    };
    for format in Format::all() {
        for &contents in Contents::ALL {
            let mut file = Vec::new();
            let out: &mut dyn Write = &mut file;
            let refused = match contents {
                Contents::Points => is_refused(write_points(out, format, &flat), format, contents),
                Contents::Lines => is_refused(write_graph(out, format, &Graph::default()), format, contents),
                Contents::Indices => is_refused(write_indices(out, format, 1, &[1]), format, contents),
                Contents::Triangles => {
                    is_refused(write_mesh(out, format, &Mesh::new(&plane, &flat), &options), format, contents)
                }
                Contents::SecondOrder => {
                    let mesh = Mesh { second_order: true, ..Mesh::new(&plane, &flat) };
                    matches!(write_mesh(out, format, &mesh, &options), Err(Error::Unsupported { .. }))
                }
                Contents::Tetrahedra => is_refused(
                    write_mesh(out, format, &Mesh::new(&space, &solid), &options),
                    format,
                    contents,
                ),
                Contents::Surfaces => {
                    let solid =
                        Solid { points: solid.to_vec(), faces: vec![vec![0, 2, 1]], ..Solid::default() };
                    is_refused(write_solid(out, format, &solid, &options), format, contents)
                }
                Contents::Cells => {
                    let diagram = Diagram { triangulation: &plane, cells: &cells, crs: None, features: None };
                    is_refused(write_diagram(out, format, &diagram, 20), format, contents)
                }
                Contents::Polyhedra => {
                    let region = Region3::cuboid([0.0; 3], [4.0; 3]).expect("a box");
                    let cells = space.voronoi().clip(&region);
                    let cells = Polyhedra::of_cells(&solid, &cells, None);
                    is_refused(write_polyhedra(out, format, &cells), format, contents)
                }
                Contents::Edges => {
                    // Pictures of edges are drawn with the triangulation below.
                    let edges = Edges { points: &flat, pairs: &[[0, 1]], widths: None, crs: None };
                    is_refused(write_edges(out, format, &edges), format, contents)
                }
                Contents::Patches => is_refused(write_patches(out, format, &patches, 20), format, contents),
                Contents::Contours => {
                    is_refused(write_contours(out, format, &ContourMap::default(), 20), format, contents)
                }
                Contents::Filtrations => {
                    is_refused(write_filtration(out, format, &plane.alpha()), format, contents)
                }
                Contents::Rasters => {
                    let grid = Grid::new([0.0; 2], [1.0, -1.0], 1, 1).expect("a raster");
                    let writer =
                        RasterWriter::create(Cursor::new(Vec::new()), format, &RasterInfo::new(grid));
                    let outcome = writer
                        .and_then(|mut writer| writer.write_rows(&[1.0]).map(|()| writer))
                        .and_then(RasterWriter::finish);
                    is_refused(outcome, format, contents)
                }
                _ => continue,
            };
            assert_eq!(refused, !format.holds(contents, Direction::Written), "{contents} to {format}");
            assert!(!refused || file.is_empty(), "{contents} to {format}");
        }
    }
}

#[test]
fn errors_name_what_holds_it() {
    let error = Format::Las.check(Contents::Cells, Direction::Written).expect_err("no cells");
    assert_eq!(error.to_string(), "Voronoi cells are not written to las files");
    assert_eq!(
        error.help(),
        "las files are read alone; Voronoi cells are written to: csv geojson fgb gpkg wkt wkb svg png"
    );
}

#[test]
fn formats_of_others_are_converted() {
    let help = |name: &str| Format::of(Path::new(name)).expect_err("no format").help().into_owned();
    let expected =
        "convert it with ogr2ogr -f GPKG out.gpkg maps/a.KML; as an output write gpkg, and convert that";
    assert_eq!(help("maps/a.KML"), expected);
    assert!(help("a.gdb").starts_with("convert it"));
    assert_eq!(help("a.what"), "name the format with --from or --to");
    assert_eq!("kml".parse::<Format>().expect_err("none").help(), "name the format with --from or --to");
}

/// The page of the book: a row for each format. `BLESS=1 cargo test -p delone-io --test all formats` writes it.
fn page() -> String {
    let held = |format: Format, direction| {
        let all = Contents::ALL.iter().filter(|contents| format.holds(**contents, direction));
        all.map(ToString::to_string).collect::<Vec<_>>().join(", ")
    };
    let mut page = "# Formats

A file's extension names its format; `--from` and `--to` name it where the extension does not. A file that ends in `.gz` is compressed,
read or written. `delone COMMAND --help` lists the formats of a command.

| extensions | format | reads | writes |
| --- | --- | --- | --- |
"
    .to_owned();
    for format in Format::all().filter(|&format| format != Format::WktCollection) {
        let names: Vec<_> = format.names().into_iter().flatten().map(|name| format!("`{name}`")).collect();
        let [read, written] = [Direction::Read, Direction::Written].map(|direction| held(format, direction));
        page += &format!("| {} | {} | {read} | {written} |\n", names.join(" "), format.title());
    }
    page + "
Layers of GeoPackage have a spatial index (the extension `gpkg_rtree_index`). FlatGeobuf is written without one: it would stand before
the features and in their order, so that all would have to be kept until the last is known. `ogr2ogr indexed.fgb cells.fgb` makes one.
"
}

/// The rows of the page of everything supported that name formats.
fn rows() -> Vec<String> {
    [
        ("points are read from", Contents::Points, Direction::Read),
        ("lines and polygons are read from", Contents::Lines, Direction::Read),
        ("meshes are written to", Contents::Triangles, Direction::Written),
        ("cells are written to", Contents::Cells, Direction::Written),
        ("tetrahedra, or their hull, are written to", Contents::Tetrahedra, Direction::Written),
        ("rasters are written to", Contents::Rasters, Direction::Written),
        ("triangles are judged from", Contents::Triangles, Direction::Read),
        ("tetrahedra are judged from", Contents::Tetrahedra, Direction::Read),
    ]
    .into_iter()
    .map(|(what, contents, direction)| format!("| {what} | {} |\n", Format::with(&[contents], direction)))
    .collect()
}

#[test]
fn pages_say_what_the_table_says() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("docs/reference/formats.md");
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, page()).expect("the page is written");
    }
    assert!(fs::read_to_string(path).expect("the page") == page(), "BLESS=1 writes the page");
    let supported = fs::read_to_string(root.join("docs/reference/supported.md")).expect("the page");
    for row in rows() {
        assert!(supported.contains(&row), "docs/reference/supported.md has no row {row}");
    }
}
