// SPDX-License-Identifier: GPL-3.0-or-later
// The panel of the current point: its name, where the crosshair goes, what can be done with its mark.

import {button, byId, labelled, node} from "../words/dom.js";
import {confirm, deleteMark, marking, takeName, toggleDubious, toggleOff} from "./marking.js";
import {match, refine} from "./proposals.js";
import {showRename} from "./renaming.js";
import {say} from "../around/notices.js";
import {parseNumber, parsePair} from "../words/numbers.js";
import {indexed, photoOf, state} from "../site/state.js";
import {activePane, hands, showPhoto, ui} from "../site/ui.js";
import {on} from "../site/signals.js";
import {t} from "../words/words.js";

/** What keyboard users type: a name, a place. */
export function buildPointPanel(root) {
  const name = node("input", {
    id: "point-name",
    type: "text",
    list: "names",
    autocomplete: "off",
    spellcheck: "false",
    "aria-keyshortcuts": "Control+F"
  });
  const place = node("input", {
    id: "go-to",
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    placeholder: "x y",
    "aria-keyshortcuts": "Control+G"
  });
  name.addEventListener("keydown", event => {
    if (event.key === "Enter") found(name.value.trim());
    if (event.key === "Escape") backFrom(name);
  });
  place.addEventListener("keydown", event => {
    if (event.key === "Enter") goToPlace(place);
    if (event.key === "Escape") backFrom(place);
  });
  root.replaceChildren(
    node(
      "div",
      {class: "row", id: "point-row"},
      labelled(t("point"), name),
      labelled(t("goTo"), place),
      node("span", {class: "sigma"}, labelled(t("sigmaNew"), sigmaField()))
    ),
    node("datalist", {id: "names"})
  );
  on("tables site mode", fillNames);
  on("selection mode", () => {
    if (document.activeElement !== name) name.value = hands()?.current() ?? ui.point ?? "";
    byId("point-row").querySelector("span").textContent = t(hands() ? "fiducial" : "point");
  });
  fillNames();
}

function backFrom(field) {
  field.value = field.id === "point-name" ? (hands()?.current() ?? ui.point ?? "") : "";
  activePane().focus();
}

/** A photo's name shows the photo, any other is a point. */
function found(name) {
  const isPoint = hands() ? hands()?.names().includes(name) : indexed().points.has(name);
  if (photoOf(name) && !isPoint) showPhoto(name);
  else takeName(name);
}

function goToPlace(field) {
  const pair = parsePair(field.value);
  if (!pair || !activePane().isInFrame(...pair)) return say(t("badPlace", {text: field.value}));
  field.value = "";
  activePane().moveCursor(...pair);
  activePane().focus();
}

function fillNames() {
  const things = hands()?.names() ?? indexed().points.keys();
  const names = [...things, ...state.photos.map(photo => photo.name)];
  byId("names").replaceChildren(...names.map(value => node("option", {value})));
}

/** The σ that new marks get. */
function sigmaField() {
  const sigma = node("input", {
    id: "sigma-px",
    type: "text",
    inputmode: "decimal",
    value: String(marking.sigma)
  });
  sigma.addEventListener("change", () => {
    const value = parseNumber(sigma.value);
    if (value === null || !(value > 0)) {
      say(t("badNumber", {text: sigma.value}));
      sigma.value = String(marking.sigma);
      return;
    }
    marking.sigma = value;
    localStorage.setItem("insitu-sigma", String(value));
  });
  return sigma;
}

export function buildMarkPanel(root) {
  const on_ = (text, key, action) =>
    button(
      t(text),
      () => {
        action();
        activePane().focus();
      },
      {title: `${t(text)} (${key})`}
    );
  root.replaceChildren(
    node(
      "div",
      {class: "buttons"},
      button(t("confirm"), () => confirm(activePane(), false), {
        class: "main",
        id: "confirm",
        title: "Enter"
      }),
      on_("switch", "X", toggleOff),
      on_("doubt", "D", toggleDubious),
      on_("delete", "Del", deleteMark),
      button(t("rename"), showRename),
      on_("refine", "F", () => refine(activePane())),
      on_("match", "G", () => match(activePane()))
    ),
    node("div", {id: "marks-of-point"})
  );
}
