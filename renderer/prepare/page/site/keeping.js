// SPDX-License-Identifier: GPL-3.0-or-later
// Operations in the browser's own store, on its disk before it says so: they outlive the page, the browser
// and the server, killed or not. By site, for pages of several sites may have had one address.

/** @typedef {import("./outbox.js").Operation} Operation */

const kName = "insitu-prepare",
  kStore = "operations";

/** @type {Promise<IDBDatabase>|null} */
let opening = null;
const open = () =>
  (opening ??= new Promise((resolve, reject) => {
    const asked = indexedDB.open(kName, 1);
    asked.onupgradeneeded = () =>
      asked.result.createObjectStore(kStore, {keyPath: "order", autoIncrement: true});
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error);
  }));

/**
 * Does something in a transaction; resolves when that is on the disk.
 * @template T
 * @param {(store: IDBObjectStore) => IDBRequest<T>} act
 * @param {IDBTransactionDurability} [durability]
 * @returns {Promise<T>}
 */
async function inTransaction(act, durability = "strict") {
  const database = await open();
  return new Promise((resolve, reject) => {
    const transaction = database.transaction(kStore, "readwrite", {durability});
    const asked = act(transaction.objectStore(kStore));
    transaction.oncomplete = () => resolve(asked.result);
    transaction.onabort = () => reject(transaction.error);
  });
}

/**
 * Resolves to what `drop` wants when the operation is on the disk; rejects where there is no store.
 * @param {string} site
 * @param {Operation} operation
 */
export const keep = (site, operation) => inTransaction(store => store.add({site, operation}));

/**
 * One that comes back after all counts once at the server: its disk need not be waited for.
 * @param {IDBValidKey} order
 */
export const drop = order => inTransaction(store => store.delete(order), "relaxed");

/**
 * What is kept of a site, the oldest first; none where there is no store.
 * @param {string} site
 * @returns {Promise<{order: number, operation: Operation}[]>}
 */
export async function keptOf(site) {
  try {
    return (await inTransaction(store => store.getAll())).filter(one => one.site === site);
  } catch {
    return [];
  }
}
