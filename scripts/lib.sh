# Sourced by the scripts: steps that say what they do, what they took and where they failed.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

STEP="starting"
STEP_TABLE=()
trap 'status=$?; if [ $status -ne 0 ]; then echo "$0: failed while $STEP (see above)" >&2; fi' EXIT

# step WHAT COMMAND...: runs it, says so, and remembers the seconds.
step() {
  STEP="$1"
  shift
  echo "==> $STEP"
  local begin=$SECONDS
  "$@"
  STEP_TABLE+=("$(printf '%6d s  %s' $((SECONDS - begin)) "$STEP")")
}

print_steps() {
  echo "==> what it took"
  printf '%s\n' "${STEP_TABLE[@]}"
}

fail() {
  echo "$0: $1" >&2
  trap - EXIT
  exit 1
}

# configure_and_build PRESET: quick where nothing changed.
configure_and_build() {
  local launcher=()
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  cmake --preset "$1" "${launcher[@]}" >"/tmp/pinocchio-configure-$$.log" 2>&1 || {
    cat "/tmp/pinocchio-configure-$$.log" >&2
    return 1
  }
  rm -f "/tmp/pinocchio-configure-$$.log"
  cmake --build --preset "$1"
}
