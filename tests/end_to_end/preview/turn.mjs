// SPDX-License-Identifier: GPL-3.0-or-later
// turn.mjs PAGE [SCREENSHOT]: the page on which a building is turned: layers, search, measuring, backs, open edges. Its
// building: 30 green boxes of 1 m in a row along x, 2 m apart, "Box 0" ... "Box 29", of the last only the face to the south.
import {createRequire} from "node:module";
import {report, until} from "../prepare/server.mjs";

const {chromium} = createRequire(import.meta.url)(process.env.PLAYWRIGHT);
const [file, screenshot] = process.argv.slice(2);
const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"]});
const page = await browser.newPage({viewport: {width: 1200, height: 900}});
const faults = [];
page.on("pageerror", error => faults.push(error.message));
await page.goto(`file://${file}`);

/** Pixels of the canvas that are as asked for. */
const count = async isOne => {
  const png = (await page.locator("#turn").screenshot()).toString("base64");
  return page.evaluate(async ([data, test]) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const codes = context.getImageData(0, 0, image.width, image.height).data;
    const is = new Function("r", "g", "b", `return ${test}`);
    let found = 0;
    for (let i = 0; i < codes.length; i += 4) found += is(codes[i], codes[i + 1], codes[i + 2]) ? 1 : 0;
    return found;
  }, [png, isOne]);
};
const kBuilding = "g > r + 25 && g > b + 25";
const kRed = "r > 150 && g < 60 && b < 60", kMagenta = "r > 100 && g < 60 && b > 70";
const labels = () => page.locator("#turn-layers label").allTextContents();
const allBox = () => page.locator("#turn-all").evaluate(box => [box.checked, box.indeterminate].join());
const told = () => page.textContent("#turn-told");

const whole = await count(kBuilding);
report("the building is drawn", whole > 2000, `${whole} pixels`);
report("its layers are listed", (await labels()).length === 30 && (await allBox()) === "true,false", `${(await labels()).length}`);
const red = await count(kRed);
report("open edges are red", red > 5, `${red} pixels`);
await page.uncheck("#turn-edges");
report("and are switched off", (await count(kRed)) === 0);
const bare = await count(kBuilding);
await page.locator("#turn-layers input").nth(3).uncheck();
const less = await count(kBuilding);
report("a layer is switched off", less < bare && less > 0.9 * bare, `${less} of ${bare} pixels`);
report("then not all layers are ticked", (await allBox()) === "false,true", await allBox());
await page.fill("#turn-name", "box 2");
report("a search finds layers by a part of their name", (await labels()).length === 11, (await labels()).join(","));
await page.uncheck("#turn-all");
await page.fill("#turn-name", "");
const few = await count(kBuilding);
report("all that it finds are switched together", few < 0.75 * less && few > 0.4 * less, `${few} pixels`);
await page.check("#turn-all");
report("and all of them come back", (await count(kBuilding)) === bare && (await allBox()) === "true,false");

// Seen from the south-west, no box shows its back but the lone face, from the north.
await page.check("#turn-backs");
const front = await count(kMagenta);
const box = await page.locator("#turn").boundingBox();
await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
await page.mouse.down();
await page.mouse.move(box.x + box.width / 2 + 280, box.y + box.height / 2, {steps: 8});
await page.mouse.up();
const behind = await count(kMagenta);
report("backs of faces are magenta", front < 20 && behind > 50, `${front} pixels before, ${behind} from behind`);

// A place is told and then a distance, wherever a box is hit.
const hits = [];
for (let x = 0.05; x < 1 && hits.length < 2; x += 0.01) {
  const before = await told();
  await page.mouse.click(box.x + x * box.width, box.y + 0.5 * box.height);
  if ((await told()) !== before) hits.push(await told());
}
report("a click tells layer and place", /^Box \d+ at \([\d., -]+\) m; click a second/.test(hits[0]), hits[0]);
report("a second one the distance", /; \d+\.\d{3} m from the last point, \d+\.\d{3} m along and -?\d+\.\d{3} m up$/.test(hits[1]), hits[1]);
await until("the line between them", async () => (await count("r < 80 && g < 190 && b > 200")) > 20);
report("the page has no fault", faults.length === 0, faults.join());
if (screenshot) await page.screenshot({path: screenshot, fullPage: true});
await browser.close();
