#!/usr/bin/env bash
# Every text of the tree has no word that codespell knows as a misspelling. spelling_test.sh SOURCE_DIR; 77: skipped
# tests/spelling_words.txt holds the words that are right here.
set -euo pipefail
if ! command -v codespell > /dev/null; then echo "skipped: codespell is missing (scripts/install-packages test)"; exit 77; fi
cd "$1"
codespell --ignore-words tests/spelling_words.txt --quiet-level 3 \
  --skip '*.svg,*.html,*.png,*.exr,*.hdr,*.glb,*.gltf,*.bin,*.obj,*.mtl,*.ply,*.ipynb,*/fuzz/corpus/*,*/fuzz/found/*,spelling_words.txt' \
  README.md CONTRIBUTING.md CHANGELOG.md CMakeLists.txt app bench cmake core docs examples farm gl hybrid python scenes scripts shaders tests
