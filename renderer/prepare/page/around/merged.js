// SPDX-License-Identifier: GPL-3.0-or-later
// Rows in which a colleague's copy of the site differs (--merge): both versions, to choose.

import {post} from "../site/api.js";
import {edit, state} from "../site/state.js";
import {button, node, table} from "../words/dom.js";
import {t} from "../words/words.js";

/** @param {import("../site/rows.js").Row|null|undefined} one */
export const rowText = one =>
  one
    ? Object.entries(one)
        .map(([key, value]) => `${key} ${Array.isArray(value) ? value.join(" ") : value}`)
        .join(", ")
    : t("deleted");

const kFields = ["photo", "point", "name", "id", "shadow", "object"]; // that say which row it is

/** Which row, and of each version what differs. */
function versions({table: name, current, after}) {
  const fields = [...new Set([...Object.keys(current), ...Object.keys(after)])];
  const differs = key => JSON.stringify(current[key]) !== JSON.stringify(after[key]);
  const only = row =>
    rowText(Object.fromEntries(fields.filter(differs).map(key => [key, row[key] ?? ""])));
  const which = kFields.filter(key => key in current && !differs(key)).map(key => current[key]);
  return [[name, ...which].join(" "), only(current), only(after)];
}

/** If nobody hears it, it is asked again. */
const decide = conflict => post("/api/merge_decided", conflict).catch(() => {});

function take(conflict) {
  edit(t("opMerge", {from: conflict.from}), [
    {table: conflict.table, before: conflict.current, after: conflict.after}
  ]);
  decide(conflict);
}

/** One after the other. */
export function mergeBanner() {
  const [first] = state.merge,
    count = state.merge.length;
  return node(
    "div",
    {class: "banner review conflict merge"},
    node("p", {text: t("mergeDiffers", {n: count, from: first.from})}),
    table([t("table"), t("here"), first.from], [versions(first)]),
    button(t("keepHere"), () => decide(first)),
    button(t("takeOther", {from: first.from}), () => take(first)),
    count > 1 ? button(t("keepAllHere"), () => [...state.merge].forEach(decide)) : null
  );
}
