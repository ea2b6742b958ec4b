// SPDX-License-Identifier: GPL-3.0-or-later
// The header: modes, undo and redo, what is saved, σ0; and the status line.

import {ask, isReport, reportAddress} from "../site/api.js";
import {showSite} from "./site_table.js";
import {button, byId, keepText, select} from "../words/dom.js";
import {emptied, keptCount, newId, unconfirmed} from "../site/outbox.js";
import {on} from "../site/signals.js";
import {adjustedMark, mark, prediction, raysOf, state} from "../site/state.js";
import {settle} from "../points/marking.js";
import {shown} from "../words/numbers.js";
import {say} from "./notices.js";
import {fiducial, reviewedMark} from "../film/certified.js";
import {offText, samples} from "../light/samples.js";
import {activePane, setMode, ui} from "../site/ui.js";
import {kLanguages, language, setLanguage, raysText, said, t} from "../words/words.js";

/** @type {[import("../site/ui.js").Mode, string][]} */
export const kModes = [
  ["control", "1"],
  ["polygons", "2"],
  ["sun", "3"],
  ["light", "4"],
  ["film", "5"]
];

/** Takes the last operation back, whoever did it. */
export const undo = () => step("undo");
export const redo = () => step("redo");
async function step(which) {
  settle();
  if (which === "undo" && ui.tool?.back?.()) return;
  if (!(await emptied(3))) return say(t("waiting"));
  const label = state.history?.[which];
  if (!label) return say(t(`${which}Nothing`));
  const answer = await ask(`/api/${which}`, {id: newId()});
  say(
    answer.error
      ? answer.error
      : t(which === "undo" ? "undone" : "redone", {label: answer.operation?.label ?? label ?? ""})
  );
}

/**
 * Builds what stays.
 * @param {[string, () => void][]} menu
 */
export function buildHeader(menu) {
  byId("site").replaceChildren(button(state.name, showSite, {"data-menu": "site", title: t("site")}));
  document.title = `${state.name} – insitu prepare`;
  byId("modes").setAttribute("aria-label", t("modes"));
  byId("modes").replaceChildren(
    ...kModes.map(([mode, key]) =>
      button(`${key} ${t(`mode_${mode}`)}`, () => setMode(mode), {
        "data-mode": mode,
        "aria-keyshortcuts": `Alt+${key}`
      })
    )
  );
  byId("history").replaceChildren(button("↶", undo, {id: "undo"}), button("↷", redo, {id: "redo"}));
  const languages = select(kLanguages, language, setLanguage, {"aria-label": t("language")});
  const entries = isReport
    ? []
    : menu.map(([text, action]) => button(t(text), action, {"data-menu": text}));
  if (!isReport)
    entries.unshift(
      button(t("secondWindow"), () => window.open(reportAddress(), "_blank"), {"data-menu": "report"})
    );
  byId("menu").replaceChildren(...entries, languages);
  on("draw", draw);
  on("frame", drawStatus);
}

function draw() {
  for (const made of byId("modes").children)
    made.setAttribute("aria-pressed", String(made.dataset.mode === ui.mode));
  for (const which of ["undo", "redo"]) {
    const made = byId(which),
      label = state.history?.[which];
    made.disabled = !label && !(which === "undo" && ui.tool?.back);
    made.title = label ? t(which, {label}) : t(`${which}Nothing`);
    made.setAttribute("aria-label", made.title);
  }
  drawSaved();
  drawSigma();
}

function drawSaved() {
  const waiting = unconfirmed().length + state.asking,
    made = byId("saved");
  made.className = waiting > 0 || state.notSaved ? "review" : "pass";
  const isKept = state.asking === 0 && keptCount() === waiting;
  keepText(made, t(state.notSaved ? "notSaved" : waiting === 0 ? "saved" : isKept ? "kept" : "saving"));
  made.title = t("savedNote", {revision: state.saved});
  const data = document.body.dataset;
  data.revision = String(state.revision);
  data.saved = String(state.saved);
  data.pending = String(waiting);
  data.kept = String(keptCount());
  data.mode = ui.mode;
  data.adjusted = String(state.adjusted?.revision ?? "");
}

function drawSigma() {
  const about = state.adjusted,
    made = byId("sigma");
  if (!about || about.failed) {
    made.className = "review";
    made.title = said(about, "failed");
    return keepText(made, about?.failed ? t("notAdjusted") : "σ0 –");
  }
  const isOk = about.p === undefined || about.p === null || about.p > 0.001;
  made.className = about.redundancy > 0 ? (isOk ? "pass" : "review") : "faint";
  keepText(
    made,
    about.redundancy > 0
      ? `σ0 ${shown(about.sigma0, 2)} ${isOk ? "ok" : t("sigmaBad")}`
      : t("noRedundancy")
  );
  made.title = t("sigmaNote", {
    r: about.redundancy,
    n: about.observations,
    u: about.unknowns,
    ms: Math.round(1000 * (about.seconds ?? 0))
  });
}

function drawStatus() {
  const pane = activePane(),
    made = byId("where");
  if (!pane?.photo) return keepText(made, "");
  const place = pane.hover ?? pane.cursor,
    photo = pane.photo.name,
    point = ui.point;
  const parts = [`${photo}  x ${shown(place.x, 2)}  y ${shown(place.y, 2)}`];
  const sample = ui.mode === "light" && samples().find(one => one.key === ui.sample);
  if (sample) parts.push(`${t(sample.kind)} ${sample.row.polygon ?? ""}`, `${t("off100")} ${offText(sample)}`);
  else if (ui.mode === "film") parts.push(...fiducialParts(photo, ui.fiducial));
  else if (point !== null) parts.push(...pointParts(photo, point));
  keepText(made, parts.join("  |  "));
}

function fiducialParts(photo, name) {
  if (name === null) return [];
  const about = reviewedMark(photo, name);
  if (!about) return [name, t(fiducial(photo, name) ? "placedOnly" : "notPlaced")];
  return [
    name,
    `v ${shown(about.vx, 2)} ${shown(about.vy, 2)} px`,
    about.w === null ? t("cannotCheck") : `w ${shown(about.w, 1)}  r ${shown(about.r, 2)}`
  ];
}

function pointParts(photo, point) {
  const one = mark(photo, point),
    about = adjustedMark(photo, point),
    expected = prediction(photo, point);
  const parts = [`${point}${one ? `  σ ${shown(one.sigma, 2)}` : ""}`];
  if (one && about)
    parts.push(
      `v ${shown(about.vx, 2)} ${shown(about.vy, 2)} px`,
      about.w === null ? t("cannotCheck") : `w ${shown(about.w, 1)}  r ${shown(about.r, 2)}`
    );
  if (!one && expected) parts.push(t("predictedWithin", {px: shown(expected.major, 1)}));
  parts.push(raysText(raysOf(point)));
  const solved = state.adjusted?.points?.[point];
  if (solved) parts.push(`± ${shown(1000 * Math.hypot(...solved.sigma), 0)} mm`);
  return parts;
}
