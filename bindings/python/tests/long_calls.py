"""A program: all calls that may be long, each left by Ctrl-C while the only thread of the pool is busy with other work.

So it is certain, at any speed, that a call was left before its end; and one that does not go to the pool is not left. Prints a
line for each call that was not left, and for each object that is not as it must be when all is done.
"""

import os
import pickle
import signal
import sys
import threading
import time
from copy import copy

import delone
import numpy as np
from delone import tiles

#: Enough for the pool.
N = 21_000
rng = np.random.default_rng(1)
PLANE, MORE = rng.random((2, N, 2))
SPACE = rng.random((N, 3))
HEIGHTS = PLANE.sum(axis=1)
SIDES = np.array([[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]])
BOX = [[0, 0], [1, 0], [1, 1], [0, 1]]


def constrained():
    """With segments that are edges, so that none cross, and a long one beside them."""
    edges = delone.Delaunay(PLANE).edges[::7]
    points = np.concatenate([PLANE, [[-1.0, -1.0], [2.0, -1.0]]])
    return delone.ConstrainedDelaunay(points, np.concatenate([edges, [[N, N + 1]]]), fill="even-odd")


def all_of(makes):
    """What all of them make, by name."""
    return {name: make() for name, make in makes.items()}


MADE = all_of(
    {
        "plane": lambda: delone.Delaunay(PLANE),
        "space": lambda: delone.Delaunay(SPACE),
        "furthest": lambda: delone.Delaunay(PLANE, furthest_site=True),
        "constrained": constrained,
        "mesh": lambda: delone.mesh(BOX, [[0, 1], [1, 2], [2, 3], [3, 0]], max_area=2e-5),
        "regular": lambda: delone.RegularTriangulation(PLANE),
        "regular space": lambda: delone.RegularTriangulation(SPACE),
        "weighted": lambda: delone.RegularTriangulation(PLANE),
        "weights": lambda: delone.PowerDiagram(PLANE),
        "power": lambda: delone.PowerDiagram(PLANE),
        "neighbors": lambda: delone.Neighbors(PLANE),
        "order": lambda: delone.OrderVoronoi(PLANE[: N // 4], 2),
        "alpha": lambda: delone.AlphaComplex(PLANE),
        "alpha space": lambda: delone.AlphaComplex(SPACE),
        "hints": lambda: delone.Hints(PLANE),
        "voronoi": lambda: delone.Voronoi(PLANE),
        "hull": lambda: delone.ConvexHull(np.c_[np.cos(2 * np.pi * HEIGHTS), np.sin(2 * np.pi * HEIGHTS)]),
        "cuts": lambda: tiles.Cuts(PLANE, 4),
    }
)
#: The ends of an edge that is no constraint, and two vertices that do not see each other.
UNUSED = next(edge for edge in MADE["plane"].edges.tolist() if MADE["constrained"].sees(*edge))
FAR_APART = next([k, 100 + k] for k in range(100) if not MADE["constrained"].sees(k, 100 + k))
BORDERS = [
    tiles.triangulate(PLANE[MADE["cuts"].tile_of(PLANE) == node], MADE["cuts"].region(node), node=node).border
    for node in MADE["cuts"].nodes
]

#: By name what is called, and for what of the above; it is copied before where what it keeps would answer.
ASKED = {
    "Delaunay": (None, lambda _: delone.Delaunay(PLANE)),
    "Delaunay in space": (None, lambda _: delone.Delaunay(SPACE)),
    "Delaunay of few in space, which may have any number of simplices": (None, lambda _: delone.Delaunay(SPACE[:1000])),
    "Delaunay.simplices": ("plane", lambda d: d.simplices),
    "Delaunay.simplices in space": ("space", lambda d: d.simplices),
    "Delaunay.simplices of furthest sites": ("furthest", lambda d: d.simplices),
    "Delaunay.convex_hull": ("space", lambda d: d.convex_hull),
    "Delaunay.edges": ("plane", lambda d: d.edges),
    "Delaunay.duplicates": ("plane", lambda d: d.duplicates),
    "Delaunay.find_simplex": ("plane", lambda d: d.find_simplex(MORE)),
    "Delaunay.find_simplex in space": ("space", lambda d: d.find_simplex(SPACE / 2)),
    "Delaunay.nearest": ("plane", lambda d: d.nearest(MORE)),
    "Delaunay.k_nearest": ("plane", lambda d: d.k_nearest(MORE[:2000], 20)),
    "Delaunay.k_nearest of few": ("plane", lambda d: d.k_nearest(MORE[:500], 100)),
    "Delaunay.copy": ("space", lambda d: d.copy()),
    "Delaunay of pickle": ("plane", lambda d: pickle.loads(pickle.dumps(d))),
    "Voronoi": (None, lambda _: delone.Voronoi(PLANE)),
    "Voronoi in space": (None, lambda _: delone.Voronoi(SPACE, merge=1e-9)),
    "Voronoi.cells": ("voronoi", lambda v: v.cells(SIDES)),
    "ConvexHull": (None, lambda _: delone.ConvexHull(PLANE)),
    "ConvexHull in space": (None, lambda _: delone.ConvexHull(SPACE)),
    "LinearInterpolator": ("plane", lambda d: delone.LinearInterpolator(d, HEIGHTS)(MORE)),
    "NaturalNeighborInterpolator": ("plane", lambda d: delone.NaturalNeighborInterpolator(d, HEIGHTS)(MORE)),
    "smooth": ("plane", lambda d: delone.NaturalNeighborInterpolator(d, HEIGHTS, method="smooth")(MORE)),
    "farin in space": ("space", lambda d: delone.NaturalNeighborInterpolator(d, SPACE[:, 0], method="farin")(SPACE / 2)),
    "weights": ("plane", lambda d: delone.NaturalNeighborInterpolator(d, HEIGHTS).weights(MORE)),
    "gradients": ("plane", lambda d: delone.NaturalNeighborInterpolator(d, HEIGHTS).gradients()),
    "rasterize": ("plane", lambda d: delone.rasterize(d, HEIGHTS, cell=0.004)),
    "rasterize sibson": ("plane", lambda d: delone.rasterize(d, HEIGHTS, cell=0.01, method="sibson")),
    "rasterize constrained": ("constrained", lambda c: delone.rasterize(c, c.points[:, 0], cell=0.004)),
    "contours": ("plane", lambda d: delone.contours(d, HEIGHTS, interval=0.1)),
    "contours of few at many levels": (None, lambda _: delone.contours(PLANE[:300], HEIGHTS[:300], interval=1e-4)),
    "bands": ("plane", lambda d: delone.contours(d, HEIGHTS, interval=0.1, bands=True)),
    "contours constrained": ("constrained", lambda c: delone.contours(c, c.points[:, 0], interval=0.1)),
    "dtm": (None, lambda _: delone.dtm(PLANE, HEIGHTS, cell=0.002, method="natural")),
    "simplify": (None, lambda _: delone.simplify(PLANE, HEIGHTS**2, max_error=0.01)),
    "ConstrainedDelaunay": (None, lambda _: delone.ConstrainedDelaunay(PLANE, [[0, 1]])),
    "ConstrainedDelaunay.points": ("constrained", lambda c: c.points),
    "ConstrainedDelaunay.all_triangles": ("constrained", lambda c: c.all_triangles),
    "ConstrainedDelaunay.inside": ("constrained", lambda c: c.inside),
    "ConstrainedDelaunay.constrained": ("constrained", lambda c: c.constrained),
    "ConstrainedDelaunay.constraints": ("constrained", lambda c: c.constraints),
    "ConstrainedDelaunay.segments": ("constrained", lambda c: c.segments),
    "ConstrainedDelaunay.edges": ("constrained", lambda c: c.edges),
    "ConstrainedDelaunay.convex_hull": ("constrained", lambda c: c.convex_hull),
    "ConstrainedDelaunay.duplicates": ("constrained", lambda c: c.duplicates),
    "ConstrainedDelaunay.find_simplex": ("constrained", lambda c: c.find_simplex(MORE)),
    "ConstrainedDelaunay.nearest": ("constrained", lambda c: c.nearest(MORE)),
    "ConstrainedDelaunay.k_nearest": ("constrained", lambda c: c.k_nearest(MORE, 2)),
    "ConstrainedDelaunay.sees": ("constrained", lambda c: c.sees(np.arange(N), np.arange(N)[::-1])),
    "ConstrainedDelaunay.check": ("constrained", lambda c: c.check()),
    "ConstrainedDelaunay.copy": ("constrained", lambda c: c.copy()),
    "mesh": (None, lambda _: delone.mesh(BOX, [[0, 1], [1, 2], [2, 3], [3, 0]], max_area=2e-5)),
    "Mesh.refine": ("mesh", lambda m: m.refine(max_area=1e-5)),
    "Mesh.points": ("mesh", lambda m: m.points),
    "Mesh.triangles": ("mesh", lambda m: m.triangles),
    "Mesh.regions": ("mesh", lambda m: m.regions),
    "Mesh.segments": ("mesh", lambda m: m.segments),
    "Mesh.check": ("mesh", lambda m: m.check()),
    "RegularTriangulation": (None, lambda _: delone.RegularTriangulation(PLANE, HEIGHTS / N)),
    "RegularTriangulation in space": (None, lambda _: delone.RegularTriangulation(SPACE)),
    "RegularTriangulation.simplices": ("regular", lambda r: r.simplices),
    "RegularTriangulation.convex_hull": ("regular space", lambda r: r.convex_hull),
    "RegularTriangulation.edges": ("regular", lambda r: r.edges),
    "RegularTriangulation.hidden": ("regular", lambda r: r.hidden),
    "RegularTriangulation.duplicates": ("regular", lambda r: r.duplicates),
    "RegularTriangulation.nearest": ("regular", lambda r: r.nearest(MORE)),
    "RegularTriangulation.nearest in space": ("regular space", lambda r: r.nearest(SPACE / 2)),
    "PowerDiagram.integrals": ("power", lambda p: p.integrals()),
    "PowerDiagram.adjust_weights": ("power", lambda p: p.adjust_weights()),
    "Neighbors": (None, lambda _: delone.Neighbors(PLANE)),
    "Neighbors in space": (None, lambda _: delone.Neighbors(SPACE)),
    "Neighbors.nearest": ("neighbors", lambda t: t.nearest(MORE)),
    "Neighbors.k_nearest": ("neighbors", lambda t: t.k_nearest(MORE, 2)),
    "Neighbors.query": ("neighbors", lambda t: t.query(MORE, 2)),
    "Neighbors.within": ("neighbors", lambda t: t.within(MORE[:3], 0.5)),
    "OrderVoronoi": (None, lambda _: delone.OrderVoronoi(PLANE, 2)),
    "OrderVoronoi.locate": ("order", lambda o: o.locate(MORE)),
    "OrderVoronoi.cells": ("order", lambda o: o.cells(SIDES)),
    "OrderVoronoi.areas": ("order", lambda o: o.areas(SIDES)),
    "AlphaComplex": (None, lambda _: delone.AlphaComplex(PLANE)),
    "AlphaComplex with weights": (None, lambda _: delone.AlphaComplex(SPACE, np.zeros(N))),
    "AlphaComplex.simplices": ("alpha", lambda a: a.simplices(2)),
    "AlphaComplex.values": ("alpha", lambda a: a.values(1)),
    "AlphaComplex.outline": ("alpha", lambda a: a.outline(1e-4)),
    "AlphaComplex.manifold": ("alpha space", lambda a: a.manifold(1e-3)),
    "AlphaComplex.components": ("alpha", lambda a: a.components(1e-4)),
    "AlphaComplex.optimal_alpha": ("alpha", lambda a: a.optimal_alpha()),
    "AlphaComplex.spectrum": ("alpha", lambda a: a.spectrum()),
    "Hints": (None, lambda _: delone.Hints(SPACE)),
    "Hints.triangulate": ("hints", lambda h: h.triangulate(PLANE + 1e-5)),
    "gabriel_graph": (None, lambda _: delone.gabriel_graph(PLANE)),
    "relative_neighborhood_graph": (None, lambda _: delone.relative_neighborhood_graph(SPACE)),
    "euclidean_minimum_spanning_tree": (None, lambda _: delone.euclidean_minimum_spanning_tree(PLANE)),
    "beta_skeleton": (None, lambda _: delone.beta_skeleton(PLANE, 1.5)),
    "knn_graph": (None, lambda _: delone.knn_graph(PLANE, 3)),
    "triangulate_polygons": (None, lambda _: delone.triangulate_polygons(PLANE.reshape(-1, 3, 2), ragged=True)),
    "tiles.Cuts": (None, lambda _: tiles.Cuts(PLANE, 4)),
    "tiles.Cuts.tile_of": ("cuts", lambda c: c.tile_of(PLANE)),
    "tiles.triangulate": (None, lambda _: tiles.triangulate(PLANE)),
    "tiles.join": (None, lambda _: tiles.join(BORDERS)),
    "tiles.fingerprint": (None, lambda _: tiles.fingerprint(PLANE, MADE["plane"].simplices)),
}


def joined(points, more):
    """Points and more."""
    return np.concatenate([points, more])


#: By name an object, a change that goes on after Ctrl-C, and how it is made at once.
CHANGED = {
    "Delaunay.add_points": ("plane", lambda d: d.add_points(MORE), lambda: delone.Delaunay(joined(PLANE, MORE))),
    "Delaunay.add_points in space": (
        "space",
        lambda d: d.add_points(SPACE[:500] / 2),
        lambda: delone.Delaunay(joined(SPACE, SPACE[:500] / 2)),
    ),
    "Delaunay.remove": ("plane", lambda d: d.remove(np.arange(5, 900)), lambda: without(np.arange(5, 900))),
    "RegularTriangulation.set_weights": (
        "weighted",
        lambda r: r.set_weights(HEIGHTS / N),
        lambda: delone.RegularTriangulation(PLANE, HEIGHTS / N),
    ),
    "ConstrainedDelaunay.insert": ("constrained", lambda c: c.insert(MORE[:900]), None),
    "ConstrainedDelaunay.remove": ("constrained", lambda c: c.remove(3, "drop"), None),
    "ConstrainedDelaunay.insert_segment": ("constrained", lambda c: c.insert_segment(*UNUSED), None),
    "ConstrainedDelaunay.remove_segment": ("constrained", lambda c: c.remove_segment(1), None),
}

#: The same of what is not changed at all after Ctrl-C.
UNCHANGED = {
    "Delaunay.add_points with restart": ("plane", lambda d: d.add_points(MORE, restart=True)),
    "Voronoi.add_points": ("voronoi", lambda v: v.add_points(MORE)),
    "ConvexHull.add_points": ("hull", lambda h: h.add_points(2 * MORE - 1)),
    "PowerDiagram.adjust_weights": ("weights", lambda p: p.adjust_weights()),
    "ConstrainedDelaunay.insert_segment that crosses": ("constrained", lambda c: c.insert_segment(*FAR_APART)),
}


def without(removed):
    """The triangulation without some points."""
    d = delone.Delaunay(PLANE)
    d.remove(removed)
    return d


def fresh(name):
    """One of those made that keeps nothing that it was asked for."""
    made = MADE.get(name)
    if isinstance(made, (delone.Delaunay, delone.ConstrainedDelaunay, delone.Voronoi)):
        return made.copy() if hasattr(made, "copy") else copy(made)
    if made is None:
        return None
    again = copy(made)
    if "_cache" in vars(again):
        again._cache = {}
    return again


class Busy:
    """Keeps the thread of the pool busy for some seconds at a time."""

    def __init__(self):
        """Finds how many points take a few seconds."""
        self.thread, self.count, took = None, 10_000, 0.0
        while took < 2.5:
            self.count *= 2
            began = time.perf_counter()
            self.work()
            took = time.perf_counter() - began

    def work(self):
        """Triangulates."""
        delone.Delaunay(np.random.default_rng(2).random((self.count, 3)))

    def __bool__(self):
        """Whether it is."""
        return self.thread is not None and self.thread.is_alive()

    def start(self):
        """Makes it so, unless it is."""
        if not self:
            self.thread = threading.Thread(target=self.work)
            self.thread.start()
            # It makes its points before.
            time.sleep(0.3)


def is_left(busy, call):
    """Whether a signal ends a call while the pool is busy. On slow machines it is tried again, unless the call has ended."""
    for _ in range(4):
        busy.start()
        has_ended = False
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            call()
            has_ended = bool(busy)
            time.sleep(60)
        except KeyboardInterrupt:
            pass
        timer.join()
        if has_ended:
            return False
        if busy:
            return True
    return False


def same(a, b):
    """Whether two are the same triangulation."""
    return set(map(frozenset, a.simplices.tolist())) == set(map(frozenset, b.simplices.tolist()))


def contents(made):
    """The bytes of what it says of itself."""
    names = ("points", "weights", "simplices", "vertices", "ridge_points", "constraints")
    return [np.asarray(getattr(made, name)).tobytes() for name in names if hasattr(made, name)]


def main():
    """Leaves all calls."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    asked = {name: (fresh(of), call) for name, (of, call) in ASKED.items()}
    changed = {name: (fresh(of), change, made) for name, (of, change, made) in CHANGED.items()}
    unchanged = {name: (fresh(of), change) for name, (of, change) in UNCHANGED.items()}
    before = {name: contents(made) for name, (made, _) in unchanged.items()}
    # A change looks at it first.
    _ = changed["ConstrainedDelaunay.remove_segment"][0].segments
    busy = Busy()
    only = sys.argv[1:]
    for kind in (asked, changed, unchanged):
        for name, (made, call, *_) in kind.items():
            if (not only or name in only) and not is_left(busy, lambda made=made, call=call: call(made)):
                print("not left:", name)
    busy.thread.join()
    if only:
        return
    for name, (made, change, at_once) in changed.items():
        if isinstance(made, delone.ConstrainedDelaunay):
            expected = MADE["constrained"].copy()
            change(expected)
            made.check()
        else:
            expected = at_once()
        is_right = same(made, expected) and np.array_equal(made.points, expected.points)
        if not isinstance(made, delone.RegularTriangulation):
            is_right &= same(pickle.loads(pickle.dumps(made)), expected)
        elif not np.array_equal(made.weights, HEIGHTS / N):
            is_right = False
        if not is_right:
            print("not as if it was made at once:", name)
    for name, content in before.items():
        if contents(unchanged[name][0]) != content:
            print("changed:", name)
    if not np.array_equal(asked["Delaunay.find_simplex"][0].find_simplex(MORE), MADE["plane"].find_simplex(MORE)):
        print("wrong: find_simplex")
    print("done")


if __name__ == "__main__":
    main()
