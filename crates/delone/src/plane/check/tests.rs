//! The checker must fail: a valid triangulation is corrupted in every way that it claims to see.

use super::Flaw2 as Flaw;
use crate::duplicates::Duplicates;
use crate::ids::{EdgeId, Place, VertexId};
use crate::mesh::MeshFlaw2 as MeshFlaw;
use crate::{Delaunay2, Duplicate, Mesh2};
use delone_generators::Kind;

/// As surgery does, which would not do it here.
fn link(mesh: &mut Mesh2, e: EdgeId, f: EdgeId) {
    mesh.edges[e.index()].twin = f;
    mesh.edges[f.index()].twin = e;
}

fn sample() -> Delaunay2 {
    let mut points = Kind::Uniform.points(40, 9);
    points.push(points[3]);
    let triangulation = Delaunay2::from_vec(points).expect("finite");
    assert_eq!(triangulation.check(), Ok(()));
    triangulation
}

/// The flaw found after a corruption.
fn flaw(corrupt: impl FnOnce(&mut Delaunay2)) -> Flaw {
    let mut triangulation = sample();
    corrupt(&mut triangulation);
    triangulation.check().expect_err("the corruption must be seen")
}

/// An edge between two finite triangles whose four corners are in convex position.
fn flippable(d: &Delaunay2) -> EdgeId {
    let convex = |&e: &EdgeId| {
        let f = d.base.mesh.twin(e);
        let corners =
            [d.base.mesh.origin(e), d.base.mesh.apex(f), d.base.mesh.destination(e), d.base.mesh.apex(e)];
        !corners.contains(&VertexId::GHOST) && {
            let p = corners.map(|v| d.base.points[v.index()]);
            (0..4).all(|i| delone_predicates::orient2d(p[i], p[(i + 1) % 4], p[(i + 2) % 4]).is_positive())
        }
    };
    d.base.mesh.undirected_edges().find(convex).expect("a convex quadrilateral")
}

/// Replaces the diagonal of a quadrilateral by the other one.
fn flip(d: &mut Delaunay2, e: EdgeId) {
    let mesh = &mut d.base.mesh;
    let f = mesh.twin(e);
    let (a, b) = (mesh.tip(e), mesh.tip(f));
    let (across_e, across_f) = (mesh.twin(f.previous()), mesh.twin(e.previous()));
    // (u, v, a) and (v, u, b) become (b, v, a) and (a, u, b).
    mesh.edges[e.index()].origin = b;
    mesh.edges[f.index()].origin = a;
    link(mesh, e, across_e);
    link(mesh, f, across_f);
    link(mesh, e.previous(), f.previous());
    let incident = mesh.edges.clone();
    mesh.incident.fill(EdgeId::NONE);
    for (i, record) in
        incident.iter().enumerate().filter(|(i, record)| i % 4 < 3 && !record.origin.is_ghost())
    {
        mesh.incident[record.origin.index()] = EdgeId::new(i);
    }
}

#[test]
fn a_wrong_diagonal() {
    assert!(matches!(
        flaw(|d| {
            let e = flippable(d);
            flip(d, e);
            assert_eq!(d.base.mesh.check(), Ok(()), "the surface itself stays closed");
        }),
        Flaw::Delaunay(_)
    ));
}

#[test]
fn a_moved_point() {
    // A vertex inside, moved across the hull: its star is no disk around it any more.
    assert!(matches!(
        flaw(|d| {
            let hull: Vec<_> = d.hull_vertices().collect();
            let inner = d.vertices().find(|v| !hull.contains(v) && v.index() != 3).expect("an inner vertex");
            d.base.points[inner.index()] = [0.5, -3.0];
        }),
        Flaw::Orientation(_) | Flaw::Delaunay(_)
    ));
}

#[test]
fn a_dent_in_the_hull() {
    let count = sample().hull_vertices().count();
    for dented in 0..count {
        let mut v = VertexId::GHOST;
        let found = flaw(|d| {
            let hull: Vec<_> = d.hull_vertices().collect();
            v = hull[dented];
            let [a, b] = [count - 1, 1].map(|i| d.base.points[hull[(dented + i) % count].index()]);
            let inside = [0.7 * a[0] + 0.3 * b[0] + 0.0, 0.7 * a[1] + 0.3 * b[1]];
            let center = [0.5, 0.5];
            d.base.points[v.index()] = [0, 1].map(|k| inside[k] + 0.01 * (center[k] - inside[k]));
        });
        assert_eq!(found, Flaw::Hull(v));
    }
}

#[test]
fn one_sided_neighbors() {
    let broken = flaw(|d| {
        let e = EdgeId::new(0);
        let other = d.base.mesh.twin(e.next());
        d.base.mesh.edges[0].twin = other;
    });
    assert!(matches!(broken, Flaw::Mesh(MeshFlaw::Twin(_))));
}

#[test]
fn mutual_neighbors_with_other_ends() {
    let broken = flaw(|d| {
        let (e, f) = (EdgeId::new(0), EdgeId::new(1));
        let (across_e, across_f) = (d.base.mesh.twin(e), d.base.mesh.twin(f));
        link(&mut d.base.mesh, e, across_f);
        link(&mut d.base.mesh, f, across_e);
    });
    assert!(matches!(broken, Flaw::Mesh(MeshFlaw::Ends(_))));
}

