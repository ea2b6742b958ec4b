// SPDX-License-Identifier: GPL-3.0-or-later
// relit.mjs SITE: the demo site's photo "right" without the sun and in the sun alone, as the measured light
// says; by keyboard, anew after a change, and why not where there is no light.
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const site = process.argv[2];
const kShade = [890, 465], kSun = [900, 370], kRadius = 7; // [px] on the lawn: in the pavilion's shadow, beside it
const server = await start(site);
const person = await open(server);
const {page} = person;
await person.settled();

/** Mean linear green around a place of what the pane paints, of 1. */
const painted = place => page.evaluate(([[x, y], r]) => {
  const stage = document.querySelector('.pane[data-photo="right"] .stage');
  const canvas = stage.querySelector("canvas"), {a, d, e, f} = stage.querySelector(".figures").getScreenCTM();
  const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width;
  const corner = [(a * (x - r) + e - box.left) * ratio, (d * (y - r) + f - box.top) * ratio];
  const side = Math.max(1, Math.round(2 * r * a * ratio));
  const {data} = canvas.getContext("2d").getImageData(...corner.map(Math.round), side, side);
  let sum = 0;
  for (let i = 1; i < data.length; i += 4) {
    const code = data[i] / 255;
    sum += code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
  }
  return sum / (data.length / 4);
}, [place, kRadius]);
const shadeOverSun = async () => {
  await person.drawn();
  return (await painted(kShade)) / (await painted(kSun));
};
const pane = '.pane[data-photo="right"]';
const light = () => page.getAttribute(pane, "data-light");

await person.photo("right");
await until("the photo is painted", async () => (await painted(kSun)) > 0.05);
const before = await shadeOverSun();
await person.press("3");
await person.drawn();
report("a key shows the photo without sun", (await light()) === "none", await page.textContent(`${pane} .relit`));
await person.sees(`${pane} .relit`, "exposed");
const without = await shadeOverSun();
report("without sun the shadow on the ground is gone", before < 0.5 && Math.abs(without - 1) < 0.25, `shade over sun ${before.toFixed(2)}, then ${without.toFixed(2)}`);
await person.press("3");
await person.sees(`${pane} .relit`, "sun alone: exposed");
const alone = await shadeOverSun();
report("in the sun alone the shadow is dark but for its haze", alone < before / 2 && alone < 0.15, `shade over sun ${alone.toFixed(2)}`);
await person.click(`${pane} .relight`);
await person.drawn(); // a click is seen in the next frame only
report("a button goes on to the photo as it was taken", (await light()) === "photo" && !(await page.isVisible(`${pane} .relit`)));

// Anew when the light is another one; not without.
const {body: was} = await server.ask("GET", "/api/relit?photo=2&light=none");
const rows = (await server.ask("GET", "/api/site")).body.tables;
await server.ask("POST", "/api/op", {id: "fewer", label: "fewer", edits: [{table: "daylight", before: rows.daylight[0], after: null}]});
const now = await until("it is made anew", async () => {
  const {status, body} = await server.ask("GET", "/api/relit?photo=2&light=none");
  return status === 200 && body.revision > was.revision && body;
});
report("a change of the light makes it anew", now.exposure > 1, `revision ${was.revision}, then ${now.revision}`);
await server.ask("POST", "/api/op", {id: "none", label: "none", edits: rows.daylight.slice(1).map(row => ({table: "daylight", before: row, after: null}))});
await person.settled();
await page.evaluate(() => localStorage.setItem("insitu-language", "de"));
await page.reload();
await page.waitForSelector("body[data-ready]");
await person.photo("right");
await person.press("3");
await person.sees(`${pane} .relit.fault`, "Tageslicht: 0 brauchbare Proben");
report("without samples it says why not, in German", true, await page.textContent(`${pane} .relit`));
report("a photo or light that is not there is refused", (await server.ask("GET", "/api/relit?photo=9&light=none")).status === 404 &&
  (await server.ask("GET", "/api/relit?photo=0&light=moon")).status === 404);
report("nothing is wrong on the page", person.faults.length === 0, person.faults.join());
await person.browser.close();
await server.stop();
