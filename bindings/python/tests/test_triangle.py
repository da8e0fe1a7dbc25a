"""The interface of the package `triangle`: against the package where it is installed, and against what its words say."""

import pickle
import subprocess
import sys

import delone
import numpy as np
import pytest

SQUARE = {
    "vertices": [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]],
    "segments": [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]],
    "holes": [[2.0, 2.0]],
}
UNIT = {"vertices": [[0, 0], [1, 0], [1, 1], [0, 1]], "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
FULL = SQUARE | {
    "regions": [[0.5, 0.5, 7, 0.3]],
    "vertex_markers": [[0], [1], [2], [3], [4], [5], [6]],
    "segment_markers": [[0], [0], [9], [8], [0], [7], [5]],
    "vertex_attributes": [[x, 10 * x + y] for x, y in SQUARE["vertices"]],
}
#: The package crashes now and then, so it has a process of its own.
_ASK = """
import pickle, sys, triangle
tri, switches = pickle.load(sys.stdin.buffer)
found = []
for one in switches:
    found.append(triangle.triangulate(tri, one))
sys.stdout.buffer.write(pickle.dumps(found))
"""


def as_arrays(tri):
    return {key: np.array(value) for key, value in tri.items()}


def original(tri, switches):
    pytest.importorskip("triangle")
    ask = pickle.dumps((as_arrays(tri), switches))
    done = subprocess.run([sys.executable, "-c", _ASK], input=ask, capture_output=True, check=True, timeout=120)
    return pickle.loads(done.stdout)


def shapes(made):
    return {key: (array.dtype, array.shape[1:]) for key, array in made.items()}


def areas(made):
    a, b, c = (made["vertices"][made["triangles"][:, k]] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return (ux * vy - uy * vx) / 2


def smallest_angles(made):
    corners = made["vertices"][made["triangles"][:, :3]]
    found = []
    for k in range(3):
        u, v = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        found.append(np.degrees(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))))
    return np.min(found, axis=0)


def edges_of(triangles):
    return {tuple(sorted(e)) for a, b, c in triangles[:, :3].tolist() for e in ((a, b), (b, c), (c, a))}


def border_of(triangles):
    directed = {e for a, b, c in triangles[:, :3].tolist() for e in ((a, b), (b, c), (c, a))}
    return {tuple(sorted(e)) for e in directed if e[::-1] not in directed}


def planar(seed):
    """A frame with points and segments inside, at general places."""
    random = np.random.default_rng(seed)
    points = np.concatenate([[[0, 0], [1, 0], [1, 1], [0, 1]], random.random((14, 2)) * 0.9 + 0.05])
    segments = [[0, 1], [1, 2], [2, 3], [3, 0]]

    def side(p, q, r):
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    def cross(a, b, c, d):
        p, q, r, s = points[[a, b, c, d]]
        return side(p, q, r) * side(p, q, s) < 0 and side(r, s, p) * side(r, s, q) < 0

    for a, b in random.integers(4, 18, (20, 2)).tolist():
        known = [sorted(s) for s in segments]
        if a != b and sorted([a, b]) not in known and not any(cross(a, b, c, d) for c, d in segments):
            segments.append([a, b])
    markers = random.integers(0, 4, (len(segments), 1))
    return {
        "vertices": points,
        "segments": np.array(segments),
        "segment_markers": markers,
        "vertex_markers": random.integers(0, 3, (18, 1)),
        "vertex_attributes": np.column_stack([points @ [2.0, 3.0], points @ [1.0, -1.0] + 5]),
        "regions": np.array([[0.01, 0.02, 3.0, 0.02], [0.99, 0.97, 4.0, 0.01]]),
    }


WORDS = (
    "p pq pc pe pn pen pB pP pN pE pI pO pX pz pj po2 pqo2 pv pY pqY pqYY pqS3 pA pAn pAe pqAB pD i c e n pC s q a1 ac pl pF h"
)
KEYS = WORDS.split(" ")


