// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of this page in its language.

import {filled, language} from "../../../prepare/page/words/language.js";
import {kTexts} from "./view_texts.js";

/**
 * @param {string} key
 * @param {Record<string, any>} [values]
 */
export function t(key, values = {}) {
  const texts = kTexts[key];
  return texts ? filled(texts[language === "de" ? 1 : 0], values) : key;
}
