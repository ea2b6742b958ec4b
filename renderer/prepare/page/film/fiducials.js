// SPDX-License-Identifier: GPL-3.0-or-later
// Fiducial marks placed on the scans, by the same keys and gestures as points.

import {
  certified,
  fiducial,
  fiducialsOn,
  lacking,
  movingFiducial as moving,
  placeOfFiducial,
  predictedFiducial,
  reviewOf,
  scans
} from "./certified.js";
import {say} from "../around/notices.js";
import {ask} from "../site/api.js";
import {emit, on} from "../site/signals.js";
import {edit, isReadOnly, photoOf} from "../site/state.js";
import {activePane, addHands, setMode, showPhoto, ui} from "../site/ui.js";
import {stored} from "../words/numbers.js";
import {t} from "../words/words.js";

const kReach = 10; // CSS px within which a click means the mark

function settle() {
  clearTimeout(moving.timer);
  const {photo, mark, x, y} = moving,
    old = mark && fiducial(photo, mark);
  moving.mark = "";
  if (!old) return;
  for (const pane of ui.panes) if (pane.photo?.name === photo) pane.isMoved = false;
  edit(t("opMove", {point: mark, photo}), [
    {table: "fiducials", before: old, after: {...old, x: stored(x), y: stored(y)}}
  ]);
}

function move(photo, mark, x, y, delay) {
  if (moving.mark && (moving.photo !== photo || moving.mark !== mark)) settle();
  clearTimeout(moving.timer);
  Object.assign(moving, {photo, mark, x, y, timer: window.setTimeout(settle, delay)});
  emit("view");
}

/** The mark nearest to a place, if within reach. */
function markAt(pane, x, y) {
  let best = null,
    least = kReach / pane.k;
  for (const one of fiducialsOn(pane.photo.name)) {
    const distance = Math.hypot(one.x - x, one.y - y);
    if (distance <= least) [best, least] = [one.mark, distance];
  }
  return best;
}

/**
 * Makes a mark the current one and brings the active crosshair to it.
 * @param {string} mark
 */
export function chooseFiducial(mark) {
  settle();
  ui.fiducial = mark;
  activePane()?.toCurrent(true);
  emit("selection");
}

/** Puts the current mark at a place. */
function place(photo, mark, x, y) {
  const size = photoOf(photo),
    millimetres = certified().get(mark);
  if (!size || !millimetres) return false;
  if (x < -0.5 || y < -0.5 || x > size.width - 0.5 || y > size.height - 0.5) say(t("offFrame"));
  else if (isReadOnly("fiducials")) say(t("readOnlyTable"));
  else {
    const old = fiducial(photo, mark) ?? null,
      {x_mm, y_mm} = old ?? millimetres;
    edit(t(old ? "opMove" : "opMark", {point: mark, photo}), [
      {table: "fiducials", before: old, after: {...old, mark, x_mm, y_mm, photo, x: stored(x), y: stored(y)}}
    ]);
    for (const pane of ui.panes) if (pane.photo?.name === photo) pane.isMoved = false;
    say("");
    return true;
  }
  return false;
}

function confirm(pane, isShift) {
  if (certified().size === 0) return say(t("certificateFirst"));
  if (ui.fiducial === null || !certified().has(ui.fiducial)) return say(t("noFiducial"));
  settle();
  const photo = pane.photo.name,
    mark = ui.fiducial,
    old = fiducial(photo, mark);
  if (!old && !pane.isMoved && !predictedFiducial(photo, mark)) return say(t("moveFirst"));
  if ((!old || pane.isMoved) && !place(photo, mark, pane.cursor.x, pane.cursor.y)) return;
  if (!isShift) advance(photo, mark);
}

/** To the next mark that the photo lacks, then to the next scan that lacks one. */
function advance(photo, mark) {
  const names = [...certified().keys()],
    at = names.indexOf(mark),
    here = new Set(lacking(photo));
  const next = [...names.slice(at + 1), ...names.slice(0, at)].find(name => here.has(name));
  if (next) return chooseFiducial(next);
  const other = scans().find(name => name !== photo && lacking(name).length > 0);
  if (!other) return say(t("fiducialsDone", {photo}));
  ui.fiducial = lacking(other)[0];
  showPhoto(other);
}

/** The next mark that the photo lacks; if it has all, the next mark. */
function step(by) {
  settle();
  const photo = activePane()?.photo?.name,
    names = [...certified().keys()],
    here = new Set(lacking(photo));
  const wanted = names.filter(name => here.size === 0 || here.has(name));
  if (wanted.length === 0) return say(t("certificateFirst"));
  const from = names.indexOf(ui.fiducial ?? "");
  for (let i = 1; i <= names.length; ++i) {
    const name = names[(from + by * i + (from < 0 && by < 0 ? 1 : 0) + 2 * names.length) % names.length];
    if (wanted.includes(name)) return chooseFiducial(name);
  }
}

