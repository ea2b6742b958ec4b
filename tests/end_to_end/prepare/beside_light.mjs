// SPDX-License-Identifier: GPL-3.0-or-later
// beside_light.mjs SITE: marks are adjusted and shown while the light is still being measured, however long that
// takes; then the light of the last of them is told, and of none in between.
import {spawn} from "node:child_process";
import fs from "node:fs";
import {once} from "node:events";
import {dirname} from "node:path";
import {fileURLToPath} from "node:url";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const site = process.argv[2];
// Where the light's thread waits: nothing else reads what stands in front of a building.
const gate = `${site}/survey/foreground/left.png`;
fs.mkdirSync(dirname(gate));
const holder = spawn("/usr/bin/python3", [`${dirname(fileURLToPath(import.meta.url))}/held_file.py`, gate, "960", "640"],
  {stdio: ["pipe", "pipe", "inherit"]});
await once(holder.stdout, "data");

const server = await start(site);
const person = await open(server);
const {page} = person;
const lights = () => person.told.filter(one => one.type === "light").map(one => one.revision);
const move = async (point, x, y) => {
  await person.point(point);
  await person.goTo(x, y);
  await person.press("Shift+Enter");
  await person.settled();
  return Number((await person.data()).revision);
};
await person.settled();
await person.photo("left");
const marks = (await server.ask("GET", "/api/site")).body.tables.observations.filter(one => one.photo === "left").slice(0, 2);
let last = 0;
for (const {point, x, y} of marks) last = await move(point, (x + 0.2).toFixed(2), (y - 0.1).toFixed(2));
report("marks are adjusted while the light is being measured", last === 2 && lights().length === 0, `revision ${last}`);
await person.press("Alt+4");
await person.drawn();
report("the page says that the light is being measured", await page.isVisible("#light-about .soon"), await page.textContent("#light-about .soon"));
report("and takes no sample as left out for that", (await page.$$(".sample")).length > 0 && (await page.$$(".sample.off")).length === 0);

holder.stdin.end();
await until("the light of the last mark is told", () => lights().includes(last), async () => person.told.slice(-5));
await until("the page shows it", () => page.isHidden("#light-about .soon"));
report("then the light of the last mark is told, of none in between", lights().length === 2, lights().join(", "));
report("with its weights", (await page.$$("#light-about .weights tr")).length === 3);
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);
