#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From nothing to montages on the demo site: scripts/montage makes every result, skips what is up
# to date, keeps photographs untouched, and comes near the truth. Leaves the site for other tests.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
site=$DEMO_SITE

# montage_lines PATTERN COUNT [OPTIONS]: scripts/montage succeeds and prints COUNT such lines.
montage_lines() {
  local pattern=$1 expected=$2 output count
  shift 2
  output=$("$root/scripts/montage" "$@" "$site") || return 1
  count=$(grep -cE "$pattern" <<<"$output" || true)
  [[ $count -eq $expected ]] || printf '%s\nexpected %d lines like %s' "$output" "$expected" "$pattern"
  [[ $count -eq $expected ]]
}

# for_each_photo WHAT FUNCTION: one assertion a photograph.
for_each_photo() {
  local name
  while read -r name; do check "$name, $1" "$2" "$name"; done < <(photo_names "$site")
}

has_montages() {
  local ending
  for ending in exr png jpg; do [[ -s $site/montages/$1.$ending ]] || return 1; done
}

is_photo() { "$COMPARE_IMAGES" identical "$(photo_file "$site" "$1")" "$site/montages/$1.png"; }

is_photo_where_untouched() {
  "$COMPARE_IMAGES" identical "$(photo_file "$site" "$1")" "$site/montages/$1.png" \
    "$site/truth/mask_$1.png"
}

# The truth has no interreflection and the photographs have none either: the model is exact but
# for what survey, JPEG and light samples leave uncertain.
is_near_truth() {
  "$COMPARE_IMAGES" error "$site/montages/$1.png" "$site/truth/after_$1.exr" \
    "$site/truth/before_$1.exr" "$site/truth/mask_$1.png" 0.12
}

rm -rf -- "$site"
check 'the demo site is made' "$INSITU_BIN/insitu-demo-site" "$site"
photos=$(checksums "$site/photos")
check 'the empty site runs' montage_lines '^\[[1-7]/7\] [a-z]+ +[0-9]+\.[0-9] s$' 5 --no-building
for_each_photo 'no building: every pixel is the photograph'\''s' is_photo
check_figures 'reconstruction' /usr/bin/python3 "$tests/demo_figures.py" "$site"
check 'with the building only convert and render run' montage_lines '[0-9] s$' 2
for_each_photo 'exr, png and jpg are there' has_montages
for_each_photo 'untouched pixels are the photograph'\''s' is_photo_where_untouched
for_each_photo 'near the truth' is_near_truth
check 'a second run finds all up to date' montage_lines 'up to date$' 6
check 'another frame renders again' montage_lines '[0-9] s$' 1 --frame pinhole
printf '\n' >>"$site/survey/samples.json"
check 'a changed survey file redoes what depends on it' montage_lines ' light +[0-9.]+ s$' 1
check 'the photographs are as they were' test "$photos" = "$(checksums "$site/photos")"
finish
