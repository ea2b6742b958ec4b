// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons left unfinished: kept in survey/drafts.json, which no program reads, and offered again.

import {button, node} from "../words/dom.js";
import {newId} from "../site/outbox.js";
import {say} from "../around/notices.js";
import {edit, isReadOnly, rows} from "../site/state.js";
import {ui} from "../site/ui.js";
import {t} from "../words/words.js";

/** Those of this page's making; others may keep drafts of their own there. */
export const polygonDrafts = () =>
  rows("drafts").filter(one => one.kind === "polygon" && Array.isArray(one.vertices));

/**
 * Keeps what was drawn so far.
 * @param {string[]} vertices
 * @param {string|null} photo
 * @param {any} before the draft that was taken up again
 * @param {Record<string, string>} [more] of it: hole_of
 */
export function keepDraft(vertices, photo, before, more = {}) {
  if (vertices.length < 2 || isReadOnly("drafts")) return;
  const after = {id: before?.id ?? newId(), kind: "polygon", vertices: [...vertices], photo, ...more};
  edit(t("opDraft"), [{table: "drafts", before, after}]);
  say(t("draftKept"));
}

/** The edit that ends a draft, to go with that which makes something of it. */
export const endDraft = draft => (draft ? [{table: "drafts", before: draft, after: null}] : []);

let drawn = "";
/**
 * The drafts there are, each to be taken up or thrown away.
 * @param {any} root
 * @param {(draft: any) => void} goOn
 */
export function showDrafts(root, goOn) {
  const all = /^draw/.test(ui.tool?.name ?? "") ? [] : polygonDrafts(),
    signature = JSON.stringify(all);
  if (drawn === signature && root.childElementCount === all.length) return;
  drawn = signature;
  root.replaceChildren(
    ...all.map(one =>
      node(
        "p",
        {class: "draft"},
        node("span", {text: `${t("drafts")}${one.hole_of ? ` (${one.hole_of})` : ""}: ${one.vertices.join(" ")}`}),
        button(t("goOn"), () => goOn(one), {class: "small"}),
        button(t("discard"), () => edit(t("opDiscard"), endDraft(one)), {class: "small"})
      )
    )
  );
}
