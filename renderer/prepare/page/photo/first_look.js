// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows first, asked for while its other modules are still on their way.

import {getJson, isReport} from "./api.js";
import {fetchTiles, wishTile} from "../photo/tiles.js";

const kMostPanes = 4;

/** Everything, as it is when the page comes up. */
export const firstSite = getJson("/api/site");
firstSite.then(askForOverviews, () => {}); // who awaits it tells what is wrong

function askForOverviews(site) {
  if (isReport) return;
  site.photos.slice(0, kMostPanes).forEach((photo, i) => {
    if (!photo.fault) wishTile(i, photo.levels - 1, 0, 0);
  });
  fetchTiles();
}
