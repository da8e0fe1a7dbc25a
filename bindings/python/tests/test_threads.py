"""Threads that ask and change one object, and states that were damaged on the way."""

import os
import pickle
import signal
import threading
import time

import delone
import numpy as np
import pytest

N = 5_000


def together(*works):
    """Does all at once; the first error of any."""
    errors = []

    def told(work):
        try:
            work()
        except BaseException as error:
            errors.append(error)

    threads = [threading.Thread(target=told, args=(work,)) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]


@pytest.mark.parametrize("ndim", [2, 3])
def test_a_change_waits_for_those_who_ask(ndim):
    rng = np.random.default_rng(1)
    points, more, queries = (rng.random((n, ndim)) for n in (N, 40, 4 * N))
    d = delone.Delaunay(points, incremental=True)
    asked = []

    def ask():
        while len(d.points) < N + len(more):
            asked.append((d.find_simplex(queries) >= 0).mean())
            d.nearest(queries[:100])

    def change():
        for p in more:
            d.add_points([p])

    together(ask, ask, change)
    assert asked and min(asked) > 0.9
    made = delone.Delaunay(np.concatenate([points, more]))
    assert set(map(frozenset, d.simplices)) == set(map(frozenset, made.simplices))


def test_a_constrained_triangulation_and_weights_are_changed_while_others_ask():
    rng = np.random.default_rng(2)
    points, queries = rng.random((N, 2)), rng.random((4 * N, 2))
    c, r = delone.ConstrainedDelaunay(points), delone.RegularTriangulation(points, np.zeros(N))
    done = threading.Event()

    def ask():
        while not done.is_set():
            c.find_simplex(queries)
            r.nearest(queries)

    def change():
        try:
            for k, (v, w, _) in enumerate(c.simplices[:600:30].tolist()):
                c.insert_segment(v, w)
                r.set_weights(np.full(N, float(k)))
        finally:
            done.set()

    together(ask, ask, change)
    assert len(c.segments) == 20


LONG = {
    "find_simplex": lambda p, n: delone.Delaunay(p).find_simplex(again(p, 40 * n)),
    "k_nearest": lambda p, n: delone.Delaunay(p).k_nearest(again(p, n // 8), 300),
    "neighbors": lambda p, n: delone.Neighbors(p).k_nearest(again(p, n), 300),
    "natural neighbors": lambda p, n: delone.NaturalNeighborInterpolator(p, p[:, 0])(again(p, 4 * n)),
    "smooth": lambda p, n: delone.NaturalNeighborInterpolator(p, p[:, 0], method="smooth")(again(p, 2 * n)),
}


def again(points, count):
    """So many queries, a little off the points."""
    return np.resize(0.999 * points, (count, 2))


@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise")
@pytest.mark.parametrize("name", LONG)
def test_many_queries_end_at_an_interruption(name):
    points = np.random.default_rng(4).random((N, 2))
    n = 1000
    took = 0.0
    while took < 2.0:
        n *= 2
        began = time.perf_counter()
        LONG[name](points, n)
        took = time.perf_counter() - began
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    began = time.perf_counter()
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            LONG[name](points, 4 * n)
        # It would have been eight seconds.
        assert time.perf_counter() - began < 2 * took
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


MADE = {
    "delaunay": lambda p: delone.Delaunay(p),
    "removed": lambda p: removed(p),
    "space": lambda p: delone.Delaunay(np.c_[p, p[:, 0] * p[:, 1]]),
    "constrained": lambda p: delone.ConstrainedDelaunay(p, [[0, 1], [2, 3]], crossings="split"),
    "mesh": lambda p: delone.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]], max_area=0.1),
    "neighbors": lambda p: delone.Neighbors(p),
}


def removed(points):
    d = delone.Delaunay(points)
    d.remove([3, 7])
    return d


def damaged(state):
    """States with one thing gone or another thing in its place."""
    others = [
        None,
        "x",
        -1,
        1e300,
        b"",
        [],
        {},
        [[1]],
        np.zeros(3),
        np.full((2, 2), np.nan),
        np.zeros((3, 5)),
        [10**30],
        [[0, 10**9]],
    ]
    if isinstance(state, dict):
        for name in state:
            yield {key: value for key, value in state.items() if key != name}
            for other in others:
                yield {**state, name: other}
    else:
        for k in range(len(state)):
            yield state[:k] + state[k + 1 :]
            for other in others:
                yield (*state[:k], other, *state[k + 1 :])
    yield from others


@pytest.mark.parametrize("name", MADE)
def test_a_damaged_state_is_an_error_of_pickle(name):
    made = MADE[name](np.random.default_rng(3).random((20, 2)))
    again = pickle.loads(pickle.dumps(made))
    assert np.array_equal(again.points, made.points)
    refused = 0
    for state in damaged(made.__getstate__()):
        empty = type(made).__new__(type(made))
        try:
            empty.__setstate__(state)
        except (pickle.UnpicklingError, MemoryError) as error:
            refused += 1
            assert str(error)
    assert refused >= 8
