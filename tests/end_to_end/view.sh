#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The viewing page: attacks are turned away over the wire; in a browser before and after to the pixel, the
# outline, layers, differences, and a render that is watched, stopped and gone on with.
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
cp -r -- "$DEMO_SITE" "$temporary/site"
rm -rf -- "$temporary/site/montages" "$temporary/site/work/render"
"$INSITU_BIN/insitu-render" "$temporary/site" >/dev/null
check_figures 'attacks' node "$tests/view/view_attacks.mjs" "$temporary/site"
if [[ ! -f ${PLAYWRIGHT:=$root/build/playwright-core}/package.json ]]; then
  printf 'SKIPPED: the page in a browser: no playwright-core in %s; scripts/setup --developer fetches it\n' \
    "$PLAYWRIGHT"
  finish
fi
export PLAYWRIGHT
check_figures 'looking' node "$tests/view/look.mjs" "$temporary/site" "${SCREENSHOTS:-}"
check_figures 'a pipe' node "$tests/view/pipe.mjs"
check_figures 'a render' node "$tests/view/watch.mjs" "$temporary/site" "${SCREENSHOTS:-}"
finish
