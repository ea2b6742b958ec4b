// SPDX-License-Identifier: GPL-3.0-or-later
// The page as a whole.

import {isReport} from "./api.js";
import {byId, first, node} from "./dom.js";
import {addConstraintKeys, showConstraints} from "./constraints.js";
import {showControlTable} from "./control_table.js";
import {addDirectionKeys} from "./directions.js";
import {buildHeader} from "./header.js";
import {showHelp} from "./help.js";
import {addAction, addKeys, listenToKeys} from "./keys.js";
import {addLightKeys} from "./light_panel.js";
import {buildLists, showList} from "./lists.js";
import {showMeasure} from "./measure.js";
import {buildPanes} from "./panes.js";
import {addPolygonKeys} from "./polygon_tool.js";
import {emit} from "./signals.js";
import {showSketches} from "./sketches.js";
import {followRuns, showStages} from "./stages.js";
import {start} from "./state.js";
import {buildToolPanel} from "./tool_panel.js";
import {activePane} from "./ui.js";
import {language, t} from "./words.js";

function addPageKeys() {
  addKeys();
  addPolygonKeys();
  addDirectionKeys();
  addLightKeys();
  addConstraintKeys();
  addAction({
    id: "list",
    key: "L",
    run: () => {
      showList("points");
      first("#list tbody button")?.focus();
    }
  });
  addAction({id: "help", key: "?", run: showHelp, isPage: true});
}

async function begin() {
  document.documentElement.lang = language === "de" ? "de-CH" : "en";
  document.body.classList.toggle("report", isReport);
  try {
    await start();
  } catch (error) {
    byId("banners").replaceChildren(
      node("p", {
        class: "banner fail",
        text: /^401/.test(error.message)
          ? t("noToken")
          : t("cannotLoad", {why: String(error.message ?? error)})
      })
    );
    return;
  }
  addPageKeys();
  buildHeader([
    ["controlTable", showControlTable],
    ["constraints", showConstraints],
    ["measure", showMeasure],
    ["stages", showStages],
    ["sketches", showSketches],
    ["help", showHelp]
  ]);
  buildLists();
  followRuns();
  if (!isReport) {
    buildPanes();
    buildToolPanel();
    activePane()?.focus();
  }
  listenToKeys();
  document.body.dataset.ready = "true";
  emit("view");
}

begin();
