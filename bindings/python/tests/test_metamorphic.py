"""What units, order, repetition, layout and threads do to every operation that gives geometry: nothing but what they must.

Each operation of the table takes a set and gives shapes: tuples of numbers that were scaled back to the set's first unit.
Scaled by a power of two they are the same, to the bit; so they are in another order, with points twice, in any layout in
memory, and on any number of threads.
"""

import hashlib
import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import delone
import numpy as np
import pytest


@dataclass
class Given:
    """Points with heights and weights, in a unit of 2**k; the heights are of no unit, the weights squared lengths."""

    points: np.ndarray
    heights: np.ndarray
    weights: np.ndarray
    queries: np.ndarray
    k: int = 0

    def length(self, value, power=1):
        """So many units."""
        return np.ldexp(value, self.k * power)

    def back(self, values, power=1):
        """Numbers in the first unit, and without a sign of zero."""
        return np.ldexp(np.asarray(values, dtype=float), -self.k * power) + 0.0

    def key(self):
        """The set's distinct points in an order of their own."""
        return np.unique(self.back(self.points), axis=0, return_index=True)[1]


def row(*parts):
    """A shape: numbers one after the other, those that are none being equal."""
    return tuple("none" if x != x else x for part in parts for x in np.ravel(part).tolist())


def simplices(g, indices, points=None):
    """Shapes whose corners have no order."""
    at = g.back(g.points if points is None else points)
    return [row(sorted(map(tuple, corners))) for corners in at[np.asarray(indices)]]


def ring(g, points):
    """A closed line that may begin anywhere."""
    at = [tuple(p) for p in g.back(points).tolist()]
    if len(at) > 1 and at[0] == at[-1]:
        at.pop()
    first = at.index(min(at)) if at else 0
    return row(at[first:] + at[:first])


def window(g):
    return g.length([[-0.25, -0.125], [1.25, 0.0], [1.125, 1.25], [0.5, 0.5], [0.0, 1.0]])


