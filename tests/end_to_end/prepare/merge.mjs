// SPDX-License-Identifier: GPL-3.0-or-later
// merge.mjs SITE COPY: a colleague measures in COPY, we in SITE; --merge takes in what is new, and the page lets somebody
// decide what differs, row by row.
import fs from "node:fs";
import {spawnSync} from "node:child_process";
import {open} from "./page.mjs";
import {insert, report, start} from "./server.mjs";

const [site, copy] = process.argv.slice(2);
const marksOf = folder => fs.readFileSync(`${folder}/survey/observations.csv`, "utf8");
const row = (folder, photo, point) => marksOf(folder).split("\n").find(line => line.startsWith(`${photo},${point},`));
const pixel = (folder, photo, point) => row(folder, photo, point).split(",").slice(2, 4).map(Number);
fs.rmSync(copy, {recursive: true, force: true});
fs.cpSync(site, copy, {recursive: true});
const points = marksOf(site).trim().split("\n").slice(1).filter(line => line.startsWith("left,")).slice(0, 3).map(line => line.split(",")[1]);
const [near, far, other] = points;

// The colleague moves one mark a little, two by much, and makes a new one.
const theirs = await start(copy);
const {observations} = (await theirs.ask("GET", "/api/site")).body.tables;
const moved = (point, by) => {
  const before = observations.find(one => one.photo === "left" && one.point === point);
  return {table: "observations", before, after: {...before, x: before.x + by}};
};
await theirs.ask("POST", "/api/op", {id: "moves", label: "moves", edits: [moved(near, 0.3), moved(far, 25), moved(other, 30)]});
await theirs.ask("POST", "/api/op", insert("new", "observations", {photo: "left", point: "of_colleague", x: 111, y: 222, sigma: 0.5}));
await theirs.stop();
const before = Object.fromEntries(points.map(point => [point, row(site, "left", point)]));

const merged = spawnSync(`${process.env.INSITU_BIN}/insitu-prepare`, [site, "--merge", copy], {encoding: "utf8"});
report("--merge takes in what is new and counts what differs", merged.status === 0 && /^1 rows taken in, 2 differ/.test(merged.stdout), merged.stdout.split("\n")[0]);
report("what differs stays as it is here", points.every(point => row(site, "left", point) === before[point]) && row(site, "left", "of_colleague") !== undefined);
const again = spawnSync(`${process.env.INSITU_BIN}/insitu-prepare`, [site, "--merge", copy], {encoding: "utf8"});
report("a second time nothing is new", again.status === 0 && /^0 rows taken in, 2 differ/.test(again.stdout));

const server = await start(site);
const person = await open(server);
const {page} = person;
const count = async () => (await server.ask("GET", "/api/site")).body.merge.length;
await person.settled();
report("the page shows them, each once", (await count()) === 2, await page.textContent(".banner.merge p"));
const shown = await page.textContent(".banner.merge");
report("with both versions of what differs", shown.includes(far) && shown.includes(String(pixel(site, "left", far)[0])) && shown.includes(String(pixel(copy, "left", far)[0])), shown);
await page.click(".banner.merge button:nth-of-type(2)");
await person.sees(".banner.merge", other);
await person.settled();
report("theirs is taken", pixel(site, "left", far)[0] === pixel(copy, "left", far)[0], row(site, "left", far));
await page.click(".banner.merge button:nth-of-type(1)");
await page.waitForSelector(".banner.merge", {state: "detached"});
report("or ours kept, and nothing is left to decide", (await count()) === 0 && row(site, "left", other) === before[other]);
await person.press("Control+Z");
await person.settled();
report("undo brings ours back", row(site, "left", far) === before[far], row(site, "left", far));
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
const last = await start(site);
report("what is decided is not asked again", (await last.ask("GET", "/api/site")).body.merge.length === 0);
await last.stop();
