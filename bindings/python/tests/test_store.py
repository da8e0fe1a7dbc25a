"""Folders of tiles: the triangles of all points, runs that go on, and the bytes of the program."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

import delone
import numpy as np
import pytest
from delone import tiles

SMALL = {"memory": "64M", "tile": 300, "workers": 2}


def survey(count=3000, seed=5):
    x, y = np.random.default_rng(seed).integers(0, 5000, (2, count))
    return np.column_stack([x, y, x % 7]).astype(float)


@pytest.fixture
def points(tmp_path):
    np.save(tmp_path / "points.npy", survey())
    return tmp_path / "points.npy"


def contents(folder):
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def edges(xy, triangles):
    return {tuple(sorted(map(tuple, xy[row]))) for row in triangles}


def test_tiles_are_the_triangulation_of_all(tmp_path, points):
    store = tiles.build(points, tmp_path / "tiles", heights=True, **SMALL)
    all_ = survey()
    tri = delone.Delaunay(all_[:, :2])
    summary = store.summary
    assert summary.fingerprint == tiles.fingerprint(all_[:, :2], tri.simplices)
    assert summary.points == 3000 and summary.vertices + summary.duplicates == 3000 and summary.triangles == len(tri.simplices)
    store.verify()
    again = tiles.open(tmp_path / "tiles")
    assert again.summary == summary and again.has_heights and again.folder == tmp_path / "tiles"
    assert "5" in repr(again) and len(again.cuts) > 5
    known = {tuple(row) for row in all_.tolist()}
    total = 0
    for node in again.cuts.nodes:
        rows, triangles = again.points(node), again.triangles(node)
        assert {tuple(row) for row in rows.tolist()} <= known
        assert len(triangles) == 0 or triangles.max() < len(rows)
        total += len(triangles)
    assert total == summary.triangles - summary.of_seams
    at, shown = again.window()
    assert edges(at[:, :2], shown) == edges(all_[:, :2], tri.simplices)
    box = (1000, 1000, 2000, 1500)
    at, shown = again.window(box)
    corners = at[shown][:, :, :2]
    low, high = corners.min(axis=1), corners.max(axis=1)
    assert ((low <= box[2:]) & (high >= box[:2])).all() and 100 < len(shown) < 1000
    assert edges(at[:, :2], shown) <= edges(all_[:, :2], tri.simplices)
    assert 200 < len(again.overview(300)) < 600
    places = np.random.default_rng(1).random((500, 2)) * 6000 - 500
    names = again.locate(places)
    outside = (names == 2**64 - 1).all(axis=1)
    assert np.array_equal(outside, tri.find_simplex(places) < 0) and 50 < outside.sum() < 450
    rows = {node: again.points(node)[:, :2] for node in again.cuts.nodes}
    for place, found in zip(places[~outside], names[~outside].tolist(), strict=True):
        a, b, c = (rows[name >> 32][name & 0xFFFFFFFF] for name in found)
        for p, q in ((a, b), (b, c), (c, a)):
            (x, y), (u, v) = q - p, place - p
            assert x * v - y * u >= -1e-6


def test_a_killed_run_goes_on(tmp_path, points):
    whole = tiles.build(points, tmp_path / "whole", neighbors=True, **SMALL)
    program = f"""
        import sys, threading, os, time
        from delone import tiles
        threading.Thread(target=lambda: (time.sleep(float(sys.argv[1])), os._exit(9)), daemon=True).start()
        tiles.build({str(points)!r}, {str(tmp_path / "parts")!r}, neighbors=True, resume=True, memory="64M", tile=300, workers=2)
    """
    for pause in (0.0, 0.005, 0.02, 0.04):
        subprocess.run([sys.executable, "-c", textwrap.dedent(program), str(pause)], check=False)
    made = tiles.build(points, tmp_path / "parts", neighbors=True, resume=True, **SMALL)
    assert made.summary == whole.summary
    assert contents(tmp_path / "whole") == contents(tmp_path / "parts")


@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise")
def test_an_interruption_ends_a_run(tmp_path):
    np.save(tmp_path / "points.npy", survey(400_000))
    program = f"""
        import signal, threading, time
        from delone import tiles
        threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
        try:
            tiles.build({str(tmp_path / "points.npy")!r}, {str(tmp_path / "a")!r}, memory="64M", tile=2000)
        except KeyboardInterrupt:
            print("left")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=600)
    assert done.stdout == "left\n", done.stderr
    tiles.build(tmp_path / "points.npy", tmp_path / "a", memory="64M", tile=2000, resume=True).verify()


