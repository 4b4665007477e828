#!/usr/bin/env bash
# consumer_test.sh HOW TREE BUILT OPTIONS...: builds the examples in an empty folder and runs them.
# HOW installed: against the prefix that BUILT installs; subdirectory: by add_subdirectory of TREE, with BUILT's archives
# in the place of those that it would compile (python/CMakeLists.txt compiles them so). OPTIONS are CMake's.
set -euo pipefail
how=$1 tree=$2 built=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
build() { # SOURCE FOLDER OPTIONS...
  quietly cmake -G Ninja -S "$1" -B "$2" "${@:3}"
  if grep -iE 'warning|does not exist|possible reasons' "$work/log"; then
    echo "$1: what find_package(Pinocchio) prints looks like a failure"
    exit 1
  fi
  quietly cmake --build "$2"
}
links_core_alone() { # FOLDER of tracer_alone
  if ninja -C "$1" -t commands tracer_alone | grep -oE -- '-o tracer_alone .*pinocchio_(compare|reference)'; then
    echo "the tracer alone links more than Pinocchio::core"
    exit 1
  fi
}
commands_of() { # EXAMPLE: the project's own, of all that building it runs
  ninja -C "$work/build" -t commands "$1" | grep -E -- "-o (CMakeFiles/$1\.dir/|$1 )"
}

if [ "$how" = subdirectory ]; then
  quietly cmake -G Ninja -S "$tree/tests/consumer/subdirectory" -B "$work/build" -DPINOCCHIO_SOURCE="$tree" "$@"
  (cd "$built" && cp --parents {core,core/compare,core/reference,gl,hybrid}/*.a "$work/build/pinocchio/")
  links_core_alone "$work/build"
  for example in tracer_alone headless own_window; do
    mkdir -p "$work/build/CMakeFiles/$example.dir/$tree/examples/$example"
    (cd "$work/build" && quietly bash -e <(commands_of "$example"))
  done
else
  prefix=$work/prefix
  quietly cmake --install "$built" --prefix "$prefix"
  if find "$prefix" -name '*.so*' | grep .; then
    echo "libraries of the system are installed"
    exit 1
  fi
  cd "$prefix/share/doc/pinocchio"
  for page in *.md docs/*.md; do
    { grep -oE '\]\([^)#:]+\)' "$page" || true; } | tr -d '])(' | sort -u | while read -r file; do
      [ -e "$(dirname "$page")/$file" ] || { echo "$page links to $file, which is not installed"; exit 1; }
    done
  done
  cp -r "$prefix/share/doc/pinocchio/examples" "$work/examples"
  for example in tracer_alone headless own_window; do
    build "$work/examples/$example" "$work/build-$example" -DCMAKE_PREFIX_PATH="$prefix" "$@"
    mkdir -p "$work/build" && mv "$work/build-$example/$example" "$work/build/"
  done
  links_core_alone "$work/build-tracer_alone"
  build "$tree/tests/consumer/compare" "$work/compare" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  "$work/compare/compare"
  build "$tree/tests/consumer/own_glad" "$work/own_glad" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  for kind in STATIC SHARED; do "$work/own_glad/own_glad_$kind" "$tree/scenes/cornell.gltf"; done
fi

"$work/build/tracer_alone" "$tree/scenes/cornell.gltf" >"$work/letters"
grep -q '#' "$work/letters" && grep -q '\.' "$work/letters"
if ldd "$work/build/tracer_alone" | grep -E 'libGL|libEGL|libglfw'; then
  echo "the tracer alone links OpenGL"
  exit 1
fi

"$work/build/headless" "$tree/scenes/cornell.gltf" "$work/cornell.exr"
"$built/bin/pinocchio" render "$tree/scenes/cornell.gltf" --depth 4 -o "$work/program.exr" --quiet
"$built/bin/pinocchio" compare "$work/cornell.exr" "$work/program.exr" --max-error max=0
quietly xvfb-run -a "$work/build/own_window" "$tree/scenes/cornell.gltf" 5
