#!/usr/bin/env bash
# Tiles beside the construction in memory: processor time, wall time and peak memory, and whether the triangles are the same.
#
#   docs/tiles.sh                     ten million points of each set
#   docs/tiles.sh 1e6                 a million
#   docs/tiles.sh 1e8 512M uniform    one set, and the memory that tiles may take
#
# Both read the same file. The table goes to standard output; files go to a temporary folder of the size of eight times the points.
set -euo pipefail
cd "$(dirname "$0")/.."
size=${1:-1e7} memory=${2:-256M} kinds=${3:-uniform clusters lognormal grid utm duplicates lidar dense-patch}
cargo build --release --quiet
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 - "$PWD/target/release/delone" "$work" "$size" "$memory" $kinds <<'PYTHON'
import json, os, shutil, subprocess, sys, time

program, work, size, memory, *kinds = sys.argv[1:]
program = os.environ.get("CARGO_TARGET_DIR", os.path.dirname(os.path.dirname(program))) + "/release/delone"


def run(*arguments):
    """What a command answers; processor seconds, wall seconds, peak megabytes."""
    start = time.time()
    child = subprocess.Popen([program, "-q", *arguments], stdout=subprocess.PIPE, text=True)
    answer = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    assert status == 0, arguments
    return answer, (usage.ru_utime + usage.ru_stime, time.time() - start, usage.ru_maxrss / 1024)


print(f"| {size} points | in memory: processor, wall, peak | tiles, `--memory {memory}`: processor, wall, peak | tiles | borders |")
print("| --- | --- | --- | --- | --- |")
for kind in kinds:
    points, folder = f"{work}/points.npy", f"{work}/tiles"
    run("generate", kind, "-n", size, "--seed", "1", "-o", points)
    text, whole = run("triangulate", points, "--fingerprint")
    _, tiles = run("tiles", points, "-o", folder, "--memory", memory, "--stats", f"{work}/stats.json")
    stats = json.load(open(f"{work}/stats.json"))
    assert stats["fingerprint"] == text.strip(), f"{kind}: other triangles"
    share = 100 * stats["border"] / max(stats["points"], 1)
    times = [f"{cpu:.1f} s, {wall:.1f} s, {peak:,.0f} MB" for cpu, wall, peak in (whole, tiles)]
    print(f"| {kind} | {times[0]} | {times[1]} | {stats['tiles']} | {share:.2f} % |", flush=True)
    shutil.rmtree(folder)
PYTHON
