//! Sets of the table, the same sets changed, and what the program made of them in the numbers of the set as it was.

use std::collections::BTreeMap;

use delone_generators::Random;
use serde_json::Value;

use crate::place::Place;

pub(super) type Point = [f64; 3];

/// Numbers that say what there is: corners one after the other, and what is known of them.
pub(super) type Shape = Vec<f64>;

/// Its name begins with the command; what it gives has no order.
pub(super) type Row = (&'static str, fn(&Given) -> Vec<Shape>);

/// Points with what commands need besides: as they were.
#[derive(Clone)]
pub(super) struct Set {
    pub(super) name: &'static str,
    /// In the plane the third number is a height.
    pub(super) points: Vec<Point>,
    pub(super) queries: Vec<Point>,
    /// About the size of the whole.
    pub(super) unit: f64,
    /// About the range of heights.
    pub(super) steep: f64,
}

/// The change of all coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Map {
    /// The power of two that each axis is scaled by.
    pub(super) powers: [i32; 3],
    /// Which axis comes where, counted from 1, with a minus where it is turned around.
    pub(super) axes: [i8; 3],
    pub(super) shift: Point,
}

impl Map {
    pub(super) const NONE: Self = Self { powers: [0; 3], axes: [1, 2, 3], shift: [0.0; 3] };

    fn to(&self, p: Point) -> Point {
        std::array::from_fn(|k| {
            let x = p[usize::from(self.axes[k].unsigned_abs()) - 1] * f64::from(self.axes[k].signum());
            x * 2f64.powi(self.powers[k]) + self.shift[k]
        })
    }

    fn back(&self, p: Point) -> Point {
        let mut was = [0.0; 3];
        for (k, x) in p.into_iter().enumerate() {
            let x = (x - self.shift[k]) / 2f64.powi(self.powers[k]);
            was[usize::from(self.axes[k].unsigned_abs()) - 1] = x * f64::from(self.axes[k].signum()) + 0.0;
        }
        was
    }

    /// Whether left is right.
    fn mirrors(&self) -> bool {
        let axis = |k: usize| self.axes[k].abs();
        let swaps = [(0, 1), (0, 2), (1, 2)].into_iter().filter(|&(i, j)| axis(i) > axis(j)).count();
        (swaps + self.axes.iter().filter(|axis| **axis < 0).count()) % 2 == 1
    }
}

/// A set in a folder of its own, changed.
pub(super) struct Given<'a> {
    pub(super) place: Place,
    pub(super) set: &'a Set,
    map: Map,
    /// As they were, in the order of `p.csv`.
    points: Vec<Point>,
    /// The first place that each of them is at, by its bits.
    first: BTreeMap<[u64; 3], usize>,
    /// Further words of the command.
    words: &'a str,
}

pub(super) fn compare(p: &[f64], q: &[f64]) -> std::cmp::Ordering {
    let first = p.iter().zip(q).map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
    first.unwrap_or(p.len().cmp(&q.len()))
}

fn comma(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",")
}

/// Numbers of points that look random, and that equal points have alike.
fn fraction(p: Point, factor: f64) -> f64 {
    ((p[0] + 2.0 * p[1] + 3.0 * p[2]) * factor).fract().abs()
}

/// Weights (squares of lengths) and radii are of a sixteenth of the unit at most, in steps of which squares are exact.
fn radius(p: Point, unit: f64) -> f64 {
    (fraction(p, 0.37) * 64.0).floor() / 1024.0 * unit
}

impl<'a> Given<'a> {
    pub(super) fn new(set: &'a Set, map: Map, which: &[usize], words: &'a str) -> Self {
        let points: Vec<Point> = which.iter().map(|&i| set.points[i]).collect();
        let mut first = BTreeMap::new();
        points.iter().enumerate().for_each(|(k, p)| _ = first.entry(p.map(f64::to_bits)).or_insert(k));
        let given = Self { place: Place::new(), set, map, points, first, words };
        let mut rows = String::from("x,y,z,w,r\n");
        for &p in &given.points {
            let r = radius(p, set.unit);
            let own = [given.length(r * r, 2), given.length(r, 1)];
            rows += &format!("{},{}\n", comma(&map.to(p)), comma(&own));
        }
        given.place.file("p.csv", rows);
        given.file("q.csv", &set.queries);
        given
    }

