// SPDX-License-Identifier: GPL-3.0-or-later
// german.mjs SITE [SCREENSHOTS]: the page in German: what the survey's diagnosis, the to-do list, dialogs, refusals
// and readers of files say, and that no English sentence is left on it.
import fs from "node:fs";
import {open} from "./page.mjs";
import {report, start} from "./server.mjs";

const [site, screenshots] = process.argv.slice(2);
const marks = `${site}/survey/observations.csv`;
const kEnglish = /\b(the|is|are|of|and|with|from|not|this|needs?|has|have|its|cannot|without|expected)\b/;
const server = await start(site);
const person = await open(server, {size: {width: 1400, height: 900}, prepared: page =>
  page.addInitScript(() => localStorage.setItem("insitu-language", "de"))});
const {page} = person;
/** Lines of the page, titles and labels that are English, but for what programs print. */
const english = () => page.evaluate(source => {
  const said = [...document.querySelectorAll("[title], [aria-label], [placeholder]")]
    .flatMap(one => ["title", "aria-label", "placeholder"].map(name => one.getAttribute(name) ?? ""));
  const log = document.querySelector("#stage-log")?.textContent ?? "";
  const lines = [...document.body.innerText.split("\n"), ...said].filter(line => line && !log.includes(line));
  return [...new Set(lines)].filter(line => new RegExp(source).test(line));
}, kEnglish.source);
const shot = async name => {
  await person.drawn();
  if (screenshots) await page.screenshot({path: `${screenshots}/german_${name}.png`});
};
const isGerman = async where => {
  await person.drawn();
  const found = await english();
  report(`no English in ${where}`, found.length === 0, found.slice(0, 3).join(" | "));
};

await person.settled();
for (const [key, name] of [["1", "control"], ["2", "polygons"], ["3", "sun"], ["4", "light"], ["5", "film"]]) {
  await person.press(`Alt+${key}`);
  await isGerman(`mode ${name}`);
  await shot(`mode_${name}`);
}
await person.press("Alt+1");
for (const list of ["points", "photos", "polygons", "pairs", "samples"]) {
  await page.click(`[data-list=${list}]`);
  await isGerman(`the list of ${list}`);
}
for (const menu of ["controlTable", "constraints", "stages", "help", "site", "measure"]) {
  await page.click(`[data-menu=${menu}]`);
  await isGerman(`the dialog ${menu}`);
  await shot(`dialog_${menu}`);
  if (menu === "measure" || menu === "constraints") await page.click(".floating .buttons button:last-child");
  else await person.press("Escape");
}

// Two names exchanged, as people do.
const whole = fs.readFileSync(marks, "utf8");
const names = [...new Set(fs.readFileSync(`${site}/survey/control_points.csv`, "utf8").trim().split("\n").slice(1).map(line => line.split(",")[0]))]
  .filter(name => whole.includes(`,${name},`));
const [one, other] = names;
fs.writeFileSync(marks, whole.replace(new RegExp(`,${one},`, "g"), ",\u0000,").replace(new RegExp(`,${other},`, "g"), `,${one},`)
  .replaceAll("\u0000", other));
await person.sees("#todo", "vertauscht");
const told = (await page.textContent("#todo")).match(/[^.]*vertauscht[^.]*/)[0];
report("the diagnosis of exchanged names is said in German", told.includes("die Punkte «") && told.includes(one) && told.includes(other), told.slice(0, 160));
await isGerman("the diagnosis");
await shot("diagnosis");
fs.writeFileSync(marks, whole);
await page.waitForFunction(() => !document.querySelector("#todo").textContent.includes("vertauscht"));

