// SPDX-License-Identifier: GPL-3.0-or-later
// Panes beside each other: one, two or four; the first is the large one.

import {byId} from "../words/dom.js";
import {firstLayout} from "./first_look.js";
import {Pane} from "./pane.js";
import {live, mark, state} from "../site/state.js";
import {emit, on, redraw} from "../site/signals.js";
import {onTiles, onUndecodable} from "./tiles.js";
import {photosOf, ui} from "../site/ui.js";

export function buildPanes() {
  onTiles(redraw);
  onUndecodable((photo, why) => {
    state.photos[photo].fault = why;
  });
  byId("panes").replaceChildren(); // the first look
  setLayout(firstLayout(state.photos));
  // Of what else is told, as that something is saved, no photo shows anything.
  on("adjusted building faults film light merge mode refused selection tables tool view", () =>
    ui.panes.forEach(pane => {
      pane.isDrawn = false;
    })
  );
  on("frame", () => ui.panes.forEach(pane => pane.draw()));
  on("selection", follow);
  on("tables adjusted", () => ui.panes.forEach(pane => pane.stay()));
}

/** @param {number} count 1, 2 or 4 panes */
export function setLayout(count) {
  localStorage.setItem("insitu-layout", String(count));
  const root = byId("panes");
  root.dataset.layout = String(count);
  while (ui.panes.length > count) ui.panes.pop().root.remove();
  while (ui.panes.length < count) {
    const pane = new Pane();
    ui.panes.push(pane);
    root.append(pane.root);
    const free = state.photos.find(photo => !ui.panes.some(other => other.photo === photo));
    pane.setPhoto(free ?? null);
  }
  ui.panes.forEach((pane, i) => pane.root.classList.toggle("spare", !pane.photo && i > 0));
  ui.active = Math.min(ui.active, count - 1);
  emit("view");
}

/** 1, 2, 4, 1, ... */
export const nextLayout = () => setLayout(ui.panes.length === 1 ? 2 : ui.panes.length === 2 ? 4 : 1);

/**
 * To the next pane; false at the last, so that Tab goes on to what follows.
 * @param {number} step
 */
export function stepPane(step) {
  const next = ui.panes[ui.active + step];
  if (!next?.photo) return false;
  next.focus();
  live.send({focus: next.photo?.name});
  return true;
}

/** The active photo and that of the large pane change places. */
export function enlarge() {
  const [large] = ui.panes,
    pane = ui.panes[ui.active],
    photo = pane.photo;
  if (pane === large || !photo) return;
  const before = large.photo;
  large.setPhoto(photo);
  pane.setPhoto(before);
  large.focus();
}

let followed = "";
/** With more photos than panes, those that show the current point come to the other panes. */
function follow() {
  const point = ui.point;
  if (point === null || point === followed || state.photos.length <= ui.panes.length) return;
  followed = point;
  const names = photosOf(point).sort(
    (a, b) => Number(Boolean(mark(a, point))) - Number(Boolean(mark(b, point)))
  );
  const active = ui.panes[ui.active];
  const wanted = names.filter(name => name !== active.photo?.name).slice(0, ui.panes.length - 1);
  const idle = ui.panes.filter(pane => pane !== active && !wanted.includes(pane.photo?.name));
  for (const name of wanted.filter(one => !ui.panes.some(pane => pane.photo?.name === one))) {
    idle.shift()?.setPhoto(state.photos.find(photo => photo.name === name));
  }
}