def test_keys_and_types_are_those_of_the_package():
    for tri in (SQUARE, FULL):
        for switches, wanted in zip(KEYS, original(tri, KEYS), strict=True):
            made = delone.triangle.triangulate(tri, switches)
            assert shapes(made) == shapes(wanted), switches
            if not set("qaDY") & set(switches):
                assert {k: len(v) for k, v in made.items()} == {k: len(v) for k, v in wanted.items()}, switches


@pytest.mark.parametrize("seed", range(20))
def test_what_is_not_refined_is_the_same(seed):
    tri = planar(seed)
    for switches, theirs in zip(["penA", "cen", "pceA", "penAj"], original(tri, ["penA", "cen", "pceA", "penAj"]), strict=True):
        ours = delone.triangle.triangulate(tri, switches)
        assert shapes(ours) == shapes(theirs)
        for key in ("vertices", "vertex_markers", "vertex_attributes"):
            assert (ours[key] == theirs[key]).all(), (switches, key)

        def rows(made, name, *values):
            sides = np.sort(made[name], axis=1).tolist()
            return sorted((tuple(e), *(made[v][k].tolist() for v in values)) for k, e in enumerate(sides))

        attributes = ["triangle_attributes"] if "A" in switches else []
        assert rows(ours, "triangles", *attributes) == rows(theirs, "triangles", *attributes)
        assert rows(ours, "edges", "edge_markers") == rows(theirs, "edges", "edge_markers")
        assert rows(ours, "segments", "segment_markers") == rows(theirs, "segments", "segment_markers")
        if "n" in switches:
            for row, (corners, beside) in enumerate(zip(ours["triangles"], ours["neighbors"], strict=True)):
                for k, other in enumerate(beside):
                    if other >= 0:
                        assert row in ours["neighbors"][other]
                        assert {corners[(k + 1) % 3], corners[(k + 2) % 3]} <= set(ours["triangles"][other].tolist())


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("switches", ["pqAe", "pq30a0.01e", "pq25aAej", "q30c", "pqDo2e", "pa0.02ce"])
def test_meshes_are_good(seed, switches):
    tri = planar(seed)
    made = delone.triangle.triangulate(tri, switches)
    check(tri, made, switches)
    (theirs,) = original(tri, [switches])
    assert shapes(made) == shapes(theirs)


def test_new_vertices_are_about_as_many_in_sum():
    ours = sum(len(delone.triangle.triangulate(planar(seed), "pq")["vertices"]) for seed in range(12))
    theirs = sum(len(original(planar(seed), ["pq"])[0]["vertices"]) for seed in range(12))
    assert ours <= 1.5 * theirs


def check(tri, made, switches):
    """What a result promises, by its own arrays."""
    vertices, triangles = made["vertices"], made["triangles"]
    given = len(tri["vertices"])
    if "j" not in switches:
        assert (vertices[:given] == tri["vertices"]).all()
    assert (areas(made) > 0).all() and areas(made).sum() == pytest.approx(1)
    border = border_of(triangles)
    assert {tuple(e) for e in np.sort(made["segments"], axis=1).tolist()} >= border
    markers = dict(
        zip(map(tuple, np.sort(made["segments"], axis=1).tolist()), made["segment_markers"].ravel().tolist(), strict=True)
    )
    assert all(markers[e] != 0 for e in border)
    assert all(made["vertex_markers"][v, 0] != 0 for e in border for v in e)
    if "e" in switches:
        edges = np.sort(made["edges"], axis=1)
        assert {tuple(e) for e in edges.tolist()} == edges_of(triangles) and len(edges) == len(edges_of(triangles))
        for e, marker in zip(edges.tolist(), made["edge_markers"].ravel().tolist(), strict=True):
            assert marker == markers.get(tuple(e), 0)
    # The attributes are linear over the plane here.
    assert np.allclose(made["vertex_attributes"][:, 0], vertices @ [2.0, 3.0], atol=1e-9)
    assert np.allclose(made["vertex_attributes"][:, 1], vertices @ [1.0, -1.0] + 5, atol=1e-9)
    if "o2" in switches:
        for k in range(3):
            ends = vertices[triangles[:, [(k + 1) % 3, (k + 2) % 3]]]
            assert np.allclose(vertices[triangles[:, 3 + k]], ends.mean(axis=1), atol=1e-15)


