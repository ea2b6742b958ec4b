// SPDX-License-Identifier: GPL-3.0-or-later
// watch.mjs SITE [SCREENSHOTS]: a render begun on the page, watched, stopped, gone on with, to the same
// bytes; one of another program that is killed.
import {createHash} from "node:crypto";
import {existsSync, readFileSync, readdirSync, rmSync} from "node:fs";
import {spawn, spawnSync} from "node:child_process";
import {once} from "node:events";
import {open} from "../prepare/page.mjs";
import {report, start, until as untilSoon} from "../prepare/server.mjs";

const [site, screenshots] = process.argv.slice(2);
const render = `${process.env.INSITU_BIN}/insitu-render`;
const montage = `${site}/montages/left.exr`, partial = `${site}/work/render/left.partial`;
const sums = () => readdirSync(`${site}/montages`).sort().map(name => createHash("sha256").update(readFileSync(`${site}/montages/${name}`)).digest("hex")).join();
spawnSync(render, [site, "--photo", "left"]);
const expected = sums();
rmSync(montage);

const server = await start(site, [], {}, "insitu-view");
const person = await open(server);
const {page} = person;
const shot = name => (screenshots ? page.screenshot({path: `${screenshots}/view_${name}.png`}) : undefined);
const photoNow = async () => (await server.ask("GET", "/api/site")).body.photos.find(one => one.name === "left");
const hatched = () => page.evaluate(() => {
  const canvas = document.getElementById("canvas");
  const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i] - data[i + 2] > 90 && data[i] > 130) ++count;
  return count / (data.length / 4);
});

/** A render takes its time where others compute too. */
async function until(what, is, instead) {
  for (let i = 0; i < 8; ++i) {
    try {
      return await untilSoon(what, is);
    } catch {}
  }
  return untilSoon(what, is, instead);
}

// Without tiles in the way: the whole picture in place.
await person.press("b", "b");
const begin = performance.now();
await person.press("r");
await until("the render is seen", async () => (await photoNow()).render.done > 0);
const first = performance.now() - begin;
await until("its tiles are on the page", async () => (await page.textContent(".label")).includes("hatched") && (await hatched()) > 0.05, hatched);
report("tiles appear while it runs, the others hatched", true, `first tile after ${(first / 1000).toFixed(1)} s`);
await person.press("r");
await until("it has stopped", async () => (await person.data()).ended === "3");
await person.sees("#say", "stopped; what is rendered is kept");
await person.drawn();
await until("the newest tiles", async () => (await hatched()) > 0.02, hatched);
await shot("unfinished");
const {render: waiting, pictures} = await photoNow();
report("stopped from the page it waits, and no montage is there", waiting.state === "waiting" && waiting.done > 0 && waiting.done < waiting.total && !existsSync(montage), `${waiting.done} of ${waiting.total} tiles`);
const unfinished = pictures.find(one => one.kind === "unfinished");
const corner = (await server.ask("GET", `/api/value?photo=${unfinished.id}&x=0&y=${unfinished.height - 1}`)).body;
report("an unfinished pixel has no value", corner.unfinished === true, JSON.stringify(corner));
await person.press("r");
await until("it has ended", async () => (await person.data()).ended === "0", () => person.data());
await until("the montage is shown", async () => !(await page.textContent(".label")).includes("hatched"));
report("gone on with from the page it comes to the same bytes", sums() === expected && !existsSync(partial));

// Another program's render, killed.
rmSync(montage);
const child = spawn(render, [site, "--photo", "left"]);
const ended = once(child, "exit");
await until("it is seen", async () => (await photoNow()).render.state === "running" && (await photoNow()).render.done > 20);
child.kill("SIGKILL");
await ended;
await until("it is told as stopped", async () => (await page.getAttribute('#renders [data-photo="left"]', "data-state")) === "waiting");
const kept = (await photoNow()).render.done;
await person.sees("#renders", "go on");
await page.focus('#renders [data-photo="left"] .run');
await person.press("Enter");
await until("it goes on where it was", async () => (await photoNow()).render.done >= kept);
await until("it has ended", async () => existsSync(montage) && !existsSync(partial));
report("another program's render, killed, is gone on with from the page", sums() === expected, `${kept} tiles were kept`);
report("nothing is wrong on the page", person.faults.length === 0, person.faults.join());
await person.browser.close();
await server.stop();
