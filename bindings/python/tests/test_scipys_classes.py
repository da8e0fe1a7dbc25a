"""delone.scipy: classes that are derived, attributes, signatures, and what is assigned, beside SciPy itself."""

import copy
import inspect
import pickle
import pydoc
import threading

import delone
import delone.scipy as spatial
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

RANDOM = np.random.default_rng(54)
SPATIAL = ["Delaunay", "Voronoi", "ConvexHull", "HalfspaceIntersection"]
INTERPOLATORS = ["LinearNDInterpolator", "CloughTocher2DInterpolator"]
PACKAGES = {**dict.fromkeys(SPATIAL, scipy.spatial), **dict.fromkeys([*INTERPOLATORS, "griddata"], scipy.interpolate)}


def theirs(name):
    return getattr(PACKAGES[name], name)


def around(ndim, count=40):
    """Half-spaces that touch a sphere."""
    normals = RANDOM.normal(size=(count, ndim))
    return np.column_stack([normals / np.linalg.norm(normals, axis=1, keepdims=True), -np.ones(count)])


def given(name, ndim):
    """What a constructor takes."""
    if name == "HalfspaceIntersection":
        return around(ndim), np.zeros(ndim)
    points = RANDOM.random((40, ndim))
    return (points, RANDOM.random(40)) if name in INTERPOLATORS else (points,)


# Classes that users derive.


class Counted:
    """A part that has nothing to do with triangulations."""

    def __init__(self, *args, tag="none", **options):
        super().__init__(*args, **options)
        self.tag = tag

    def find_simplex(self, xi):
        return super().find_simplex(xi) + 100

    @property
    def twice(self):
        return 2 * self.ndim


DERIVED = {
    name: type(f"Derived{name}", (Counted, getattr(spatial, name)), {"__module__": __name__})
    for name in PACKAGES
    if name[0] != "g"
}
globals().update({kind.__name__: kind for kind in DERIVED.values()})


class Explicit(spatial.Delaunay):
    def __init__(self, points):
        self.before = 1
        spatial.Delaunay.__init__(self, points, qhull_options="Qbb Qt Qc C-0")


class Slotted(spatial.ConvexHull):
    __slots__ = ("mine",)


@pytest.mark.parametrize("ndim", [2, 3, 4, 5])
@pytest.mark.parametrize("name", DERIVED)
def test_classes_that_users_derive(name, ndim):
    if name == "CloughTocher2DInterpolator" and ndim > 2:
        return
    args = given(name, ndim)
    kind = DERIVED[name]
    made = kind(*args, tag="kept")
    assert isinstance(made, kind) and isinstance(made, getattr(spatial, name)) and isinstance(made, theirs(name))
    assert type(made).__name__ == kind.__name__ and made.tag == "kept"
    expected = theirs(name)(*args)
    at = RANDOM.random((20, ndim))
    for each in (made, copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made))):
        assert isinstance(each, kind) and each.tag == "kept"
        if name in INTERPOLATORS:
            assert np.allclose(each(at), expected(at), equal_nan=True, rtol=0, atol=0.1)
            continue
        assert each.twice == 2 * ndim
        if name == "Delaunay" and each is made:
            assert np.array_equal(each.find_simplex(at) > 99, expected.find_simplex(at) >= 0)
            if ndim > 3:
                assert np.array_equal(each.simplices, expected.simplices)
        if name == "ConvexHull":
            assert np.isclose(each.volume, expected.volume)
        if name == "Voronoi":
            assert len(each.vertices) == len(expected.vertices)
        if name == "HalfspaceIntersection":
            assert len(each.intersections) == len(expected.intersections)


