// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of the light on the photos: the shape tells the kind, the colour how far it is off.

import {svg} from "../words/dom.js";
import {shown} from "../words/numbers.js";
import {emit} from "../site/signals.js";
import {isLightAwaited, rows, state} from "../site/state.js";
import {ui} from "../site/ui.js";
import {t} from "../words/words.js";

export const kKinds = ["horizon", "haze", "daylight"];

/** A rising sun, banks of mist, a sun with rays. */
const kShapes = {
  horizon: "M-8 4H8M-5 4A5 5 0 0 1 5 4",
  haze: "M-7 -5Q-3.5 -8 0 -5T7 -5M-7 0Q-3.5 -3 0 0T7 0M-7 5Q-3.5 2 0 5T7 5",
  daylight:
    "M-4 0A4 4 0 1 1 4 0A4 4 0 1 1 -4 0M0 -6V-9M0 6V9M-6 0H-9M6 0H9" +
    "M-4.3 -4.3L-6.4 -6.4M4.3 -4.3L6.4 -6.4M-4.3 4.3L-6.4 6.4M4.3 4.3L6.4 6.4"
};
const kOut = "M-9 -9L9 9M9 -9L-9 9",
  kDot = "M-1.5 0H1.5M0 -1.5V1.5";
const kSuspect = 0.1,
  kBad = 0.25, // of what the sample should be
  kReach = 10; // CSS px

/**
 * By what a sample is known on the page.
 * @param {string} kind
 * @param {any} row
 */
export const sampleKey = (kind, row) => [kind, row.photo, row.x, row.y].join("\n");

/** @typedef {{key: string, kind: string, row: any, residual: number|null, level: string, isOut: boolean}} Sample */
/** @type {{from: any[], all: Sample[]}} */
let made = {from: [], all: []};

/**
 * All samples with what the light's measurement says of them; `isOut`: it left them out.
 * @returns {Sample[]}
 */
export function samples() {
  const {light, tables} = state,
    isAwaited = isLightAwaited();
  const from = [light, isAwaited, ...kKinds.map(kind => tables[kind])];
  if (from.every((one, i) => one === made.from[i]) && made.all.length === count()) return made.all;
  const residuals = new Map();
  for (const kind of kKinds)
    for (const one of light?.samples?.[kind] ?? []) residuals.set(sampleKey(kind, one), one.residual);
  const all = kKinds.flatMap(kind =>
    rows(kind).map(row => {
      const key = sampleKey(kind, row),
        residual = residuals.get(key) ?? null;
      const isOut = !isAwaited && residual === null && (light?.samples?.[kind]?.length ?? 0) > 0;
      return {key, kind, row, residual, level: isOut ? "off" : gradeOf(residual), isOut};
    })
  );
  made = {from, all};
  return all;
}
const count = () => kKinds.reduce((sum, kind) => sum + rows(kind).length, 0);

const gradeOf = residual =>
  residual === null
    ? "unknown"
    : Math.abs(residual) < kSuspect
      ? "good"
      : Math.abs(residual) < kBad
        ? "suspect"
        : "bad";

/**
 * How far a sample is off, in percent.
 * @param {Sample} sample
 */
export const offText = sample =>
  sample.residual === null
    ? "–"
    : `${sample.residual > 0 ? "+" : ""}${shown(100 * sample.residual, 1)} %`;

/**
 * The sample nearest to a place of a photo, if within reach.
 * @param {any} pane
 * @param {number} x
 * @param {number} y
 */
export function sampleAt(pane, x, y) {
  const near = samples()
    .filter(one => one.row.photo === pane.photo?.name)
    .map(one => ({one, far: Math.hypot(one.row.x - x, one.row.y - y) * pane.k}))
    .filter(({far}) => far <= kReach)
    .sort((a, b) => a.far - b.far);
  return near[0]?.one ?? null;
}

/** @param {Sample|null} sample */
export function chooseSample(sample) {
  ui.sample = sample?.key ?? null;
  emit("selection");
}

/** @param {any} pane */
export function drawSamples(pane) {
  const nodes = pane.sampleNodes,
    wanted = new Set(),
    {width, height} = pane;
  for (const sample of samples()) {
    if (sample.row.photo !== pane.photo.name) continue;
    const at = pane.toScreen(sample.row.x, sample.row.y);
    if (at.x < -width || at.y < -height || at.x > 2 * width || at.y > 2 * height) continue;
    wanted.add(sample.key);
    if (!nodes.has(sample.key))
      pane.sampleLayer.append(nodes.set(sample.key, make(sample)).get(sample.key));
    update(nodes.get(sample.key), sample, at, pane.k);
  }
  for (const [key, old] of nodes) {
    if (wanted.has(key)) continue;
    old.remove();
    nodes.delete(key);
  }
}

function make(sample) {
  const shape = svg("path", {class: "shape"}),
    casing = svg("path", {class: "casing shape"});
  const dots = ["casing dot", "dot"].map(name => svg("path", {class: name, d: kDot}));
  const text = svg("text", {x: 12, y: -7});
  const group = svg("g", {tabindex: -1, role: "button"}, casing, shape, ...dots, text);
  group.addEventListener("keydown", event => {
    if (event.key !== "Enter" && event.key !== " ") return;
    chooseSample(sample);
    event.stopPropagation();
    event.preventDefault();
  });
  return group;
}

function update(group, sample, at, k) {
  const isCurrent = sample.key === ui.sample && ui.mode === "light";
  const set = (made_, name, value) => {
    if (made_.getAttribute(name) !== value) made_.setAttribute(name, value);
  };
  set(group, "transform", `translate(${at.x.toFixed(2)} ${at.y.toFixed(2)})`);
  set(group, "class", `mark sample ${sample.kind} ${sample.level}${isCurrent ? " current" : ""}`);
  set(group, "aria-label", [t(sample.kind), sample.row.polygon ?? "", offText(sample)].join(" "));
  const scale = ui.mode !== "light" || (k < 0.6 && !isCurrent) ? "scale(.7)" : "scale(1)";
  for (const i of [0, 1]) {
    set(group.childNodes[i], "d", kShapes[sample.kind] + (sample.isOut ? kOut : ""));
    set(group.childNodes[i], "transform", scale);
  }
  const text = isCurrent ? offText(sample) : sample.level === "bad" && ui.mode === "light" ? "!" : "";
  if (group.lastChild.textContent !== text) group.lastChild.textContent = text;
}
