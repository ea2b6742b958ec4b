// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of scanned film: the certificate's fiducial marks, where they are on each scan, and what
// the server says of the map between the two.

import {row, rows, state} from "../site/state.js";
import {grade} from "../site/ui.js";

/** A mark that arrows or a drag are moving and that is not yet told to the server. */
export const movingFiducial = {photo: "", mark: "", x: 0, y: 0, timer: 0};

/**
 * The camera's fiducial marks by name: those of the certificate, of older sites those placed somewhere.
 * @returns {Map<string, any>} rows {mark, x_mm, y_mm}
 */
export function certified() {
  const all = new Map(rows("film_marks").map(one => [one.mark, one]));
  for (const {mark, x_mm, y_mm} of rows("fiducials"))
    if (!all.has(mark)) all.set(mark, {mark, x_mm, y_mm});
  return all;
}

/**
 * @param {string} photo
 * @param {string} mark
 */
export const fiducial = (photo, mark) => row("fiducials", photo, mark);
/** @param {string} photo */
export const fiducialsOn = photo => rows("fiducials").filter(one => one.photo === photo);
/** @param {string} photo */
export const reviewOf = photo => state.film?.photos?.[photo];

/**
 * What the map says of a placed mark.
 * @param {string} photo
 * @param {string} mark
 */
export const reviewedMark = (photo, mark) => reviewOf(photo)?.marks.find(one => one.mark === mark);
/**
 * @param {string} photo
 * @param {string} mark
 */
export const gradeOfFiducial = (photo, mark) => grade(reviewedMark(photo, mark)?.w);

/**
 * Where the other marks put one that is not placed.
 * @param {string} photo
 * @param {string} mark
 * @returns {{x: number, y: number}|null}
 */
export function predictedFiducial(photo, mark) {
  const at = reviewOf(photo)?.predicted?.[mark];
  return at && !fiducial(photo, mark) ? {x: at[0], y: at[1]} : null;
}

/**
 * Where a mark is, or may be.
 * @param {string} photo
 * @param {string} mark
 * @returns {{x: number, y: number}|null}
 */
export function placeOfFiducial(photo, mark) {
  if (movingFiducial.mark === mark && movingFiducial.photo === photo)
    return {x: movingFiducial.x, y: movingFiducial.y};
  const one = fiducial(photo, mark);
  return one ? {x: one.x, y: one.y} : predictedFiducial(photo, mark);
}

/**
 * Marks that a photo lacks, in the certificate's order.
 * @param {string} photo
 */
export const lacking = photo => [...certified().keys()].filter(mark => !fiducial(photo, mark));

/** Photos that are scans of film, as far as is known. */
export const scans = () => state.photos.map(photo => photo.name).filter(name => reviewOf(name));
