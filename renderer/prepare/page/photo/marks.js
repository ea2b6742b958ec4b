// SPDX-License-Identifier: GPL-3.0-or-later
// The current photo's marks as focusable nodes over it: the shape tells the kind, the colour |w|.

import {svg} from "../words/dom.js";
import {moving} from "../points/marking.js";
import {proposalFor} from "../points/proposals.js";
import {adjustedMark, kindOf, mark, rows, state} from "../site/state.js";
import {choosePoint, grade, ui} from "../site/ui.js";
import {shown} from "../words/numbers.js";
import {t} from "../words/words.js";

/** Outlines about the place, which itself stays free. */
const kShapes = {
  control: "M0 -9L8 6H-8Z",
  check: "M-7 -7H7V7H-7Z",
  tie: "M-7 0A7 7 0 1 1 7 0A7 7 0 1 1 -7 0Z",
  vertex: "M0 -8.5L8.5 0L0 8.5L-8.5 0Z",
  proposal: "M-9 -4V-9H-4M4 -9H9V-4M9 4V9H4M-4 9H-9V4"
};
const kMostNamed = 12; // bad marks of a photo that show their names unasked
const kOff = "M-9 -9L9 9M9 -9L-9 9",
  kDot = "M-1.5 0H1.5M0 -1.5V1.5";

/** @param {any} pane */
export function drawMarks(pane) {
  const nodes = pane.markNodes,
    wanted = new Set(),
    photo = pane.photo.name;
  const draw = (key, make, update) => {
    wanted.add(key);
    if (!nodes.has(key)) pane.markLayer.append(nodes.set(key, make()).get(key));
    update(nodes.get(key));
  };
  const {width, height} = pane; // the layer is twice as large
  const isNear = at => at.x > -width && at.y > -height && at.x < 2 * width && at.y < 2 * height;
  for (const [point, about] of Object.entries(state.adjusted?.points ?? {})) {
    const image = about.images?.[photo];
    if (!image || mark(photo, point) || (!ui.predictions && point !== ui.point)) continue;
    const at = pane.toScreen(image.x, image.y);
    if (isNear(at))
      draw(
        `?${point}`,
        () => makePrediction(point, photo),
        made => updatePrediction(made, point, image, at, pane)
      );
  }
  for (const one of rows("observations")) {
    if (one.photo !== photo) continue;
    const place = moving.point === one.point && moving.photo === photo ? moving : one;
    const at = pane.toScreen(place.x, place.y);
    if (isNear(at))
      draw(
        one.point,
        () => makeMark(one.point, photo),
        made => updateMark(made, one, at, pane)
      );
  }
  const proposal = ui.point === null ? undefined : proposalFor(photo, ui.point);
  if (proposal) {
    draw(
      "!proposal",
      () =>
        svg(
          "g",
          {class: "mark proposal"},
          svg("path", {class: "casing", d: kShapes.proposal}),
          svg("path", {d: kShapes.proposal}),
          svg("path", {d: kDot})
        ),
      made => put(made, pane.toScreen(proposal.x, proposal.y))
    );
  }
  for (const [key, made] of nodes) {
    if (wanted.has(key)) continue;
    made.remove();
    nodes.delete(key);
  }
}

const put = (made, at) =>
  made.setAttribute("transform", `translate(${at.x.toFixed(2)} ${at.y.toFixed(2)})`);
/** Sets an attribute only where it differs: the browser lays out again for each. */
function keep(made, name, value) {
  if (made.getAttribute(name) !== value) made.setAttribute(name, value);
}

function choosable(point, photo, ...children) {
  const made = svg("g", {tabindex: -1, role: "button", data: {point, photo}}, ...children);
  made.addEventListener("keydown", event => {
    if (event.key === "Enter" || event.key === " ") {
      choosePoint(point, false);
      event.stopPropagation();
      event.preventDefault();
    }
  });
  return made;
}

const makeMark = (point, photo) =>
  choosable(
    point,
    photo,
    svg("path", {class: "arrow casing"}),
    svg("path", {class: "arrow"}),
    svg("path", {class: "casing shape"}),
    svg("path", {class: "shape"}),
    svg("path", {class: "casing dot", d: kDot}),
    svg("path", {class: "dot", d: kDot}),
    svg("text", {x: 11, y: -7})
  );

