#!/usr/bin/env bash
# Writes docs/performance.md: figures of the machine that runs it. `bash docs/performance.sh [POINTS]`, about twenty minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
points=${1:-1000000}
compare() {
    echo '```'
    cargo run --release --quiet --manifest-path compare/Cargo.toml -- "$@"
    echo '```'
}
cargo build --release --quiet --manifest-path compare/Cargo.toml
page=$(mktemp)
trap 'rm -f "$page"' EXIT
{
    cat <<'TEXT'
# Performance

Made by `bash docs/performance.sh`; run it on your machine, these are figures of another. Every engine gets the same points, in
turns, and the least of its times counts. Results are judged exactly; wrong ones are shown as wrong. Ratios are to Delone
on one thread.
TEXT
    echo
    model=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo 2>/dev/null | head -1)
    echo "- Machine: ${model:-unknown}, $(nproc) cores"
    echo "- $(rustc --version), $(date -u +%Y-%m-%d)"
    echo "- $points points, where nothing else is said"
    echo "- Load of the machine at the start: $(cut -d' ' -f1-2 /proc/loadavg 2>/dev/null || echo unknown); with more than 0 the ratios hold, the"
    echo "  times are too long, and threads gain less than they could"
    printf '\n## Bulk construction in the plane\n\n'
    compare --size "$points" --runs 3
    printf '\n## One by one: insertion, location, nearest vertex, removal\n\n'
    compare --changes --size $((points / 4)) --runs 2 --kinds uniform,clusters
    printf '\n## Space\n\n'
    compare --space cube,sphere --size $((points / 10)) --runs 2
    printf '\n## Segments: constrained triangulations\n\n'
    compare --constrained --size "$points" --runs 3
    printf '\n## Polygons: the triangles inside, many polygons of the same size\n\n'
    compare --polygons --size $((points / 10)) --runs 3
    printf '\n## Meshes without small angles: refinement\n\n'
    echo "Triangle takes part where TRIANGLE_PYTHON is a Python that has it (\`pip install triangle numpy\`): its licence is not free."
    echo
    compare --mesh --size "$points" --runs 3
    printf '\n## Voronoi cells\n\n'
    compare --voronoi --size $((points / 10)) --runs 2 --kinds uniform,grid
    printf '\n## Voronoi cells in space\n\n'
    compare --cells3 --size $((points / 10)) --runs 2
    compare --periodic --size 10000,$((points / 10)) --runs 2
    printf '\n## Weights: regular triangulations, in the plane and in space\n\n'
    compare --weights --size $((points / 10)) --runs 3
    printf '\n## Proximity graphs, beside the construction that they are made from\n\n'
    compare --graphs --size "$points" --runs 3
    printf '\n## Surfaces: a cell of a raster beyond the triangulation\n\n'
    compare --surface --size "$points" --runs 3 --kinds uniform,clusters,lidar
    printf '\n## Convex hulls in space\n\n'
    compare --hull --size $((points / 10)) --runs 2
} >"$page"
mv "$page" docs/performance.md
chmod 644 docs/performance.md
trap - EXIT
bash docs/chart.sh
