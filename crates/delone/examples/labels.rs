//! Names on vertices that come and go, and whose place it is: `cargo run --example labels` leaves `labels.svg`.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::{Delaunay2, Region2, VertexMap};
use picture::Picture;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let towns = [("Ada", [0.2, 0.3]), ("Boole", [0.7, 0.2]), ("Cantor", [0.5, 0.8]), ("Delone", [0.8, 0.6])];
    let mut d = Delaunay2::new();
    let mut names = VertexMap::new();
    for (name, place) in towns {
        names.insert(d.insert(place)?.vertex(), name);
    }
    for q in [[0.1, 0.1], [0.6, 0.6], [0.9, 0.3]] {
        let nearest = d.nearest(q)?.expect("there are towns");
        println!("{q:?} is nearest to {}", names[nearest]);
    }
    let boole = names.iter().find(|(_, name)| **name == "Boole").map(|(v, _)| v).expect("there");
    d.remove(boole)?;
    names.remove(boole);
    names.compact(&d.compact());
    let cells = d.voronoi().clip(&Region2::rectangle([0.0, 0.0], [1.0, 1.0])?);
    let mut picture = Picture::new([0.0, 0.0], [1.0, 1.0]);
    for (k, (v, name)) in names.iter().enumerate() {
        println!("{name} has {:.3}", cells.area(v));
        for ring in cells.rings(v) {
            picture.polygon(&ring.points().collect::<Vec<_>>(), k as f64 / 3.0);
        }
    }
    Ok(picture.save("labels.svg")?)
}
