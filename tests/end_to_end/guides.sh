#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The commands of the guides print what the guides say; the pictures that they show are there.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
guides=("$root"/{reconstruction/REPORT,renderer/CLAIMS,renderer/prepare/GUIDE}.md)

cp -a -- "$DEMO_SITE" "$temporary/my_site"
commands() { (cd -- "$temporary" && PATH=$INSITU_BIN:$PATH /usr/bin/python3 "$tests/guide_commands.py" "$@"); }
check_figures 'the commands of the guides' commands "${guides[@]:0:2}"

has_its_pictures() {
  local picture
  grep -o '](guide/[^)]*)' -- "$1" | sed 's/](\(.*\))/\1/' | while read -r picture; do
    [[ -s $(dirname -- "$1")/$picture ]] || { printf '%s\n' "$picture"; return 1; }
  done
}
for guide in "${guides[@]}"; do check "$(basename -- "$guide") has its pictures" has_its_pictures "$guide"; done
finish
