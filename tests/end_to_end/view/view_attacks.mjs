// SPDX-License-Identifier: GPL-3.0-or-later
// view_attacks.mjs SITE: what other pages and programs try, and questions that cannot be right.
import {ask, report, start} from "../prepare/server.mjs";

const server = await start(process.argv[2], [], {}, "insitu-view");
const token = {authorization: `Bearer ${server.token}`};
const host = `127.0.0.1:${server.port}`;

/** @type {[string, string, string, any, any, number][]} what, method, path, headers, body, status that is right */
const table = [
  ["the page needs no token", "GET", "/", {host}, undefined, 200],
  ["nor do its modules", "GET", "/prepare/page/words/dom.js", {host}, undefined, 200],
  ["data need one", "GET", "/api/site", {host}, undefined, 401],
  ["with it they are given", "GET", "/api/site", {host, ...token}, undefined, 200],
  ["another name of this machine (DNS rebinding)", "GET", "/api/site", {host: `evil.example:${server.port}`, ...token}, undefined, 403],
  ["a foreign page", "POST", "/api/run", {host, origin: "https://evil.example", ...token}, {photo: "left"}, 403],
  ["another site says the browser", "POST", "/api/stop", {host, "sec-fetch-site": "cross-site", ...token}, {}, 403],
  ["a picture by its path", "GET", "/api/tile?photo=../site.json&level=0&x=0&y=0", {host, ...token}, undefined, 400],
  ["a picture that is none", "GET", "/api/tile?photo=999&level=0&x=0&y=0", {host, ...token}, undefined, 400],
  ["a tile that is none", "GET", "/api/tile?photo=0&level=0&x=99&y=0", {host, ...token}, undefined, 400],
  ["a level that is none", "GET", "/api/tile?photo=0&level=-1&x=0&y=0", {host, ...token}, undefined, 400],
  ["a pixel that is none", "GET", "/api/value?photo=0&x=-1&y=0", {host, ...token}, undefined, 400],
  ["an outline of no photograph", "GET", "/api/outline?photo=..%2Fsite&frame=photo", {host, ...token}, undefined, 400],
  ["a difference of nothing", "POST", "/api/difference", {host, ...token}, {before: 0, after: 999}, 400],
  ["a render of no photograph", "POST", "/api/run", {host, ...token}, {photo: "--help"}, 400],
  ["a render of a quality that is none", "POST", "/api/run", {host, ...token}, {photo: "left", quality: "best"}, 400],
  ["what is no JSON", "POST", "/api/run", {host, ...token}, "{", 400],
  ["an address that is none", "GET", "/api/op", {host, ...token}, undefined, 404],
  ["a module of the measuring page that is not shared", "GET", "/prepare/page/points/marking.js", {host, ...token}, undefined, 404]
];
for (const [what, method, path, headers, body, status] of table) {
  const answer = await ask(server.port, method, path, body, headers);
  report(what, answer.status === status, answer.status === status ? "" : `${answer.status} ${JSON.stringify(answer.body)}`);
}
const {body: site} = await server.ask("GET", "/api/site");
report("pictures are told without their places on the disk", !JSON.stringify(site).includes(process.argv[2]));
report("it ends in order", (await server.stop("SIGINT")) === 0);
