#!/usr/bin/env bash
# Draws docs/figures/peers.svg from docs/performance.md: construction in the plane, a bar for each program whose result was right.
# `bash docs/chart.sh`; with --check it compares the picture, and its words in the README, with the figures, and writes nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
figures() { # KIND: the lines "program nanoseconds" of that kind of points, the fastest first
    sed -n "/^## Bulk construction/,/^## /{/^$1 /,/^$/p}" docs/performance.md |
        awk '$3 ~ /^[0-9.]+$/ && $2 ~ /^[0-9]+$/ && !/WRONG/ { print $1, $2 }' | sort -k2n
}
chart() {
    awk -v row=24 -v left=150 -v scale=0.6 '
    function text(x, y, anchor, weight, words) {
        printf "<text x=\"%d\" y=\"%d\" text-anchor=\"%s\" font-weight=\"%s\">%s</text>\n", x, y, anchor, weight, words
    }
    BEGIN {
        name["delone"] = "Delone"; name["delone-2-threads"] = "Delone, 2 threads"
        name["spade"] = "spade"; name["cgal"] = "CGAL"; name["delaunator"] = "delaunator"
    }
    $1 == "kind" { kinds++; y += 34; body = body sprintf("K %d %s\n", y, $2); next }
    $1 in name { y += row; body = body sprintf("B %d %s %d\n", y, $1, $2) }
    END {
        print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 580 " y + 16 "\" font-family=\"sans-serif\" font-size=\"13\">"
        print "<title>Delaunay triangulation of a million points: nanoseconds a point</title>"
        print "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"
        n = split(body, lines, "\n")
        for (i = 1; i < n; i++) {
            split(lines[i], at, " ")
            if (at[1] == "K") { text(left, at[2] - 4, "start", "bold", "a million points: " at[3]); continue }
            is_own = at[3] ~ /^delone/
            text(left - 8, at[2] + 1, "end", is_own ? "bold" : "normal", name[at[3]])
            printf "<rect x=\"%d\" y=\"%d\" width=\"%.1f\" height=\"16\" fill=\"%s\"/>\n", left, at[2] - 12, at[4] * scale, is_own ? "#0072b2" : "#999999"
            text(left + at[4] * scale + 6, at[2] + 1, "start", "normal", at[4] " ns a point")
        }
        print "</svg>"
    }'
}
picture=$(for kind in uniform clusters; do echo "kind $kind"; figures "$kind"; done | chart)
[ "$(grep -c '<rect x' <<<"$picture")" -ge 8 ] || { echo "error: docs/performance.md has no figures of construction"; exit 1; }
if [ "${1:-}" != --check ]; then
    printf '%s\n' "$picture" > docs/figures/peers.svg
    exit
fi
cmp <(printf '%s\n' "$picture") docs/figures/peers.svg || { echo "error: run docs/chart.sh"; exit 1; }
words=$(figures uniform | awk '$1 ~ /^(delone|spade|cgal|delaunator)$/ { printf "%s%s %s", n++ ? ", " : "", $1, $2 }')
grep -qF "![Nanoseconds a point, one thread: $words](docs/figures/peers.svg)" README.md || { echo "error: the picture in the README has other words than: $words"; exit 1; }
