// SPDX-License-Identifier: GPL-3.0-or-later
// Another name for a point: for one mark that was given the wrong one, or wherever the point is named.

import {button, dialog, node} from "../words/dom.js";
import {settle} from "./marking.js";
import {say} from "../around/notices.js";
import {isSame} from "../site/rows.js";
import {edit, indexed, isReadOnly, mark, nameFault, rows} from "../site/state.js";
import {activePane, choosePoint, ui} from "../site/ui.js";
import {t} from "../words/words.js";

/** Tables whose rows name points, with the fields that do. */
const kNaming = {
  control_points: ["name"],
  observations: ["point"],
  edges: ["from", "to"],
  polygons: ["vertices", "holes"],
  sun: ["object", "shadow"],
  zenith: ["bottom", "top"],
  constraints: ["points"]
};

export function showRename() {
  settle();
  const from = ui.point;
  if (from === null) return say(t("noPoint"));
  const field = node("input", {
    id: "new-name",
    type: "text",
    value: from,
    "aria-label": t("newName"),
    autocomplete: "off"
  });
  const shown = dialog(
    `${t("rename")}: ${from}`,
    [
      field,
      node(
        "p",
        {class: "buttons"},
        button(t("everywhere"), () => take(field.value.trim(), renamed), {class: "main"}),
        button(t("thisMark"), () => take(field.value.trim(), renamedMark))
      )
    ],
    t("close")
  );
  field.select();
  const take = (to, edits) => {
    const fault = nameFault(to);
    if (fault || to === from) return say(t(fault || "taken", {name: to}));
    const all = edits(from, to)?.filter(one => !isSame(one.before, one.after));
    if (!all) return say(t("taken", {name: to}));
    if (all.some(one => isReadOnly(one.table))) return say(t("readOnlyTable"));
    shown.close();
    edit(t("opRenamePoint", {name: from, to}), all);
    choosePoint(to, false);
  };
}

/** Edits of every row that names the point; null if the name is another's. */
function renamed(from, to) {
  if (indexed().points.has(to)) return null;
  const swap = value => (Array.isArray(value) ? value.map(swap) : value === from ? to : value);
  return Object.entries(kNaming).flatMap(([table, fields]) =>
    rows(table).map(before => ({
      table,
      before,
      after: {
        ...before,
        ...Object.fromEntries(
          fields.filter(field => field in before).map(field => [field, swap(before[field])])
        )
      }
    }))
  );
}

/** The edit of the mark on the active photo; if that has the new name's too, both are exchanged. */
function renamedMark(from, to) {
  const photo = activePane()?.photo?.name,
    one = mark(photo, from),
    other = mark(photo, to);
  if (!one) return null;
  if (!other) return [{table: "observations", before: one, after: {...one, point: to}}];
  return [
    {table: "observations", before: one, after: {...other, point: from}},
    {table: "observations", before: other, after: {...one, point: to}}
  ];
}
