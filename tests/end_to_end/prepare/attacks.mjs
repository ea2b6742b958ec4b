// SPDX-License-Identifier: GPL-3.0-or-later
// attacks.mjs SITE: what other web pages, other names and other programs try, against the real server.
import http from "node:http";
import net from "node:net";
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
  ["a photo that is no number", "GET", "/api/tile?photo=0%00&level=0&x=0&y=0", {host, ...token}, [400]],
  ["a tile that is none", "GET", "/api/tile?photo=0&level=0&x=-1&y=0", {host, ...token}, [400]],
  ["a relit photo by its path", "GET", "/api/relit_picture?photo=../site.json&light=none", {host, ...token}, [400]],
  ["a relit photo without a token", "GET", "/api/relit_picture?photo=0&light=none", {host}, [401]],
  ["a patch of a gigabyte", "GET", "/api/patch?photo=0&x=0&y=0&r=20000", {host, ...token}, [400]],
  ["a path to the site's files", "GET", "/site.json", {host, ...token}, [404]],
  ["a whole address as the path", "GET", `http://evil.example/api/site`, {host: "evil.example", ...token}, [400, 403]],
  ["another method", "PUT", "/api/op", {host, ...token}, [404, 405]],
  ["asked before it is sent (CORS)", "OPTIONS", "/api/op", {host, origin: "https://evil.example"}, [403, 405]],
  ["a host that begins like ours", "GET", "/api/site", {host: `127.0.0.1.evil.example:${server.port}`, ...token}, [403]],
  ["a host that ends like ours", "GET", "/api/site", {host: "evil.localhost", ...token}, [403]],
  ["a host with a user", "GET", "/api/site", {host: `127.0.0.1@evil.example`, ...token}, [403]],
  ["our address by https", "POST", "/api/undo", {host, origin: `https://${host}`, ...token}, [403]],
  ["our page at another port", "POST", "/api/undo", {host, origin: "http://127.0.0.1:1", ...token}, [403]],
  ["a subdomain says the browser", "POST", "/api/undo", {host, "sec-fetch-site": "same-site", ...token}, [403]],
  ["a foreign page opens ours in a frame", "GET", "/", {host, "sec-fetch-site": "cross-site", "sec-fetch-mode": "navigate", "sec-fetch-dest": "iframe"}, [403]],
  ["a token that is cut", "GET", "/api/site", {host, authorization: `Bearer ${server.token.slice(0, 31)}`}, [401]],
  ["a token that is too long", "GET", "/api/site", {host, authorization: `Bearer ${server.token}0`}, [401]],
  ["an empty token", "GET", "/api/site", {host, authorization: "Bearer "}, [401]],
  ["the token by another scheme", "GET", "/api/site", {host, authorization: `Basic ${server.token}`}, [401]],
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
const twice = await raw(`GET /api/site HTTP/1.1\r\nHost: ${host}\r\nHost: evil.example\r\nAuthorization: Bearer ${server.token}\r\n\r\n`);
report("two hosts in a request", /^HTTP\/1.1 400/.test(twice), twice.split("\r\n")[0]);
for (const [what, line] of [["no host", ""], ["an empty host", "Host:\r\n"]]) {
  const answer = await raw(`GET /api/site HTTP/1.1\r\n${line}Authorization: Bearer ${server.token}\r\n\r\n`);
  report(what, /^HTTP\/1.1 (400|403)/.test(answer), answer.split("\r\n")[0]);
}
const rubbish = await raw("\x16\x03\x01\x02\r\n\r\n");
report("no HTTP at all", /^HTTP\/1.1 400/.test(rubbish) || rubbish === "", rubbish.split("\r\n")[0]);
const late = Buffer.from('{"token":"' + "0".repeat(32) + '"}');
report("a WebSocket with a wrong token is told nothing", !/"type"|"tables"/.test(await live(late)));
report("after all that it serves us", (await server.ask("GET", "/api/site")).status === 200);
await server.stop();

/** What the server answers to bytes. */
function raw(text) {
  return new Promise((resolve, reject) => {
    const socket = net.connect(server.port, "127.0.0.1", () => socket.write(text));
    let answer = "";
    socket.on("data", part => {
      answer += part;
      socket.end();
    });
    socket.on("close", () => resolve(answer));
    socket.on("error", reject);
  });
}

/** What a WebSocket of our page is told after its first message, until the server ends it. */
function live(message) {
  return new Promise((resolve, reject) => {
    const mask = Buffer.from([1, 2, 3, 4]);
    const frame = Buffer.concat([Buffer.from([0x81, 0x80 | message.length]), mask, message.map((byte, i) => byte ^ mask[i % 4])]);
    const request = http.request({host: "127.0.0.1", port: server.port, path: "/api/live", headers: {host, origin: `http://${host}`, ...upgrade}});
    request.on("upgrade", (answer, socket) => {
      let told = "";
      socket.on("data", part => (told += part.toString("latin1")));
      socket.on("close", () => resolve(told));
      socket.write(frame);
    });
    request.on("error", reject);
    request.end();
  });
}