def test_regions_and_areas():
    made = delone.triangle.triangulate(FULL, "pq28aA")
    assert areas(made).max() <= 0.3 and set(made["triangle_attributes"].ravel()) == {7.0}
    assert areas(delone.triangle.triangulate(FULL, "pA")).max() > 0.3
    # A lattice of points without a region has the attribute 0, and of two seeds in one part the last one counts.
    two = SQUARE | {"regions": [[0.5, 0.5, 7, 0], [3.5, 3.5, 8, 0], [9, 9, 1, 1]]}
    made = delone.triangle.triangulate(two, "pAO")
    assert sorted(set(made["triangle_attributes"].ravel())) == [0.0, 8.0]
    assert delone.triangle.triangulate(SQUARE | {"holes": [[2, 2], [9, 9]]}, "p")["triangles"].shape == (7, 3)


@pytest.mark.parametrize("switches", ["p", "pqAenj", "pqAo2en", "pqAo2ejn"])
def test_results_may_be_written_to(switches):
    made = delone.triangle.triangulate(FULL, switches)
    assert all(array.flags.writeable and array.flags.c_contiguous for array in made.values())
    assert made["triangles"].max() == len(made["vertices"]) - 1


def test_refinement_of_a_mesh():
    first = delone.triangle.triangulate(FULL, "pq25aAe")
    first["triangle_max_area"] = np.where(first["vertices"][first["triangles"]].mean(axis=1)[:, :1] < 2, 0.02, -1)
    for switches in ("rpqaAe", "rqae"):
        made = delone.triangle.triangulate(first, switches)
        assert areas(made).sum() == pytest.approx(14) and (made["triangle_attributes"] == 7).all()
        old = len(first["vertices"])
        assert (made["vertices"][:old] == first["vertices"]).all()
        assert ("segments" in made) == ("p" in switches) == ("holes" in made)
        left = made["vertices"][made["triangles"]].mean(axis=1)[:, 0] < 1.5
        assert areas(made)[left].max() <= 0.02 < areas(made)[~left].max()
        border = border_of(made["triangles"])
        at = dict(zip(map(tuple, np.sort(made["edges"], axis=1).tolist()), made["edge_markers"].ravel().tolist(), strict=True))
        assert all(at[e] != 0 for e in border)
    same = delone.triangle.triangulate(first, "rp")
    assert edges_of(same["triangles"]) == edges_of(first["triangles"])
    sides = {key: {tuple(sorted(e)) for e in made["segments"].tolist()} for key, made in (("a", same), ("b", first))}
    assert sides["a"] == sides["b"]
    quality = delone.triangle.triangulate(first, "rq30")
    assert smallest_angles(quality).min() >= 30 - 1e-9


def test_crossings_have_attributes_too():
    cross = {
        "vertices": [[0, 0], [1, 1], [0, 1], [1, 0]],
        "segments": [[0, 1], [2, 3]],
        "vertex_attributes": [[0], [1], [10], [20]],
    }
    made = delone.triangle.triangulate(cross, "pc")
    assert made["vertices"].tolist()[4] == [0.5, 0.5] and made["vertex_attributes"].ravel().tolist() == [0, 1, 10, 20, 0.5]
    assert len(made["segments"]) == 8 and made["vertex_markers"].ravel().tolist() == [1, 1, 1, 1, 0]


