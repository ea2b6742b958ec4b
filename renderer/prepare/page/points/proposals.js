// SPDX-License-Identifier: GPL-3.0-or-later
// Places that the server proposes for the current point; they count only when someone confirms them.

import {ask} from "../site/api.js";
import {settle} from "./marking.js";
import {say} from "../around/notices.js";
import {emit} from "../site/signals.js";
import {mark, prediction} from "../site/state.js";
import {hands, photosOf, placeOf, showPhoto, ui} from "../site/ui.js";
import {t} from "../words/words.js";

/** Proposals of the point they are for, by photo. */
export const proposals = {point: "", /** @type {Map<string, any>} */ byPhoto: new Map()};

export const proposalFor = (photo, point) =>
  proposals.point === point ? proposals.byPhoto.get(photo) : undefined;

/** Takes proposals of the current point and shows the first. */
function propose(photo, point, proposal) {
  if (proposals.point !== point) {
    proposals.point = point;
    proposals.byPhoto.clear();
  }
  proposals.byPhoto.set(photo, proposal);
  for (const pane of ui.panes) {
    if (pane.photo?.name !== photo) continue;
    pane.cursor = {x: proposal.x, y: proposal.y};
    pane.isMoved = false;
    pane.reveal();
  }
  emit("view");
}

/** Asks where the corner at the crosshair is; Enter takes it. */
export async function refine(pane) {
  const other = hands();
  if (other) return other.refine(pane);
  if (!pane?.photo || ui.point === null) return say(t("noPoint"));
  settle();
  const photo = pane.photo.name,
    point = ui.point;
  const answer = await ask("/api/refine", {photo, x: pane.cursor.x, y: pane.cursor.y});
  if (answer.error) return say(t("notRefined", {why: answer.error}));
  propose(photo, point, answer);
  say(
    t("refined", {shift: Number(answer.shift ?? 0).toFixed(2), sigma: Number(answer.sigma).toFixed(2)})
  );
}

/** Asks for the point on all photos that lack it: matches, or corners at the predictions. */
export async function match(pane) {
  if (hands()) return say(t("notInFilm"));
  if (!pane?.photo || ui.point === null) return say(t("noPoint"));
  const point = ui.point,
    photo = pane.photo.name;
  const answer = await ask("/api/match", {photo, point});
  for (const one of answer.proposals ?? []) propose(one.photo, point, {...one, method: "match"});
  if (answer.error) {
    for (const name of photosOf(point).filter(
      other => !mark(other, point) && prediction(other, point)
    )) {
      const corner = await ask("/api/refine", {photo: name, ...placeOf(name, point)});
      if (!corner.error) propose(name, point, corner);
    }
  }
  const found = proposals.point === point ? proposals.byPhoto.size : 0;
  say(t("matched", {n: found}));
  if (found > 0 && !proposals.byPhoto.has(photo)) showPhoto([...proposals.byPhoto.keys()][0]);
}
