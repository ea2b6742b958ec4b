// SPDX-License-Identifier: GPL-3.0-or-later
// figures.mjs SITE [LARGE...]: how fast the measuring page is on SITE, and on folders each of which holds
// one large photograph: first tile, frames while panning, from a mark to the adjustment and to the light;
// each beside its limit, if there is one. Nothing fails: on a machine that is busy they say little.
import fs from "node:fs";
import {open} from "./page.mjs";
import {start, until} from "./server.mjs";

const [site, ...large] = process.argv.slice(2);
const median = (values, share = 0.5) => [...values].sort((a, b) => a - b)[Math.floor(share * (values.length - 1))];
const print = (what, text) => console.log(`${what.padEnd(44)} ${text}`);
const ms = value => `${Math.round(value)} ms`;
/** [ms] that a figure may have. */
const kLimits = {tile: {24: 300, 102: 600}, median: 17, most: 27, adjusted: 500, light: 500};
const held = (value, limit) => (limit === undefined ? "" : `, at most ${limit} ms: ${value <= limit ? "ok" : "OVER"}`);
function printFrames(what, times) {
  const middle = median(times), most = median(times, 0.95);
  print(what, `median ${middle.toFixed(1)} ms${held(Math.floor(middle * 10) / 10, kLimits.median)}; ` +
    `95 % under ${most.toFixed(1)} ms${held(most, kLimits.most)}`);
}

/** Frames while a hand drags the photo about for `count` of them, with the page's own painting [ms]. */
function frames(person, count) {
  return person.page.evaluate(async frameCount => {
    const stage = document.querySelector(".pane.active .stage") ?? document.querySelector(".stage");
    const box = stage.getBoundingClientRect();
    const send = (type, x, y) => stage.dispatchEvent(new PointerEvent(type,
      {bubbles: true, cancelable: true, pointerId: 1, pointerType: "mouse", button: 0, buttons: 1, clientX: x, clientY: y}));
    stage.setPointerCapture = () => {}; // of a pointer that is none
    const middle = {x: box.left + box.width / 2, y: box.top + box.height / 2};
    send("pointerdown", middle.x, middle.y);
    const times = [];
    let last = 0;
    for (let i = 0; i < frameCount; ++i) {
      const now = await new Promise(requestAnimationFrame);
      if (last > 0) times.push(now - last);
      last = now;
      send("pointermove", middle.x + 300 * Math.sin(i / 20), middle.y + 200 * Math.sin(i / 31));
    }
    send("pointerup", middle.x, middle.y);
    return times;
  }, count);
}

/** The first tile: as the server answers at once after its first start, and as the page shows it after the second. */
async function firstTile(folder) {
  let server = await start(folder);
  const {photos: [photo]} = (await server.ask("GET", "/api/site")).body;
  const begun = performance.now();
  const {status} = await server.ask("GET", `/api/tile?photo=0&level=${photo.levels - 1}&x=0&y=0`);
  const served = performance.now() - begun;
  await server.stop();
  if (status !== 200) throw new Error(`first tile: ${status}`);
  server = await start(folder);
  const person = await open(server, {prepared: page => page.addInitScript(() => {
    const drawn = CanvasRenderingContext2D.prototype.drawImage;
    CanvasRenderingContext2D.prototype.drawImage = function (...what) {
      globalThis.firstDrawn ??= performance.now();
      return drawn.apply(this, what);
    };
  })});
  await person.page.waitForFunction(() => globalThis.firstDrawn !== undefined);
  const shown = await person.page.evaluate(() => globalThis.firstDrawn);
  return {server, person, photo, served, shown};
}

for (const folder of large) {
  const {server, person, photo, served, shown} = await firstTile(folder);
  const what = `${((photo.width * photo.height) / 1e6).toFixed(0)} MP ${fs.readdirSync(`${folder}/photos`)[0].split(".").pop()}`;
  print(`${what}: first tile`, `${ms(served)} from the server${held(served, kLimits.tile[Math.round((photo.width * photo.height) / 1e6)])}; ` +
    `${ms(shown)} from the page's address to the screen`);
  for (const [name, key] of [["whole photo", "0"], ["100 %", "1"]]) {
    await person.page.focus(".stage");
    await person.press(key);
    await frames(person, 60); // tiles come in
    const times = await frames(person, 240);
    printFrames(`${what}: frames while panning, ${name}`, times);
  }
  await person.browser.close();
  await server.stop();
}

/** From a key that moves a mark to the messages it brings. */
async function feedback(person, marks) {
  const adjusted = [], light = [];
  for (const {photo, point} of marks) {
    await person.photo(photo);
    await person.point(point);
    await person.goTo(...(await nearby(photo, point)));
    const begun = performance.now();
    await person.press("Shift+Enter");
    await person.settled();
    const revision = Number((await person.data()).revision);
    const when = type => until(`${type} of revision ${revision}`,
      () => person.told.find(one => one.type === type && one.revision === revision && one.at > begun));
    adjusted.push((await when("adjusted")).at - begun);
    light.push((await when("light")).at - begun);
  }
  return {adjusted, light};
}
let server;
const rowsOf = async table => (await server.ask("GET", "/api/site")).body.tables[table];
async function nearby(photo, point) {
  const row = (await rowsOf("observations")).find(one => one.photo === photo && one.point === point);
  return [(row.x + 0.05).toFixed(3), (row.y - 0.05).toFixed(3)];
}
server = await start(site);
const person = await open(server);
const marks = await rowsOf("observations"), photos = fs.readdirSync(`${site}/photos`).length;
const chosen = Array.from({length: 11}, (_, i) => marks[Math.floor((i * marks.length) / 11)]);
const {adjusted, light} = await feedback(person, chosen);
const tell = (values, limit) => `median ${ms(median(values))}${held(median(values), limit)}; longest ${ms(Math.max(...values))}`;
print(`${photos} photos, ${marks.length} marks: a mark to the adjustment`, tell(adjusted.slice(1), kLimits.adjusted));
print(`${photos} photos, ${marks.length} marks: a mark to the light`, tell(light.slice(1), kLimits.light));
const times = await frames(person, 240);
printFrames(`${photos} photos, ${marks.length} marks: frames while panning`, times);
await person.browser.close();
await server.stop();
