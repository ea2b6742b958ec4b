// SPDX-License-Identifier: GPL-3.0-or-later
// polygons.mjs SITE [SCREENSHOTS]: a polygon renamed and given a hole by keyboard; a point with one mark,
// predicted from the plane it stands on, in the band of its epipolar curve. The mark stays in SITE.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const [site, screenshots] = process.argv.slice(2);
fs.writeFileSync(`${site}/survey/constraints.json`,
  JSON.stringify({constraints: [{kind: "vertical", polygons: ["sup10_w0"], sigma_deg: 0.5}]}));
const server = await start(site);
const person = await open(server);
const tables = async () => (await server.ask("GET", "/api/site")).body.tables;
const adjusted = async () => {
  await person.settled();
  return (await server.ask("GET", "/api/site")).body.adjusted;
};
const polygon = async name => (await tables()).polygons.find(one => one.name === name);
const shot = async name => {
  await person.drawn();
  if (screenshots) await person.page.screenshot({path: `${screenshots}/${name}.png`});
};
/** Whether nothing in the panel of what is to be done is cut off; how many are left out. */
const todoCut = () => person.page.evaluate(() => {
  const root = document.querySelector("#todo"), bottom = root.getBoundingClientRect().bottom;
  const seen = [...root.querySelectorAll("li, button")].filter(one => one.getClientRects().length > 0);
  return {cut: seen.some(one => one.getBoundingClientRect().bottom > bottom), all: root.querySelectorAll("li").length,
    shown: seen.filter(one => one.tagName === "LI").length, more: root.querySelector(".more")?.textContent};
});
const choose = name => person.click(`#list tr[data-key="${name}"] button`);
await person.settled();
await shot("to_do");

await person.press("Alt+2");
await choose("sup10_w0");
const named = one => one.polygon === "sup10_w0" || one.polygons?.includes("sup10_w0");
const before = Object.values(await tables()).flat().filter(named).length;
await person.press("F2");
await person.enter("pillar");
await person.settled();
const after = Object.values(await tables()).flat();
const moved = after.filter(one => one.polygon === "pillar" || one.polygons?.includes("pillar")).length;
report("F2 renames a polygon by keyboard, with the samples and constraints that name it",
  (await polygon("pillar")) && before > 2 && moved === before && !after.some(named), `${moved} of ${before}`);
report("and the photo has the focus again", await person.page.evaluate(() => Boolean(document.activeElement?.closest(".stage"))));

const area = async () => (await adjusted()).polygons.block_w0?.area_m2;
const pieces = () => person.page.evaluate(() =>
  document.querySelector('.pane[data-photo="right"] path[data-polygon="block_w0"]')?.getAttribute("d")?.split("M").length - 1);
await person.photo("right");
await choose("block_w0");
const whole = await area(), outline = await pieces();
await person.press("Shift+B");
for (const [x, y] of [[660, 140], [740, 132], [770, 170], [742, 205], [660, 200]]) {
  await person.goTo(x, y);
  await person.press("Enter");
  if (x === 770) await person.press("Backspace");
}
await shot("hole_drawn");
await until("its points are to be done", async () => (await todoCut()).all > 4);
await person.drawn();
const todo = await todoCut();
report("what is to be done is shown in whole things, the others are counted", !todo.cut && todo.more === `${todo.all - todo.shown} more`, JSON.stringify(todo));
await person.press("Enter");
const pierced = await area(), {holes} = await polygon("block_w0");
report("Shift+B draws a hole, vertex by vertex, Backspace takes one back", holes?.length === 1 && holes[0].length === 4, JSON.stringify(holes));
report("its area is taken from the polygon's", whole - pierced > 0.1 * whole && pierced > 0.3 * whole, `${whole} m², then ${pierced} m²`);
report("its outline is drawn with the polygon", (await pieces()) > outline, `${await pieces()} pieces, ${outline} before`);
await shot("hole");
report("the panel lists it", (await person.page.textContent("#holes"))?.includes(holes[0].join(" ")));
const file = JSON.parse(fs.readFileSync(`${site}/survey/polygons.json`, "utf8"));
report("it is in polygons.json", JSON.stringify(file.polygons.find(one => one.name === "block_w0").holes) === JSON.stringify(holes));
await person.press("Control+Z");
await person.settled();
report("undo takes it away", !(await polygon("block_w0")).holes && Math.abs((await area()) - whole) < 1e-6);
await person.press("Control+Y");
await person.settled();
await person.goTo(700, 170);
await person.press("Shift+X");
await person.settled();
report("Shift+X removes it", !(await polygon("block_w0")).holes);
await person.press("Control+Z");
await person.settled();
report("and undo brings it back", (await polygon("block_w0")).holes?.length === 1);
await person.press("Shift+B");
await person.point((await polygon("block_w0")).vertices[0]);
await person.drawn();
report("a vertex of the outline is none of a hole", (await person.page.textContent("#say"))?.length > 0 &&
  !(await person.page.textContent("#tool .hint"))?.includes((await polygon("block_w0")).vertices[0]));
