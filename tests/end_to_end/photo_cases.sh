#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Photographs of the shared cases 03 to 06 and 14, each put into the shared gallery site in the place
# of one of its own, and the same in other colour spaces. The data is no part of this repository:
# INSITU_SHARED names its folder, else ../shared is tried.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
: "${WRITE_PHOTOGRAPH:?program}"
shared=${INSITU_SHARED:-$(dirname -- "$root")/shared}
gallery=$shared/data/gallery
cases=$shared/data/cases/survey
if [[ ! -d $gallery || ! -d $cases ]]; then
  printf 'SKIPPED: no shared data in %s\n' "$shared"
  exit 77
fi
readonly name=IMG_2102

# The site's own montage, with and without the building; all cases start from its results.
base=$temporary/base
mkdir -- "$base"
cp -r -- "$gallery"/{site.json,photos,calibration,survey,building} "$base"
chmod -R u+w -- "$base"
run() { "$INSITU_BIN/insitu-$1" "$site" "${@:2}" >/dev/null; }
site=$base
for program in calibrate reconstruct undistort light convert; do check "gallery, $program" run "$program"; done

# montage_of ENDING OPTION...: renders the photograph of $site, whose input images are there.
montage_of() { run render "${@:2}" --photo "$name" && [[ -s $site/montages/$name.$1 ]]; }
without_building() { run undistort && montage_of "$1" --no-building; }
# In direct light: colours are looked at, not light.
with_building() { montage_of "$1" --no-shadow-search --bounces 0; }
# new_site FILE: $site is the gallery with this as its photograph.
new_site() {
  site=$temporary/site
  rm -rf -- "$site"
  cp -r -- "$base" "$site"
  rm -- "$site/photos/$name.jpg"
  photo=$site/photos/$name.${1##*.}
  cp -- "$1" "$photo"
  chmod u+w -- "$photo"
}
looks_like() { "$COMPARE_IMAGES" colors "$1" "$2" "$3"; }
is_photo() { "$COMPARE_IMAGES" identical "$photo" "$site/montages/$name.$1"; }
orientation_of() { oiiotool --info -v "$1" | sed -n 's/.*Orientation: *\([0-9]\).*/\1/p'; }
size_of() { oiiotool --info "$1" | sed -E 's/.* ([0-9]+) x +([0-9]+),.*/\1x\2/'; }
# stands_upright ENDING: a picture of 1800 x 1200 px with the orientation 6 is seen 1200 wide.
stands_upright() {
  local file=$site/montages/$name.$1 size turned
  size=$(size_of "$file") turned=$(orientation_of "$file")
  printf '%s, orientation %s' "$size" "${turned:-none}"
  [[ $size == 1200x1800 && ${turned:-1} == 1 || $size == 1800x1200 && $turned == 6 ]]
}
refuses_photo() {
  local message status=0
  message=$("$INSITU_BIN/insitu-undistort" "$site" 2>&1 >/dev/null) || status=$?
  printf '%s' "${message//"$site/"/}"
  [[ $status -eq 2 && $message != *$'\n'* && $message =~ "$site/photos/"$1 ]]
}

# 03: a profile is heeded.
new_site "$cases/03-icc-profile-ignored/p3_icc.jpg"
check 'case 03, montage without building' without_building jpg
for ending in jpg png; do check "case 03, the $ending is the photograph" is_photo "$ending"; done
check 'case 03, the exr looks like the photograph' looks_like "$photo" "$site/montages/$name.exr" 0.5
new_site "$cases/03-icc-profile-ignored/orient6p3.jpg"
check 'case 03, turned, montage without building' without_building jpg
for ending in jpg png exr; do check "case 03, the turned $ending" stands_upright "$ending"; done

# 04: converted, or refused by name.
new_site "$cases/04-cmyk-lab-gamma-chromaticities/cmyk_icc.jpg"
check 'case 04, CMYK' refuses_photo "$name.jpg: is CMYK, expected RGB or grey; convert it to sRGB"
new_site "$cases/04-cmyk-lab-gamma-chromaticities/grey_icc.jpg"
check 'case 04, grey with its profile, montage without building' without_building jpg
check 'case 04, the png looks like the grey photograph' looks_like "$photo" \
  "$site/montages/$name.png" 0.5

# 05: orientation.
new_site "$cases/05-orientation-png/orient6.jpg"
check 'case 05, montage without building' without_building jpg
for ending in jpg png exr; do check "case 05, the $ending" stands_upright "$ending"; done

# 06: metadata that a JPEG cannot hold.
new_site "$cases/06-xmp-over-64k/bigxmp.tif"
warns_of_xmp() {
  run undistort
  "$INSITU_BIN/insitu-render" "$site" --no-building --photo "$name" 2>&1 |
    grep "$name.jpg: its XMP does not fit"
}
check 'case 06, what does not fit is told' warns_of_xmp
for ending in jpg png exr tif; do
  check "case 06, the $ending is there" test -s "$site/montages/$name.$ending"
done

# 14: what is not read is told.
tells() { { "$INSITU_BIN/insitu-$1" "$site" 2>&1 || true; } | grep -E "$2"; }
new_site "$gallery/photos/$name.jpg"
mv -- "$site/photos/IMG_2101.jpg" "$site/photos/IMG_2101.heic"
check 'case 14, HEIC' tells calibrate 'photos/IMG_2101.heic is not read, expected JPEG'
new_site "$gallery/photos/$name.jpg"
for board in "$site"/calibration/board_*.jpg; do
  mv -- "$board" "$site/calibration/IMG_${board##*board_}"
done
check 'case 14, boards under other names' tells calibrate 'not named board_\*'

# The montage in other colour spaces beside that in sRGB: what is seen differs by under 0.5.
# montages_in SPACE ENDING: as $temporary/SPACE.{without,with}.ENDING.
montages_in() {
  new_site "$gallery/photos/$name.jpg"
  rm -- "$photo"
  "$WRITE_PHOTOGRAPH" "$1" "$gallery/photos_linear/$name.exr" "$site/photos/$name.$2"
  without_building "$2" &&
    mv -- "$site/montages/$name.$2" "$temporary/$1.without.$2" &&
    with_building "$2" &&
    mv -- "$site/montages/$name.$2" "$temporary/$1.with.$2"
}
check 'sRGB, montages' montages_in srgb png
for kind in p3:png adobe:tif prophoto:tif linear:tif; do
  space=${kind%:*} ending=${kind#*:}
  check "$space, montages" montages_in "$space" "$ending"
  for which in without with; do
    check "$space, $which building as in sRGB" looks_like "$temporary/srgb.$which.png" \
      "$temporary/$space.$which.$ending" 0.5
  done
done
finish
