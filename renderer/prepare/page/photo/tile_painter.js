// SPDX-License-Identifier: GPL-3.0-or-later
// A picture painted from its tiles.

import {kTile, tileIfHere, wishTile} from "./tiles.js";

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/**
 * Onto what is seen of a canvas, all in device pixels: screen = k (p + 1/2) + t. False: until tiles are
 * here that are not yet, coarser ones stand for them.
 * @param {CanvasRenderingContext2D} context
 * @param {{index: number, width: number, height: number, levels: number}} picture
 * @param {number} k
 * @param {number} tx
 * @param {number} ty
 * @returns {boolean}
 */
export function paintTiles(context, picture, k, tx, ty) {
  const {index, width, height, levels} = picture;
  const level = clamp(Math.floor(-Math.log2(k) + 1e-6), 0, levels - 1),
    side = kTile * 2 ** level;
  context.imageSmoothingEnabled = k < 1;
  context.save();
  context.beginPath();
  context.rect(
    Math.round(tx),
    Math.round(ty),
    Math.round(k * width + tx) - Math.round(tx),
    Math.round(k * height + ty) - Math.round(ty)
  );
  context.clip();
  const last = (extent, shift, size) =>
    Math.min(Math.floor((extent - shift) / k / side), Math.ceil(size / side) - 1);
  const first = shift => Math.max(0, Math.floor(-shift / k / side));
  let isWhole = wishTile(index, levels - 1, 0, 0); // the overview, which is shown until finer tiles are here
  for (let y = first(ty); y <= last(context.canvas.height, ty, height); ++y) {
    for (let x = first(tx); x <= last(context.canvas.width, tx, width); ++x) {
      isWhole = wishTile(index, level, x, y) && isWhole;
      paintTile(context, picture, {level, x, y}, k * side, tx, ty);
    }
  }
  context.restore();
  return isWhole;
}

/** A tile, or until it is here its part of a coarser one. */
function paintTile(context, {index, levels}, {level, x, y}, size, tx, ty) {
  const left = Math.round(tx + x * size),
    right = Math.round(tx + (x + 1) * size);
  const top = Math.round(ty + y * size),
    bottom = Math.round(ty + (y + 1) * size);
  for (let up = 0; level + up < levels; ++up) {
    const tile = tileIfHere(index, level + up, x >> up, y >> up);
    if (!tile) continue;
    const part = kTile / 2 ** up;
    context.drawImage(
      tile,
      (x - ((x >> up) << up)) * part,
      (y - ((y >> up) << up)) * part,
      part,
      part,
      left,
      top,
      right - left,
      bottom - top
    );
    return;
  }
}
