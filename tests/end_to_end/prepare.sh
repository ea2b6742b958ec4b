#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The measuring page: its server over the wire (nothing confirmed is lost by kill -9, attacks are turned
# away, bad input is told), and the demo site measured on it by keyboard, then its montage.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"

# A site of the test's own.
new_site() {
  rm -rf -- "$temporary/site"
  cp -r -- "$DEMO_SITE" "$temporary/site"
}

# 20 of the 100 moments that scripts/bench prepare tries.
new_site && check_figures 'kill -9' node "$tests/prepare/kill.mjs" "$temporary/site" "${KILLS:-20}"
new_site && check_figures 'attacks' node "$tests/prepare/attacks.mjs" "$temporary/site"
new_site && check_figures 'bad input' node "$tests/prepare/bad_input.mjs" "$temporary/site"

# From photographs to a montage. Status 77, a skip, only if nothing above failed.
if [[ ! -f ${PLAYWRIGHT:=$root/build/playwright-core}/package.json ]]; then
  printf 'skipped: no playwright-core in %s, scripts/setup --developer fetches it\n' "$PLAYWRIGHT"
  exit $((failures > 0 ? 1 : 77))
fi
export PLAYWRIGHT
new_site && rm -rf -- "$temporary/site/work" "$temporary/site/montages"
find "$temporary/site/survey" -type f ! -name materials.json -delete
check_figures 'measuring' node "$tests/prepare/measure.mjs" "$temporary/site" "$DEMO_SITE" "${SCREENSHOTS:-}"
makes_montages() {
  "$INSITU_BIN/insitu-montage" "$temporary/site" >"$temporary/log" 2>&1 || { tail -n 3 "$temporary/log" && return 1; }
  grep '^reconstruct .*verdict' "$temporary/log"
  [[ $(find "$temporary/site/montages" -name '*.png' | wc -l) -eq 3 ]]
}
check 'what was measured makes the montages' makes_montages
finish
