// SPDX-License-Identifier: GPL-3.0-or-later
// check_sentences.mjs TEXTS SOURCE...: every Sentence("key", "english", ...) of the C++ sources has a German
// text in the module TEXTS with the same {values}, and no text there is left over.
import fs from "node:fs";
import {pathToFileURL} from "node:url";
import {resolve} from "node:path";

const [module, ...sources] = process.argv.slice(2);
const {kServerTexts} = await import(pathToFileURL(resolve(module)).href);
const placesIn = text => [...new Set([...text.matchAll(/\{(\w+)\}/g)].map(one => one[1]))].sort().join();

/** @type {Map<string, string>} English by key */
const said = new Map();
const faults = [];
const kSentence = /\bSentence(?:\s+\w+)?[({]\s*"([^"]*)",\s*((?:"(?:[^"\\]|\\.)*"\s*)+)/g;
for (const source of sources) {
  for (const [, key, literals] of fs.readFileSync(source, "utf8").matchAll(kSentence)) {
    const english = literals.replace(/"\s*"/g, "").trim().slice(1, -1);
    if (said.has(key) && said.get(key) !== english) faults.push(`${source}: "${key}" says two things`);
    said.set(key, english);
  }
}
for (const [key, english] of said) {
  const german = kServerTexts[key];
  if (german === undefined) faults.push(`${module}: no text for ${key}: ${english}`);
  else if (placesIn(german) !== placesIn(english)) faults.push(`${module}: ${key} has other values than "${english}"`);
}
for (const key of Object.keys(kServerTexts)) if (!said.has(key)) faults.push(`${module}: nobody says ${key}`);
for (const fault of faults) console.log(fault);
process.exitCode = faults.length === 0 ? 0 : 1;
