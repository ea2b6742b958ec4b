#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The measuring page: its server over the wire (nothing confirmed is lost by kill -9, attacks are turned
# away, bad input is told); in a browser two windows, undo to the byte, what cannot be saved, a start from
# nothing but photographs, scanned film, and the demo site measured by keyboard, then its montage.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"

# A site of the test's own.
new_site() {
  rm -rf -- "$temporary/site"
  cp -r -- "$DEMO_SITE" "$temporary/site"
}

# 20 of the 100 moments that scripts/bench prepare tries, and 5 of the 25 while the journal is made shorter.
new_site && check_figures 'kill -9' node "$tests/prepare/kill.mjs" "$temporary/site" "${KILLS:-20}" 5
new_site && check_figures 'attacks' node "$tests/prepare/attacks.mjs" "$temporary/site"
new_site && check_figures 'bad input' node "$tests/prepare/bad_input.mjs" "$temporary/site"

if [[ ! -f ${PLAYWRIGHT:=$root/build/playwright-core}/package.json ]]; then
  printf 'SKIPPED: the page in a browser: no playwright-core in %s; scripts/setup --developer fetches it\n' \
    "$PLAYWRIGHT"
  finish
fi
export PLAYWRIGHT
# in_browser WHAT MODULE ARGUMENT...: on a new site.
in_browser() {
  new_site
  check_figures "$1" node "$tests/prepare/$2.mjs" "$temporary/site" "${@:3}"
}
in_browser 'two windows' windows
in_browser 'a colleague'\''s copy' merge "$temporary/copy of it"
in_browser 'beside the light' beside_light
in_browser 'another light' relit
in_browser 'German' german "${SCREENSHOTS:-}"
in_browser 'sketches' sketches
in_browser 'files' files
check 'what the page wrote is read by the adjustment' \
  "$INSITU_BIN/insitu-reconstruct" "$temporary/site"
in_browser 'polygons' polygons
leaves_out_by_name() {
  local message
  message=$("$INSITU_BIN/insitu-reconstruct" "$temporary/site" 2>&1) || return 1
  printf '%s\n' "$message" | grep "^warning: .*point 'lone': one ray only, .*left out"
}
check 'the adjustment reads them, and leaves out the point of one mark by name' leaves_out_by_name
in_browser 'kill -9 of the browser' browser_kill "$temporary/profile"
in_browser 'a read-only file' not_saved

# On a disk of its own, which only root can make.
if mkdir -- "$temporary/disk" && mount -t tmpfs -o size=80m tmpfs "$temporary/disk" 2>/dev/null; then
  trap 'umount -l "$temporary/disk" 2>/dev/null; rm -rf -- "$temporary"' EXIT
  mkdir -- "$temporary/disk/site"
  cp -r -- "$DEMO_SITE"/{photos,calibration,survey,site.json} "$temporary/disk/site"
  mkdir -- "$temporary/disk/site/work"
  cp -r -- "$DEMO_SITE/work/calibration" "$temporary/disk/site/work" # what renders keep is as large as the disk
  check_figures 'a full disk' node "$tests/prepare/not_saved.mjs" "$temporary/disk/site" \
    "$temporary/disk/filled"
else
  printf 'SKIPPED: a full disk, which only root can make\n'
fi

mkdir -- "$temporary/photographs"
cp -- "$DEMO_SITE"/photos/* "$temporary/photographs"
/usr/bin/python3 "$tests/prepare/large_photo.py" 480 320 "$temporary/small.jpg"
new_site
check_figures 'nothing but photographs' node "$tests/prepare/start_from_nothing.mjs" \
  "$temporary/photographs" "$temporary/site" "$temporary/small.jpg"

mkdir -p -- "$temporary/upright/photos"
/usr/bin/python3 "$tests/prepare/upright_photos.py" "$temporary/upright/photos"
in_browser 'for everyone' everyone "$temporary/upright" "${SCREENSHOTS:-}"

# The photographs as if taken on film and scanned: no camera but the certificate that is typed.
/usr/bin/python3 "$tests/prepare/film_scans.py" "$DEMO_SITE" "$temporary/film"
check_figures 'scanned film' node "$tests/prepare/film.mjs" "$temporary/film" "${SCREENSHOTS:-}"
check 'the film that the page wrote is read by insitu-calibrate' \
  "$INSITU_BIN/insitu-calibrate" "$temporary/film"

# From photographs to a montage. A quarter is measured, the rest is there: scripts/bench prepare measures all.
new_site && rm -rf -- "$temporary/site/work" "$temporary/site/montages"
find "$temporary/site/survey" -type f -delete
check_figures 'measuring' env MEASURE_EVERY="${MEASURE_EVERY:-4}" node "$tests/prepare/measure.mjs" "$temporary/site" "$DEMO_SITE" "${SCREENSHOTS:-}"
makes_montages() {
  "$INSITU_BIN/insitu-montage" "$temporary/site" >"$temporary/log" 2>&1 || { tail -n 3 "$temporary/log" && return 1; }
  grep '^reconstruct .*verdict' "$temporary/log"
  [[ $(find "$temporary/site/montages" -name '*.png' | wc -l) -eq 3 ]]
}
check 'what was measured makes the montages' makes_montages
finish
