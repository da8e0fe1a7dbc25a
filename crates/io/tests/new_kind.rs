//! A kind of triangulation that this crate does not know is written, drawn and asked like those that it knows.

use delone::Dimension;
use delone::Flaw2;
use delone::{
    Ask, Delaunay2, Delaunay3, Duplicate, Error, Found, Tally, TriangleId, Triangulation, VertexId, VertexMap,
};
use delone_io::{Contents, Drawable, Format, Mesh, Trim, picture, write_mesh};

use crate::meshes;

/// A triangulation whose vertices have names.
#[derive(Debug)]
struct Named {
    plain: Delaunay2,
    names: VertexMap<String>,
}

impl Named {
    fn of(points: &[[f64; 2]]) -> Self {
        let plain = Delaunay2::from_points(points).expect("finite");
        let names = plain.vertices().map(|v| (v, format!("point {}", v.index()))).collect();
        Self { plain, names }
    }
}

impl Triangulation for Named {
    type Point = [f64; 2];
    type Simplex = TriangleId;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = Flaw2;

    fn dimension(&self) -> Dimension {
        self.plain.dimension()
    }

    fn ids_given(&self) -> usize {
        self.plain.ids_given()
    }

    fn vertex_count(&self) -> usize {
        self.names.len()
    }

    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.names.iter().map(|(v, _)| v)
    }

    fn position(&self, v: VertexId) -> Option<[f64; 2]> {
        self.plain.position(v)
    }

    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.plain.duplicates()
    }

    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.plain.edges()
    }

    fn simplices(&self) -> impl Iterator<Item = TriangleId> + Send + '_ {
        self.plain.simplices()
    }

    fn index(&self, t: TriangleId) -> usize {
        self.plain.index(t)
    }

    fn slot_count(&self) -> usize {
        self.plain.slot_count()
    }

    fn corners(&self, t: TriangleId) -> [VertexId; 3] {
        self.plain.corners(t)
    }

    fn across(&self, t: TriangleId, k: usize) -> Option<TriangleId> {
        self.plain.across(t, k)
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TriangleId> {
        self.plain.simplices_at(v)
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.plain.hull_facets()
    }

    fn check(&self) -> Result<(), Flaw2> {
        self.plain.check()
    }
}

impl Ask for Named {
    fn find_observed<O: Tally>(&self, q: [f64; 2], observer: &mut O) -> Result<Found<TriangleId>, Error> {
        self.plain.find_observed(q, observer)
    }

    fn nearest_observed<O: Tally>(&self, q: [f64; 2], observer: &mut O) -> Result<Option<VertexId>, Error> {
        self.plain.nearest_observed(q, observer)
    }

    fn k_nearest(&self, q: [f64; 2], k: usize) -> Result<Vec<VertexId>, Error> {
        self.plain.k_nearest(q, k)
    }

    fn within(&self, q: [f64; 2], radius: f64) -> Result<Vec<VertexId>, Error> {
        self.plain.within(q, radius)
    }
}

/// Points of a grid, some of them twice.
fn points() -> Vec<[f64; 2]> {
    (0..120).map(|i| [f64::from(i % 10), f64::from(i % 100 / 10) + 0.01 * f64::from(i % 3)]).collect()
}

fn written<T: Triangulation<Point: Drawable>>(format: Format, mesh: &Mesh<T>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let options = picture::Options { size: 300, disks: Some(0.2), ..picture::Options::default() };
    write_mesh(&mut bytes, format, mesh, &options).expect("memory takes it");
    bytes
}

#[test]
fn a_new_kind_is_written_and_drawn() {
    let points = points();
    let named = Named::of(&points);
    let heights: Vec<f64> = points.iter().map(|p| p[0] * p[1]).collect();
    assert!(meshes(Contents::Triangles).next().is_some());
    for longest in [None, Some(1.2)] {
        let trims = longest.map(|l| [Trim::long_edges(&named, l), Trim::long_edges(&named.plain, l)]);
        let [trim, plain_trim] = trims.as_ref().map_or([None; 2], |[a, b]| [Some(a), Some(b)]);
        for heights in [None, Some(&heights[..])] {
            let mesh = Mesh { trim, heights, base: 1, ..Mesh::new(&named, &points) };
            let plain = Mesh { trim: plain_trim, heights, base: 1, ..Mesh::new(&named.plain, &points) };
            for format in meshes(Contents::Triangles) {
                assert!(written(format, &mesh) == written(format, &plain), "{format}");
            }
        }
    }
    let mut animation =
        picture::Animation::start(Vec::new(), [[0.0; 2], [9.0; 2]], 1, 40, picture::Options::default())
            .expect("a start");
    animation.add(&Mesh::new(&named, &points)).expect("a picture");
    animation.finish().expect("an end");
}

#[test]
fn a_new_kind_is_asked() {
    /// The vertices of the smallest face that holds a point.
    fn face<T: Ask<Point = [f64; 2]>>(t: &T, q: [f64; 2]) -> Vec<VertexId> {
        t.find(q).expect("finite").face().to_vec()
    }
    let named = Named::of(&points());
    for q in [[3.2, 4.1], [2.0, 0.02], [0.0, 0.0], [-1.0, 3.0]] {
        assert_eq!(face(&named, q), face(&named.plain, q));
        let v = named.nearest_observed(q, &mut ()).expect("finite").expect("a vertex");
        assert_eq!(named.names[v], format!("point {}", v.index()));
    }
}

#[test]
fn edges_of_space_tell_the_hull() {
    // Eight corners of a cube and its middle, which no edge of the hull ends at.
    let mut points: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
    points.push([0.5; 3]);
    let d = Delaunay3::from_points(&points).expect("finite");
    let text = String::from_utf8(written(Format::Edge, &Mesh::new(&d, &points))).expect("text");
    assert!(text.starts_with("26 1\n"), "{text}");
    for line in text.lines().skip(1) {
        let numbers: Vec<usize> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
        assert_eq!(numbers[3] == 0, numbers[1..3].contains(&8), "{line}");
    }
}
