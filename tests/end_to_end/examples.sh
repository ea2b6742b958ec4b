#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The paper's first example, small, through scripts/examples in both modes, and what a second run does.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
export INSITU_EXAMPLES=$temporary/examples
examples() { "$root/scripts/examples" --width 360 gallery; }

names_the_three() {
  local status=0 error
  error=$("$root/scripts/examples" galery 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 && $error == *'"galery", expected gallery, bridge or courtyard'* ]]
}
check 'an unknown example is told the three' names_the_three
the_program_too() {
  local status=0 error
  error=$("$INSITU_BIN/insitu-demo-site" --example galery "$temporary/none" 2>&1) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 && $error == *'expected gallery, bridge or courtyard'* ]]
}
check 'by the program, too' the_program_too

examples >"$temporary/first" 2>"$temporary/error" || true
has_row() { grep -E "$1" "$temporary/first"; }
check 'Table 1 counts the photographs' has_row '^input images +\| +3 +3 +3 *$'
check 'has the sun in both modes' has_row '^k_s +\| +4111\.65 +[0-9]+\.[0-9]+ +[0-9]+\.[0-9]+ *$'
check 'and the facets' has_row '^m_h +\| +2 +[0-9]+ +[0-9]+ *$'

# The mean share of the error that is left: at most MODE's bound.
leaves_at_most() { # FIELD BOUND
  awk -v field="$1" -v bound="$2" '
    $1 == "gallery" && $2 == "mean" { print $field; found = 1; exit !($field > 0 && $field <= bound) }
    END { if (!found) exit 1 }' "$temporary/first"
}
check 'the paper'\''s mode is no worse than showing nothing' leaves_at_most 5 1
check 'the default mode is nearer to the truth' leaves_at_most 8 0.2

does_nothing_again() {
  local before after
  before=$(checksums "$INSITU_EXAMPLES/gallery/truth" "$INSITU_EXAMPLES/gallery/montages")
  examples >"$temporary/second" 2>&1 || return 1
  after=$(checksums "$INSITU_EXAMPLES/gallery/truth" "$INSITU_EXAMPLES/gallery/montages")
  ! grep -E '^\[[0-9]/[0-9]\] [a-z-]* .* s$' "$temporary/second" && [[ $before == "$after" ]]
}
check 'a second run does nothing again' does_nothing_again
finish
