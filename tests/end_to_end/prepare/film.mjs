// SPDX-License-Identifier: GPL-3.0-or-later
// film.mjs SITE [SCREENSHOTS]: SITE, of film_scans.py, has scans and no camera. Its certificate is typed, its
// fiducial marks are placed by keyboard, and the stages then run from the page.
import fs from "node:fs";
import {open} from "./page.mjs";
import {insert, report, start, until} from "./server.mjs";

const [site, screenshots] = process.argv.slice(2);
const truth = JSON.parse(fs.readFileSync(`${site}/film_truth.json`, "utf8"));
const names = Object.keys(truth.fiducials);
const server = await start(site);
const person = await open(server, {size: {width: 1400, height: 900}});
const {page} = person;

const asked = async () => (await server.ask("GET", "/api/site")).body;
const review = async photo => (await asked()).film.photos[photo];
const toDo = async () => (await asked()).todo.map(one => one.text);
const shot = async name => {
  if (screenshots) await page.screenshot({path: `${screenshots}/${name}.png`});
};
/** Into a field of the dialog, as Tab leaves it. */
const fill = async (id, text) => {
  await page.focus(`#${id}`);
  await person.press("Control+A");
  await person.type(text);
  await person.press("Tab");
};
/** A mark by its name, to a place, Enter. */
const place = async (mark, [x, y]) => {
  await person.point(mark);
  await person.goTo(x, y);
  await person.press("Shift+Enter");
  await person.settled();
};
const says = id => page.textContent(`#${id}`);

// ---- the certificate ----
await person.sees("#todo", "certificate");
const begin = page.locator("#todo button", {hasText: "of scanned film"});
await person.settled();
report("it is not among those that are folded away", await begin.isVisible());
await begin.focus();
// The list is made anew beneath the person who goes through it by keyboard.
const told = await says("todo");
await server.ask("POST", "/api/op", insert("other", "polygons", {name: "other", vertices: ["tower_0", "tower_1", "tower_5"], material: "m", photo: null, mask: null}));
await until("the list has changed", async () => (await says("todo")) !== told);
report("the focus stays on it while the list changes", await begin.evaluate(one => one === document.activeElement));
await server.ask("POST", "/api/undo", {id: "back"});
await until("the list is as it was", async () => (await says("todo")) === told);
await person.press("Enter");
await page.waitForSelector("#film-focal");
report("what is to be done leads to the certificate", (await person.data()).mode === "film");
await fill("film-focal", "56.5x");
report("what is no number is told", (await says("certificate-says")).includes("56.5x"), await says("certificate-says"));
await fill("film-focal", "NaN");
report("NaN is told", (await says("certificate-says")).includes("NaN"));
await fill("film-focal", String(truth.focal_mm).replace(".", ","));
await fill("film-point-x", String(truth.principal_point_mm[0]));
await fill("film-point-y", String(truth.principal_point_mm[1]));
await fill("film-distortion", truth.distortion.map(([radius, value]) => `${value} ${radius}`).join("\n"));
report("exchanged columns are told", (await says("certificate-says")).includes("columns exchanged"), await says("certificate-says"));
await fill("film-distortion", truth.distortion.map(pair => pair.join("\t")).join("\n"));
report("then nothing is complained of", (await says("certificate-says")) === "");
for (const name of names) {
  await page.focus("#film-mark");
  await person.type(name);
  for (const number of truth.fiducials[name]) {
    await person.press("Tab");
    await person.type(String(number));
  }
  await person.press("Enter");
}
await shot("certificate");
await person.press("Escape");
await person.settled();
const film = JSON.parse(fs.readFileSync(`${site}/calibration/film.json`, "utf8"));
report("film.json holds the certificate", film.focal_mm === truth.focal_mm && film.distortion.length === 8 &&
  film.principal_point_mm.join() === truth.principal_point_mm.join() && film.fiducials.length === names.length, JSON.stringify(film).slice(0, 120));
