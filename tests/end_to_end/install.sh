#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake --install puts on a machine: one command for all programs, man pages, completion; nothing
# that needs the source tree.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
prefix=$temporary/usr
build=$(dirname -- "$INSITU_BIN")

installs() { cmake --install "$build" --prefix "$prefix" >/dev/null; }
check 'it installs' installs
insitu=$prefix/bin/insitu

names_no_source() { ! grep -lF -- "$root/" "$prefix"/bin/*; }
check 'programs carry no path of the source tree' names_no_source

has_page() {
  local program
  for program in "$prefix"/bin/*; do
    grep -q '^\.SH OPTIONS\|^\.SH DESCRIPTION' "$prefix/share/man/man1/${program##*/}.1" || return 1
  done
  find "$prefix/share/man/man1" -type f | wc -l
}
check 'each program has a man page' has_page

help_has_stages_in_order() {
  local stages
  stages=$("$insitu" --help | sed -n 's/^  \([a-z-]*\) .*/\1/p' | xargs)
  printf '%s' "$stages"
  [[ $stages == 'calibrate tie-points reconstruct undistort light convert render montage '* ]]
}
check 'insitu --help tells the stages in their order' help_has_stages_in_order

every_command_explains_itself() {
  local command
  for command in $("$insitu" --help | sed -n 's/^  \([a-z-]*\) .*/\1/p'); do
    grep -q "^Usage: insitu-$command" < <("$insitu" "$command" --help) || { printf '%s' "$command" && return 1; }
    [[ $("$insitu" "$command" --version) == "insitu-$command "* ]] || return 1
  done
}
check 'every command explains itself' every_command_explains_itself

takes_a_folder() {
  local command status error
  for command in calibrate tie-points reconstruct undistort light convert render montage; do
    status=0
    error=$("$insitu" "$command" "$temporary/nothing" 2>&1) || status=$?
    [[ $status -ne 2 || $error != "insitu-$command: SITE: "@(Directory|Path)" does not exist"* ]] || continue
    printf '%s: status %d, %s' "$command" "$status" "$error"
    return 1
  done
}
check 'SITE is checked as a folder everywhere' takes_a_folder

refuses_unknown() {
  local status=0 error
  error=$("$insitu" lights 2>&1) || status=$?
  printf '%s' "$error"
  [[ $status -eq 2 ]] && grep -q '^insitu lights: no such command, expected one of calibrate' <<<"$error"
}
check 'an unknown command' refuses_unknown

lists_materials() { (cd / && env -i PATH=/usr/bin:/bin "$insitu" materials | grep brick_red); }
check 'the material library is installed' lists_materials

# complete WORDS...: what is offered for the last word.
complete_words() {
  # shellcheck disable=SC2016 # expanded by the inner shell
  bash -c '
    PATH=$1:$PATH
    source /usr/share/bash-completion/bash_completion
    source "$2"
    COMP_WORDS=(insitu "${@:3}") COMP_CWORD=$(($# - 2)) COMP_LINE="insitu ${*:3}"
    COMP_POINT=${#COMP_LINE}
    _insitu
    printf "%s\n" "${COMPREPLY[@]}"' - "$prefix/bin" \
    "$prefix/share/bash-completion/completions/insitu" "$@" | xargs
}
completes() { # EXPECTED WORDS...
  local offered
  offered=$(complete_words "${@:2}")
  printf '%s' "$offered"
  [[ $offered == "$1" ]]
}
check 'commands complete' completes 'reconstruct render relight' re
check 'options complete' completes '--plane-sigma' reconstruct --plane
check 'options of stages complete' completes '--light.sky-facets' montage --light.sky

site=$temporary/site
cp -a -- "$DEMO_SITE" "$site"
rm -r -- "$site/work" "$site/montages"
runs_elsewhere() {
  cd / && env -i PATH=/usr/bin:/bin "$insitu" montage "$site" --render.photo left >/dev/null
}
check 'the installed programs run on their own' runs_elsewhere
same_bytes() { # as the build's own programs made
  local name first second
  for name in "$site"/montages/left.*; do
    first=$(checksums "$name") second=$(checksums "$DEMO_SITE/montages/${name##*/}")
    [[ ${first%% *} == "${second%% *}" ]] || { printf '%s' "${name##*/}" && return 1; }
  done
  [[ -s $site/montages/left.exr ]]
}
check 'and make the same bytes' same_bytes
finish
