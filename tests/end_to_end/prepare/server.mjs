// SPDX-License-Identifier: GPL-3.0-or-later
// insitu-prepare, or another server of ours, as a test drives it: started, asked, killed.
import {spawn} from "node:child_process";
import http from "node:http";
import {once} from "node:events";

/** No server outlives its test. */
const running = new Set();
process.once("exit", () => running.forEach(child => child.kill("SIGKILL")));

/**
 * @param {string} site
 * @param {string[]} [options]
 * @param {import("node:child_process").SpawnOptions} [how] as whom it runs, for one
 * @param {string} [program]
 */
export async function start(site, options = [], how = {}, program = "insitu-prepare") {
  const child = spawn(`${process.env.INSITU_BIN}/${program}`, [site, "--no-browser", ...options], how);
  running.add(child);
  child.once("exit", () => running.delete(child));
  let said = "", complained = "";
  child.stderr.on("data", text => (complained += text));
  const ended = once(child, "exit");
  const address = await new Promise((resolve, reject) => {
    child.stdout.on("data", text => {
      said += text;
      const found = said.match(/http:\/\/127\.0\.0\.1:(\d+)\/#([0-9a-f]{32})\s/);
      if (found) resolve({port: Number(found[1]), token: found[2]});
    });
    child.on("exit", status => reject(new Error(`ended with ${status}: ${complained}`)));
  });
  return {
    ...address,
    child,
    /** What it has said of errors and warnings. */
    complained: () => complained,
    /** Ends it; its exit status, or the signal's name. */
    async stop(signal = "SIGTERM") {
      child.kill(signal);
      const [status, by] = await ended;
      return status ?? by;
    },
    /** @returns {Promise<{status: number, body: any}>} */
    ask: (method, path, body) => ask(address.port, method, path, body, {authorization: `Bearer ${address.token}`}),
  };
}

/**
 * One request, with just these headers.
 * @returns {Promise<{status: number, body: any, headers: any}>}
 */
export function ask(port, method, path, body, headers = {}) {
  return new Promise((resolve, reject) => {
    const text = body === undefined ? "" : typeof body === "string" ? body : JSON.stringify(body);
    const request = http.request({host: "127.0.0.1", port, method, path, headers: {...headers, "content-length": Buffer.byteLength(text)}, agent: false});
    request.on("response", async answer => {
      const parts = [];
      for await (const part of answer) parts.push(part);
      const whole = Buffer.concat(parts).toString();
      let json = whole;
      try {
        json = JSON.parse(whole);
      } catch {}
      resolve({status: answer.statusCode, body: json, headers: answer.headers});
    });
    request.on("upgrade", (answer, socket) => {
      socket.destroy();
      resolve({status: answer.statusCode, body: null, headers: answer.headers});
    });
    request.on("error", reject);
    request.end(text);
  });
}

/** An operation that puts a row in. */
export const insert = (id, table, row) => ({id, label: id, edits: [{table, before: null, after: row}]});

/** [ms] after which what does not come is taken as never coming, on a machine that is busy with much else. */
export const kPatience = 120000;

/** Asks again until it is so; `instead`: what there was at the end, for the error. */
export async function until(what, is, instead = async () => "") {
  for (const begun = performance.now(); performance.now() - begun < kPatience;) {
    const found = await is();
    if (found) return found;
    await new Promise(resolve => setTimeout(resolve, 50));
  }
  throw new Error(`never: ${what} ${JSON.stringify(await instead())}`);
}

/** Prints an assertion for assertions.sh's check_figures. */
export function report(what, isRight, figure = "") {
  const told = String(figure).replace(/\s+/g, " ").trim(); // an assertion is a line
  console.log(`${isRight ? "ok" : "FAIL"}: ${what}${told === "" ? "" : ` (${told})`}`);
}

/** A generator of numbers from 0 to 1 that gives the same ones each time. [mulberry32] */
export function seeded(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
