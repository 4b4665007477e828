# shellcheck shell=bash
# Sourced by the scripts: steps that say what they do, what they took and where they failed.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

STEP="starting"
STEP_TABLE=()
BESIDE_ID=""  # of the process group that runs beside a step; empty: none does
at_exit() {
  local status=$?
  if [ -n "$BESIDE_ID" ]; then kill -- "-$BESIDE_ID" 2>/dev/null || true; fi
  if [ $status -ne 0 ]; then echo "$0: failed while $STEP (see above)" >&2; fi
}
trap at_exit EXIT

# step WHAT COMMAND...: runs it, says so, and remembers the seconds.
step() {
  STEP="$1"
  shift
  echo "==> $STEP"
  local begin=$SECONDS
  "$@"
  STEP_TABLE+=("$(printf '%6d s  %s' $((SECONDS - begin)) "$STEP")")
}

# beside WHAT COMMAND...: begins it in the background, where it gives way to the steps that follow; `finish` waits
# for it and shows what it wrote. For what computes beside what waits.
beside() {
  BESIDE="$1"
  shift
  echo "==> $BESIDE: begins in the background"
  BESIDE_LOG=$(mktemp)
  set -m  # a process group of its own
  (renice -n 19 "$BASHPID" >/dev/null && "$@") >"$BESIDE_LOG" 2>&1 </dev/null &
  set +m
  BESIDE_ID=$!
}

finish() {
  local begin=$SECONDS status=0
  STEP="$BESIDE"
  echo "==> $STEP: what it wrote"
  renice -n 0 -g "$BESIDE_ID" >/dev/null 2>&1 || true  # nothing to give way to any more; root alone may
  wait "$BESIDE_ID" || status=$?
  BESIDE_ID=""
  cat "$BESIDE_LOG"
  rm -f "$BESIDE_LOG"
  STEP_TABLE+=("$(printf '%6d s  %s (beyond the step it ran beside)' $((SECONDS - begin)) "$STEP")")
  return $status
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

# configure_and_build PRESET [TARGET...]: quick where nothing changed.
configure_and_build() {
  local launcher=() targets=()
  if [ $# -gt 1 ]; then targets=(--target "${@:2}"); fi
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  cmake --preset "$1" "${launcher[@]}" >"/tmp/pinocchio-configure-$$.log" 2>&1 || {
    cat "/tmp/pinocchio-configure-$$.log" >&2
    return 1
  }
  rm -f "/tmp/pinocchio-configure-$$.log"
  cmake --build --preset "$1" "${targets[@]}"
}
