// SPDX-License-Identifier: GPL-3.0-or-later
// Holes of the current polygon: windows in a wall, drawn as outlines are. Either way round is right.

import {button, node} from "../words/dom.js";
import {endDraft, keepDraft} from "./drafts.js";
import {addAction} from "../around/keys.js";
import {say} from "../around/notices.js";
import {isInside, placed, ringsOf} from "./outlines.js";
import {pointTool} from "./pickers.js";
import {edit, isReadOnly, row} from "../site/state.js";
import {activePane, setMode, setTool, ui} from "../site/ui.js";
import {t} from "../words/words.js";

const current = () => (ui.polygon === null ? undefined : row("polygons", ui.polygon));

/**
 * Takes a hole's vertices until Enter; left before, what there is becomes a draft.
 * @param {any} [draft] that is taken up again
 */
export function drawHole(draft = null) {
  if (draft) ui.polygon = draft.hole_of;
  const polygon = current();
  if (!polygon) return say(t("noPolygon"));
  if (isReadOnly("polygons")) return say(t("readOnlyTable"));
  setMode("polygons");
  const tool = pointTool({
    name: "drawHole",
    wanted: ["vertexFirst", "vertexNext", "vertexNext", "vertexOrEnter"],
    begun: draft ? {names: draft.vertices, photo: draft.photo} : undefined,
    taken: () => ringsOf(row("polygons", polygon.name) ?? polygon).flat(),
    done: names => finish(polygon.name, names, draft),
    cancelled: (names, photo) => keepDraft(names, photo, draft, {hole_of: polygon.name})
  });
  setTool(tool);
  say(tool.hint());
}

function finish(name, names, draft) {
  const before = row("polygons", name);
  if (!before) return say(t("noPolygon"));
  const after = {...before, holes: [...(before.holes ?? []), [...names]]};
  edit(t("opHole", {name}), [{table: "polygons", before, after}, ...endDraft(draft)]);
  say(t("holeMade", {name, n: after.holes.length}));
}

function remove(which) {
  const before = current();
  if (!before) return;
  if (isReadOnly("polygons")) return say(t("readOnlyTable"));
  const {holes, ...rest} = before,
    left = holes.filter((_, i) => i !== which);
  const after = left.length > 0 ? {...rest, holes: left} : rest;
  edit(t("opDeleteHole", {name: before.name}), [{table: "polygons", before, after}]);
  say(t("holeRemoved", {name: before.name, n: which + 1}));
}

/** The hole at the crosshair, or the only one. */
function removeAtCrosshair() {
  const polygon = current(),
    holes = polygon?.holes ?? [],
    pane = activePane();
  if (!polygon) return say(t("noPolygon"));
  if (holes.length === 0) return say(t("noHole", {name: polygon.name}));
  const {x, y} = pane.cursor;
  const at = holes.findIndex(hole => isInside(placed(hole, pane.photo?.name), x, y));
  if (at < 0 && holes.length > 1) return say(t("whichHole"));
  remove(Math.max(at, 0));
}

/**
 * The current polygon's holes, each with its button.
 * @param {any} root
 */
export function showHoles(root) {
  const holes = current()?.holes ?? [];
  root.replaceChildren(
    ...holes.map((names, i) =>
      node(
        "p",
        {class: "draft hole", data: {hole: i}},
        node("span", {text: `${t("hole", {n: i + 1})}: ${names.join(" ")}`}),
        button(
          t("remove"),
          () => {
            remove(i);
            activePane().focus();
          },
          {class: "small", title: "Shift+X"}
        )
      )
    )
  );
}

export function addHoleKeys() {
  addAction({id: "drawHole", key: "Shift+B", run: () => drawHole()});
  addAction({id: "removeHole", key: "Shift+X", run: removeAtCrosshair});
}
