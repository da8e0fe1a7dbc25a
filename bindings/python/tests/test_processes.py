"""Forked and spawned processes, numbers of threads, signals and memory. Whatever hangs is a failure."""

import importlib.util
import os
import subprocess
import sys
import textwrap

import pytest

#: The hash of triangulations that are large enough for threads, in a file that new processes can import.
WORK = """
import hashlib
import os
import numpy as np
import delone

def points(n, ndim):
    return np.random.default_rng(n).random((n, ndim))

def work(n):
    "Asks for everything that has threads."
    digest = hashlib.sha256()
    for ndim in (2, 3):
        tri = delone.Delaunay(points(n, ndim))
        digest.update(tri.simplices.tobytes())
        queries = points(3 * n // 4, ndim)
        digest.update(tri.find_simplex(queries).tobytes())
        digest.update(tri.nearest(queries[:1]).tobytes())
        digest.update(tri.k_nearest(queries[:5000], 2).tobytes())
        tri.add_points(queries[:100] + 1)
        tri.remove([0, 5])
        tri.find_simplex(queries[0])
        digest.update(tri.simplices.tobytes())
        digest.update(delone.ConvexHull(tri.points).simplices.tobytes())
        hints = delone.Hints(points(n // 4, ndim))
        digest.update(hints.triangulate(points(n // 4, ndim) + 1e-3).simplices.tobytes())
    delone.Voronoi(points(n // 2, 2)).cells()
    given = points(n, 2)
    edges = delone.Delaunay(given).edges[::5]
    tri = delone.ConstrainedDelaunay(given, edges, fill="even-odd")
    tri.insert([2.0, 2.0])
    tri.remove_segment(0)
    tri.check()
    digest.update(tri.triangles.tobytes() + tri.find_simplex(points(n // 2, 2)).tobytes())
    digest.update(tri.sees(np.arange(n // 2), np.arange(n // 2) + 1).tobytes())
    triangles = given[: n // 3 * 3].reshape(-1, 3, 2)
    digest.update(delone.triangulate_polygons(triangles, ragged=True).triangles.tobytes())
    wild = np.arange(2 * min(n, 600)).reshape(-1, 2)
    tri = delone.ConstrainedDelaunay(points(2 * min(n, 600), 2), wild, crossings="split")
    digest.update(tri.points.tobytes())
    return digest.hexdigest()
"""

N = 50_000


@pytest.fixture
def run(tmp_path):
    """Runs a program beside `work.py`; its output. With a time limit."""
    (tmp_path / "work.py").write_text(WORK)

    def run(program, seconds=120, **environment):
        (tmp_path / "program.py").write_text(textwrap.dedent(program))
        done = subprocess.run(
            [sys.executable, "program.py"],
            cwd=tmp_path,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore", **environment},
            capture_output=True,
            text=True,
            timeout=seconds,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.split()

    return run


needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")


@needs_fork
@pytest.mark.parametrize("before", [100, N])
def test_a_forked_child_has_threads_of_its_own(run, before):
    program = f"""
        import os, sys
        from work import work
        work({before})
        expected = work({N}) if {before} == {N} else None
        sys.stdout.flush()
        for generation in range(3):
            child = os.fork()
            if child:
                break
        # The deepest first: all have other threads, or none left, above them.
        status = os.waitpid(child, 0)[1] if child else 0
        print(work({N}), flush=True)
        os._exit(os.waitstatus_to_exitcode(status))
    """
    answers = run(program)
    assert len(answers) == 4 and len(set(answers)) == 1


@needs_fork
def test_a_fork_while_other_threads_are_at_work(run):
    program = """
        import os, sys, threading, time
        import delone
        from work import points, work
        given = points(50_000, 2)
        threading.Thread(target=work, args=[200_000], daemon=True).start()
        # The first of these may meet the pool as it is made.
        for pause in (0, 0.001, 0.01, 0.1):
            time.sleep(pause)
            child = os.fork()
            if not child:
                print(len(delone.Delaunay(given).simplices), flush=True)
                os._exit(0)
            os.waitpid(child, 0)
        sys.stdout.flush()
        os._exit(0)
    """
    answers = run(program)
    assert len(answers) == 4 and len(set(answers)) == 1


@needs_fork
@pytest.mark.parametrize("ndim", [2, 3])
def test_a_fork_while_another_thread_asks_for_the_first_time(run, ndim):
    program = f"""
        import os, sys, threading, time
        import delone
        from work import points
        given = points(300_000, {ndim})
        whole = delone.Delaunay(given)
        for pause in (0, 0.002, 0.005, 0.01, 0.02, 0.1):
            tri = whole.copy()
            other = threading.Thread(target=tri.find_simplex, args=[given[:20_000]])
            other.start()
            time.sleep(pause)
            child = os.fork()
            if not child:
                try:
                    found = tri.nearest(given[:1])
                except RuntimeError as error:
                    found = tri.copy().nearest(given[:1])
                print(*found, flush=True)
                os._exit(0)
            os.waitpid(child, 0)
            other.join()
    """
    assert run(program) == ["0"] * 6


@needs_fork
def test_a_fork_in_a_handler_of_signals(run):
    program = """
        import os, signal, sys
        import delone
        from work import points
        def handler(number, frame):
            if not os.fork():
                return
            os.wait()
        signal.signal(signal.SIGALRM, handler)
        given = points(1_000_000, 3)
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        try:
            delone.Delaunay(given)
        except RuntimeError as error:
            print("child", flush=True)
            os._exit(0)
        print("parent", flush=True)
    """
    answers = run(program)
    # Before and after the work there is nothing to wait for.
    assert answers in (["child", "parent"], ["parent", "parent"])


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
@pytest.mark.parametrize("how", ["pool", "executor"])
def test_processes_of_python(run, method, how):
    import multiprocessing

    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {method} here")
    program = f"""
        import multiprocessing
        from concurrent.futures import ProcessPoolExecutor
        from work import work
        if __name__ == "__main__":
            print(work({N}))
            context = multiprocessing.get_context("{method}")
            if "{how}" == "pool":
                with context.Pool(2) as pool:
                    print(*pool.map(work, [{N}] * 2))
            else:
                with ProcessPoolExecutor(2, mp_context=context) as pool:
                    print(*pool.map(work, [{N}] * 2))
    """
    answers = run(program)
    assert len(answers) == 3 and len(set(answers)) == 1


@pytest.mark.skipif(importlib.util.find_spec("joblib") is None, reason="no joblib here")
@pytest.mark.parametrize("backend", ["loky", "multiprocessing", "threading"])
def test_joblib(run, backend):
    program = f"""
        from joblib import Parallel, delayed
        from work import work
        if __name__ == "__main__":
            print(work({N}))
            print(*Parallel(2, backend="{backend}")(delayed(work)({N}) for _ in range(2)))
    """
    answers = run(program)
    assert len(answers) == 3 and len(set(answers)) == 1


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="no /proc here")
def test_there_are_as_many_threads_as_asked_for(run):
    program = f"""
        import os
        from work import work
        before = len(os.listdir("/proc/self/task"))
        work(100)
        # Little work starts none.
        print(len(os.listdir("/proc/self/task")) - before)
        work(19_000)
        answer = work({N})
        names = [open(f"/proc/self/task/{{task}}/comm").read().strip() for task in os.listdir("/proc/self/task")]
        # And none but these, or there would be a second pool, which nobody makes anew.
        print(len(names) - before, sum(name.startswith("delone-") for name in names), answer)
    """
    answers = {threads: run(program, RAYON_NUM_THREADS=threads) for threads in ("1", "3")}
    assert answers["1"][:3] == ["0", "1", "1"] and answers["3"][:3] == ["0", "3", "3"]
    assert answers["1"][3] == answers["3"][3]


