// SPDX-License-Identifier: GPL-3.0-or-later
// Lines over a photo: polygons, the planned building, edges, pairs, epipolar curves, what is being drawn.

import {ask} from "../site/api.js";
import {svg} from "../words/dom.js";
import {mark, rows, state} from "../site/state.js";
import {emit} from "../site/signals.js";
import {placeOf, ui} from "../site/ui.js";
import {placed, ringsOf} from "../tools/outlines.js";

const path = (line, isClosed = false) =>
  `M${line.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L")}${isClosed ? "Z" : ""}`;

const lines = all => all.map(line => path(line)).join("");

/**
 * Draws anew only when what is shown has changed; zoom and pan only move the group.
 * @param {any} pane
 */
export function drawFigures(pane) {
  const {k, tx, ty} = pane.drawn,
    figures = pane.figures,
    photo = pane.photo.name;
  const transform = `matrix(${k} 0 0 ${k} ${tx + k / 2} ${ty + k / 2})`;
  if (figures.placed !== transform) figures.setAttribute("transform", (figures.placed = transform));
  if (figures.seen === pane.changes && !ui.tool?.outline) return;
  figures.seen = pane.changes;
  const shapes = [
    ...building(photo),
    ...polygons(photo),
    ...edges(photo),
    ...pairs(photo),
    ...curves(photo),
    ...drawing(photo, pane)
  ];
  const signature = shapes.map(shape => `${shape.class}|${shape.d}`).join("\n");
  if (figures.signature === signature) return;
  figures.signature = signature;
  figures.replaceChildren(
    ...shapes.flatMap(shape => [
      svg("path", {class: `casing ${shape.class}`, d: shape.d}),
      svg("path", {class: shape.class, d: shape.d, data: shape.data ?? {}})
    ])
  );
}

function* polygons(photo) {
  if (ui.lines === "none") return;
  const isCurrent = polygon => Number(polygon.name === ui.polygon); // drawn last, over its neighbours
  for (const polygon of rows("polygons").sort((a, b) => isCurrent(a) - isCurrent(b))) {
    const about = state.adjusted?.polygons?.[polygon.name],
      data = {polygon: polygon.name};
    const className = `polygon${isCurrent(polygon) ? " current" : ""}`;
    const seen = about?.images?.[photo],
      hidden = about?.hidden?.[photo];
    if (seen) yield {class: className, d: lines(seen), data};
    if (hidden) yield {class: `${className} hidden`, d: lines(hidden), data};
    if (seen || hidden) continue;
    const rings = ringsOf(polygon).map(names => placed(names, photo));
    if (rings[0].length > 2) {
      const d = rings.map(ring => (ring.length > 2 ? path(ring, true) : "")).join("");
      yield {class: `${className} flat`, d, data};
    }
  }
}

/** Off while marks are placed; faint, without the ellipses of its corners, until all lines are wanted. */
function* building(photo) {
  const isWanted = ui.lines === "all",
    images = state.building?.images?.[photo];
  if (ui.lines === "none" || (!isWanted && (ui.mode === "control" || ui.tool))) return;
  if (images?.length) yield {class: `building${isWanted ? "" : " faint"}`, d: lines(images)};
  if (!isWanted) return;
  for (const {x, y, major, minor, angle} of state.building?.corners?.[photo] ?? []) {
    yield {class: "building corner", d: ellipse(x, y, major, minor, angle)};
  }
}

function ellipse(x, y, major, minor, angle) {
  const points = Array.from({length: 24}, (_, i) => (i * Math.PI) / 12).map(a => {
    const u = major * Math.cos(a),
      v = minor * Math.sin(a);
    return /** @type {[number, number]} */ ([
      x + u * Math.cos(angle) - v * Math.sin(angle),
      y + u * Math.sin(angle) + v * Math.cos(angle)
    ]);
  });
  return path(points, true);
}

function* edges(photo) {
  const isShown = ui.mode === "sun" || ui.mode === "polygons" || ui.lines === "all";
  for (const edge of isShown ? rows("edges") : []) {
    if (edge.photo !== photo) continue;
    const isOff = edge.state === "off";
    yield {
      class: `edge${isOff ? " off" : ""}`,
      d: `M${edge.x - 4} ${edge.y}H${edge.x + 4}M${edge.x} ${edge.y - 4}V${edge.y + 4}`
    };
    const from = placeOf(photo, edge.from),
      to = placeOf(photo, edge.to);
    if (from && to && !isOff)
      yield {
        class: "edge line",
        d: path([
          [from.x, from.y],
          [to.x, to.y]
        ])
      };
  }
}

function* pairs(photo) {
  const ends = [
    ...rows("sun").map(one => ["sun", one.object, one.shadow]),
    ...rows("zenith").map(one => ["zenith", one.bottom, one.top])
  ];
  if (ui.mode !== "sun") return;
  for (const [kind, a, b] of ends) {
    const from = placeOf(photo, a),
      to = placeOf(photo, b);
    if (from && to)
      yield {
        class: kind,
        d: path([
          [from.x, from.y],
          [to.x, to.y]
        ])
      };
  }
}

/** The outline of the tool, with a last line to the crosshair. */
function* drawing(photo, pane) {
  const outline = ui.tool?.outline?.(photo) ?? [];
  if (outline.length === 0) return;
  const end = /** @type {[number, number][]} */ (
    pane.hover ? [[pane.hover.x, pane.hover.y]] : pane.isMoved ? [[pane.cursor.x, pane.cursor.y]] : []
  );
  yield {class: "drawn", d: path([...outline, ...end], outline.length + end.length > 2)};
}

/** @typedef {[number, number][]} Line */
/** @type {Map<string, {key: string, curve: Line, band: Line}>} by photo */
const known = new Map();

/** Epipolar curves of the current point's marks on other photos, each in its band of 95 %. */
function* curves(photo) {
  if (!ui.curves || ui.point === null || mark(photo, ui.point)) return;
  for (const one of rows("observations")) {
    if (one.point !== ui.point || one.photo === photo || one.state === "off") continue;
    const name = `${photo}\n${one.photo}`;
    const key = `${one.point}\n${one.x}\n${one.y}\n${one.sigma}\n${state.adjusted?.revision}`;
    const before = known.get(name);
    if (before?.key !== key) {
      const {curve, band} = before?.key.startsWith(`${one.point}\n`) ? before : {curve: [], band: []};
      known.set(name, {key, curve, band});
      fetchCurve(name, key, {photo: one.photo, x: one.x, y: one.y, sigma: one.sigma, other: photo});
    }
    const {curve, band} = /** @type {any} */ (known.get(name));
    if (curve.length < 2) continue;
    if (band.length === curve.length) yield {class: "band", d: path(around(curve, band), true)};
    yield {class: "epipolar", d: path(curve)};
  }
}

/** Along one side of a curve and back along the other. */
function around(curve, band) {
  const side = sign => curve.map(([x, y], i) => [x + sign * band[i][0], y + sign * band[i][1]]);
  return [...side(1), ...side(-1).reverse()];
}

async function fetchCurve(name, key, question) {
  const answer = await ask("/api/epipolar", question);
  if (known.get(name)?.key !== key) return;
  known.set(name, {key, curve: answer.curve ?? [], band: answer.band ?? []});
  emit("view");
}
