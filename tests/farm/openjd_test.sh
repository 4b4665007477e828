#!/bin/bash
# farm/openjd.yaml, run locally by openjd-cli. openjd_test.sh PROGRAM SOURCE_DIR; 77: skipped
set -eu
program=$1 source=$2
if ! command -v openjd > /dev/null; then echo "skipped: openjd is missing (pip install openjd-cli)"; exit 77; fi
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
openjd check "$source/farm/openjd.yaml"
openjd run "$source/farm/openjd.yaml" --step Render -p Program="$program" -p Scene="$source/scenes/cornell.gltf" \
  -p OutputDir="$folder/frames" -p LastFrame=4 -p ChunkSize=2 -p Options="--turntable 12 --size 48x36" > "$folder/log" ||
  { cat "$folder/log"; exit 1; }
"$program" render "$source/scenes/cornell.gltf" --frames 0-4 --turntable 12 --size 48x36 --deterministic \
  -o "$folder/one-####.exr" --quiet
for i in 0 1 2 3 4; do cmp "$folder/frames/frame-000$i.exr" "$folder/one-000$i.exr"; done
