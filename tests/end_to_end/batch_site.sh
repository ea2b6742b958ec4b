# SPDX-License-Identifier: GPL-3.0-or-later
# For scripts of this folder to source: the demo site with a second design, and a plan of 12 jobs.
# shellcheck shell=bash
: "${temporary:?folder}" "${DEMO_SITE:?folder}"

# At $site, the plan at $plan.
make_batch_site() {
  site=$temporary/site plan=$temporary/plan.json
  cp -a -- "$DEMO_SITE" "$site"
  rm -rf -- "$site/montages" "$site/work/render" "$site/work/batch"
  mkdir -p -- "$site/variants"
  cp -a -- "$site/building" "$site/variants/low"
  cat >"$plan" <<'PLAN'
{"comment": "3 views, 2 designs, 2 hours",
 "site": "site",
 "variants": ["building", "low"],
 "hours": ["measured", "17:00"],
 "qualities": ["fast"]}
PLAN
}

# How many pictures of the plan are whole, and how many records tell of it.
pictures() { find "$site/montages" -name '*~fast.png' -type f 2>/dev/null | wc -l; }
records() { find "$site/work" -path '*/stages/batch/*~fast.json' 2>/dev/null | wc -l; }

# Check sums of all pictures.
montages() { checksums "$site/montages"; }
