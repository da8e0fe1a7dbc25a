use super::super::cut::{Sites, divide};
use super::super::{Rest, triangulate_whole, with_duplicates};
use super::triangulate;
use crate::duplicates::Duplicates;
use crate::mesh::{Mesh3, Names};
use crate::space::layer::Layer;
use crate::space::layer::kernel::Lift;
use crate::space::regular::build::assemble;
use crate::space::{Delaunay3, Regular3};
use delone_generators::{Kind3, Random};

/// All tetrahedra, ghosts included, as sorted corners.
fn cells(mesh: &Mesh3) -> Vec<[usize; 4]> {
    let corners = |t| {
        let mut corners = mesh.corners(t).map(crate::VertexId::index);
        corners.sort_unstable();
        corners
    };
    let mut cells: Vec<[usize; 4]> = mesh.cells().map(corners).collect();
    cells.sort_unstable();
    cells
}

/// Sites triangulated in parts and as a whole, if they can be cut so often.
fn apart_and_whole<W: Lift>(points: &[[f64; 3]], weights: &[W], cuts: u32) -> Option<[(Layer<W>, Rest); 2]> {
    let all = (0..points.len() as u32).collect();
    let runs = divide(Sites { points, weights }, all, cuts, Vec::new());
    if runs.len() == 1 {
        return None;
    }
    let order: Vec<u32> = runs.iter().flat_map(|run| run.order.iter().copied()).collect();
    let along = order.iter().map(|&i| i as usize);
    let mut layer =
        Layer::with_weights(along.clone().map(|i| points[i]).collect(), along.map(|i| weights[i]).collect());
    layer.mesh.names = Names::along(&order);
    let mut whole = layer.clone();
    let runs: Vec<_> = runs.into_iter().map(|run| (run.order.len(), run.others)).collect();
    let rest = triangulate(&mut layer, &runs, 0, &mut ())?;
    let rest_of_whole = triangulate_whole(&mut whole, 0, &mut ())?;
    Some([(layer, rest), (whole, rest_of_whole)])
}

#[test]
fn parts_are_joined_to_the_one_triangulation() {
    let mut joined = 0;
    for &kind in Kind3::ALL {
        for (count, cuts) in [(40, 1), (300, 1), (700, 3), (1500, 2)] {
            let points = kind.points(count, 7);
            let Some(built) = apart_and_whole(&points, &vec![(); points.len()], cuts) else { continue };
            joined += 1;
            let [apart, whole] = built.map(|built| {
                let (base, duplicates) = with_duplicates(built);
                Delaunay3 { base, duplicates: Duplicates::new(duplicates), ..Delaunay3::default() }
            });
            apart.check().unwrap_or_else(|flaw| panic!("{} {count}: {flaw}", kind.name()));
            assert_eq!(cells(apart.mesh()), cells(whole.mesh()), "{} {count}", kind.name());
            assert!(apart.duplicates().eq(whole.duplicates()), "{} {count}", kind.name());
        }
    }
    assert!(joined > 40, "{joined}");
}

/// Compares both, with all hidden sites.
fn assert_equal([apart, whole]: &[Regular3; 2], what: &str) {
    apart.check().unwrap_or_else(|flaw| panic!("{what}: {flaw}"));
    assert_eq!(cells(apart.mesh()), cells(whole.mesh()), "{what}");
    assert_eq!(apart.vertex_count(), whole.vertex_count(), "{what}");
    assert!(apart.vertices().eq(whole.vertices()), "{what}");
    assert!(apart.hidden().eq(whole.hidden()), "{what}");
    assert!(apart.duplicates().eq(whole.duplicates()), "{what}");
}

#[test]
fn parts_with_weights_are_joined_to_the_one_triangulation() {
    let mut random = Random::new(5);
    let mut joined = 0;
    for &kind in Kind3::ALL {
        for (count, cuts) in [(40, 1), (100, 2), (250, 3)] {
            let points = kind.points(count, 7);
            let size = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
            let square = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
            for family in 0..8 {
                let mut weight = |p: &[f64; 3]| match family {
                    // Few, many and nearly all hidden.
                    0 => (0.05 * size * random.unit()).powi(2),
                    1 => (0.4 * size * random.unit()).powi(2),
                    2 => (4.0 * size * random.unit()).powi(2),
                    // Lifted to one plane, rounded; nearly to one; to a saddle; negative ones that tie.
                    3 => square(p),
                    4 => square(p) + [0.0, 1.0, -1.0][random.below(3)] * size * size / 1024.0,
                    5 => p[0] * p[0] - p[1] * p[1],
                    6 => random.below(4) as f64 * -size * size,
                    // All but few far lighter.
                    _ => [-1e6, 1e-9, 3.0][random.below(40).min(2)] * size * size,
                };
                let weights: Vec<f64> = points.iter().map(&mut weight).collect();
                let Some(built) = apart_and_whole(&points, &weights, cuts) else { continue };
                joined += 1;
                assert_equal(&built.map(assemble), &format!("{} {count} {family}", kind.name()));
            }
        }
    }
    assert!(joined > 250, "{joined}");
}

/// One site hides all of the other part, or all sites but the corners; and equal sites are hidden with the one they equal.
#[test]
fn one_site_hides_what_another_part_thinks_it_has() {
    let mut hidden = 0;
    for &kind in &[Kind3::Cube, Kind3::Grid3] {
        let mut points = kind.points(300, 3);
        let doubled = points[..30].to_vec();
        points.extend(doubled);
        let size = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        for share in [0.1, 0.3, 1.0, 1e3, 1e100] {
            for heavy in [0, 17, 299] {
                for cuts in [1, 2, 3] {
                    let mut weights = vec![0.0; points.len()];
                    weights[heavy] = share * size * size;
                    let Some(built) = apart_and_whole(&points, &weights, cuts) else { continue };
                    let [apart, whole] = built.map(assemble);
                    hidden += apart.hidden().count();
                    assert_equal(&[apart, whole], &format!("{} {share} {heavy} {cuts}", kind.name()));
                }
            }
        }
    }
    assert!(hidden > 5000, "{hidden}");
}
