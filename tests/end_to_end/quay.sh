#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# quay.sh quay|quay_dusk: the figures to reach on a shared site with glass, metal, water, trees and
# lamps, by day or at dusk, which another renderer path traced. The data is no part of this
# repository: INSITU_SHARED names its folder, else ../shared is tried.
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
name=$1
shared=${INSITU_SHARED:-$(dirname -- "$root")/shared}
if [[ ! -d $shared/data/$name ]]; then
  printf 'SKIPPED: no shared data in %s\n' "$shared"
  exit 77
fi
if [[ ${CI:-} == true ]]; then
  printf 'SKIPPED: ten minutes of figures, which CI has not: scripts/test end_to_end/%s\n' "$name"
  exit 77
fi

# Linear photographs: the noise of JPEG would hide the smaller changes.
site=$temporary/$name
mkdir -p -- "$site/photos"
cp -r -- "$shared/data/$name"/{site.json,calibration,survey,building} "$site"
cp -- "$shared/data/$name"/photos_linear/*.exr "$site/photos"
check 'montage' "$root/scripts/montage" "$site" --render.photo QY_4102
check_figures "$name" /usr/bin/python3 "$tests/quay_figures.py" "$name" "$site" "$shared"
finish