for (const x of [680, 720]) {
  await person.goTo(x, 222);
  await person.press("Enter");
}
await person.press("Escape");
await person.settled();
const draft = (await tables()).drafts.find(one => one.hole_of === "block_w0");
report("a hole left unfinished is kept as a draft", draft?.vertices.length === 2, JSON.stringify(draft));
await person.click("#drafts button");
await person.sees("#tool .hint", draft.vertices.join(", "));
report("and taken up again", true);
await person.press("Backspace", "Backspace", "Escape");

// A place on the chosen polygon's edge: the one that is nearest to the crosshair.
await person.click('#list tr[data-key="block_w0"] button');
await person.photo("right");
const seen = (await tables()).observations.filter(one => one.photo === "right");
const ends = (await polygon("block_w0")).vertices.slice(0, 2).map(name => seen.find(one => one.point === name));
await person.goTo(((ends[0].x + ends[1].x) / 2).toFixed(2), ((ends[0].y + ends[1].y) / 2).toFixed(2));
await person.press("k");
await person.sees("#tool .hint", `${ends[0].point}–${ends[1].point}`);
await person.press("Enter", "Escape");
await person.settled();
const [edge] = (await tables()).edges;
report("K marks a place on the polygon's edge at the crosshair", edge?.from === ends[0].point && edge?.to === ends[1].point && edge?.photo === "right", JSON.stringify(edge));
report("in the mode in which polygons are drawn, which shows it", (await person.data()).mode === "polygons" && (await person.page.$$('.pane[data-photo="right"] .edge.line')).length > 0);

// Materials of the library: what a photograph does not tell.
const material = async name => (await tables()).materials.find(one => one.name === name);
await person.click('#list tr[data-key="block_w0"] button');
const wasOf = (await polygon("block_w0")).material;
await person.photo("right");
await person.press("t");
await person.enter("water");
await person.settled();
report("a material named as in the library is its entry", (await polygon("block_w0")).material === "water" && (await material("water"))?.use === "water",
  JSON.stringify(await material("water")));
await person.page.waitForFunction(() => document.querySelector("#surface-swatch.mirrors"));
report("its swatch says that it mirrors", true, await person.page.getAttribute("#surface-swatch", "title"));
await person.page.selectOption("#surface", "stone_polished_dark");
await person.settled();
report("another entry is chosen from the list", (await material("water")).use === "stone_polished_dark");
await shot("surface");
await person.page.focus('.pane[data-photo="right"] .stage');
await person.press("Control+Z", "Control+Z");
await person.settled();
report("undo takes both away", (await polygon("block_w0")).material === wasOf && !(await material("water")));
await person.press("Alt+4");
await person.click("#card");
await person.enter("brick_red");
await person.settled();
const [light] = (await tables()).light;
report("daylight samples may be of a material of the library", light.daylight_material === "brick_red" && !light.daylight_reflectance_rgb, JSON.stringify(light));
await person.page.focus('.pane[data-photo="right"] .stage');
await person.press("Control+Z");
await person.settled();

await person.press("Alt+1");
await person.point("lone");
await person.goTo(640, 215);
await person.press("Shift+Enter");
const {points, left_out: leftOut} = await adjusted();
report("a point of one mark is predicted where it stands on a plane", points.lone?.plane === "block_w0" && points.lone.images.middle?.major > 0,
  `${points.lone?.plane}, ± ${points.lone?.images?.middle?.major} px`);
report("and still left out", leftOut.some(one => one.name === "lone"));
await person.point("lone");
await person.sees("#marks-of-point .plane", "block_w0");
report("its panel says on which", true);
await person.photo("middle");
await until("the band is drawn", () => person.page.$('.pane[data-photo="middle"] .band:not(.casing)'));
report("the epipolar curve lies in its band", true);
report("its place is shown on the other photo", Boolean(await person.page.$('.pane[data-photo="middle"] .prediction.current')));
await person.press("2", "+", "+", "c");
await shot("band");

await person.click("[data-menu=controlTable]");
await person.page.fill("#pasted", "name,x,y,z\nQ1,2600001,1200001,430\n");
await person.sees("#take-over");
report("a pasted table of new points speaks of no others", !/would be changed/.test((await person.page.textContent("dialog")) ?? ""));
await person.press("Escape");
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
