// SPDX-License-Identifier: GPL-3.0-or-later
// The measuring page in Chromium, used as a person uses it; keys and clicks are counted.
import {createRequire} from "node:module";
import {until} from "./server.mjs";

const {chromium} = createRequire(import.meta.url)(process.env.PLAYWRIGHT);

/** @param {{port: number, token: string}} server */
export async function open(server, size = {width: 1280, height: 800}) {
  const browser = await chromium.launch({executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]});
  const page = await browser.newPage({viewport: size});
  const faults = [];
  page.on("pageerror", error => faults.push(error.message));
  await page.goto(`http://127.0.0.1:${server.port}/#${server.token}`);
  await page.waitForSelector("body[data-ready]");
  return new Person(browser, page, faults);
}

export class Person {
  keys = 0;
  clicks = 0;
  constructor(browser, page, faults) {
    Object.assign(this, {browser, page, faults});
  }
  async press(...keys) {
    for (const key of keys) await this.page.keyboard.press(key);
    this.keys += keys.length;
  }
  async type(text) {
    await this.page.keyboard.type(text);
    this.keys += text.length;
  }
  async click(selector) {
    await this.page.click(selector);
    ++this.clicks;
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
  /** Until all is confirmed, in the files and adjusted. */
  settled() {
    return until("the page is settled", async () => {
      const {revision, saved, adjusted, pending} = await this.data();
      return pending === "0" && saved === revision && adjusted === revision;
    });
  }
}
