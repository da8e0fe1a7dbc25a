"""The program, a folder to work in, and the points from which all files are made."""

import itertools
import subprocess
import sys
from pathlib import Path

import numpy as np
import shapely

DELONE = Path(sys.argv[1]).resolve()
FOLDER = Path(sys.argv[2]).resolve()
FOLDER.mkdir(parents=True, exist_ok=True)


def run(*words):
    """Runs the program, and gives its standard error. A failure ends the judgment."""
    done = subprocess.run([DELONE, *map(str, words)], cwd=FOLDER, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"delone {' '.join(map(str, words))}: {done.stderr}"
    return done.stderr


def normal(triangles, points):
    """Triangles by the coordinates of their corners, in an order that depends on nothing else."""
    corners = np.round(np.asarray(points, dtype=float)[np.asarray(triangles)][..., :2], 4)
    return sorted(sorted(map(tuple, triangle)) for triangle in corners.tolist())


def rings(polygons):
    """Polygons with three corners, as triangles between points."""
    points = np.concatenate([np.array(polygon.exterior.coords)[:3] for polygon in polygons])
    return np.arange(len(points)).reshape(-1, 3), points


# Terrain in projected coordinates, far from the origin, in millimetres.
rng = np.random.default_rng(1)
points = rng.uniform((637_000.0, 849_000.0, 400.0), (637_900.0, 849_700.0, 520.0), (500, 3)).round(3)
flat = points[:, :2]
np.save(FOLDER / "points.npy", points)
np.save(FOLDER / "flat.npy", flat)
np.savetxt(FOLDER / "points.csv", points, delimiter=",", header="x,y,z", comments="")
run("triangulate", "points.npy", "-o", "mesh.npy")
triangles = np.load(FOLDER / "mesh.npy")
expected = normal(triangles, points)

# A ball of points, its tetrahedra, and what is around it.
run("generate", "ball", "-n", 200, "-o", "ball.npy")
ball = np.load(FOLDER / "ball.npy")
run("triangulate", "ball.npy", "--dim", 3, "-o", "tetrahedra.npy")
tetrahedra = np.load(FOLDER / "tetrahedra.npy")

# Lines: a ring and a path between seven places, and the segments of both.
places = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0], [1, 1, 0], [3, 2, 0], [2, 2.5, 0]], float)
ring, path = [0, 1, 2, 3, 0], [4, 5, 6]
segments = np.array([side for chain in (ring, path) for side in itertools.pairwise(chain)])
# Polygons: one with a hole, one in two parts, one alone.
squares = [shapely.box(x, x, x + 3, x + 3) for x in (0, 10, 20)]
squares[0] = squares[0].difference(shapely.box(1, 1, 2, 2))
squares[1] = shapely.MultiPolygon([squares[1], shapely.box(50, 0, 52, 2)])
area_of_squares = sum(square.area for square in squares)
