// SPDX-License-Identifier: GPL-3.0-or-later
// Left and right on one canvas: side by side, with a border between them, or in turn. Both have the
// same place and zoom.

import {leftPicture, pictureName, rightPicture, shown} from "./state.js";
import {drawOutline} from "./outline.js";
import {byId, node} from "../../prepare/page/words/dom.js";
import {emit, on, redraw} from "../../prepare/page/site/signals.js";
import {pan, pinch, wheelScale} from "../../prepare/page/photo/pan_zoom.js";
import {paintTiles} from "../../prepare/page/photo/tile_painter.js";
import {fetchTiles, onTiles} from "../../prepare/page/photo/tiles.js";
import {t} from "./words/view_words.js";
import {Zoomed} from "../../prepare/page/photo/zoom.js";

const kAutoMs = 800; // well below three flashes a second

/** Where a half of the stage, or all of it, shows the picture. */
export const zoomed = new Zoomed();

const stage = () => byId("stage");
const isSide = () => shown.mode === "side";

/** Left edge of what the pictures are shown in [CSS px], of each half alike. */
const halfOf = x => (isSide() && x >= (zoomed.width ?? 0) ? 1 : 0);

/** From the stage's to a half's place. */
const local = event => {
  const box = stage().getBoundingClientRect(),
    x = event.clientX - box.left;
  return {x: x - halfOf(x) * (zoomed.width ?? 0), y: event.clientY - box.top};
};

function resize() {
  const box = stage().getBoundingClientRect(),
    canvas = byId("canvas"),
    width = isSide() ? box.width / 2 : box.width;
  if (box.width === 0) return;
  const dx = (width - (zoomed.width ?? width)) / 2,
    dy = (box.height - (zoomed.height ?? box.height)) / 2;
  zoomed.width = width;
  zoomed.height = box.height;
  canvas.width = Math.round(box.width * devicePixelRatio);
  canvas.height = Math.round(box.height * devicePixelRatio);
  if (zoomed.isFitted) zoomed.fit();
  else zoomed.setView(zoomed.k, zoomed.tx + dx, zoomed.ty + dy);
  paint();
}

/** What is shown where: the picture, its half, and the part of the half [0, 1]. */
function parts() {
  const left = leftPicture(),
    right = rightPicture();
  if (isSide())
    return [
      {picture: left, half: 0, from: 0, to: 1},
      {picture: right, half: 1, from: 0, to: 1}
    ];
  if (shown.mode === "flicker")
    return [{picture: shown.side === "left" ? left : right, half: 0, from: 0, to: 1}];
  return [
    {picture: left, half: 0, from: 0, to: shown.split},
    {picture: right, half: 0, from: shown.split, to: 1}
  ];
}

function paint() {
  const canvas = byId("canvas"),
    context = canvas.getContext("2d", {alpha: false}),
    ratio = devicePixelRatio,
    width = (zoomed.width ?? 0) * ratio;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = "#15191c";
  context.fillRect(0, 0, canvas.width, canvas.height);
  for (const {picture, half, from, to} of parts()) {
    context.save();
    context.beginPath();
    const begin = Math.round((half + from) * width);
    context.rect(begin, 0, Math.round((half + to) * width) - begin, canvas.height);
    context.clip();
    const tx = zoomed.tx * ratio + Math.round(half * width);
    if (picture && picture.fault === undefined)
      paintTiles(context, {...picture, index: picture.id}, zoomed.k * ratio, tx, zoomed.ty * ratio);
    drawOutline(context, picture, zoomed.k * ratio, tx, zoomed.ty * ratio);
    drawCursor(context, tx, ratio);
    context.restore();
  }
  drawBorder(context, canvas, width);
  fetchTiles();
}

function drawBorder(context, canvas, width) {
  const at = isSide() ? width : shown.mode === "slider" ? shown.split * width : -10;
  context.fillStyle = "#000";
  context.fillRect(Math.round(at) - 2, 0, 4, canvas.height);
  context.fillStyle = "#fff";
  context.fillRect(Math.round(at) - 1, 0, 2, canvas.height);
}

/** The pixel under the cursor as a square, or a cross where pixels are small. */
function drawCursor(context, tx, ratio) {
  const k = zoomed.k * ratio,
    x = k * shown.cursor.x + tx,
    y = k * shown.cursor.y + zoomed.ty * ratio;
  for (const [color, width] of /** @type {[string, number][]} */ ([
    ["#000c", 3 * ratio],
    ["#fff", ratio]
  ])) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.beginPath();
    if (k >= 6) context.rect(x, y, k, k);
    else
      for (const [dx, dy] of [
        [1, 0],
        [-1, 0],
        [0, 1],
        [0, -1]
      ]) {
        context.moveTo(x + k / 2 + 4 * ratio * dx, y + k / 2 + 4 * ratio * dy);
        context.lineTo(x + k / 2 + 12 * ratio * dx, y + k / 2 + 12 * ratio * dy);
      }
    context.stroke();
  }
}

function label(text, place, isUnfinished) {
  return node("span", {
    class: `label ${place}${isUnfinished ? " unfinished" : ""}`,
    text: text + (isUnfinished ? ` (${t("hatched")})` : "")
  });
}

