#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The figures to reach on the shared gallery site, which another renderer path traced. The data is
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

# new_site NAME: a copy of the gallery without its truth, at $site.
new_site() {
  site=$temporary/$1
  mkdir -- "$site"
  cp -r -- "$gallery"/{site.json,photos,calibration,survey,building} "$site"
}

# figures KIND: one assertion a figure, by gallery_figures.py.
figures() { check_figures "$1" /usr/bin/python3 "$tests/gallery_figures.py" "$1" "$site" "$shared"; }

is_photo() { "$COMPARE_IMAGES" identical "$site/photos/$1.jpg" "$site/montages/$1.png"; }

new_site photographs
check 'photographs, montage' "$root/scripts/montage" "$site"
figures gi
calibration=$site/work/calibration

new_site direct_light
rm -- "$site"/photos/*
cp -- "$gallery"/photos_direct/*.exr "$site/photos"
mkdir -- "$site/work" # the same camera: its calibration need not run twice
cp -r -- "$calibration" "$site/work"
check 'direct light, montage' "$root/scripts/montage" "$site" --from tie-points --bounces 0
figures direct

site=$temporary/photographs
check 'photographs, montage without building' "$root/scripts/montage" --no-building "$site"
for name in $(photo_names "$site"); do
  check "photographs, $name without building: every pixel is the photograph's" is_photo "$name"
done
finish
