// SPDX-License-Identifier: GPL-3.0-or-later
// The measuring page in Chromium, used as a person uses it; keys and clicks are counted.
import {createRequire} from "node:module";
import {kPatience, until} from "./server.mjs";

const {chromium} = createRequire(import.meta.url)(process.env.PLAYWRIGHT);

/** What Chromium is told: who runs tests as root has no sandbox. */
const launching = {executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]};

/**
 * A window on the page; `profile`: a folder in which the browser keeps what pages store.
 * @param {{port: number, token: string}} server
 * @param {{size?: {width: number, height: number}, profile?: string, browser?: any, touch?: boolean,
 *   prepared?: (page: any) => Promise<void>}} [how]
 */
export async function open(server, {size = {width: 1280, height: 800}, profile, browser, prepared, touch = false} = {}) {
  if (profile) {
    const context = await chromium.launchPersistentContext(profile, {...launching, viewport: size});
    return openIn(context, server, context.pages()[0] ?? (await context.newPage()));
  }
  const used = browser ?? (await chromium.launch(launching));
  const context = await used.newContext({viewport: size, hasTouch: touch});
  const page = await context.newPage();
  await prepared?.(page);
  return openIn(used, server, page);
}

async function openIn(browser, server, page) {
  const faults = [];
  page.setDefaultTimeout(kPatience);
  page.on("pageerror", error => faults.push(error.message));
  page.on("console", said => {
    if (/Content Security Policy/.test(said.text())) faults.push(said.text());
  });
  const person = new Person(browser, page, faults);
  page.on("websocket", socket => socket.on("framereceived", ({payload}) => {
    const {type, revision} = JSON.parse(String(payload));
    person.told.push({type, revision, at: performance.now()});
  }));
  await page.goto(`http://127.0.0.1:${server.port}/#${server.token}`);
  await page.waitForSelector("body[data-ready]");
  return person;
}

export class Person {
  keys = 0;
  clicks = 0;
  notches = 0; // of the wheel
  /** @type {{type: string, revision?: number, at: number}[]} messages of the server, with their time [ms] */
  told = [];
  constructor(browser, page, faults) {
    Object.assign(this, {browser, page, faults});
  }
  async press(...keys) {
    for (const key of keys) await this.page.keyboard.press(key);
    this.keys += keys.length;
  }
  async type(text) {
    if (process.env.EVERY_KEY) await this.page.keyboard.type(text);
    else await this.page.keyboard.insertText(text); // at once, which takes a tenth of the time
    this.keys += text.length;
  }
  async click(selector) {
    await this.page.click(selector);
    ++this.clicks;
  }
  async clickPlace({x, y}) {
    await this.page.mouse.click(x, y);
    ++this.clicks;
  }
  async wheel({x, y}, deltaY) {
    await this.page.mouse.move(x, y);
    await this.page.mouse.wheel(0, deltaY);
    this.notches += Math.abs(deltaY) / 120;
  }
  /** What was copied elsewhere, into the field that has the focus. */
  async paste(text) {
    await this.page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await this.page.evaluate(copied => navigator.clipboard.writeText(copied), text);
    await this.press("Control+V");
  }
  /** Into a field that has the focus, in the place of what is in it. */
  async enter(text) {
    await this.page.keyboard.press("Control+A");
    await this.type(text);
    await this.press("Enter");
  }
  async photo(name) {
    await this.press("Control+F");
    await this.enter(name);
  }
  async point(name) {
    await this.press("Control+F");
    await this.enter(name);
  }
  /** The crosshair to a pixel. */
  async goTo(x, y) {
    await this.press("Control+G");
    await this.enter(`${x} ${y}`);
  }
  /** Until the page has drawn what was done, as a person would see it first. */
  drawn() {
    return this.page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
  }
  data() {
    return this.page.evaluate(() => ({...document.body.dataset}));
  }
  /** Until all is confirmed, in the files and adjusted. What was just done is told by the next frame only. */
  async settled() {
    await this.drawn();
    return until("the page is settled", async () => {
      const {revision, saved, adjusted, pending} = await this.data();
      return pending === "0" && saved === revision && adjusted === revision;
    }, () => this.data());
  }
  /** The centre of a pixel of a photo that a pane shows, on the screen. */
  async at(photo, x, y) {
    return this.page.evaluate(([name, u, v]) => {
      const stage = document.querySelector(`.pane[data-photo="${name}"] .stage`);
      const matrix = stage.querySelector(".figures").getScreenCTM();
      return {x: matrix.a * u + matrix.e, y: matrix.d * v + matrix.f};
    }, [photo, x, y]);
  }
  /** Until the page says it: a text in an element. */
  sees(selector, text = "") {
    return this.page.waitForFunction(([where, what]) =>
      [...document.querySelectorAll(where)].some(one => one.textContent.includes(what)), [selector, text]);
  }
}
