"""Boundary layers of meshes."""

from __future__ import annotations

import pickle

import delone
import numpy as np
import pytest

BOX = [[0, 0], [6, 0], [6, 1], [0, 1]]
SIDES = [[0, 1], [1, 2], [2, 3], [3, 0]]


def test_walls_of_a_channel_have_rows() -> None:
    walls = delone.Layers(0.01, 4, growth=2, segments=[0, 2])
    made = delone.mesh(BOX, SIDES, edge=0.25, min_angle=28, layers=walls)
    made.check()
    layers = made.report.layers
    assert (layers.rows, layers.shortened, len(made.report.left)) == (4, 0, 0)
    assert layers.points == 4 * layers.places
    assert layers.triangles == made.is_layer.sum() == 8 * (layers.places - 2)
    assert not made.is_layer.flags.writeable
    assert np.isclose(made.area, 6, rtol=1e-12)
    y = made.points[made.triangles[made.is_layer], 1]
    found = np.unique(np.minimum(y, 1 - y).round(14))
    assert np.allclose(found, [0, 0.01, 0.03, 0.07, 0.15])
    assert np.isclose(made.areas[made.is_layer].sum(), 12 * 0.15)
    # Segments are those of the border alone.
    assert set(made.segment_origin.tolist()) == {0, 1, 2, 3}
    on = made.points[made.segments]
    assert (((on[:, :, 0] % 6) == 0).all(axis=1) | ((on[:, :, 1] % 1) == 0).all(axis=1)).all()
    for again in (pickle.loads(pickle.dumps(made)), delone.mesh(BOX, SIDES, edge=0.25, min_angle=28, layers=walls)):
        assert np.array_equal(again.points, made.points) and np.array_equal(again.triangles, made.triangles)


def test_layers_stay_in_a_mesh_that_is_refined() -> None:
    made = delone.mesh(BOX, SIDES, edge=0.25, layers=delone.Layers(0.02))
    finer = made.refine(max_area=0.01)
    assert finer.is_layer.sum() == made.is_layer.sum() == made.report.layers.triangles > 0

    def corners(mesh: delone.Mesh) -> set[tuple[int, ...]]:
        return {tuple(sorted(t)) for t in mesh.triangles[mesh.is_layer].tolist()}

    assert corners(made) == corners(finer)
    assert made.parents.shape == made.is_layer.shape
    assert not delone.mesh(BOX, SIDES).is_layer.any()


def test_segments_by_flags_and_fewer_rows() -> None:
    flags = delone.Layers(0.01, 9, thickness=0.031, growth=1, segments=np.array([True, False, False, False]))
    made = delone.mesh(BOX, SIDES, edge=0.5, layers=flags)
    assert made.report.layers.rows == 3
    narrow = delone.mesh(BOX, SIDES, edge=0.5, layers=delone.Layers(0.2, 9))
    assert narrow.report.layers.rows < 9 and narrow.report.layers.shortened > 0


@pytest.mark.parametrize(
    ("layers", "error", "told"),
    [
        (0.1, TypeError, "delone.Layers"),
        (delone.Layers(0), ValueError, "layers.first_height"),
        (delone.Layers(float("nan")), ValueError, "layers.first_height"),
        (delone.Layers(float("inf")), ValueError, "layers.first_height"),
        (delone.Layers("a"), TypeError, "layers.first_height"),
        (delone.Layers(1, 0), ValueError, "layers.count"),
        (delone.Layers(1, 2000), ValueError, "layers.count"),
        (delone.Layers(1, 1.5), TypeError, "layers.count"),
        (delone.Layers(1, growth=0.5), ValueError, "layers.growth"),
        (delone.Layers(1, thickness=-1), ValueError, "layers.thickness"),
        (delone.Layers(1, segments=[4]), IndexError, "layers.segments"),
        (delone.Layers(1, segments=[True]), ValueError, "layers.segments"),
    ],
)
def test_wrong_layers_are_refused(layers: object, error: type[Exception], told: str) -> None:
    with pytest.raises(error, match=told.replace(".", r"\.")):
        delone.mesh(BOX, SIDES, layers=layers)
