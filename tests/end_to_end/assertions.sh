# SPDX-License-Identifier: GPL-3.0-or-later
# For the scripts of this folder to source: each assertion prints a line with its figure.
# shellcheck shell=bash
# The caller's environment, set by CMakeLists.txt:
: "${INSITU_BIN:?folder of the programs}" "${COMPARE_IMAGES:?program}" "${DEMO_SITE:?folder}"
export LC_ALL=C.UTF-8
tests=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
root=$(dirname -- "$(dirname -- "$tests")")
export tests root
failures=0
temporary=$(mktemp -d)
trap 'rm -rf -- "$temporary"' EXIT

# check WHAT COMMAND...: the command's status decides; its output is shown, and what is slow.
check() {
  local what=$1 output result=ok start=$SECONDS slow=''
  shift
  output=$("$@" 2>&1) || result=FAIL
  [[ $result == ok ]] || failures=$((failures + 1))
  [[ $((SECONDS - start)) -lt 5 ]] || slow=" [$((SECONDS - start)) s]"
  printf '%-4s %s%s%s\n' "$result" "$what" "$slow" "${output:+: $output}"
}

# finish: the script's status, 1 if any assertion failed.
finish() {
  [[ $failures -eq 0 ]] || printf '%d assertions failed\n' "$failures"
  exit $((failures > 0))
}

# Check sums of every file below the folders that exist, to see whether anything changed.
checksums() { find "$@" -type f -print0 2>/dev/null | sort -z | xargs -0r sha256sum; }

# Names of a site's photographs, without the ending.
photo_names() { find "$1/photos" -type f -printf '%f\n' | sed 's/\.[^.]*$//' | sort; }

# The photograph of a site with this name.
photo_file() { find "$1/photos" -name "$2.*"; }

# check_figures WHAT COMMAND...: one assertion for each line "ok: ..." or "FAIL: ..." it prints.
check_figures() {
  local what=$1 line start=$SECONDS
  shift
  while IFS= read -r line; do
    check "$what, ${line#*: }" test "${line%%: *}" = ok
  done < <("$@" || printf 'FAIL: %s ends with an error\n' "${2##*/}")
  [[ $((SECONDS - start)) -lt 5 ]] || printf '     %s took %d s\n' "$what" $((SECONDS - start))
}

# fresh_site: a copy of the demo site with all its results, at $site.
fresh_site() {
  site=$temporary/site
  rm -rf -- "$site"
  cp -a -- "$DEMO_SITE" "$site"
}

# refuses PROGRAM PATTERN: insitu-PROGRAM refuses $site, its one line of stderr matches PATTERN
# after the site's path, and no result is changed.
refuses() {
  local program=$1 pattern=$2 status=0 message before
  before=$(checksums "$site/work" "$site/montages")
  message=$("$INSITU_BIN/insitu-$program" "$site" 2>&1 >/dev/null) || status=$?
  printf '%s' "${message//"$site/"/}"
  [[ $status -eq 2 && $message != *$'\n'* && $message =~ ^"$site"/$pattern &&
    $before == "$(checksums "$site/work" "$site/montages")" ]]
}

# halve FILE: cuts it in the middle.
halve() { truncate -s $(($(stat -c %s -- "$1") / 2)) -- "$1"; }
