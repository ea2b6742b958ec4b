// SPDX-License-Identifier: GPL-3.0-or-later
// measure.mjs SITE MEASURED [SCREENSHOTS]: measures SITE, whose survey/ is empty, as MEASURED was: the marks that its
// truth has, with 0.4 px noise, its polygons, pairs and samples, by keyboard. With MEASURE_EVERY=N only every Nth of
// them: the others are in the files at the start, as if somebody had got that far. With BY=pointer as people do
// with a mouse, and the montage at last, from the page.
import fs from "node:fs";
import {Keyboard, Pointer} from "./hands.mjs";
import {open} from "./page.mjs";
import {report, seeded, start, until} from "./server.mjs";
import {truePixels} from "./truth.mjs";

const [site, measured, screenshots] = process.argv.slice(2);
const kNoise = 0.4; // [px]
const isByPointer = process.env.BY === "pointer";
const read = name => fs.readFileSync(`${measured}/survey/${name}`, "utf8");
const json = name => JSON.parse(read(name));
const csv = name => {
  const [header, ...lines] = read(name).trim().split("\n").map(line => line.trim().split(","));
  return lines.map(cells => Object.fromEntries(header.map((column, i) => [column, cells[i]])));
};
const random = seeded(10);
const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());

const every = Number(process.env.MEASURE_EVERY ?? 1);
const isTyped = (_, i) => i % every === 0, isThere = (_, i) => i % every !== 0;
const control = csv("control_points.csv"), trueAt = truePixels(measured);
const marks = csv("observations.csv").map(({photo, point}) => {
  const {x, y} = trueAt(photo, point);
  return {photo, point, x: (x + kNoise * normal()).toFixed(2), y: (y + kNoise * normal()).toFixed(2)};
});
const {polygons} = json("polygons.json"), {sun, zenith} = json("directions.json"), samples = json("samples.json");
const kinds = {horizon: "h", haze: "j", daylight: "o"};
if (every > 1) {
  const write = (name, value) => fs.writeFileSync(`${site}/survey/${name}`, JSON.stringify(value, null, 1));
  const lines = marks.filter(isThere).map(({photo, point, x, y}) => `${photo},${point},${x},${y},${kNoise}`);
  fs.writeFileSync(`${site}/survey/observations.csv`, `photo,point,x,y,sigma\n${lines.join("\n")}\n`);
  write("polygons.json", {polygons: polygons.filter(isThere)});
  write("directions.json", {sun: sun.filter(isThere), zenith: zenith.filter(isThere)});
  write("samples.json", Object.fromEntries(Object.keys(kinds).map(kind => [kind, samples[kind].filter(isThere)])));
} else {
  report("survey/ is empty", fs.readdirSync(`${site}/survey`).length === 0);
}

const server = await start(site);
const person = await open(server);
const hand = isByPointer ? new Pointer(person) : new Keyboard(person);
let shots = 0;
const shot = async name => {
  if (screenshots) await person.page.screenshot({path: `${screenshots}/${++shots}_${name}.png`});
};
/** Keys, clicks and notches of the wheel that something takes. */
const timed = async (what, count, work) => {
  const before = [person.keys, person.clicks, person.notches], begun = Date.now();
  await work();
  const [keys, clicks, notches] = [person.keys, person.clicks, person.notches].map((value, i) => ((value - before[i]) / count).toFixed(1));
  report(`${count} ${what}`, person.faults.length === 0,
    person.faults[0] ?? `${keys} keys, ${clicks} clicks and ${notches} notches of the wheel each, ` +
      `${((Date.now() - begun) / 1000).toFixed(1)} s`);
};
const runStage = async name => {
  await person.click("[data-menu=stages]");
  await person.click(`[data-stage=${name}]`);
  await person.page.waitForFunction(stage => new RegExp(`^${stage}: (done|failed)`).test(document.querySelector("#stage-status")?.textContent ?? ""),
    name, {timeout: 600000});
  const status = await person.page.textContent("#stage-status");
  if (!status.endsWith("done")) report(`the stage ${name}`, false, `${status}: ${await person.page.textContent("#stage-log")}`);
  await person.press("Escape");
};

