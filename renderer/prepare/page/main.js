// SPDX-License-Identifier: GPL-3.0-or-later
// The page as a whole.

import {isReport, wordErrors} from "./site/api.js";
import {byId, first, node} from "./words/dom.js";
import {addConstraintKeys, showConstraints} from "./tools/constraints.js";
import {showControlTable} from "./points/control_table.js";
import {addDirectionKeys} from "./tools/directions.js";
import {buildHeader} from "./around/header.js";
import {showHelp} from "./around/help.js";
import {addAction, addKeys, listenToKeys} from "./around/keys.js";
import {addFilmHands} from "./film/fiducials.js";
import {addLightKeys} from "./light/light_panel.js";
import {buildLists, showList} from "./around/lists.js";
import {showMeasure} from "./tools/measure.js";
import {buildPanes} from "./photo/panes.js";
import {addPolygonKeys} from "./tools/polygon_tool.js";
import {emit} from "./site/signals.js";
import {showSketches} from "./points/sketches.js";
import {followRuns, showStages} from "./around/stages.js";
import {connect, start} from "./site/state.js";
import {buildToolPanel} from "./tools/tool_panel.js";
import {activePane} from "./site/ui.js";
import {language, said, t} from "./words/words.js";

function addPageKeys() {
  addKeys();
  addPolygonKeys();
  addDirectionKeys();
  addLightKeys();
  addConstraintKeys();
  addFilmHands();
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
  wordErrors(answer => said(answer, "error"));
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
  await connect();
  document.body.dataset.ready = "true";
  emit("view");
}

begin();
