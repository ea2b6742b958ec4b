// SPDX-License-Identifier: GPL-3.0-or-later
// Mouse, pen and fingers on a pane. A finger's lift does not place: Confirm does.

import {clickAt, dragMark, isDraggable} from "../points/marking.js";
import {pan, pinch, wheelScale} from "./pan_zoom.js";
import {redraw} from "../site/signals.js";
import {setActive, ui} from "../site/ui.js";

const kStill = 4; // CSS px that a hand may move in a click

/** @param {any} pane */
export function listenTo(pane) {
  const stage = pane.stage;
  /** @type {Map<number, {x: number, y: number}>} */
  const down = new Map();
  /** @type {{x: number, y: number, moved: boolean, mark: boolean}|null} */
  let press = null;
  const local = event => {
    const box = stage.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };

  stage.addEventListener("pointerdown", event => {
    if (event.button > 1) return;
    const at = local(event);
    pane.focus();
    setActive(ui.panes.indexOf(pane));
    stage.setPointerCapture(event.pointerId);
    down.set(event.pointerId, at);
    const p = pane.toPhoto(at.x, at.y);
    press = {
      ...at,
      moved: down.size > 1,
      mark: event.pointerType !== "touch" && isDraggable(pane, p.x, p.y)
    };
    event.preventDefault();
  });

  stage.addEventListener("pointermove", event => {
    const at = local(event),
      before = down.get(event.pointerId);
    if (event.pointerType !== "touch") {
      pane.hover = pane.toPhoto(at.x, at.y);
      redraw();
    }
    if (!before || !press) return;
    if (Math.hypot(at.x - press.x, at.y - press.y) > kStill) press.moved = true;
    if (!press.moved) return;
    if (press.mark) dragMark(pane, pane.toPhoto(at.x, at.y), false);
    else if (down.size === 2) pinch(pane, down, event.pointerId, at);
    else pan(pane, at.x - before.x, at.y - before.y);
    down.set(event.pointerId, at);
  });

  const released = event => {
    if (!down.delete(event.pointerId) || !press) return;
    const at = local(event),
      p = pane.toPhoto(at.x, at.y),
      ended = press;
    if (down.size > 0) return;
    press = null;
    if (event.type === "pointercancel") return;
    if (ended.mark && ended.moved) dragMark(pane, p, true);
    else if (!ended.moved && event.pointerType === "touch") touchAt(pane, p);
    else if (!ended.moved && event.button === 0) clickAt(pane, p.x, p.y, event.shiftKey);
  };
  stage.addEventListener("pointerup", released);
  stage.addEventListener("pointercancel", released);
  stage.addEventListener("pointerleave", () => {
    pane.hover = null;
    redraw();
  });

  stage.addEventListener(
    "wheel",
    event => {
      const at = local(event);
      pane.zoomAt(wheelScale(pane.k, event), at.x, at.y);
      event.preventDefault();
    },
    {passive: false}
  );
  stage.addEventListener("focusin", () => setActive(ui.panes.indexOf(pane)));
}

/** A finger brings the crosshair, or takes the mark that it meets. */
function touchAt(pane, p) {
  clickAt(pane, p.x, p.y, false, true);
}
