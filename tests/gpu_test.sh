#!/usr/bin/env bash
# gpu_test.sh SOURCE_FOLDER BUILD_FOLDER: scripts/gpu packs an archive that runs with nothing of this tree, and says what it
# measured of the context that is here.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PINOCCHIO_BUILT=$2 "$1/scripts/gpu" pack "$work/gpu.tar.gz"
tar -xzf "$work/gpu.tar.gz" -C "$work"
cd "$work"
clean=(env -i PATH=/usr/bin:/bin HOME="$work")
if "${clean[@]}" LD_LIBRARY_PATH="$work/pinocchio-gpu/lib" ldd pinocchio-gpu/bin/pinocchio | grep -E 'not found|/usr/.*(OpenEXR|Imath)'; then
  echo "the program does not find its own libraries"
  exit 1
fi
"${clean[@]}" pinocchio-gpu/gpu --quick -o out
cat out/gpu.md
python3 - <<'PYTHON'
import json
result = json.load(open("out/gpu.json"))
assert not result["wrong"] and not result["left_out"]
assert result["gl"]["renderer"] and result["system"]["cpu"]
assert sum(test["tests"] for test in result["tests"]) > 10
assert [picture["design"] for picture in result["pictures"]] == [1, 2]
assert len(result["exchanges"]) == 10 and all(run["figures"]["fps"] > 0 for run in result["exchanges"])
PYTHON
# A driver that is not there is said, and the exit code says so, too.
if "${clean[@]}" PINOCCHIO_DEVICE=99 pinocchio-gpu/gpu --quick --seconds 20 -o none; then exit 1; fi
grep -q 'no OpenGL' none/gpu.md
