#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Surveys that people stumbled on, after public reports: what each must give is in its README. The data is
# no part of this repository: INSITU_SHARED names its folder, else ../shared is tried.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
shared=${INSITU_SHARED:-$(dirname -- "$root")/shared}
cases=$shared/data/cases/survey
gallery=$shared/data/gallery
if [[ ! -d $cases ]]; then
  printf 'SKIPPED: no shared data in %s\n' "$shared"
  exit 77
fi

# fresh_site PHOTO...: a site without survey, with photographs of these names, at $site.
fresh_site() {
  local name
  site=$temporary/site
  rm -rf -- "$site"
  mkdir -p -- "$site/photos"
  for name in "$@"; do cp -- "$gallery/photos/IMG_2101.jpg" "$site/photos/$name"; done
}

# blank_site PHOTO...: the same with grey photographs that are large enough for any mark.
blank_site() {
  local name
  fresh_site
  /usr/bin/python3 -c 'import sys; from PIL import Image
Image.new("L", (6000, 6000), 128).save(sys.argv[1])' "$temporary/grey.jpg"
  for name in "$@"; do cp -- "$temporary/grey.jpg" "$site/photos/$name"; done
}

import() { "$INSITU_BIN/insitu-import-survey" "$site" "$@" 2>&1; }

# says PATTERN STATUS COMMAND...: its status, and a line of its output that matches, which is shown.
says() {
  local pattern=$1 expected=$2 output status=0
  shift 2
  output=$("$@" 2>&1) || status=$?
  grep -E -m 1 -- "$pattern" <<<"$output" || { printf 'status %d: %s' "$status" "$output" && return 1; }
  [[ $status -eq $expected ]]
}

# stands FILE PATTERN: a row of survey/FILE.
stands() { grep -E -m 1 -- "$2" "$site/survey/$1"; }

# reads PATTERN ARGUMENT...: the import succeeds, and control_points.csv has such a row.
reads() {
  local pattern=$1 output
  shift
  output=$(import "$@") || { printf '%s' "$output" && return 1; }
  stands control_points.csv "$pattern"
}

photos=(IMG_2101.jpg IMG_2102.jpg IMG_2103.jpg IMG_2104.jpg)
given=(--sigma-m 0.01 --mark-sigma-px 0.5)
point='^path_1,464999\.76[12]?[0-9]*,5251995\.31[0-9]*,400\.00[0-9]*,0\.01,'
case=$cases/01-units-in-header
fresh_site "${photos[@]}"
check 'US survey feet' reads "$point" "$case/points.csv" "$case/marks.csv" "${given[@]}" --unit 'US survey feet'
fresh_site "${photos[@]}"
check 'millimetres' reads "$point" "$case/points_mm.csv" "$case/marks.csv" "${given[@]}"
fresh_site "${photos[@]}"
check 'accuracy in centimetres' reads '^path_1,.*,0\.015,0\.015,0\.015,' "$case/acc_cm.csv" \
  "$case/marks.csv" --mark-sigma-px 0.5
fresh_site "${photos[@]}"
check 'marks in millimetres' says 'mm' 2 import "$case/points_mm.csv" "$case/m_mm.csv" "${given[@]}"

site=$temporary/planar
cp -r -- "$cases/02-planar-pose-ambiguity" "$site"
check 'six coplanar points, calibration' "$INSITU_BIN/insitu-calibrate" "$site"
check 'six coplanar points: a second place' says 'from two places: .*\(-1[67][0-9]\.[0-9]*, -24[0-9]' 0 \
  "$INSITU_BIN/insitu-reconstruct" "$site"

# gallery_site: the gallery with its calibration, at $site.
gallery_site() {
  site=$temporary/gallery
  if [[ ! -d $site ]]; then
    mkdir -- "$site"
    cp -r -- "$gallery"/{site.json,photos,calibration} "$site"
    "$INSITU_BIN/insitu-calibrate" "$site"
  fi
  rm -rf -- "$site/survey" "$site/work/reconstruction"
  cp -r -- "$gallery/survey" "$site"
}

