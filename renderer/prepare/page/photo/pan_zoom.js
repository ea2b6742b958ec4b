// SPDX-License-Identifier: GPL-3.0-or-later
// Hands that move a picture: a drag, two fingers, the wheel.

/**
 * By what a hand has moved [CSS px].
 * @param {any} pane a Zoomed
 * @param {number} dx
 * @param {number} dy
 */
export function pan(pane, dx, dy) {
  pane.isFitted = false;
  // Unrounded sums, or slow drags would lag behind the hand.
  pane.rest = {x: (pane.rest?.x ?? 0) + dx, y: (pane.rest?.y ?? 0) + dy};
  const tx = pane.tx,
    ty = pane.ty;
  pane.setView(pane.k, tx + pane.rest.x, ty + pane.rest.y);
  pane.rest = {x: pane.rest.x - (pane.tx - tx), y: pane.rest.y - (pane.ty - ty)};
}

/**
 * Two fingers: what is between them stays between them.
 * @param {any} pane a Zoomed
 * @param {Map<number, {x: number, y: number}>} down fingers, as they were
 * @param {number} id of the one that has moved
 * @param {{x: number, y: number}} at where it is now
 */
export function pinch(pane, down, id, at) {
  const before = /** @type {{x: number, y: number}} */ (down.get(id));
  const [, other] = /** @type {[number, any]} */ ([...down].find(([key]) => key !== id));
  const scale =
    Math.hypot(at.x - other.x, at.y - other.y) / Math.hypot(before.x - other.x, before.y - other.y);
  const middle = {x: (before.x + other.x) / 2, y: (before.y + other.y) / 2};
  if (Number.isFinite(scale) && scale > 0) pane.zoomAt(pane.k * scale, middle.x, middle.y);
  pan(pane, (at.x - before.x) / 2, (at.y - before.y) / 2);
}

/**
 * The scale after a turn of the wheel.
 * @param {number} k
 * @param {WheelEvent} event
 */
export const wheelScale = (k, event) =>
  k * 2 ** ((-event.deltaY * (event.deltaMode === 1 ? 33 : 1)) / 250);
