#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Bad input: status 2, one line on stderr that names file and line, nothing half-written.
# shellcheck disable=SC2016,SC2317 # awk has $ of its own; the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"

# edit_json FILE STATEMENT: runs a Python statement on `data`, the content of survey/FILE.
edit_json() {
  /usr/bin/python3 - "$site/survey/$1" "$2" <<'PYTHON'
import json, sys
path, statement = sys.argv[1:]
data = json.load(open(path))
exec(statement)
json.dump(data, open(path, 'w'), indent=1)
PYTHON
}

# last_line FILE: the number of its last line.
last_line() { awk 'END { print NR }' "$1"; }

survey() { printf '%s' "$site/survey/$1"; }

fresh_site
photo=$(photo_file "$site" "$(photo_names "$site" | head -n 1)")
name=$(photo_names "$site" | head -n 1)
rm -- "$photo"
check 'missing photo' refuses reconstruct 'survey/[a-z_]+\.(csv|json):[0-9]+: '

fresh_site
halve "$photo"
check 'unreadable photo, light' refuses light "photos/$name\.[a-z]+: "
check 'unreadable photo, undistort' refuses undistort "photos/$name\.[a-z]+: "
check 'unreadable photo, render' refuses render "photos/$name\.[a-z]+: "

fresh_site
printf '%s,towre_1,100.0,100.0,0.3\n' "$name" >>"$(survey observations.csv)"
sed -i "/^$name,tower_1,/d" "$(survey observations.csv)"
check 'unknown point near to a known one' refuses reconstruct \
  "survey/observations\.csv:$(last_line "$(survey observations.csv)"): .*did you mean 'tower_1'\?"

fresh_site
awk -F, -v OFS=, 'NR > 3 { $8 = "check" } 1' "$DEMO_SITE/survey/control_points.csv" \
  >"$(survey control_points.csv)"
check 'two control points' refuses reconstruct 'survey/[a-z_]+\.csv:[0-9]+: '

fresh_site
awk -F, -v OFS=, 'NR > 1 { $2 = 2600500 + NR; $3 = 1200300 + 2 * NR; $4 = 430 } 1' \
  "$DEMO_SITE/survey/control_points.csv" >"$(survey control_points.csv)"
check 'collinear control' refuses reconstruct 'survey/[a-z_]+\.csv:[0-9]+: .*line'

fresh_site
edit_json polygons.json 'del data["polygons"][1]["vertices"][2:]'
check 'polygon with two vertices' refuses reconstruct 'survey/polygons\.json:[0-9]+: '

fresh_site
edit_json polygons.json \
  'p = data["polygons"]; q = next(q for q in p[1:] if len(q["vertices"]) == 4 and
   not set(q["vertices"]) & set(p[0]["vertices"])); p[0]["vertices"] += q["vertices"][2:3]'
check 'polygon far from planar' refuses reconstruct 'survey/polygons\.json:[0-9]+: '

fresh_site
sed -i '3s/,[^,]*/,nan/' "$(survey control_points.csv)"
check 'NaN in a coordinate' refuses reconstruct 'survey/control_points\.csv:3: '

fresh_site
sed -i '4s/\(,[^,]*\),[^,]*/\1,nan/' "$(survey observations.csv)"
check 'NaN in a mark' refuses reconstruct 'survey/observations\.csv:4: '

# What surveyors mix up: each is told with its remedy.
# edit_table FILE STATEMENT: an awk statement on each row of survey/FILE but its header.
edit_table() {
  awk -F, -v OFS=, -v CONVFMT=%.14g "NR > 1 { $2 } 1" "$DEMO_SITE/survey/$1" >"$(survey "$1")"
}

# line_of FILE PATTERN: the number of the first line of survey/FILE that matches.
line_of() { grep -n -m 1 -- "$2" "$(survey "$1")" | cut -d: -f1; }

fresh_site
edit_table control_points.csv 't = $2; $2 = $3; $3 = t'
check 'control with x and y exchanged' refuses reconstruct \
  'survey/control_points\.csv:2: .*left-handed.*x and y are exchanged.*as given, to [0-9.]+ px'

fresh_site
edit_table control_points.csv '$2 = -$2'
check 'control of the other hand' refuses reconstruct \
  'survey/control_points\.csv:2: .*left-handed.*an axis counts backwards'

