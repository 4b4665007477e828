#!/usr/bin/env bash
# completion_test.sh FOLDER: bash and zsh, given the completions in FOLDER, offer verbs, options and choices.
set -euo pipefail
folder=$1

check() { # SHELL TYPED OFFERED EXPECTED
  grep -qE -- "$4" <<<"$3" || { echo "$1: 'pinocchio $2' is offered: $3"; exit 1; }
}

source "$folder/pinocchio.bash"
in_bash() { # WORDS...: what is offered for the last
  COMP_WORDS=(pinocchio "$@") COMP_CWORD=$# COMPREPLY=()
  _pinocchio
  echo "${COMPREPLY[*]}"
}
check bash "rend" "$(in_bash rend)" '^render$'
check bash "render --mode " "$(in_bash render --mode '')" 'hybrid raytrace raster auto'
check bash "compare --heat" "$(in_bash compare --heat)" '^--heatmap$'

command -v zsh >/dev/null || { echo "skipped: no zsh"; exit 77; }
in_zsh() { # TYPED: what an interactive zsh shows of "pinocchio TYPED" after two tabs
  FOLDER=$folder TYPED=$1 zsh -f <<'EOF'
zmodload zsh/zpty
zpty shell 'COLUMNS=200 TERM=dumb zsh -f -i'
zpty -w shell "fpath=($FOLDER \$fpath); autoload -U compinit; compinit -u -D; print REA''DY"
zpty -r -m shell shown '*READY*'
zpty -n -w shell "pinocchio $TYPED"$'\t\t\C-a: \C-e\n'  # then a line that does nothing
zpty -w shell "print DO''NE"
zpty -r -m shell shown '*DONE*'
print -r -- "$shown"
EOF
}
check zsh "rend" "$(in_zsh rend)" 'pinocchio render'
check zsh "render --mode " "$(in_zsh 'render --mode ')" 'hybrid'
check zsh "compare --heat" "$(in_zsh 'compare --heat')" 'compare --heatmap'
