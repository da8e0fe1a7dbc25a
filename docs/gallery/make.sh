#!/usr/bin/env bash
# Makes the pictures of the gallery anew. Needs the programs: cargo build --release -p delone-cli -p delone-lab
set -euo pipefail
cd "$(dirname "$0")/../.."
delone=${DELONE:-target/release/delone}
lab=${LAB:-target/release/delone-lab}
here=docs/gallery
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

$delone generate uniform -n 400 --seed 3 -o "$work/sites.csv"
$delone voronoi "$work/sites.csv" --box 0,0,1,1 -o $here/cells.png --size 640
$delone voronoi "$work/sites.csv" --box 0,0,1,1 --relax 60 -o $here/relaxed.png --size 640

# A ring of 80 corners with a square hole, as GeoJSON.
ring=$(awk 'BEGIN { for (i = 0; i <= 80; i++) { t = 6.283185307179586 * (i % 80) / 80
    printf "%s[%.6f,%.6f]", i ? "," : "", 0.5 + (i % 2 ? 0.36 : 0.48) * cos(t), 0.5 + (i % 2 ? 0.36 : 0.48) * sin(t) } }')
cat > "$work/star.geojson" <<JSON
{"type":"Polygon","coordinates":[[$ring],[[0.4,0.4],[0.4,0.6],[0.6,0.6],[0.6,0.4],[0.4,0.4]]]}
JSON
$delone generate uniform -n 1500 --seed 5 -o "$work/many.csv"
$delone voronoi "$work/many.csv" --clip "$work/star.geojson" -o $here/star.png --size 640

$delone generate uniform -n 60 -o "$work/sixty.csv"
$delone voronoi "$work/sixty.csv" --order 3 --box 0,0,1,1 -o $here/order.png --size 640

# Grains of prescribed sizes: from 1 to 9 times the smallest.
$delone generate uniform -n 300 --seed 4 -o "$work/seeds.csv"
awk 'BEGIN { for (i = 0; i < 300; i++) print 1 + (i * 37 % 100) ^ 2 / 1250 }' > "$work/sizes.csv"
$delone voronoi "$work/seeds.csv" --areas "$work/sizes.csv" --box 0,0,1,1 -o $here/areas.png --size 640

# Meshes, coloured by the smallest angle of each triangle: a machine part, and lakes.
$delone mesh $here/part.poly --min-angle 30 --max-area 12 --color angle -o $here/part.png --picture-size 800
$delone mesh $here/plate.dxf --fill even-odd --edge 0.25 --min-angle 28 --color angle -o $here/plate.png --picture-size 960
$delone mesh $here/wing.poly --edge 0.08 --min-angle 28 --layers 2,3 --layer-height 0.001 --layer-count 10 --layer-growth 1.3 --color angle \
    -o $here/wing.png --picture-size 960
$delone draw $here/part.poly -o $here/part-before.png --size 800
$delone mesh data/great_lakes.geojson --min-angle 30 --color angle -o $here/meshed-lakes.png --picture-size 960

$delone generate clusters -n 3000 --seed 1 -o "$work/clusters.csv"
$delone voronoi "$work/clusters.csv" -o $here/clusters.png --size 640
$delone alpha data/autzen_trim.laz --class ground --radius 12 -o $here/alpha.png --size 640

$delone voronoi data/autzen_trim.laz --class 2 -o $here/ground.png --size 960
$delone draw data/autzen_trim.laz --class 2 -o $here/terrain.png --size 960

# The shortest tree through the shores of lakes.
$delone graph data/great_lakes.geojson --kind spanning-tree -o $here/tree.png --size 960

# Points along a spiral on a sphere.
awk 'BEGIN { for (i = 0; i < 600; i++) { z = 1 - (2 * i + 1) / 600; r = sqrt(1 - z * z); t = 2.399963229728653 * i
    printf "%.9f,%.9f,%.9f\n", r * cos(t), r * sin(t), z } }' > "$work/sphere.csv"
$delone hull "$work/sphere.csv" --dim 3 -o $here/sphere.png --size 640
$delone hull data/autzen_trim.laz --dim 3 -o $here/tile.png --size 960

