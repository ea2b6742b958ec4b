// SPDX-License-Identifier: GPL-3.0-or-later
// pipe.mjs: `insitu view -`, fed by hand: a picture of four tiles as it comes, the next one, and what is no
// stream.
import {open} from "../prepare/page.mjs";
import {report, start, until} from "../prepare/server.mjs";

const server = await start("-", [], {}, "insitu-view");
const write = text => new Promise(done => server.child.stdin.write(text, done));
const value = async (x, y) => (await server.ask("GET", `/api/value?photo=0&x=${x}&y=${y}`)).body;
/** Rows of a tile of one colour. */
const tile = (x, y, color) => `tile ${x} ${y} 32 32\n${`${Array(32).fill(color).join(" ")}\n`.repeat(32)}`;

await write(`insitu-stream 1\nimage a photo 64 64 tile 32\nphoto 1 1\n128 128 128\n${tile(0, 0, "255 0 0")}`);
const person = await open(server);
const {page} = person;
await until("the first tile", async () => (await value(3, 3)).encoded?.[0] === 1);
report("a tile is shown as it comes, what has not come is told", (await value(40, 3)).unfinished === true && (await value(3, 3)).encoded[1] === 0);
await person.sees(".label", "hatched");
await person.sees("#renders", "1 of 4 tiles");
report("nothing can be begun", (await page.locator("#renders .run").count()) === 0);
await write(`same 1 0\n${tile(0, 1, "0 0 255")}tile 1 1 32 32 base64\n${Buffer.alloc(3072, 255).toString("base64")}\nprogress 4 4\nend done\n`);
await until("it is done", async () => (await server.ask("GET", "/api/site")).body.photos[0].render.state === "none");
await person.sees(".label", "montage");
report("the finished picture holds all of it", (await value(40, 40)).encoded.join() === "1,1,1" && (await value(3, 40)).encoded[2] === 1);
await write("image next 32 32 tile 32\n");
await until("the next one", async () => (await person.data()).photo === "next");
report("the next picture takes its place", true);
await write("tile 0 0 1 1\n");
await person.sees("#banners", "is a tile of another size");
report("what is no stream is told by its line", true, await page.textContent("#banners"));
report("nothing is wrong on the page", person.faults.length === 0, person.faults.join());
await person.browser.close();
report("it ends in order though its input does not", (await server.stop("SIGINT")) === 0);
