// SPDX-License-Identifier: GPL-3.0-or-later
// measure.mjs SITE MEASURED [SCREENSHOTS]: measures SITE, whose survey/ is empty, by keyboard, as MEASURED
// was: its marks with 0.4 px noise, its polygons, pairs and samples. With MEASURE_EVERY=N only every Nth of
// them: the others are in the files at the start, as if somebody had got that far.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, seeded, start, until} from "./server.mjs";

const [site, measured, screenshots] = process.argv.slice(2);
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
const marks = csv("observations.csv").map(({photo, point, x, y}) =>
  ({photo, point, x: (Number(x) + 0.4 * normal()).toFixed(2), y: (Number(y) + 0.4 * normal()).toFixed(2)}));
const {polygons} = json("polygons.json"), {sun, zenith} = json("directions.json"), samples = json("samples.json");
const kinds = {horizon: "h", haze: "j", daylight: "o"};
if (every > 1) {
  const write = (name, value) => fs.writeFileSync(`${site}/survey/${name}`, JSON.stringify(value, null, 1));
  const lines = marks.filter(isThere).map(({photo, point, x, y}) => `${photo},${point},${x},${y},0.5`);
  fs.writeFileSync(`${site}/survey/observations.csv`, `photo,point,x,y,sigma\n${lines.join("\n")}\n`);
  write("polygons.json", {polygons: polygons.filter(isThere)});
  write("directions.json", {sun: sun.filter(isThere), zenith: zenith.filter(isThere)});
  write("samples.json", Object.fromEntries(Object.keys(kinds).map(kind => [kind, samples[kind].filter(isThere)])));
}

const server = await start(site);
const person = await open(server);
let shots = 0;
const shot = async name => {
  if (screenshots) await person.page.screenshot({path: `${screenshots}/${++shots}_${name}.png`});
};
const timed = async (what, count, work) => {
  const [keys, clicks, begun] = [person.keys, person.clicks, Date.now()];
  await work();
  const each = value => (value / count).toFixed(1);
  report(`${count} ${what}`, person.faults.length === 0,
    person.faults[0] ?? `${each(person.keys - keys)} keys and ${each(person.clicks - clicks)} clicks each, ` +
      `${((Date.now() - begun) / 1000).toFixed(1)} s`);
};

await timed("calibration from the page", 1, async () => {
  await person.click("[data-menu=stages]");
  await person.click("[data-stage=calibrate]");
  await person.page.waitForFunction(() => /done/i.test(document.querySelector("#stage-status")?.textContent ?? ""),
    null, {timeout: 120000});
  await person.press("Escape");
});
const control = csv("control_points.csv");
await timed("control points, pasted", control.length, async () => {
  await person.click("[data-menu=controlTable]");
  await person.page.fill("#pasted", read("control_points.csv"));
  await person.click("#take-over");
  await person.press("Escape");
});
const typed = {marks: marks.filter(isTyped), polygons: polygons.filter(isTyped), sun: sun.filter(isTyped), zenith: zenith.filter(isTyped)};
let current = "";
await timed("marks", typed.marks.length, async () => {
  await person.page.fill("#sigma-px", "0.5");
  for (const mark of typed.marks) {
    if (mark.photo !== current) await person.photo((current = mark.photo));
    await person.point(mark.point);
    await person.goTo(mark.x, mark.y);
    await person.press("Shift+Enter");
  }
});
await person.settled();
await shot("marks");
await timed("polygons", typed.polygons.length, async () => {
  for (const polygon of typed.polygons) {
    if (polygon.photo && polygon.photo !== current) await person.photo((current = polygon.photo));
    await person.press("b");
    for (const vertex of polygon.vertices) await person.point(vertex);
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
  for (const {object, shadow} of typed.sun) for (const point of [object, shadow]) await person.point(point);
  await person.press("Escape", "v");
  for (const {bottom, top} of typed.zenith) for (const point of [bottom, top]) await person.point(point);
  await person.press("Escape");
});
await person.settled();
await shot("sun");
const all = Object.keys(kinds).flatMap(kind => samples[kind].filter(isTyped).map(sample => ({...sample, kind})));
await timed("samples", all.length, async () => {
  let kind = "";
  for (const sample of all) {
    if (sample.photo !== current) await person.photo((current = sample.photo));
    if (sample.kind !== kind) await person.press(kinds[(kind = sample.kind)]);
    await person.goTo(sample.x, sample.y);
    await person.press("Enter");
  }
  await person.press("Escape");
  await person.page.fill("#card", samples.daylight_reflectance_rgb.join(" "));
  await person.press("Enter", "Escape");
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
const files = () => fs.readdirSync(`${site}/survey`).sort().map(name => fs.readFileSync(`${site}/survey/${name}`, "utf8")).join("\0");
const before = files();
for (let i = 0; i < 12; ++i) await person.press("Control+Z");
for (let i = 0; i < 12; ++i) await person.press("Control+Y");
await person.settled();
report("undone and redone, the files are the same bytes", files() === before);
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