report("the list asks for the fiducials of each scan", (await toDo()).filter(text => /fiducials to be placed/.test(text)).length === 3, (await toDo())[0]);

// ---- the first scan, with mistakes ----
await person.photo("left");
const scan = truth.scans.left;
await place("1", scan["1"]);
await place("2", scan["2"]);
await until("two marks predict the third", async () => (await review("left")).predicted["3"]);
const [px, py] = (await review("left")).predicted["3"];
report("two marks predict the others", Math.hypot(px - scan["3"][0], py - scan["3"][1]) < 2, `${px.toFixed(1)} ${py.toFixed(1)}`);
await place("3", scan["3"]);
await person.sees("#film-map", "redundancy 0");
report("three marks cannot be checked", (await says("film-map")).includes("cannot be checked"), await says("film-map"));
report("and the list says so", (await toDo()).some(text => text === "left: one more fiducial"));
await place("4", scan["4"]);
await place("5", scan["7"]);
await person.sees("#film-about .fail", "mark 5 stands on mark 7");
const german = await open(server, {browser: person.browser, prepared: other => other.addInitScript(() => localStorage.setItem("insitu-language", "de"))});
await german.press("Alt+5");
await german.photo("left");
await german.sees("#film-about .fail", "die Marke 5 steht auf der Marke 7, oder ");
await german.sees("#todo", "left: die Marke 5 steht auf der Marke 7");
report("also in German, beside the scan and in the list", true, await german.page.textContent("#film-about .fail"));
await german.page.close();
await shot("wrong_fiducial");
report("a mark on the wrong fiducial is named", true, await says("film-about .fail"));
const worst = await page.getAttribute("#film-marks tbody tr", "data-fiducial");
report("its residual of millimetres stands there", Math.abs(1000 * (await review("left")).marks[0].vy_mm) > 1000, `first in the table: ${worst}`);
await person.press("Control+Z");
await person.settled();
await place("5", [scan["5"][0] + 3, scan["5"][1] - 2]);
await person.sees("#film-about .fail", "mark 5 lies");
report("a blunder of 3.6 px is named and is first", (await page.getAttribute("#film-marks tbody tr", "data-fiducial")) === "5", await says("film-about .fail"));
await shot("blunder");
await person.press("ArrowLeft", "ArrowLeft", "ArrowLeft", "ArrowDown", "ArrowDown");
await until("arrows mend it", async () => (await review("left")).sigma_px < 0.05);
report("arrows nudge it right, and the residuals follow", (await review("left")).suspicions.length === 0, await says("film-map"));
for (const name of ["6", "7", "8"]) await place(name, scan[name]);
await person.sees("#film-map", "8 marks");
const done = await review("left");
report("eight marks: redundancy 10, the scan's own turn and scale", done.redundancy === 10 && Math.abs(done.turn_deg - 0.7) < 0.01 && Math.abs(done.px_per_mm - 16) < 0.01, await says("film-map"));
await shot("placed");

