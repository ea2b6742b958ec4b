// SPDX-License-Identifier: GPL-3.0-or-later
// The panel of scanned film: the map between the active scan and its film, its marks worst first.

import {showCertificate} from "./certificate.js";
import {certified, fiducial, fiducialsOn, lacking, reviewOf} from "./certified.js";
import {chooseFiducial} from "./fiducials.js";
import {confirm, deleteMark, toggleDubious, toggleOff} from "../points/marking.js";
import {refine} from "../points/proposals.js";
import {state} from "../site/state.js";
import {activePane, grade, ui} from "../site/ui.js";
import {button, byId, node} from "../words/dom.js";
import {shown} from "../words/numbers.js";
import {said, t} from "../words/words.js";

export function buildFilmPanel(root) {
  const inPane = (text, key, action, more = {}) =>
    button(
      t(text),
      () => {
        action();
        activePane().focus();
      },
      {title: `${t(text)} (${key})`, ...more}
    );
  root.append(
    node(
      "div",
      {class: "buttons"},
      inPane("confirm", "Enter", () => confirm(activePane(), false), {class: "main"}),
      inPane("switch", "X", () => toggleOff()),
      inPane("doubt", "D", () => toggleDubious()),
      inPane("delete", "Del", deleteMark),
      inPane("refine", "F", () => refine(activePane())),
      button(t("certificate"), showCertificate, {id: "certificate"})
    ),
    node("div", {id: "film-about"})
  );
  drawn = "";
}

let drawn = "";
export function updateFilmPanel() {
  const root = byId("film-about"),
    photo = activePane()?.photo?.name ?? "";
  const review = reviewOf(photo);
  const states = fiducialsOn(photo).map(one => one.state ?? "on");
  const signature = JSON.stringify([photo, review, state.film?.missing, ui.fiducial, certified().size, states]);
  if (!root || drawn === signature) return;
  drawn = signature;
  root.replaceChildren(...about(photo, review));
}

function* about(photo, review) {
  if (certified().size === 0) return yield node("p", {class: "faint", text: t("certificateFirst")});
  const text = mapText(photo, review);
  yield node("p", {id: "film-map", "aria-live": "polite", text, class: isUnchecked(review) ? "review" : ""});
  for (const suspicion of review?.suspicions ?? []) yield node("p", {class: "fail", text: said(suspicion)});
  yield node(
    "table",
    {class: "rays", id: "film-marks"},
    node(
      "thead",
      {},
      node(
        "tr",
        {},
        ...["markHead", "vFilm", "vPixels", "rHead", "wHead"].map(head => node("th", {text: t(head)}))
      )
    ),
    node("tbody", {}, ...(review?.marks ?? []).map(one => placedLine(photo, one)), ...unplacedLines(photo, review))
  );
}

/** A length on the film [mm]: micrometres, of blunders millimetres. */
const onFilm = mm => (Math.abs(mm) < 1 ? `${shown(1000 * mm, 1)} µm` : `${shown(mm, 2)} mm`);

const isUnchecked = review => review?.px_per_mm && review.redundancy === 0;

function mapText(photo, review) {
  const placed = review?.placed ?? 0;
  if (!review?.px_per_mm) {
    return t("filmNoMap", {photo, n: placed, needed: review?.needed ?? 3, all: certified().size});
  }
  const values = {photo, n: placed, kind: t(review.kind), r: review.redundancy};
  const quality =
    review.redundancy > 0
      ? t("filmSigma", {
          ...values,
          px: shown(review.sigma_px, 2),
          film: onFilm(review.sigma_mm)
        })
      : t("filmUnchecked", values);
  const scan = t("filmScan", {scale: shown(review.px_per_mm, 2), turn: shown(review.turn_deg, 2)});
  return `${quality}\n${scan}`;
}

const nameCell = (mark, level, isDubious = false) =>
  node("td", {}, button(`${mark}${level === "bad" ? " !" : ""}${isDubious ? " ?" : ""}`, () => {
    chooseFiducial(mark);
    activePane()?.focus();
  }, {class: "small"}));

const brief = px => shown(px, Math.abs(px) < 10 ? 2 : 0);

function placedLine(photo, one) {
  const level = grade(one.w),
    isDubious = fiducial(photo, one.mark)?.state === "dubious";
  const cells = [
    Math.hypot(one.vx_mm, one.vy_mm) < 1
      ? `${shown(1000 * one.vx_mm, 1)} ${shown(1000 * one.vy_mm, 1)} µm`
      : `${shown(one.vx_mm, 2)} ${shown(one.vy_mm, 2)} mm`,
    `${brief(one.vx)} ${brief(one.vy)}`,
    shown(one.r, 2),
    one.w === null ? "–" : shown(one.w, one.w < 100 ? 1 : 0)
  ];
  const checked = one.off_px === null ? t("cannotCheck") : t("offOthers", {px: shown(one.off_px, 2)});
  const title = isDubious ? `${t("dubious")} (σ × 3): ${checked}` : checked;
  return node(
    "tr",
    {class: `${level}${one.mark === ui.fiducial ? " current" : ""}`, title, data: {fiducial: one.mark}},
    nameCell(one.mark, level, isDubious),
    ...cells.map(text => node("td", {text}))
  );
}

/** Marks without residual: placed while there is no map, switched off, or not placed. */
function unplacedLines(photo, review) {
  const lacked = new Set(lacking(photo)),
    told = new Set((review?.marks ?? []).map(one => one.mark));
  const stateOf = mark =>
    lacked.has(mark) ? "notPlaced" : fiducial(photo, mark)?.state === "off" ? "off" : "placedOnly";
  return [...certified().keys()]
    .filter(mark => !told.has(mark))
    .map(mark =>
      node(
        "tr",
        {class: mark === ui.fiducial ? "current" : "", data: {fiducial: mark}},
        nameCell(mark, ""),
        node("td", {colspan: 4, class: "instead", text: t(stateOf(mark))})
      )
    );
}