def test_refusals(tmp_path, points):
    tiles.build(points, tmp_path / "a", **SMALL)
    (tmp_path / "other.csv").write_text("0,0\n1,1\n")
    refusals = [
        (ValueError, "has tiles already", (points, tmp_path / "a"), SMALL),
        (ValueError, "is not empty", (points, tmp_path), SMALL),
        (ValueError, "heights are others", (points, tmp_path / "a"), {**SMALL, "resume": True, "heights": True}),
        (ValueError, "another one", (tmp_path / "other.csv", tmp_path / "a"), {**SMALL, "resume": True}),
        (ValueError, "1M is not enough", (points, tmp_path / "b"), {"memory": "1M"}),
        (ValueError, "memory must be a number", (points, tmp_path / "b"), {"memory": "much"}),
        (ValueError, "at least one point", (points, tmp_path / "b"), {"tile": 0}),
        (ValueError, "it has no heights", (tmp_path / "other.csv", tmp_path / "c"), {**SMALL, "heights": True}),
        (FileNotFoundError, "nowhere", (tmp_path / "nowhere.npy", tmp_path / "b"), SMALL),
        (ValueError, "no format", (tmp_path / "points.unknown", tmp_path / "b"), SMALL),
    ]
    for kind, words, given, how in refusals:
        with pytest.raises(kind, match=words):
            tiles.build(*given, **how)
    with pytest.raises(FileNotFoundError, match=r"without tiles\.json"):
        tiles.open(tmp_path)
    store = tiles.open(tmp_path / "a")
    with pytest.raises(ValueError, match="is no tile"):
        store.points(1)
    with pytest.raises(ValueError, match="a box is"):
        store.window((0, 0, -1, 1))
    name = next((tmp_path / "a").glob("triangles-*"))
    name.write_bytes(name.read_bytes()[:-4] + b"\0\0\0\0")
    with pytest.raises(ValueError, match=name.name):
        store.verify()


@pytest.mark.parametrize("method", ["linear", "natural", "laplace", "nearest"])
def test_models_of_tiles_are_those_of_memory(tmp_path, points, method):
    how = {"cell": 50.0, "method": method, "max_edge_anywhere": 400.0, "clip": [[100, 100], [4000, 300], [2000, 4500]]}
    heights, transform = delone.dtm(points, **how)
    in_tiles, where = delone.dtm(points, memory="64M", **how)
    assert where == transform and np.array_equal(heights, in_tiles, equal_nan=True)
    delone.dtm(points, output=tmp_path / "a.tif", **how)
    delone.dtm(points, output=tmp_path / "b.tif", memory="64M", **how)
    assert (tmp_path / "a.tif").read_bytes() == (tmp_path / "b.tif").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.tif", "b.tif", "points.npy"]


def test_models_of_tiles_have_limits(tmp_path, points):
    for words, how in [
        ("needs all triangles in memory", {"method": "smooth"}),
        ("needs all triangles in memory", {"max_edge": 3.0}),
        ("needs all triangles in memory", {"output": tmp_path / "a.geojson"}),
        ("without breaklines", {"breaklines": [[0, 0], [1, 1]]}),
        ("is not enough", {"memory": 1000}),
    ]:
        with pytest.raises(ValueError, match=words):
            delone.dtm(points, **{"cell": 50.0, "memory": "64M", **how})
    with pytest.raises(ValueError, match="points of files"):
        delone.dtm(survey(100), memory="64M")


@pytest.mark.skipif("DELONE" not in os.environ, reason="the program is named by DELONE")
def test_bytes_are_those_of_the_program(tmp_path, points):
    line = "-q tiles points.npy -o theirs --memory 64M --tile 300 --workers 2 --heights --neighbors"
    subprocess.run([os.environ["DELONE"], *line.split()], cwd=tmp_path, check=True)
    tiles.build(points, tmp_path / "ours", heights=True, neighbors=True, **SMALL)
    assert contents(tmp_path / "ours") == contents(tmp_path / "theirs")
    assert json.loads((tmp_path / "ours" / "tiles.json").read_text())["stage"] == "done"
    # Each goes on where the other has stopped.
    tiles.build(points, tmp_path / "theirs", heights=True, resume=True, **SMALL)
    subprocess.run([os.environ["DELONE"], "-q", "check", "ours"], cwd=tmp_path, check=True)
