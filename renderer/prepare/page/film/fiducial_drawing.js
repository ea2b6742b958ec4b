// SPDX-License-Identifier: GPL-3.0-or-later
// Fiducial marks over a scan: placed with their residuals as arrows, predicted with dashes.

import {
  certified,
  fiducial,
  gradeOfFiducial,
  placeOfFiducial,
  predictedFiducial,
  reviewedMark
} from "./certified.js";
import {svg} from "../words/dom.js";
import {arrowPath} from "../photo/marks.js";
import {ui} from "../site/ui.js";
import {shown} from "../words/numbers.js";
import {t} from "../words/words.js";

const kShape = "M-6 0A6 6 0 1 1 6 0A6 6 0 1 1 -6 0ZM0 -6V-11M0 6V11M-6 0H-11M6 0H11";
const kOff = "M-8 -8L8 8M-8 8L8 -8";
const kDot = "M-1.5 0H1.5M0 -1.5V1.5";

/** @param {any} pane */
export function drawFiducials(pane) {
  const photo = pane.photo.name,
    made = [];
  for (const mark of ui.mode === "film" ? certified().keys() : []) {
    const at = placeOfFiducial(photo, mark);
    if (!at) continue;
    const {x, y} = pane.toScreen(at.x, at.y);
    if (x > -pane.width && y > -pane.height && x < 2 * pane.width && y < 2 * pane.height)
      made.push(draw(photo, mark, {x, y}, pane.k));
  }
  pane.fiducialLayer.replaceChildren(...made);
}

function draw(photo, mark, at, k) {
  const about = reviewedMark(photo, mark),
    isPlaced = fiducial(photo, mark) !== undefined,
    isOff = fiducial(photo, mark)?.state === "off",
    isDubious = fiducial(photo, mark)?.state === "dubious",
    level = isOff ? "off" : gradeOfFiducial(photo, mark);
  const arrow = isPlaced && about && ui.arrows ? arrowPath(about.vx * ui.arrows * k, about.vy * ui.arrows * k) : "";
  const shape = kShape + (isOff ? kOff : "");
  const name = `${mark}${level === "bad" ? " !" : ""}${isDubious ? " ?" : ""}`;
  const classes = [
    "mark fiducial",
    isPlaced ? level : "unplaced",
    isDubious ? "dubious" : "",
    mark === ui.fiducial ? "current" : ""
  ].join(" ");
  return svg(
    "g",
    {
      class: classes,
      role: "img",
      transform: `translate(${at.x.toFixed(2)} ${at.y.toFixed(2)})`,
      "aria-label": label(photo, mark, about),
      data: {fiducial: mark, photo}
    },
    svg("path", {class: "arrow casing", d: arrow}),
    svg("path", {class: "arrow", d: arrow}),
    svg("path", {class: "casing shape", d: shape}),
    svg("path", {class: "shape", d: shape}),
    svg("path", {class: "dot", d: kDot}),
    svg("text", {x: 12, y: -8, text: name})
  );
}

function label(photo, mark, about) {
  const parts = [t("fiducial"), mark];
  if (predictedFiducial(photo, mark)) parts.push(t("prediction"));
  else if (fiducial(photo, mark)?.state === "off") parts.push(t("off"));
  else if (fiducial(photo, mark)?.state === "dubious") parts.push(t("dubious"));
  else if (about) parts.push(about.w === null ? t("cannotCheck") : `w ${shown(about.w, 1)}`);
  return parts.join(", ");
}
