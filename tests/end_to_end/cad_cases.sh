#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The cases of public reports on CAD files, each with its expected value. The data is no part of this repository:
# INSITU_SHARED names its folder, else ../shared is tried.
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
shared=${INSITU_SHARED:-$(dirname -- "$root")/shared}
if [[ ! -d $shared/data/cases/cad ]]; then
  printf 'SKIPPED: no shared data in %s\n' "$shared"
  exit 77
fi
while IFS= read -r line; do
  check "${line#*: }" test "${line%%: *}" = ok
done < <(/usr/bin/python3 "$tests/cad_cases.py" "$shared" "$INSITU_BIN/insitu-convert" "$temporary" ||
  printf 'FAIL: cad_cases.py ends with an error\n')
finish