fresh_site
edit_table control_points.csv '$4 = $4 / 0.3048'
check 'heights in feet' refuses reconstruct \
  'survey/control_points\.csv:2: z of the control points in feet'

fresh_site
edit_table observations.csv 't = $3; $3 = $4; $4 = t'
check 'marks with x and y exchanged' refuses reconstruct \
  "survey/observations\.csv:2: the marks' x and y are exchanged"

fresh_site
height=$(oiiotool --info "$photo" | sed 's/.* x *\([0-9]*\),.*/\1/')
edit_table observations.csv "\$4 = $height - 1 - \$4"
check 'marks counted from the bottom' refuses reconstruct \
  "survey/observations\.csv:2: the marks' y is counted from the bottom"

fresh_site
edit_table control_points.csv 'for (i = 2; i <= 7; ++i) $i *= 1000'
printf 'photo,x,y,z,sigma_x,sigma_y,sigma_z,role\n' >"$(survey camera_positions.csv)"
/usr/bin/python3 - "$site/truth/truth.json" "$name" >>"$(survey camera_positions.csv)" <<'PYTHON'
import json, sys
path, photo = sys.argv[1:]
print(photo, *json.load(open(path))['photos'][photo]['center'], 0.02, 0.02, 0.02, 'weighted', sep=',')
PYTHON
check 'millimetres for metres, a camera position tells' refuses reconstruct \
  'survey/camera_positions\.csv:2: .*control points in millimetres'

fresh_site
edit_table control_points.csv 'for (i = 2; i <= 7; ++i) $i *= 1000'
asks_for_millimetres() {
  "$INSITU_BIN/insitu-reconstruct" "$site" 2>&1 |
    grep 'control_points.csv:2: .*are these in millimetres?'
}
check 'millimetres for metres, nothing tells: a question' asks_for_millimetres

fresh_site
edit_table control_points.csv 'for (i = 2; i <= 4; ++i) $i *= 1000'
check 'millimetres for metres, but not of sigmas' refuses reconstruct \
  'survey/control_points\.csv:2: .*are these in millimetres\?'

fresh_site
edit_table control_points.csv 'if ($1 == "tower_1") for (i = 2; i <= 4; ++i) $i *= 1000'
check 'one control point in millimetres' refuses reconstruct \
  "survey/control_points\.csv:3: .*'tower_1' lies .*are they in millimetres\?"

# warns PATTERN: insitu-reconstruct takes $site, but with a warning like that.
warns() { "$INSITU_BIN/insitu-reconstruct" "$site" 2>&1 | grep -E "^warning: .*$1"; }

fresh_site
printf '%s,no_such_point,100.0,100.0,0.3\n' "$name" >>"$(survey observations.csv)"
check 'a point of one mark is left out by name' warns \
  "observations\.csv:[0-9]+: point 'no_such_point': one ray only, .*left out"
left_out_in_report() {
  /usr/bin/python3 - "$site/work/reconstruction/report.json" <<'PYTHON'
import json, sys
verdict = json.load(open(sys.argv[1]))['verdict']
told = [one for one in verdict['reasons'] if 'no_such_point' in str(one)]
sys.exit(0 if verdict['status'] == 'review' and len(told) == 1 else str(verdict))
PYTHON
}
check 'its report says so, to be reviewed' left_out_in_report

fresh_site
edit_table control_points.csv 'if ($1 == "tower_1") $1 = "toewr_1"'
check 'a control point misspelt' warns "toewr_1.*did you mean 'tower_1'\?"

fresh_site
edit_table control_points.csv 'if ($1 == "tower_1") $1 = "Q17"'
check 'a control point under another name' warns \
  "'Q17' is marked on no photo, and point 'tower_1', [0-9]+ mm from it"

fresh_site
semicolons_are_read() {
  local commas
  commas=$("$INSITU_BIN/insitu-reconstruct" "$site") || return 1
  sed -i 's/,/;/g' "$(survey control_points.csv)"
  [[ $("$INSITU_BIN/insitu-reconstruct" "$site") == "$commas" ]]
}
check 'semicolons between columns are read as commas are' semicolons_are_read