    /// The number of units in the set as it is.
    pub(super) fn length(&self, value: f64, power: i32) -> f64 {
        value * 2f64.powi(self.map.powers[0] * power)
    }

    /// An option that is a part of the unit, or of a power of it.
    pub(super) fn part(&self, value: f64, power: i32) -> String {
        format!("{:?}", self.length(value * self.set.unit.powi(power), power))
    }

    /// An option that is a height.
    pub(super) fn height(&self, value: f64) -> String {
        format!("{:?}", value * 2f64.powi(self.map.powers[2]))
    }

    /// A height as it was.
    pub(super) fn height_back(&self, value: f64) -> f64 {
        value / 2f64.powi(self.map.powers[2]) + 0.0
    }

    /// A number of this power of lengths as it was.
    pub(super) fn length_back(&self, value: f64, power: i32) -> f64 {
        value / 2f64.powi(self.map.powers[0] * power) + 0.0
    }

    /// The points of `p.csv` as they were.
    pub(super) fn points(&self) -> &[Point] {
        &self.points
    }

    pub(super) fn to(&self, p: Point) -> Point {
        self.map.to(p)
    }

    pub(super) fn back(&self, p: Point) -> Point {
        self.map.back(p)
    }

    /// A place of the plane in parts of the unit, as it is.
    pub(super) fn at(&self, x: f64, y: f64) -> Point {
        self.map.to([x * self.set.unit, y * self.set.unit, 0.0])
    }

    /// The box between two places in parts of the unit.
    pub(super) fn rectangle(&self, low: f64, high: f64) -> String {
        let [p, q] = [self.at(low, low), self.at(high, high)];
        comma(&[p[0].min(q[0]), p[1].min(q[1]), p[0].max(q[0]), p[1].max(q[1])])
    }

    /// A file of points of the set as it was.
    pub(super) fn file(&self, name: &str, points: &[Point]) {
        let rows: Vec<String> = points.iter().map(|&p| comma(&self.to(p))).collect();
        self.place.file(name, format!("x,y,z\n{}\n", rows.join("\n")));
    }

