"""Delaunay triangulation and Voronoi diagrams in the plane and in space: exact on every input, fast, dynamic.

import delone

tri = delone.Delaunay(points)      # as scipy.spatial.Delaunay
tri.simplices, tri.neighbors, tri.find_simplex(queries)
tri.add_points(more)
tri.remove([17, 4])

delone.AlphaComplex(points).outline(alpha)
delone.OrderVoronoi(points, 3).locate(queries)
delone.Neighbors(points).query(queries, k=8)            # as scipy.spatial.KDTree
delone.ConstrainedDelaunay(points, segments).triangles
delone.triangulate_polygons(geometries)
delone.mesh(points, segments, min_angle=30, max_area=0.1).triangles
delone.triangle.triangulate(dictionary, "pq30a.1")      # as the package triangle
delone.euclidean_minimum_spanning_tree(points)
delone.NaturalNeighborInterpolator(points, values)(x, y)
delone.rasterize(points, z, cell=1.0), delone.contours(points, z, interval=10), delone.simplify(points, z, max_error=0.5)
delone.dtm("tile.laz", cell=1.0, output="dem.tif")                                  # terrain models of files or arrays
delone.tiles.triangulate(points, region), delone.dask.triangulate(array)       # more points than memory
delone.Periodic(points, box=[10, 10, 10]).volumes                               # a box that repeats
delone.RegularTriangulation(points, weights), delone.PowerDiagram(positions, weights).integrals()
"""

import os

from . import _delone, tiles, triangle
from ._alpha import AlphaComplex
from ._arcs import SecondOrder
from ._constrained import ConstrainedDelaunay
from ._delaunay import Delaunay
from ._dtm import dtm
from ._errors import CrossingError, QhullError
from ._graphs import (
    beta_skeleton,
    euclidean_minimum_spanning_tree,
    gabriel_graph,
    knn_graph,
    relative_neighborhood_graph,
)
from ._hints import Hints
from ._hull import ConvexHull
from ._interpolate import LinearInterpolator, LinearNDInterpolator, NaturalNeighborInterpolator
from ._layers import Layers
from ._mesh import LayerReport, Mesh, MeshAllQuads, MeshQuads, MeshReport, MeshShapes
from ._meshing import mesh
from ._neighbors import Neighbors
from ._orders import OrderVoronoi
from ._periodic import Periodic
from ._plot import plot
from ._polygons import PolygonTriangles, RaggedTriangles, triangulate_polygon, triangulate_polygons
from ._regular import PowerDiagram, RegularTriangulation
from ._terrain import ContourBand, ContourLine, Simplified, contours, rasterize, simplify
from ._voronoi import Voronoi
from ._weld import weld
from ._welded import Welded

# Threads do not survive a fork.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_delone.after_fork)

__version__ = "0.1.0"
__all__ = [
    "AlphaComplex",
    "ConstrainedDelaunay",
    "ContourBand",
    "ContourLine",
    "ConvexHull",
    "CrossingError",
    "Delaunay",
    "Hints",
    "LayerReport",
    "Layers",
    "LinearInterpolator",
    "LinearNDInterpolator",
    "Mesh",
    "MeshAllQuads",
    "MeshQuads",
    "MeshReport",
    "MeshShapes",
    "NaturalNeighborInterpolator",
    "Neighbors",
    "OrderVoronoi",
    "Periodic",
    "PolygonTriangles",
    "PowerDiagram",
    "QhullError",
    "RaggedTriangles",
    "RegularTriangulation",
    "SecondOrder",
    "Simplified",
    "Voronoi",
    "Welded",
    "beta_skeleton",
    "contours",
    "dtm",
    "euclidean_minimum_spanning_tree",
    "gabriel_graph",
    "knn_graph",
    "mesh",
    "plot",
    "rasterize",
    "relative_neighborhood_graph",
    "simplify",
    "tiles",
    "triangle",
    "triangulate_polygon",
    "triangulate_polygons",
    "weld",
]
