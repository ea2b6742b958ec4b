// SPDX-License-Identifier: GPL-3.0-or-later
// Keys: what each does, which can be changed, and who gets them. Letters act only in a focused pane.

import {byId} from "../words/dom.js";
import {
  cancel,
  centreAll,
  centreIn,
  confirm,
  deleteMark,
  nextSuspect,
  nudge,
  stepPhoto,
  stepPoint,
  toggleDubious,
  toggleOff
} from "../points/marking.js";
import {deleteSample} from "../light/light_panel.js";
import {match, refine} from "../points/proposals.js";
import {chooseSample} from "../light/samples.js";
import {kModes, redo, undo} from "./header.js";
import {say} from "./notices.js";
import {enlarge, nextLayout, stepPane} from "../photo/panes.js";
import {stepLight} from "../photo/relit.js";
import {emit, redraw} from "../site/signals.js";
import {activePane, setMode, setTool, ui} from "../site/ui.js";

const kStore = "insitu-keys";
/** @type {Record<string, string>} the person's own, by action */
let own = JSON.parse(localStorage.getItem(kStore) ?? "{}");

/** @typedef {{id: string, key: string, run: (event: KeyboardEvent) => any, isPage?: boolean}} Action */
/** @type {Action[]} */
export const actions = [];
/** @param {Action} action */
export const addAction = action => actions.push(action);

/**
 * The key of an action as it is now.
 * @param {string} id
 */
export const keyFor = id => own[id] ?? actions.find(action => action.id === id)?.key ?? "";

/**
 * Gives an action another key; the error's name, or "".
 * @param {string} id
 * @param {string} key
 */
export function changeKey(id, key) {
  if (key === "") delete own[id];
  else if (actions.some(action => action.id !== id && keyFor(action.id) === key)) return "keyTaken";
  else own[id] = key;
  localStorage.setItem(kStore, JSON.stringify(own));
  return "";
}
export function resetKeys() {
  own = {};
  localStorage.removeItem(kStore);
}

/**
 * A key with its modifiers, letters in capitals: "Ctrl+Z", "Shift+Enter", "B", "?".
 * @param {KeyboardEvent} event
 */
export function keyText(event) {
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const isLetter = /^[A-ZÄÖÜ]$/.test(key),
    isShift = event.shiftKey && (isLetter || event.key.length > 1);
  return (
    `${event.ctrlKey || event.metaKey ? "Ctrl+" : ""}${event.altKey ? "Alt+" : ""}${isShift ? "Shift+" : ""}` +
    (key === " " ? "Space" : key)
  );
}

const kArrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

function focusField(id) {
  const field = byId(id);
  field?.focus();
  field?.select();
}

const zoom = factor => () => activePane().zoomAtCursor(activePane().k * factor);
const scaled = k => () => activePane().zoomAtCursor(k / devicePixelRatio);
const cycle = () => {
  ui.arrows = {0: 1, 1: 10, 10: 100, 100: 0}[ui.arrows] ?? 10;
};

