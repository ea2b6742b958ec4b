// SPDX-License-Identifier: GPL-3.0-or-later
// The page's language and its texts; {name} stands for a value.

import {kTexts} from "./texts.js";

/** @type {[string, string][]} */
export const kLanguages = [
  ["en", "EN"],
  ["de", "DE"]
];
export const language =
  localStorage.getItem("insitu-language") ?? (navigator.language.startsWith("de") ? "de" : "en");

/**
 * Texts are built once: the page begins anew.
 * @param {string} chosen
 */
export function setLanguage(chosen) {
  localStorage.setItem("insitu-language", chosen);
  location.reload();
}

/** @param {number} n */
export const raysText = n => t(n === 1 ? "oneRay" : "rays", {n});

/**
 * @param {string} key
 * @param {Record<string, any>} [values]
 */
export function t(key, values = {}) {
  const texts = kTexts[key];
  if (!texts) return key;
  return texts[language === "de" ? 1 : 0].replace(/\{(\w+)\}/g, (whole, name) =>
    values[name] === undefined ? whole : String(values[name])
  );
}
