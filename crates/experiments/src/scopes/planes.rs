//! Edges in space by the points beyond a plane through them: the remark after Lemma 4.3 (Guibas, Knuth & Sharir 1992, §4.2).

use delone_generators::{Kind3, Random};
use delone_predicates::orient3d;

use super::super::table::short;
use super::super::{Findings, Options};

/// Points of each set.
const COUNTED: [usize; 2] = [20, 40];
/// The remark gives an order of growth. The constant is that of the proof of Lemma 2.5 for one side, 3 e: the hull of a sample of
/// n / (k + 1) points has three times as many edges at most.
const BOUND: f64 = 8.2;

/// The fewest points that are on one side of a plane through two: of the planes through a third one, which can be turned to
/// either side of it.
fn fewest_beyond(points: &[[f64; 3]], x: usize, y: usize) -> usize {
    let others: Vec<usize> = (0..points.len()).filter(|i| ![x, y].contains(i)).collect();
    let beyond = |&z: &usize| {
        let rest = others.iter().filter(|&&i| i != z);
        let above =
            rest.filter(|&&i| orient3d(points[x], points[y], points[z], points[i]).is_positive()).count();
        above.min(others.len() - 1 - above)
    };
    others.iter().map(beyond).min().unwrap_or(0)
}

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) {
    let title = "Edges in space with a plane through them that has at most k points on one side, O(k n) (the remark after Lemma 4.3)";
    let heads = ["set", "points", "k", "edges", "in units of n (k+1)", "by the proof"];
    let mut table = options.table("scopes-planes", title, &heads);
    let moment = |n: usize| {
        let mut random = Random::new(options.seed);
        let at = |_| {
            let t = random.between(-1.0, 1.0);
            [t, t * t, t * t * t]
        };
        (0..n).map(at).collect()
    };
    for n in COUNTED {
        let sets: [(&str, Vec<[f64; 3]>); 3] = [
            ("cube", Kind3::Cube.points(n, options.seed)),
            ("sphere", Kind3::Sphere.points(n, options.seed)),
            ("moment curve", moment(n)),
        ];
        for (set, points) in sets {
            let pairs = (0..n).flat_map(|x| (x + 1..n).map(move |y| (x, y)));
            let fewest: Vec<usize> = pairs.map(|(x, y)| fewest_beyond(&points, x, y)).collect();
            for k in [0, 1, 2, 4, 8] {
                let edges = fewest.iter().filter(|&&fewest| fewest <= k).count();
                let units = edges as f64 / (n * (k + 1)) as f64;
                let names = [set.to_owned(), n.to_string(), k.to_string(), edges.to_string()];
                table.row(names.into_iter().chain([short(units), short(BOUND)]));
            }
        }
    }
    findings.tables.push(table);
}

#[cfg(test)]
mod tests {
    use super::fewest_beyond;

    #[test]
    fn edges_of_the_hull_have_nothing_beyond() {
        // A tetrahedron around a point: the edge from a corner to it has a corner on each side.
        let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [0.9, 1.0, 1.1]];
        assert_eq!(fewest_beyond(&points, 0, 1), 0);
        assert_eq!(fewest_beyond(&points, 0, 4), 1);
    }
}
