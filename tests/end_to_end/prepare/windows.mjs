// SPDX-License-Identifier: GPL-3.0-or-later
// windows.mjs SITE: two people on one site, and a third who edits its files by hand.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const site = process.argv[2], marks = `${site}/survey/observations.csv`;
const server = await start(site);
const anna = await open(server), ben = await open(server, {browser: anna.browser});
const row = async (photo, point) =>
  (await server.ask("GET", "/api/site")).body.tables.observations.find(one => one.photo === photo && one.point === point);
const onPage = (person, point) => person.page.waitForSelector(`.marks [data-point="${point}"][data-photo="left"]`, {state: "attached"});
const mark = async (person, point, x, y) => {
  await person.photo("left");
  await person.point(point);
  await person.goTo(x, y);
  await person.press("Shift+Enter");
};

await mark(anna, "of_anna", 300, 200);
await onPage(ben, "of_anna");
report("a mark in one window appears in the other", true);
await ben.press("Control+Z");
await anna.page.waitForSelector('.marks [data-point="of_anna"][data-photo="left"]', {state: "detached"});
report("so does its undo", true);

const cara = await open(server, {browser: anna.browser, prepared: page => page.addInitScript(() => {
  delete globalThis.WebSocket;
})});
await mark(anna, "for_cara", 320, 220);
await onPage(cara, "for_cara");
report("also in a browser without WebSocket", cara.faults.length === 0, cara.faults[0] ?? "");
await cara.page.close();

/** Ben moves a mark while his operations are held up, Anna moves the same one meanwhile. */
async function collide(point, [x, y], [u, v]) {
  let release = () => {};
  const held = new Promise(resolve => (release = resolve));
  await ben.page.route("**/api/op", async route => {
    await held;
    await route.continue();
  });
  await mark(ben, point, x, y);
  await mark(anna, point, u, v);
  await anna.settled();
  release();
  await ben.sees(".banner.conflict", point);
  await ben.page.unroute("**/api/op");
}
await collide("tower_0", [80, 350], [90, 360]);
const banner = await ben.page.textContent(".banner.conflict");
report("a conflict shows both versions", /90/.test(banner) && /80/.test(banner));
await ben.page.click(".banner.conflict button >> nth=0");
await ben.page.waitForSelector(".banner.conflict", {state: "detached"});
report("theirs is kept", (await row("left", "tower_0")).x === 90);
await collide("tower_1", [150, 350], [160, 360]);
await ben.page.click(".banner.conflict button >> nth=1");
await ben.settled();
report("or mine taken", (await row("left", "tower_1")).x === 150, JSON.stringify(await row("left", "tower_1")));

fs.writeFileSync(marks, `${fs.readFileSync(marks, "utf8").trimEnd()}\nleft,by_hand,400,300,0.5\n`);
await Promise.all([onPage(anna, "by_hand"), onPage(ben, "by_hand")]);
report("what an editor writes into the file appears in both", true);
fs.writeFileSync(marks, fs.readFileSync(marks, "utf8").replace("left,by_hand,400,", "left,by_hand,410,"));
await until("it moves", async () => (await row("left", "by_hand"))?.x === 410);
report("and what is changed there", true);
const whole = fs.readFileSync(marks, "utf8");
fs.writeFileSync(marks, "photo,point,x,y,sigma\nleft,tower_0,1,2\n");
await anna.sees(".banner", "survey/observations.csv:2");
report("a line that does not parse is told on the page", true, (await anna.page.textContent(".banner")).slice(0, 140));
const told = await until("the to-do list", async () => {
  const {todo: [first]} = (await server.ask("GET", "/api/site")).body;
  return first.text.includes("observations.csv:2") && first.text;
});
report("and is the first thing to do", true, told);
fs.writeFileSync(marks, whole);
await anna.page.waitForSelector(".banner", {state: "detached"});
report("mended, it is read again", (await row("left", "by_hand"))?.x === 410);
await anna.photo("right");
await anna.press("*"); // to the large pane, where its tiles are others
const isShown = () => anna.page.evaluate(() => {
  const canvas = document.querySelector('.pane[data-photo="right"] canvas');
  const [red, green, blue] = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data;
  return red + green + blue > 3 * 0x1c;
});
report("a photo that is enlarged after that is shown", await until("the photo", isShown));
report("the pages run without faults", anna.faults.length + ben.faults.length === 0, [...anna.faults, ...ben.faults][0] ?? "");
await anna.browser.close();
await server.stop();
