// SPDX-License-Identifier: GPL-3.0-or-later
// The viewing page as a whole.

import {showPhoto, shown, start, state} from "./state.js";
import {buildHeader} from "./header.js";
import {buildRenders} from "./renders.js";
import {buildStage, zoomed} from "./stage.js";
import {byId, node} from "../../prepare/page/words/dom.js";
import {emit, on} from "../../prepare/page/site/signals.js";
import {followCursor} from "./values.js";
import {forgetOutlines} from "./outline.js";
import {language} from "../../prepare/page/words/language.js";
import {listenToKeys, showKeys} from "./keys.js";
import {t} from "./words/view_words.js";

/** What tests wait for. */
function tell() {
  Object.assign(document.body.dataset, {
    photo: shown.photo,
    left: String(shown.left),
    right: String(shown.difference?.id ?? shown.right),
    mode: shown.mode,
    side: shown.side,
    k: String(zoomed.k),
    running: state.running
  });
}

async function begin() {
  document.documentElement.lang = language === "de" ? "de-CH" : "en";
  try {
    await start();
  } catch (error) {
    const why = String(error.message ?? error);
    byId("banners").append(
      node("p", {class: "banner", text: /^401/.test(why) ? t("noToken") : t("cannotLoad", {why})})
    );
    return;
  }
  buildRenders();
  buildHeader(showKeys);
  buildStage();
  followCursor();
  listenToKeys();
  on("pictures", forgetOutlines);
  on("frame", tell);
  showPhoto(state.photos[0].name);
  byId("stage").focus();
  document.body.dataset.ready = "true";
  emit("view");
}

begin();
