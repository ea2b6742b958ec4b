// SPDX-License-Identifier: GPL-3.0-or-later
// A distance, a height or an angle between points, with its σ: the surveyor's tape.

import {ask} from "../site/api.js";
import {button, byId, node} from "../words/dom.js";
import {say} from "../around/notices.js";
import {shown} from "../words/numbers.js";
import {pointTool} from "./pickers.js";
import {activePane, setTool} from "../site/ui.js";
import {t} from "../words/words.js";

/** Shows the box of results, which stays while one works. */
export function showMeasure() {
  const box =
    byId("measure") ??
    byId("panes").appendChild(
      node(
        "section",
        {id: "measure", class: "floating", "aria-label": t("measure")},
        node("h2", {text: t("measure")}),
        node(
          "div",
          {class: "buttons"},
          button(t("distance"), () => take(2)),
          button(t("angle"), () => take(3)),
          button(t("close"), () => byId("measure").remove())
        ),
        node("ul", {id: "measured", "aria-live": "polite"})
      )
    );
  box.querySelector("button").focus();
}

/** @param {number} count of points */
function take(count) {
  const wanted = count === 2 ? ["pick_from", "pick_to"] : ["pick_from", "pick_apex", "pick_to"];
  setTool(
    pointTool({name: count === 2 ? "distance" : "angle", wanted, count, onlyKnown: true, done: measure})
  );
  say(t("pick_from"));
  activePane().focus();
}

async function measure(names) {
  const answer = await ask("/api/measure", {points: names});
  const text = answer.error
    ? answer.error
    : answer.angle_deg !== undefined
      ? `${shown(answer.angle_deg, 3)}° ± ${shown(answer.sigma_deg, 3)}°`
      : t("distanceAbout", {
          distance: shown(answer.distance_m, 4),
          sigma: shown(1000 * answer.sigma_m, 1),
          height: shown(answer.height_m, 4),
          heightSigma: shown(1000 * answer.height_sigma_m, 1)
        });
  say(text);
  if (!byId("measured")) showMeasure();
  byId("measured").prepend(node("li", {text: `${names.join(" – ")}: ${text}`}));
}
