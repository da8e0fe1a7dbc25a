//! Points of other types give the same triangulation.

use delone::{Delaunay2, Error, MAX_POINTS, Position2};

#[test]
fn numbers_of_other_types() {
    let count = |d: Result<Delaunay2, delone::Error>| d.expect("finite").triangles().count();
    assert_eq!(count(Delaunay2::from_points(&[[0.0_f32, 0.0], [1.0, 0.0], [0.0, 1.0]])), 1);
    assert_eq!(count(Delaunay2::from_points(&[[0_i32, 0], [1, 0], [0, 1]])), 1);
    assert_eq!(count(Delaunay2::from_points(&[(0.0_f64, 0.0), (1.0, 0.0), (0.0, 1.0)])), 1);
}

#[cfg(feature = "mint")]
#[test]
fn mint_points() {
    let points = [[0.0_f64, 0.0], [1.0, 0.0], [0.0, 1.0]].map(mint::Point2::from);
    assert_eq!(Delaunay2::from_points(&points).expect("finite").triangles().count(), 1);
}

#[cfg(feature = "geo-types")]
#[test]
fn geo_types_points() {
    let points = [[0.0_f64, 0.0], [1.0, 0.0], [0.0, 1.0]].map(geo_types::Point::from);
    assert_eq!(Delaunay2::from_points(&points).expect("finite").triangles().count(), 1);
    let coordinates = points.map(|p| p.0);
    assert_eq!(Delaunay2::from_points(&coordinates).expect("finite").triangles().count(), 1);
}

/// Takes no memory, so that a slice of it can be longer than memory.
#[derive(Clone, Copy)]
struct Origin;

impl Position2 for Origin {
    fn xy(&self) -> [f64; 2] {
        [0.0, 0.0]
    }
}

#[test]
fn too_many_points_are_refused() {
    // Arrays, which take no time to make: a vector is filled element by element where no optimizer sees that they have no size.
    let sets: [&[Origin]; 3] = [&[Origin; MAX_POINTS + 1], &[Origin; u32::MAX as usize], &[Origin; 1 << 40]];
    for points in sets {
        let error = Delaunay2::from_points(points).expect_err("too many");
        assert_eq!(error, Error::TooManyPoints { count: points.len(), most: MAX_POINTS });
    }
    assert_eq!(Delaunay2::from_points(&[Origin; 1000]).expect("finite").duplicates().count(), 999);
}