def test_derived_classes_with_what_only_qhull_has():
    points = RANDOM.random((30, 3))
    tri = DERIVED["Delaunay"](points, furthest_site=True)
    assert isinstance(tri, DERIVED["Delaunay"]) and not isinstance(tri, delone.Delaunay) and tri.furthest_site
    made = Explicit(points)
    assert isinstance(made, Explicit) and made.before == 1 and made.find_simplex(points).shape == (30,)
    twins = np.repeat(RANDOM.random((9, 2)), 2, axis=0)
    assert len(set(DERIVED["Delaunay"](twins, qhull_options="QJ Pp").simplices.ravel())) == 18
    grown = DERIVED["ConvexHull"](RANDOM.random((30, 4)), incremental=True)
    grown.add_points(np.full((1, 4), 5.0))
    assert 30 in grown.vertices and isinstance(grown, DERIVED["ConvexHull"])
    hull = Slotted(RANDOM.random((30, 4)))
    hull.mine = 1
    assert isinstance(hull, Slotted) and hull.nsimplex > 4
    assert type(DERIVED["Delaunay"](RANDOM.random((9, 4)))) is type(DERIVED["Delaunay"](RANDOM.random((9, 5))))
    with pytest.raises(scipy.spatial.QhullError):
        DERIVED["Delaunay"](np.zeros((9, 4)))


def test_constructors_may_be_called_again():
    space, plane = RANDOM.random((30, 4)), RANDOM.random((30, 2))
    tri = Explicit(space)
    for points, options in [(plane, "Qt"), (space, "Qt"), (plane, "Qt"), (plane, "C-0 Qt"), (plane[:9], "Qt")]:
        spatial.Delaunay.__init__(tri, points, qhull_options=options)
        assert isinstance(tri, Explicit) and isinstance(tri, delone.Delaunay) == (options == "Qt" and points.shape[1] == 2)
        assert tri.simplices.shape == (tri.nsimplex, points.shape[1] + 1) and tri.npoints == len(points)
        tri.simplices = tri.simplices[:1]
        if isinstance(tri, delone.Delaunay):
            assert tri.nsimplex == 1


# Attributes.


def kind_of(value):
    if isinstance(value, np.ndarray):
        return value.dtype, value.ndim, value.flags.c_contiguous, value.flags.writeable
    if isinstance(value, (list, tuple)):
        return type(value), frozenset(kind_of(element) for element in value)
    return type(value)


def attempt(do, *args):
    try:
        do(*args)
    except Exception as error:
        return type(error)
    return None


@pytest.mark.parametrize("ndim", [2, 3])
@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("Delaunay", {}),
        ("Delaunay", {"incremental": True}),
        ("Delaunay", {"furthest_site": True}),
        ("Voronoi", {}),
        ("Voronoi", {"furthest_site": True}),
        ("ConvexHull", {}),
        ("ConvexHull", {"qhull_options": "QG4"}),
        ("HalfspaceIntersection", {}),
        ("LinearNDInterpolator", {}),
        ("LinearNDInterpolator", {"rescale": True, "fill_value": 0}),
        ("CloughTocher2DInterpolator", {}),
        ("CloughTocher2DInterpolator", {"rescale": True}),
    ],
)
def test_attributes_are_of_the_same_kind(name, options, ndim):
    if name == "CloughTocher2DInterpolator" and ndim == 3:
        return
    args = given(name, ndim)
    made, expected = getattr(spatial, name)(*args, **options), theirs(name)(*args, **options)
    names = [each for each in dir(expected) if not each.startswith("_") and not callable(getattr(expected, each, None))]
    assert len(names) > 5
    for each in names:
        value = getattr(expected, each)
        if each != "tri":
            assert kind_of(getattr(made, each)) == kind_of(value), each
        # What can be assigned and deleted there can here.
        for act in (lambda o, each=each: setattr(o, each, getattr(o, each)), lambda o, each=each: delattr(o, each)):
            if attempt(act, copy.copy(expected)) is None:
                assert attempt(act, copy.copy(made)) is None, each
        if attempt(delattr, other := copy.copy(expected), each) is None and not hasattr(other, each):
            gone = copy.copy(made)
            delattr(gone, each)
            assert not hasattr(gone, each), each
            assert attempt(delattr, gone, each) is AttributeError


