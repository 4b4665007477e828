#!/bin/bash
# farm/slurm-array.sh as Slurm would run it, on two workers: the frames are those of one run, to the byte.
# slurm_test.sh PROGRAM SOURCE_DIR; 77: skipped
set -eu
program=$1 source=$2
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
export PINOCCHIO=$program SCENE=$source/scenes/cornell.gltf OUTPUT=$folder/farm FIRST=0 LAST=6 CHUNK=3
task() { SLURM_ARRAY_TASK_ID=$1 SLURM_CPUS_PER_TASK=1 "$source/farm/slurm-array.sh" --turntable 12 --size 48x36; }
task 0 > "$folder/0" & first=$!
task 1 > "$folder/1"; task 2 > "$folder/2"; task 3 > "$folder/3"; wait $first
"$program" render "$SCENE" --frames 0-6 --turntable 12 --size 48x36 --deterministic -o "$folder/one-####.exr" --quiet
for i in 0 1 2 3 4 5 6; do cmp "$folder/farm/frame-000$i.exr" "$folder/one-000$i.exr"; done
[ "$(ls "$folder/farm" | wc -l)" = 7 ]
# A task that is run again draws what is missing alone.
rm "$folder/farm/frame-0004.exr"
task 1 | grep -q '2 frames were there already'
cmp "$folder/farm/frame-0004.exr" "$folder/one-0004.exr"
# What Slurm sends before the time is over goes to the script's own process; the program ends there, and keeps whole frames alone.
grep -q '^#SBATCH --signal=B:TERM@' "$source/farm/slurm-array.sh"
OUTPUT=$folder/ended LAST=200 CHUNK=201 SLURM_ARRAY_TASK_ID=0 SLURM_CPUS_PER_TASK=1 \
  "$source/farm/slurm-array.sh" --turntable 201 --size 192x144 > "$folder/ended.txt" & task=$!
while [ ! -e "$folder/ended/frame-0001.exr" ]; do sleep 0.05; done
kill -TERM $task
status=0; wait $task || status=$?
[ "$status" = 130 ] || { echo "ended by TERM: exit code $status"; exit 1; }
[ "$(find "$folder/ended" -name 'frame-*.exr' | wc -l)" -lt 201 ]
[ -z "$(find "$folder/ended" ! -name 'frame-*.exr' -type f)" ]
if ! command -v shellcheck > /dev/null; then echo "skipped: shellcheck is missing"; exit 77; fi
shellcheck "$source/farm/slurm-array.sh"
