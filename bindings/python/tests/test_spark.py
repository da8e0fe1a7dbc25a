import shutil

import delone
import numpy as np
import pytest

pyspark = pytest.importorskip("pyspark")
pd = pytest.importorskip("pandas")
if shutil.which("java") is None:
    pytest.skip("Spark needs Java", allow_module_level=True)

import delone.spark  # noqa: E402

RANDOM = np.random.default_rng(5)
pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def session():
    settings = pyspark.sql.SparkSession.builder.master("local[2]").config("spark.ui.enabled", "false")
    made = settings.getOrCreate()
    made.sparkContext.setLogLevel("OFF")
    yield made
    made.stop()


@pytest.mark.parametrize("count", [1, 5, 40])
def test_tiles_give_what_memory_gives(session, count):
    grid = np.stack(np.meshgrid(np.arange(50.0), np.arange(50.0)), axis=-1).reshape(-1, 2)
    for points in [RANDOM.random((3000, 2)), np.concatenate([grid, grid[::3]])]:
        frame = session.createDataFrame(pd.DataFrame({"number": np.arange(len(points)), "e": points[:, 0], "n": points[:, 1]}))
        made = delone.spark.triangulate(frame, count, x="e", y="n", id="number")
        expected = delone.tiles.fingerprint(points, delone.Delaunay(points).simplices)
        assert made.fingerprint() == expected
        # Not the usual 200 a level.
        assert made.parts.rdd.getNumPartitions() <= 2 * len(made.cuts)
        assert delone.tiles.fingerprint(points, made.triangles.toPandas().to_numpy()) == expected


def test_what_cannot_be_is_refused(session):
    frame = session.createDataFrame(pd.DataFrame({"id": [0, 1], "x": [0.0, np.inf], "y": [1.0, 2.0]}))
    with pytest.raises(ValueError, match="not finite"):
        delone.spark.triangulate(frame, 2)
    frame = session.createDataFrame(pd.DataFrame({"id": [0, -1], "x": [0.0, 3.0], "y": [1.0, 2.0]}))
    with pytest.raises(Exception, match="negative"):
        delone.spark.triangulate(frame, 1).fingerprint()
