#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# insitu batch by Slurm, on a cluster of this machine alone that the test starts: 12 jobs as an array, one
# killed in the middle and one cancelled; the next run does what is left, nothing twice, and the pictures
# are those of a run without Slurm.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
# shellcheck source=batch_site.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/batch_site.sh"
# shellcheck source=one_node_slurm.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/one_node_slurm.sh"
PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch squeue scancel; do
  command -v "$program" >/dev/null && continue
  echo "SKIPPED: no $program here (Debian packages slurm-wlm and munge)"
  exit 77
done
trap 'stop_slurm; rm -rf -- "$temporary"' EXIT
if ! start_slurm "$temporary/slurm"; then
  echo 'SKIPPED: a Slurm cluster of this machine does not come up:'
  tail -n 3 "$temporary"/slurm/*.out "$temporary"/slurm/*.log
  exit 77
fi
make_batch_site
batch() { "$INSITU_BIN/insitu" batch "$plan" "$@"; }
submit() { batch --engine slurm --threads 1; }
array_of() { sed -n 's/.*"array" : "\([0-9]*\)".*/\1/p' "$site/work/batch/plan/slurm.json"; }
waits() { SECONDS_TO_WAIT=${1:-600} wait_for is_queue_empty; }

submitted() { submit | grep -E 'array [0-9]+: 12 tasks submitted'; }
check 'an array of 12 tasks is submitted' submitted

refuses_twice() {
  local status=0 error
  error=$(submit 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 && $error == *"is still in Slurm's queue"* ]]
}
check 'while it is in the queue it is not submitted again' refuses_twice

# Kills the render of a task that has kept some tiles.
kills_a_render() {
  local end=$((SECONDS + 300)) partial=
  until [[ -n $partial ]]; do
    [[ $SECONDS -lt $end ]] || return 1
    partial=$(find "$site/work" -name '*.partial' -size +8k | head -n 1)
    sleep 0.02
  done
  local render
  render=$(pgrep -n -f "insitu-render $site ")
  [[ -n $render ]] && kill -9 "$render" && echo "${partial##*/} of process $render"
}
check 'one of its renders is killed in the middle' kills_a_render
has_a_picture() { [[ $(pictures) -ge 1 ]]; }
cancels_some() {
  SECONDS_TO_WAIT=300 wait_for has_a_picture || return 1
  scancel "$(array_of)_11" "$(array_of)_10"
}
check 'two tasks are cancelled' cancels_some
check 'the array comes to its end' waits
left=$((12 - $(pictures)))
check 'some pictures are missing' test "$left" -ge 1 -a "$left" -le 4
has_sheet() { grep -c '<figure' "$site/montages/plan.sheet.html"; }
check 'the contact sheet came after it' test "$(has_sheet)" = 12

submits_the_rest() { submit | grep -E "array [0-9]+: $left tasks? submitted|: $left tasks submitted"; }
check 'the next run submits what is left' submits_the_rest
check 'which is done' waits
check 'all pictures are there' test "$(pictures)" = 12
by_slurm=$(checksums "$site/montages" | grep -v sheet)
nothing() { submit | grep '12 of 12 pictures are there'; }
check 'then nothing is submitted' nothing

rm -rf -- "$site/montages" "$site/work/stages/batch" "$site/work/variants/low/stages/batch"
batch >/dev/null
check 'without Slurm the pictures are the same' test "$by_slurm" = "$(checksums "$site/montages" | grep -v sheet)"

changes_meanwhile() {
  local status=0 error
  echo '{}' >"$site/survey/foreground.json"
  mkdir -p "$site/survey/shadows" && cp "$site"/photos/left.* "$site/survey/shadows/left.png" 2>/dev/null
  error=$("$INSITU_BIN/insitu-batch" "$plan" --job 0 2>&1 >/dev/null) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 && $error == *'survey/shadows/left.png is new; run insitu-batch again'* ]]
}
check 'a task whose inputs changed since it was laid out is refused' changes_meanwhile

finish