/** The worst mark here, then the next worse. */
function suspect() {
  const marks = reviewOf(activePane()?.photo?.name)?.marks ?? [];
  if (marks.length === 0) return;
  const at = marks.findIndex(one => one.mark === ui.fiducial);
  chooseFiducial(marks[(at + 1) % marks.length].mark);
}

function click(pane, x, y, isShift, isTouch) {
  const name = markAt(pane, x, y);
  if (name !== null) {
    ui.fiducial = name;
    pane.toCurrent(false);
    return emit("selection");
  }
  if (pane.k * devicePixelRatio < 0.5) {
    pane.cursor = {x, y};
    pane.isMoved = true;
    return pane.zoomAtCursor(1 / devicePixelRatio);
  }
  pane.moveCursor(x, y);
  const isFree = ui.fiducial === null || !fiducial(pane.photo.name, ui.fiducial);
  if (!isTouch && isFree) confirm(pane, isShift);
}

/** The crosshair by arrows; a mark under it comes along. */
function nudge(pane, dx, dy) {
  const photo = pane.photo.name,
    mark = ui.fiducial,
    {x, y} = pane.cursor;
  const old = mark !== null && fiducial(photo, mark) ? placeOfFiducial(photo, mark) : null;
  const isOn = old && Math.hypot(old.x - x, old.y - y) < 1e-3 && !isReadOnly("fiducials");
  pane.moveCursor(x + dx, y + dy);
  if (isOn && mark !== null) move(photo, mark, pane.cursor.x, pane.cursor.y, 400);
}

function remove() {
  settle();
  const photo = activePane()?.photo?.name,
    old = ui.fiducial !== null && fiducial(photo, ui.fiducial);
  if (!old) return say(t("noFiducialHere"));
  if (isReadOnly("fiducials")) return say(t("readOnlyTable"));
  edit(t("opDelete", {point: ui.fiducial, photo}), [{table: "fiducials", before: old, after: null}]);
}

/**
 * @param {"off"|"dubious"} wanted the state of the current mark, on again if it has it
 * @param {string} label
 */
function toggle(wanted, label) {
  settle();
  const photo = activePane()?.photo?.name,
    old = ui.fiducial !== null && fiducial(photo, ui.fiducial);
  if (!old) return say(t("noFiducialHere"));
  if (isReadOnly("fiducials")) return say(t("readOnlyTable"));
  edit(t(label, {point: ui.fiducial, photo}), [
    {table: "fiducials", before: old, after: {...old, state: old.state === wanted ? "on" : wanted}}
  ]);
}

/** The crosshair to the centre of the cross, dot or ring that it is near; Enter takes it. */
async function refine(pane) {
  if (!pane?.photo) return;
  settle();
  const photo = pane.photo.name,
    {x, y} = pane.cursor;
  const answer = await ask("/api/refine", {photo, x, y, fiducial: true});
  if (answer.error) return say(t("notRefined", {why: answer.error}));
  if (pane.photo?.name !== photo) return;
  pane.moveCursor(answer.x, answer.y);
  say(
    t("refined", {shift: Number(answer.shift ?? 0).toFixed(2), sigma: Number(answer.sigma).toFixed(2)})
  );
  emit("view");
}

function take(name) {
  activePane()?.focus();
  if (!certified().has(name)) return say(t("noSuchFiducial", {name}));
  chooseFiducial(name);
}

/** Begins to place marks: the first that the photo lacks. */
export function placeFiducials() {
  setMode("film");
  const photo = activePane()?.photo?.name;
  if (ui.fiducial === null && photo) ui.fiducial = lacking(photo)[0] ?? null;
  activePane()?.focus();
  emit("selection");
}

export function addFilmHands() {
  addHands("film", {
    click,
    confirm,
    nudge,
    remove,
    toggleOff: () => toggle("off", "opSwitch"),
    toggleDubious: () => toggle("dubious", "opDubious"),
    step,
    suspect,
    refine,
    take,
    settle,
    current: () => ui.fiducial ?? "",
    names: () => [...certified().keys()],
    place: photo => (ui.fiducial === null ? null : placeOfFiducial(photo, ui.fiducial)),
    cancel: () => {
      ui.fiducial = null;
    },
    isDraggable: (pane, x, y) =>
      ui.fiducial !== null && markAt(pane, x, y) === ui.fiducial && !isReadOnly("fiducials"),
    drag: (pane, at, isEnd) => {
      if (ui.fiducial === null || !pane.isInFrame(at.x, at.y)) return;
      pane.moveCursor(at.x, at.y);
      move(pane.photo.name, ui.fiducial, at.x, at.y, 5000);
      if (isEnd) settle();
    }
  });
  on("mode", () => {
    settle();
    if (ui.mode === "film") placeFiducials();
  });
}