def test_the_variable_is_limited(run):
    program = """
        import os
        import delone
        from work import points
        delone.Delaunay(points(50_000, 2))
        print(len(os.listdir("/proc/self/task")))
    """
    if not os.path.exists("/proc/self/task"):
        pytest.skip("nothing tells the number of threads here")
    # This one, and whatever numpy has.
    assert int(run(program, RAYON_NUM_THREADS="4000")[0]) <= max(16, 4 * os.cpu_count()) + 8


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a limit of Linux")
def test_no_thread_to_be_had(run):
    program = """
        import os
        import resource
        import threading
        import work
        if os.environ["ALONE"] == "1":
            # What is imported late may be where another user finds nothing.
            work.work(100)
            if os.getuid() == 0:
                # No limit holds root.
                os.setgroups([])
                os.setgid(65534)
                os.setuid(65534)
            resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
            try:
                threading.Thread(target=int).start()
            except RuntimeError:
                print("alone")
        print(work.work(20_000), work.work(20_000))
        print(len(os.listdir("/proc/self/task")))
    """
    first, second, _ = run(program, ALONE="0")
    assert run(program, ALONE="1") == ["alone", first, second, "1"]


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc here")
@pytest.mark.parametrize("what", ["Delaunay", "ConvexHull", "Hints", "add_points", "ConstrainedDelaunay"])
@pytest.mark.parametrize("ndim", [2, 3])
def test_no_memory_is_an_error_of_python(run, what, ndim):
    if what == "ConstrainedDelaunay" and ndim == 3:
        pytest.skip("for the plane")
    program = f"""
        import resource
        import numpy as np
        import delone
        tri = delone.Delaunay(np.zeros((1, {ndim})))
        # Pages that were never touched take no memory, only addresses.
        many = np.zeros((12_000_000, {ndim}))
        used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
        copies = 3 if "{what}" == "add_points" else 2
        resource.setrlimit(resource.RLIMIT_AS, (used + copies * many.nbytes + (400 << 20),) * 2)
        try:
            tri.add_points(many) if "{what}" == "add_points" else delone.{what}(many)
        except MemoryError as error:
            print("MemoryError", "need about" in str(error))
        assert len(delone.Delaunay(many[:1]).points) == 1
    """
    assert run(program, RAYON_NUM_THREADS="1") == ["MemoryError", "True"]


def test_work_goes_on_after_an_interruption(run):
    program = """
        import os, signal, threading
        import delone
        from work import points
        signal.signal(signal.SIGINT, signal.default_int_handler)
        given, few = points(1_500_000, 3), points(50_000, 2)
        for make in (delone.Delaunay, delone.Hints):
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            try:
                for _ in range(20):
                    make(given)
            except KeyboardInterrupt:
                print("interrupted")
        print(len(delone.Delaunay(few).simplices) == 2 * len(few) - 2 - len(delone.ConvexHull(few).simplices))
    """
    assert run(program) == ["interrupted", "interrupted", "True"]