// ---- refinement, clicks, the other scans ----
await person.point("8");
await person.goTo(scan["8"][0] + 1, scan["8"][1] - 1);
await person.press("f");
const said = await until("an answer", () => page.textContent("#say"));
await person.press("Shift+Enter");
await person.settled();
const refined = fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8").match(/^8,.*,left,(.*),(.*)$/m).slice(1).map(Number);
const missed = Math.hypot(refined[0] - scan["8"][0], refined[1] - scan["8"][1]);
report("F finds the cross's centre, Enter takes it", missed < 0.15 && missed > 0, `${said} ${missed.toFixed(3)} px from the truth`);
await place("8", scan["8"]);
await person.photo("middle");
const click = async at => {
  const {x, y} = await person.at("middle", ...at);
  await page.mouse.click(x, y);
  await person.drawn();
};
await person.point("1");
await click(truth.scans.middle["1"]); // from far away it zooms in first
await click(truth.scans.middle["1"]);
await person.settled();
const clicked = async () => fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8").match(/^1,.*,middle,(.*),(.*)$/m)?.slice(1).map(Number) ?? [];
const [x1, y1] = await clicked();
report("a click places a mark", Math.hypot(x1 - truth.scans.middle["1"][0], y1 - truth.scans.middle["1"][1]) < 1, `${x1} ${y1}`);
await person.point("1");
const from = await person.at("middle", x1, y1);
await page.mouse.move(from.x, from.y);
await page.mouse.down();
await page.mouse.move(from.x + 8, from.y - 6, {steps: 4});
await page.mouse.up();
await person.settled();
report("a drag moves it", Math.hypot((await clicked())[0] - x1 - 8, (await clicked())[1] - y1 + 6) < 1, await clicked());
for (const name of names) await place(name, truth.scans.middle[name]);
await person.photo("right");
await place("1", truth.scans.right["1"]);
await place("2", truth.scans.right["2"]);
await place("3", truth.scans.right["3"]);
await person.point("4");
for (const name of ["4", "5", "6", "7", "8"]) {
  await person.press("Enter"); // at the prediction, and on to the next
  await until(`${name} is placed`, async () => (await review("right")).marks.some(one => one.mark === name));
}
await person.settled();
report("predictions are confirmed by Enter one by one", (await review("right")).sigma_px < 0.05, (await review("right")).sigma_px);
const bytes = fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8");
await person.point("1");
await person.press("x");
await person.settled();
await until("one mark less counts", async () => (await review("right")).placed === 7);
report("X switches a mark off: a comment in the file, said in the table", /^#off 1,/m.test(fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8")) &&
  (await page.textContent("#film-marks tr[data-fiducial='1']")).includes("off"), await page.textContent("#film-marks tr[data-fiducial='1']"));
await shot("switched_off");
await person.press("x");
await person.settled();
report("and on again, to the byte", fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8") === bytes);
const [dubious] = (await review("right")).marks.filter(one => one.mark === "1");
await person.press("d");
await person.settled();
await until("its residual is another", async () => (await review("right")).marks.find(one => one.mark === "1").r > dubious.r);
report("D doubts a mark: three times the σ, said in file and table", /^1,.*,right,.*,dubious$/m.test(fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8")) &&
  (await page.textContent("#film-marks tr[data-fiducial='1']")).includes("?"), await page.getAttribute("#film-marks tr[data-fiducial='1']", "title"));
await shot("dubious");
await person.press("d");
await person.settled();
await person.press("Control+Z");
await person.press("Control+Z");
await person.settled();
report("undone it is as before, to the byte", fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8") === bytes);
await person.press("Delete");
await person.settled();
await person.press("Control+Z");
await person.settled();
report("undone to the byte", fs.readFileSync(`${site}/calibration/fiducials.csv`, "utf8") === bytes, bytes.split("\n")[1]);

// ---- the stages ----
const run = async stage => {
  await page.click("[data-menu=stages]");
  await page.click(`[data-stage=${stage}]`);
  await page.waitForFunction(() => /done|failed/.test(document.querySelector("#stage-status")?.textContent ?? ""));
  const status = await says("stage-status"), log = await says("stage-log");
  await person.press("Escape");
  report(`${stage} runs from the page`, /done/.test(status), log.trim().split("\n").slice(-1)[0]);
  return log;
};
report("the list says to calibrate", (await toDo())[0] === "calibrate the scans", (await toDo())[0]);
const log = await run("calibrate");
report("the product's reader takes the film", (log.match(/scanned film/g) ?? []).length === 3, log.split("\n")[0]);
await until("the photos are oriented", async () => Object.values((await asked()).adjusted?.photos ?? {}).filter(one => one.oriented).length === 3);
report("and is not to do any more", !(await toDo()).includes("calibrate the scans"));
const {sigma0} = (await asked()).adjusted;
report("the survey adjusts with the scans' cameras", sigma0 < 1.5, sigma0);
await run("reconstruct");
await run("undistort");
report("undistorted scans are there", ["left", "middle", "right"].every(name => fs.existsSync(`${site}/work/input_images/${name}.exr`)));
await shot("end");
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
