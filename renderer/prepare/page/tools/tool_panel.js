// SPDX-License-Identifier: GPL-3.0-or-later
// The panel beside the panes: what is always there, and the mode's own part.

import {button, byId, node} from "../words/dom.js";
import {confirm} from "../points/marking.js";
import {buildFilmPanel, updateFilmPanel} from "../film/film_panel.js";
import {on} from "../site/signals.js";
import {buildMarkPanel, buildPointPanel} from "../points/point_panel.js";
import {updatePointTable} from "../points/point_table.js";
import {buildPolygonPanel, updatePolygonPanel} from "./polygon_tool.js";
import {buildDirectionPanel, updateDirectionPanel} from "./directions.js";
import {buildLightPanel, updateLightPanel} from "../light/light_panel.js";
import {activePane, setTool, ui} from "../site/ui.js";
import {t} from "../words/words.js";

/** @type {Record<string, [(root: any) => void, () => void]>} */
const kParts = {
  control: [buildMarkPanel, updatePointTable],
  polygons: [buildPolygonPanel, updatePolygonPanel],
  sun: [buildDirectionPanel, updateDirectionPanel],
  light: [buildLightPanel, updateLightPanel],
  film: [buildFilmPanel, updateFilmPanel]
};

export function buildToolPanel() {
  const always = node("div"),
    hint = node("p", {class: "hint", hidden: true}),
    part = node("div", {id: "mode-part"});
  byId("tool").replaceChildren(always, hint, part);
  buildPointPanel(always);
  const build = () => {
    part.replaceChildren();
    kParts[ui.mode][0](part);
    kParts[ui.mode][1]();
  };
  on("mode", build);
  on("draw", () => {
    kParts[ui.mode][1]();
    const text = ui.tool ? `${t(ui.tool.name)}: ${ui.tool.hint()}` : "";
    if (hint.dataset.text === text) return;
    hint.dataset.text = text;
    hint.hidden = text === "";
    hint.replaceChildren(
      node("span", {text}),
      node(
        "span",
        {class: "buttons"},
        button(t("confirm"), () => confirm(activePane(), false), {class: "main"}),
        button(t("cancel"), () => setTool(null))
      )
    );
  });
  // A crosshair on its way: how far it is from where the point should be.
  on("frame", () => {
    if (ui.mode === "control" && ui.panes.some(pane => pane.isMoved)) updatePointTable();
  });
  build();
}
