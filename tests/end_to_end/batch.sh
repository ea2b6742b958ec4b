#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# insitu batch on this machine: 12 jobs in the light of the photographs and of another hour, stopped,
# killed and gone on with, nothing twice, the same bytes; what changes runs again and nothing else; the
# contact sheet; GNU parallel; plans that cannot be.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
# shellcheck source=batch_site.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/batch_site.sh"
make_batch_site

batch() { "$INSITU_BIN/insitu" batch "$plan" "$@"; }

# batch_says STATUS PATTERN [OPTIONS]: it ends so, with such a line on one of its streams.
batch_says() {
  local status=0 output
  output=$(batch "${@:3}" 2>&1) || status=$?
  grep -E -m1 "$2" <<<"$output" || printf '%s' "$output"
  [[ $status -eq $1 ]] && grep -qE "$2" <<<"$output"
}

# Begun in the background; ended by signal $1 once $2 pictures are there.
batch_until() {
  local pid status=0
  "$INSITU_BIN/insitu" batch "$plan" >"$temporary/log" 2>&1 &
  pid=$!
  until [[ $(pictures) -ge $2 ]] || ! kill -0 "$pid" 2>/dev/null; do sleep 0.05; done
  kill "-$1" "$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || status=$?
  printf '%d pictures, status %d' "$(pictures)" "$status"
  return "$status"
}

stops_by_a_signal() {
  local status=0
  batch_until TERM 3 || status=$?
  [[ $status -eq 143 && $(pictures) -lt 12 ]]
}
check 'a signal ends it with its status, in the middle' stops_by_a_signal
check 'no picture is without its record but the one at work' test "$(pictures)" -le $(($(records) + 1))

is_killed() {
  local status=0
  batch_until KILL $(($(pictures) + 2)) || status=$?
  while pgrep -f -- "$site" >/dev/null; do sleep 0.1; done # what it had begun ends by itself
  [[ $status -eq 137 && $(pictures) -lt 12 ]]
}
check 'kill -9 ends it, too' is_killed
before=$(records)
goes_on() {
  local output
  output=$(batch) || return 1
  [[ $(grep -c 'done  [0-9.]* s$' <<<"$output") -eq $((12 - before)) ]] || return 1
  [[ $(grep -c '  done already$' <<<"$output") -eq $before && $(pictures) -eq 12 ]] &&
    echo "$before were done, $((12 - before)) are added"
}
check 'the next run does the rest and nothing twice' goes_on
first=$(montages)
check 'then nothing is to do' batch_says 0 '^12 jobs, 12 of them done already$'
check 'and nothing has changed' diff - <(montages) <<<"$first"

is_one_render() {
  "$INSITU_BIN/insitu-render" "$site" --photo left --variant low --quality fast >/dev/null
  cmp "$site/montages/low/left.exr" "$site/montages/low/left~fast.exr"
}
check 'a job is what insitu render makes' is_one_render

# ---- another hour ----------------------------------------------------------------------------------

states() { # FILE PATTERN
  grep -oE -m1 "$2" < <(strings -n 8 "$1") # a pipe would end strings, and count as failed
}
check 'pictures of another hour say that they are a simulation' \
  states "$site/montages/left@1700~fast.jpg" "simulated daylight, not the photograph's: 2024-05-15T17:00"
has_no_such_word() { ! states "$site/montages/left~fast.jpg" 'simulated'; }
check 'those of the photograph do not' has_no_such_word
check 'a quick look says that it is one' states "$site/montages/left~fast.jpg" 'insitu:Quality[^/]*fast'
sheet=$site/montages/plan.sheet.html
marks_simulations() { [[ $(grep -c 'class="simulation"' "$sheet") -eq 6 && $(grep -c '<img ' "$sheet") -eq 12 ]]; }
check 'the contact sheet shows 12 pictures and marks 6 of them' marks_simulations

# ---- what changed ----------------------------------------------------------------------------------

printf '{"rotation_deg": 3}\n' >"$site/variants/low/note.json"
changed() { batch --explain | grep -c ' runs: .*variants/low/note.json is new'; }
check 'a changed design is rendered anew, and no other' test "$(changed)" = 6

# ---- failures --------------------------------------------------------------------------------------

rm -f -- "$site"/montages/left~fast.* "$site"/montages/right~fast.*
fails_and_goes_on() {
  # A folder where the picture should be: the job fails, the others go on.
  mkdir -- "$site/montages/left~fast.png"
  batch_says 1 'left~fast +failed \(status 1\)'
}
check 'a job that fails is told, with status 1' fails_and_goes_on
check 'the others are done' test -s "$site/montages/right~fast.png"
check 'the sheet tells it' grep -q '<b>failed:</b> failed (status 1)' "$sheet"
rmdir -- "$site/montages/left~fast.png"
check 'when the reason is gone it is done' batch_says 0 '12 of 12 pictures are there'

# ---- other engines ---------------------------------------------------------------------------------

rm -f -- "$site"/montages/*~fast.* "$site"/montages/low/*~fast.*
check 'an OpenJD template has the tasks' batch_says 0 'openjd.json: 12 tasks; .*no farm' --engine openjd
if parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  check 'GNU parallel does them' batch_says 0 '12 of 12 pictures are there' --engine parallel --jobs 2 --threads 1
else
  echo 'SKIPPED: no GNU parallel here (Debian package parallel)'
fi
no_program() { PATH=$temporary/none batch_with "$1"; }
batch_with() {
  local status=0 error
  error=$("$INSITU_BIN/insitu-batch" "$plan" --engine "$1" 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 && $error == *"--engine $1: there is no"*install* ]]
}
rm -f -- "$site"/montages/low/left~fast.*
check 'without Slurm it says so' no_program slurm
check 'without GNU parallel it says so' no_program parallel

# ---- plans that cannot be --------------------------------------------------------------------------

refuses_plan() { # TEXT PATTERN
  local status=0 error before
  before=$(montages)
  printf '%s' "$1" >"$temporary/bad.json"
  error=$("$INSITU_BIN/insitu-batch" "$temporary/bad.json" 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 && $error != *$'\n'* && $error == *$2* && $before == "$(montages)" ]]
}
at='"site": "site"'
check 'a missing variant' refuses_plan "{$at, \"variants\": [\"towr\"]}" "is \"towr\", no variant, expected one of building, low"
check 'a missing photograph' refuses_plan "{$at, \"views\": [\"lfet\"]}" 'no photograph'
check 'a missing quality' refuses_plan "{$at, \"qualities\": [\"best\"]}" 'no quality'
check 'a damaged plan' refuses_plan "{$at, \"views\": [\"le" 'bad.json:1'
check 'an empty plan' refuses_plan '' 'bad.json'
check 'an empty list' refuses_plan "{$at, \"views\": []}" 'is empty'
check 'an hour of night' refuses_plan "{$at, \"hours\": [\"23:30\"]}" 'above the horizon'
check 'an hour that is none' refuses_plan "{$at, \"hours\": [\"noon\"]}" 'no time'
check 'a job that there is not' batch_says 2 'has no job 12, expected 0 to 11' --job 12
echo '{"view": 1}' >"$site/work/batch/plan/jobs.jsonl"
check 'damaged jobs' batch_says 2 'jobs.jsonl:1: is no job as insitu-batch writes it' --job 0

finish
