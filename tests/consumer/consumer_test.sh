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
    echo "$1: what find_package(PinocchioRenderer) prints looks like a failure"
    exit 1
  fi
  quietly cmake --build "$2"
}
# The robotics library `pinocchio` in the same prefix: no path of its file list is one of ours, with letters of any case,
# and a program finds both. Its files here are stand-ins.
stands_beside_robotics() { # PREFIX
  local theirs=$tree/tests/consumer/robotics_pinocchio.txt file
  (cd "$1" && find . -type f | sed 's|^\./||') | tr '[:upper:]' '[:lower:]' | sort >"$work/ours"
  if grep -v '^#' "$theirs" | tr '[:upper:]' '[:lower:]' | sort | comm -12 - "$work/ours" | grep .; then
    echo "these files are the robotics library's as well"
    exit 1
  fi
  if grep -E '^include/pinocchio/|/cmake/pinocchio/|/libpinocchio_(collision|default|parsers|visualizers)\.' "$work/ours"; then
    echo "these files lie in folders of the robotics library, or have its libraries' names"
    exit 1
  fi
  grep -v '^#' "$theirs" | while read -r file; do
    mkdir -p "$1/$(dirname "$file")"
    true >"$1/$file"
  done
  echo '#define PINOCCHIO_ROBOTICS 1' >"$1/include/pinocchio/fwd.hpp"
  cat >"$1/lib/cmake/pinocchio/pinocchioConfig.cmake" <<'EOF'
add_library(pinocchio::pinocchio INTERFACE IMPORTED)
target_include_directories(pinocchio::pinocchio INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
EOF
  build "$tree/tests/consumer/beside_robotics" "$work/beside" -DCMAKE_PREFIX_PATH="$1" "${@:2}"
  "$work/beside/beside_robotics"
}
links_core_alone() { # FOLDER of tracer_alone
  if ninja -C "$1" -t commands tracer_alone | grep -oE -- '-o tracer_alone .*pinocchio_renderer_(compare|reference)'; then
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
  for example in tracer_alone headless layers own_window; do
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
  for example in tracer_alone headless layers own_window; do
    build "$work/examples/$example" "$work/build-$example" -DCMAKE_PREFIX_PATH="$prefix" "$@"
    mkdir -p "$work/build" && mv "$work/build-$example/$example" "$work/build/"
  done
  links_core_alone "$work/build-tracer_alone"
  build "$tree/tests/consumer/compare" "$work/compare" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  "$work/compare/compare"
  build "$tree/tests/consumer/own_glad" "$work/own_glad" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  stands_beside_robotics "$prefix" "$@"
  for kind in STATIC SHARED; do "$work/own_glad/own_glad_$kind" "$tree/scenes/cornell.gltf"; done
fi

"$work/build/tracer_alone" "$tree/scenes/cornell.gltf" >"$work/letters"
grep -q '#' "$work/letters" && grep -q '\.' "$work/letters"
if ldd "$work/build/tracer_alone" | grep -E 'libGL|libEGL|libglfw'; then
  echo "the tracer alone links OpenGL"
  exit 1
fi
for example in headless layers; do
  if ldd "$work/build/$example" | grep -E 'libglfw|libX11'; then
    echo "$example opens no window, but links GLFW or X11"
    exit 1
  fi
done

"$work/build/headless" "$tree/scenes/cornell.gltf" "$work/cornell.exr"
"$built/bin/pinocchio" render "$tree/scenes/cornell.gltf" --depth 4 -o "$work/program.exr" --quiet
"$built/bin/pinocchio" compare "$work/cornell.exr" "$work/program.exr" --max-error max=0
# Of the windmill sails move and the tower stands still; the EXR has the layers that are named.
"$work/build/layers" "$tree/scenes/windmill.glb" 1 "$work/layers.exr" >"$work/nodes"
grep -qE '^sail 0: [0-9]+ pixels, .*, motion 1\.' "$work/nodes" && grep -qE '^tower: .*, motion 0.00$' "$work/nodes" ||
  { cat "$work/nodes"; exit 1; }
for channel in id.node motion.X shadow.mask Z; do grep -qa "$channel" "$work/layers.exr"; done
quietly xvfb-run -a "$work/build/own_window" "$tree/scenes/cornell.gltf" 5
