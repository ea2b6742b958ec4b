#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# insitu montage as a driver: what runs again and why, locks, signals, leftovers, verdicts, options of
# stages, programs that do not fit, disks that are full or may not be written.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
site=$temporary/site
cp -a -- "$DEMO_SITE" "$site"
montage() { "$INSITU_BIN/insitu" montage "$site" --no-building "$@"; }

# Stages that ran, in their order.
ran() {
  local output
  output=$(montage "$@") || return $?
  sed -n 's/^\[[0-9]\/[0-9]\] \([a-z-]*\) .* s$/\1/p' <<<"$output" | sort -n | xargs
}
runs() { # EXPECTED [OPTIONS]
  local stages
  stages=$(ran "${@:2}") || return $?
  printf '%s' "$stages"
  [[ $(tr ' ' '\n' <<<"$stages" | sort) == "$(tr ' ' '\n' <<<"$1" | sort)" ]]
}

# fails STATUS PATTERN [OPTIONS]: with such a line on standard error.
fails() {
  local status=0 error
  error=$(montage "${@:3}" 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq $1 ]] && grep -qE "$2" <<<"$error"
}

explains() { # PATTERN [OPTIONS]
  local output
  output=$(montage --explain "${@:2}") || return $?
  grep -E "$1" <<<"$output"
}

leaves_nothing() { [[ -z $(find "$site/work" "$site/montages" -name '.*.[0-9]*' -print) ]]; }

# Starts a run that takes a while, waits until it has the lock, and leaves its process in $run.
start_run() {
  rm -f -- "$site/work/stages/calibrate.json"
  "$INSITU_BIN/insitu" montage "$site" --no-building >/dev/null 2>"$temporary/error" &
  run=$!
  for _ in {1..100}; do
    pgrep -P "$run" >/dev/null && return
    sleep 0.05
  done
  return 1
}

ends_on() { # SIGNAL STATUS
  local status=0
  start_run
  kill "-$1" "$run"
  wait "$run" || status=$?
  printf 'status %d' "$status"
  [[ $status -eq $2 ]] && ! pgrep -f "insitu-calibrate $site" >/dev/null
}

montage >/dev/null
check 'a second run finds all up to date' runs ''
find "$site/survey" "$site/photos" -type f -exec touch {} +
check 'another time of a file is no change' runs ''
mv -- "$site" "$temporary/moved site" && site="$temporary/moved site"
check 'nor is another place' runs ''
printf ' \n' >>"$site/survey/samples.json"
check 'why a stage runs is said' explains \
  '^\[5/7\] light +runs: survey/samples.json has changed$'
check 'results that are the same end it there' runs ''
printf '{"constraints": []}\n' >"$site/survey/constraints.json"
check 'a new file is said' explains 'reconstruct +runs: survey/constraints.json is new'
rm -- "$site/survey/constraints.json"
check 'and one that is gone' explains 'reconstruct +runs: survey/constraints.json is gone'
draw_mask() { # of a polygon, in its photograph: all of it is seen
  /usr/bin/python3 - "$site/survey" <<'PYTHON'
import json, sys
import cv2, numpy
survey = sys.argv[1]
with open(f"{survey}/polygons.json", encoding="utf-8") as file:
    told = json.load(file)
polygon = next(one for one in told["polygons"] if one.get("photo"))
polygon["mask"] = "mask.png"
with open(f"{survey}/polygons.json", "w", encoding="utf-8") as file:
    json.dump(told, file)
height, width = cv2.imread(f"{survey}/../photos/{polygon['photo']}.jpg").shape[:2]
cv2.imwrite(f"{survey}/mask.png", numpy.full((height, width), 255, numpy.uint8))
PYTHON
}
draw_mask
check 'the mask of a polygon is an input of rendering' explains 'render +runs: .*survey/mask.png is new'
rm -- "$site/work/environment.json"
check 'a missing result is made again' explains 'light +runs: work/environment.json is missing'
printf ' ' >>"$site/work/environment.json"
check 'so is one that was altered' \
  explains 'light +runs: work/environment.json is not as it was written'
rm -r -- "$site/work/stages"
check 'without records every stage runs' runs 'calibrate reconstruct undistort light render'
sed -i 's/"insitu" : "/&0.0.1 of /' "$site/work/stages/light.json"
check 'results of another version are made again' explains 'light +runs: insitu is version .*, was 0.0.1'

check 'an option of a stage' explains \
  'reconstruct +runs: its options are --plane-sigma=0.02, were none' --reconstruct.plane-sigma 0.02
check 'which holds' runs '' --reconstruct.plane-sigma=0.02
check 'a flag of a stage before the site' "$INSITU_BIN/insitu" montage \
  --reconstruct.plane-sigma 0.02 --light.uniform-ambient "$site" --no-building
check 'bounces of light are for light and render' explains \
  'light +runs: its options are --bounces=1, were --uniform-ambient' --bounces 1
check 'so is the paper'\''s ambient light' explains \
  'render +runs: its options are .*--paper, were .*--bounces=1' --paper
check 'but not both' fails 2 ': --bounces excludes --paper' --bounces 1 --paper
check 'an unknown option' fails 2 \
  '^--light.bin: insitu-light has no such option, expected one of .*--bins' --light.bin 9
check 'of an unknown stage' fails 2 '^lights: is no stage, expected one of calibrate' --lights.bins 9
check 'a value that is missing' fails 2 '^--light.bins: expected a value after it' --light.bins
check 'a part of the stages' runs 'light' --from light --to light
check 'in the wrong order' fails 2 '^--from: comes after --to' --from render --to light
check 'one after the other' runs 'render' --from render --jobs 1

