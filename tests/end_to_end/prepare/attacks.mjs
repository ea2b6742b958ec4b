// SPDX-License-Identifier: GPL-3.0-or-later
// attacks.mjs SITE: what other web pages, other names and other programs try, against the real server.
import {ask, report, start} from "./server.mjs";

const server = await start(process.argv[2]);
const token = {authorization: `Bearer ${server.token}`};
const host = `127.0.0.1:${server.port}`;
const upgrade = {connection: "Upgrade", upgrade: "websocket", "sec-websocket-version": "13",
  "sec-websocket-key": "dGhlIHNhbXBsZSBub25jZQ=="};

/** @type {[string, string, string, any, number[]][]} what, method, path, headers, statuses that are right */
const table = [
  ["the page needs no token", "GET", "/", {host}, [200]],
  ["data need one", "GET", "/api/site", {host}, [401]],
  ["with it they are given", "GET", "/api/site", {host, ...token}, [200]],
  ["a wrong token", "GET", "/api/site", {host, authorization: `Bearer ${"0".repeat(32)}`}, [401]],
  ["the token in the query", "GET", `/api/site?token=${server.token}`, {host}, [401]],
  ["the token as a cookie", "GET", "/api/site", {host, cookie: `token=${server.token}`}, [401]],
  ["another name of this machine (DNS rebinding)", "GET", "/api/site", {host: `evil.example:${server.port}`, ...token}, [403]],
  ["no page even, under another name", "GET", "/", {host: "evil.example"}, [403]],
  ["localhost is this machine", "GET", "/api/site", {host: "localhost:1", ...token}, [200]],
  ["a foreign page", "POST", "/api/undo", {host, origin: "https://evil.example", ...token}, [403]],
  ["a page without origin", "POST", "/api/undo", {host, origin: "null", ...token}, [403]],
  ["another site says the browser", "GET", "/api/site", {host, "sec-fetch-site": "cross-site", ...token}, [403]],
  ["a path out of the page", "GET", "/page/../../../etc/passwd", {host, ...token}, [400, 401, 404]],
  ["the same, disguised", "GET", "/page/%2e%2e/%2e%2e/etc/passwd", {host, ...token}, [400, 401, 404]],
  ["a photo by its path", "GET", "/api/tile?photo=../site.json&level=0&x=0&y=0", {host, ...token}, [400]],
  ["a photo that is none", "GET", "/api/tile?photo=99&level=0&x=0&y=0", {host, ...token}, [400]],
  ["an address that is none", "GET", "/api/everything", {host, ...token}, [404]],
  ["a WebSocket without origin", "GET", "/api/live", {host, ...upgrade}, [403]],
  ["a WebSocket of a foreign page", "GET", "/api/live", {host, origin: "http://evil.example", ...upgrade}, [403]],
  ["a WebSocket of our page", "GET", "/api/live", {host, origin: `http://${host}`, ...upgrade}, [101]],
];
for (const [what, method, path, headers, right] of table) {
  const {status} = await ask(server.port, method, path, undefined, headers);
  report(what, right.includes(status), `${status}`);
}
const big = await ask(server.port, "POST", "/api/op", "x".repeat(2 << 20), {host, ...token}).catch(() => ({status: 413}));
report("a body of 2 MB", big.status === 413, `${big.status}`);
const broken = await server.ask("POST", "/api/op", "{");
report("a body that is no JSON", broken.status === 400, broken.body.error);
const page = await ask(server.port, "GET", "/", undefined, {host});
report("the page may load nothing from elsewhere", /default-src 'self'/.test(page.headers["content-security-policy"]) &&
  page.headers["x-content-type-options"] === "nosniff" && !page.headers["access-control-allow-origin"]);
await server.stop();
