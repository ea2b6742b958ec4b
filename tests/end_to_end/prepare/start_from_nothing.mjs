// SPDX-License-Identifier: GPL-3.0-or-later
// start_from_nothing.mjs FOLDER SITE: FOLDER holds nothing but photographs; of SITE one is replaced by another size.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const [folder, site, small] = process.argv.slice(2);
let server = await start(folder);
let person = await open(server);
const told = await until("the page says what is missing", async () => (await server.ask("GET", "/api/site")).body.todo?.[0]);
report("a folder of photographs becomes a site", fs.readdirSync(`${folder}/photos`).length === 3, told.text);
await person.sees("#todo", told.text);
report("its page says what to do first", true);
await person.photo("left");
await person.point("first");
await person.goTo(100, 100);
await person.press("Shift+Enter");
await person.sees("#saved", "");
await until("it is in the files", () => fs.existsSync(`${folder}/survey/observations.csv`));
const [header, line] = fs.readFileSync(`${folder}/survey/observations.csv`, "utf8").trim().split("\n");
report("the first mark makes the file", /^photo,point,x,y,sigma/.test(header) && line.startsWith("left,first,100,100,"), line);
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);

fs.copyFileSync(small, `${site}/photos/right.jpg`);
server = await start(site);
person = await open(server);
await until("it is adjusted", async () => (await server.ask("GET", "/api/site")).body.adjusted);
const {adjusted, todo} = (await server.ask("GET", "/api/site")).body;
const about = adjusted.photos?.right, said = JSON.stringify([adjusted.failed, about, adjusted.left_out?.filter(one => one.name === "right"), todo.map(one => one.text)]);
report("a photo of another size than its camera's is named", about?.oriented !== true && /480|320|size|pixels/.test(said),
  about?.why ?? adjusted.failed ?? said.slice(0, 200));
report("the others are oriented", adjusted.photos?.left?.oriented === true && adjusted.photos?.middle?.oriented === true);
await person.browser.close();
await server.stop();
