// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs as the measured light says they would look without the sun, and in the sun alone: made by
// the server when a pane asks, anew after every change of the light.

import {getBlob, getJson} from "../site/api.js";
import {on, redraw} from "../site/signals.js";
import {shown} from "../words/numbers.js";
import {nearPlace, said, t} from "../words/words.js";

/** @typedef {"photo"|"none"|"sun"} Light */
/** @typedef {{picture: ImageBitmap|null, text: string, isFault: boolean}} Relit */

const kPause = 300, // [ms] between questions whether it is made
  kMostKept = 16;
const kNext = /** @type {const} */ ({photo: "none", none: "sun", sun: "photo"});

/** @type {Map<string, Relit>} by photo and light, the latest last */
const kept = new Map();
/** @type {Set<string>} */
const underway = new Set();
let epoch = 0; // of the light

/**
 * As it is, without the sun, in the sun alone, ...
 * @param {any} pane
 */
export function stepLight(pane) {
  if (!pane?.photo) return;
  pane.light = kNext[/** @type {Light} */ (pane.light)];
  redraw();
}

/**
 * What a pane shows instead of its photograph; the last one until a newer is here.
 * @param {number} photo
 * @param {Light} light
 * @returns {Relit}
 */
export function relit(photo, light) {
  const key = `${photo}/${light}`;
  const made = kept.get(key);
  if (made?.["epoch"] !== epoch && !underway.has(key)) fetchRelit(key, photo, light);
  return made ?? {picture: null, text: t("relitSoon"), isFault: false};
}

async function fetchRelit(key, photo, light) {
  underway.add(key);
  const of = epoch,
    query = `?photo=${photo}&light=${light}`;
  try {
    const about = await getJson(`/api/relit${query}`, [409]);
    if (about.photo === undefined && !about.error) {
      setTimeout(() => {
        underway.delete(key);
        redraw();
      }, kPause);
      return;
    }
    const picture = about.error
      ? null
      : await createImageBitmap(await getBlob(`/api/relit_picture${query}`));
    keep(key, {picture, text: textOf(about), isFault: Boolean(about.error), epoch: of});
  } catch (error) {
    keep(key, {picture: null, text: String(error.message ?? error), isFault: true, epoch: of});
  }
  underway.delete(key);
  redraw();
}

const textOf = about =>
  about.error
    ? t("relitNot", {why: nearPlace(said(about, "error"))})
    : t("relitNote", {times: shown(about.exposure, 1), percent: Math.round(100 * about.share)});

function keep(key, made) {
  kept.get(key)?.picture?.close();
  kept.delete(key);
  kept.set(key, made);
  while (kept.size > kMostKept) {
    const [oldest, one] = kept.entries().next().value;
    one.picture?.close();
    kept.delete(oldest);
  }
}

on("light adjusted", () => {
  epoch += 1;
});
