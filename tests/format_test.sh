#!/usr/bin/env bash
# Every source is as .clang-format says. format_test.sh SOURCE_DIR; 77: skipped
set -euo pipefail
if ! command -v clang-format > /dev/null; then echo "skipped: clang-format is missing"; exit 77; fi
cd "$1"
find app bench core examples gl hybrid python scenes tests \( -name '*.cpp' -o -name '*.h' \) -print0 |
  xargs -0 clang-format --dry-run -Werror
