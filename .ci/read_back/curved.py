"""Drawings with curves, written by ezdxf: meshes of second order fill what they bound, and no element is inverted."""

import math

import ezdxf
import numpy as np
from ezdxf.math import BSpline, bulge_radius
from solvers import by_meshio, gmsh
from world import FOLDER, run

QUARTER = math.sqrt(2) - 1


def plate():
    """A rounded plate with round holes, a slot of lines and arcs, and a hole in a block that is turned."""
    drawing = ezdxf.new("R2010")
    model = drawing.modelspace()
    corners = [(1, 0, 0), (9, 0, QUARTER), (10, 1, 0), (10, 4, QUARTER), (9, 5, 0), (1, 5, QUARTER), (0, 4, 0), (0, 1, QUARTER)]
    model.add_lwpolyline(corners, format="xyb", close=True)
    model.add_circle((2, 2.5), 0.8)
    model.add_line((4.5, 2), (5.5, 2))
    model.add_line((5.5, 3), (4.5, 3))
    model.add_arc((5.5, 2.5), 0.5, -90, 90)
    model.add_arc((4.5, 2.5), 0.5, 90, 270)
    block = drawing.blocks.new("hole")
    # A half disk, by a bulge of one.
    block.add_lwpolyline([(0, 0, 1), (1, 0, 0)], format="xyb", close=True)
    model.add_blockref("hole", (8, 2.5), dxfattribs={"xscale": 0.9, "yscale": 0.9, "rotation": 30})
    drawing.saveas(FOLDER / "curved.dxf")
    (insert,) = model.query("INSERT")
    (half,) = insert.virtual_entities()
    outline = model.query("LWPOLYLINE").first
    return area_of(outline) - area_of(half) - math.pi * 0.8**2 - 1 - math.pi * 0.5**2


def area_of(polyline):
    """The area in a closed polyline, with its arcs."""
    area = 0.0
    vertices = polyline.get_points("xyb")
    for (x, y, bulge), (u, v, _) in zip(vertices, [*vertices[1:], vertices[0]], strict=True):
        area += (x * v - u * y) / 2
        if bulge:
            turn = 4 * math.atan(bulge)
            area += bulge_radius((x, y), (u, v), bulge) ** 2 * (turn - math.sin(turn)) / 2
    return abs(area)


def jacobians(sixes, at):
    """Of triangles with six nodes, at barycentric coordinates."""
    u, v = at
    w = 1 - u - v
    along_u = np.array([1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v])
    along_v = np.array([1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)])
    first, second = (np.einsum("j,tjd->td", along, sixes) for along in (along_u, along_v))
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]


def drawings_with_arcs():
    """By meshio, and by gmsh's own measure of elements."""
    wanted = plate()
    kinds = ("msh", "vtu", "inp", "bdf", "xdmf")
    outputs = [word for kind in kinds for word in ("-o", f"curved.{kind}")]
    for options in (("--edge", 0.4), ("--min-angle", 28), ("--max-area", 0.1, "--smooth", 3)):
        run("mesh", "curved.dxf", "--fill", "even-odd", "--second-order", "--check", *options, *outputs)
        for kind in kinds:
            mesh = by_meshio(f"curved.{kind}")
            sixes = mesh.points[mesh.cells_dict["triangle6"]][..., :2]
            area = sum(jacobians(sixes, at).sum() for at in ((0.5, 0), (0.5, 0.5), (0, 0.5))) / 6
            # Quadratic functions along arcs of 11.25 degrees.
            assert abs(area / wanted - 1) < 2e-6, f"{kind}: {area}, not {wanted}"
            worst = min(jacobians(sixes, (i / 6, j / 6)).min() for i in range(7) for j in range(7 - i))
            assert worst > 0, f"{kind}: an element is inverted"
        if gmsh is not None:
            gmsh.initialize()
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(str(FOLDER / "curved.msh"))
            tags = np.concatenate(gmsh.model.mesh.getElements(2)[1])
            assert min(gmsh.model.mesh.getElementQualities(tags, "minSJ")) > 0.5
            gmsh.finalize()


def closed_curves():
    """A spline, a rational one and an ellipse far from the origin: drawings, with many points of each."""
    around = [(637000 + r * math.cos(a), r * math.sin(a)) for a, r in zip(range(6), (3, 2, 2.5, 3, 1.5, 2), strict=True)]
    places = [(x, y, 0) for x, y in [*around, around[0]]]
    for weights in (None, [1, 2, 0.5, 1, 3, 1, 2]):
        drawing = ezdxf.new("R2010")
        curve = BSpline(places, order=4, weights=weights)
        spline = drawing.modelspace().add_spline()
        spline.control_points, spline.knots, spline.dxf.degree = places, curve.knots(), 3
        if weights:
            spline.weights = weights
        yield drawing, np.array([(point.x, point.y) for point in curve.approximate(20_000)])
    drawing = ezdxf.new("R2010")
    ellipse = drawing.modelspace().add_ellipse((637000, 5), (2, 1), ratio=0.2)
    yield drawing, np.array([(point.x, point.y) for point in ellipse.vertices(np.linspace(0, 2 * math.pi, 20_001))])


def drawings_with_splines():
    """Areas are those of the curves."""
    for drawing, points in closed_curves():
        drawing.saveas(FOLDER / "spline.dxf")
        run("mesh", "spline.dxf", "--fill", "even-odd", "--edge", 0.4, "--second-order", "--check", "-o", "spline.vtu")
        mesh = by_meshio("spline.vtu")
        sixes = mesh.points[mesh.cells_dict["triangle6"]][..., :2] - [637000, 0]
        area = sum(jacobians(sixes, at).sum() for at in ((0.5, 0), (0.5, 0.5), (0, 0.5))) / 6
        x, y = (points - [637000, 0]).T
        wanted = abs((x[:-1] * y[1:] - x[1:] * y[:-1]).sum() + x[-1] * y[0] - x[0] * y[-1]) / 2
        assert abs(area / wanted - 1) < 3e-4, f"{area}, not {wanted}"


JUDGES = [drawings_with_arcs, drawings_with_splines]
