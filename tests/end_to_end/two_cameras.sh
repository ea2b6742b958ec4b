#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A site with two cameras through every stage, and what is done again when a lens changes.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"

# The demo site's photographs dealt out to two cameras, which its boards calibrated.
site=$temporary/site
mkdir -p -- "$site"
cp -a -- "$DEMO_SITE"/{photos,survey,building,site.json} "$site"
for camera in 'first camera' camera; do
  mkdir -p -- "$site/calibration/$camera"
  cp -- "$DEMO_SITE/work/calibration/camera.cameramodel" "$site/calibration/$camera"
done
readarray -t photos < <(photo_names "$site")
/usr/bin/python3 - "$site/site.json" "${photos[@]}" <<'PYTHON'
import json, sys
path, *photos = sys.argv[1:]
data = json.load(open(path))
data['cameras'] = {photo: 'camera' if i else 'first camera' for i, photo in enumerate(photos)}
json.dump(data, open(path, 'w'))
PYTHON

# runs STAGES [OPTION]: scripts/montage has to run these stages, in this order.
runs() {
  local ran
  ran=$("$root/scripts/montage" "${@:2}" "$site" |
    sed -n 's/^\[\([0-9]\)\/[0-9]\] \([a-z-]*\) .* s$/\1 \2/p' | sort | cut -d ' ' -f 2 | xargs) ||
    return 1
  printf '%s' "$ran"
  [[ $ran == "$1" ]]
}
# The same without the building, which renders at once.
redoes() { runs "$1" --no-building "${@:2}"; }

is_photo_where_untouched() {
  "$COMPARE_IMAGES" identical "$(photo_file "$site" "$1")" "$site/montages/$1.png" \
    "$DEMO_SITE/truth/mask_$1.png"
}

# Each camera's calibration is in the residual report, and its files among the inputs.
reports_both() {
  /usr/bin/python3 - "$site/work/reconstruction/report.json" <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
assert [c['name'] for c in report['cameras']] == ['first camera', 'camera'], report['cameras']
inputs = {i['file'] for i in report['identity']['inputs']}
for camera in report['cameras']:
    assert camera['calibration']['rms_px'] > 0 and camera['calibrated_region'], camera['name']
    assert camera['model_file'] in inputs, camera['model_file']
PYTHON
}

self_calibrate() { "$INSITU_BIN/insitu-reconstruct" "$site" "$@" >/dev/null; }

check 'every stage runs' runs 'calibrate reconstruct undistort light convert render'
for name in "${photos[@]}"; do
  check "$name, untouched pixels are the photograph's" is_photo_where_untouched "$name"
done
check 'the report tells of both calibrations' reports_both
check 'then all is up to date' runs ''
check 'without the building' redoes 'render'
# The light is not asked for again where it must be the same in the end.
to=(--to undistort)
check 'lenses of few photographs can be adjusted' \
  redoes 'reconstruct undistort' --self-calibrate "${to[@]}"
check 'and be as calibrated again' redoes 'reconstruct undistort' "${to[@]}"
check 'lenses adjusted by hand' self_calibrate --self-calibrate
check 'are used when that stage is left as it is' redoes 'undistort' --from undistort "${to[@]}"
check 'else it is made anew' redoes 'reconstruct undistort' "${to[@]}"
printf '# a remark\n' >>"$site/calibration/camera/camera.cameramodel"
check 'a remark in a camera file goes no further than those who read it' \
  redoes 'calibrate reconstruct undistort'
longer_focal_length() {
  /usr/bin/python3 - "$site/calibration/camera/camera.cameramodel" <<'PYTHON'
import sys
import mrcal
model = mrcal.cameramodel(sys.argv[1])
name, values = model.intrinsics()
values[:2] *= 1.0001
mrcal.cameramodel(intrinsics=(name, values), imagersize=model.imagersize()).write(sys.argv[1])
PYTHON
}
longer_focal_length
check 'another camera is heeded' redoes 'calibrate reconstruct undistort light render'
finish
