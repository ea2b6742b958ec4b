// SPDX-License-Identifier: GPL-3.0-or-later
// sketches.mjs SITE: the sketches of control points: each point with its coordinates, a crop of every photo that
// shows it, centred on its mark, and a note that goes into the file; printed, they stand alone.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const site = process.argv[2];
const file = () => fs.readFileSync(`${site}/survey/control_points.csv`, "utf8");
const before = file();
const server = await start(site);
const person = await open(server);
await person.settled();
const {tables, adjusted, photos} = (await server.ask("GET", "/api/site")).body;
await person.click("#top button:has-text('Sketches')");
await person.page.waitForSelector("#sketches article");

const sheets = await person.page.evaluate(() => [...document.querySelectorAll("#sketches article")].map(one => ({
  title: one.querySelector("h2").textContent,
  place: one.querySelector("p").textContent,
  crops: [...one.querySelectorAll("figcaption")].map(caption => caption.textContent),
})));
const control = tables.control_points;
report("each control point has a sketch", sheets.length === control.length &&
  control.every((point, i) => sheets[i].title.startsWith(`${point.name} (`)), sheets.length);
const other = control.flatMap((point, i) => ["x", "y", "z"].map(axis => {
  const [, value, sigma] = sheets[i].place.match(new RegExp(`${axis} ([-\\d.]+) ± ([\\d.]+) m`)) ?? [];
  const isRight = Math.abs(value - point[axis]) <= 0.00051 && Math.abs(sigma - point[`sigma_${axis}`]) <= 0.00051;
  return isRight ? "" : `${point.name} ${axis} ${point[axis]}: ${sheets[i].place}`;
})).filter(text => text !== "");
report("with its coordinates to the millimetre, and their sigma", other.length === 0, other[0]);
const marked = (photo, point) => tables.observations.some(one => one.photo === photo && one.point === point && one.state !== "off");
const shows = (photo, point) => marked(photo, point) || adjusted.points[point]?.images?.[photo];
report("and a crop of each photo that shows it", control.every((point, i) => {
  const expected = photos.filter(photo => shows(photo.name, point.name)).map(photo => photo.name);
  return expected.length === sheets[i].crops.length && expected.every((name, k) => sheets[i].crops[k].startsWith(`${name} `) &&
    sheets[i].crops[k].includes("(") !== marked(name, point.name));
}), JSON.stringify(sheets[0].crops));

// Inside the cross, at the middle of a crop, is the pixel of the mark.
const mark = tables.observations.find(one => one.point === control[0].name);
const index = photos.findIndex(photo => photo.name === mark.photo);
const {body: value} = await server.ask("GET", `/api/value?photo=${index}&x=${Math.round(mark.x)}&y=${Math.round(mark.y)}`);
const middle = () => person.page.evaluate(name => {
  const figure = [...document.querySelector("#sketches article").querySelectorAll("figure")]
    .find(one => one.querySelector("figcaption").textContent.startsWith(`${name} `));
  const canvas = figure.querySelector("canvas");
  return [...canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data].slice(0, 3);
}, mark.photo);
const shown = await until("the crop is painted", async () => {
  const rgb = await middle();
  return rgb.some(code => code > 0) && rgb;
});
const codes = value.encoded.map(one => Math.round(255 * one));
report("its middle is the mark's pixel", shown.join() === codes.join(), `${shown} ${codes}`);

await person.page.emulateMedia({media: "print"});
const visible = await person.page.evaluate(() => [...document.querySelectorAll("body *")]
  .filter(one => one.checkVisibility() && !one.closest("#sketches")).map(one => one.tagName));
report("printed, they stand alone", visible.length === 0 &&
  !(await person.page.isVisible("#sketches .no-print")), visible.slice(0, 5).join(" "));
await person.page.emulateMedia({media: "screen"});

await person.click("#sketches article input");
await person.type("bolt, east of the door");
await person.press("Tab");
await until("the note is in the file", () => /bolt/.test(file()), file);
const row = file().split("\n").find(line => line.startsWith(`${control[0].name},`));
report("a note goes into the file, in quotes for its comma", row.endsWith(',"bolt, east of the door"'), row);
await person.click("#sketches button:has-text('Close')");
await person.press("Control+Z");
await until("the note is undone", () => file() === before, file);
report("and is undone to the byte", file() === before);
report("the page has no faults", person.faults.length === 0, person.faults.join("; "));
await person.browser.close();
await server.stop();
