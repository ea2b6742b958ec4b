// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to look at, and what of it the page shows.

import {ask, connectLive, getJson} from "../../prepare/page/site/api.js";
import {emit} from "../../prepare/page/site/signals.js";
import {renewTiles} from "../../prepare/page/photo/tiles.js";
import {t} from "./words/view_words.js";

/**
 * @typedef {{id: number, kind: string, name: string, of?: string, frame: string, width: number, height: number,
 *   levels: number, version: string, fault?: string, summary?: any}} Picture
 * @typedef {{state: string, done?: number, total?: number}} Render
 * @typedef {{name: string, pictures: Picture[], render: Render, fault?: string}} Photo
 */

export const state = {
  name: "",
  /** @type {Photo[]} */ photos: [],
  /** Of the photograph that a render of this page is at; "": none. */
  running: "",
  isConnected: false,
  /** Of a pipe: nothing can be begun. */
  isStream: false,
  /** What is wrong with it. */
  fault: "",
  /** @type {string[]} what the render said last */
  lines: []
};

export const shown = {
  photo: "",
  /** Ids of pictures; -1: none. */
  left: -1,
  right: -1,
  /** @type {"side"|"slider"|"flicker"} */ mode: "slider",
  split: 0.5,
  /** Which one flicker shows. */
  /** @type {"left"|"right"} */ side: "right",
  isAuto: false,
  isOutline: false,
  /** @type {Picture|null} of left and right, in the place of right */
  difference: null,
  cursor: {x: 0, y: 0}
};

/** @param {string} name */
export const photoOf = name => state.photos.find(photo => photo.name === name);
export const photo = () => photoOf(shown.photo);
/** @param {number} id */
export const pictureOf = id => photo()?.pictures.find(picture => picture.id === id) ?? null;
export const leftPicture = () => pictureOf(shown.left);
export const rightPicture = () => shown.difference ?? pictureOf(shown.right);

/** Of "variant@hour~quality", each in words. */
function madeOf(name) {
  const [made, quality] = name.split("~");
  const [variant, hour] = made.split("@");
  return [
    variant && t("variant", {name: variant}),
    hour && t("hour", {name: hour}),
    quality
  ].filter(Boolean);
}

/** @param {Picture|null} picture */
export function pictureName(picture) {
  if (!picture) return t("noPicture");
  const names = madeOf(picture.of ?? picture.name);
  const withNames = text => [text, ...names].join(", ");
  if (picture.kind === "layer") return withNames(t(`layer_${picture.name}`));
  if (picture.kind === "part") return withNames(t("part", {name: picture.name}));
  return picture.kind === "montage" ? withNames(t("kind_montage")) : t(`kind_${picture.kind}`);
}

const has = picture => picture.fault === undefined;
const ofKind = (kind, frame) => one =>
  one.kind === kind && has(one) && (frame === undefined || one.frame === frame);

/** What is compared first: what is being rendered, else the montage, with the photograph of its grid. */
export function showUsual() {
  const pictures = photo()?.pictures ?? [];
  const after =
    pictures.find(ofKind("unfinished")) ?? pictures.find(ofKind("montage")) ?? pictures.find(has);
  const before =
    after?.frame === "pinhole" ? pictures.find(ofKind("input")) : pictures.find(ofKind("photo"));
  shown.right = after?.id ?? -1;
  shown.left = before?.id ?? after?.id ?? -1;
  shown.difference = null;
}

/** @param {string} name */
export function showPhoto(name) {
  if (!photoOf(name)) return;
  shown.photo = name;
  showUsual();
  const picture = rightPicture();
  if (picture) shown.cursor = {x: Math.floor(picture.width / 2), y: Math.floor(picture.height / 2)};
  emit("photo");
}

/** @param {number} by */
export function stepPhoto(by) {
  const at = state.photos.findIndex(one => one.name === shown.photo);
  const next = state.photos[at + by];
  if (next) showPhoto(next.name);
}

/**
 * @param {"left"|"right"} side
 * @param {number} id
 */
export function choose(side, id) {
  shown[side] = id;
  shown.difference = null;
  emit("pictures");
}

/** Pictures as they are now; what is shown stays if it is still there. */
async function load() {
  const before = new Map(state.photos.flatMap(one => one.pictures).map(one => [one.id, one.version]));
  const site = await getJson("/api/site");
  Object.assign(state, {name: site.name, photos: site.photos, running: site.running});
  state.isStream = site.stream === true;
  state.fault = site.fault ?? "";
  if (!photoOf(shown.photo) && shown.photo !== "") showPhoto(state.photos[0].name); // of a stream the next one
  for (const picture of site.photos.flatMap(one => one.pictures)) {
    if (before.has(picture.id) && before.get(picture.id) !== picture.version) renewTiles(picture.id);
  }
}

const unfinished = () => photo()?.pictures.find(ofKind("unfinished"));

/** After a change of the files: a render that begins is shown, one that has ended leaves its place to the montage. */
async function reload() {
  const before = unfinished(),
    wasShown = before?.id === shown.right;
  await load();
  const now = unfinished();
  if (!pictureOf(shown.right) || (now && !before) || (wasShown && !now)) showUsual();
  if (shown.difference) await showDifference();
  emit("pictures");
}

/** The difference of left and right in the place of right. */
export async function showDifference() {
  const answer = await ask("/api/difference", {before: shown.left, after: shown.right});
  if (answer.error) return answer.error;
  if (shown.difference && shown.difference.version !== answer.version) renewTiles(answer.id);
  shown.difference = {...answer, frame: pictureOf(shown.right)?.frame ?? "photo"};
  emit("pictures");
  return "";
}

/** @param {any} message of tiles that have come */
function takeTiles(message) {
  const one = photoOf(message.photo);
  if (!one) return;
  one.render = {state: message.state, done: message.done, total: message.total};
  const picture = one.pictures.find(ofKind("unfinished"));
  if (picture && message.tiles.length > 0) {
    renewTiles(picture.id, (level, x, y) => {
      const side = 512 * 2 ** level;
      return message.tiles.some(
        ([left, top, right, bottom]) =>
          left < (x + 1) * side && right > x * side && top < (y + 1) * side && bottom > y * side
      );
    });
  }
  emit("render");
}

export async function start() {
  await load();
  connectLive(
    message => {
      if (message.type === "pictures") reload();
      if (message.type === "render") takeTiles(message);
      if (message.type === "run") emit("run", message);
    },
    async isOpen => {
      state.isConnected = isOpen;
      if (isOpen) await reload().catch(() => {});
      emit("connection");
    }
  );
}