    /// A file of a geometry whose places are parts of the unit, and heights, as they were.
    pub(super) fn geometry(&self, name: &str, kind: &str, lines: &[&[Point]]) {
        let u = self.set.unit;
        let line = |line: &&[Point]| {
            let points = line.iter().map(|p| format!("[{}]", comma(&self.to([p[0] * u, p[1] * u, p[2]]))));
            format!("[{}]", points.collect::<Vec<_>>().join(","))
        };
        let lines = lines.iter().map(line).collect::<Vec<_>>().join(",");
        self.place.file(name, format!(r#"{{"type":"{kind}","coordinates":[{lines}]}}"#));
    }

    /// A file of lengths of edges that are wanted at some places.
    pub(super) fn sizes(&self, name: &str) {
        let size = |&q: &Point| {
            let [x, y, _] = self.to(q);
            comma(&[x, y, self.length((0.03125 + fraction(q, 0.3) / 8.0) * self.set.unit, 1)])
        };
        let rows: Vec<String> = self.set.queries.iter().map(size).collect();
        self.place.file(name, format!("x,y,size\n{}\n", rows.join("\n")));
    }

    /// A file of segments between points that are near each other along a line, some of which cross: in the order of the points, and
    /// from the first one on.
    pub(super) fn segments(&self, name: &str, step: usize) {
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        let key = |i: usize| self.points[i][0] + self.points[i][1] / 4.0;
        order.sort_by(|&i, &j| {
            key(i).total_cmp(&key(j)).then(compare(&self.points[i], &self.points[j])).then(i.cmp(&j))
        });
        order.dedup_by_key(|i| self.points[*i].map(f64::to_bits));
        let pair = |run: &[usize]| [run[0].min(run[step - 2]), run[0].max(run[step - 2])];
        let mut pairs: Vec<[usize; 2]> = order.chunks_exact(step).map(pair).collect();
        pairs.sort_unstable();
        self.place.file(name, pairs.iter().map(|[i, j]| format!("{i},{j}\n")).collect::<String>());
    }

    /// Runs the program in the folder, with the words that are tried.
    pub(super) fn run(&self, line: &str) -> String {
        self.place.succeed(&format!("-q {line} {}", self.words))
    }

    /// Prepares something for that.
    pub(super) fn prepare(&self, line: &str) {
        self.place.succeed(&format!("-q {line}"));
    }

    /// A point of the input by its index. Of equal ones the first stands for all.
    pub(super) fn point(&self, index: f64) -> Point {
        let point = self.points[index as usize];
        assert_eq!(self.first[&point.map(f64::to_bits)], index as usize, "the first of equal points");
        point
    }

    /// A cycle of points with its side: it begins anywhere, and a mirror turns it around.
    pub(super) fn cycle(&self, mut points: Vec<Point>) -> Shape {
        if self.map.mirrors() {
            points.reverse();
        }
        let least = (0..points.len()).min_by(|&i, &j| compare(&points[i], &points[j]));
        points.rotate_left(least.unwrap_or(0));
        points.concat()
    }

    /// An open line, whose left side a mirror makes the right one.
    pub(super) fn line(&self, mut points: Vec<Point>) -> Shape {
        if self.map.mirrors() {
            points.reverse();
        }
        points.concat()
    }

    /// A closed line whose last point may be the first again.
    pub(super) fn ring(&self, mut points: Vec<Point>) -> Shape {
        if points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        self.cycle(points)
    }

    /// The triangles of an OBJ file.
    pub(super) fn obj(&self, name: &str) -> Vec<Shape> {
        let text = self.place.read(name);
        let mut points: Vec<Point> = Vec::new();
        let mut shapes = Vec::new();
        for line in text.lines() {
            let numbers: Vec<f64> =
                line.split(' ').skip(1).map(|word| word.parse().expect("a number")).collect();
            match line.as_bytes()[0] {
                b'v' => points.push(self.back(numbers.try_into().expect("three"))),
                b'f' => shapes.push(self.cycle(numbers.iter().map(|&i| points[i as usize - 1]).collect())),
                _ => panic!("{line}"),
            }
        }
        shapes
    }

    /// The triangles and quadrilaterals of a mesh of SMS.
    pub(super) fn sms(&self, name: &str) -> Vec<Shape> {
        let text = self.place.read(name);
        let numbers = |card: &str| {
            let row = |line: &str| -> Vec<f64> {
                line.split(' ').skip(2).map(|word| word.parse().expect("a number")).collect()
            };
            text.lines().filter(|line| line.starts_with(card)).map(row).collect::<Vec<_>>()
        };
        let points: Vec<Point> = numbers("ND ").iter().map(|p| self.back([p[0], p[1], p[2]])).collect();
        let cells = [numbers("E3T "), numbers("E4Q ")].concat();
        let corners = |row: &[f64]| row.iter().map(|&i| points[i as usize - 1]).collect();
        // The last number is that of the material.
        cells.iter().map(|row| self.cycle(corners(&row[..row.len() - 1]))).collect()
    }

    /// The rows of a table of numbers, below a header if there is one.
    pub(super) fn table(&self, name: &str) -> Vec<Vec<f64>> {
        let text = self.place.read(name);
        let row = |line: &str| line.split(',').map(|word| word.parse().ok()).collect::<Option<Vec<f64>>>();
        text.lines()
            .enumerate()
            .filter_map(|(k, line)| row(line).or_else(|| (k > 0).then(|| panic!("{line}"))))
            .collect()
    }

    /// Rows of corners by index that have no order.
    pub(super) fn corners(&self, row: &[f64]) -> Shape {
        let mut corners: Vec<Point> = row.iter().map(|&i| self.point(i)).collect();
        corners.sort_by(|p, q| compare(p, q));
        corners.concat()
    }

    pub(super) fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.place.read(name)).expect("JSON")
    }

