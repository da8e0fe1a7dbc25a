import os
from pathlib import Path

import delone
import numpy as np
import pytest

dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")
da = pytest.importorskip("dask.array")

import delone.dask  # noqa: E402

RANDOM = np.random.default_rng(3)


def expected(points):
    return delone.tiles.fingerprint(points, delone.Delaunay(points).simplices)


@pytest.mark.parametrize("chunk", [700, 10_000])
@pytest.mark.parametrize("count", [1, 2, 20, None])
def test_chunks_and_tiles_do_not_matter(chunk, count):
    grid = np.stack(np.meshgrid(np.arange(70.0), np.arange(70.0)), axis=-1).reshape(-1, 2)
    for points in [RANDOM.random((4000, 2)), np.concatenate([grid, grid[::3]])]:
        made = delone.dask.triangulate(da.from_array(points, chunks=(chunk, 2)), tiles=count)
        triangles, total = dask.compute(made.triangles, made.fingerprint)
        assert total == expected(points)
        assert delone.tiles.fingerprint(points, triangles) == total


def test_unknown_chunks_and_one_coordinate_each():
    points = RANDOM.random((5000, 2))
    array = da.from_array(points, chunks=(900, 1))
    array = array[array[:, 0] > 0.25]
    made = delone.dask.triangulate(array, tiles=6)
    assert made.fingerprint.compute() == expected(points[points[:, 0] > 0.25])


def test_what_cannot_be_is_refused():
    with pytest.raises(ValueError, match="shape"):
        delone.dask.triangulate(da.zeros((10, 3)))
    points = RANDOM.random((1000, 2))
    points[777] = np.nan
    with pytest.raises(ValueError, match="from row 750 on"):
        delone.dask.triangulate(da.from_array(points, chunks=(250, 2)), tiles=4)


def test_clouds_from_las():
    laspy = pytest.importorskip("laspy")
    path = str(Path(__file__).parents[3] / "data" / "autzen_trim.laz")
    cloud = laspy.read(path)
    ground = np.column_stack([cloud.x, cloud.y])[cloud.classification == 2]
    array = delone.dask.from_las([path, path], chunk=30_000, classes=[2])
    assert delone.dask.triangulate(array, tiles=7).fingerprint.compute() == expected(ground)
    assert delone.dask.from_las(path).shape == (len(cloud.points), 2)


def kill_once(block, path):
    """Ends the worker that comes here first."""
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return block
    os._exit(1)


@pytest.mark.filterwarnings("ignore")
def test_a_worker_that_dies_is_no_loss(tmp_path):
    points = RANDOM.random((50_000, 2))
    config = {"distributed.worker.daemon": False, "distributed.scheduler.allowed-failures": 5}
    with (
        dask.config.set(config),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster),
    ):
        array = da.from_array(points, chunks=(10_000, 2))
        assert delone.dask.triangulate(array, tiles=8).fingerprint.compute() == expected(points)
        # The cuts are made before; then a worker ends while others have done their part.
        made = delone.dask.triangulate(array, tiles=8)
        dying = dask.delayed(kill_once)(made.tiles[made.cuts.nodes[-1]], str(tmp_path / "killed"))
        total, tile = dask.compute(made.fingerprint, dying)
        assert total == expected(points)
        assert (tmp_path / "killed").exists() and len(tile.points) > 0


WORDS = np.array([["a", 0], [1, 0], [0, 1], [0, 0]], dtype=object)


@pytest.mark.parametrize("wrong", [WORDS, np.eye(4, 2) + 1j, np.eye(4, 2).astype(str)])
def test_arrays_of_no_numbers_are_refused_as_in_memory(wrong):
    with pytest.raises(TypeError, match="real numbers"):
        delone.dask.triangulate(da.from_array(wrong, chunks=(2, 2)), tiles=2)


def test_objects_that_are_numbers_are_taken_as_in_memory():
    points = RANDOM.random((500, 2))
    made = delone.dask.triangulate(da.from_array(points.astype(object), chunks=(100, 2)), tiles=2)
    assert made.fingerprint.compute() == expected(points)


def test_integers_that_are_no_floats_are_refused_as_in_memory():
    with pytest.raises(ValueError, match="2\\*\\*53"):
        delone.dask.triangulate(da.from_array(np.array([[2**53 + 1, 0], [1, 0], [0, 1]])), tiles=2)
