// SPDX-License-Identifier: GPL-3.0-or-later
// Marks of the current point: placed, confirmed, moved, switched, deleted, proposed.

import {byId} from "../words/dom.js";
import {
  edit,
  freeName,
  indexed,
  isReadOnly,
  live,
  mark,
  nameFault,
  photoOf,
  prediction,
  raysOf,
  rows,
  state
} from "../site/state.js";
import {emit} from "../site/signals.js";
import {stored} from "../words/numbers.js";
import {activePane, choosePoint, currentPlace, hands, photosOf, showPhoto, ui} from "../site/ui.js";
import {say} from "../around/notices.js";
import {proposalFor, proposals} from "./proposals.js";
import {chooseSample, sampleAt} from "../light/samples.js";
import {t} from "../words/words.js";

const kReach = 10; // CSS px within which a click means the mark
const kDubious = 3;

/** The σ [px] of marks by hand. */
export const marking = {sigma: Number(localStorage.getItem("insitu-sigma")) || 0.5};

/** A mark that arrows or a drag are moving and that is not yet told to the server. */
export const moving = {photo: "", point: "", x: 0, y: 0, timer: 0};

/** Tells the server where the arrows have brought a mark. */
export function settle() {
  hands()?.settle();
  clearTimeout(moving.timer);
  const old = moving.point && mark(moving.photo, moving.point);
  const {photo, point, x, y} = moving;
  moving.point = "";
  if (!old) return;
  rest(photo);
  edit(t("opMove", {point, photo}), [
    {table: "observations", before: old, after: {...old, x: stored(x), y: stored(y)}}
  ]);
}

function move(photo, point, x, y, delay) {
  if (moving.point && (moving.photo !== photo || moving.point !== point)) settle();
  clearTimeout(moving.timer);
  Object.assign(moving, {photo, point, x, y, timer: window.setTimeout(settle, delay)});
  emit("view");
}

/** The name of the mark nearest to a place, if within reach. */
function markAt(pane, x, y) {
  let best = null,
    least = kReach / pane.k;
  for (const one of rows("observations")) {
    if (one.photo !== pane.photo.name) continue;
    const distance = Math.hypot(one.x - x, one.y - y);
    if (distance <= least) [best, least] = [one.point, distance];
  }
  return best;
}

/** Whether a drag that begins here moves the current point's mark. */
export const isDraggable = (pane, x, y) =>
  hands()?.isDraggable(pane, x, y) ?? isPointDraggable(pane, x, y);
const isPointDraggable = (pane, x, y) =>
  ui.point !== null &&
  !ui.tool &&
  pane.photo !== null &&
  markAt(pane, x, y) === ui.point &&
  !isReadOnly("observations");

/**
 * @param {any} pane
 * @param {{x: number, y: number}} at
 * @param {boolean} isEnd
 */
export function dragMark(pane, at, isEnd) {
  const other = hands();
  if (other) return other.drag(pane, at, isEnd);
  if (ui.point === null || !pane.isInFrame(at.x, at.y)) return;
  pane.moveCursor(at.x, at.y);
  move(pane.photo.name, ui.point, at.x, at.y, 5000);
  if (isEnd) settle();
}

/**
 * A click: takes the mark there; else serves the tool; else places the current point if this photo has
 * no mark of it yet. From far away it zooms in first.
 */
export function clickAt(pane, x, y, isShift, isTouch = false) {
  if (!pane.isInFrame(x, y)) return;
  settle();
  const other = hands();
  if (other) return other.click(pane, x, y, isShift, isTouch);
  if (ui.mode === "light" && !ui.tool) return takeSample(pane, x, y);
  const name = markAt(pane, x, y);
  if (name !== null && ui.mode !== "light") return choosePoint(name, false);
  if (pane.k * devicePixelRatio < 0.5) {
    pane.cursor = {x, y};
    pane.isMoved = true;
    return pane.zoomAtCursor(1 / devicePixelRatio);
  }
  pane.moveCursor(x, y);
  if (isTouch) return;
  if (ui.tool) return useTool(pane);
  if (ui.point === null) return askForPoint();
  if (!mark(pane.photo.name, ui.point)) confirm(pane, isShift);
}

/** A click while the light is looked at: the sample there, or the crosshair comes. */
function takeSample(pane, x, y) {
  const sample = sampleAt(pane, x, y);
  pane.moveCursor(sample?.row.x ?? x, sample?.row.y ?? y);
  pane.isMoved = false;
  chooseSample(sample);
}

