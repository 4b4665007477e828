#!/bin/bash
# One still in tiles, joined by oiiotool as docs/farm.md says: the pixels of the still in one piece.
# tiles_test.sh PROGRAM SOURCE_DIR; 77: skipped
set -eu
program=$1 source=$2
if ! command -v oiiotool > /dev/null; then echo "skipped: oiiotool is missing (apt: openimageio-tools)"; exit 77; fi
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
types="-d half -d Z=float -d P.X=float -d P.Y=float -d P.Z=float -d id.triangle=uint -d shadow.mask=uint"
for how in "--mode raytrace" "--visibility gpu"; do
  draw() { "$program" render "$source/scenes/two-lights.gltf" --size 160x120 $how --deterministic --quiet "$@"; }
  rm -f "$folder"/*
  draw -o "$folder/one.exr"
  for box in 0,0,81,61 81,0,160,61 0,61,81,120 81,61,160,120; do draw --crop $box -o "$folder/tile-$box.exr"; done
  # shellcheck disable=SC2086
  oiiotool "$folder"/tile-*.exr --paste:mergeroi=1:all=1 +0+0 $types -o "$folder/joined.exr"
  "$program" compare "$folder/joined.exr" "$folder/one.exr" --channels --max-error max=0 --max-error mask=0 > "$folder/figures"
  if grep -v ' 0 of ' "$folder/figures" | grep ' pixels differ'; then exit 1; fi
done
