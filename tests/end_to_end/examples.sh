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
# A tenth above what is measured at this size, 0.781 and 0.117. At the README's 720 px they are 0.784, since it is the
# light that is off, by the samples' reflectance, and 0.092, since half as many pixels are outlines there.
check 'the paper'\''s mode leaves what its dark light explains' leaves_at_most 5 0.86
check 'the default mode is nearer to the truth' leaves_at_most 9 0.129
has_sheet() { [[ $(file -b -- "$INSITU_EXAMPLES/gallery.jpg") == *'JPEG image'*1280x661* ]]; }
check 'all pictures lie side by side' has_sheet

does_nothing_again() {
  local before after
  before=$(checksums "$INSITU_EXAMPLES/gallery/truth" "$INSITU_EXAMPLES/gallery/montages")
  examples >"$temporary/second" 2>&1 || return 1
  after=$(checksums "$INSITU_EXAMPLES/gallery/truth" "$INSITU_EXAMPLES/gallery/montages")
  ! grep -E '^\[[0-9]/[0-9]\] [a-z-]* .* s$' "$temporary/second" && [[ $before == "$after" ]]
}
check 'a second run does nothing again' does_nothing_again
finish
