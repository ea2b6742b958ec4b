#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A camera's response fitted to JPEG of three cameras' curves, on the shared gallery site. The data is
# no part of this repository: INSITU_SHARED names its folder, else ../shared is tried.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
shared=${INSITU_SHARED:-$(dirname -- "$root")/shared}
gallery=$shared/data/gallery
if [[ ! -d $gallery ]]; then
  printf 'SKIPPED: no shared data in %s\n' "$shared"
  exit 77
fi
run() { "$INSITU_BIN/insitu-$1" "$site" "${@:2}" >/dev/null; }
figures() { /usr/bin/python3 "$tests/response_figures.py" "$@"; }

# What linear photographs give; the others share its lens and its geometry.
linear=$temporary/linear site=$temporary/linear
mkdir -p -- "$site/photos"
cp -r -- "$gallery"/{site.json,calibration,survey} "$site"
cp -- "$gallery"/photos_linear/*.exr "$site/photos"
chmod -R u+w -- "$site"
for program in calibrate reconstruct undistort light; do check "linear, $program" run "$program"; done
refuses_linear() {
  { "$INSITU_BIN/insitu-light" "$site" --fit-response 2>&1 || true; } | grep 'exr: is linear light'
}
check 'linear light has no response to fit' refuses_linear

for curve in filmic channels kink; do
  site=$temporary/$curve
  cp -r -- "$linear" "$site"
  rm -- "$site"/photos/*
  for photo in "$gallery"/photos_linear/*.exr; do
    photo=${photo##*/}
    check "$curve, ${photo%.exr} as JPEG" figures encode "$curve" "$gallery/photos_linear/$photo" \
      "$site/photos/${photo%.exr}.jpg"
  done
  check "$curve, fit" run light --fit-response
  cp -- "$site/work/light/response.json" "$site/photos"
  check "$curve, light" run light
  check_figures "$curve" figures compare "$linear" "$site"
done
finish