/** Enter or Confirm: the crosshair's place is meant. */
export function confirm(pane, isShift) {
  if (!pane?.photo) return;
  const other = hands();
  if (other) return other.confirm(pane, isShift);
  if (ui.tool) return useTool(pane);
  if (ui.mode === "light") return; // the points are dimmed: nothing is to happen to them unseen
  if (ui.point === null) return askForPoint();
  settle();
  const photo = pane.photo.name,
    point = ui.point,
    old = mark(photo, point),
    proposal = proposalFor(photo, point);
  if (!old && !pane.isMoved && !proposal && !prediction(photo, point)) return say(t("moveFirst"));
  if (!old || pane.isMoved || proposal)
    place(photo, point, pane.cursor.x, pane.cursor.y, pane.isMoved ? null : proposal);
  if (!isShift) advance(photo, point);
}

/** The tool gets the place, snapped to a point that is there; untouched crosshair: it is finished. */
function useTool(pane) {
  const tool = /** @type {import("../site/ui.js").Tool} */ (ui.tool),
    {x, y} = pane.cursor;
  if (!pane.isMoved) return tool.finish?.();
  pane.isMoved = false;
  const name = tool.pickPoint ? markAt(pane, x, y) : null;
  if (name !== null) tool.pickPoint?.(name);
  else if (tool.place) tool.place(pane.photo.name, x, y);
  else say(t("pickMark"));
  emit("view");
}

/** Inserts or moves a mark. */
export function place(photo, point, x, y, proposal = null) {
  const size = photoOf(photo);
  if (!size || x < -0.5 || y < -0.5 || x > size.width - 0.5 || y > size.height - 0.5)
    return say(t("offFrame"));
  const fault = nameFault(point);
  if (fault) return say(t(fault));
  if (isReadOnly("observations")) return say(t("readOnlyTable"));
  edit(mark(photo, point) ? t("opMove", {point, photo}) : t("opMark", {point, photo}), [
    markEdit(photo, point, x, y, proposal)
  ]);
  proposals.byPhoto.delete(photo);
  rest(photo);
  say("");
}

/** The crosshair of a photo stands where it belongs. */
function rest(photo) {
  for (const pane of ui.panes) if (pane.photo?.name === photo) pane.isMoved = false;
}

/**
 * The edit that puts a mark at a place.
 * @returns {import("../site/outbox.js").Edit}
 */
export function markEdit(photo, point, x, y, proposal = null) {
  const old = mark(photo, point) ?? null;
  const sigma = proposal?.sigma ?? old?.sigma ?? marking.sigma;
  /** @type {import("../site/state.js").Row} */
  const after = {...old, photo, point, x: stored(x), y: stored(y), sigma};
  if (proposal) after.method = proposal.method ?? "corner";
  else if (after.method) after.method = "hand";
  return {table: "observations", before: old, after};
}

/** To the point's next photo without a mark, then to the next point. */
function advance(photo, point) {
  const names = photosOf(point),
    at = names.indexOf(photo);
  const next = [...names.slice(at + 1), ...names.slice(0, Math.max(at, 0))].find(
    name => !mark(name, point)
  );
  if (next) return showPhoto(next);
  if (stepPoint(1)) showFirstWish();
}

/** The current point on the first photo that lacks it, if the active one has it. */
function showFirstWish() {
  const point = ui.point,
    photo = activePane().photo?.name;
  if (point === null || !mark(photo, point)) return;
  const next = photosOf(point).find(name => !mark(name, point));
  if (next) showPhoto(next);
}

/** Names that need rays, in the files' order. */
function wanting() {
  const names = [...indexed().points.keys()];
  return names.filter(
    name =>
      raysOf(name) < 2 || photosOf(name).some(photo => !mark(photo, name) && prediction(photo, name))
  );
}

/**
 * The next point that needs rays; false if none.
 * @param {number} step
 */
export function stepPoint(step) {
  settle();
  const other = hands();
  if (other) {
    other.step(step);
    return false;
  }
  const needed = new Set(wanting()),
    names = [...indexed().points.keys()];
  const from = names.indexOf(ui.point ?? "");
  for (let i = 1; i <= names.length; ++i) {
    const name =
      names[(from + step * i + (from < 0 && step < 0 ? 1 : 0) + names.length * 2) % names.length];
    if (needed.has(name) && name !== ui.point) {
      choosePoint(name);
      return true;
    }
  }
  say(t("noPointWants"));
  return false;
}

/**
 * The next photo that sees the point; without a point, of all.
 * @param {number} step
 */
export function stepPhoto(step) {
  settle();
  const isAny = ui.point === null || hands() !== undefined;
  const names = isAny ? state.photos.map(photo => photo.name) : photosOf(ui.point ?? "");
  if (names.length === 0) return;
  const at = names.indexOf(activePane().photo?.name);
  const next = names[at < 0 ? 0 : (at + step + names.length) % names.length];
  const before = activePane().photo,
    other = ui.panes.find(pane => pane !== activePane() && pane.photo?.name === next);
  activePane().setPhoto(photoOf(next));
  other?.setPhoto(before); // no photo stands twice
  live.send({focus: next});
  activePane().toCurrent(true);
  emit("selection");
}