@pytest.mark.parametrize("switches", ["pe", "pqe", "pqea0.5", "pceD"])
def test_edges_and_segments_run_as_in_the_package(switches):
    """Clients take normals from that."""
    made = delone.triangle.triangulate(FULL, switches)
    rows = made["triangles"].tolist()
    first = {}
    for row, corners in enumerate(rows):
        for k in range(3):
            first.setdefault(tuple(sorted((corners[k], corners[k - 2]))), (row, (corners[k], corners[k - 2])))
    for edge in map(tuple, made["edges"].tolist()):
        assert first[tuple(sorted(edge))][1] == edge
    sides = {(corners[k], corners[k - 2]) for corners in rows for k in range(3)}
    border = [s for s in map(tuple, made["segments"].tolist()) if (s in sides) != (s[::-1] in sides)]
    assert border and all(s[::-1] in sides for s in border), "the mesh is on the right"


@pytest.mark.parametrize("markers", [(0, 7), (7, 0), (5, 7), (0, 0)])
def test_the_first_marker_of_a_segment_given_twice(markers):
    tri = UNIT | {"segments": [*UNIT["segments"], [1, 0]], "segment_markers": [markers[0], 0, 0, 0, markers[1]]}
    made, theirs = delone.triangle.triangulate(tri, "pe"), original(tri, ["pe"])[0]
    assert (made["vertex_markers"] == theirs["vertex_markers"]).all()
    at = [
        {tuple(sorted(s)): m for s, m in zip(of["segments"].tolist(), of["segment_markers"].ravel().tolist(), strict=True)}
        for of in (made, theirs)
    ]
    assert at[0] == at[1]


def test_vertices_in_holes_have_the_markers_of_their_segments():
    corners = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [2, 1], [2, 2], [1, 2], [1.5, 1.4], [1.6, 1.6]]
    sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [8, 9]]
    tri = {"vertices": corners, "segments": sides, "segment_markers": list(range(2, 11)), "holes": [[1.2, 1.5]]}
    for made in (delone.triangle.triangulate(tri, "p"), original(tri, ["p"])[0]):
        assert made["vertex_markers"].ravel().tolist() == [2, 2, 3, 4, 6, 6, 7, 8, 10, 10]


def test_more_than_34_degrees_are_tried():
    made = delone.triangle.triangulate(UNIT, "pzeAa0.1q34.3")
    assert len(made["vertices"]) <= 20  # Triangle makes 13
    with pytest.warns(UserWarning, match="55 degrees"):
        delone.triangle.triangulate(UNIT, "pq55a0.01")


@pytest.mark.parametrize("switches", ["r", "rp", "ra0.01", "rq30"])
def test_materials_keep_their_areas_where_a_mesh_is_refined(switches):
    tri = {"vertices": [[0, 0], [2, -0.6], [4, 0], [2.5, 0.5]], "triangles": [[0, 1, 2], [0, 2, 3]]}
    tri["triangle_attributes"] = [[1.0], [2.0]]
    made = delone.triangle.triangulate(tri, switches)
    attributes = made["triangle_attributes"].ravel()
    assert np.allclose([areas(made)[attributes == k].sum() for k in (1, 2)], [1.2, 1.0])
    if "p" in switches:
        assert {tuple(sorted(s)) for s in made["segments"].tolist()} == border_of(made["triangles"]), "and no other"


