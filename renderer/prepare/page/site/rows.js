// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the tables: by which fields one is known, and whether two mean the same.

/** @typedef {Record<string, any>} Row */

/** The fields by which a row is known; none: the whole row; empty: the table's only row. */
export const kKeys = {
  control_points: ["name"],
  observations: ["photo", "point"],
  edges: ["photo", "from", "to", "x", "y"],
  camera_positions: ["photo"],
  polygons: ["name"],
  sun: ["shadow", "object"],
  zenith: ["bottom", "top"],
  constraints: null,
  horizon: ["photo", "x", "y"],
  haze: ["photo", "x", "y"],
  daylight: ["photo", "x", "y"],
  light: [],
  materials: ["name"],
  drafts: ["id"],
  site: [],
  film: [],
  film_marks: ["mark"],
  fiducials: ["photo", "mark"]
};

/**
 * A row's meaning as a text: fields in order, no state being "on".
 * @param {any} value
 * @returns {string}
 */
function meaning(value) {
  if (Array.isArray(value)) return `[${value.map(meaning).join()}]`;
  if (value === null || typeof value !== "object") return JSON.stringify(value ?? null);
  return `{${Object.keys(value)
    .sort()
    .filter(
      key => value[key] !== undefined && value[key] !== "" && !(key === "state" && value[key] === "on")
    )
    .map(key => `${key}:${meaning(value[key])}`)
    .join()}}`;
}
/**
 * @param {Row|null|undefined} a
 * @param {Row|null|undefined} b
 */
export const isSame = (a, b) => meaning(a ?? null) === meaning(b ?? null);

/**
 * @param {string} table
 * @param {Row} row
 */
export function keyOf(table, row) {
  const fields = kKeys[table];
  return fields ? fields.map(field => String(row[field])).join("\n") : meaning(row);
}
