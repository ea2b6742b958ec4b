// SPDX-License-Identifier: GPL-3.0-or-later
// everyone.mjs SITE PORTRAIT [SCREENSHOTS]: contrast, names and sizes of what is to be read and pressed (WCAG 2.2 AA),
// in both languages and on a narrow window; a finger and a pen on a photo; PORTRAIT, a folder with an upright one.
import {open} from "./page.mjs";
import {report, start, until} from "./server.mjs";

const [site, portrait, screenshots] = process.argv.slice(2);
let server = await start(site);

/** Faults of what is visible: text of too little contrast, controls that are too small, nameless or out of reach. */
const faults = page => page.evaluate(() => {
  const found = [];
  const parsed = colour => (colour.match(/[\d.]+/g) ?? []).map(Number);
  const luminance = rgb => rgb.slice(0, 3).map(v => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4))
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const isSeen = one => {
    const box = one.getBoundingClientRect(), style = getComputedStyle(one);
    return box.width > 0 && box.height > 0 && style.visibility === "visible" && style.opacity !== "0";
  };
  const top = document.querySelector("dialog[open]") ?? document.body;
  const name = one => one.getAttribute("aria-label") || one.textContent.trim() || one.title || one.placeholder ||
    one.labels?.[0]?.textContent || one.closest("label")?.textContent || "";
  /** The opaque colour behind an element; null over a photo. */
  const behind = one => {
    for (let at = one; at; at = at.parentElement) {
      if (at.matches("canvas, .stage")) return null;
      const colour = parsed(getComputedStyle(at).backgroundColor);
      if (colour.length === 3 || colour[3] > 0.99) return colour;
    }
    return [255, 255, 255];
  };
  for (const one of top.querySelectorAll("*")) {
    const text = [...one.childNodes].filter(node => node.nodeType === 3).map(node => node.textContent.trim()).join("");
    if (!text || !isSeen(one) || one.closest("svg, :disabled, option") || behind(one) === null) continue;
    const style = getComputedStyle(one), [a, b] = [luminance(parsed(style.color)), luminance(behind(one))].sort((x, y) => y - x);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < 4.5) found.push(`contrast ${contrast.toFixed(1)}: ${text.slice(0, 30)}`);
  }
  for (const one of top.querySelectorAll(".pane > header select")) {
    if (isSeen(one) && one.clientWidth < 60) found.push(`a photo's name cannot be read: ${one.clientWidth} px`);
  }
  for (const one of top.querySelectorAll("button, input, select, textarea, summary")) {
    if (!isSeen(one)) continue;
    const {width, height, left, right} = one.getBoundingClientRect();
    const isInline = one.type === "checkbox" || one.type === "radio";
    if ((width < 24 || height < 23.9) && !isInline) found.push(`${Math.round(width)}x${Math.round(height)}: ${name(one).slice(0, 30)}`);
    if (!name(one)) found.push(`nameless: ${one.outerHTML.slice(0, 80)}`);
    const scrolls = [...(function* () { for (let at = one.parentElement; at; at = at.parentElement) yield at; })()]
      .some(at => /auto|scroll/.test(getComputedStyle(at).overflowX) && at.scrollWidth > at.clientWidth);
    if ((left < -1 || right > innerWidth + 1) && !scrolls) found.push(`out of reach: ${name(one).slice(0, 30)}`);
  }
  return [...new Set(found)];
});

