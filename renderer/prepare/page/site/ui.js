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

/** @typedef {"control"|"polygons"|"sun"|"light"|"film"} Mode */

/**
 * What the keys and gestures do in a mode in which something else than points is placed.
 * @typedef {object} Hands
 * @property {(pane: any, x: number, y: number, isShift: boolean, isTouch: boolean) => void} click
 * @property {(pane: any, isShift: boolean) => void} confirm
 * @property {(pane: any, dx: number, dy: number) => void} nudge
 * @property {() => void} remove
 * @property {() => void} toggleOff
 * @property {() => void} toggleDubious
 * @property {(by: number) => void} step
 * @property {() => void} suspect the next worse
 * @property {(pane: any) => void} refine
 * @property {(name: string) => void} take a name typed
 * @property {() => void} settle
 * @property {() => void} cancel
 * @property {() => string} current its name
 * @property {() => string[]} names
 * @property {(photo: string) => {x: number, y: number}|null} place of the current one
 * @property {(pane: any, x: number, y: number) => boolean} isDraggable
 * @property {(pane: any, at: {x: number, y: number}, isEnd: boolean) => void} drag
 */
/** @type {Partial<Record<Mode, Hands>>} */
const handsOf = {};
/** Those of the mode; none: points are placed, or a tool takes them. */
export const hands = () => (ui.tool ? undefined : handsOf[ui.mode]);
/**
 * @param {Mode} mode
 * @param {Hands} made
 */
export function addHands(mode, made) {
  handsOf[mode] = made;
}

export const ui = {
  /** @type {Mode} */ mode: "control",
  /** @type {string|null} */ point: null,
  /** @type {string|null} */ polygon: null,
  /** @type {string|null} */ fiducial: null,
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

/** @param {Mode} mode */
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
 * Where what is to be placed is on a photo, if that is known.
 * @param {string} photo
 */
export function currentPlace(photo) {
  const other = hands();
  if (other) return other.place(photo);
  return ui.point === null ? null : placeOf(photo, ui.point);
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
  const about = state.adjusted?.points?.[point];
  const isKnown = about !== undefined && !about.plane; // which may not be the one it stands on
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
  activePane().toCurrent(true);
  activePane().focus();
  emit("selection");
}
