// SPDX-License-Identifier: GPL-3.0-or-later
// Who wants to know of what. Signals: "tables", "adjusted", "light", "building", "film", "todo", "history",
// "saved", "connection", "run", "selection", "tool", "mode", "view"; "draw" in the next frame after any of
// them; "frame" in each, also where only a view has moved.

/** @type {Map<string, ((detail?: any) => void)[]>} */
const listeners = new Map();
let isScheduled = false,
  hasChanged = false;

/**
 * @param {string} names separated by blanks
 * @param {(detail?: any) => void} listener
 */
export function on(names, listener) {
  for (const name of names.split(" ")) listeners.set(name, [...(listeners.get(name) ?? []), listener]);
}

/**
 * @param {string} name
 * @param {any} [detail]
 */
function tell(name, detail) {
  for (const listener of listeners.get(name) ?? []) listener(detail);
}

/**
 * Tells the listeners now and those of "draw" in the next frame.
 * @param {string} name
 * @param {any} [detail]
 */
export function emit(name, detail) {
  tell(name, detail);
  hasChanged = true;
  redraw();
}

/** Moves, paints in the next frame; what is drawn stays as it is. */
export function redraw() {
  if (isScheduled) return;
  isScheduled = true;
  const draw = () => {
    if (!isScheduled) return;
    isScheduled = false;
    if (hasChanged) tell("draw");
    hasChanged = false;
    tell("frame");
  };
  requestAnimationFrame(draw);
  if (document.hidden) setTimeout(draw, 100); // no frames come to a window in the background
}
