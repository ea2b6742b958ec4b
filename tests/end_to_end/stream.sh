#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# insitu render --stream | insitu view -: the picture comes out as it is written, a reader that goes or
# does not read costs the render nothing, a stream that is cut is told.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
site=$temporary/site
cp -r -- "$DEMO_SITE" "$site"
name=$(photo_names "$site" | head -n 1)
render() { "$INSITU_BIN/insitu-render" "$site" --photo "$name" "$1"; }
sums() { (cd "$site" && checksums montages); }
rm -rf -- "$site/montages"
"$INSITU_BIN/insitu-render" "$site" --photo "$name" >/dev/null
expected=$(sums)

# What is computed has the codes of the montage's PNG; the photograph around it comes reduced.
through_the_pipe() {
  render "$1" 2>"$temporary/log" | tee "$temporary/stream" |
    "$INSITU_BIN/insitu-view" - --snapshot "$temporary/newest.ppm" || return 1
  /usr/bin/python3 - "$temporary/newest.ppm" "$site/montages/$name.png" "$(photo_file "$site" "$name")" <<'PYTHON' || return 1
import sys
import cv2
newest, montage, photo = (cv2.imread(path) for path in sys.argv[1:])
computed = cv2.absdiff(montage, photo).max(axis=2) > 8
worst = cv2.absdiff(newest, montage)[computed].max()
print(f"{computed.sum()} computed pixels differ from the PNG by {worst} codes at most")
sys.exit(bool(worst > 1 or computed.sum() < 1000))
PYTHON
  printf '%d bytes\n' "$(stat -c %s "$temporary/stream")"
  grep -q '^'"$name"': building' "$temporary/log"
}
check 'decimal, the snapshot of the finished picture is the montage' through_the_pipe --stream
check 'base64 too' through_the_pipe --stream-base64

a_reader_that_goes() {
  local status
  rm -rf -- "$site/montages"
  set +o pipefail
  render --stream 2>/dev/null | head -c 1000 >/dev/null
  status=${PIPESTATUS[0]}
  set -o pipefail
  [[ $status -eq 0 && $(sums) == "$expected" ]]
}
check 'a reader that goes: the render ends well, with the same bytes' a_reader_that_goes

a_stream_that_is_cut() {
  local status=0 text
  text=$(head -c 300000 "$temporary/stream" | "$INSITU_BIN/insitu-view" - --text --columns 40 2>&1) || status=$?
  [[ $status -eq 2 && $text == *'▀'*'ended after '*' tiles of '"$name"': what is missing is hatched'* ]]
}
check 'a stream that is cut is told, what came of it shown' a_stream_that_is_cut
# A viewer that speaks as tev does holds the montage in the end: as bright as the EXR.
in_tev() {
  /usr/bin/python3 "$tests/tev_viewer.py" "$temporary/port" "$temporary/viewed.json" &
  local viewer=$!
  while [[ ! -s $temporary/port ]] && kill -0 "$viewer"; do sleep 0.05; done
  rm -rf -- "$site/montages"
  "$INSITU_BIN/insitu-render" "$site" --photo "$name" --tev "127.0.0.1:$(<"$temporary/port")" >/dev/null ||
    { kill "$viewer" && return 1; }
  wait "$viewer" || return 1
  [[ $(sums) == "$expected" ]] || return 1
  oiiotool --stats "$site/montages/$name.exr" | grep 'Stats Avg' >"$temporary/stats"
  /usr/bin/python3 - "$temporary/viewed.json" "$temporary/stats" "$name" <<'PYTHON'
import json, sys
viewed = json.load(open(sys.argv[1]))
average = [float(word) for word in open(sys.argv[2]).read().split()[2:5]]
assert viewed['name'] == sys.argv[3], viewed['name']
worst = max(abs(a - b) for a, b in zip(viewed['average'], average))
print(f"{viewed['updates']} updates, averages differ by {worst:.1e}")
sys.exit(bool(worst > 1e-5 or viewed['updates'] < 100))
PYTHON
}
check 'tev sees the montage' in_tev
without_tev() {
  local status=0
  "$INSITU_BIN/insitu-render" "$site" --photo "$name" --tev "127.0.0.1:$(<"$temporary/port")" 2>"$temporary/log" >/dev/null || status=$?
  [[ $status -eq 2 ]] && grep '^--tev: .*Connection refused; start tev there first' "$temporary/log"
}
check 'without tev it is told' without_tev
no_stream() {
  local status=0
  "$INSITU_BIN/insitu-view" - --text <"$site/site.json" 2>"$temporary/log" || status=$?
  [[ $status -eq 2 ]] && grep '^stream:1: does not begin with insitu-stream 1' "$temporary/log"
}
check 'what is no stream is refused by its line' no_stream
finish
