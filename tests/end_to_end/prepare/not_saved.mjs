// SPDX-License-Identifier: GPL-3.0-or-later
// not_saved.mjs SITE [FILLED]: a file that is made read-only while it is open; and, SITE being on a small disk, that
// full of the file FILLED. It is said on the page, nothing is lost.
import fs from "node:fs";
import {lengthen, linesOf} from "./long_journal.mjs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const [site, filled] = process.argv.slice(2);
const kRoom = 300000; // [bytes], less than the shorter journal needs
let server = await start(site),
  person = await open(server);
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
report("a file made read-only is told on the page and in the terminal", !saved().includes("read_only") && server.complained().includes("warning: survey/observations.csv: is read-only"), (await person.page.textContent(".banner.fail span")).slice(0, 100));
fs.chmodSync(`${site}/survey/observations.csv`, 0o644);
await person.settled();
await quiet();
report("made writable again it is saved", saved().includes("left,read_only,300,") && server.complained().includes("warning: all is saved again"));
if (filled) {
  await fillTheDisk();
  await shortenInVain();
}

/** Nothing more can be written; the file that did it. */
function fill() {
  const block = Buffer.alloc(1 << 16), file = fs.openSync(filled, "w");
  try {
    for (;;) fs.writeSync(file, block);
  } catch {} // full
  try {
    for (;;) fs.writeSync(file, block, 0, 1);
  } catch {}
  return file;
}

async function fillTheDisk() {
  const file = fill();
  for (let i = 0; i < 14; ++i) await mark(`full_${i}`, 300 + 10 * i);
  await person.sees(".banner.fail", "cannot be written");
  report("a full disk is told on the page and in the terminal", server.complained().includes("No space left on device"), (await person.page.textContent(".banner.fail span")).slice(0, 140));
  fs.ftruncateSync(file, 0);
  await person.settled();
  report("when there is room again all is saved", Array.from({length: 14}, (_, i) => `left,full_${i},`).every(text => saved().includes(text)));
  await quiet();
  report("and the page says so", true);
}

/** Room for marks and files, but not for the journal that is to be put in the place of a long one. */
async function shortenInVain() {
  await person.browser.close();
  await server.stop();
  lengthen(site, 10);
  server = await start(site);
  person = await open(server);
  await person.settled();
  const file = fill();
  fs.ftruncateSync(file, fs.fstatSync(file).size - kRoom);
  for (let i = 0; i < 8; ++i) {
    await mark(`long_${i}`, 300 + 10 * i);
    await person.settled();
  }
  await person.sees(".banner.review", "cannot be made shorter");
  const told = await person.page.textContent(".banner.review span"), lines = linesOf(site).length;
  report("a journal that cannot be made shorter is told, and stays whole", lines > 9990, `${lines} entries; ${told.slice(-100)}`);
  report("what is marked meanwhile is saved", saved().includes("left,long_7,370,"));
  fs.ftruncateSync(file, 0);
  await server.stop("SIGKILL");
  await person.browser.close();
  server = await start(site);
  person = await open(server);
  await person.settled();
  report("at the next start it is made shorter", linesOf(site).length < 20, `${linesOf(site).length} entries`);
  const text = saved();
  await server.ask("POST", "/api/undo", {id: "back"});
  await person.settled();
  report("nothing is lost, and it can be undone", text.includes("left,long_7,370,") && !saved().includes("long_7") && saved().includes("left,long_6,360,"));
}
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
