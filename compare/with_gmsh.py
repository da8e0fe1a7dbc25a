"""Meshes of a wanted length of edges, beside gmsh's and Triangle's: twenty geometries of engineering, the same length for all.

python with_gmsh.py [--runs N] [--only NAME] [--picture FILE]

For each geometry and program: triangles, the least and the mean smallest angle, the mean quality and the one that 5 percent
do not reach (1 is an equilateral triangle), the ratio of the areas of neighbors that 5 percent exceed, the mean length of
edges over the one wanted, and milliseconds: the least of the runs, which alternate. Then medians and worst values. gmsh
makes its frontal Delaunay meshes (algorithm 6); it has no geometry for lines that end inside, and takes growth from the
border by its own rule. Triangle takes the area of an equilateral triangle of that length as its bound, as does `delone`
without `edge`.

Exits with 1 if a mesh of ours has an angle below 30 degrees that the input does not force. Needs: pip install gmsh triangle
numpy scipy matplotlib (for the picture), and delone.
"""

import argparse
import sys
import time

import delone
import numpy as np

try:
    import gmsh
except ImportError:
    gmsh = None
try:
    import triangle
except ImportError:
    triangle = None

ANGLE = 30.0
#: Growth from one edge to the next.
GROWTH = 1.2


def circle(count, radius, center=(0.0, 0.0)):
    """Corners of a regular polygon."""
    t = np.arange(count) * 2 * np.pi / count
    return np.c_[center[0] + radius * np.cos(t), center[1] + radius * np.sin(t)]


def rings(*corners, holes=(), length):
    """Points, segments, holes and the length wanted, of closed polygons."""
    points, segments = [], []
    for ring in corners:
        first, count = len(points), len(ring)
        segments += [(first + k, first + (k + 1) % count) for k in range(count)]
        points += [tuple(map(float, corner)) for corner in ring]
    return np.array(points), np.array(segments), np.array(holes, float).reshape(-1, 2), length


def gear(teeth=24):
    """A gear of radius one."""
    profile = ((-0.28, 1.0), (-0.17, 1.12), (-0.06, 1.125), (0.06, 1.125), (0.17, 1.12), (0.28, 1.0))
    turns = [((k + a) * 2 * np.pi / teeth, r) for k in range(teeth) for a, r in profile]
    return [(r * np.cos(t), r * np.sin(t)) for t, r in turns]


def airfoil(count=80, thickness=0.12):
    """NACA 0012."""
    x = 0.5 * (1 - np.cos(np.linspace(0, np.pi, count)))
    y = 5 * thickness * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    return np.vstack([np.c_[x, y], np.c_[x, -y][1:-1][::-1]])


def coast(levels=7):
    """A closed line with detail of all sizes."""
    random = np.random.default_rng(1)
    line = circle(6, 1.0)
    for _ in range(levels):
        along = np.roll(line, -1, 0) - line
        bent = np.c_[-along[:, 1], along[:, 0]] * (random.random((len(line), 1)) - 0.5) * 0.35
        line = np.stack([line, line + along / 2 + bent], 1).reshape(-1, 2)
    return line


def grains(count=40):
    """Voronoi cells in a square, by mirrors."""
    from scipy.spatial import Voronoi

    sites = np.random.default_rng(3).random((count, 2))
    mirrored = [sites, sites * [-1, 1], sites * [1, -1], [2, 0] + sites * [-1, 1], [0, 2] + sites * [1, -1]]
    diagram = Voronoi(np.vstack(mirrored))
    places, segments = {}, set()

    def corner(k):
        return places.setdefault(tuple(np.clip(np.round(diagram.vertices[k], 9) + 0.0, 0, 1)), len(places))

    for k in range(count):
        cell = [corner(v) for v in diagram.regions[diagram.point_region[k]]]
        segments |= {(min(a, b), max(a, b)) for a, b in zip(cell, cell[1:] + cell[:1], strict=True) if a != b}
    for at in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
        places.setdefault(at, len(places))
    points = np.array(list(places))
    for axis, value in ((0, 0), (0, 1), (1, 0), (1, 1)):
        side = np.flatnonzero(points[:, axis] == value)
        side = side[np.argsort(points[side, 1 - axis])]
        segments |= {(min(a, b), max(a, b)) for a, b in zip(side.tolist(), side[1:].tolist(), strict=False)}
    return points, np.array(sorted(segments)), np.empty((0, 2)), 0.04


