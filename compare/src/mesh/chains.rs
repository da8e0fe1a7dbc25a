//! Whether the segments of the input are in a mesh: each as a chain of edges from its first end to its second.
//!
//! Steiner points are rounded, so whether one is on a segment is asked with the tolerance of [`super::wedges`]; a chain that
//! leaves a segment by more is a segment lost. Segments whose ends are in no triangle are outside. O(n log n), and for each
//! point of a chain the edges at it.

use super::input::Input;
use super::judge::Mesh;
use super::wedges::is_on;

/// The first segment that is lost.
pub fn lost(input: &Input, mesh: &Mesh) -> Option<usize> {
    let order = |p: &[f64; 2], q: &[f64; 2]| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]));
    let mut by_place: Vec<usize> = (0..mesh.points.len()).collect();
    by_place.sort_by(|&a, &b| order(&mesh.points[a], &mesh.points[b]));
    let vertex = |p: &[f64; 2]| {
        let at = by_place.binary_search_by(|&v| order(&mesh.points[v], p)).ok()?;
        Some(by_place[at])
    };
    let of_input: Vec<Option<usize>> = input.points.iter().map(vertex).collect();
    let mut edges: Vec<[usize; 2]> = mesh
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a], [b, a], [c, b], [a, c]])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let around = |v: usize| &edges[edges.partition_point(|e| e[0] < v)..edges.partition_point(|e| e[0] <= v)];
    let is_there = |ends: &[usize; 2]| {
        let [Some(first), Some(last)] = ends.map(|i| of_input[i]) else { return false };
        if around(first).is_empty() || around(last).is_empty() {
            return true;
        }
        let [a, b] = [first, last].map(|v| mesh.points[v]);
        let along = |v: usize| (0..2).map(|k| (mesh.points[v][k] - a[k]) * (b[k] - a[k])).sum::<f64>();
        let mut at = first;
        while at != last {
            // The next point of the chain: the nearest that is further along.
            let further = around(at).iter().map(|e| e[1]).filter(|&v| along(v) > along(at));
            let on = further.filter(|&v| v == last || is_on(mesh.points[v], a, b));
            let Some(next) = on.min_by(|&v, &w| along(v).total_cmp(&along(w))) else { return false };
            at = next;
        }
        true
    };
    input.segments.iter().position(|ends| !is_there(ends))
}

#[cfg(test)]
mod tests {
    use super::super::input::Input;
    use super::super::judge::Mesh;
    use super::lost;

    #[test]
    fn a_diagonal_is_there_or_is_lost() {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]];
        let input = Input {
            name: String::new(),
            points: points.clone(),
            segments,
            holes: vec![],
            is_hull: true,
            area: 4.0,
        };
        let mesh = |middle: Option<[f64; 2]>, triangles: &[[usize; 3]]| Mesh {
            points: points.iter().copied().chain(middle).collect(),
            triangles: triangles.to_vec(),
        };
        assert_eq!(lost(&input, &mesh(None, &[[0, 1, 2], [0, 2, 3]])), None);
        assert_eq!(lost(&input, &mesh(None, &[[0, 1, 3], [1, 2, 3]])), Some(4));
        let fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        assert_eq!(lost(&input, &mesh(Some([1.0, 1.0]), &fan)), None);
        assert_eq!(lost(&input, &mesh(Some([1.0, 1.1]), &fan)), Some(4));
    }
}
