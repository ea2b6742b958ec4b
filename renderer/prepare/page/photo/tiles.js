// SPDX-License-Identifier: GPL-3.0-or-later
// Tiles of photographs: fetched by need, the newest wishes first, kept until newer ones need the room.

import {getBlob} from "../site/api.js";

export const kTile = 512;
const kMostKept = 256,
  kMostAtOnce = 6;

/** @type {Map<string, ImageBitmap>} by use, the latest last */
const kept = new Map();
/** @type {Map<string, {path: string, wanted: number}>} */
const wishes = new Map();
const underway = new Set();
/** Keys of tiles that are shown until their newer state is here. */
const stale = new Set();
/** @type {Map<string, number>} until when a tile that failed is not asked for again */
const failed = new Map();
let turn = 0;
/** @type {() => void} */
let arrived = () => {};
/** @type {(photo: number, why: string) => void} */
let undecodable = () => {};

/** @param {() => void} listener called when there are new tiles */
export const onTiles = listener => {
  arrived = listener;
};

/** @param {(photo: number, why: string) => void} listener called when a photo cannot be decoded */
export const onUndecodable = listener => {
  undecodable = listener;
};

/** The tile, if it is here. */
export function tileIfHere(photo, level, x, y) {
  const key = `${photo}/${level}/${x}/${y}`;
  const tile = kept.get(key);
  if (tile) {
    kept.delete(key);
    kept.set(key, tile);
  }
  return tile;
}

/**
 * Asks for a tile, unless it is here: then true. What is not asked for again in the next frames is given up.
 * @returns {boolean}
 */
export function wishTile(photo, level, x, y) {
  const key = `${photo}/${level}/${x}/${y}`;
  if (kept.has(key) && !stale.has(key)) return true;
  if (underway.has(key) || (failed.get(key) ?? 0) > performance.now()) return false;
  wishes.set(key, {path: `/api/tile?photo=${photo}&level=${level}&x=${x}&y=${y}`, wanted: turn});
  return false;
}

/**
 * What changes on the server is asked for anew, and stays until that is here.
 * @param {number} photo
 * @param {(level: number, x: number, y: number) => boolean} [isChanged]
 */
export function renewTiles(photo, isChanged = () => true) {
  for (const key of [...kept.keys(), ...underway]) {
    const [of, level, x, y] = key.split("/").map(Number);
    if (of === photo && isChanged(level, x, y)) stale.add(key);
  }
}

/** After a frame's wishes. */
export function fetchTiles() {
  turn += 1;
  for (const [key, wish] of wishes) if (wish.wanted < turn - 30) wishes.delete(key);
  const newest = [...wishes].sort((a, b) => b[1].wanted - a[1].wanted);
  for (const [key, wish] of newest) {
    if (underway.size >= kMostAtOnce) return;
    wishes.delete(key);
    underway.add(key);
    fetchTile(key, wish.path);
  }
}

async function fetchTile(key, path) {
  stale.delete(key);
  try {
    const tile = await createImageBitmap(await getBlob(path));
    kept.get(key)?.close();
    kept.set(key, tile);
    while (kept.size > kMostKept) {
      const [oldest, tile] = kept.entries().next().value;
      tile.close();
      kept.delete(oldest);
    }
  } catch (error) {
    if (error.status === 400) undecodable(Number(key.split("/")[0]), error.message);
    failed.set(key, performance.now() + 2000);
    setTimeout(() => arrived(), 2100);
  }
  underway.delete(key);
  arrived();
  fetchTiles();
}
