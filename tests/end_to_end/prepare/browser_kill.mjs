// SPDX-License-Identifier: GPL-3.0-or-later
// browser_kill.mjs SITE PROFILE: browser and server are killed at once, while marks are set that no server has
// confirmed; when both are there again, every mark that the page had shown as kept comes in, once.
import fs from "node:fs";
import net from "node:net";
import {open} from "./page.mjs";
import {report, seeded, start, until} from "./server.mjs";

const [site, profile] = process.argv.slice(2);
const kRounds = 4;
const random = seeded(92);
/** The processes of a browser: those with its profile in their command line. */
const browserProcesses = () => fs.readdirSync("/proc").filter(name => /^\d+$/.test(name)).filter(name => {
  try {
    return fs.readFileSync(`/proc/${name}/cmdline`, "utf8").includes(`--user-data-dir=${profile}`);
  } catch {
    return false;
  }
}).map(Number);

let marks = 0;
/** Marks a new point; its name. */
async function placeOne(person) {
  const name = `unsent_${++marks}`;
  await person.point(name);
  await person.goTo(200 + 12 * marks, 200);
  await person.press("Shift+Enter");
  return name;
}

function killBoth(server) {
  for (const process_ of [...browserProcesses(), server.child.pid]) {
    try {
      process.kill(process_, "SIGKILL");
    } catch {} // gone with its parent
  }
}

const timesOf = async (server, name) => (await server.ask("GET", "/api/site")).body.tables.observations
  .filter(row => row.point === name).length;

let server = await start(site);
const {port} = server;
let lost = 0, twice = 0, shown = 0, placed = 0;
for (let round = 0; round < kRounds; ++round) {
  const person = await open(server, {profile});
  await person.photo("left");
  await person.settled();
  server.child.kill("SIGSTOP"); // it answers nothing, so that nothing is confirmed
  const names = [];
  for (let i = 0; i < 5; ++i) names.push(await placeOne(person));
  const shownAsKept = async () => Number((await person.data()).kept);
  // In the last round as soon as all are shown as kept, else at some moment.
  if (round === kRounds - 1) await until("all are shown as kept", async () => await shownAsKept() === names.length);
  else await new Promise(resolve => setTimeout(resolve, 30 * random()));
  const kept = await shownAsKept();
  killBoth(server);
  await until("both are gone", () => browserProcesses().length === 0 && server.child.signalCode !== null);
  server = await start(site);
  const again = await open(server, {profile});
  await again.settled();
  const times = await Promise.all(names.map(name => timesOf(server, name)));
  shown += kept;
  placed += names.length;
  lost += times.slice(0, kept).filter(n => n === 0).length;
  twice += times.filter(n => n > 1).length;
  if (round === kRounds - 1) report("all are shown as kept within a moment", kept === names.length, `${kept} of ${names.length}`);
  await again.browser.close();
}
report("after kill -9 of browser and server at once what was shown as kept comes in, once each",
  lost === 0 && twice === 0 && shown > 0, `${shown} of ${placed} marks shown as kept, ${lost} lost, ${twice} twice`);
report("the server comes back under its port, under which the browser keeps them", server.port === port, port);

// Without a server the page says so, and how many it keeps; a port that is taken is told.
const person = await open(server, {profile});
await person.photo("left");
await server.stop("SIGKILL");
await placeOne(person);
await person.sees(".banner.fail", "They are kept here");
report("without a server the page says what it keeps", (await person.data()).pending === "1", await person.page.textContent(".banner.fail span"));
const taker = net.createServer().listen(port, "127.0.0.1");
await new Promise(resolve => taker.once("listening", resolve));
server = await start(site);
report("a port that is taken is told, another one serves", server.port !== port && server.complained().includes(`port ${port}`), server.complained());
taker.close();
await person.browser.close();
await server.stop();
