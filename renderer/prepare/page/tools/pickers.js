// SPDX-License-Identifier: GPL-3.0-or-later
// A tool that takes points one after the other: existing ones snap, elsewhere a new one is marked.

import {markEdit} from "../points/marking.js";
import {edit, freeName, isReadOnly, mark} from "../site/state.js";
import {say} from "../around/notices.js";
import {emit} from "../site/signals.js";
import {placeOf, setTool, ui} from "../site/ui.js";
import {t} from "../words/words.js";

/**
 * @param {object} what
 * @param {string} what.name text of the tool
 * @param {string[]} what.wanted texts of the points wanted; the last stands for all that follow
 * @param {number} [what.count] of points after which it is done; none: Enter or the first point again ends it
 * @param {boolean} [what.isClosed] drawn as an outline
 * @param {boolean} [what.onlyKnown] no new points
 * @param {() => string[]} [what.taken] points that cannot be picked
 * @param {(names: string[], photo: string|null) => void} what.done
 * @param {{names: string[], photo: string|null}} [what.begun] taken up again
 * @param {(names: string[], photo: string|null) => void} [what.cancelled]
 * @returns {import("../site/ui.js").Tool}
 */
export function pointTool(what) {
  /** @type {string[]} */
  const names = [...(what.begun?.names ?? [])];
  const made = new Set(); // points that this tool has marked
  let photo = what.begun?.photo ?? null,
    isDone = false;
  const end = () => {
    isDone = true;
    setTool(null);
    what.done(names, photo);
  };
  /** @type {import("../site/ui.js").Tool} */
  const tool = {
    name: what.name,
    hint: () =>
      `${t(what.wanted[Math.min(names.length, what.wanted.length - 1)], {n: names.length + 1})}` +
      (names.length > 0 ? ` (${names.join(", ")})` : ""),
    pickPoint: name => {
      if (!what.count && name === names[0] && names.length > 2) return end();
      const isTaken = !what.count && (names.includes(name) || what.taken?.().includes(name));
      if (names[names.length - 1] === name || isTaken) return say(t("twice", {name}));
      names.push(name);
      photo ??= ui.panes[ui.active]?.photo?.name ?? null;
      say(tool.hint());
      if (names.length === what.count) end();
    },
    back: () => {
      const name = names.pop();
      if (name === undefined) return false;
      if (made.delete(name)) takeBack(name);
      if (names.length === 0) photo = null;
      say(tool.hint());
      return true;
    },
    finish: () => {
      if (what.count || names.length < 3) return say(tool.hint());
      end();
    },
    cancelled: () => {
      if (!isDone) what.cancelled?.(names, photo);
    },
    outline: on =>
      what.count === 1
        ? []
        : names
            .map(name => placeOf(on, name))
            .filter(at => at !== null)
            .map(
              at =>
                /** @type {[number, number]} */ ([/** @type {any} */ (at).x, /** @type {any} */ (at).y])
            )
  };
  if (!what.onlyKnown) {
    tool.place = (on, x, y, given) => {
      if (isReadOnly("observations")) return say(t("readOnlyTable"));
      const name = given ?? freeName("p");
      edit(t("opMark", {point: name, photo: on}), [markEdit(on, name, x, y)]);
      made.add(name);
      photo ??= on;
      tool.pickPoint?.(name);
      emit("view");
    };
  }
  return tool;
}

/** Deletes the mark of a point made on the fly. */
function takeBack(name) {
  for (const pane of ui.panes) {
    const old = pane.photo && mark(pane.photo.name, name);
    if (old)
      return edit(t("opDelete", {point: name, photo: old.photo}), [
        {table: "observations", before: old, after: null}
      ]);
  }
}
