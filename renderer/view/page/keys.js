// SPDX-License-Identifier: GPL-3.0-or-later
// Letters act while the stage has the focus; the page works by keyboard alone.

import {choose, photo, shown, stepPhoto} from "./state.js";
import {flicker, moveCursor, revealCursor, setMode, setSplit, zoomAtCursor, zoomed} from "./stage.js";
import {runOrStop} from "./renders.js";
import {showHelp, toggleDifference, toggleOutline} from "./header.js";
import {byId} from "../../prepare/page/words/dom.js";
import {emit} from "../../prepare/page/site/signals.js";

const kSplitStep = 0.02;

/** The next picture on the right that is one of these. */
function next(isWanted) {
  const pictures = (photo()?.pictures ?? []).filter(one => one.fault === undefined && isWanted(one));
  if (pictures.length === 0) return;
  const at = pictures.findIndex(one => one.id === shown.right);
  choose("right", pictures[(at + 1) % pictures.length].id);
}

function swap() {
  const {left, right} = shown;
  shown.left = right;
  choose("right", left);
}

const scaled = k => () => zoomAtCursor(k / devicePixelRatio);

/** @type {{id: string, key: string, run: () => any}[]} */
const kActions = [
  {id: "side", key: "S", run: () => setMode("side")},
  {id: "slider", key: "D", run: () => setMode("slider")},
  {id: "flicker", key: "B", run: flicker},
  {
    id: "auto",
    key: "Shift+B",
    run: () => {
      setMode("flicker");
      shown.isAuto = !shown.isAuto;
      emit("view");
    }
  },
  {id: "splitLeft", key: ",", run: () => setSplit(shown.split - kSplitStep)},
  {id: "splitRight", key: ".", run: () => setSplit(shown.split + kSplitStep)},
  {id: "outline", key: "O", run: toggleOutline},
  {id: "difference", key: "X", run: toggleDifference},
  {id: "layer", key: "L", run: () => next(one => one.kind === "layer" || one.kind === "part")},
  {id: "variant", key: "V", run: () => next(one => one.kind === "montage")},
  {id: "unfinished", key: "U", run: () => next(one => one.kind === "unfinished")},
  {id: "swap", key: "T", run: swap},
  {id: "run", key: "R", run: runOrStop},
  {id: "nextPhoto", key: "PageDown", run: () => stepPhoto(1)},
  {id: "previousPhoto", key: "PageUp", run: () => stepPhoto(-1)},
  {id: "fit", key: "0", run: () => zoomed.fit()},
  {id: "zoom100", key: "1", run: scaled(1)},
  {id: "zoom200", key: "2", run: scaled(2)},
  {id: "zoom1600", key: "3", run: scaled(16)},
  {id: "zoomIn", key: "+", run: () => zoomAtCursor(zoomed.k * 2)},
  {id: "zoomOut", key: "-", run: () => zoomAtCursor(zoomed.k / 2)},
  {id: "centre", key: "C", run: () => zoomed.centre(shown.cursor.x, shown.cursor.y)},
  {id: "help", key: "?", run: () => showKeys()}
];

export const showKeys = () => showHelp(kActions);

const kArrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

function moveByArrow(event, [dx, dy]) {
  const step = event.ctrlKey ? 100 : event.shiftKey ? 10 : 1;
  moveCursor(shown.cursor.x + step * dx, shown.cursor.y + step * dy);
  revealCursor();
}

export function listenToKeys() {
  addEventListener("keydown", event => {
    if (document.querySelector("dialog[open]") || event.isComposing || event.altKey) return;
    if (event.key === "Escape") return byId("stage").focus();
    if (event.target !== byId("stage")) return;
    const arrow = kArrows[event.key],
      isLetter = event.key.length === 1,
      key = (event.shiftKey && /^[a-z]$/i.test(event.key) ? "Shift+" : "") + (isLetter ? event.key.toUpperCase() : event.key);
    const action = event.ctrlKey || event.metaKey ? undefined : kActions.find(one => one.key === key);
    if (!arrow && !action) return;
    event.preventDefault();
    if (arrow) moveByArrow(event, arrow);
    else action?.run();
  });
}
