#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `insitu new`: what it writes fits the schemas that it writes beside, as do the demo site and the examples of
# FILES.md, and what is wrong does not.
# shellcheck disable=SC2317 # the functions are called through check
set -euo pipefail
# shellcheck source=assertions.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/assertions.sh"
if ! /usr/bin/python3 -c 'import jsonschema' 2>/dev/null; then
  printf 'SKIPPED: no python3-jsonschema\n'
  exit 77
fi

# fits SCHEMA FILE: prints the first thing that does not.
fits() {
  /usr/bin/python3 - "$site/schemas/$1.schema.json" "$2" <<'PYTHON'
import json, sys, jsonschema
schema, data = (json.load(open(path)) for path in sys.argv[1:])
jsonschema.Draft7Validator.check_schema(schema)
faults = sorted(jsonschema.Draft7Validator(schema).iter_errors(data), key=str)
if faults: sys.exit(faults[0].message)
PYTHON
}

fits_not() { ! fits "$@"; }

# example FILE: its example in FILES.md.
example() { awk -v head="## \`$1\`" '$0 == head { on = 1 } on && /^```$/ { exit } on && code { print } on && /^```./ { code = 1 }' \
  "$root/reconstruction/FILES.md"; }

site="$temporary/new site"
check 'a new site' "$INSITU_BIN/insitu-new" "$site" --photos "$DEMO_SITE/photos"
for name in polygons directions constraints samples materials; do
  check "template of $name" fits "$name" "$site/survey/$name.json"
  example "survey/$name.json" >"$temporary/$name.json"
  check "example of $name" fits "$name" "$temporary/$name.json"
  [[ ! -e $DEMO_SITE/survey/$name.json ]] ||
    check "demo site's $name" fits "$name" "$DEMO_SITE/survey/$name.json"
  sed 's/"\(vertices\|object\|value_m\|photo\|ior\)"/"wrong"/; s/"specular": "fresnel"/"specular": "no"/' \
    "$temporary/$name.json" >"$temporary/wrong.json"
  check "a fault in $name" fits_not "$name" "$temporary/wrong.json"
done
example building/objects.json >"$temporary/objects.json"
check 'example of objects' fits objects "$temporary/objects.json"
sed 's/"radius_m": 0.5/"radius_m": 0/' "$temporary/objects.json" >"$temporary/wrong.json"
check 'a fault in objects' fits_not objects "$temporary/wrong.json"
check 'template of site' fits site "$site/site.json"
example site.json >"$temporary/site.json"
check 'example of site' fits site "$temporary/site.json"
check "demo site's site" fits site "$DEMO_SITE/site.json"
finish
