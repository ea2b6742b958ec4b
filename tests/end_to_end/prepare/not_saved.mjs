// SPDX-License-Identifier: GPL-3.0-or-later
// not_saved.mjs SITE FILLED: SITE is on a small disk, FILLED a file that fills it: said on the page, nothing lost.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const [site, filled] = process.argv.slice(2);
const server = await start(site);
const person = await open(server);
const saved = () => fs.readFileSync(`${site}/survey/observations.csv`, "utf8");
const mark = async (point, x) => {
  await person.photo("left");
  await person.point(point);
  await person.goTo(x, 200);
  await person.press("Shift+Enter");
};
await person.settled();
const block = Buffer.alloc(1 << 16), file = fs.openSync(filled, "w");
try {
  for (;;) fs.writeSync(file, block);
} catch {} // full
try {
  for (;;) fs.writeSync(file, block, 0, 1);
} catch {}
for (let i = 0; i < 8; ++i) await mark(`full_${i}`, 300 + 10 * i);
await person.sees(".banner.fail", "No space left");
report("a full disk is told on the page", true, (await person.page.textContent(".banner.fail span")).slice(0, 140));
fs.ftruncateSync(file, 0);
await person.settled();
report("when there is room again all is saved", Array.from({length: 8}, (_, i) => `left,full_${i},`).every(text => saved().includes(text)));
await until("the page says so", async () => (await person.page.locator(".banner.fail").count()) === 0);
report("and the page says so", true);
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
