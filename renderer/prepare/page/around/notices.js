// SPDX-License-Identifier: GPL-3.0-or-later
// What the page has to say: a line below, banners above, conflicts to decide.

import {button, byId, node, table} from "../words/dom.js";
import {kKeys} from "../site/rows.js";
import {edit, state} from "../site/state.js";
import {mergeBanner, rowText} from "./merged.js";
import {emit, on} from "../site/signals.js";
import {failures, keptCount, sendNow, storeFault, unconfirmed} from "../site/outbox.js";
import {said, t} from "../words/words.js";

/**
 * A sentence in the status line, read out.
 * @param {string} text
 */
export function say(text) {
  byId("say").textContent = text;
}

/** Operations that no server has, as a file. */
function download() {
  const refused = state.refused.map(one => one.operation);
  const text = JSON.stringify(
    {site: state.siteFolder, operations: [...refused, ...unconfirmed()]},
    null,
    1
  );
  const address = URL.createObjectURL(new Blob([text], {type: "application/json"}));
  node("a", {href: address, download: `${state.name || "site"}_unsaved.json`}).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

const banner = (kind, text, ...controls) =>
  node("p", {class: `banner ${kind}`}, node("span", {text}), ...controls);

/** How many outlive this page. */
const keptText = (waiting, kept) => t(kept === waiting ? "keptAll" : "keptSome", {n: kept});

let drawn = "";
function draw() {
  const waiting = unconfirmed().length,
    kept = keptCount();
  const isGone = state.isLoaded && ((!state.isConnected && isLate) || (failures > 1 && !storeFault));
  const signature = JSON.stringify([
    isGone,
    isGone && [waiting, kept],
    state.notSaved,
    storeFault,
    state.readOnly,
    state.faults,
    state.refused.length,
    state.merge
  ]);
  if (signature === drawn) return;
  drawn = signature;
  const made = [];
  if (isGone)
    made.push(
      banner(
        "fail",
        t("serverGone", {n: waiting}) + (waiting > 0 ? ` ${keptText(waiting, kept)}` : ""),
        button(t("tryNow"), sendNow),
        button(t("download"), download)
      )
    );
  const fault = state.notSaved || storeFault;
  if (fault)
    made.push(
      banner(
        "fail",
        t("notSavedBecause", {why: fault}),
        button(t("tryNow"), sendNow),
        button(t("download"), download)
      )
    );
  for (const one of state.readOnly) {
    made.push(banner("review", t("readOnlyFile", {place: `${one.file}:${one.line}`, text: said(one)})));
  }
  state.faults.forEach(one =>
    made.push(
      banner(
        "review",
        one.file ? `${one.file}:${one.line}: ${said(one)}` : said(one),
        button(t("dismiss"), () => {
          state.faults = state.faults.filter(other => other !== one);
          emit("faults");
        })
      )
    )
  );
  if (state.refused.length > 0) made.push(conflict(state.refused[0]));
  if (state.merge.length > 0) made.push(mergeBanner());
  byId("banners").replaceChildren(...made);
}

/** The rows of an operation that was refused, both versions, to choose. */
function conflict(one) {
  const decided = () => {
    state.refused.shift();
    emit("saved");
  };
  if (one.conflicts.length === 0) {
    return banner(
      "fail",
      t("refused", {label: one.operation.label, why: one.error ?? ""}),
      button(t("dismiss"), decided),
      button(t("download"), download)
    );
  }
  const mine = one.conflicts.map(({table: name, before, current}) =>
    one.operation.edits.find(
      e => e.table === name && isKeyAlike(name, e.before ?? e.after, before ?? current)
    )
  );
  const lines = one.conflicts.map((c, i) => [c.table, rowText(c.current), rowText(mine[i]?.after)]);
  const useMine = () => {
    const others = one.operation.edits.filter(e => !mine.includes(e));
    decided();
    edit(one.operation.label, [
      ...others,
      ...one.conflicts.map((c, i) => ({
        table: c.table,
        before: c.current,
        after: mine[i]?.after ?? null
      }))
    ]);
  };
  return node(
    "div",
    {class: "banner fail conflict"},
    node("p", {text: t("conflict", {label: one.operation.label})}),
    table([t("table"), t("theirs"), t("mine")], lines),
    button(t("keepTheirs"), decided),
    button(t("useMine"), useMine),
    button(t("download"), download)
  );
}

const isKeyAlike = (table_, a, b) =>
  !kKeys[table_] || !a || !b || kKeys[table_].every(key => String(a[key]) === String(b[key]));
let isLate = false,
  lateTimer = 0;
on("connection", () => {
  // a moment without a connection is not worth a banner
  clearTimeout(lateTimer);
  isLate = false;
  lateTimer = window.setTimeout(() => {
    isLate = true;
    emit("saved");
  }, 1500);
});
on("draw", draw);

addEventListener("beforeunload", event => {
  if (unconfirmed().length > 0) event.preventDefault();
});
