#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The measuring page's server over the wire: nothing confirmed is lost by kill -9, attacks are turned away,
# bad input is told.
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
finish
