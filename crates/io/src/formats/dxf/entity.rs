//! Entities: what their groups say, and which geometry that is.

use super::curves::Path;
use super::splines::{Ellipse, Spline, Vertex, WHOLE_TURN};
use crate::Error;
use crate::error::excerpt;

/// The groups of an entity.
pub(super) struct Entity {
    pub(super) kind: String,
    pub(super) layer: String,
    /// The name of a block.
    pub(super) name: String,
    /// The numbers, with their codes.
    numbers: Vec<(i32, f64)>,
    /// The vertices of a polyline that are entities of their own, with the bulges of the arcs that begin at them.
    vertices: Vec<([f64; 3], f64)>,
}

/// A geometry.
#[derive(Debug)]
pub(super) enum Item {
    Point { layer: String, at: [f64; 3], is_high: bool },
    Line { layer: String, path: Path, is_closed: bool, is_high: bool },
    Insert { layer: String, insert: Insert },
}

/// Where a block is inserted.
#[derive(Debug)]
pub(super) struct Insert {
    pub(super) name: String,
    pub(super) at: [f64; 3],
    pub(super) scale: [f64; 3],
    /// In degrees.
    pub(super) angle: f64,
    /// Columns and rows, and the steps between them.
    pub(super) counts: [u32; 2],
    pub(super) steps: [f64; 2],
}

/// The kind of an entity.
pub(super) enum What {
    Is(Item),
    /// It is left out, and counted as that.
    IsNot(String),
}

impl Item {
    pub(super) fn layer(&self) -> &str {
        match self {
            Self::Point { layer, .. } | Self::Line { layer, .. } | Self::Insert { layer, .. } => layer,
        }
    }

    pub(super) fn is_closed(&self) -> bool {
        matches!(self, Self::Line { is_closed: true, .. })
    }

    /// Whether its positions have heights.
    pub(super) fn is_high(&self) -> bool {
        matches!(self, Self::Point { is_high: true, .. } | Self::Line { is_high: true, .. })
    }
}

/// The kinds that have numbers which are read.
const KINDS: [&str; 12] = [
    "POINT",
    "LINE",
    "ARC",
    "CIRCLE",
    "ELLIPSE",
    "SPLINE",
    "LWPOLYLINE",
    "POLYLINE",
    "VERTEX",
    "3DFACE",
    "INSERT",
    "BLOCK",
];

/// Codes of groups.
const NAME: i32 = 2;
const LAYER: i32 = 8;
const X: i32 = 10;
const Y: i32 = 20;
const Z: i32 = 30;
const ELEVATION: i32 = 38;
const RADIUS: i32 = 40;
const SCALE: i32 = 41;
const BULGE: i32 = 42;
const STEPS: [i32; 2] = [44, 45];
const ANGLE: i32 = 50;
const END_ANGLE: i32 = 51;
const DEGREE: i32 = 71;
const KNOT: i32 = 40;
const WEIGHT: i32 = 41;
const PARAMETERS: [i32; 2] = [41, 42];
const ON_PAPER: i32 = 67;
const FLAGS: i32 = 70;
const COUNTS: [i32; 2] = [70, 71];
const UP: i32 = 230;

/// Flags of polylines and vertices.
const CLOSED: u32 = 1;
const IN_SPACE: u32 = 8;
const MESHES: u32 = 16 | 64;
const FRAME: u32 = 16;

impl Entity {
    pub(super) fn new(kind: String) -> Self {
        Self { kind, layer: String::new(), name: String::new(), numbers: Vec::new(), vertices: Vec::new() }
    }

    /// Takes a group.
    pub(super) fn group(&mut self, code: i32, value: String, line: usize) -> Result<(), Error> {
        match code {
            NAME => self.name = value,
            LAYER => self.layer = value,
            10..=79 | 210..=239 if KINDS.contains(&self.kind.as_str()) => {
                let number = value.parse().map_err(|_| Error::Line {
                    line,
                    what: format!("{:?} of {} is no number", excerpt(&value), self.kind),
                })?;
                self.numbers.push((code, number));
            }
            _ => {}
        }
        Ok(())
    }

    /// Takes a vertex of a polyline; those of the frame of a curve are none.
    pub(super) fn vertex(&mut self, vertex: &Self) {
        if vertex.flags() & FRAME == 0 {
            let bulge = vertex.number(BULGE).unwrap_or_default();
            self.vertices.push((vertex.corner(0).unwrap_or_default(), bulge));
        }
    }

    fn number(&self, code: i32) -> Option<f64> {
        self.numbers.iter().find(|number| number.0 == code).map(|number| number.1)
    }