/** Whether a photo has more bad marks than names have room. */
function isCrowded(pane) {
  if (pane.countedAt !== pane.changes) {
    pane.countedAt = pane.changes;
    const bad = (state.adjusted?.marks ?? []).filter(
      one => one.photo === pane.photo.name && grade(one.w) === "bad"
    );
    pane.isCrowded = bad.length > kMostNamed;
  }
  return pane.isCrowded;
}

function updateMark(made, one, at, pane) {
  const {k, changes} = pane;
  put(made, at);
  if (made.changes !== changes) describeMark(made, one);
  made.changes = changes;
  const {about, isOff, isCurrent, signs} = made.told;
  const arrow =
    about && ui.arrows && !isOff ? arrowPath(about.vx * ui.arrows * k, about.vy * ui.arrows * k) : "";
  const scale = k < 1 && !isCurrent ? "scale(.7)" : "scale(1)";
  const isNamed = isCurrent || ui.isNamed || k >= 6 || (signs && !isCrowded(pane));
  const text = isNamed ? one.point + signs : signs.trim();
  const parts = made.childNodes;
  if (made.arrow !== arrow) [parts[0], parts[1]].forEach(part => part.setAttribute("d", arrow));
  if (made.scale !== scale) [parts[2], parts[3]].forEach(part => part.setAttribute("transform", scale));
  if (made.text !== text) made.lastChild.textContent = text;
  Object.assign(made, {arrow, scale, text});
}

/** What of a mark no zoom changes. */
function describeMark(made, one) {
  const about = adjustedMark(one.photo, one.point),
    kind = kindOf(one.point),
    isOff = one.state === "off",
    isCurrent = one.point === ui.point;
  const level = isOff ? "off" : grade(about?.w);
  keep(made, "class", `mark ${kind} ${level} ${one.state ?? "on"}${isCurrent ? " current" : ""}`);
  const shape = (kShapes[kind] ?? kShapes.tie) + (isOff ? kOff : "");
  for (const i of [2, 3]) keep(made.childNodes[i], "d", shape);
  keep(made, "aria-label", markLabel(one, about, kind));
  const signs = (level === "bad" ? " !" : "") + (one.state === "dubious" ? " ?" : "");
  made.told = {about, isOff, isCurrent, signs};
}

function markLabel(one, about, kind) {
  const parts = [t(kind), one.point, `x ${shown(one.x, 2)} y ${shown(one.y, 2)}`];
  if (one.state && one.state !== "on") parts.push(t(one.state));
  if (about) parts.push(about.w === null ? t("cannotCheck") : `w ${shown(about.w, 1)}`);
  return parts.join(", ");
}

/** From the mark to where the adjustment puts it, with a head; "" if too short to see. */
export function arrowPath(dx, dy) {
  const length = Math.hypot(dx, dy);
  if (length < 1) return "";
  const head = Math.min(6, length / 2),
    ux = (dx / length) * head,
    uy = (dy / length) * head;
  const f = value => value.toFixed(1);
  return (
    `M0 0L${f(dx)} ${f(dy)}M${f(dx - ux - uy / 2)} ${f(dy - uy + ux / 2)}L${f(dx)} ${f(dy)}` +
    `L${f(dx - ux + uy / 2)} ${f(dy - uy - ux / 2)}`
  );
}

const makePrediction = (point, photo) =>
  choosable(
    point,
    photo,
    svg("ellipse", {class: "casing"}),
    svg("ellipse"),
    svg("path", {class: "dot", d: kDot}),
    svg("text", {x: 9, y: -5})
  );

function updatePrediction(made, point, image, at, {k, changes}) {
  const isCurrent = point === ui.point,
    least = isCurrent ? 4 : 3;
  put(made, at);
  for (const i of [0, 1]) {
    keep(made.childNodes[i], "rx", Math.max(image.major * k, least).toFixed(1));
    keep(made.childNodes[i], "ry", Math.max(image.minor * k, least).toFixed(1));
  }
  const text = isCurrent || ui.isNamed || k >= 6 ? point : "";
  if (made.lastChild.textContent !== text) made.lastChild.textContent = text;
  if (made.changes === changes) return;
  made.changes = changes;
  keep(made, "class", `mark prediction${isCurrent ? " current" : ""}`);
  const turn = `rotate(${((image.angle * 180) / Math.PI).toFixed(1)})`;
  for (const i of [0, 1]) keep(made.childNodes[i], "transform", turn);
  keep(
    made,
    "aria-label",
    `${t("prediction")}, ${point}, x ${shown(image.x, 1)} y ${shown(image.y, 1)}`
  );
}