@pytest.mark.parametrize("name", PACKAGES)
def test_signatures_are_told(name):
    ours, expected = (inspect.signature(each).parameters for each in (getattr(spatial, name), theirs(name)))
    assert list(ours)[: len(expected)] == list(expected)
    for key, parameter in expected.items():
        assert repr(ours[key].default) == repr(parameter.default) and ours[key].kind == parameter.kind
    assert all(p.default is not p.empty for key, p in ours.items() if key not in expected)
    text = pydoc.plain(pydoc.render_doc(getattr(spatial, name)))
    assert f"{name}({next(iter(expected))}: " in text


@pytest.mark.parametrize("name", SPATIAL + INTERPOLATORS)
def test_what_was_never_made_is_shown(name):
    kind = getattr(spatial, name)
    assert name in repr(object.__new__(kind)) and name in repr(kind.__new__(kind))
    assert name in repr(kind(*given(name, 2)))


# What is assigned.


@pytest.mark.parametrize("ndim", [2, 3])
def test_simplices_that_were_assigned_are_asked(ndim):
    points = RANDOM.random((40, ndim))
    points = np.vstack([points, points[:3]])
    at, values = RANDOM.random((200, ndim)), points.sum(axis=1) ** 2
    expected = scipy.spatial.Delaunay(points)
    names = "simplices neighbors equations coplanar good nsimplex paraboloid_scale paraboloid_shift min_bound max_bound"
    tri, tri_of_f = spatial.Delaunay(points), spatial.Delaunay(points)
    f = spatial.LinearNDInterpolator(tri_of_f, values)
    # What was made before is not kept.
    for each in ("transform", "vertex_to_simplex", "equations", "convex_hull"):
        getattr(tri, each)
    before = f(at)
    for name in names.split():
        setattr(tri, name, getattr(expected, name))
        setattr(tri_of_f, name, getattr(expected, name))
    for name in ("convex_hull", "transform", "vertex_to_simplex"):
        assert np.array_equal(getattr(tri, name), getattr(expected, name), equal_nan=True), name
    for ours, scipys in zip(tri.vertex_neighbor_vertices, expected.vertex_neighbor_vertices, strict=True):
        assert np.array_equal(ours, scipys)
    for options in ({}, {"bruteforce": True}, {"tol": 1e-3}):
        assert np.array_equal(tri.find_simplex(at, **options), expected.find_simplex(at, **options))
    assert np.allclose(tri.plane_distance(at), expected.plane_distance(at))
    assert np.allclose(tri.lift_points(at), expected.lift_points(at))
    linear = scipy.interpolate.LinearNDInterpolator(expected, values)(at)
    for made in (f, spatial.LinearNDInterpolator(tri, values), scipy.interpolate.LinearNDInterpolator(tri, values)):
        assert np.array_equal(made(at), linear, equal_nan=True)
    assert np.allclose(before, linear, equal_nan=True)
    if ndim == 2:
        smooth = [spatial.CloughTocher2DInterpolator(t, values, tol=1e-12)(at) for t in (tri, expected)]
        assert np.allclose(*smooth, equal_nan=True, rtol=0, atol=1e-5)
    tri.min_bound = tri.min_bound + 10
    assert (tri.find_simplex(at) == -1).all()
    tri.add_points(RANDOM.random((1, ndim)))
    assert tri.npoints == 44 and len(tri.simplices) == tri.nsimplex and (tri.find_simplex(points) >= 0).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_assigned_arrays_that_do_not_fit_are_told(ndim):
    points = RANDOM.random((40, ndim))
    tri = spatial.Delaunay(points)
    tri.simplices = tri.simplices[::2]
    assert tri.simplices.flags.c_contiguous, "SciPy's compiled code reads no other arrays"
    assert tri.nsimplex == len(tri.transform) == len(tri.equations) == tri.plane_distance(points).shape[1]
    for ask in (lambda: tri.find_simplex(points), lambda: tri.convex_hull):
        with pytest.raises(ValueError, match="neighbors must be assigned"):
            ask()
    tri.neighbors = np.full_like(tri.simplices, -1)
    tri.find_simplex(points)
    for name, value in [
        ("simplices", tri.simplices + 1000),
        ("simplices", tri.simplices - 1000),
        ("simplices", tri.simplices[:, :2]),
        ("simplices", tri.simplices.astype(np.int64)),
        ("neighbors", tri.neighbors + len(tri.simplices) + 1),
        ("neighbors", tri.neighbors - 1),
        ("equations", tri.equations[1:]),
        ("min_bound", np.zeros(1)),
        ("npoints", 3),
        ("nsimplex", 3),
        ("ndim", 7),
    ]:
        other = copy.copy(tri)
        setattr(other, name, value)
        with pytest.raises(ValueError):
            other.find_simplex(points)
        if name == "simplices":
            with pytest.raises((ValueError, IndexError, TypeError)):
                _ = other.transform
            with pytest.raises((ValueError, IndexError, TypeError)):
                _ = other.vertex_neighbor_vertices


