// SPDX-License-Identifier: GPL-3.0-or-later
// kill.mjs SITE MOMENTS [SHORTENED]: kill -9 at random moments while marks are set, moved and taken away; whatever
// the server confirmed is there when it comes up again. Then SHORTENED times while it makes a long journal shorter.
import fs from "node:fs";
import {lengthen, linesOf} from "./long_journal.mjs";
import {insert, report, seeded, start} from "./server.mjs";

const site = process.argv[2], [moments, shortened] = process.argv.slice(3).map(Number);
const kPause = 90; // [ms], more than after which the server writes the files
const random = seeded(9);
const confirmed = new Map(); // point -> row
let lost = 0, invented = 0, operations = 0, count = 0;

/** A random change of the marks as they are known. */
function change() {
  const id = `op-${++count}`;
  const known = [...confirmed.values()];
  const before = known[Math.floor(random() * known.length)];
  const at = {x: Math.round(random() * 90000) / 100, y: Math.round(random() * 60000) / 100};
  if (!before || random() < 0.5) {
    const row = {photo: "left", point: `kill_${count}`, ...at, sigma: 0.5};
    return insert(id, "observations", row);
  }
  const after = random() < 0.6 ? {...before, ...at} : null;
  return {id, label: id, edits: [{table: "observations", before, after}]};
}

function note({before, after}) {
  if (after) confirmed.set(after.point, after);
  else confirmed.delete(before.point);
}

function compare(rows, pending) {
  const marks = new Map(rows.filter(row => row.point.startsWith("kill_")).map(row => [row.point, row]));
  const touched = pending?.edits[0].after?.point ?? pending?.edits[0].before?.point;
  for (const [point, row] of confirmed) {
    const found = marks.get(point);
    if (point !== touched && (!found || found.x !== row.x || found.y !== row.y)) ++lost;
  }
  for (const point of marks.keys()) if (point !== touched && !confirmed.has(point)) ++invented;
  // What was asked for and not confirmed may be done or not: it counts as it is.
  if (touched === undefined) return;
  if (marks.has(touched)) confirmed.set(touched, marks.get(touched));
  else confirmed.delete(touched);
}

const pause = ms => new Promise(done => setTimeout(done, ms));

/** Changes until the server is killed, in a row or with time to save between; the one that was not confirmed. */
async function changeUntilKilled(server) {
  for (;;) {
    const pending = change();
    const answer = await server.ask("POST", "/api/op", pending).catch(() => null);
    if (answer?.status !== 200) return pending;
    note(pending.edits[0]);
    ++operations;
    if (random() < 0.1) await pause(kPause);
  }
}

async function compareAfter(server, pending) {
  await server.stop("SIGKILL");
  const again = await start(site);
  compare((await again.ask("GET", "/api/site")).body.tables.observations, pending);
  await again.stop("SIGKILL");
}

for (let moment = 0; moment < moments; ++moment) {
  const server = await start(site);
  const timer = setTimeout(() => server.child.kill("SIGKILL"), 20 + random() * 230);
  const pending = await changeUntilKilled(server);
  clearTimeout(timer);
  await compareAfter(server, pending);
}

/** Kills it once it has begun to make its journal shorter, at once or a little later; what was there then. */
async function killWhileShortening() {
  lengthen(site, 4 + Math.floor(random() * 8));
  const folder = `${site}/work/prepare`, server = await start(site);
  const later = random() * 30;
  const watcher = fs.watch(folder, (_, name) => {
    if (!name?.startsWith(".journal.")) return;
    watcher.close();
    if (later < 10) server.child.kill("SIGKILL");
    else setTimeout(() => server.child.kill("SIGKILL"), later - 10);
  });
  const pending = await changeUntilKilled(server);
  watcher.close();
  const isHalf = fs.readdirSync(folder).some(name => name.startsWith(".journal."));
  const isShort = linesOf(site)[0].includes('"kind": "begin"');
  await compareAfter(server, pending);
  return isHalf ? "half" : isShort ? "done" : "before";
}

const found = {half: 0, done: 0, before: 0};
for (let i = 0; i < (shortened ?? 0); ++i) ++found[await killWhileShortening()];
if (shortened) report("killed while the journal was made shorter", found.half > 0 && found.half + found.done === shortened, JSON.stringify(found));
report("nothing confirmed is lost", lost === 0, `${moments + (shortened ?? 0)} kills, ${operations} operations`);
report("nothing is there that nobody asked for", invented === 0);
const last = await start(site);
report("SIGTERM ends it well", (await last.stop()) === 0);
