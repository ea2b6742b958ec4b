#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A model alone, without a site: its description, its report and the page on which it is turned.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
cd -- "$temporary"
mkdir models
printf 'o box\nv 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >models/tent.obj

# holds FILE EXPRESSION: Python's word on the JSON `d` of a file.
holds() {
  /usr/bin/python3 -c 'import json, sys; d = json.load(open(sys.argv[1])); sys.exit(not eval(sys.argv[2]))' "$@"
}

check 'it is converted' "$INSITU_BIN/insitu-convert" models/tent.obj -o out/tent.json --report report.json
check 'its description has 4 triangles' holds out/tent.json 'd["mesh"]["triangles"] == 4'
check 'and its mesh beside it' test -s out/tent.bin
check 'the report has its volume' holds report.json 'abs(d["volume_m3"] - 4) < 1e-9'
check 'nothing is written beside the model' test "$(ls models)" = tent.obj
check 'a preview needs no description' "$INSITU_BIN/insitu-convert" models/tent.obj --preview
check 'its page is in the current folder' test -s tent_preview.html
check 'nothing else is' test "$(echo *)" = 'models out report.json tent_preview.html tent_preview.png'
if [[ -f $INSITU_BIN/../../three/three.min.js || -f $INSITU_BIN/../share/insitu/three/three.min.js ]]; then
  check 'the page holds the building' grep -q 'const BUILDING = {"center":\[1' tent_preview.html
fi
mkdir site rooms
/usr/bin/python3 - >rooms/boxes.obj <<'PYTHON'
print('mtllib boxes.mtl\nusemtl green')
for i in range(30):
    print(f'o Box {i}')
    for corner in range(8):
        print('v', 2 * i + corner % 2, corner // 2 % 2, corner // 4)
    faces = [(0, 1, 5, 4)] if i == 29 else [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    for face in faces:
        print('f', *(8 * i + corner + 1 for corner in face))
PYTHON
printf 'newmtl green\nKd 0.05 0.4 0.05\n' >rooms/boxes.mtl
check 'a row of boxes is converted' "$INSITU_BIN/insitu-convert" rooms/boxes.obj --preview
if [[ -f ${PLAYWRIGHT:=$root/build/playwright-core}/package.json ]]; then
  export PLAYWRIGHT
  check_figures 'turning' node "$tests/preview/turn.mjs" "$temporary/boxes_preview.html" "${SCREENSHOTS:+$SCREENSHOTS/turn.png}"
else
  printf 'SKIPPED: the page in a browser: no playwright-core in %s; scripts/setup --developer fetches it\n' "$PLAYWRIGHT"
fi
refuses() { ! "$@"; }
check '-o is of a model alone' refuses "$INSITU_BIN/insitu-convert" site -o x.json
finish
