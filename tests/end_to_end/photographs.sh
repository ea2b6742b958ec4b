#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Photographs as cameras make them, on the demo site: raw from the adjustment to the montage, and
# files that are refused by one line.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
: "${WRITE_PHOTOGRAPH:?program}"

name=$(photo_names "$DEMO_SITE" | head -n 1)
photo=$(photo_file "$DEMO_SITE" "$name")

# with_photo ENDING: $site is a fresh one, whose first photograph is $target, not there yet.
with_photo() {
  fresh_site
  rm -- "$site/photos/${photo##*/}"
  target=$site/photos/$name.$1
}

# Raw, alone: read, measured, rendered, and delivered as 16-bit TIFF, PNG, JPEG and EXR.
with_photo dng
"$WRITE_PHOTOGRAPH" raw "$photo" "$target"
program() { "$INSITU_BIN/insitu-$1" "$site" "${@:2}" >/dev/null; }
depth_of() { grep -m 1 -oE 'uint(8|16)|half|float' < <(oiiotool --info -v "$1"); }
has_depth() {
  local depth
  depth=$(depth_of "$site/montages/$name.$1")
  printf '%s' "$depth"
  [[ $depth == "$2" ]]
}
names_no_sensor() { ! oiiotool --info -v "$site/montages/$name.$1" | grep -iE 'dngversion|cfa'; }
same_as_of_jpeg() { "$COMPARE_IMAGES" colors "$DEMO_SITE/$1" "$site/$1" "$2"; }
check 'raw, reconstruct' program reconstruct
check 'raw, its picture is in the report' test \
  "$(grep -o 'data:image/jpeg' "$site/work/reconstruction/report.html" | wc -l)" -eq \
  "$(grep -o 'data:image/jpeg' "$DEMO_SITE/work/reconstruction/report.html" | wc -l)"
check 'raw, undistort' program undistort
check 'raw, the input image shows what that of the JPEG does' same_as_of_jpeg \
  "work/input_images/$name.exr" 2
check 'raw, light' program light
check 'raw, render' program render --photo "$name"
check 'raw, the TIFF has 16 bits' has_depth tif uint16
check 'raw, the JPEG has 8 bits' has_depth jpg uint8
for ending in tif jpg; do
  check "raw, the $ending does not claim to be one" names_no_sensor "$ending"
  cp -- "$DEMO_SITE/montages/$name.png" "$site/montages/$name.of_jpeg.png"
  check "raw, the $ending looks as the montage of the JPEG" "$COMPARE_IMAGES" colors \
    "$site/montages/$name.of_jpeg.png" "$site/montages/$name.$ending" 2
done
check 'raw, render without building' program render --no-building --photo "$name"
check 'raw without building is the raw' "$COMPARE_IMAGES" identical "$target" \
  "$site/montages/$name.exr"

# A picture with its raw beside it: what its codes are in the raw's light.
fresh_site
no_raw_no_response() {
  ! "$INSITU_BIN/insitu-light" "$site" --fit-response 2>"$temporary/error" >/dev/null &&
    grep 'photos: has no raw beside a picture' "$temporary/error"
}
check 'no raw, no response' no_raw_no_response
"$WRITE_PHOTOGRAPH" raw "$photo" "$site/photos/$name.dng"
fits_response() {
  "$INSITU_BIN/insitu-light" "$site" --fit-response | tee "$temporary/fit" |
    grep -E "^$name: lies on its raw to 0\.[0-4][0-9]* px" || { head -n 3 "$temporary/fit" && return 1; }
}
check 'a raw beside its picture, response' fits_response
cp -- "$site/work/light/response.json" "$site/photos"
check 'its response is read' program undistort
check 'the input image is as by sRGB, of which the raw was made' same_as_of_jpeg \
  "work/input_images/$name.exr" 2

# What is refused.
# is_refused WHAT PATTERN: undistort, light and render refuse $site.
is_refused() {
  local what=$1 pattern=$2 program
  for program in undistort light render; do
    check "$what, $program" refuses "$program" "photos/${target##*/}: $pattern"
  done
}

with_photo dng
"$WRITE_PHOTOGRAPH" unknown_raw "$photo" "$target"
is_refused 'raw of an unknown camera' 'is of a camera \(Insitu Test\) whose colours LibRaw'

with_photo dng
"$WRITE_PHOTOGRAPH" raw "$photo" "$target"
halve "$target"
is_refused 'raw cut in the middle' 'cut short or damaged'

for kind in profile:'its ICC profile is damaged' \
  half_profile:'its ICC profile is damaged: 1 of 2 pieces' \
  link:"its ICC profile is of class 'link'" huge:'is 60000x60000 px'; do
  with_photo jpg
  "$tests/damage_photograph.py" "${kind%%:*}" "$photo" "$target"
  is_refused "JPEG, ${kind%%:*}" "${kind#*:}"
done

for kind in bomb:'its ICC profile unpacks to over 64 MB' huge:'is 60000x60000 px'; do
  with_photo png
  oiiotool "$photo" -o "$temporary/photo.png"
  "$tests/damage_photograph.py" "${kind%%:*}" "$temporary/photo.png" "$target"
  is_refused "PNG, ${kind%%:*}" "${kind#*:}"
done

fresh_site
target=$site/photos/$name.png
oiiotool "$photo" -o "$target"
is_refused 'two photographs of one name' "has the same name as $name\.jpg"
finish