    fn flags(&self) -> u32 {
        self.number(FLAGS).unwrap_or_default() as u32
    }

    /// A corner, by its number, if there is one.
    fn corner(&self, k: i32) -> Option<[f64; 3]> {
        let [x, y] = [self.number(X + k)?, self.number(Y + k)?];
        Some([x, y, self.number(Z + k).unwrap_or_default()])
    }

    /// The geometry that it is.
    pub(super) fn item(self) -> What {
        if self.number(ON_PAPER).is_some_and(|paper| paper != 0.0) {
            return What::IsNot(format!("{} on paper", self.kind));
        }
        // Coordinates of what is flat are those of its plane: seen from above, or from below with x to the left.
        let in_space = self.kind == "POLYLINE" && self.flags() & IN_SPACE != 0;
        let is_flat = ["ARC", "CIRCLE", "LWPOLYLINE", "INSERT"].contains(&self.kind.as_str())
            || self.kind == "POLYLINE" && !in_space;
        let up = self.number(UP).unwrap_or(1.0);
        if (is_flat || self.kind == "ELLIPSE") && up.abs() != 1.0 {
            return What::IsNot(format!("{} in a tilted plane", self.kind));
        }
        let sign = if is_flat && up < 0.0 { -1.0 } else { 1.0 };
        self.placed(sign).map_or_else(What::IsNot, What::Is)
    }

    /// The geometry, with x and z times a sign; or what it is counted as.
    fn placed(mut self, sign: f64) -> Result<Item, String> {
        let turned = |[x, y, z]: [f64; 3]| [sign * x, y, sign * z];
        let has_height = |code: i32| self.number(code).is_some();
        let short = || format!("{} without a position", self.kind);
        let line = |mut path: Path, is_closed, is_high, layer| {
            path.points.iter_mut().for_each(|point| *point = turned(*point));
            path.centers.iter_mut().for_each(|(_, center)| *center = turned(*center));
            Item::Line { layer, path, is_closed, is_high }
        };
        match self.kind.as_str() {
            "POINT" => {
                let (at, is_high) = (self.corner(0).ok_or_else(short)?, has_height(Z));
                Ok(Item::Point { at, is_high, layer: self.layer })
            }
            "LINE" => {
                let points = vec![self.corner(0).ok_or_else(short)?, self.corner(1).ok_or_else(short)?];
                Ok(line(Path::straight(points), false, has_height(Z), self.layer))
            }
            "ARC" | "CIRCLE" => {
                let center = self.corner(0).ok_or_else(short)?;
                let radius = self.number(RADIUS).filter(|radius| *radius > 0.0);
                let radius = radius.ok_or_else(|| format!("{} without a radius", self.kind))?;
                let is_circle = self.kind == "CIRCLE";
                let angle = |code: i32| self.number(code).unwrap_or_default();
                let angles = (!is_circle).then(|| [ANGLE, END_ANGLE].map(angle));
                if angles.iter().flatten().chain(&[radius]).any(|x| !x.is_finite()) {
                    return Err(format!("{} of numbers that are not finite", self.kind));
                }
                Ok(line(Path::around(center, radius, angles), is_circle, has_height(Z), self.layer))
            }
            "ELLIPSE" | "SPLINE" => {
                let (vertices, is_closed) =
                    if self.kind == "ELLIPSE" { self.ellipse()? } else { self.spline()? };
                let height = self.number(Z).unwrap_or_default();
                let raised: Vec<_> =
                    vertices.into_iter().map(|([x, y], bulge)| ([x, y, height], bulge)).collect();
                let path = Path { curves: 1, ..Path::with_bulges(&raised, is_closed) };
                Ok(line(path, is_closed, has_height(Z), self.layer))
            }
            "3DFACE" => {
                let mut points: Vec<[f64; 3]> = (0..4).map_while(|k| self.corner(k)).collect();
                points.dedup();
                Ok(line(Path::straight(points), true, true, self.layer))
            }
            "LWPOLYLINE" => {
                let height = self.number(ELEVATION);
                let mut vertices: Vec<([f64; 3], f64)> = Vec::new();
                for &(code, number) in &self.numbers {
                    match (code, vertices.last_mut()) {
                        (X, _) => vertices.push(([number, 0.0, height.unwrap_or_default()], 0.0)),
                        (Y, Some(vertex)) => vertex.0[1] = number,
                        (BULGE, Some(vertex)) => vertex.1 = number,
                        _ => {}
                    }
                }
                let is_closed = self.flags() & CLOSED != 0;
                Ok(line(Path::with_bulges(&vertices, is_closed), is_closed, height.is_some(), self.layer))
            }
            "POLYLINE" if self.flags() & MESHES != 0 => Err("POLYLINE that is a mesh".to_owned()),
            "POLYLINE" => {
                let mut vertices = std::mem::take(&mut self.vertices);
                let is_in_space = self.flags() & IN_SPACE != 0;
                // Of what is flat, the height is that of the polyline.
                if let Some(height) = self.number(Z).filter(|_| !is_in_space) {
                    vertices.iter_mut().for_each(|vertex| vertex.0[2] = height);
                }
                if is_in_space {
                    vertices.iter_mut().for_each(|vertex| vertex.1 = 0.0);
                }
                let is_closed = self.flags() & CLOSED != 0;
                Ok(line(Path::with_bulges(&vertices, is_closed), is_closed, true, self.layer))
            }
            "INSERT" => {
                let counts = COUNTS.map(|code| self.number(code).map_or(1, |count| count as u32).max(1));
                let steps = STEPS.map(|code| self.number(code).unwrap_or_default());
                let scale = [0, 1, 2].map(|k| self.number(SCALE + k).unwrap_or(1.0));
                let insert = Insert {
                    at: turned(self.corner(0).ok_or_else(short)?),
                    scale: turned(scale),
                    angle: sign * self.number(ANGLE).unwrap_or_default(),
                    counts,
                    steps: [sign * steps[0], steps[1]],
                    name: self.name,
                };
                Ok(Item::Insert { layer: self.layer, insert })
            }
            _ => Err(self.kind),
        }
    }

