// SPDX-License-Identifier: GPL-3.0-or-later
// look.mjs SITE [SCREENSHOTS]: photographs and montages by keyboard alone: to the pixel, in turn, with the
// outline, layers and differences; in German too.
import {readdirSync, statSync} from "node:fs";
import {open} from "../prepare/page.mjs";
import {report, start, until} from "../prepare/server.mjs";

const [site, screenshots] = process.argv.slice(2);
const files = () => readdirSync(site, {recursive: true}).map(name => [name, statSync(`${site}/${name}`)])
  .filter(([, about]) => about.isFile()).map(([name, about]) => `${name} ${about.size} ${about.mtimeMs}`).sort().join();
const filesBefore = files();
const server = await start(site, [], {}, "insitu-view");
const person = await open(server);
const {page} = person;
const shot = name => (screenshots ? page.screenshot({path: `${screenshots}/view_${name}.png`}) : undefined);
const pictures = (await server.ask("GET", "/api/site")).body.photos.map(photo => photo.pictures);
const idOf = (kind, name = "", photo = 0) => String(pictures[photo].find(one => one.kind === kind && one.name === name).id);
const valueOf = async (id, x, y) => (await server.ask("GET", `/api/value?photo=${id}&x=${x}&y=${y}`)).body;

/** Codes of the canvas at a share of its width, in the middle. */
const painted = share => page.evaluate(at => {
  const canvas = document.getElementById("canvas");
  return [...canvas.getContext("2d").getImageData(Math.floor(at * canvas.width), Math.floor(canvas.height / 2), 1, 1).data.slice(0, 3)];
}, share);
const isNear = (a, b) => a.every((code, i) => Math.abs(code - b[i]) <= 1);
const codes = value => value.encoded.map(one => Math.round(255 * Math.min(Math.max(one, 0), 1)));
const values = () => page.evaluate(() => JSON.parse(document.getElementById("where").dataset.values ?? "{}"));

report("the photograph and its montage are compared first", (await person.data()).left === idOf("photo") && (await person.data()).right === idOf("montage"));
await until("both are painted", async () => !isNear(await painted(0.25), [21, 25, 28]) && !isNear(await painted(0.75), [21, 25, 28]));
await shot("slider");

// Where the montage differs most from the photograph: a pixel of the building.
const difference = (await server.ask("POST", "/api/difference", {before: Number(idOf("photo")), after: Number(idOf("montage"))})).body;
report("the difference counts pixels", difference.summary.differing > 1000 && difference.summary.differing < difference.summary.of / 2, `${difference.summary.differing} of ${difference.summary.of}`);
const far = await (async () => {
  for (let y = difference.height >> 1; y > 0; y -= 7)
    for (let x = 20; x < difference.width; x += 41) {
      const {codes: by} = await valueOf(difference.id, x, y);
      if (Math.max(...by.map(Math.abs)) > 40) return {x, y};
    }
})();
const before = await valueOf(idOf("photo"), far.x, far.y), after = await valueOf(idOf("montage"), far.x, far.y);

// To that pixel by arrows, then so near that a pixel is a square.
const steps = async (less, more, by) => {
  const presses = [["Control+", 100], ["Shift+", 10], ["", 1]];
  let left = Math.abs(by);
  for (const [modifier, step] of presses) for (; left >= step; left -= step) await person.press(`${modifier}Arrow${by < 0 ? less : more}`);
};
await steps("Left", "Right", far.x - Math.floor(difference.width / 2));
await steps("Up", "Down", far.y - Math.floor(difference.height / 2));
await until("values under the cursor", async () => {
  const told = await values();
  return told.x === far.x && told.y === far.y && told.left && told.right;
});
const told = await values();
report("linear and encoded values of both stand below", JSON.stringify([told.left, told.right]) === JSON.stringify([before, after]), await page.textContent("#where"));
await person.press("3", "b", "b");
await until("B twice", async () => {
  const {mode, side} = await person.data();
  return mode === "flicker" && side === "right";
});
report("B shows before and after in turn", true);
const inMiddle = value => until("the pixel is painted", async () => isNear(await painted(0.5), codes(value)), () => painted(0.5));
// The cursor's square is around the pixel, its middle is free.
await inMiddle(after);
await person.press("b");
await inMiddle(before);
report("at 1600 % the middle of the stage is the pixel itself, of before and after", true, `${codes(before)}, ${codes(after)}`);
await shot("pixels");
await person.press("s");
await until("side by side", async () => isNear(await painted(0.25), codes(before)) && isNear(await painted(0.75), codes(after)), async () => [await painted(0.25), await painted(0.75)]);
report("side by side both show the same pixel", true);
await person.press("0");
await person.drawn();
await shot("side");
await person.press("d", ",", ",");
await until("the slider", async () => Math.abs(Number(await page.inputValue("#split")) - 0.46) < 1e-6);
report("keys move the slider", true);

await person.press("o");
await person.sees("#say", "outline: σ of its corners up to");
await person.press("3");
await person.drawn();
await shot("outline");
const {body: outline} = await server.ask("GET", "/api/outline?photo=left&frame=photo");
report("the outline has a band, hidden parts are told", outline.known && outline.lines.some(line => line.low.length > 1) && outline.lines.some(line => line.hidden), `${outline.lines.length} pieces, ${outline.corners.length} corners`);
await person.press("o", "0", "x");
await person.sees("#say", "pixels differ");
await until("the difference", async () => (await person.data()).right === String(difference.id));
report("the difference is told in words", true, await page.textContent("#say"));
await person.press("s");
await person.drawn();
await until("its tiles", async () => isNear(await painted(0.98), [0, 0, 0]));
await shot("difference");
await person.press("x", "l");
await person.sees(".label", "layer: share of the photograph");
await person.press("l");
await person.sees(".label", "layer: computed share");
await until("the share", async () => (await values()).right?.share === 1);
report("layers are shown one by one, with the share under the cursor", true);
await person.press("v", "PageDown");
await until("the next photo", async () => {
  const {photo, right} = await person.data();
  return photo === "middle" && right === idOf("montage", "", 1);
});
report("keys go to the next photo", true);
await person.press("?");
await person.sees("dialog", "one pixel a pixel");
await person.press("Escape");

await page.evaluate(() => localStorage.setItem("insitu-language", "de"));
await page.reload();
await page.waitForSelector("body[data-ready]");
await person.sees(".label", "Montage");
await person.press("o");
await person.sees("#say", "Umriss: σ seiner Ecken bis");
report("in German too", /nebeneinander/.test(await page.textContent("#top")));
await shot("german");
report("nothing is wrong on the page", person.faults.length === 0, person.faults.join());
await person.browser.close();
report("it ends in order", (await server.stop()) === 0);
report("looking writes nothing", files() === filesBefore);