def test_points_that_are_added_leave_interpolators_behind():
    points, values, at = RANDOM.random((40, 2)), RANDOM.random(40), RANDOM.random((50, 2))
    for name in INTERPOLATORS:
        tri = spatial.Delaunay(points)
        f = getattr(spatial, name)(tri, values)
        f(at)
        tri.add_points(at)
        with pytest.raises(ValueError, match="40 values and 90 points"):
            f(at)
    f = spatial.CloughTocher2DInterpolator(points, values)
    f.values = f.values[:3]
    with pytest.raises(ValueError, match="3 values"):
        f(at)


def test_triangulations_of_delone_are_taken():
    points, at = RANDOM.random((40, 2)), RANDOM.random((50, 2))
    values = points @ [1.0, 2.0]
    for name in INTERPOLATORS:
        found = getattr(spatial, name)(delone.Delaunay(points), values)(at)
        inside = ~np.isnan(found)
        assert inside.any() and np.allclose(found[inside], at[inside] @ [1.0, 2.0])


# Values and places that are no float64.

VALUES = {
    "objects": lambda v: v.astype(object),
    "integers": lambda v: (v * 100).astype(np.int16),
    "booleans": lambda v: v > 0.5,
    "strings": lambda v: v.astype(str),
    "objects that are strings": lambda v: v.astype(str).astype(object),
    "half precision": lambda v: v.astype(np.float16),
    "long doubles": lambda v: v.astype(np.longdouble),
    "masked": lambda v: np.ma.array(v, mask=v > 0.5),
    "complex": lambda v: v + 1j,
    "single complex": lambda v: (v + 1j).astype(np.complex64),
    "columns": lambda v: np.stack([v, -v], axis=1),
    "tables": lambda v: np.stack([v, -v, v, v], axis=1).reshape(-1, 2, 2),
    "no columns": lambda v: np.empty((len(v), 0)),
    "a list": lambda v: v.tolist(),
    "NaN": lambda v: np.where(v > 0.9, np.nan, v),
}
PLACES = {
    "objects": lambda at: at.astype(object),
    "strings": lambda at: at.astype(str),
    "masked": lambda at: np.ma.array(at, mask=at > 0.5),
    "a tuple of masked": lambda at: tuple(np.ma.array(at, mask=at > 0.5).T),
    "complex": lambda at: at + 1j,
    "a tuple of complex": lambda at: tuple((at + 1j).T),
    "a tuple of strings": lambda at: tuple(at.T.astype(str)),
    "single precision": lambda at: at.astype(np.float32),
    "a row": lambda at: at[0],
    "a long row": lambda at: at.ravel(),
    "a list": lambda at: at.tolist(),
    "a grid": lambda at: at[:40].reshape(4, 10, 2),
    "none": lambda at: at[:0],
    "a tuple of numbers": lambda at: (0.5, 0.25),
    "broadcast": lambda at: (at[:5, :1], at[:7, 1]),
    "not finite": lambda at: np.where(at > 0.8, np.inf, np.where(at < 0.1, np.nan, at)),
    "columns in Fortran's order": lambda at: np.asfortranarray(at),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("rescale", [False, True])
@pytest.mark.parametrize("name", [*INTERPOLATORS, "griddata linear", "griddata cubic"])
def test_values_and_places_are_taken_as_scipy_does(name, rescale):
    points, values, at = RANDOM.random((40, 2)), RANDOM.random(40), RANDOM.random((50, 2))

    def both(given, place):
        for package in (spatial, PACKAGES[name.split()[0]]):
            if name.startswith("griddata"):
                yield package.griddata(points, given, place, method=name.split()[1], rescale=rescale)
            else:
                yield getattr(package, name)(points, given, rescale=rescale)(place)

    cases = [(what, make(values), at) for what, make in VALUES.items()]
    cases += [(what, values, make(at)) for what, make in PLACES.items()]
    for what, value, place in cases:
        ours, expected = both(value, place)
        assert ours.dtype == expected.dtype and ours.shape == expected.shape and type(ours) is type(expected), what
        atol = 1e-12 if "inear" in name else 1e-2 * max(1.0, np.nanmax(np.abs(np.asarray(expected)), initial=0.0))
        assert np.allclose(ours, expected, equal_nan=True, rtol=0, atol=atol), what


@pytest.mark.filterwarnings("ignore")
def test_places_to_be_found_are_taken_as_scipy_does():
    points, at = RANDOM.random((40, 2)), RANDOM.random((40, 2))
    ours, expected = spatial.Delaunay(points), scipy.spatial.Delaunay(points)
    for what, make in PLACES.items():
        place = make(at)
        if isinstance(place, tuple):
            continue
        found = ours.find_simplex(place) if what != "a long row" else ours.find_simplex(at)
        wanted = expected.find_simplex(place) if what != "a long row" else expected.find_simplex(at)
        assert found.dtype == wanted.dtype and found.shape == wanted.shape, what
        same = [
            set(a) == set(b) if i >= 0 and k >= 0 else i == k
            for i, k, a, b in zip(
                found.ravel(), wanted.ravel(), ours.simplices[found.ravel()], expected.simplices[wanted.ravel()], strict=True
            )
        ]
        assert all(same), what


def test_masked_points_that_are_added_are_taken_as_scipy_does():
    points, more = RANDOM.random((40, 2)), RANDOM.random((5, 2)) * 2
    for name in ("Delaunay", "Voronoi", "ConvexHull"):
        made = [kind(points, incremental=True) for kind in (getattr(spatial, name), theirs(name))]
        for each in made:
            each.add_points(np.ma.array(more, mask=more > 1))
            each.add_points(np.empty((0, 2)))
        assert np.array_equal(*(each.points for each in made)) and made[0].npoints == 45


# Patches.


def test_patches_may_end_in_any_order():
    kinds = scipy.spatial.Delaunay, scipy.interpolate.griddata
    first, second = spatial.patched(), spatial.patched()
    first.__enter__()
    second.__enter__()
    first.__exit__(None, None, None)
    assert scipy.spatial.Delaunay is spatial.Delaunay, "one is left"
    second.__exit__(None, None, None)
    assert kinds == (scipy.spatial.Delaunay, scipy.interpolate.griddata)


def test_patches_of_several_threads():
    kinds = scipy.spatial.Delaunay, scipy.interpolate.griddata
    barrier, wrong = threading.Barrier(8), []

    def work():
        barrier.wait()
        for _ in range(5):
            with spatial.patched():
                if scipy.spatial.Delaunay is not spatial.Delaunay:
                    wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong and kinds == (scipy.spatial.Delaunay, scipy.interpolate.griddata)
