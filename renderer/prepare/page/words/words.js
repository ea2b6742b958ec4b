// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of this page in its language, and the server's.

import {filled, language} from "./language.js";
import {kFormats, kKinds, kServerTexts} from "./server_texts.js";
import {kTexts} from "./texts.js";

export {kLanguages, language, setLanguage} from "./language.js";

/** @param {number} n */
export const raysText = n => t(n === 1 ? "oneRay" : "rays", {n});

/**
 * @param {string} key
 * @param {Record<string, any>} [values]
 */
export function t(key, values = {}) {
  const texts = kTexts[key];
  return texts ? filled(texts[language === "de" ? 1 : 0], values) : key;
}

/** Without the folders before the site's own. */
export const nearPlace = text => text.replace(/\S*?(?=survey\/)/, "");

/** As what a table was read, as the server names it. */
export const formatText = format => (language === "de" && kFormats[format]) || format;

/**
 * What the server says in a member of a message, in the page's language: `member`_said holds the
 * sentence's key and values, which may be sentences. A text without a key is English.
 * @param {any} message
 * @param {string} member
 * @returns {string}
 */
export function said(message, member = "text") {
  const sentence = message?.[`${member}_said`],
    german = language === "de" && kServerTexts[sentence?.key];
  if (!german) return message?.[member] ?? "";
  const values = Object.entries(sentence.values ?? {}).map(([name, value]) => [
    name,
    typeof value === "object" ? said(value) : name === "kind" ? (kKinds[value] ?? value) : value
  ]);
  return filled(german, Object.fromEntries(values));
}
