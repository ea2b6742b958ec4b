// SPDX-License-Identifier: GPL-3.0-or-later
// figures.mjs SITE [WIDTH HEIGHT]: how fast the page is on a site: first tile, frames while panning, from a
// mark to the adjustment and to the light. Prints, asserts nothing.
import {open} from "./page.mjs";
import {insert, start, until} from "./server.mjs";

const site = process.argv[2];
const server = await start(site);
const median = values => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const show = (what, value, unit) => console.log(`${what.padEnd(46)} ${value.toFixed(value < 10 ? 2 : 0)} ${unit}`);

const begun = Date.now();
await server.ask("GET", "/api/tile?photo=0&level=0&x=0&y=0");
show("a tile of a photo that nobody asked for before", Date.now() - begun, "ms");
await until("adjusted", async () => (await server.ask("GET", "/api/site")).body.adjusted);
const person = await open(server, {width: 1440, height: 900});
await until("the page is adjusted", async () => (await person.data()).adjusted !== undefined);

const frames = await person.page.evaluate(async () => {
  const stage = document.querySelector(".stage"), box = stage.getBoundingClientRect();
  const at = (type, x) => stage.dispatchEvent(new PointerEvent(type, {bubbles: true, pointerId: 1, isPrimary: true,
    button: 0, buttons: type === "pointerup" ? 0 : 1, clientX: box.x + x, clientY: box.y + 200, pointerType: "mouse"}));
  const taken = [];
  at("pointerdown", 300);
  for (let i = 0, last = await new Promise(requestAnimationFrame); i < 240; ++i) {
    at("pointermove", 300 + 120 * Math.sin(i / 20));
    const now = await new Promise(requestAnimationFrame);
    taken.push(now - last);
    last = now;
  }
  at("pointerup", 300);
  return taken;
});
const sorted = [...frames].sort((a, b) => a - b);
show("frame while panning, median", median(frames), "ms");
show("frame while panning, 95 % under", sorted[Math.floor(sorted.length * 0.95)], "ms");

const site0 = (await server.ask("GET", "/api/site")).body;
const {photo, x, y} = site0.tables.observations[0];
const [adjusted, lit] = [[], []];
for (let i = 0; i < 9; ++i) {
  const at = Date.now();
  const {body} = await server.ask("POST", "/api/op", insert(`figure-${i}`, "observations",
    {photo, point: `figure_${i}`, x: x + i, y, sigma: 0.5}));
  await person.page.waitForFunction(revision => Number(document.body.dataset.adjusted) >= revision, body.revision);
  adjusted.push(Date.now() - at);
  if (!site0.light) continue;
  await until("lit", async () => (await server.ask("GET", "/api/site")).body.light?.revision >= body.revision);
  lit.push(Date.now() - at);
}
show("from a mark to the adjustment on the page, median", median(adjusted), "ms");
if (lit.length > 0) show("from a mark to the light, median (looked at every 50 ms)", median(lit), "ms");
for (let i = 0; i < 9; ++i) await server.ask("POST", "/api/undo", {id: `undo-${i}`});
await person.browser.close();
await server.stop();