    /// The properties of each feature of a file, and its rings or lines.
    pub(super) fn features(&self, name: &str) -> Vec<(Value, Vec<Vec<Point>>)> {
        let Value::Array(features) = self.json(name)["features"].take() else { panic!("features") };
        let read = |mut feature: Value| {
            let mut lines = Vec::new();
            self.lines(&feature["geometry"]["coordinates"], &mut lines);
            (feature["properties"].take(), lines)
        };
        features.into_iter().map(read).collect()
    }

    fn lines(&self, value: &Value, lines: &mut Vec<Vec<Point>>) {
        let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
        if value[0][0].is_number() {
            let number = |x: &Value| x.as_f64().unwrap_or(0.0);
            let point = |p: &Value| self.back([number(&p[0]), number(&p[1]), number(&p[2])]);
            lines.push(list(value).iter().map(point).collect());
        } else {
            list(value).iter().for_each(|part| self.lines(part, lines));
        }
    }

    /// The numbers of an array file.
    pub(super) fn array(&self, name: &str) -> Vec<f64> {
        let bytes = std::fs::read(self.place.path(name)).expect("an array");
        let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        bytes[start..].chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().expect("eight"))).collect()
    }

    /// The cells of a raster of heights by their centers.
    pub(super) fn raster(&self, name: &str, cell: f64) -> Vec<Shape> {
        let cell = self.length(cell * self.set.unit, 1);
        let all = || self.points.iter().map(|&p| self.to(p));
        let steps = |k: usize| {
            let low = all().map(|p| p[k]).fold(f64::INFINITY, f64::min);
            let high = all().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
            [(low / cell).floor(), (high / cell).ceil()]
        };
        let ([west, east], [_, north]) = (steps(0), steps(1));
        let columns = (east - west) as usize;
        let shape = |(k, value): (usize, f64)| {
            let (x, y) = (west + (k % columns) as f64 + 0.5, north - (k / columns) as f64 - 0.5);
            self.back([x * cell, y * cell, value]).to_vec()
        };
        self.array(name).into_iter().enumerate().map(shape).collect()
    }
}

/// Points at random places of a square or cube.
pub(super) fn uniform(count: usize) -> Set {
    let mut random = Random::new(5);
    let mut points = |count: usize| (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect();
    Set { name: "uniform", points: points(count), queries: points(20), unit: 1.0, steep: 1.0 }
}

/// A lattice of tenths, whose circles all have ties; with queries at points, on edges and between.
pub(super) fn lattice(is_space: bool) -> Set {
    let at = |[i, j, k]: [usize; 3]| [i, j, k].map(|n| n as f64 * 0.1);
    let mut points: Vec<Point> = if is_space {
        (0..64).map(|n| at([n % 4, n / 4 % 4, n / 16])).collect()
    } else {
        (0..64).map(|n| at([n % 8, n / 8, n * 37 % 11])).collect()
    };
    let queries = points
        .iter()
        .step_by(9)
        .chain(&[[0.15, 0.1, 0.1], [0.25, 0.25, 0.25], [2.0, 0.1, 0.1]])
        .copied()
        .collect();
    Random::new(2).shuffle(&mut points);
    Set { name: "lattice", points, queries, unit: 0.75, steep: 1.0 }
}

/// Integers, among which no four are on a circle, no five on a sphere and no three on a line, as far as decisions see.
pub(super) fn integers(count: usize) -> Set {
    let mut random = Random::new(8);
    let mut points =
        |count: usize| (0..count).map(|_| std::array::from_fn(|_| random.below(1024) as f64)).collect();
    Set { name: "integers", points: points(count), queries: points(20), unit: 1024.0, steep: 1024.0 }
}

/// A picture of lines and areas. Its bar is of a round length, which another unit makes another one.
pub(super) fn drawn(g: &Given, name: &str) -> Vec<Shape> {
    let text = g.place.read(name);
    let lines = text.lines().filter(|line| !line.starts_with("<text") && !line.contains("fill=\"#263238\""));
    lines.map(|line| line.bytes().map(f64::from).collect()).collect()
}
