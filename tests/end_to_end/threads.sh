#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The same bytes come out whatever the number of threads.
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
site=$temporary/site
cp -a -- "$DEMO_SITE" "$site"
name=$(photo_names "$site" | head -n 1)

# The check sums of one photograph's montage, rendered by this many threads.
render_with_threads() {
  rm -rf -- "$site/montages"
  "$INSITU_BIN/insitu-render" "$site" --photo "$name" --threads "$1" >/dev/null
  checksums "$site/montages"
}

single=$(render_with_threads 1)
check 'EXR, layers, shadows, what is unseen, PNG, JPEG and the uncertainty of the building, of the one that is asked for' \
  test "$(wc -l <<<"$single")" -eq 7
for threads in 2 3; do
  check "$threads threads: the same bytes" test "$(render_with_threads "$threads")" = "$single"
done
finish
