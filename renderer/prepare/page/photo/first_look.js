// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows first, asked for and painted while its other modules are still on their way: the first
// photo's overview, where its pane will stand.

import {getJson, isReport} from "../site/api.js";
import {fetchTiles, onTiles, tileIfHere, wishTile} from "./tiles.js";

const kMostPanes = 4;

/** Everything, as it is when the page comes up. */
export const firstSite = getJson("/api/site");
firstSite.then(askForOverviews, () => {}); // who awaits it tells what is wrong

/** How many panes are shown: as chosen last, else as many as there are photos. */
export const firstLayout = photos =>
  Number(localStorage.getItem("insitu-layout")) ||
  Math.min(photos.length > 2 ? kMostPanes : photos.length || 1, kMostPanes);

function askForOverviews({photos}) {
  if (isReport) return;
  photos.slice(0, kMostPanes).forEach((photo, i) => {
    if (!photo.fault) wishTile(i, photo.levels - 1, 0, 0);
  });
  const [first] = photos;
  if (first && !first.fault) onTiles(() => paint(first, firstLayout(photos)));
  fetchTiles();
}

function paint({width, height, levels}, layout) {
  const tile = tileIfHere(0, levels - 1, 0, 0),
    panes = document.getElementById("panes");
  if (!tile || !panes || panes.childElementCount > 0) return;
  const pane = document.createElement("section"),
    stage = document.createElement("div"),
    canvas = document.createElement("canvas");
  pane.className = "pane first-look";
  stage.className = "stage";
  stage.append(canvas);
  pane.append(document.createElement("header"), stage);
  panes.dataset.layout = String(layout);
  panes.append(pane);
  const box = stage.getBoundingClientRect(),
    ratio = devicePixelRatio;
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  const k = Math.min(canvas.width / width, canvas.height / height),
    part = 2 ** (levels - 1);
  canvas
    .getContext("2d")
    ?.drawImage(tile, 0, 0, width / part, height / part, (canvas.width - k * width) / 2, (canvas.height - k * height) / 2, k * width, k * height);
}