def segments(g):
    """Segments between points along a line; some cross."""
    at = g.key()
    fives = at[: len(at) // 5 * 5].reshape(-1, 5)
    return fives[:, [0, 3]]


def delaunay(g):
    tri = delone.Delaunay(g.points)
    found = g.back(tri.points)[tri.k_nearest(g.queries, 3)]
    inside = tri.find_simplex(g.queries) >= 0
    asked = [row(*each) for each in zip(g.back(g.queries), found, inside, strict=True)]
    return simplices(g, tri.simplices) + simplices(g, tri.convex_hull) + simplices(g, tri.edges) + asked


def furthest(g):
    return simplices(g, delone.Delaunay(g.points, furthest_site=True).simplices)


def voronoi(g, merge=None):
    v = delone.Voronoi(g.points, merge=merge)
    at = np.vstack([g.back(v.vertices), np.full(g.points.shape[1], np.inf)])
    sites = g.back(g.points)
    shapes = [row(p) for p in at[:-1]]
    for pair, ends in zip(v.ridge_points, v.ridge_vertices, strict=True):
        shapes.append(row(sorted(map(tuple, sites[pair])), sorted(map(tuple, at[ends]))))
    for i in g.key():
        shapes.append(row(sites[i], sorted(map(tuple, at[v.regions[v.point_region[i]]]))))
    return shapes


def merged(g):
    return voronoi(g, "auto") + voronoi(g, g.length(0.125))


def cells(g, merge=None):
    v = delone.Voronoi(g.points, merge=merge).cells(window(g))
    return [ring(g, r) for rings in v for r in rings]


def merged_cells(g):
    return cells(g, "auto") + cells(g, g.length(0.125))


def hull(g):
    h = delone.ConvexHull(g.points)
    shapes = simplices(g, h.vertices[:, None])
    if g.points.shape[1] == 2:
        shapes += [*simplices(g, h.simplices), ring(g, g.points[h.vertices])]
    return shapes


def regular(g):
    r = delone.RegularTriangulation(g.points, g.weights)
    return simplices(g, r.simplices) + simplices(g, r.convex_hull) + simplices(g, r.nearest(g.queries)[:, None])


def graphs(g):
    made = [delone.gabriel_graph, delone.relative_neighborhood_graph, delone.euclidean_minimum_spanning_tree]
    shapes = []
    for make in made:
        heads, tails, lengths = make(g.points, as_arrays=True)
        ends = simplices(g, np.transpose([heads, tails]))
        shapes += [row(*each) for each in zip(ends, g.back(lengths), strict=True)]
    return shapes


def beta(g):
    return simplices(g, np.transpose(delone.beta_skeleton(g.points, 1.7, as_arrays=True)[:2]))


def alpha(g):
    a = delone.AlphaComplex(g.points)
    shapes = []
    for dimension in range(g.points.shape[1] + 1):
        faces = simplices(g, a.simplices(dimension))
        shapes += [row(*each) for each in zip(faces, g.back(a.values(dimension), 2), strict=True)]
    return [*shapes, row(g.back(a.optimal_alpha(), 2), g.back(a.spectrum(), 2))]


def outline(g):
    return [ring(g, g.points[r]) for rings in delone.AlphaComplex(g.points).outline(g.length(0.01, 2)) for r in rings]


def orders(g):
    o = delone.OrderVoronoi(g.points, 2)
    shapes = simplices(g, o.regions) + [row(p) for p in g.back(o.vertices)] + simplices(g, o.circles)
    return shapes + [ring(g, r) for rings in o.cells(window(g)) for r in rings]


def constrained(g):
    c = delone.ConstrainedDelaunay(g.points, segments(g), crossings="split")
    return simplices(g, c.simplices, c.points) + simplices(g, c.constraints, c.points)


def meshed(**wanted):
    def run(g):
        # Of sizes: lengths and areas by their powers.
        sizes = {name: g.length(*value) if isinstance(value, tuple) else value for name, value in wanted.items()}
        m = delone.mesh(g.points, segments(g), crossings="split", fill="all", max_vertices=3000, **sizes)
        return [*simplices(g, m.triangles, m.points), row(m.report.smallest_angle)]

    return run


def polygons(g):
    star = g.points[g.key()] - g.length(0.5)
    star = star[np.lexsort([g.back(star)[:, 0], np.arctan2(*star.T)])] + g.length(0.5)
    made = delone.triangulate_polygon(star, crossings="split")
    return simplices(g, made.triangles, made.points)


def interpolators(g):
    shapes = []
    for outside in ("fill", "nearest", "hull"):
        made = [delone.LinearNDInterpolator(g.points, g.heights, outside=outside)]
        for method in ("sibson", "laplace", "smooth", "farin"):
            made.append(delone.NaturalNeighborInterpolator(g.points, g.heights, method, outside=outside))
        values = [f(g.queries) for f in made]
        shapes += [row(outside, *each) for each in zip(g.back(g.queries), *values, strict=True)]
    return shapes


def rasters(g):
    shapes = []
    for method in ("linear", "sibson", "laplace", "nearest"):
        values, transform = delone.rasterize(g.points, g.heights, cell=g.length(0.125), method=method)
        shapes.append(row(g.back(transform), values))
    return shapes


def contours(g):
    lines = delone.contours(g.points, g.heights, interval=0.25)
    shapes = [row(line.level, g.back(line.points)) for line in lines if not line.is_closed]
    shapes += [row(line.level, *ring(g, line.points)) for line in lines if line.is_closed]
    for band in delone.contours(g.points, g.heights, interval=0.25, bands=True):
        shapes += [row(band.lower, band.upper, *ring(g, r)) for rings in band.polygons for r in rings]
    return shapes


def simplified(g):
    made = delone.simplify(g.points, g.heights, max_error=0.1)
    return [*simplices(g, made.triangles, g.points[made.indices]), row(made.error)]


def neighbors(g):
    tree = delone.Neighbors(g.points)
    distances = tree.query(g.queries, 1)[0]
    found = g.back(g.points)[tree.nearest(g.queries)]
    return [row(*each) for each in zip(g.back(g.queries), g.back(distances), found, strict=True)]


BOTH = [delaunay, voronoi, merged, hull, regular, graphs, alpha, interpolators, neighbors]
PLANE = [beta, furthest, cells, merged_cells, outline, orders, constrained, polygons, rasters, contours, simplified]
MESHES = {
    "mesh by angle": meshed(min_angle=25),
    "mesh by edge": meshed(max_edge=(0.0625, 1)),
    "mesh by area": meshed(max_area=(0.002, 2), smooth=1),
}
OPERATIONS = {
    **{f"{run.__name__} in {ndim}": (run, ndim) for run in BOTH for ndim in (2, 3)},
    **{run.__name__: (run, 2) for run in PLANE},
    **{name: (run, 2) for name, run in MESHES.items()},
}
# They ask for several nearest points: of points that are there twice both.
ONCE = {"delaunay in 2", "delaunay in 3"}


def sets(ndim):
    """Random points and a grid whose spheres all have ties, in numbers that single precision has."""
    rng = np.random.default_rng(ndim)
    uniform = rng.random((120, ndim)).astype(np.float32).astype(float)
    side = 8 if ndim == 2 else 4
    tenths = (np.indices((side,) * ndim).reshape(ndim, -1).T * np.float32(0.1)).astype(np.float32).astype(float)
    for name, points in [("uniform", uniform), ("tenths", tenths)]:
        known = points @ np.arange(1.0, ndim + 1)
        heights = np.modf(known * 3)[0].astype(np.float32).astype(float)
        weights = (np.modf(known * 7)[0] / 512).astype(np.float32).astype(float)
        yield name, Given(points, heights, weights, rng.random((15, ndim)) * 1.25)


def outcome(run, g):
    return sorted(run(g), key=repr)


def scaled(g, k):
    return replace(g, points=np.ldexp(g.points, k), weights=np.ldexp(g.weights, 2 * k), queries=np.ldexp(g.queries, k), k=k)


def picked(g, which):
    return replace(g, points=g.points[which], heights=g.heights[which], weights=g.weights[which])


def in_layouts(g):
    """The same numbers in other layouts and types."""
    wide = np.full((len(g.points), 3, g.points.shape[1]), np.nan)
    wide[:, 1] = g.points
    yield "Fortran order", replace(g, points=np.asfortranarray(g.points))
    yield "strided", replace(g, points=wide[:, 1], heights=np.repeat(g.heights, 2)[::2])
    yield "backwards", replace(g, points=g.points[::-1].copy()[::-1], queries=g.queries[::-1].copy()[::-1])
    yield "single precision", replace(g, points=g.points.astype(np.float32), heights=g.heights.astype(np.float32))
    yield "big endian", replace(g, points=g.points.astype(">f8"), weights=g.weights.astype(">f8"))


@pytest.mark.parametrize("name", OPERATIONS)
def test_units_order_and_repetition_change_nothing(name):
    run, ndim = OPERATIONS[name]
    for kind, g in sets(ndim):
        expected = outcome(run, g)
        assert expected
        for k in (-100, -31, -1, 1, 30, 100):
            assert outcome(run, scaled(g, k)) == expected, f"{kind}, scaled by 2**{k}"
        order = np.random.default_rng(9).permutation(len(g.points))
        assert outcome(run, picked(g, order)) == expected, f"{kind} in another order"
        if name not in ONCE:
            twice = np.concatenate([order, order[:40]])
            assert outcome(run, picked(g, twice)) == expected, f"{kind} with points twice"


@pytest.mark.parametrize("name", OPERATIONS)
def test_layouts_change_nothing(name):
    run, ndim = OPERATIONS[name]
    for kind, g in sets(ndim):
        expected = run(g)
        for layout, other in in_layouts(g):
            assert run(other) == expected, f"{kind}, {layout}"


def digest():
    """Of all operations, not sorted, over sets that are large enough for threads."""
    made = hashlib.sha256()
    for name, (run, ndim) in OPERATIONS.items():
        rng = np.random.default_rng(7)
        points = rng.random((3000 if name in ("delaunay in 2", "delaunay in 3", "hull in 3") else 300, ndim))
        g = Given(points, points.sum(axis=1), points[:, 0] / 512, rng.random((2000, ndim)))
        made.update(f"{name} {run(g)!r}".encode())
    return made.hexdigest()


def test_threads_change_nothing():
    def run(threads):
        environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        words = [sys.executable, "-c", "import test_metamorphic; print(test_metamorphic.digest())"]
        folder = Path(__file__).parent
        return subprocess.run(words, env=environment, cwd=folder, capture_output=True, text=True, check=True, timeout=300).stdout

    assert len(run(1)) == 65
    assert run(1) == run(7)
