"""How right finite elements are on meshes of gmsh and of delone, with as many unknowns.

python with_gmsh_fem.py

Two problems with known solutions, in linear elements: an L-shape, whose solution is r^(2/3) sin(2 t / 3) around the corner that
points inwards, and a disk with the load 1. For each mesh: unknowns, the error of the gradient (H1), that error times the root of
the unknowns, and the condition number of the stiffness matrix over them. Lengths are chosen so that all meshes of a problem have
the same number of points within one percent. Needs: pip install gmsh scikit-fem numpy scipy, and delone.
"""

import delone
import gmsh
import numpy as np
from scipy.sparse.linalg import eigsh
from skfem import Basis, BilinearForm, ElementTriP1, Functional, LinearForm, MeshTri, condense, solve
from skfem.helpers import dot, grad

#: Parts of a circle.
SIDES = 256
L_SHAPE = [(-1, -1), (1, -1), (1, 0), (0, 0), (0, 1), (-1, 1)]
DISK = [(np.cos(2 * np.pi * k / SIDES), np.sin(2 * np.pi * k / SIDES)) for k in range(SIDES)]


def by_gmsh(corners, length):
    """Gmsh's frontal Delaunay mesh."""
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.Algorithm", 6)
    points = [gmsh.model.geo.addPoint(x, y, 0, length) for x, y in corners]
    lines = [gmsh.model.geo.addLine(*ends) for ends in zip(points, points[1:] + points[:1], strict=True)]
    gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(lines)])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(2)
    names, places, _ = gmsh.model.mesh.getNodes()
    triangles = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    gmsh.finalize()
    row = np.zeros(int(names.max()) + 1, int)
    row[names.astype(int)] = np.arange(len(names))
    return places.reshape(-1, 3)[:, :2], row[triangles.astype(int)]


def by_edge(corners, length):
    """Edges of a wanted length."""
    made = delone.mesh(corners, sides(corners), edge=length, min_angle=30)
    return made.points, made.triangles


def by_area(corners, length):
    """Bounds of areas."""
    made = delone.mesh(corners, sides(corners), max_area=0.6 * length**2, min_angle=30)
    return made.points, made.triangles


def sides(corners):
    """A ring of segments."""
    return [[k, (k + 1) % len(corners)] for k in range(len(corners))]


def angle(x, y):
    """Around the inward corner, from one side of it to the other."""
    return np.mod(np.arctan2(y, x) - np.pi / 2, 2 * np.pi)


def in_l_shape(x, y):
    """The solution."""
    return np.hypot(x, y) ** (2 / 3) * np.sin(2 * angle(x, y) / 3)


def slope_in_l_shape(x, y):
    """Its gradient."""
    radius, turn = 2 / 3 * np.hypot(x, y) ** (-1 / 3), np.arctan2(y, x)
    along, across = radius * np.sin(2 * angle(x, y) / 3), radius * np.cos(2 * angle(x, y) / 3)
    return along * np.cos(turn) - across * np.sin(turn), along * np.sin(turn) + across * np.cos(turn)


def in_disk(x, y):
    """The solution."""
    return (1 - x * x - y * y) / 4


def slope_in_disk(x, y):
    """Its gradient."""
    return -x / 2, -y / 2


def measured(points, triangles, solution, slope, load):
    """Unknowns, the error, and the condition number."""
    used, corners = np.unique(triangles, return_inverse=True)
    mesh = MeshTri(points[used].T.copy(), corners.reshape(-1, 3).T.copy())
    basis, border = Basis(mesh, ElementTriP1(), intorder=6), mesh.boundary_nodes()
    stiffness = BilinearForm(lambda u, v, w: dot(grad(u), grad(v))).assemble(basis)
    loads = LinearForm(lambda v, w: load * v).assemble(basis)
    found = solve(*condense(stiffness, loads, x=solution(*mesh.p), D=border))
    error = Functional(lambda w: sum((g - s) ** 2 for g, s in zip(grad(w["u"]), slope(*w.x), strict=True)))
    inner = condense(stiffness, D=border, expand=False).tocsc()
    largest, least = eigsh(inner, 1, which="LA")[0][0], eigsh(inner, 1, sigma=0)[0][0]
    return inner.shape[0], np.sqrt(error.assemble(basis, u=basis.interpolate(found))), largest / least


def main():
    """Both problems on three meshes."""
    print(f"{'problem':8} {'mesh':15} {'unknowns':>8} {'H1 error':>9} {'error sqrt(n)':>13} {'condition / n':>13}")
    for name, corners, *problem in (
        ("L-shape", L_SHAPE, in_l_shape, slope_in_l_shape, 0.0),
        ("disk", DISK, in_disk, slope_in_disk, 1.0),
    ):
        wanted = None
        for how, make in (("gmsh", by_gmsh), ("delone, edge", by_edge), ("delone, area", by_area)):
            length = 0.05
            for _ in range(12):
                points, triangles = make(corners, length)
                count = len(np.unique(triangles))
                wanted = wanted or count
                if abs(count / wanted - 1) < 0.01:
                    break
                length *= np.sqrt(count / wanted)
            n, error, condition = measured(points, triangles, *problem)
            print(f"{name:8} {how:15} {n:8} {error:9.5f} {error * n**0.5:13.4f} {condition / n:13.4f}", flush=True)


if __name__ == "__main__":
    main()
