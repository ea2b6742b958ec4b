// SPDX-License-Identifier: GPL-3.0-or-later
// A journal as after days of work, so that the server soon makes it shorter.
import fs from "node:fs";

const kLong = 10000; // entries from which on it is made shorter: HistoryLimits in site_history.h
const path = site => `${site}/work/prepare/journal.jsonl`;

/** Its lines. */
export const linesOf = site => fs.readFileSync(path(site), "utf8").split("\n").slice(0, -1);

/**
 * Marks put in and taken out again, until the journal lacks `short` entries of being long. No server may run.
 * @param {string} site
 * @param {number} short
 */
export function lengthen(site, short) {
  const count = fs.existsSync(path(site)) ? linesOf(site).length : 0,
    row = {photo: "left", point: "filler", x: 100, y: 100, sigma: 0.5},
    made = [];
  for (let i = count; i + 1 < kLong - short; i += 2) {
    for (const [name, before, after] of [["in", null, row], ["out", row, null]]) {
      const operation = {id: `filler-${count}-${i}-${name}`, label: "filler", edits: [{table: "observations", before, after}]};
      made.push(JSON.stringify({kind: "edit", operation, traces: []}));
    }
  }
  fs.appendFileSync(path(site), made.map(line => `${line}\n`).join(""));
}