def geometries():
    """All of them by name."""
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    wide = [(0, 0), (2, 0), (2, 1), (0, 1)]
    star = np.arange(14) * np.pi / 7
    radii = np.where(np.arange(14) % 2 == 0, 1, 0.35)
    left, right = np.linspace(np.pi / 2, 3 * np.pi / 2, 20), np.linspace(-np.pi / 2, np.pi / 2, 20)
    slot = np.vstack(
        [
            np.c_[0.6 + 0.15 * np.cos(left), 0.5 + 0.15 * np.sin(left)],
            np.c_[1.4 + 0.15 * np.cos(right), 0.5 + 0.15 * np.sin(right)],
        ]
    )
    centers = [((i + 0.5) / 10, (j + 0.5) / 10) for i in range(10) for j in range(10)]
    flanges = [(0, 0), (1, 0), (1, 0.1), (0.55, 0.1), (0.55, 1.4), (1, 1.4), (1, 1.5), (0, 1.5), (0, 1.4), (0.45, 1.4)]
    tee = [(0, 0), (0.2, 0), (0.2, 1), (1, 1), (1, 1.2), (-0.8, 1.2), (-0.8, 1), (0, 1)]
    channel = [(0, 0), (1, 0), (1, 0.12), (0.12, 0.12), (0.12, 1.88), (1, 1.88), (1, 2), (0, 2)]
    points, segments, none, length = rings(wide, length=0.05)
    crack = (np.vstack([points, [(0.8, 0.5), (1.2, 0.53)]]), np.vstack([segments, [(4, 5)]]), none, length)
    return {
        "square": rings(square, length=0.04),
        "L": rings([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], length=0.1),
        "I": rings([*flanges, (0.45, 0.1), (0, 0.1)], length=0.05),
        "T": rings(tee, length=0.05),
        "channel": rings(channel, length=0.05),
        "gear": rings(gear(), circle(48, 0.4), holes=[(0, 0)], length=0.05),
        "disk": rings(circle(120, 1), length=0.05),
        "annulus": rings(circle(100, 1), circle(60, 0.5), holes=[(0, 0)], length=0.05),
        "eccentric": rings(circle(120, 1), circle(80, 0.55, (0.4, 0)), holes=[(0.4, 0)], length=0.05),
        "airfoil": rings([(-1, -1), (2, -1), (2, 1), (-1, 1)], airfoil(), holes=[(0.5, 0)], length=0.1),
        "100 holes": rings(square, *[circle(24, 0.025, at) for at in centers], holes=centers, length=0.02),
        "crack": crack,
        "strip": rings([(0, 0), (10, 0), (10, 0.05), (0, 0.05)], length=0.05),
        "coast": rings(coast(), length=0.1),
        "grains": grains(),
        "star": rings(np.c_[radii * np.cos(star), radii * np.sin(star)], length=0.05),
        "slot": rings(wide, slot, holes=[(1, 0.5)], length=0.05),
        "hexagon": rings(circle(6, 1), length=0.06),
        "triangle": rings([(0, 0), (1, 0), (0.3, 0.9)], length=0.04),
        "plate": rings([(0, 0), (4, 0), (4, 2), (0, 2)], circle(64, 0.5, (2, 1)), holes=[(2, 1)], length=0.1),
    }


def by_delone(points, segments, holes, length):
    """Ours."""
    made = delone.mesh(points, segments, holes=holes, min_angle=ANGLE, edge=length, growth=GROWTH)
    forced = sum(reason == "input angle" for reason in made.report.reasons)
    if len(made.report.left) > forced:
        print(f"{len(made.report.left) - forced} triangles are left without need", file=sys.stderr)
        by_delone.failed = True
    return made.points, made.triangles


by_delone.failed = False


def by_area(smooth):
    """Ours without lengths: bounded areas, as Triangle has them."""

    def make(points, segments, holes, length):
        area = length**2 * 3**0.5 / 4
        made = delone.mesh(points, segments, holes=holes, min_angle=ANGLE, max_area=area, smooth=smooth)
        return made.points, made.triangles

    return make


def by_triangle(points, segments, holes, length):
    """Triangle's."""
    given = {"vertices": points, "segments": segments}
    if len(holes):
        given["holes"] = holes
    made = triangle.triangulate(given, f"pq{ANGLE:g}a{length**2 * 3**0.5 / 4:.12f}")
    return made["vertices"], made["triangles"]


def loops_of(segments):
    """Closed chains of segments, each as (from, segment); None if there are others."""
    at = {}
    for k, (a, b) in enumerate(segments):
        at.setdefault(int(a), []).append(k)
        at.setdefault(int(b), []).append(k)
    if any(len(own) != 2 for own in at.values()):
        return None
    seen, loops = set(), []
    for first in range(len(segments)):
        loop, k, v = [], first, int(segments[first][0])
        while k not in seen:
            seen.add(k)
            loop.append((v, k))
            v = int(segments[k][1] if segments[k][0] == v else segments[k][0])
            k = next(other for other in at[v] if other != k)
        if loop:
            loops.append(loop)
    return loops