# Tetrahedra of a ball, cut open.
$delone generate ball -n 1500 --seed 1 -o "$work/ball.csv"
$delone draw "$work/ball.csv" --dim 3 --view -60,40 --cut 0,0,1,0.1 -o $here/ball.png --size 640
# Cells of space, cut open.
$delone generate ball -n 400 --seed 2 -o "$work/foam.csv"
$delone voronoi "$work/foam.csv" --dim 3 --clip hull --cut 1,-1,0.6,0.1 --view -40,30 -o $here/foam.png --size 640
# Imprecise points, and moving ones.
$delone generate disks -n 60 --seed 3 -o "$work/disks.csv"
$delone draw "$work/disks.csv" --disks 1 --hints -o $here/hints.png --size 700
$lab animate "$work/disks.csv" --radius 0.3 --steps 40 --size 400 -o $here/motion.png
# What the algorithms of the papers do.
$delone generate uniform -n 14 --seed 3 -o "$work/few.csv"
$delone generate uniform -n 48 --seed 3 -o "$work/some.csv"
$delone generate uniform -n 300 --seed 3 -o "$work/several.csv"
$delone generate disks -n 30 --seed 3 -o "$work/thirty.csv"
$lab animate "$work/few.csv" --show flips --size 400 -o $here/flips.png
$lab animate "$work/some.csv" --show lists --steps 23 --size 400 -o $here/lists.png
$lab animate "$work/several.csv" --show levels --steps 30 --size 400 -o $here/levels.png
$lab animate "$work/several.csv" --show jump --steps 30 --size 400 -o $here/jump.png
$lab animate "$work/thirty.csv" --show hints --size 400 -o $here/walks.png
# The five sets of the paper of the Delaunay hierarchy (Devillers 1998, Figure 5).
for kind in uniform ellipse2 ellipse parabola circle; do
    $delone generate $kind -n 400 --seed 1 -o "$work/$kind.csv"
    $delone draw "$work/$kind.csv" --colors=no -o $here/set-$kind.png --size 360
done
# A scanned head, if there is one.
scan=${SCAN:-../shared/data/igea.ply}
if [ -e "$scan" ]; then
    $delone draw "$scan" --dim 3 --view 30,20 --cut 1,0,0,0 -o $here/scan.png
else
    echo "no $scan: its picture stays as it is"
fi

# Tiles, and the seams between them.
$delone generate uniform -n 3000 --seed 5 -o "$work/tiled.csv"
$delone tiles "$work/tiled.csv" -o "$work/tiles" --tile 220
$delone window "$work/tiles" --tiles -o $here/tiles.png --size 700

# Constraints: the Great Lakes, and a snowflake.
$delone draw data/great_lakes.geojson -o $here/lakes.png --size 1200
$delone generate koch -n 768 -o "$work/koch.poly"
$delone draw "$work/koch.poly" -o $here/koch.png --size 640

# A lattice, whose every square is a tie.
awk 'BEGIN { for (i = 0; i < 64; i++) print i % 8 "," int(i / 8) }' > "$work/lattice.csv"
$delone draw "$work/lattice.csv" -o $here/lattice.png --size 360

# The shipped scan as a hillshade, and 60 points of a wave by triangles and by natural neighbours.
$delone -q dtm data/autzen_trim.laz --cell 2 -o $here/shade.png
$delone -q contours data/autzen_trim.laz --class ground --interval 5 --bands -o $here/contours.png --size 960
$delone generate uniform -n 60 --seed 2 -o "$work/wave.csv"
awk -F, 'NR == 1 && $1 + 0 != $1 { next } { printf "%.9f,%.9f,%.9f\n", $1, $2, 0.16 * cos(9 * $1) * cos(7 * $2) }' \
    "$work/wave.csv" > "$work/heights.csv"
$delone -q dtm "$work/heights.csv" --cell 0.0025 -o $here/linear.png
$delone -q dtm "$work/heights.csv" --cell 0.0025 --method natural -o $here/sibson.png

# A roof of 70 points, and the same with its ridge as a breakline.
$delone generate uniform -n 70 --seed 6 -o "$work/roof.csv"
awk -F, 'NR == 1 && $1 + 0 != $1 { next } { d = $1 - 0.4 - 0.2 * $2; printf "%.9f,%.9f,%.9f\n", $1, $2, 0.15 - 0.35 * (d < 0 ? -d : d) }' \
    "$work/roof.csv" > "$work/roof-heights.csv"
cat > "$work/ridge.geojson" <<JSON
{"type":"LineString","coordinates":[[0.4,0,0.15],[0.6,1,0.15]]}
JSON
$delone -q dtm "$work/roof-heights.csv" --cell 0.0025 -o $here/roof.png
$delone -q dtm "$work/roof-heights.csv" --cell 0.0025 --breaklines "$work/ridge.geojson" -o $here/roof-ridge.png

# Thiessen polygons: the commands of that page.
program=$(realpath "$delone") page=$PWD/docs/howto/thiessen.md
(cd "$work" && delone() { "$program" "$@"; } && eval "$(sed -n '/^```sh$/,/^```$/{/^```/!p}' "$page")")
cp "$work/areas.png" $here/thiessen.png

# Where pictures of terrain lie is of no use here.
rm -f $here/*.pgw
