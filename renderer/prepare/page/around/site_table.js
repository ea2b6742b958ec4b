// SPDX-License-Identifier: GPL-3.0-or-later
// What site.json says of the place and the time, to be corrected.

import {dialog, node, table} from "../words/dom.js";
import {say} from "./notices.js";
import {parseNumber} from "../words/numbers.js";
import {edit, isReadOnly, rows} from "../site/state.js";
import {t} from "../words/words.js";

/** Asked for where the file has none yet, since the ephemeris needs them. */
const kWanted = {latitude: 0, longitude: 0, altitude_m: 0, local_time: ""};

export function showSite() {
  const site = rows("site")[0] ?? {};
  const names = [...new Set([...Object.keys(site), ...Object.keys(kWanted)])].sort();
  dialog(
    t("site"),
    [
      node("p", {class: "faint", text: t("siteNote")}),
      node(
        "div",
        {class: "scroll tall"},
        table(
          ["", ""],
          names.map(name => [name, field(name, site[name])]),
          "keys"
        )
      )
    ],
    t("close")
  );
}

/** A list is numbers with blanks between; other structures are shown only. */
function field(name, value) {
  const isList = Array.isArray(value) && value.every(one => typeof one === "number");
  const isShownOnly = typeof value === "object" && value !== null && !isList;
  const input = node("input", {
    type: "text",
    "aria-label": name,
    autocomplete: "off",
    disabled: isShownOnly,
    value: isShownOnly ? JSON.stringify(value) : isList ? value.join(" ") : (value ?? "")
  });
  const isNumber = typeof (value ?? kWanted[name]) === "number";
  input.addEventListener("change", () => {
    const text = input.value.trim(),
      values = text.split(/\s+/).map(parseNumber);
    const isBad = isList
      ? values.length !== value.length || values.includes(null)
      : isNumber && parseNumber(text) === null;
    input.setAttribute("aria-invalid", String(isBad));
    if (isBad) return say(t("badNumber", {text}));
    take(name, isList ? values : isNumber ? parseNumber(text) : text);
  });
  return input;
}

function take(name, value) {
  if (isReadOnly("site")) return say(t("readOnlyTable"));
  const old = rows("site")[0] ?? null;
  edit(t("opSite", {name}), [{table: "site", before: old, after: {...old, [name]: value}}]);
}
