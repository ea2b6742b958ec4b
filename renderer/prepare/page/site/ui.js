// SPDX-License-Identifier: GPL-3.0-or-later
// What the person at the page is about: mode, point, panes, tool.

import {indexed, live, photoOf, prediction, state} from "./state.js";
import {emit} from "./signals.js";
import {adjustedMark, mark} from "./state.js";

/**
 * What takes points and places instead of the current point.
 * @typedef {object} Tool
 * @property {string} name of a text: what is to be done
 * @property {() => string} hint
 * @property {(name: string) => void} [pickPoint]
 * @property {(name: string) => void} [pickPolygon]
 * @property {(photo: string, x: number, y: number, name?: string) => void} [place] `name`: of a point typed
 * @property {() => boolean} [back] takes the last step back, false if there was none
 * @property {() => void} [finish]
 * @property {() => void} [cancelled]
 * @property {(photo: string) => [number, number][]} [outline] what is being drawn
 */

export const ui = {
  /** @type {"control"|"polygons"|"sun"|"light"} */ mode: "control",
  /** @type {string|null} */ point: null,
  /** @type {string|null} */ polygon: null,
  /** @type {any[]} */ panes: [],
  active: 0,
  /** @type {Tool|null} */ tool: null,
  arrows: 10,
  curves: true,
  predictions: true,
  /** Lines over the photos: what the mode needs, all, none. */
  /** @type {"auto"|"all"|"none"} */ lines: "auto",
  /** @type {string|null} the key of a sample, see samples.js */ sample: null,
  isLoupe: true,
  isNamed: false
};

/** The window with the lists alone tells those with panes what was chosen in it. */
const windows = new BroadcastChannel("insitu-prepare");
windows.onmessage = ({data}) => {
  if (ui.panes.length === 0) return;
  if (data.point) choosePoint(data.point);
  if (data.photo) showPhoto(data.photo);
};

/**
 * The pane that keys act on.
 * @returns {any}
 */
export const activePane = () => ui.panes[ui.active];

/** @param {number} place */
export function setActive(place) {
  if (place === ui.active || !ui.panes[place]) return;
  ui.active = place;
  live.send({focus: activePane().photo?.name});
  emit("selection");
}

/** Lines as the mode needs them, all, none, ... */
export function stepLines() {
  ui.lines = /** @type {const} */ ({auto: "all", all: "none", none: "auto"})[ui.lines];
  emit("view");
}

/** @param {"control"|"polygons"|"sun"|"light"} mode */
export function setMode(mode) {
  if (ui.mode === mode) return;
  setTool(null);
  ui.mode = mode;
  emit("mode");
}

/**
 * Ends the tool there is and begins another.
 * @param {Tool|null} tool
 */
export function setTool(tool) {
  const before = ui.tool;
  ui.tool = tool;
  for (const pane of ui.panes) pane.isMoved = false; // a place that was meant for what went before
  if (before && before !== tool) before.cancelled?.();
  emit("tool");
}

/**
 * Where a point is on a photo: its mark, else its prediction.
 * @param {string} photo
 * @param {string} point
 */
export function placeOf(photo, point) {
  const one = mark(photo, point) ?? prediction(photo, point);
  return one ? {x: one.x, y: one.y} : null;
}

/**
 * Makes a point the current one and brings the crosshairs to it; a tool takes it instead.
 * @param {string|null} point
 * @param {boolean} [moves] panes to it
 */
export function choosePoint(point, moves = true) {
  if (point !== null && ui.tool?.pickPoint) {
    ui.tool.pickPoint(point);
    for (const pane of ui.panes) pane.isMoved = false;
    emit("view");
    return;
  }
  ui.point = point;
  if (ui.panes.length === 0) windows.postMessage({point});
  if (point !== null) for (const pane of ui.panes) pane.goTo(point, moves);
  emit("selection");
}

/** @param {string} name */
export function choosePolygon(name) {
  if (ui.tool?.pickPolygon) ui.tool.pickPolygon(name);
  else ui.polygon = name;
  emit("selection");
}

/**
 * The photos on which a point is or may be: marked, predicted there, or nothing known.
 * @param {string} point
 */
export function photosOf(point) {
  const isKnown = state.adjusted?.points?.[point] !== undefined;
  return state.photos
    .map(photo => photo.name)
    .filter(
      name =>
        mark(name, point) ||
        (isKnown && state.adjusted.photos?.[name]?.oriented ? prediction(name, point) : true)
    );
}

/** Names of the points: worst first. */
export function pointsByWorst() {
  return [...indexed().points.values()].sort(
    (a, b) => (b.w ?? -1) - (a.w ?? -1) || a.name.localeCompare(b.name, undefined, {numeric: true})
  );
}

/**
 * "good", "suspect", "bad" or "unknown".
 * @param {string} photo
 * @param {string} point
 */
export function gradeOf(photo, point) {
  return grade(adjustedMark(photo, point)?.w);
}
/** @param {number|null|undefined} w */
export function grade(w) {
  if (w === null || w === undefined) return "unknown";
  return Math.abs(w) < 2 ? "good" : Math.abs(w) < 3.29 ? "suspect" : "bad";
}

/**
 * Shows a photo in the active pane, or goes to the pane that shows it.
 * @param {string} name
 */
export function showPhoto(name) {
  if (ui.panes.length === 0) return windows.postMessage({photo: name});
  const shownIn = ui.panes.findIndex(pane => pane.photo?.name === name);
  if (shownIn >= 0) setActive(shownIn);
  else if (photoOf(name)) activePane().setPhoto(photoOf(name));
  live.send({focus: name});
  if (ui.point !== null) activePane().goTo(ui.point, true);
  activePane().focus();
  emit("selection");
}
