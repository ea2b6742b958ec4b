// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as people write them, there and back.

import {language} from "./language.js";

const formats = new Map();

/**
 * A number typed by a person: a comma or a point before the decimals, groups only by apostrophe, ’ or
 * blank. Null where that is not one number without doubt, as in 1.234,5.
 * @param {string} text
 * @returns {number|null}
 */
export function parseNumber(text) {
  const trimmed = text.trim().replace(/\u2212/g, "-");
  if (!/^[+-]?(\d+|\d{1,3}(['’\u0020\u00a0\u202f]\d{3})+)?([.,]\d*)?([eE][+-]?\d+)?$/.test(trimmed))
    return null;
  const value = Number(trimmed.replace(/['’\u0020\u00a0\u202f]/g, "").replace(",", "."));
  return /\d/.test(trimmed) && Number.isFinite(value) ? value : null;
}

/**
 * Two coordinates: "12.5 7", "12,5; 7", "12.5, 7".
 * @param {string} text
 * @returns {[number, number]|null}
 */
export function parsePair(text) {
  for (const separator of [";", "\t", /,\s+/, /\s+/, ","]) {
    const parts = text
      .trim()
      .split(separator)
      .filter(part => part !== "");
    if (parts.length !== 2) continue;
    const [x, y] = parts.map(parseNumber);
    if (x !== null && y !== null) return [x, y];
  }
  return null;
}

/**
 * Rounded, as the reader's country writes it; "–" if unknown.
 * @param {any} value
 * @param {number} digits
 */
export function shown(value, digits) {
  if (typeof value !== "number" || !Number.isFinite(value)) return "–";
  if (!formats.has(digits)) {
    const place =
      language !== "de" || navigator.language.startsWith("de") ? navigator.language : "de-CH";
    formats.set(
      digits,
      new Intl.NumberFormat(place, {
        minimumFractionDigits: digits,
        maximumFractionDigits: digits,
        useGrouping: place.startsWith("de")
      })
    ); // a comma between thousands is one before decimals elsewhere
  }
  const text = formats.get(digits).format(value);
  return /[1-9]/.test(text) ? text.replace("-", "\u2212") : text.replace(/^[-\u2212]/, "");
}

/**
 * A value and its σ, to the second digit of the σ.
 * @param {number} value
 * @param {number} sigma
 * @returns {[string, string]}
 */
export function withSigma(value, sigma) {
  if (!(sigma > 0) || !Number.isFinite(sigma)) return [shown(value, 4), "–"];
  const digits = Math.min(1 - Math.floor(Math.log10(sigma)), 9),
    unit = 10 ** -digits;
  const rounded = number => shown(digits < 0 ? Math.round(number / unit) * unit : number, Math.max(digits, 0));
  return [rounded(value), rounded(sigma)];
}

/**
 * A pixel coordinate as it is stored: to a thousandth.
 * @param {number} value
 */
export const stored = value => Math.round(value * 1000) / 1000 + 0;
