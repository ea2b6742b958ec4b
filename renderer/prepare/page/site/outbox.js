// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on their way: in memory and in the browser's store until the server has confirmed them,
// sent in order, one after the other, and again after a failure. Each counts once, by its id.

import {post} from "./api.js";
import {drop, keep, keptOf} from "./keeping.js";
import {said} from "../words/words.js";

/** @typedef {{table: string, before: any, after: any}} Edit */
/** @typedef {{id: string, label: string, edits: Edit[]}} Operation */

/** @type {Operation[]} */
const waiting = [];
/** @type {Map<string, Promise<IDBValidKey|null>>} their keys in the store, by id; null: not kept */
const keys = new Map();
/** @type {Set<string>} ids of those that the store holds for sure */
const kept = new Set();
let isSending = false,
  isOpen = false, // what an earlier page left is here, which goes first
  site = "",
  timer = 0;
let handlers = {
  confirmed: (_operation, _revision) => {},
  refused: (_operation, _status, _body) => {},
  changed: () => {}
};

/** Operations that the server has not confirmed. */
export const unconfirmed = () => waiting;
/** How often sending has failed since it last succeeded. */
export let failures = 0;
/** Why the server keeps an operation off its disk, or "". */
export let storeFault = "";

/** A text that no other operation has. */
export const newId = () =>
  [...crypto.getRandomValues(new Uint8Array(12))]
    .map(byte => byte.toString(16).padStart(2, "0"))
    .join("");

/** Of the unconfirmed, those that outlive this page, the browser being killed. */
export const keptCount = () => waiting.filter(operation => kept.has(operation.id)).length;

/** @param {Operation} operation */
function store(operation) {
  const stored = keep(site, operation).then(
    key => {
      if (waiting.includes(operation)) kept.add(operation.id);
      handlers.changed();
      return key;
    },
    () => null // a full or forbidden store: memory still has it
  );
  keys.set(operation.id, stored);
}

/**
 * Takes up those that an earlier page of this site left unconfirmed.
 * @param {string} siteFolder
 * @param {typeof handlers} called
 */
export async function openOutbox(siteFolder, called) {
  site = siteFolder;
  handlers = called;
  const earlier = (await keptOf(site)).filter(({operation}) => !keys.has(operation.id));
  for (const {order, operation} of earlier) {
    keys.set(operation.id, Promise.resolve(order));
    kept.add(operation.id);
  }
  waiting.unshift(...earlier.map(({operation}) => operation));
  isOpen = true;
  if (waiting.length > 0) sendNow();
}

/** @param {Operation} operation */
export function enqueue(operation) {
  waiting.push(operation);
  store(operation);
  handlers.changed();
  if (failures === 0) sendNow();
}

/** @param {Operation} operation */
function forget(operation) {
  const place = waiting.indexOf(operation);
  if (place >= 0) waiting.splice(place, 1);
  kept.delete(operation.id);
  keys.get(operation.id)?.then(key => (key === null ? null : drop(key).catch(() => {})));
  keys.delete(operation.id);
}

/**
 * Sends the oldest; true if the next may follow.
 * @param {Operation} operation
 */
async function send(operation) {
  const {status, body} = await post("/api/op", operation);
  if (status === 200) {
    forget(operation);
    storeFault = "";
    handlers.confirmed(operation, body.revision);
    return true;
  }
  if (status === 400 || status === 409) {
    // wrong for ever: a person decides
    forget(operation);
    handlers.refused(operation, status, body);
    return true;
  }
  storeFault = said(body, "error") || `${status}`; // 5xx: the disk is full, ...; 401: another server's token
  return false;
}

/** Sends what waits; after a failure again in a while. */
export async function sendNow() {
  if (isSending || !isOpen) return;
  isSending = true;
  clearTimeout(timer);
  try {
    while (waiting.length > 0) {
      if (!(await send(waiting[0]))) throw new Error(storeFault);
      failures = 0;
    }
    failures = 0;
  } catch {
    failures += 1;
    timer = window.setTimeout(sendNow, Math.min(4000, 250 * 2 ** Math.min(failures, 4)));
  }
  isSending = false;
  handlers.changed();
}

/**
 * Resolves when nothing waits any more, false after `seconds`.
 * @param {number} seconds
 */
export async function emptied(seconds) {
  for (let i = 0; i < seconds * 50; ++i) {
    if (waiting.length === 0) return true;
    await new Promise(done => setTimeout(done, 20));
  }
  return waiting.length === 0;
}
