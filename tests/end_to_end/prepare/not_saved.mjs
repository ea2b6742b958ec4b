// SPDX-License-Identifier: GPL-3.0-or-later
// not_saved.mjs SITE [FILLED]: a file that is made read-only while it is open; and, SITE being on a small disk, that
// full of the file FILLED. It is said on the page, nothing is lost.
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
const quiet = () => until("the page says so", async () => (await person.page.locator(".banner.fail").count()) === 0);
await person.settled();
fs.chmodSync(`${site}/survey/observations.csv`, 0o444);
await mark("read_only", 300);
await person.sees(".banner.fail", "read-only");
report("a file made read-only is told on the page", !saved().includes("read_only"), (await person.page.textContent(".banner.fail span")).slice(0, 100));
fs.chmodSync(`${site}/survey/observations.csv`, 0o644);
await person.settled();
await quiet();
report("made writable again it is saved", saved().includes("left,read_only,300,"));
if (filled) await fillTheDisk();

async function fillTheDisk() {
  const block = Buffer.alloc(1 << 16), file = fs.openSync(filled, "w");
  try {
    for (;;) fs.writeSync(file, block);
  } catch {} // full
  try {
    for (;;) fs.writeSync(file, block, 0, 1);
  } catch {}
  for (let i = 0; i < 14; ++i) await mark(`full_${i}`, 300 + 10 * i);
  await person.sees(".banner.fail", "cannot be written");
  report("a full disk is told on the page", true, (await person.page.textContent(".banner.fail span")).slice(0, 140));
  fs.ftruncateSync(file, 0);
  await person.settled();
  report("when there is room again all is saved", Array.from({length: 14}, (_, i) => `left,full_${i},`).every(text => saved().includes(text)));
  await quiet();
  report("and the page says so", true);
}
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