// What is refused or cannot be saved.
fs.writeFileSync(marks, "photo,point,x,y,sigma\nleft,tower_0,abc,2,0.5\n");
await person.sees(".banner", "nötig ist eine endliche Zahl");
report("a line that does not parse is told in German", true, await page.textContent(".banner span"));
await shot("does_not_parse");
fs.writeFileSync(marks, whole);
await page.waitForSelector(".banner", {state: "detached"});
const outlines = `${site}/survey/polygons.json`, drawn = fs.readFileSync(outlines, "utf8");
for (const [change, said] of [[/"material"\s*:\s*"[^"]*"/, "«material» fehlt"], [/"photo"\s*:\s*"[^"]*"/, "ist nicht im Ordner photos"]]) {
  fs.writeFileSync(outlines, drawn.replace(change, said.includes("photos") ? '"photo": "lefft"' : '"comment": ""'));
  await person.sees("#todo", said);
  await isGerman(`a file that takes no part: ${said}`);
}
fs.writeFileSync(outlines, drawn);
await page.waitForFunction(() => !document.querySelector("#todo").textContent.includes("ist nicht im Ordner"));
const mark = {photo: "left", point: "p", x: 1, y: 1, sigma: 0.5};
for (const [table, row, said] of [
  ["observations", {...mark, photo: "lefft"}, "observations: das Foto «lefft» ist nicht im Ordner photos; ist «left» gemeint?"],
  ["observations", {...mark, sigma: 0}, "observations: sigma ist nicht grösser als 0"],
  ["observations", {...mark, point: "tie_000001"}, "heisst wie ein Verknüpfungspunkt"],
  ["control_points", {name: "P", x: 1, y: 2, z: 3, sigma_x: 1, sigma_y: 1, sigma_z: 1, role: "x"}, "nötig ist control oder check"],
  ["polygons", {name: "p", vertices: ["a", "b"], material: "m", photo: null, mask: null}, "hat 2 Eckpunkte, davon 2 verschiedene"],
  ["constraints", {kind: "vertical", points: ["a"], sigma_deg: 1}, "nennt 1 Punkte oder Polygone, nötig sind 2 Punkte oder 1 Polygone"],
]) {
  const answer = await page.evaluate(async operation => {
    const {post} = await import("/page/site/api.js"), {said: worded} = await import("/page/words/words.js");
    const {status, body} = await post("/api/op", operation);
    return {status, text: worded(body, "error")};
  }, {id: `${table} ${said}`, label: "refused", edits: [{table, before: null, after: row}]});
  report(`a row is refused in German: ${said}`, answer.status === 400 && answer.text.includes(said) && !kEnglish.test(answer.text), answer.text);
}
fs.chmodSync(marks, 0o444);
await person.photo("left");
await person.point("neu");
await person.goTo(300, 200);
await person.press("Shift+Enter");
await person.sees(".banner.fail", "schreibgeschützt");
await isGerman("what is not saved");
await shot("not_saved");
fs.chmodSync(marks, 0o644);
await person.settled();
await page.waitForSelector(".banner.fail", {state: "detached"});
await person.press("Control+Z");
await person.settled();
await page.click("[data-menu=controlTable]");
await page.fill("#pasted", "name x y z\nneu_1 1 2 3\n");
await person.sees("#import-found", "kein σ angegeben");
await isGerman("what is pasted");
await person.press("Escape");
await page.click("[data-menu=controlTable]");
await page.fill("#pasted", "name;x;y;z\nneu_1;1,5;2,25;3\n");
await person.sees("#import-found", "1.5");
report("decimal commas are taken", (await page.textContent("#import-found")).includes("2.25"));
for (const [text, said] of [
  ["nichts davon\n", "hat kein bekanntes Format"],
  ["name;x;y;z\nneu_1;abc;2;3\n", "«abc» für x, nötig ist eine endliche Zahl"],
  ["name;x [mm];y [mm];z [mm]\nneu_1;1500;2250;3000\n", "umgerechnet in Meter oder Grad"],
  ["name;x [ft];y [ft];z [ft]\nneu_1;1;2;3\n", "ist in Fuss, von denen es zwei gibt"],
  ["name;y;x;z\nneu_1;1;2;3\n", "steht vor \"x\""],
  ["name;x [px];y;z\nneu_1;1;2;3\n", "nötig ist eine Länge"],
  ["name;x;irgendwas;z\nneu_1;1;2;3\n", "keine Spalte ist Nord (y)"],
  ["<document><chunk><markers><marker id='0' label='a'><reference x='1' y='zwei' z='3'/></marker></markers></chunk></document>",
    "<reference>: y=«zwei», nötig ist eine endliche Zahl"],
  ["<DicoAppuisFlottant><OneAppuisDAF><Pt>1 2</Pt><NamePt>a</NamePt></OneAppuisDAF></DicoAppuisFlottant>", "2 Zahlen, nötig sind 3"],
  ["<DicoAppuisFlottant><OneAppuisDAF>", "kein gültiges XML"],
  ['<document dbat_script_version="1"><input><cameras><file>c.xml</file></cameras></input></document>', "gibt es nicht"],
  ["1 2 0.1 0.2 0.01 0.01 0 0 1 1 0\n", "brauchen die Kamera daneben"],
]) {
  await page.fill("#pasted", text);
  await person.sees("#import-found", said);
  await isGerman(`what is pasted: ${said}`);
}
await person.press("Escape");

// Film beside another camera.
await person.press("Alt+5");
await page.click("#certificate");
await page.fill("#film-focal", "56,5");
await person.press("Tab");
await person.sees(".banner.fail", "gehört zu einer anderen Kamera");
await person.press("Escape");
await isGerman("what is refused");
report("what is refused is told in German", true, await page.textContent(".banner.fail span"));
await shot("film");
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
report("SIGTERM ends it well", (await server.stop()) === 0);

// A photo that is cut short, whose size is known all the same.
const photo = fs.readFileSync(`${site}/photos/left.jpg`);
fs.writeFileSync(`${site}/photos/left.jpg`, photo.subarray(0, photo.length / 2));
fs.rmSync(`${site}/work/prepare/overviews`, {recursive: true, force: true});
const again = await start(site);
const beside = await open(again, {prepared: made => made.addInitScript(() => localStorage.setItem("insitu-language", "de"))});
await beside.photo("left");
await beside.sees('.pane[data-photo="left"] .note.fault', "ist abgeschnitten; nötig ist ein ganzes Foto");
report("a photo that is cut short is told in its pane", true, await beside.page.textContent('.pane[data-photo="left"] .note'));
await beside.browser.close();
await again.stop();
