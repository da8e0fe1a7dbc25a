import pickle

import delone
import numpy as np
import pytest
from delone import tiles

RANDOM = np.random.default_rng(11)


def sets():
    grid = np.stack(np.meshgrid(np.arange(60.0), np.arange(60.0)), axis=-1).reshape(-1, 2)
    angle = np.linspace(0, 2 * np.pi, 500)
    yield "uniform", RANDOM.random((5000, 2))
    yield "grid", grid
    yield "twice", np.concatenate([grid, grid])
    yield "circle", np.column_stack([np.cos(angle), np.sin(angle)])
    yield "line", np.column_stack([np.arange(300.0), np.arange(300.0)])
    yield "equal", np.ones((100, 2))
    yield "huge and tiny", RANDOM.random((300, 2)) * 10.0 ** RANDOM.integers(-300, 300, (300, 1))
    yield "none", np.empty((0, 2))


def in_tiles(points, count, levels=32):
    cuts = tiles.Cuts(points, count)
    own = cuts.tile_of(points)
    found, borders, total = [], {}, tiles.Fingerprint()
    for node in cuts.nodes:
        rows = np.flatnonzero(own == node)
        tile = tiles.triangulate(points[rows], cuts.region(node), ids=rows)
        assert np.array_equal(tile.points, points[rows][tile.order])
        found.append(rows[tile.order][tile.triangles.astype(int)])
        borders[node] = pickle.loads(pickle.dumps(tile.border))
        total += tile.fingerprint

    def border(node):
        nonlocal total
        if node in borders:
            return borders[node]
        seam = tiles.join([border(part) for part in cuts.parts(node, levels)], cuts.region(node))
        found.append(seam.triangles.astype(int))
        total += seam.fingerprint
        return seam.border

    assert len(border(1).open) == 0 or len(cuts) == 1
    return np.concatenate([np.empty((0, 3), int), *found]), total


@pytest.mark.parametrize(("name", "points"), list(sets()), ids=[name for name, _ in sets()])
def test_tiles_give_what_memory_gives(name, points):
    expected = delone.Delaunay(points).simplices if len(points) else np.empty((0, 3), int)
    canonical = {tuple(sorted(map(tuple, points[row]))) for row in expected}
    for count, levels in [(1, 32), (2, 1), (7, 2), (16, 4)]:
        found, total = in_tiles(points, count, levels)
        assert total == tiles.fingerprint(points, expected), name
        assert total.count == len(expected)
        assert {tuple(sorted(map(tuple, points[row]))) for row in found} == canonical


def test_all_of_it_pickles():
    cuts = tiles.Cuts(RANDOM.random((1000, 2)), 5)
    again = pickle.loads(pickle.dumps(cuts))
    assert (again.cuts, again.nodes, len(again)) == (cuts.cuts, cuts.nodes, 5)
    assert all(again.region(node) == cuts.region(node) for node in cuts.nodes)
    tile = tiles.triangulate(RANDOM.random((100, 2)), node=7)
    copy = pickle.loads(pickle.dumps(tile))
    assert copy.fingerprint == tile.fingerprint and hash(copy.fingerprint) == hash(tile.fingerprint)
    assert np.array_equal(copy.border.points, tile.border.points)
    assert (tile.border.ids >> 32 == 7).all() and len(tile.border) == len(tile.border.ids)
    assert str(tiles.Fingerprint(str(tile.fingerprint))) == str(tile.fingerprint)


def test_a_window_says_what_it_waits_for():
    points = RANDOM.random((10_000, 2))
    window = ((0.4, 0.4), (0.5, 0.5))
    margin = 0.0
    while True:
        region = ((0.4 - margin, 0.4 - margin), (0.5 + margin, 0.5 + margin))
        inside = points[((points >= region[0]) & (points < region[1])).all(axis=1)]
        boxes = tiles.triangulate(inside, region).border.open_in(region, window)
        if not boxes:
            break
        assert all(len(box) == 2 for box in boxes)
        margin += 0.01
    assert 0 < margin < 0.1


def test_what_cannot_be_is_refused():
    points = RANDOM.random((100, 2))
    region = ((0.0, 0.0), (0.5, 0.5))
    with pytest.raises(ValueError, match="not in the region"):
        tiles.triangulate(points, region)
    with pytest.raises(ValueError, match="ids must have the shape"):
        tiles.triangulate(points, ids=[1, 2])
    with pytest.raises(ValueError, match="negative"):
        tiles.triangulate(points, ids=-np.arange(100))
    with pytest.raises(TypeError, match="integers"):
        tiles.triangulate(points, ids=np.linspace(0, 1, 100))
    with pytest.raises(ValueError, match="corner of a box"):
        tiles.triangulate(points, (0.0, 1.0))
    with pytest.raises(ValueError, match="NaN"):
        tiles.triangulate(points, ((np.nan, 0), (1, 1)))
    with pytest.raises(ValueError, match="not finite"):
        tiles.triangulate([[0, np.inf]])
    with pytest.raises(ValueError, match="numbered from 1"):
        tiles.triangulate(points, node=0)
    with pytest.raises(ValueError, match="at least 1"):
        tiles.Cuts(points, 0)
    with pytest.raises(ValueError, match="no tile"):
        tiles.Cuts.from_cuts([(2, 0, 0.5)])
    border = tiles.triangulate(points).border
    with pytest.raises(ValueError, match="border 1"):
        tiles.join([border, border])
    data = bytearray(border.to_bytes())
    data[50] ^= 1
    with pytest.raises(ValueError, match=r"changed|damaged|sum"):
        tiles.Border.from_bytes(bytes(data))
    with pytest.raises(ValueError, match="hexadecimal"):
        tiles.Fingerprint("xyz")
    with pytest.raises(ValueError, match="no points"):
        tiles.fingerprint(points, [[0, 1, 100]])
