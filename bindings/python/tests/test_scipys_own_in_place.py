"""SciPy's own tests once more, with the classes of delone.scipy in their place: of any dimension, half-spaces too."""

import importlib.util
import re
import sys
import types
import warnings
from pathlib import Path

import delone.scipy
import pytest
import scipy.interpolate
import scipy.spatial
from test_scipys_own import substituted

NUMBERS = "the order of rows and corners is that in which Qhull meets them"
#: Names of tests, and why they fail.
EXPECTED = [
    (r"TestUtilities::test_(find_simplex|convex_hull)|test_2d_square|TestDelaunay::test_furthest_site", NUMBERS),
    (r"test_good2d\[|test_good2d_incremental_changes\[new_gen[123]-", NUMBERS),
    (r"Voronoi::test_(simple|furthest_site)$", NUMBERS),
    (r"HalfspaceIntersection::test_cube", NUMBERS),
    (r"test_degenerate_barycentric_transforms", "31 simplices are flat, where Qhull drops 9 of them, and 22 are allowed"),
]

NAMES = ("Delaunay", "ConvexHull", "HalfspaceIntersection", "tsearch")
again = substituted(delone.scipy.Voronoi, delone.scipy, NAMES)
globals().update({name: tests for name, tests in vars(again).items() if re.match("[Tt]est", name)})
del again.Test_Qhull.test_swapping


def interpolation(name):
    """Their tests of a module of interpolation, made again with these classes."""
    theirs = pytest.importorskip(f"scipy.interpolate.tests.{name}", reason="SciPy was installed without its tests")
    with pytest.MonkeyPatch.context() as patch, warnings.catch_warnings():
        for package, module in ((scipy.spatial, "_qhull"), (scipy.interpolate, "_interpnd")):
            real = getattr(package, module)
            shim = types.ModuleType(real.__name__)
            names = [key for key in dir(real) if not key.startswith("__")]
            ours = delone.scipy.__all__
            shim.__dict__.update({key: getattr(delone.scipy if key in ours else real, key) for key in names})
            patch.setattr(package, module, shim)
            patch.setitem(sys.modules, real.__name__, shim)
        warnings.simplefilter("ignore")
        spec = importlib.util.spec_from_file_location(f"again_{name}", theirs.__file__)
        made = importlib.util.module_from_spec(spec)
        with delone.scipy.patched():
            spec.loader.exec_module(made)
    return {key: tests for key, tests in vars(made).items() if re.match("[Tt]est", key)}


globals().update({**interpolation("test_interpnd"), **interpolation("test_ndgriddata")})


@pytest.fixture(autouse=True)
def _expected(request):
    if Path(str(request.node.fspath)).name == Path(__file__).name:
        for pattern, reason in EXPECTED:
            if re.search(pattern, request.node.nodeid):
                request.node.add_marker(pytest.mark.xfail(reason=reason, strict=True))
                return
