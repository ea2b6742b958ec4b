// SPDX-License-Identifier: GPL-3.0-or-later
// What the server says, in German (Swiss), by the keys of its sentences (calibration/files/sentence.h);
// the English stands in the server. scripts/check_pages compares keys and {values}.

/** @type {Record<string, string>} */
export const kServerTexts = {
  relitFailed: "das Licht ist nicht gemessen: {why}",
  relitNoLight: "noch ist kein Licht gemessen: es braucht orientierte Fotos, Polygone und Proben",
  relitNotOriented: "das Foto ist noch nicht orientiert"
};