for (const [language, width, height] of [["en", 1400, 900], ["de", 1400, 900], ["de", 820, 700]]) {
  const person = await open(server, {size: {width, height}, prepared: page =>
    page.addInitScript(chosen => localStorage.setItem("insitu-language", chosen), language)});
  const {page} = person, where = `${language}, ${width} px wide`;
  const all = [];
  const look = async what => {
    await person.drawn();
    all.push(...(await faults(page)).map(fault => `${what}: ${fault}`));
    if (screenshots) await page.screenshot({path: `${screenshots}/everyone_${language}_${width}_${what}.png`});
  };
  await person.settled();
  for (const mode of ["1", "2", "3", "4", "5"]) {
    await person.press(`Alt+${mode}`);
    await look(`mode_${mode}`);
  }
  await person.press("Alt+1");
  for (const menu of ["controlTable", "constraints", "stages", "help", "site"]) {
    await page.click(`[data-menu=${menu}]`);
    await look(menu);
    await person.press("Escape");
  }
  report(`${where}: text has 4.5:1, what is pressed 24 px and a name, in reach`, all.length === 0, all.slice(0, 6).join(" | "));
  await person.browser.close();
}

// A finger chooses a place and moves the photo; only Confirm marks.
const person = await open(server, {touch: true});
const {page} = person;
await person.settled();
await person.photo("left");
await person.point("of_finger");
const marked = async () => (await server.ask("GET", "/api/site")).body.tables.observations.find(one => one.point === "of_finger");
await person.press("1");
await person.goTo(320, 210);
await person.drawn();
const at = await person.at("left", 330, 215);
await page.touchscreen.tap(at.x, at.y);
await person.drawn();
report("a finger's tap marks nothing", (await marked()) === undefined);
await page.tap("button.main:visible");
await person.settled();
const {x, y} = (await marked()) ?? {};
report("Confirm does, where the finger was", Math.hypot(x - 330, y - 215) < 1, `${x} ${y}`);
/** As a pen does. */
const pen = (type, place, buttons) => page.evaluate(([what, where, held]) => {
  document.querySelector('.pane[data-photo="left"] .stage').dispatchEvent(new PointerEvent(what,
    {bubbles: true, cancelable: true, pointerId: 7, pointerType: "pen", button: 0, buttons: held, clientX: where.x, clientY: where.y}));
}, [type, place, buttons]);
await person.point("of_pen");
await page.evaluate(() => {
  for (const stage of document.querySelectorAll(".stage")) stage.setPointerCapture = () => {};
});
const tip = await person.at("left", 345, 222);
await pen("pointerdown", tip, 1);
await pen("pointerup", tip, 0);
await person.settled();
const drawn = (await server.ask("GET", "/api/site")).body.tables.observations.find(one => one.point === "of_pen");
report("a pen's tip marks", drawn && Math.hypot(drawn.x - 345, drawn.y - 222) < 1, JSON.stringify(drawn));
report("the page runs without faults", person.faults.length === 0, person.faults[0] ?? "");
await person.browser.close();
await server.stop();

// A photo that stands upright in its file, and one that only its EXIF turns: pixels are the file's.
server = await start(portrait);
const upright = await open(server);
const {photos} = (await server.ask("GET", "/api/site")).body;
for (const {name, width, height} of photos) {
  await upright.photo(name);
  await upright.press("0");
  await upright.drawn();
  const inside = await upright.page.evaluate(([photo, w, h]) => {
    const pane = document.querySelector(`.pane[data-photo="${photo}"] .stage`), {a, d, e, f} = pane.querySelector(".figures").getScreenCTM();
    const box = pane.getBoundingClientRect();
    return a === d && e >= box.left - 1 && f >= box.top - 1 && e + a * w <= box.right + 1 && f + d * h <= box.bottom + 1 &&
      (a * w > 0.9 * box.width || d * h > 0.9 * box.height);
  }, [name, width, height]);
  report(`${name}, ${width} x ${height}, is shown whole`, inside);
  const value = (await server.ask("GET", `/api/value?photo=${photos.findIndex(one => one.name === name)}&x=2&y=${height - 3}`)).body.encoded;
  report("its lower left pixel is the file's", value[0] > 0.9 && value[2] < 0.1, value.map(one => one.toFixed(2)).join(" "));
}
if (screenshots) await upright.page.screenshot({path: `${screenshots}/portrait.png`});
report("the page runs without faults", upright.faults.length === 0, upright.faults[0] ?? "");
await upright.browser.close();
await server.stop();
