// SPDX-License-Identifier: GPL-3.0-or-later
// The building's outline with the band of ± 2 σ, asked for once a photograph and frame.

import {shown} from "./state.js";
import {emit} from "../../prepare/page/site/signals.js";
import {getJson} from "../../prepare/page/site/api.js";
import {shown as number} from "../../prepare/page/words/numbers.js";
import {t} from "./words/view_words.js";

const kLine = "#f0e442",
  kBand = "#f0e44255",
  kCasing = "#000a";

/** @type {Map<string, any>} by photograph and frame; {} while it is asked for */
const known = new Map();

export const forgetOutlines = () => known.clear();

function outlineOf(frame) {
  const key = `${shown.photo}/${frame}`;
  if (!known.has(key)) {
    known.set(key, {});
    const query = `photo=${encodeURIComponent(shown.photo)}&frame=${frame}`;
    getJson(`/api/outline?${query}`, [400])
      .catch(error => ({error: String(error.message ?? error)}))
      .then(answer => {
        known.set(key, answer);
        emit("view");
      });
  }
  return known.get(key);
}

/** What is to be said of it. @param {string} frame */
export function outlineText(frame) {
  const outline = outlineOf(frame);
  if (outline.error) return t("outlineNone", {why: outline.error});
  if (!outline.lines) return "";
  if (!outline.known) return t("outlineUnknown");
  const most = Math.max(0, ...outline.corners.map(corner => corner.major / 2));
  return t("outlineSigma", {most: number(most, 2)});
}

function pathOf(points, k, tx, ty, path = new Path2D()) {
  points.forEach(([x, y], i) =>
    path[i === 0 ? "moveTo" : "lineTo"](k * (x + 0.5) + tx, k * (y + 0.5) + ty)
  );
  return path;
}

/** All in device pixels. */
export function drawOutline(context, picture, k, tx, ty) {
  if (!shown.isOutline || !picture) return;
  const outline = outlineOf(picture.frame ?? "photo");
  if (!outline.lines) return;
  for (const line of outline.lines) drawLine(context, line, k, tx, ty);
  context.strokeStyle = kLine;
  context.lineWidth = devicePixelRatio;
  context.setLineDash([]);
  for (const {x, y, major, minor, angle} of outline.corners) {
    context.beginPath();
    context.ellipse(k * (x + 0.5) + tx, k * (y + 0.5) + ty, k * major, k * minor, angle, 0, 2 * Math.PI);
    if (k * major > 3) context.stroke();
  }
}

function drawLine(context, {points, low, high, hidden}, k, tx, ty) {
  const ratio = devicePixelRatio;
  context.setLineDash(hidden ? [6 * ratio, 5 * ratio] : []);
  if (low.length > 0 && !hidden) {
    const band = pathOf(low, k, tx, ty);
    [...high].reverse().forEach(([x, y]) => band.lineTo(k * (x + 0.5) + tx, k * (y + 0.5) + ty));
    context.fillStyle = kBand;
    context.fill(band);
  }
  const path = pathOf(points, k, tx, ty);
  context.strokeStyle = kCasing;
  context.lineWidth = 3 * ratio;
  context.globalAlpha = hidden ? 0.35 : 1;
  context.stroke(path);
  context.strokeStyle = kLine;
  context.lineWidth = ratio;
  context.stroke(path);
  context.globalAlpha = 1;
}
