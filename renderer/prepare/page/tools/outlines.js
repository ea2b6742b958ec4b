// SPDX-License-Identifier: GPL-3.0-or-later
// A polygon's rings as a photo shows them: its outline and its holes.

import {placeOf} from "../site/ui.js";

/** @typedef {[number, number][]} Ring */

/** Names of each ring, the outline first. */
export const ringsOf = polygon => [polygon.vertices, ...(polygon.holes ?? [])];

/**
 * @param {string[]} names
 * @param {string} photo
 * @returns {Ring} empty if not all places are known
 */
export function placed(names, photo) {
  const places = names.map(name => placeOf(photo, name));
  return places.every(at => at)
    ? places.map(at => [/** @type {any} */ (at).x, /** @type {any} */ (at).y])
    : [];
}

/**
 * @param {Ring} ring
 * @param {number} x
 * @param {number} y
 */
export function isInside(ring, x, y) {
  let inside = false;
  ring.forEach(([x1, y1], i) => {
    const [x2, y2] = ring[(i + 1) % ring.length];
    if (y1 > y !== y2 > y && x < ((x2 - x1) * (y - y1)) / (y2 - y1) + x1) inside = !inside;
  });
  return inside;
}

/** Whether a photo shows the polygon at a pixel: within its outline and in no hole. */
export function isSeenAt(polygon, photo, x, y) {
  const [outline, ...holes] = ringsOf(polygon).map(names => placed(names, photo));
  return isInside(outline, x, y) && !holes.some(hole => isInside(hole, x, y));
}

/** @param {Ring} ring */
export const area = ring =>
  Math.abs(
    ring.reduce((sum, [x, y], i) => {
      const [u, v] = ring[(i + 1) % ring.length];
      return sum + x * v - u * y;
    }, 0)
  );

/** A pixel that shows the polygon: its middle or, if that is in a hole, on the way to a vertex. */
export function pixelOf(polygon, photo) {
  const outline = placed(polygon.vertices, photo);
  if (outline.length === 0) return null;
  const mean = axis => outline.reduce((sum, at) => sum + at[axis], 0) / outline.length;
  const middle = [mean(0), mean(1)];
  const ways = outline.flatMap(([x, y]) =>
    [0.5, 0.8].map(part => [middle[0] + part * (x - middle[0]), middle[1] + part * (y - middle[1])])
  );
  const [x, y] = [middle, ...ways].find(([u, v]) => isSeenAt(polygon, photo, u, v)) ?? middle;
  return {x: Math.round(x), y: Math.round(y)};
}

/** Square of the distance from a place to a segment. */
function fromSegment([x1, y1], [x2, y2], x, y) {
  const [u, v] = [x2 - x1, y2 - y1],
    along = ((x - x1) * u + (y - y1) * v) / (u * u + v * v || 1),
    share = Math.min(Math.max(along, 0), 1);
  return (x1 + share * u - x) ** 2 + (y1 + share * v - y) ** 2;
}

/**
 * The ends of the polygon's edge that is nearest to a pixel; null where none of its edges has both.
 * @param {any} polygon
 * @param {string} photo
 * @param {number} x
 * @param {number} y
 * @returns {[string, string]|null}
 */
export function nearestEdge(polygon, photo, x, y) {
  /** @type {[string, string]|null} */
  let nearest = null;
  let least = Infinity;
  for (const names of ringsOf(polygon)) {
    names.forEach((from, i) => {
      const to = names[(i + 1) % names.length],
        [a, b] = [placeOf(photo, from), placeOf(photo, to)];
      const distance = a && b ? fromSegment([a.x, a.y], [b.x, b.y], x, y) : Infinity;
      if (distance < least) [nearest, least] = [[from, to], distance];
    });
  }
  return nearest;
}
