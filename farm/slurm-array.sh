#!/bin/bash
# An animation in chunks of frames as a Slurm job array. Frames FIRST to LAST, CHUNK to a task:
#   sbatch --array=0-8 --export=ALL,SCENE=boat.glb,OUTPUT=frames,FIRST=0,LAST=89,CHUNK=10 farm/slurm-array.sh --turntable 90
# What follows the script's name are more options of 'pinocchio render'. A task that is ended or requeued goes on
# where it stopped: frames that are whole are left out.
#SBATCH --job-name=pinocchio
#SBATCH --cpus-per-task=8
#SBATCH --requeue
#SBATCH --signal=B:TERM@10
set -eu
: "${SCENE:?the scene file}" "${OUTPUT:?the folder of the frames}" "${LAST:?the last frame}"
chunk=${CHUNK:-10}
start=$((${FIRST:-0} + SLURM_ARRAY_TASK_ID * chunk))
end=$((start + chunk - 1))
if [ "$end" -gt "$LAST" ]; then end=$LAST; fi
if [ "$start" -gt "$end" ]; then exit 0; fi
mkdir -p "$OUTPUT"
# B: above sends the signal to this script's process, which exec makes the program: it keeps what it has drawn.
exec "${PINOCCHIO:-pinocchio}" render "$SCENE" --frames "$start-$end" --exchange pipelined "$@" --threads "${SLURM_CPUS_PER_TASK:-0}" \
  -o "$OUTPUT/frame-####.exr" --deterministic --skip-existing --progress off