#[test]
fn a_triangle_too_few() {
    let broken = flaw(|d| d.base.mesh.edges.truncate(d.base.mesh.edges.len() - 4));
    assert!(matches!(broken, Flaw::Mesh(MeshFlaw::Euler { .. })));
    let none = flaw(|d| d.base.mesh.incident.fill(EdgeId::NONE));
    assert!(none.to_string().starts_with("0 vertices need 0 triangles"), "{none}");
}

#[test]
fn a_wrong_incident_edge() {
    let broken = flaw(|d| d.base.mesh.incident.swap(0, 1));
    assert!(matches!(broken, Flaw::Mesh(MeshFlaw::Incident(_))));
}

#[test]
fn two_spheres() {
    let broken = flaw(|d| {
        // Two sets side by side, with twice the ghosts: the counts are repaired, the star of the ghost is not.
        let mut copy = d.clone();
        let (edges, points) = (d.base.mesh.edges.len(), d.base.points.len());
        for record in &mut copy.base.mesh.edges {
            if record.twin != EdgeId::NONE {
                record.twin = EdgeId::new(record.twin.index() + edges);
            }
            if !record.origin.is_ghost() {
                record.origin = Place::new(record.origin.index() + points);
            }
        }
        d.base.mesh.edges.extend(copy.base.mesh.edges);
        let shifted = |e: EdgeId| if e == EdgeId::NONE { e } else { EdgeId::new(e.index() + edges) };
        d.base.mesh.incident.extend(copy.base.mesh.incident.into_iter().map(shifted));
        d.base.points.extend(copy.base.points);
        d.base.mesh.vertex_count *= 2;
    });
    assert!(matches!(broken, Flaw::Mesh(MeshFlaw::Euler { .. })));
}

#[test]
fn a_lost_point() {
    assert!(matches!(flaw(|d| d.base.points.push([0.5, 0.5])), Flaw::Missing(41)));
    assert!(matches!(flaw(|d| d.duplicates.clear()), Flaw::Missing(40)));
}

#[test]
fn a_false_duplicate() {
    let wrong = Duplicate { point: 40, vertex: VertexId::new(4) };
    assert_eq!(flaw(|d| d.duplicates = Duplicates::new(vec![wrong])), Flaw::Duplicate(wrong));
    // There is no point 41.
    let wrong = Duplicate { point: 41, vertex: VertexId::new(3) };
    assert_eq!(flaw(|d| d.duplicates.push(wrong)), Flaw::Duplicate(wrong));
    // Of a point that is a duplicate itself.
    let wrong = Duplicate { point: 2, vertex: VertexId::new(1) };
    let mut d = Delaunay2::from_points(&[[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        .expect("finite");
    assert_eq!(d.check(), Ok(()));
    let first = d.duplicates().next().expect("of the first point");
    d.duplicates = Duplicates::new(vec![first, wrong]);
    assert_eq!(d.check(), Err(Flaw::Duplicate(wrong)));
}

#[test]
fn false_names() {
    let (v, w) = (VertexId::new(20), VertexId::new(7));
    let mut named = sample();
    named.remove(w).expect("a vertex");
    assert_eq!(named.check(), Ok(()));
    let place = |d: &Delaunay2, v: VertexId| d.base.mesh.place(v).expect("a vertex");
    let flaw = |corrupt: &dyn Fn(&mut Delaunay2)| {
        let mut d = named.clone();
        corrupt(&mut d);
        d.check().expect_err("the corruption must be seen")
    };
    // Other coordinates than those that are kept.
    assert_eq!(flaw(&|d| d.named.as_mut().expect("changed")[v.index()][0] += 0.5), Flaw::Name(v));
    // Where another vertex is.
    let (low, high) = (VertexId::new(5), v);
    let there = place(&named, high);
    assert_eq!(flaw(&|d| d.base.mesh.names().bind(low, there)), Flaw::Name(low));
    let there = place(&named, low);
    let taken = flaw(&|d| {
        d.base.mesh.names().bind(high, there);
        d.base.mesh.names().bind(low, there);
    });
    assert_eq!(taken, Flaw::Name(high));
    // Where there is no vertex, with the right coordinates all the same.
    let left = Place::new(w.index());
    assert_eq!(named.base.points[left.index()], named.named.as_ref().expect("changed")[w.index()]);
    assert_eq!(flaw(&|d| d.base.mesh.names().bind(w, left)), Flaw::Name(w));
    // A vertex without a name.
    assert!(matches!(flaw(&|d| d.base.mesh.names().release(v)), Flaw::Name(_)));
}

#[test]
fn a_clockwise_surface() {
    let mirrored = flaw(|d| d.base.points.iter_mut().for_each(|p| p[0] = -p[0]));
    assert!(matches!(mirrored, Flaw::Hull(_)));
}

#[test]
fn a_disordered_line() {
    let points: Vec<_> = (0..10).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
    let mut line = Delaunay2::from_points(&points).expect("finite");
    assert_eq!(line.check(), Ok(()));
    line.base.points.swap(3, 7);
    assert!(matches!(line.check(), Err(Flaw::Line(_))));
    line.base.points.swap(3, 7);
    line.base.points[5] = [5.0, 10.5];
    assert!(matches!(line.check(), Err(Flaw::Line(_))));
}
