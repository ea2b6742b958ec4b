// SPDX-License-Identifier: GPL-3.0-or-later
// files.mjs SITE: one change of each kind on the page; all undone, the files are the bytes they were, all
// redone, those they became.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start} from "./server.mjs";

const site = process.argv[2];
const files = () => Object.fromEntries(["site.json", ...fs.readdirSync(`${site}/survey`).sort().map(name => `survey/${name}`)]
  .map(name => [name, fs.readFileSync(`${site}/${name}`, "utf8")]));
const differing = (a, b) => [...new Set([...Object.keys(a), ...Object.keys(b)])].filter(name => a[name] !== b[name]);

const server = await start(site);
const person = await open(server);
const before = files();
const history = async () => (await server.ask("GET", "/api/site")).body.history;

await person.photo("left");
await person.point("new_mark");
await person.goTo(660, 336);
await person.press("Shift+Enter");
await person.photo("middle");
await person.goTo(704, 326);
await person.press("Shift+Enter");
await person.photo("left");
await person.point("tower_0");
await person.press("ArrowLeft", "Shift+ArrowUp", "x");
await person.point("tower_1");
await person.press("d");
await person.point("roof_6");
await person.press("Delete");
await person.press("b");
for (const name of ["tower_0", "tower_1", "tower_5", "tower_4"]) await person.point(name);
await person.press("Enter");
await person.press("s");
for (const name of ["lamp_4", "lamp_0"]) await person.point(name);
await person.press("Escape", "v");
for (const name of ["house_0", "house_4"]) await person.point(name);
await person.press("Escape", "k");
for (const name of ["tower_0", "tower_1"]) await person.point(name);
await person.goTo(120, 352);
await person.press("Enter", "Escape", "h");
await person.goTo(480, 20);
await person.press("Enter", "Escape");
await person.page.fill("#card", "0.3 0.31 0.32");
await person.press("Enter");
await person.click("[data-menu=controlTable]");
await person.page.fill('[aria-label="tower_0 z"]', "431.5");
await person.page.press('[aria-label="tower_0 z"]', "Tab");
await person.press("Escape");
await person.settled();
const after = files();
const changed = differing(before, after);
report("a change of each kind is in the files", changed.length >= 5, changed.join(", "));

let steps = 0;
for (; (await history()).undo !== null && steps < 100; ++steps) await server.ask("POST", "/api/undo", {id: `undo-${steps}`});
await person.settled();
report("all undone, the files are the bytes they were", differing(before, files()).length === 0,
  differing(before, files()).join(", ") || `${steps} steps`);
let again = 0;
for (; (await history()).redo !== null && again < 100; ++again) await server.ask("POST", "/api/redo", {id: `redo-${again}`});
await person.settled();
report("all redone, those they became", again === steps && differing(after, files()).length === 0, differing(after, files()).join(", "));
report("the page shows them", (await person.page.locator('.marks [data-point="new_mark"]').count()) > 0 && person.faults.length === 0,
  person.faults[0] ?? "");

// A file of an older Windows program, and one of a spreadsheet that says "Unicode text".
const take = async bytes => {
  await person.click("[data-menu=controlTable]");
  await person.page.setInputFiles("#import-file", {name: "points.txt", mimeType: "text/plain", buffer: Buffer.from(bytes)});
  await person.click("#take-over");
  await person.press("Escape");
  await person.settled();
};
await take(Buffer.from("name;x;y;z\nT\u00fcrm;2600371,5;1200130;431\n", "latin1"));
await take(Buffer.from("\ufeffname\tx\ty\tz\nZ\u00fcrich\t2600380\t1200140\t432\n", "utf16le"));
const points = fs.readFileSync(`${site}/survey/control_points.csv`, "utf8");
report("points of a file are taken, whatever its letters", points.includes("T\u00fcrm,2600371.5,1200130,431,") && points.includes("Z\u00fcrich,2600380,1200140,432,"),
  points.trim().split("\n").slice(-2).join(" | "));
await person.browser.close();
await server.stop();