fresh_site
find "$site/calibration" -name 'board_*' | sort | tail -n +2 | xargs -d '\n' rm --
# The corners found so far are new in work/, the lens is not.
keeps_the_lens() {
  local lens=work/calibration/camera.cameramodel message status=0
  message=$("$INSITU_BIN/insitu-calibrate" "$site" 2>&1) || status=$?
  printf '%s' "${message//"$site/"/}"
  [[ $status -eq 2 && $message =~ "calibration: whole boards found in 1 of 1 photos, expected at least 3"
    && $message =~ 'a lens needs 20 to 40' ]] && cmp -- "$DEMO_SITE/$lens" "$site/$lens"
}
check 'a board folder with one photo' keeps_the_lens

fresh_site
rm -- "$site/calibration/board.txt"
check 'board photos without board.txt' refuses calibrate \
  'calibration/board\.txt: no such file, expected it beside the board photos'

fresh_site
edit_table control_points.csv 'if ($1 ~ /^tower_[01]$/) $1 = $1 == "tower_0" ? "tower_1" : "tower_0"'
check 'two control points exchanged' refuses reconstruct \
  "survey/control_points\.csv:2: points 'tower_1' and 'tower_0' .*exchanged"

fresh_site
edit_table observations.csv "if (\$1 == \"$name\" && \$2 ~ /^tower_[01]\$/)
  \$2 = \$2 == \"tower_0\" ? \"tower_1\" : \"tower_0\""
check 'two marks exchanged' refuses reconstruct \
  "survey/observations\.csv:[0-9]+: .*exchanged on this photo; did you mean 'tower_[01]'"

fresh_site
sed -i "s/^$name,tower_0,/$name,Tower 0,/" "$(survey observations.csv)"
check 'a name misspelt' refuses reconstruct \
  "survey/observations\.csv:$(line_of observations.csv 'Tower 0'): .*did you mean 'tower_0'\?"

fresh_site
edit_table control_points.csv 'if (NR % 3 == 0) { $2 -= 2000000; $3 -= 1000000 }'
check 'two coordinate systems' refuses reconstruct \
  'survey/control_points\.csv:3: the control points are in two coordinate systems'

fresh_site
sed -i '4s/^\([^,]*,[^,]*\),[^,]*/\1,1e9/' "$(survey observations.csv)"
check 'a mark at 1e9 pixels' refuses reconstruct \
  'survey/observations\.csv:4: x is 1e9, expected a pixel position'

fresh_site
cp -- "$photo" "$site/photos/twin.jpg"
check 'a photo twice' refuses reconstruct \
  "photos/[a-z]+\.jpg: is the same photograph as '[a-z]+\.jpg'"

fresh_site
printf '{"constraints": [\n{"kind": "distance", "points": ["tower_0", "tower_1"], "value_m": 1}]}\n' \
  >"$(survey constraints.json)"
check 'a constraint without sigma' refuses reconstruct 'survey/constraints\.json:2: .*sigma_m'

fresh_site
edit_json samples.json 'data["haze"][0].update(data["horizon"][0])'
check 'haze sample on the sky' refuses light 'survey/samples\.json:[0-9]+: '

fresh_site
edit_json samples.json 'data["daylight"][0]["x"] = float("nan")'
check 'NaN in a sample' refuses light 'survey/samples\.json:[0-9]+: '

fresh_site
drawing=$(find "$site/building" -name '*.dxf' | head -n 1)
halve "$drawing"
check 'drawing cut in half' refuses convert "building/${drawing##*/}:[0-9]+: "

for program in calibrate reconstruct undistort light convert render; do
  site=$temporary/empty
  mkdir -p -- "$site"
  check "empty folder, $program" refuses "$program" '[a-z]+'
  check "empty folder, $program: it stays empty" test -z "$(ls -A -- "$site")"
done

montage_status() {
  local status=0
  "$root/scripts/montage" "$@" || status=$?
  [[ $status -eq 2 ]]
}
check 'montage of no folder' montage_status "$temporary/nothing"
check 'montage in an unknown frame' montage_status --frame sideways "$DEMO_SITE"
fresh_site
halve "$drawing"
check 'montage stops with its program'\''s status' montage_status "$site"
finish
