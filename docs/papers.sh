#!/usr/bin/env bash
# Every number of docs/papers.md and docs/experiments.md: runs all experiments and leaves their tables and plots in a folder.
# What is interrupted leaves the rows that it has, in NAME.part.csv. The counts of small sets are those of docs/results, as
# .ci/counts shows.
#
#   docs/papers.sh                    the committed results (docs/results), an hour on two cores
#   docs/papers.sh FOLDER small       the smallest sizes, a minute
#   docs/papers.sh FOLDER long        up to a hundred million points, hours, 24 GB
#
# Then: BLESS=1 cargo test -p delone-experiments --test page
set -euo pipefail
# The folder is the caller's.
folder=${1:+$(realpath -m "$1")}
folder=${folder:-docs/results}
cd "$(dirname "$0")/.."
size=${2:-usual}
case $size in
small | usual | long) ;;
*)
    echo "papers.sh: there is no size $size: small, usual or long" >&2
    exit 2
    ;;
esac
mkdir -p "$folder"
# Programs that are there already may be named.
delone=${DELONE:-} lab=${LAB:-}
if [ -z "$delone" ] || [ -z "$lab" ]; then
    cargo build --release -q -p delone-cli -p delone-lab
    built=${CARGO_TARGET_DIR:-target}/release
    delone=${delone:-$built/delone} lab=${lab:-$built/delone-lab}
fi

# Name, and the largest set of each size.
experiment() {
    local name=$1 small=$2 usual=$3 long=$4
    shift 4
    local largest=${!size}
    echo "== $name up to $largest"
    $lab -q experiment "$name" "$@" --largest "$largest" -o "$folder" > /dev/null
}

experiment scopes 100 1000 1000
experiment order 100 100000 100000
experiment conflicts 100 1000 1000
experiment history 100 200000 200000 --trials 1
experiment delaunay-tree 100 100000 100000
experiment hull 100 100000 100000
experiment order-k 100 100000 1000000
experiment history-in-space 100 10000 100000
experiment radial 1000 1000000 1000000
experiment hierarchy 5000 500000 500000
experiment tuning 1000 300000 300000
experiment deletion 1000 1000000 1000000
experiment jump-and-walk 1000 1000000 1000000
experiment imprecise 10000 10000000 100000000
experiment disks 1000 100000 100000
experiment brownian 1000 1000000 100000000
experiment growth 1000 10000000 100000000
scan=${SCAN:-../shared/data/igea.ply}
if [ -e "$scan" ]; then
    experiment scan 1000 1000000 1000000 "$scan"
else
    echo "== scan: skipped, there is no $scan"
fi

# Cache misses a point of a whole run, as the paper counted them (2011, §5: 4 MB of cache).
if command -v valgrind > /dev/null; then
    sizes="1000 10000 100000"
    [ "$size" = small ] && sizes=1000
    [ "$size" = long ] && sizes="$sizes 1000000"
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    misses() {
        valgrind --tool=cachegrind --cache-sim=yes --LL=4194304,16,64 --cachegrind-out-file=/dev/null \
            $delone -q --threads 1 triangulate "$work/instance.npy" "$@" -o "$work/t.npy" 2>&1 |
            awk -v n="$n" '/LL misses/ { gsub(",", "", $4); printf "%.1f", $4 / n }'
    }
    table=$folder/imprecise-cache.csv
    echo 'points,"hints, random order","hints, spatial order",spatial sort,divide and conquer' > "$table"
    for n in $sizes; do
        echo "== cache misses at $n"
        $delone -q generate disks -n "$n" --seed 1 -o "$work/centers.npy"
        $delone -q generate disks -n "$n" --seed 1 --noise 1 -o "$work/instance.npy"
        echo "$n,$(misses --hints "$work/centers.npy" --hint-order random),$(misses --hints "$work/centers.npy"),$(misses --algorithm incremental),$(misses)" >> "$table"
    done
else
    echo "== cache misses: skipped, there is no valgrind"
fi
# The rivals of 1998 and Triangle on the disks of 2011, where there is a Python that has them.
python=${PYTHON:-python3}
if [ "$size" != small ] && "$python" -c "import numpy, scipy, triangle" 2> /dev/null; then
    echo "== rivals of 1998"
    "$python" compare/rivals_of_1998.py --delone "$delone" -o "$folder/rivals.csv" > /dev/null
    "$python" compare/rivals_of_1998.py --delone "$delone" --sets disks --noise 1 --sizes 1000,10000,100000,1000000 \
        --nanoseconds -o "$folder/rivals-disks.csv" > /dev/null
else
    echo "== rivals of 1998: skipped, PYTHON has no triangle and scipy, or sets are small"
fi
# The pages show some of the plots; tables are kept.
if [ "$folder" = docs/results ]; then
    for plot in "$folder"/*.svg; do
        shown=docs/figures/$(basename "$plot")
        if [ -e "$shown" ]; then mv "$plot" "$shown"; else rm "$plot"; fi
    done
fi
ls "$folder"