def test_the_others():
    points = np.random.default_rng(4).random((30, 2))
    triangles = delone.triangle.delaunay(points)
    assert triangles.shape[1] == 3 and triangles.dtype == np.int32
    hull = delone.triangle.convex_hull(points)
    assert {tuple(sorted(e)) for e in hull.tolist()} == border_of(triangles)
    (ax, ay), (bx, by) = points[hull[:, 0]].T, points[hull[:, 1]].T
    assert (ax * by - bx * ay).sum() < 0, "clockwise, as Triangle has it"
    centers, edges, origins, directions = delone.triangle.voronoi(points)
    assert len(centers) == len(triangles) and len(origins) == len(directions) == len(hull)
    for row, center in enumerate(centers):
        radii = np.linalg.norm(points[triangles[row]] - center, axis=1)
        assert np.allclose(radii, radii[0]) and (np.linalg.norm(points - center, axis=1) >= radii[0] - 1e-9).all()
    assert len(edges) == len(edges_of(triangles)) - len(hull)
    outward = points[triangles[origins]].mean(axis=1) - points.mean(axis=0)
    assert ((outward * directions).sum(axis=1) > 0).mean() > 0.9
    pytest.importorskip("triangle")
    code = "import pickle, sys, triangle; sys.stdout.buffer.write(pickle.dumps(triangle.voronoi(pickle.load(sys.stdin.buffer))))"
    done = subprocess.run([sys.executable, "-c", code], input=pickle.dumps(points), capture_output=True, check=True)
    for ours, theirs in zip((centers, directions), (pickle.loads(done.stdout)[k] for k in (0, 3)), strict=True):
        assert np.allclose(ours[np.lexsort(np.round(ours, 9).T)], theirs[np.lexsort(np.round(theirs, 9).T)])


@pytest.mark.parametrize(
    ("change", "switches", "error", "words"),
    [
        ({}, "q70", ValueError, "switch q: 70"),
        ({}, "qa0", ValueError, "switch a"),
        ({}, "a0.0", ValueError, "switch a"),
        ({}, "o3", ValueError, "switch o"),
        ({}, "o", ValueError, "switch o"),
        ({}, "S1.5", ValueError, "switch S"),
        ({}, "q.", ValueError, "switch q: '.' is no number"),
        ({}, "u", ValueError, "switch u"),
        ({}, "pk", ValueError, "no switch 'k'"),
        ({}, "r", ValueError, "switch r: there are no triangles"),
        ({}, 5, TypeError, "switches must be a string"),
        ({"triangles": [[0, 1, 99]]}, "r", ValueError, "triangle 0 has the corners"),
        ({"triangles": [[0, 1]]}, "r", ValueError, "3 or 6"),
        ({"vertices": [[0, 0], [1, 1]]}, "", ValueError, "at least three"),
        ({"vertices": [[0, 0, 0]] * 3}, "", ValueError, "2 coordinates"),
        ({"vertices": [[0, 0], [1, np.inf], [1, 1]]}, "", ValueError, "not finite"),
        ({"segments": [[0, 99]]}, "p", IndexError, "point 99"),
        ({"segment_markers": [1, 2]}, "p", ValueError, "segment_markers"),
        ({"segment_markers": [2**40] * 7}, "p", ValueError, "32 bits"),
        ({"vertex_attributes": [[1.0]]}, "p", ValueError, "vertex_attributes"),
        ({"holes": [[1.0, 2, 3]]}, "p", ValueError, "holes"),
        ({"holes": [[0.0, 0.0]]}, "p", ValueError, "hole 0"),
        ({"regions": [[1.0]]}, "p", ValueError, "regions"),
        ({"colors": [[1.0]]}, "p", KeyError, "colors"),
    ],
)
def test_what_is_refused(change, switches, error, words):
    with pytest.raises(error, match=words):
        delone.triangle.triangulate(SQUARE | change, switches)


@pytest.mark.parametrize("switches", ["", "p", "pq", "q", "qa0.1c", "penj", "o2e", "pA", "D"])
def test_points_on_a_line_have_no_triangles(switches):
    line = {"vertices": [[0, 0], [1, 1], [2, 2]], "segments": [[0, 2]], "vertex_attributes": [[1], [2], [3]]}
    made = delone.triangle.triangulate(line, switches)
    assert "triangles" not in made and ("j" in switches or (made["vertices"] == line["vertices"]).all())
