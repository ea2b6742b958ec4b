// SPDX-License-Identifier: GPL-3.0-or-later
// browser_kill.mjs SITE PROFILE: the server dies, marks go on being set, the browser is killed; when both are
// there again the marks come in, once each.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const [site, profile] = process.argv.slice(2);
/** The processes of a browser: those with its profile in their command line. */
const browserProcesses = () => fs.readdirSync("/proc").filter(name => /^\d+$/.test(name)).filter(name => {
  try {
    return fs.readFileSync(`/proc/${name}/cmdline`, "utf8").includes(`--user-data-dir=${profile}`);
  } catch {
    return false;
  }
}).map(Number);

let server = await start(site);
const port = ["--port", `${server.port}`];
let person = await open(server, {profile});
await person.photo("left");
await server.stop("SIGKILL");
const names = Array.from({length: 5}, (_, i) => `unsent_${i}`);
for (const [i, name] of names.entries()) {
  await person.point(name);
  await person.goTo(300 + 20 * i, 200);
  await person.press("Shift+Enter");
}
await person.sees(".banner.fail", "5");
report("without a server the page says so and keeps marks", (await person.data()).pending === "5", await person.page.textContent(".banner.fail span"));
// Chromium writes what pages store in its own time, at first within seconds, later once a minute.
const store = `${profile}/Default/Local Storage/leveldb`;
const storedText = () => fs.readdirSync(store).map(name => fs.readFileSync(`${store}/${name}`, "latin1")).join("");
const stored = () => names.filter(name => storedText().includes(`"${name}"`));
await until("the browser has stored some", () => stored().length > 0);
for (const process_ of browserProcesses()) {
  try {
    process.kill(process_, "SIGKILL");
  } catch {} // gone with its parent
}
const kept = stored();
server = await start(site, port);
person = await open(server, {profile});
await person.settled();
const found = (await server.ask("GET", "/api/site")).body.tables.observations.map(row => row.point);
const times = name => found.filter(one => one === name).length;
report("after kill -9 of the browser too what it had stored comes in, once each",
  kept.every(name => times(name) === 1) && names.every(name => times(name) <= 1), `${kept.length} of ${names.length} marks`);
await person.browser.close();
await server.stop();