/** The point with the next smaller |w|. */
export function nextSuspect() {
  const other = hands();
  if (other) return other.suspect();
  const marks = [...(state.adjusted?.marks ?? [])]
    .filter(one => one.w !== null)
    .sort((a, b) => Math.abs(b.w) - Math.abs(a.w));
  if (marks.length === 0) return;
  const at = marks.findIndex(one => one.point === ui.point && one.photo === activePane().photo?.name);
  const one = marks[(at + 1) % marks.length];
  choosePoint(one.point);
  showPhoto(one.photo);
}

/** The crosshair by arrows; a mark under it comes along. */
export function nudge(pane, dx, dy) {
  if (!pane?.photo) return;
  const other = hands();
  if (other) return other.nudge(pane, dx, dy);
  const photo = pane.photo.name,
    point = ui.point,
    {x, y} = pane.cursor;
  const old = point !== null && !ui.tool ? mark(photo, point) : null;
  const at = moving.point === point && moving.photo === photo ? moving : old;
  const isOn = old && at && Math.hypot(at.x - x, at.y - y) < 1e-3 && !isReadOnly("observations");
  pane.moveCursor(x + dx, y + dy);
  if (isOn && point !== null) move(photo, point, pane.cursor.x, pane.cursor.y, 400);
}

const activePhoto = () => activePane()?.photo?.name;

/**
 * @param {(old: any) => any} change of the current point's mark, null to delete it
 * @param {string} label
 * @param {string} [photo] the active one if none is said
 */
export function changeMark(change, label, photo = activePhoto()) {
  settle();
  if (hands()) return say(t("notInFilm"));
  const old = ui.point !== null && mark(photo, ui.point);
  if (!old) return say(t("noMark"));
  if (isReadOnly("observations")) return say(t("readOnlyTable"));
  edit(t(label, {point: ui.point, photo}), [{table: "observations", before: old, after: change(old)}]);
}
export function deleteMark() {
  const other = hands();
  if (other) other.remove();
  else changeMark(() => null, "opDelete");
}
export function toggleOff(photo = activePhoto()) {
  const other = hands();
  if (other) return other.toggleOff();
  changeMark(old => ({...old, state: old.state === "off" ? "on" : "off"}), "opSwitch", photo);
}
/** Dubious: σ is three times as large; and back. */
export function toggleDubious() {
  const other = hands();
  if (other) return other.toggleDubious();
  changeMark(
    old =>
      old.state === "dubious"
        ? {...old, state: "on", sigma: old.sigma / kDubious}
        : {...old, state: "dubious", sigma: old.sigma * kDubious},
    "opDubious"
  );
}

/** Brings the field for a point's name, with a free one in it. */
export function askForPoint() {
  const field = byId("point-name");
  field.value = freeName("p");
  field.focus();
  field.select();
  say(t("nameIt"));
}

/** The name typed: an existing point is shown, a new one is placed where the crosshair was brought. */
export function takeName(name) {
  const other = hands();
  if (other) return other.take(name);
  const fault = nameFault(name);
  if (fault) return say(t(fault));
  const pane = activePane(),
    isNew = !indexed().points.has(name),
    wasMoved = pane.isMoved && ui.point === null;
  if (isNew && ui.tool) {
    if (!ui.tool.place || !pane.isMoved) return say(t("noSuchPoint", {name}));
    pane.isMoved = false;
    ui.tool.place(pane.photo.name, pane.cursor.x, pane.cursor.y, name);
    return pane.focus();
  }
  if (isNew) {
    ui.point = name;
    pane.focus();
    emit("selection");
    if (wasMoved) confirm(pane, false);
    else say(t("newPoint", {name}));
    return;
  }
  choosePoint(name);
  pane.focus();
}

/** The crosshair of every pane to the point. */
export function centreAll() {
  for (const pane of ui.panes) centreIn(pane);
}
export function centreIn(pane) {
  const place_ = pane.photo && currentPlace(pane.photo.name);
  if (!place_) return;
  pane.cursor = place_;
  pane.isMoved = false;
  pane.centre(place_.x, place_.y);
}

/** Esc: tool, then proposals, then the point. */
export function cancel() {
  settle();
  const other = hands();
  if (other) other.cancel();
  else if (proposals.byPhoto.size > 0) proposals.byPhoto.clear();
  else if (ui.point !== null) ui.point = null;
  emit("selection");
}
