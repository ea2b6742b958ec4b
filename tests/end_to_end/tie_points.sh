#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tie points by Debian's COLMAP on shared photographs, and our models read by COLMAP's own programs.
# The data is no part of this repository: INSITU_SHARED names its folder, else ../shared is tried.
# shellcheck disable=SC2119,SC2120,SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
shared=${INSITU_SHARED:-$(dirname -- "$root")/shared}
berlin=$shared/data/scenes/opensfm_berlin_cathedral
if [[ ! -d $berlin ]]; then
  printf 'SKIPPED: no shared data in %s\n' "$shared"
  exit 77
fi

# new_site NAME PHOTOS WIDTH HEIGHT FOCAL K1 K2: photographs and their lens, no survey; sets site.
new_site() {
  site=$temporary/$1
  mkdir -p -- "$site/photos" "$site/work/calibration"
  cp -- "$2"/*.[jJ][pP][gG] "$site/photos"
  printf "{ 'lensmodel': 'LENSMODEL_OPENCV4', 'intrinsics': [ %s, %s, %s, %s, %s, %s, 0, 0 ],
  'extrinsics': [ 0, 0, 0, 0, 0, 0 ], 'imagersize': [ %s, %s ] }\n" "$5" "$5" \
    "$(awk "BEGIN { print ($3 - 1) / 2 }")" "$(awk "BEGIN { print ($4 - 1) / 2 }")" "$6" "$7" \
    "$3" "$4" >"$site/work/calibration/camera.cameramodel"
}

# shellcheck disable=SC2120 # it is also called through prints and refuses
tie_points() { "$INSITU_BIN/insitu-tie-points" "$site" "$@"; }

# prints PATTERN COMMAND...: the command succeeds and prints a line like that, which is shown.
prints() {
  local pattern=$1 output
  shift
  output=$("$@") || return 1
  grep -E -m 1 -- "$pattern" <<<"$output"
}

# refuses PATTERN COMMAND...: the command ends with status 2 and a message like that.
refuses() {
  local pattern=$1 output status=0
  shift
  output=$("$@" 2>&1) || status=$?
  [[ $status -eq 2 ]] && grep -E -m 1 -- "$pattern" <<<"$output"
}

same_again() {
  cp -- "$site/work/tie_points/tie_points.json" "$temporary/first.json"
  # shellcheck disable=SC2119
  tie_points >/dev/null && cmp -- "$temporary/first.json" "$site/work/tie_points/tie_points.json"
}

reconstruct() { "$INSITU_BIN/insitu-reconstruct" "$site" --colmap-model "$site/work/colmap"; }

# COLMAP's mean reprojection error of our model is ours, and its own adjustment gains little.
colmap_agrees() {
  mkdir -p -- "$site/work/adjusted"
  colmap bundle_adjuster --input_path "$site/work/colmap" --output_path "$site/work/adjusted" \
    --BundleAdjustment.refine_focal_length 0 --BundleAdjustment.refine_extra_params 0 |
    awk '/Initial cost/ { initial = $4 } /Final cost/ { final = $4 }
      END { print "initial", initial, "final", final; exit !(initial > 0 && final > 0.97 * initial) }'
}

# Focal length and distortion of reconstruction_example.json.
new_site berlin "$berlin/images" 3264 2448 2838.59 0.0885 -0.2324
check 'berlin: all three photographs placed' prints '^3 of 3 photos placed' tie_points
check 'berlin: the same bytes again' same_again
check 'berlin: a report without survey' prints '^sigma0 (0\.9|1\.0)' reconstruct
check 'berlin: the report tells of COLMAP'\''s version' \
  prints '"COLMAP" : "[0-9.]+"' cat "$site/work/reconstruction/report.json"
check 'berlin: a word on its datum, the places that its photographs state' \
  prints 'no control: the satellite positions of 3 of 3 photos are observed, in ' reconstruct
check 'berlin: COLMAP adjusts our model to the same' colmap_agrees
check 'berlin: our COLMAP model comes back' prints '^3 of 3 photos placed' \
  tie_points --model "$site/work/tie_points/model"
mkdir -- "$temporary/binary"
check 'berlin: COLMAP reads our model and writes it as binary' colmap model_converter \
  --input_path "$site/work/tie_points/model" --output_path "$temporary/binary" --output_type BIN
check 'berlin: COLMAP'\''s binary model comes back' prints '^3 of 3 photos placed' \
  tie_points --model "$temporary/binary"
mv -- "$site/photos/03.jpg" "$site/photos/04.jpg"
check 'berlin: tie points of other photographs' refuses "photo '03' is not in the folder" \
  reconstruct
check 'berlin: a model of other photographs, too' \
  prints "images of the model that are not in the folder photos \\(1\\): 03.jpg are left out" \
  tie_points --model "$site/work/tie_points/model"
cp -- "$site/photos/04.jpg" "$site/photos/05.jpg"
check 'berlin: a photograph twice' refuses '05.jpg: is the same photograph as .04.jpg' tie_points
finish