function drawLabels() {
  const left = leftPicture(),
    right = rightPicture(),
    text = picture => pictureName(picture),
    isHatched = picture => picture?.kind === "unfinished";
  const labels =
    shown.mode === "flicker"
      ? [
          shown.side === "left"
            ? label(`${t("before")}: ${text(left)}`, "at-left", isHatched(left))
            : label(`${t("after")}: ${text(right)}`, "at-left", isHatched(right))
        ]
      : [label(text(left), "at-left", isHatched(left)), label(text(right), isSide() ? "at-middle" : "at-right", isHatched(right))];
  byId("labels").replaceChildren(...labels);
  stage().setAttribute(
    "aria-label",
    t("stageLabel", {photo: shown.photo, left: text(left), right: text(right)})
  );
  const split = byId("split");
  split.hidden = shown.mode !== "slider";
  split.setAttribute("aria-label", t("split"));
  if (document.activeElement !== split) split.value = String(shown.split);
}

/** The picture that gives size and grid. */
const measure = () => rightPicture() ?? leftPicture();

/** The cursor to a pixel, in sight. */
export function moveCursor(x, y) {
  const picture = measure();
  if (!picture?.width) return;
  shown.cursor = {
    x: Math.min(Math.max(Math.round(x), 0), picture.width - 1),
    y: Math.min(Math.max(Math.round(y), 0), picture.height - 1)
  };
  emit("cursor");
}

export function revealCursor() {
  const at = zoomed.toScreen(shown.cursor.x, shown.cursor.y),
    edge = 16;
  const isSeen =
    at.x >= edge && at.y >= edge && at.x <= (zoomed.width ?? 0) - edge && at.y <= (zoomed.height ?? 0) - edge;
  if (!isSeen && !zoomed.isFitted) zoomed.centre(shown.cursor.x, shown.cursor.y);
}

/** @param {number} k CSS pixels a pixel, the cursor in the middle */
export function zoomAtCursor(k) {
  zoomed.k = zoomed.limited(k);
  zoomed.centre(shown.cursor.x, shown.cursor.y);
}

/** @param {"side"|"slider"|"flicker"} mode */
export function setMode(mode) {
  shown.mode = mode;
  if (mode !== "flicker") shown.isAuto = false;
  resize();
  emit("view");
}

/** @param {number} share */
export function setSplit(share) {
  shown.split = Math.min(Math.max(share, 0), 1);
  emit("view");
}

export function flicker() {
  if (shown.mode !== "flicker") setMode("flicker");
  shown.side = shown.side === "left" ? "right" : "left";
  emit("view");
}

function listen() {
  const element = stage();
  /** @type {Map<number, {x: number, y: number}>} */
  const down = new Map();
  let isOnBorder = false;
  element.addEventListener("pointerdown", event => {
    if (event.target === byId("split") || event.button > 1) return;
    const at = local(event);
    element.focus({preventScroll: true});
    element.setPointerCapture(event.pointerId);
    down.set(event.pointerId, at);
    isOnBorder =
      shown.mode === "slider" && Math.abs(at.x - shown.split * (zoomed.width ?? 0)) < 8 && down.size === 1;
    event.preventDefault();
  });
  element.addEventListener("pointermove", event => {
    const at = local(event),
      before = down.get(event.pointerId);
    const p = zoomed.toPhoto(at.x, at.y);
    if (!before) return zoomed.isInFrame(p.x, p.y) ? moveCursor(p.x, p.y) : undefined;
    if (isOnBorder) setSplit(at.x / (zoomed.width ?? 1));
    else if (down.size === 2) pinch(zoomed, down, event.pointerId, at);
    else pan(zoomed, at.x - before.x, at.y - before.y);
    down.set(event.pointerId, at);
  });
  for (const name of ["pointerup", "pointercancel"])
    element.addEventListener(name, event => {
      down.delete(/** @type {PointerEvent} */ (event).pointerId);
      isOnBorder = false;
    });
  element.addEventListener(
    "wheel",
    event => {
      const at = local(event);
      zoomed.zoomAt(wheelScale(zoomed.k, event), at.x, at.y);
      event.preventDefault();
    },
    {passive: false}
  );
  byId("split").addEventListener("input", event => setSplit(Number(event.target.value)));
}

/** Another picture with another size begins whole. */
function takeSize() {
  const picture = measure();
  const isOther =
    picture?.width !== zoomed.photo?.width || picture?.height !== zoomed.photo?.height;
  zoomed.photo = picture?.width ? {width: picture.width, height: picture.height} : null;
  if (isOther) zoomed.fit();
}

export function buildStage() {
  listen();
  new ResizeObserver(resize).observe(stage());
  onTiles(redraw);
  on("photo", () => {
    takeSize();
    zoomed.fit();
  });
  on("pictures", takeSize);
  on("draw", drawLabels);
  on("frame", paint);
  setInterval(() => {
    if (!shown.isAuto || document.hidden) return;
    shown.side = shown.side === "left" ? "right" : "left";
    emit("view");
  }, kAutoMs);
}
