"""Poisson's equation on meshes of Delone with scikit-fem: how fast the error falls on a square, and a plate with holes.

pip install './bindings/python[fem]'
python bindings/python/examples/poisson.py [poisson.png]

On the square the solution is known, so the error is too: with edges half as long it must be a quarter as large.
"""

# %% Linear elements on a mesh: -Δu = f inside, u = 0 on the border
import sys
from itertools import pairwise
from pathlib import Path

import delone
import matplotlib
import numpy as np
from skfem import Basis, BilinearForm, ElementTriP1, LinearForm, MeshTri, condense, solve
from skfem.helpers import dot, grad

if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt


@BilinearForm
def laplace(u, v, w):
    """The stiffness of a pair of shape functions."""
    return dot(grad(u), grad(v))


def poisson(mesh, load):
    """The elements, and the solution at the points that triangles have."""
    used, corners = np.unique(mesh.triangles, return_inverse=True)
    elements = MeshTri(mesh.points[used].T.copy(), corners.reshape(-1, 3).T.copy())
    basis = Basis(elements, ElementTriP1(), intorder=4)
    right = LinearForm(lambda v, w: load(*w.x) * v).assemble(basis)
    return basis, solve(*condense(laplace.assemble(basis), right, D=elements.boundary_nodes()))


# %% The unit square, where u = sin(πx) sin(πy): errors in the mean square
def wave(x, y):
    """The solution."""
    return np.sin(np.pi * x) * np.sin(np.pi * y)


square, around = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]]
lengths, errors = np.array([0.2, 0.1, 0.05]), []
for length in lengths:
    mesh = delone.mesh(square, around, min_angle=30, size=length)
    basis, u = poisson(mesh, lambda x, y: 2 * np.pi**2 * wave(x, y))
    off = (basis.interpolate(u).value - wave(*basis.global_coordinates().value)) ** 2
    errors.append(float(np.sqrt((off * basis.dx).sum())))
    print(f"edges up to {length:4.2f}: {len(mesh.triangles):5} triangles, error {errors[-1]:.2e}")
order = np.polyfit(np.log(lengths), np.log(errors), 1)[0]
print(f"the error falls like the length to the power of {order:.2f}")
assert 1.7 < order < 2.4, f"linear elements converge with order 2, not {order:.2f}"


# %% A plate with three bores and a slot: finer where it is narrow
def ring(x, y, rx, ry, count):
    """The corners of an ellipse."""
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.column_stack([x + rx * np.cos(turn), y + ry * np.sin(turn)])


corners = np.array([[0, 0], [8, 0], [8, 3], [5, 3], [4, 4], [0, 4]])
rings = [
    corners,
    ring(1.2, 1.2, 0.6, 0.6, 40),
    ring(1.2, 3, 0.4, 0.4, 30),
    ring(3, 2, 0.9, 0.3, 50),
    ring(6.5, 1.5, 0.8, 0.8, 50),
]
points, starts = np.concatenate(rings), np.cumsum([0, *map(len, rings)])
segments = np.concatenate([np.column_stack([k := np.arange(a, b), np.roll(k, -1)]) for a, b in pairwise(starts)])
centers = np.array([np.mean(r, axis=0) for r in rings[1:]])


def wanted(x, y):
    """Edges are short near bores."""
    return 0.08 + 0.12 * np.hypot(*(centers - (x, y)).T).min()


plate = delone.mesh(points, segments, min_angle=30, size=wanted, smooth=3)
basis, u = poisson(plate, lambda x, y: np.ones_like(x))
print(plate, f"smallest angle {plate.report.smallest_angle:.1f} degrees, largest value {u.max():.4f}")
assert not len(plate.report.left) and u.min() >= -1e-12 and abs(plate.area - basis.dx.sum()) < 1e-9

# %% A picture: the mesh, the solution, the errors
figure, (left, middle, right) = plt.subplots(1, 3, figsize=(15, 3.6), layout="constrained")
left.triplot(*plate.points.T, plate.triangles, linewidth=0.3, color="k")
left.set_title(f"{len(plate.triangles)} triangles")
drawn = middle.tripcolor(*basis.mesh.p, u, triangles=basis.mesh.t.T, shading="gouraud")
figure.colorbar(drawn, ax=middle)
middle.set_title("-Δu = 1, u = 0 on the border")
for axes in (left, middle):
    axes.set_aspect("equal")
right.loglog(lengths, errors, "o-", label=f"error, order {order:.2f}")
right.loglog(lengths, errors[0] * (lengths / lengths[0]) ** 2, "k:", label="order 2")
right.set_xlabel("longest edge")
right.legend()
out = Path(sys.argv[1] if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "poisson.png")
figure.savefig(out, dpi=110)
print(f"the picture is {out}")
