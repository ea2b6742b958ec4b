// SPDX-License-Identifier: GPL-3.0-or-later
// bad_input.mjs SITE: what people do to a site while its page is open, or before.
import fs from "node:fs";
import {insert, report, start, until} from "./server.mjs";

const site = process.argv[2], survey = `${site}/survey`;
const marks = `${survey}/observations.csv`;
const mark = (point, x = 100) => ({photo: "left", point, x, y: 50, sigma: 0.5});
const tables = async server => (await server.ask("GET", "/api/site")).body;

let server = await start(site);
const second = await start(site).then(() => "", error => error.message);
report("a second server on the site is refused", /2: .*observes|2: .*insitu-prepare|ended with 2/.test(second), second.trim().slice(0, 160));

const off = await server.ask("POST", "/api/op", insert("off", "observations", mark("p", 1e4)));
report("a mark off its photograph is refused", off.status === 400, off.body.error);
const twice = await server.ask("POST", "/api/op", insert("twice", "observations", (await tables(server)).tables.observations[0]));
report("a mark twice is refused, the other one shown", twice.status === 409 && twice.body.conflicts[0].current.point !== undefined);
const control = name => ({name, x: 1, y: 2, z: 3, sigma_x: 1, sigma_y: 1, sigma_z: 1, role: "control"});
const bad = await server.ask("POST", "/api/op", insert("break", "control_points", control("a\nb")));
report("a name that the file cannot hold is refused", bad.status === 400, bad.body.error);
const comma = await server.ask("POST", "/api/op", insert("comma", "control_points", control("a,b")));
await until("it is in the file", () => fs.readFileSync(`${survey}/control_points.csv`, "utf8").includes('\n"a,b",'));
report("a name with a comma stands between quotes", comma.status === 200);

fs.writeFileSync(marks, `${fs.readFileSync(marks, "utf8").trimEnd()}\nleft,from_outside,12,34,0.5\n`);
await until("the outside change is seen", async () => (await tables(server)).tables.observations.some(row => row.point === "from_outside"));
report("what somebody else writes comes in", true);
await server.ask("POST", "/api/op", insert("here", "observations", mark("from_here")));
await until("both are in the file", () => /from_outside[^]*from_here|from_here[^]*from_outside/.test(fs.readFileSync(marks, "utf8")));
report("and stays when we write", true);
report("SIGTERM ends it well", (await server.stop()) === 0);

const polygons = fs.readFileSync(`${survey}/polygons.json`, "utf8");
fs.writeFileSync(`${survey}/polygons.json`, polygons.slice(0, polygons.length / 2));
server = await start(site);
const [cut] = (await tables(server)).read_only;
report("a file that was cut is read-only, its line told", cut?.file === "survey/polygons.json" && cut.line > 1, `${cut?.file}:${cut?.line}: ${cut?.text}`);
report("also in the terminal", server.complained().includes(`warning: survey/polygons.json:${cut.line}: `), server.complained());
const locked = await server.ask("POST", "/api/op", insert("cut", "polygons", {name: "n", vertices: ["a", "b", "c"], material: "m"}));
report("and not changed", locked.status === 400 && fs.readFileSync(`${survey}/polygons.json`, "utf8").length === Math.floor(polygons.length / 2), locked.body.error);
fs.writeFileSync(`${survey}/polygons.json`, polygons);
await until("the mended file is read", async () => (await tables(server)).read_only.length === 0);
report("when it is mended, it is read", true);
await server.stop();

fs.writeFileSync(`${site}/photos/broken.jpg`, "no photograph");
server = await start(site);
const broken = (await tables(server)).photos.find(photo => photo.name === "broken");
report("a photo that cannot be decoded is named, the others go on", Boolean(broken?.fault) && server.complained().includes(`warning: ${broken.fault}`), broken?.fault);
const tile = await server.ask("GET", "/api/tile?photo=0&level=0&x=0&y=0");
report("its tile is refused", tile.status === 400, tile.body.error);
await server.stop();