def by_gmsh(points, segments, holes, length):
    """gmsh's, or None where it has no such geometry."""
    loops = loops_of(segments)
    if loops is None:
        return None
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        geo = gmsh.model.geo
        for k, (x, y) in enumerate(points):
            geo.addPoint(x, y, 0, length, k + 1)
        for k, (a, b) in enumerate(segments):
            geo.addLine(int(a) + 1, int(b) + 1, k + 1)
        doubled = [
            abs(sum(points[v][0] * points[w][1] - points[w][0] * points[v][1] for (v, _), (w, _) in pairs))
            for pairs in (list(zip(loop, loop[1:] + loop[:1], strict=True)) for loop in loops)
        ]
        outer_first = [loops[k] for k in np.argsort(doubled)[::-1]]
        signed = [[k + 1 if segments[k][0] == v else -(k + 1) for v, k in loop] for loop in outer_first]
        geo.addPlaneSurface([geo.addCurveLoop(loop) for loop in signed], 1)
        geo.synchronize()
        gmsh.option.setNumber("Mesh.Algorithm", 6)
        gmsh.option.setNumber("Mesh.MeshSizeMax", length)
        gmsh.model.mesh.generate(2)
        tags, places, _ = gmsh.model.mesh.getNodes()
        index = np.zeros(int(tags.max()) + 1, int)
        index[tags.astype(int)] = np.arange(len(tags))
        corners = index[gmsh.model.mesh.getElements(2)[2][0].astype(int)].reshape(-1, 3)
        return places.reshape(-1, 3)[:, :2], corners
    finally:
        gmsh.finalize()


def measured(points, triangles, length):
    """Triangles, least and mean angle, mean quality, its 5 percent, step, mean length."""
    corners = points[triangles]
    sides = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
    squares = (sides**2).sum(axis=2)
    area = 0.5 * np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    lengths = np.sqrt(squares)
    sums = squares.sum(axis=1, keepdims=True)
    across = np.prod(lengths, axis=1, keepdims=True) / lengths
    angles = np.degrees(np.arccos(np.clip((sums - 2 * squares) / (2 * across), -1, 1))).min(axis=1)
    quality = 4 * 3**0.5 * area / sums[:, 0]
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(triangles)), 3)
    order = np.lexsort(edges.T)
    same = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    ratio = area[owner[order][1:][same]] / area[owner[order][:-1][same]]
    step = np.percentile(np.maximum(ratio, 1 / ratio), 95) if same.any() else 1.0
    p5 = np.sort(quality)[len(quality) // 20]
    return len(triangles), angles.min(), angles.mean(), quality.mean(), p5, step, lengths.mean() / length


def main():
    """Measures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only")
    parser.add_argument("--picture", help="the same geometry by Triangle, gmsh and delone; with --only")
    options = parser.parse_args()
    programs = {"delone --edge": by_delone, "delone --max-area": by_area(0), "the same, smooth 5": by_area(5)}
    if gmsh:
        programs["gmsh"] = by_gmsh
    if triangle:
        programs["Triangle"] = by_triangle
    rows = {name: [] for name in programs}
    head = "triangles  least   mean  quality     5 %   step  length      ms"
    for title, geometry in geometries().items():
        if options.only not in (None, title):
            continue
        least, made = dict.fromkeys(programs, np.inf), {}
        for _ in range(options.runs):
            for name, make in programs.items():
                start = time.perf_counter()
                made[name] = make(*geometry)
                least[name] = min(least[name], 1e3 * (time.perf_counter() - start))
        print(f"\n{title:20}{head}")
        for name, mesh in made.items():
            if mesh is None:
                print(f"{name:20}no geometry")
                continue
            row = (*measured(*mesh, geometry[3]), least[name])
            rows[name].append(row)
            print(f"{name:20}" + "{:9d} {:6.2f} {:6.2f}  {:7.4f} {:7.4f} {:6.3f}  {:6.3f} {:7.2f}".format(*row))
        if options.picture:
            picture(options.picture, {name: made[name] for name in ("Triangle", "gmsh", "delone --edge") if made.get(name)})
    for title, of, worst in (("median", np.median, None), ("worst", np.min, np.max)):
        print(f"\n{title:20}{head}")
        for name, own in rows.items():
            columns = np.array(own).T
            row = [(worst if worst and k in (0, 5, 6, 7) else of)(column) for k, column in enumerate(columns)]
            text = "{:9.0f} {:6.2f} {:6.2f}  {:7.4f} {:7.4f} {:6.3f}  {:6.3f} {:7.2f}".format(*row)
            print(f"{name:20}{text}   (of {len(own)})")
    sys.exit(by_delone.failed)


def picture(path, meshes):
    """Draws meshes beside each other."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(meshes), figsize=(6 * len(meshes), 6.3))
    for axis, (name, (points, triangles)) in zip(np.atleast_1d(axes), meshes.items(), strict=True):
        axis.triplot(*points.T, triangles, linewidth=0.5, color="#1f4e79")
        axis.set_title(f"{name.split()[0]}: {len(triangles):,} triangles", fontsize=15)
        axis.set_aspect("equal")
        axis.set_axis_off()
    figure.tight_layout()
    figure.savefig(path, dpi=80)


if __name__ == "__main__":
    main()