    /// The numbers of a code, in their order.
    fn all(&self, code: i32) -> Vec<f64> {
        self.numbers.iter().filter(|number| number.0 == code).map(|number| number.1).collect()
    }

    /// The arcs of an ellipse, and whether it is whole.
    fn ellipse(&self) -> Result<(Vec<Vertex>, bool), String> {
        let short = || "ELLIPSE without a position or an axis".to_owned();
        let ([x, y, _], [u, v, w]) = (self.corner(0).ok_or_else(short)?, self.corner(1).ok_or_else(short)?);
        let ratio = self.number(RADIUS).unwrap_or(1.0) * self.number(UP).unwrap_or(1.0);
        let [first, last] = PARAMETERS.map(|code| self.number(code));
        let (first, last) = (first.unwrap_or(0.0), last.unwrap_or(std::f64::consts::TAU));
        let last = if last > first { last } else { last + std::f64::consts::TAU };
        let is_ellipse = [x, y, u, v, w, ratio, first, last].iter().all(|x| x.is_finite())
            && ratio != 0.0
            && (u, v) != (0.0, 0.0)
            && last > first;
        if !is_ellipse {
            return Err("ELLIPSE of numbers that are none".to_owned());
        }
        if w != 0.0 {
            return Err("ELLIPSE in a tilted plane".to_owned());
        }
        let ellipse = Ellipse { center: [x, y], axes: [[u, v], [-ratio * v, ratio * u]] };
        let is_whole = WHOLE_TURN.contains(&(last - first));
        let mut vertices = ellipse.arcs([first, if is_whole { first + std::f64::consts::TAU } else { last }]);
        vertices.truncate(vertices.len() - usize::from(is_whole));
        Ok((vertices, is_whole))
    }

    /// The arcs of a spline, and whether it is closed.
    fn spline(&self) -> Result<(Vec<Vertex>, bool), String> {
        let [x, y, z] = [X, Y, Z].map(|code| self.all(code));
        if x.is_empty() {
            return Err("SPLINE of fit points".to_owned());
        }
        if z.windows(2).any(|pair| pair[0] != pair[1]) {
            return Err("SPLINE that is not level".to_owned());
        }
        let mut weights = self.all(WEIGHT);
        weights.resize(x.len(), 1.0);
        let places = x.into_iter().zip(y).map(|(x, y)| [x, y]);
        let degree = self.number(DEGREE).unwrap_or_default() as usize;
        let spline = Spline { degree, knots: self.all(KNOT), points: places.zip(weights).collect() };
        let mut vertices = spline.arcs().map_err(|why| format!("SPLINE {why}"))?;
        let ends = [vertices[0].0, vertices[vertices.len() - 1].0];
        let is_closed = vertices.len() > 2 && (self.flags() & CLOSED != 0 || ends[0] == ends[1]);
        vertices.truncate(vertices.len() - usize::from(is_closed));
        Ok((vertices, is_closed))
    }

    /// The base point of a block.
    pub(super) fn base(&self) -> [f64; 3] {
        self.corner(0).unwrap_or_default()
    }
}
