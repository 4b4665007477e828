#!/usr/bin/env bash
# package_test.sh BUILD_FOLDER: the archive, unpacked elsewhere, draws a scene with nothing of this tree; so does the
# .deb, whose files are where Debian has them.
set -euo pipefail
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cd "$build"
cpack -G TGZ -B "$work" >"$work/cpack.log" 2>&1 || { cat "$work/cpack.log"; exit 1; }
mkdir "$work/unpacked"
tar -xzf "$work"/pinocchio-*.tar.gz -C "$work/unpacked" --strip-components=1
cd "$work/unpacked"

program=$PWD/bin/pinocchio
clean=(env -i PATH=/usr/bin:/bin HOME="$work")
if "${clean[@]}" ldd "$program" | grep -E 'not found|/usr/.*(OpenEXR|tinyobj|Imath)'; then
  echo "the program does not find its own libraries"
  exit 1
fi
"${clean[@]}" "$program" render share/pinocchio/scenes/two-lights.gltf --size 64x48 -o "$work/x.exr" --quiet
"${clean[@]}" "$program" measure share/pinocchio/scenes/cornell.gltf --size 64x48 --turntable 8 --stats-json "$work/x.json" --quiet
"${clean[@]}" "$program" info --system
test -s "$work/x.exr" && test -s "$work/x.json"

cd "$build"
cpack -G DEB -B "$work" >"$work/cpack.log" 2>&1 || { cat "$work/cpack.log"; exit 1; }
dpkg-deb -x "$work"/pinocchio_*.deb "$work/root"
cd "$work/root"
[ "$(ls)" = usr ] || { echo "the .deb has folders beside /usr: $(ls)"; exit 1; }
test -s usr/share/man/man1/pinocchio.1 && test -s usr/share/bash-completion/completions/pinocchio
"${clean[@]}" usr/bin/pinocchio render usr/share/pinocchio/scenes/two-lights.gltf --size 64x48 -o "$work/y.exr" --quiet
"${clean[@]}" usr/bin/pinocchio compare "$work/x.exr" "$work/y.exr" --max-error max=0 >/dev/null
