// SPDX-License-Identifier: GPL-3.0-or-later
// The language of a page; {name} in a text stands for a value.

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

/**
 * @param {string} text
 * @param {Record<string, any>} values
 */
export const filled = (text, values) =>
  text.replace(/\{(\w+)\}/g, (whole, name) => (values[name] === undefined ? whole : String(values[name])));
