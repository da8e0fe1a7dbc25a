//! Scenes: the common parts of sketches of algorithms: the triangulation below, and the steps of the algorithm.

use delone::{Delaunay2, Error, Tally, Triangulation, VertexId};
use delone_io::picture::{Mark, Sketch, Tone};

use super::motion::window;
use super::{build, locate};
use crate::args::{AnimateArgs, Show};

/// A scene, and its window.
pub(super) struct Scene {
    pub(super) sketches: Vec<Sketch>,
    pub(super) window: [[f64; 2]; 2],
}

/// The pictures of a scene, at most one more than steps.
pub(super) fn of(points: &[[f64; 2]], args: &AnimateArgs) -> Result<Scene, Error> {
    let mut window = window(points);
    // Disks reach beyond their centers, and points as far again.
    let radius = match args.radius {
        Some(radius) => radius,
        None => build::half_of_the_nearest(points)?,
    };
    if args.show == Show::Hints {
        window = [window[0].map(|x| x - radius), window[1].map(|x| x + radius)];
        window = window.map(|corner| corner.map(|x| x.clamp(f64::MIN, f64::MAX)));
    }
    let most = args.steps as usize + 1;
    let mut sketches = match args.show {
        Show::Motion => Vec::new(),
        Show::Flips => build::flips(points, args.seed, most)?,
        Show::Lists => build::lists(points, args.seed, most)?,
        Show::Hints => build::hints(points, radius, args.seed, most)?,
        Show::Walk | Show::Jump | Show::Levels => locate::descents(points, args.show, args.seed, most)?,
    };
    sketches.truncate(most);
    if sketches.is_empty() {
        // Of too few points for anything to happen there is one picture.
        let d = Delaunay2::from_points(points)?;
        sketches.push(Sketch {
            marks: mesh(&d, Tone::Plain),
            caption: "nothing to show".to_owned(),
            ..Sketch::default()
        });
    }
    Ok(Scene { sketches, window })
}

/// The edges and vertices of a triangulation.
pub(super) fn mesh(d: &Delaunay2, tone: Tone) -> Vec<Mark> {
    let edges = Triangulation::edges(d).map(|ends| Mark::Line(ends.map(|v| d.point(v)), tone));
    edges.chain(d.vertices().map(|v| Mark::Dot(d.point(v), tone))).collect()
}

/// The corners of a triangle.
pub(super) fn corners(d: &Delaunay2, triangle: [VertexId; 3]) -> Vec<[f64; 2]> {
    triangle.map(|v| d.point(v)).to_vec()
}

/// The steps of an operation: the corners of triangles, or single vertices, and their level.
#[derive(Debug, Default)]
pub(super) struct Seen {
    pub(super) sights: Vec<(usize, Vec<[f64; 2]>)>,
    /// How many sights there were when triangles were made.
    pub(super) insertions: Vec<usize>,
    level: usize,
}

impl Tally for Seen {
    fn saw(&mut self, corners: impl FnOnce() -> Vec<Vec<f64>>) {
        self.sights.push((self.level, corners().iter().map(|p| [p[0], p[1]]).collect()));
    }

    fn created(&mut self, _: usize) {
        self.insertions.push(self.sights.len());
    }

    fn level(&mut self, level: usize) {
        self.level = level;
    }
}
