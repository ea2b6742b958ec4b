#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# insitu render --layers and --tiff: the montage keeps its bytes, the parts are there, bad names are
# refused with those there are, pictures state how they were made.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
site=$temporary/site
cp -r -- "$DEMO_SITE" "$site"
name=$(photo_names "$site" | head -n 1)
picture=$site/montages/$name

render() { "$INSITU_BIN/insitu-render" "$site" --photo "$name" --quality fast "$@"; }
# refused PATTERN OPTIONS: status 2 and such a line.
refused() {
  local status=0 output
  output=$(render "${@:2}" 2>&1 >/dev/null) || status=$?
  printf '%s' "$output" | head -c 200
  [[ $status -eq 2 ]] && grep -qE -- "$1" <<<"$output"
}
has() { LC_ALL=C grep -aoE -m1 -- "$2" "$1"; }

render >/dev/null
expected=$(cd "$site" && checksums montages)
check 'an unknown layer is refused, with those there are' \
  refused '^--layers: there is no layer "depht", expected all, montage, photo, .*, depth, .*uncertainty' --layers photo,depht
check 'layers of a drawing are refused' refused '^--layers: is of what is rendered' --layers depth --avr 0
check 'nothing is lost by it' diff - <(cd "$site" && checksums montages) <<<"$expected"
check 'no TIFF of a JPEG unless it is asked for' test ! -e "$picture.tif"

render --layers all --tiff >/dev/null
check 'what they add up to is told' has "$picture.parts.exr" 'montage = photo \+ building_sun \+ .* \+ rest \+ rest_fine'
check 'they name things' has "$picture.parts.exr" '"building":"[0-9a-f]{8}"'
keeps_its_bytes() {
  rm -- "$picture.tif"
  mv -- "$picture.parts.exr" "$temporary/parts.exr"
  diff - <(cd "$site" && checksums montages) <<<"$expected"
}
check 'a TIFF is there, too' has "$picture.tif" 'insitu:Parameters'
check 'the JPEG states program, inputs and parameters' \
  has "$picture.jpg" 'insitu:(Program|PhotographSha256|ModelSha256|SurveySha256|Parameters)'
check 'the montage keeps its bytes' keeps_its_bytes
render --layers depth >/dev/null
check 'a choice is smaller' test "$(stat -c %s "$picture.parts.exr")" -lt "$(stat -c %s "$temporary/parts.exr")"
render >/dev/null
check 'without --layers those of an earlier run go' test ! -e "$picture.parts.exr"
finish