check 'gallery, calibration' gallery_site
for name in m_half_res n_half_res; do
  gallery_site
  rm -- "$site/survey/directions.json" # it names points that n_half_res does not mark
  cp -- "$cases/07-marks-on-resized-copy/$name"/* "$site/survey"
  check "marks on a copy, $name" says 'copy .*0\.5.*' 2 "$INSITU_BIN/insitu-reconstruct" "$site"
done

fresh_site "${photos[@]}"
cp -- "$cases/08-emlid-csv/emlid.csv" "$temporary"
check 'a rover of Emlid' reads '^1,30000\.321,200000\.92[0-9]*,700\.5[0-9]*,0\.23[0-9]*,0\.21[0-9]*,0\.571[0-9]*,' \
  "$temporary/emlid.csv" --sigma-m 0.02
fresh_site "${photos[@]}"
check 'a rover of Emlid, its system named' reads '^1,30000\.321,200000\.92[0-9]*,700\.5' \
  "$temporary/emlid.csv" --sigma-m 0.02 --file-crs EPSG:31255

case=$cases/09-two-height-columns
fresh_site "${photos[@]}"
check 'two heights' says 'Ellipsoidal height.*Orthometric height' 2 import "$case/p.csv" "${given[@]}"
fresh_site "${photos[@]}"
check 'two heights, one chosen' reads "$point" "$case/p.csv" "${given[@]}" \
  --column 'height=Orthometric height'

case=$cases/10-quoted-and-excel-csv
for name in cr_only deccomma deccomma_tab quoted quoted_names sep_line swiss_thousands trailing utf16; do
  fresh_site "${photos[@]}"
  check "a spreadsheet's table, $name" reads "$point" "$case/$name.csv" "${given[@]}"
done
gallery_site
cp -- "$case/own_quote_all.csv" "$site/survey/control_points.csv"
check 'own table in quotes' says '^verdict' 0 "$INSITU_BIN/insitu-reconstruct" "$site"

case=$cases/11-gcp-photo-names
fresh_site 'IMG_2101.jpg' 'IMG_2101 (2).jpg' 'IMG_2103.jpg' 'IMG_2103 (2).jpg' 'IMG_2104.jpg'
check 'photo names with blanks' reads "$point" "$case/windows_copies.txt" "${given[@]}"
check 'photo names with blanks: their marks' stands observations.csv '^IMG_2101 \(2\),'
blank_site IMG_{4851,4854,4873,4883,4912,4946,4964}.JPG
check 'photo names in lower case' says 'IMG_4851' 0 import "$case/boruszyn_lower_case.txt" "${given[@]}"
check 'photo names in lower case: their marks' stands observations.csv '^IMG_4851,.*,691'

case=$cases/12-gcp-crs-words
blank_site IMG_{0031,0037,0046,0052}.JPG
check 'latitude for longitude' says 'longitude|latitude' 2 import "$case/copr.txt" "${given[@]}"
blank_site img_{4976,4981,4985}.jpg
check 'band 30U' says '30N|EPSG:32630|zone 30' 0 import "$case/odm239.txt" "${given[@]}"
blank_site image1.tif
check 'a code glued to the first row' says '3979' 2 import "$case/osmauto.txt" "${given[@]}"
fresh_site "${photos[@]}"
check 'UTM33N' says '33N|EPSG:32633' 0 import "$case/posm41_b.txt" "${given[@]}"
blank_site IMG_000{1,2}.jpg
check 'band S is taken for the south, and said to be' says 'south of the equator; if S is the band .* 17N' 0 import "$case/band17S.txt" "${given[@]}"
blank_site IMG_000{1,2}.jpg
check 'band S, converted to the north' says 'area of use' 2 import "$case/band17S.txt" "${given[@]}" \
  --crs EPSG:32617

gallery_site
cp -- "$cases/13-names-nfd-zero/zero_survey"/* "$site/survey"
check 'names that differ in zeros' says 'leading zeros' 2 "$INSITU_BIN/insitu-reconstruct" "$site"
finish