await timed("calibration from the page", 1, () => runStage("calibrate"));
await timed("control points, pasted", control.length, async () => {
  await person.click("[data-menu=controlTable]");
  await person.click("#pasted");
  await person.paste(read("control_points.csv"));
  await person.click("#take-over");
  await person.press("Escape");
});
const typed = {marks: marks.filter(isTyped), polygons: polygons.filter(isTyped), sun: sun.filter(isTyped), zenith: zenith.filter(isTyped)};
const ofControl = new Set(control.map(one => one.name));
// A mouse goes from photo to photo with a point, control first; the keyboard from point to point on a photo.
const order = isByPointer
  ? (a, b) => ofControl.has(b.point) - ofControl.has(a.point) || a.point.localeCompare(b.point)
  : () => 0;
await timed("marks", typed.marks.length, async () => {
  await person.click("#sigma-px");
  await person.enter(String(kNoise));
  for (const mark of [...typed.marks].sort(order)) await hand.mark(mark);
});
await person.settled();
await shot("marks");
await timed("polygons", typed.polygons.length, async () => {
  for (const polygon of typed.polygons) {
    if (polygon.photo) await hand.show(polygon.photo);
    await person.press("b");
    for (const vertex of polygon.vertices) await hand.pick(vertex, polygon.photo);
    await person.press("Enter");
    await person.drawn();
    await person.press("F2");
    await person.enter(polygon.name);
    await person.press("t");
    await person.enter(polygon.material);
    await person.drawn();
  }
});
await person.settled();
await shot("polygons");
await timed("pairs", typed.sun.length + typed.zenith.length, async () => {
  await person.press("s");
  for (const {object, shadow} of typed.sun) await hand.pickBoth(object, shadow);
  await person.press("Escape", "v");
  for (const {bottom, top} of typed.zenith) await hand.pickBoth(bottom, top);
  await person.press("Escape");
});
await person.settled();
await shot("sun");
const all = Object.keys(kinds).flatMap(kind => samples[kind].filter(isTyped).map(sample => ({...sample, kind})));
await timed("samples", all.length, async () => {
  let kind = "";
  for (const sample of all) {
    await hand.show(sample.photo);
    if (sample.kind !== kind) await person.press(kinds[(kind = sample.kind)]);
    await hand.place(sample);
  }
  await person.press("Escape");
  await person.click("#card");
  await person.enter(samples.daylight_reflectance_rgb.join(" "));
  await person.press("Escape");
});
await person.settled();
const light = await until("the light is measured", async () => {
  const {light: told, revision} = (await server.ask("GET", "/api/site")).body;
  return told?.revision === revision && told;
});
await shot("light");
report("both inversions succeed on the page", light.failed === null, light.failed ?? "");
const {tables, todo} = (await server.ask("GET", "/api/site")).body;
const counts = {control_points: control.length, observations: marks.length, polygons: polygons.length,
  sun: sun.length, zenith: zenith.length, horizon: samples.horizon.length, haze: samples.haze.length,
  daylight: samples.daylight.length};
for (const [table, count] of Object.entries(counts)) {
  if (tables[table].length !== count) report(`${table} are all there`, false, `${tables[table].length} of ${count}`);
}
report("the next thing to do is the montage", todo.some(item => item.run === "montage"), todo[0]?.text);
reportMarks(tables.observations);
report("in all", true, `${person.keys} keys, ${person.clicks} clicks, ${Math.round(person.notches)} notches of the wheel for ` +
  `${typed.marks.length} marks, ${typed.polygons.length} polygons, ${typed.sun.length + typed.zenith.length} pairs, ${all.length} samples`);
if (isByPointer) await timed("montage from the page", 1, () => runStage("montage"));
const files = () => fs.readdirSync(`${site}/survey`).sort().map(name => fs.readFileSync(`${site}/survey/${name}`, "utf8")).join("\0");
const before = files();
for (let i = 0; i < 12; ++i) await person.press("Control+Z");
for (let i = 0; i < 12; ++i) await person.press("Control+Y");
await person.settled();
report("undone and redone, the files are the same bytes", files() === before);
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);

/** How far the marks in the files are from where they were meant. */
function reportMarks(rows) {
  const found = new Map(rows.map(row => [`${row.photo} ${row.point}`, row]));
  const off = marks.map(({photo, point, x, y}) => {
    const row = found.get(`${photo} ${point}`);
    return row ? Math.hypot(row.x - x, row.y - y) : Infinity;
  });
  report("every mark is where it was meant, to a fifth of a pixel", Math.max(...off) < 0.2, `at most ${Math.max(...off).toFixed(3)} px off`);
}
