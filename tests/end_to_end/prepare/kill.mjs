// SPDX-License-Identifier: GPL-3.0-or-later
// kill.mjs SITE MOMENTS: kill -9 at random moments while marks are set, moved and taken away; whatever the
// server confirmed is there when it comes up again.
import {insert, report, seeded, start} from "./server.mjs";

const [site, moments] = [process.argv[2], Number(process.argv[3])];
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

for (let moment = 0; moment < moments; ++moment) {
  const server = await start(site);
  const timer = setTimeout(() => server.child.kill("SIGKILL"), 20 + random() * 230);
  let pending = null;
  for (;;) {
    pending = change();
    const answer = await server.ask("POST", "/api/op", pending).catch(() => null);
    if (answer?.status !== 200) break;
    note(pending.edits[0]);
    ++operations;
    pending = null;
  }
  clearTimeout(timer);
  await server.stop("SIGKILL");
  const again = await start(site);
  compare((await again.ask("GET", "/api/site")).body.tables.observations, pending);
  await again.stop("SIGKILL");
}
report("nothing confirmed is lost", lost === 0, `${moments} kills, ${operations} operations`);
report("nothing is there that nobody asked for", invented === 0);
const last = await start(site);
report("SIGTERM ends it well", (await last.stop()) === 0);