/** Those of the notes, §4; other modules add theirs. */
export function addKeys() {
  /** @type {[string, string, (event: KeyboardEvent) => any][]} */
  const inPane = [
    ["place", "Enter", () => confirm(activePane(), false)],
    ["placeStay", "Shift+Enter", () => confirm(activePane(), true)],
    ["nextPoint", "N", () => stepPoint(1)],
    ["previousPoint", "P", () => stepPoint(-1)],
    ["nextPhoto", "PageDown", () => stepPhoto(1)],
    ["previousPhoto", "PageUp", () => stepPhoto(-1)],
    ["centreAll", "C", centreAll],
    ["fit", "0", () => activePane().fit()],
    ["zoom100", "1", scaled(1)],
    ["zoom200", "2", scaled(2)],
    ["zoomIn", "+", zoom(2)],
    ["zoomOut", "-", zoom(0.5)],
    ["refine", "F", () => refine(activePane())],
    ["match", "G", () => match(activePane())],
    ["switch", "X", () => toggleOff()],
    ["delete", "Delete", () => (ui.mode === "light" ? deleteSample() : deleteMark())],
    ["dubious", "D", toggleDubious],
    ["arrows", "R", cycle],
    [
      "curves",
      "E",
      () => {
        ui.curves = !ui.curves;
      }
    ],
    ["nextSuspect", "U", nextSuspect],
    ["goTo", ".", () => focusField("go-to")],
    ["layout", ",", nextLayout],
    ["enlarge", "*", enlarge],
    ["relight", "3", () => stepLight(activePane())],
    [
      "loupe",
      "/",
      () => {
        ui.isLoupe = !ui.isLoupe;
      }
    ],
    [
      "names",
      "!",
      () => {
        ui.isNamed = !ui.isNamed;
      }
    ]
  ];
  for (const [id, key, run] of inPane) addAction({id, key, run});
  /** @type {[string, string, (event: KeyboardEvent) => any][]} */
  const onPage = [
    ["undo", "Ctrl+Z", undo],
    ["redo", "Ctrl+Y", redo],
    ["find", "Ctrl+F", () => focusField("point-name")],
    ["goToToo", "Ctrl+G", () => focusField("go-to")],
    ...kModes.map(
      ([mode, key]) =>
        /** @type {[string, string, () => any]} */ ([
          `mode_${mode}`,
          `Alt+${key}`,
          () => {
            setMode(mode);
            activePane()?.focus();
          }
        ])
    )
  ];
  for (const [id, key, run] of onPage) addAction({id, key, run, isPage: true});
}

const isField = target => /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName ?? "");

export function listenToKeys() {
  addEventListener("keydown", event => {
    const target = /** @type {any} */ (event.target);
    if (document.querySelector("dialog[open]") || event.isComposing) return;
    const isInPane = Boolean(target.closest?.(".stage"));
    if (isInPane && paneKey(event)) return event.preventDefault();
    if (event.key === "Escape") return isField(target) ? activePane()?.focus() : escape();
    const key = keyText(event),
      action = actions.find(one => keyFor(one.id) === key);
    if (
      !action ||
      (!action.isPage && !isInPane) ||
      (isField(target) && !/^(Ctrl\+[FG]|Alt\+)/.test(key))
    )
      return;
    event.preventDefault();
    action.run(event);
    emit("view");
  });
  addEventListener("keyup", event => {
    if (event.key !== " " || !activePane()) return;
    const loupe = activePane().loupe,
      isTap = performance.now() - spaceSince < 300;
    loupe.isHeld = false;
    if (isTap && /** @type {any} */ (event.target).closest?.(".stage")) centreIn(activePane());
    spaceSince = 0;
    redraw();
  });
}

let spaceSince = 0;
/**
 * Keys that are no letters and cannot be changed.
 * @param {KeyboardEvent} event
 */
function paneKey(event) {
  const pane = activePane(),
    arrow = kArrows[event.key];
  if (arrow && !event.altKey) {
    const step = event.shiftKey ? 0.1 : event.ctrlKey ? 10 : 1;
    nudge(pane, step * arrow[0], step * arrow[1]);
    return true;
  }
  if (event.key === "Tab" && !event.ctrlKey && !event.altKey) return stepPane(event.shiftKey ? -1 : 1);
  if (event.key === " ") {
    if (!event.repeat) spaceSince = performance.now();
    pane.loupe.isHeld = true;
    redraw();
    return true;
  }
  if (event.key === "Backspace" && ui.tool) {
    ui.tool.back?.();
    emit("view");
    return true;
  }
  return false;
}

function escape() {
  say("");
  if (ui.tool) setTool(null);
  else if (ui.mode === "light" && ui.sample !== null) chooseSample(null);
  else cancel();
  emit("view");
}