montage >/dev/null
start_run
check 'a second run is told who has the site' \
  fails 2 ": is in use by insitu-montage SITE --no-building \(process $run on .*; wait"
kill -KILL "$run"
wait "$run" || true
touch -- "$site/work/.scene.1234567.json"
check 'after a killed run the next one goes on' runs 'calibrate'
check 'and removes what it left' leaves_nothing
check 'Ctrl-C ends all' ends_on INT 130
check 'kill ends all' ends_on TERM 143
check 'leaving nothing' leaves_nothing
check 'then the stage runs again' runs 'calibrate'

# A further design, in direct light and one photograph: it has its own results and records.
mkdir -- "$site/variants"
cp -r -- "$site/building" "$site/variants/other"
variant() {
  "$INSITU_BIN/insitu" montage "$site" --variant other --render.photo left --bounces 0 --from convert
}
variant_ran() { variant | sed -n 's/^\[[0-9]\/[0-9]\] \([a-z-]*\) .* s$/\1/p' | xargs; }
check 'a variant is converted and rendered' test "$(variant_ran)" = 'convert render'
check 'to montages of its own' test -s "$site/montages/other/left.png"
check 'once' test -z "$(variant_ran)"
check 'the site'\''s own stay as they are' runs ''
names_variants() {
  local error
  ! error=$("$INSITU_BIN/insitu" montage "$site" --variant othr 2>&1) || return 1
  printf '%s' "$error"
  [[ $error == *'variants: has no folder "othr", expected one of other' ]]
}
check 'a variant that is not there' names_variants

programs=$temporary/programs
cp -r -- "$INSITU_BIN" "$programs"
with_programs() { # STATUS PATTERN
  local status=0 error
  error=$("$programs/insitu" montage "$site" --no-building 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq $1 ]] && grep -qE "$2" <<<"$error"
}
printf '#!/bin/sh\necho insitu-light 0.0.1\n' >"$programs/insitu-light"
check 'a program of another version' with_programs 2 \
  'insitu-light: is insitu-light 0.0.1, expected insitu-light .*; install'
rm -- "$programs/insitu-light"
check 'a program that is missing' with_programs 2 'insitu-light: cannot be run; install'
# shellcheck disable=SC2016 # it is the program that expands them
printf '#!/bin/sh\n[ "$1" = --version ] && echo insitu-light %s || kill -SEGV $$\n' \
  "$("$INSITU_BIN/insitu" --version | cut -d ' ' -f 2)" >"$programs/insitu-light"
chmod +x -- "$programs/insitu-light"
check 'a program that crashes' with_programs 1 'insitu-light was ended by signal 11; what it printed'

# Marks that are said to be eight times as good as they are.
awk -F, -v OFS=, 'NR > 1 { $5 /= 8 } 1' "$DEMO_SITE/survey/observations.csv" \
  >"$site/survey/observations.csv"
check 'a verdict of fail ends the run' fails 1 'insitu-reconstruct: the verdict is fail, see .*report.html'
check 'also when nothing changed' fails 1 'the verdict is fail'
check 'unless it is wanted all the same' montage --despite-fail
repeats_the_verdict() { montage --despite-fail | grep -E '^reconstruct +verdict fail, see '; }
check 'and the verdict is repeated at the end' repeats_the_verdict
cp -- "$DEMO_SITE/survey/observations.csv" "$site/survey/observations.csv"

# A sample of the lawn among those of the concrete.
/usr/bin/python3 - "$site/survey/samples.json" <<'PYTHON'
import json, sys
samples = json.load(open(sys.argv[1]))
samples["daylight"].append(samples["haze"][0])
json.dump(samples, open(sys.argv[1], "w"))
PYTHON
check 'light of two materials ends the run' fails 1 'insitu-light: the verdict is fail, see .*light/report.html'
check 'unless it is wanted' montage --despite-fail
cp -- "$DEMO_SITE/survey/samples.json" "$site/survey/samples.json"

to_the_letter() {
  "$INSITU_BIN/insitu" montage "$site" --paper --no-building >/dev/null || return
  grep -E '^As in Table 1: +Omega_s 0\.0004 sr, k_s [0-9.]+, k_u [0-9.-]+, m_h 2, k_h [0-9.-]+$' \
    "$site/work/stages/light.log"
}
check 'to the letter of the paper, with a row of its table' to_the_letter

# On disks of their own, which only root can make.
if mkdir -- "$temporary/disk" && mount -t tmpfs -o size=3m tmpfs "$temporary/disk" 2>/dev/null; then
  trap 'umount -l "$temporary/disk" 2>/dev/null; rm -rf -- "$temporary"' EXIT
  small() { # STATUS PATTERN
    local status=0 error
    error=$("$INSITU_BIN/insitu" montage "$temporary/disk/site" --no-building 2>&1 >/dev/null) || status=$?
    printf '%s' "$error"
    [[ $status -eq $1 ]] && grep -qE "$2" <<<"$error"
  }
  mkdir -- "$temporary/disk/site"
  cp -r -- "$DEMO_SITE"/{photos,calibration,survey,site.json} "$temporary/disk/site" 2>/dev/null || true
  cat /dev/zero >"$temporary/disk/filled" 2>/dev/null || true
  check 'a full disk' small 2 'work: cannot be written \(No space left on device\)|\.lock: cannot be written'
  rm -- "$temporary/disk/filled"
  mount -o remount,ro "$temporary/disk"
  check 'a disk that may only be read' small 2 'cannot be written \(Read-only file system\)'
else
  printf 'SKIPPED: full and read-only disks, which only root can make\n'
fi
finish
