// SPDX-License-Identifier: GPL-3.0-or-later
// guide.mjs MEASURED FILM FOLDER PICTURES [NAME...]: the pictures of renderer/prepare/GUIDE.md, or those named, from the
// demo site MEASURED and from FILM, of film_scans.py, copied step by step into FOLDER.
import fs from "node:fs";
import {open} from "./page.mjs";
import {start, until} from "./server.mjs";

const [measured, film, folder, pictures, ...named] = process.argv.slice(2);
const read = name => fs.readFileSync(`${measured}/survey/${name}`, "utf8");

/**
 * A site with some of the demo's files, the page of a program on it, and what is done on it before its picture is taken.
 * @param {string} name
 * @param {{from?: string, parts?: string[], survey?: Record<string, string>}} site
 * @param {(person: any, server: any) => Promise<any>} act
 */
async function picture(name, {from = measured, parts = ["calibration", "work/calibration"], survey = {}}, act, program = "insitu-prepare") {
  if (named.length > 0 && !named.includes(name)) return;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(`${folder}/demo/survey`, {recursive: true});
  for (const part of ["photos", "building", "site.json", ...parts])
    fs.cpSync(`${from}/${part}`, `${folder}/demo/${part}`, {recursive: true});
  for (const [file, text] of Object.entries(survey)) fs.writeFileSync(`${folder}/demo/survey/${file}`, text);
  const server = await start(`${folder}/demo`, [], {}, program);
  const person = await open(server);
  if (program === "insitu-prepare") await person.settled();
  await act(person, server);
  await person.page.waitForLoadState("networkidle").catch(() => {});
  await person.page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  await person.page.screenshot({path: `${pictures}/${name}.png`});
  if (person.faults.length > 0) console.log(`FAIL: ${name}: ${person.faults[0]}`);
  await person.browser.close();
  await server.stop();
}

const all = Object.fromEntries(fs.readdirSync(`${measured}/survey`).map(name => [name, read(name)]));
const {"materials.json": materials, "control_points.csv": control, "observations.csv": marks} = all;
const lines = marks.trim().split("\n");
const lit = server => until("the light is measured", async () => (await server.ask("GET", "/api/site")).body.light);

await picture("1_to_do", {survey: {"materials.json": materials}, parts: ["calibration"]}, async person => {
  await person.sees("#todo");
});
const truth = JSON.parse(fs.readFileSync(`${film}/film_truth.json`, "utf8"));
await picture("1_film", {from: film, parts: [], survey: {"materials.json": materials}}, async (person, server) => {
  const edits = [];
  const put = (table, after) => edits.push({table, before: null, after});
  put("film", {focal_mm: truth.focal_mm, principal_point_mm: truth.principal_point_mm, distortion: truth.distortion});
  Object.entries(truth.fiducials).forEach(([mark, [x_mm, y_mm]], i) => {
    const [x, y] = truth.scans.left[mark], off = 0.1 * [1, -2, 2, -1, 3, -3, 0, 1][i];
    put("film_marks", {mark, x_mm, y_mm});
    if (mark !== "8") put("fiducials", {mark, x_mm, y_mm, photo: "left", x: x + off, y: y - off});
  });
  await server.ask("POST", "/api/op", {id: "film", label: "film", edits});
  await person.press("Alt+5");
  await person.photo("left");
  await person.sees("#film-map", "redundancy");
  await person.press("*");
  await person.point("8");
  await person.press("0");
});
await picture("2_coordinates", {survey: {"materials.json": materials}}, async person => {
  await person.click("[data-menu=controlTable]");
  await person.page.fill("#pasted", control.split("\n").slice(0, 9).join("\n"));
  await person.sees("#take-over");
});
// Control points that are measured somewhere: others would be asked about.
const known = new Set(lines.map(line => line.split(",")[1]));
const measuredControl = control.trim().split("\n").filter((line, i) => i === 0 || known.has(line.split(",")[0])).join("\n");
const lacking = lines.filter(line => !/^(right|left),roof_4,|^right,block_/.test(line));
await picture("3_marks", {survey: {"materials.json": materials, "control_points.csv": `${measuredControl}\n`, "observations.csv": `${lacking.join("\n")}\n`}},
  async person => {
    await person.photo("left");
    await person.press("*");
    await person.point("roof_4");
    const [, , x, y] = lines.find(line => line.startsWith("left,roof_4,")).split(",").map(Number);
    await person.goTo(x, y);
    await person.press("2");
  });
await picture("4_polygons", {survey: all}, async person => {
  await person.press("Alt+2");
  await person.photo("left");
  await person.press("/"); // no loupe
  await person.click('#list tr[data-key="house_w"] button');
});
await picture("4_hole", {survey: all}, async person => {
  await person.press("Alt+2");
  await person.photo("right");
  await person.press("*", "/");
  await person.click('#list tr[data-key="block_w0"] button');
  await person.press("Shift+B");
  for (const [x, y] of [[660, 140], [740, 132], [742, 205], [660, 200]]) {
    await person.goTo(x, y);
    await person.press("Enter");
  }
  await person.press("Enter");
  await person.settled();
});
await picture("5_sun", {survey: all}, async person => {
  await person.press("Alt+3");
  await person.photo("left");
  await person.press("/");
  await person.sees("#directions");
});
await picture("6_light", {survey: all}, async (person, server) => {
  await lit(server);
  await person.press("Alt+4");
  await person.photo("right");
  await person.press("*", "/");
});
await picture("6_relit", {survey: all}, async (person, server) => {
  await lit(server);
  await person.press("Alt+4");
  await person.photo("right");
  await person.press("*", "/", "3");
  await person.sees('.pane[data-photo="right"] .relit', "exposed");
});
await picture("7_building", {survey: all, parts: ["calibration", "work/calibration", "work/building.json", "work/building.bin"]}, async person => {
  await person.press("Alt+2");
  await person.photo("left");
  await person.press("'", "/");
  await person.page.waitForSelector('.pane[data-photo="left"] path.building.corner', {state: "attached"});
});
await picture("7_montage", {survey: all, parts: ["calibration", "work", "montages"]}, async person => {
  await person.page.selectOption("#choose-photo", "right");
}, "insitu-view");
