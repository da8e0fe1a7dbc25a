"""Ctrl-C in long calls, and handlers of signals that ask and change what they interrupt. Whatever hangs is a failure."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise")


def output_of(*command, seconds=600, **environment):
    """Runs a program; its lines."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore", **environment}
    done = subprocess.run([sys.executable, *command], env=environment, capture_output=True, text=True, timeout=seconds)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_all_long_calls_are_left_at_an_interruption():
    assert output_of(str(Path(__file__).with_name("long_calls.py")), RAYON_NUM_THREADS="1") == ["done"]


#: A triangulation, queries that take a while, and a handler that is called meanwhile.
BEGIN = """
import signal
import threading
import time
import numpy as np
import delone

points, more = np.random.default_rng(5).random((2, 30_000, 2))
d = delone.Delaunay(points)
calls = []

def during(work, handler, pause=0.05):
    "Calls a handler while work goes on, which is made longer until it is."
    signal.signal(signal.SIGALRM, lambda *_: calls.append(handler()))
    size = 1
    while not calls:
        signal.setitimer(signal.ITIMER_REAL, pause)
        result = work(size)
        signal.setitimer(signal.ITIMER_REAL, 0)
        size *= 2
    return result
"""


@pytest.fixture
def lines():
    """The lines that a program prints after the beginning."""
    return lambda program: output_of("-c", BEGIN + textwrap.dedent(program), seconds=200)


def test_a_handler_changes_what_is_asked(lines):
    program = """
        found = during(lambda size: d.find_simplex(np.resize(more, (size * 10**5, 2))), lambda: d.add_points([[2.0, 2.0]]))
        # By the old triangulation, all of it.
        whole = delone.Delaunay(points).find_simplex(more)
        print(bool((np.resize(whole, len(found)) == found).all()), len(calls), len(d.points) - len(points), d.nearest([2.0, 2.0]))
    """
    assert lines(program) == ["True 1 1 30000"]


def test_a_handler_asks_what_is_changed(lines):
    program = """
        lengths = [len(points)]

        def extend(size):
            d.add_points(np.resize(more, (size * 10**4, 2)) + np.arange(size * 10**4)[:, None] % 97)
            lengths.append(len(d.points))

        # Between two changes, or at the end of one.
        during(extend, lambda: len(d.points))
        print(calls[0] in lengths, int(d.find_simplex([0.5, 0.5])) >= 0)
    """
    assert lines(program) == ["True True"]


def test_a_handler_asks_while_a_change_waits_for_another_thread(lines):
    program = """
        queries = np.resize(more, (2 * 10**5, 2))
        stop = threading.Event()

        def ask():
            while not stop.is_set():
                d.find_simplex(queries)

        others = [threading.Thread(target=ask) for _ in range(2)]
        for thread in others:
            thread.start()
        for k in range(5):
            calls.clear()
            during(lambda _: d.add_points([[3.0 + k, 3.0]]), lambda: int(d.nearest([2.0, 2.0])), 0.01)
        stop.set()
        for thread in others:
            thread.join()
        print(d.nearest([[3.0 + k, 3.0] for k in range(5)]).min() >= len(points))
    """
    assert lines(program) == ["True"]


def test_a_handler_changes_while_a_change_waits(lines):
    program = """
        queries = np.resize(more, (10**6, 2))
        other = threading.Thread(target=d.find_simplex, args=[queries])
        other.start()
        during(lambda _: d.add_points([[2.0, 2.0]]), lambda: d.add_points([[4.0, 4.0]]), 0.01)
        other.join()
        made = delone.Delaunay(d.points)
        same = set(map(frozenset, d.simplices.tolist())) == set(map(frozenset, made.simplices.tolist()))
        print(same, len(d.points) > len(points) + 1)
    """
    assert lines(program) == ["True True"]


def test_two_threads_ask_for_the_first_time(lines):
    program = """
        many = np.random.default_rng(6).random((200_000, 2))
        for _ in range(3):
            d = delone.Delaunay(many)
            threads = [threading.Thread(target=d.find_simplex, args=[many[:50_000]]) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        print("done")
    """
    assert lines(program) == ["done"]
