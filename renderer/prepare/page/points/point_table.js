// SPDX-License-Identifier: GPL-3.0-or-later
// The current point photo by photo: placed or predicted, its residual, w, redundancy, its σ to be changed.

import {button, byId, node} from "../words/dom.js";
import {changeMark, moving, toggleOff} from "./marking.js";
import {say} from "../around/notices.js";
import {parseNumber, shown} from "../words/numbers.js";
import {proposals} from "./proposals.js";
import {adjustedMark, kindOf, mark, prediction, raysOf, state} from "../site/state.js";
import {activePane, grade, showPhoto, ui} from "../site/ui.js";
import {raysText, t} from "../words/words.js";

/** What is known of the current point on a photo. */
function aboutPhoto(photo) {
  const point = ui.point ?? "",
    one = mark(photo, point),
    about = one && adjustedMark(photo, point),
    expected = prediction(photo, point);
  const isMoving = moving.point === point && moving.photo === photo,
    pane = ui.panes.find(other => other.photo?.name === photo);
  const place = isMoving ? moving : (one ?? (pane?.isMoved ? pane.cursor : null));
  return {
    photo,
    isMarked: Boolean(one),
    state: one?.state ?? "on",
    sigma: one?.sigma,
    v: about && [about.vx, about.vy],
    w: about?.w,
    r: about?.r,
    hasResidual: Boolean(about),
    within: one ? null : (expected?.major ?? null),
    away: expected && place ? Math.hypot(expected.x - place.x, expected.y - place.y) : null,
    isProposed: proposals.point === point && proposals.byPhoto.has(photo),
    isActive: activePane()?.photo?.name === photo
  };
}

/** The middle cells: v, w and r, or in their place what is known instead. */
function middleCells(one) {
  const wide = (text, title = "") => [
    node("td", {colspan: one.isMarked ? 3 : 4, class: "instead", text, title})
  ];
  if (one.isProposed) return wide(t("proposed"));
  const away = one.away === null ? "" : shown(one.away, 1);
  const brief = (value, digits) => shown(value, Math.abs(value) < 10 ? digits : digits - 1);
  if (!one.isMarked) {
    if (one.within === null) return wide(t("notMarked"));
    const text = t("predictedShort", {px: shown(one.within, 1)});
    return wide(
      away ? `${text}, ${t("crosshairAway", {px: away})}` : text,
      t("predictedWithin", {px: shown(one.within, 1)})
    );
  }
  if (!one.hasResidual)
    return wide([t(one.state), ...(away ? [t("away", {px: away})] : [])].join(", "));
  return [
    node("td", {
      title: away ? t("away", {px: away}) : "",
      text: one.v.map(value => brief(value, 2)).join(" ")
    }),
    node("td", {
      text: one.w === null ? "–" : `${brief(one.w, 1)}${grade(one.w) === "bad" ? "!" : ""}`,
      title: one.w === null ? t("cannotCheck") : ""
    }),
    node("td", {text: shown(one.r, 2)})
  ];
}

function sigmaInput(one) {
  const input = node("input", {
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    value: String(Math.round(1e4 * one.sigma) / 1e4),
    "aria-label": t("sigmaOf", {point: ui.point, photo: one.photo})
  });
  input.addEventListener("change", () => {
    const value = parseNumber(input.value),
      isBad = value === null || !(value > 0);
    input.setAttribute("aria-invalid", String(isBad));
    if (isBad) return say(t("badNumber", {text: input.value}));
    changeMark(old => ({...old, sigma: value}), "opSigma", one.photo);
  });
  input.addEventListener("keydown", event => {
    if (event.key === "Enter" || event.key === "Escape") activePane()?.focus();
  });
  return input;
}

function line(one) {
  const level = !one.isMarked ? "" : one.state === "off" ? "off" : grade(one.w);
  const flip = one.state === "off" ? "switchOn" : "switchOff";
  const last = one.isProposed
    ? button(t("take"), () => showPhoto(one.photo), {class: "small"})
    : one.isMarked
      ? button(t(flip), () => toggleOff(one.photo), {class: "small"})
      : "";
  return node(
    "tr",
    {class: `${level}${one.isActive ? " current" : ""}`, data: {photo: one.photo}},
    node("td", {}, button(one.photo, () => showPhoto(one.photo), {class: "small", title: one.photo})),
    ...middleCells(one),
    one.isMarked ? node("td", {}, sigmaInput(one)) : null,
    node("td", {}, last)
  );
}

/** Kind, rays, ± mm; the place in the world below. */
function summary(point) {
  const solved = state.adjusted?.points?.[point];
  const parts = [t(kindOf(point)), raysText(raysOf(point))];
  if (solved) parts.push(`± ${shown(1000 * Math.hypot(...solved.sigma), 0)} mm`);
  return node(
    "p",
    {},
    node("strong", {text: point}),
    ` ${parts.join(", ")}`,
    solved?.plane
      ? node("span", {class: "plane", text: t("onPlane", {polygon: solved.plane})})
      : null,
    solved ? node("span", {class: "faint xyz", text: solved.xyz.map(v => shown(v, 3)).join("  ")}) : null
  );
}

function solvedPlace() {
  const solved = state.adjusted?.points?.[ui.point ?? ""];
  return [solved?.xyz, solved?.plane];
}

let drawn = "";
/** Draws anew what has changed, but not under the hands of one who types a σ. */
export function updatePointTable() {
  const root = byId("marks-of-point");
  if (!root || (root.contains(document.activeElement) && document.activeElement?.tagName === "INPUT"))
    return;
  const lines = ui.point === null ? [] : state.photos.map(photo => aboutPhoto(photo.name));
  const signature = JSON.stringify([ui.point, lines, solvedPlace()]);
  if (drawn === signature && root.childElementCount > 0) return;
  drawn = signature;
  const point = ui.point;
  if (point === null) return root.replaceChildren(node("p", {class: "faint", text: t("noPointHint")}));
  const focused = root.contains(document.activeElement)
    ? document.activeElement?.closest("tr")?.dataset.photo
    : undefined;
  const head = [t("photo"), t("vHead"), "w", "r", t("sigmaMark"), ""];
  root.replaceChildren(
    summary(point),
    node(
      "table",
      {class: "rays"},
      node("thead", {}, node("tr", {}, ...head.map(text => node("th", {text})))),
      node("tbody", {}, ...lines.map(line))
    )
  );
  if (focused) root.querySelector(`tr[data-photo="${CSS.escape(focused)}"] button`)?.focus();
}
