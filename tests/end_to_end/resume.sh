#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A render that ends by kill -9, Ctrl-C or a full disk goes on where it was, to the same bytes.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
site=$temporary/site
cp -r -- "$DEMO_SITE" "$site"
name=$(photo_names "$site" | head -n 1)
partial=$site/work/render/$name.partial

layers=() # options
render() { "$INSITU_BIN/insitu-render" "$site" --photo "$name" "${layers[@]}"; }
# The light that the first render keeps stays: what is begun anew are pictures.
anew() {
  rm -rf -- "$site/montages"
  rm -f -- "$site"/work/render/*.partial
}

# Begun in the background, then signalled as soon as some tiles are kept: $1 signal, $2 bytes.
render_until() {
  local pid status=0
  # Not by the function, whose shell would be signalled.
  "$INSITU_BIN/insitu-render" "$site" --photo "$name" "${layers[@]}" >"$temporary/log" 2>&1 &
  pid=$!
  while kill -0 "$pid" 2>/dev/null && [[ $(stat -c %s "$partial" 2>/dev/null || echo 0) -lt $2 ]]; do sleep 0.02; done
  kill "-$1" "$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || status=$?
  return "$status"
}

anew && render >/dev/null
expected=$(cd "$site" && checksums montages)
check 'nothing is left of a render that has ended' test ! -e "$partial"

# Each run is killed when it has kept a bit more than the one before.
killed_again_and_again() {
  local kills=0 kept=0 size
  anew
  while [[ $kills -lt ${KILLS:-20} ]]; do
    render_until KILL $((kept + 1 + RANDOM * 4)) && break
    kills=$((kills + 1))
    size=$(stat -c %s "$partial" 2>/dev/null || echo 0)
    [[ $size -ge $kept && ! -e $site/montages/$name.exr ]] || { echo "kept $size bytes after $kept" && return 1; }
    kept=$size
  done
  render >/dev/null || return 1
  [[ $(cd "$site" && checksums montages) == "$expected" && $kills -gt 2 ]] || return 1
  echo "$kills kills"
}
check 'killed again and again: the same bytes in the end' killed_again_and_again

stops_in_order() {
  local status=0
  anew
  render_until TERM 40000 || status=$?  # SIGINT is ignored by what a script starts with &
  [[ $status -eq 3 ]] && grep '^stopped: [0-9]* of [0-9]* tiles of .* are kept' "$temporary/log"
}
check 'a signal as of Ctrl-C ends it with status 3 and tells how far it was' stops_in_order
goes_on() { render >/dev/null && [[ $(cd "$site" && checksums montages) == "$expected" ]]; }
check 'then it goes on to the same bytes' goes_on

goes_on_with_its_layers() {
  local status=0 parts=$site/montages/$name.parts.exr whole=$temporary/whole.parts.exr
  layers=(--layers "depth,building_sun,object")
  anew
  render >/dev/null && mv -- "$parts" "$whole" || return 1
  anew
  render_until KILL 400000 || status=$?
  [[ $status -eq 137 && -s $partial && ! -e $parts ]] || return 1
  render >/dev/null || return 1
  cmp -- "$parts" "$whole"
  status=$?
  layers=()
  return "$status"
}
check 'so do the layers that were chosen' goes_on_with_its_layers

two_at_a_time() {
  local pid output status=0
  anew
  "$INSITU_BIN/insitu-render" "$site" --photo "$name" >/dev/null 2>&1 &
  pid=$!
  while [[ ! -s $partial ]]; do sleep 0.02; done
  kill -STOP "$pid" # else it may have ended before the other has begun
  output=$(render 2>&1) || status=$?
  kill -CONT "$pid"
  wait "$pid"
  [[ $status -ne 0 ]] || return 1
  [[ $output == *'another program is rendering this picture'* ]]
}
check 'two programs do not render one picture at a time' two_at_a_time

# On a disk of its own, which only root can make.
if mkdir -- "$temporary/disk" && mount -t tmpfs -o size=80m tmpfs "$temporary/disk" 2>/dev/null; then
  trap 'umount -l "$temporary/disk" 2>/dev/null; rm -rf -- "$temporary"' EXIT
  anew
  rm -rf -- "$site/work/render" # its light alone would fill the disk
  cp -r -- "$site"/{photos,survey,building,work} "$temporary/disk"
  full=$temporary/disk
  fill() { head -c "$(($(df --output=avail -B1 "$full" | tail -n 1) - $1))" /dev/zero >"$full/filled"; }
  full_disk() {
    local output status=0
    fill 200000
    output=$("$INSITU_BIN/insitu-render" "$full" --photo "$name" 2>&1) || status=$?
    [[ $status -eq 1 && $output == *'No space left on device'*'tiles of'*'are kept'* && ! -e $full/montages/$name.exr ]] ||
      { echo "$output" && return 1; }
    rm -- "$full/filled"
    "$INSITU_BIN/insitu-render" "$full" --photo "$name" >/dev/null
    [[ $(cd "$full" && checksums montages) == "$expected" ]]
  }
  check 'a full disk is told, and with room it goes on to the same bytes' full_disk
else
  printf 'SKIPPED: a full disk, which only root can make\n'
fi
finish
