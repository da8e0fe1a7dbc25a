//! The library of terrain models writes the bytes of the program.

use std::fs;
use std::ops::ControlFlow;

use delone::surface::{Border, Duplicates};
use delone_generators::{Kind, Random};
use delone_io::{Compression, Format};
use delone_terrain::{
    Cells, Files, Lines, Method, Options, Product, Terrain, read_clip, read_lines, read_place,
};

use crate::place::{Place, data};

const RIDGE: &str = r#"{"type": "MultiLineString", "coordinates": [[[0.1, 0.2, 9], [0.9, 0.7, 5]], [[0.2, 0.9], [0.8, 0.1]]]}"#;
const LAKE: &str =
    r#"{"type": "Polygon", "coordinates": [[[0.3, 0.3], [0.6, 0.35], [0.5, 0.6], [0.3, 0.3]]]}"#;
const AREA: &str =
    r#"{"type": "Polygon", "coordinates": [[[0.05, 0.05], [0.9, 0.1], [0.8, 0.9], [0.05, 0.05]]]}"#;

fn write(terrain: &Terrain, place: &Place, names: &[&str], product: &Product) {
    let file = |name: &&str| (place.path(name), Format::of(name.as_ref()).expect("a format"));
    let files: Vec<_> = names.iter().map(file).collect();
    terrain.write(&files, product, |_| ControlFlow::Continue(())).expect("written");
}

fn compare(place: &Place, names: &[(&str, &str)], what: &str) {
    for (ours, theirs) in names {
        let [ours, theirs] = [ours, theirs].map(|name| fs::read(place.path(name)).expect("a file"));
        assert!(ours == theirs, "{what}");
    }
}

#[test]
fn the_library_writes_the_bytes_of_the_program() {
    let place = Place::new();
    let mut random = Random::new(3);
    let points = Kind::Uniform.points(700, 1);
    let rows = points.iter().map(|[x, y]| format!("{x:?},{y:?},{:?}\n", random.between(0.0, 2.0)));
    place.file("p.csv", rows.collect::<String>());
    place.file("ridge.geojson", RIDGE);
    place.file("lake.geojson", LAKE);
    place.file("area.geojson", AREA);
    for method in Method::ALL {
        let common = format!("-q dtm p.csv --method {method} --breaklines ridge.geojson --flat lake.geojson");
        place.succeed(&format!(
            "{common} --cell 0.03 --clip area.geojson --duplicates mean --max-edge 0.3 --nodata -7 --compress lzw --interval 0.5 \
             -o a.tif -o a.npy -o a.png -o a.geojson"
        ));
        let options =
            Options::new().method(method).duplicates(Duplicates::Mean).border(Border::long_edges(Some(0.3)));
        let mut lines = Lines::new();
        lines.breaklines(&read_lines(&place.path("ridge.geojson")).expect("a file")).expect("lines");
        lines.level(&read_lines(&place.path("lake.geojson")).expect("a file")).expect("polygons");
        let cloud = Files::new([place.path("p.csv")]).read().expect("points");
        let cells = Cells::new().size(0.03);
        let terrain = Terrain::new(&cloud, lines, &cells, &options)
            .and_then(|terrain| terrain.clipped(read_clip(&place.path("area.geojson"))?))
            .expect("a surface");
        let product = Product::new().nodata(-7.0).compression(Compression::Lzw).interval(0.5);
        write(&terrain, &place, &["b.tif", "b.npy", "b.png", "b.geojson"], &product);
        let names = [("a.tif", "b.tif"), ("a.npy", "b.npy"), ("a.png", "b.png"), ("a.geojson", "b.geojson")];
        compare(&place, &names, method.name());
    }
}

#[test]
fn ground_of_lidar_over_the_cells_of_another_raster() {
    let place = Place::new();
    let tile = data("autzen_trim.laz");
    place.succeed(&format!("-q dtm {} --cell 20 -o a.tif -o a.asc", tile.display()));
    place.succeed(&format!("-q dtm {} --all-classes --like a.tif -o c.tif", tile.display()));
    let files = Files::new([&tile]);
    let make = |files: &Files, cells: &Cells| {
        let cloud = files.read().expect("points");
        Terrain::new(&cloud, Lines::new(), cells, &Options::new()).expect("a surface")
    };
    write(&make(&files, &Cells::new().size(20.0)), &place, &["b.tif", "b.asc"], &Product::new());
    let (grid, _) = read_place(&place.path("a.tif")).expect("a raster");
    let cells = Cells::new().like(grid).expect("north is up");
    write(&make(&files.all_classes(true), &cells), &place, &["d.tif"], &Product::new());
    compare(&place, &[("a.tif", "b.tif"), ("a.asc", "b.asc"), ("c.tif", "d.tif")], "LiDAR");
}
