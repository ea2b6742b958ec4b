// SPDX-License-Identifier: GPL-3.0-or-later
// What the site holds: tables as the server has confirmed them, and over them what this page has done
// since. What the server has computed from them stands beside, as it was last told.

import {connectLive, getJson} from "./api.js";
import {firstSite} from "../photo/first_look.js";
import {enqueue, newId, openOutbox, unconfirmed} from "./outbox.js";
import {isSame, kKeys, keyOf} from "./rows.js";
import {emit} from "./signals.js";
import {said} from "../words/words.js";

/** @typedef {import("./rows.js").Row} Row */
/** @typedef {{name: string, width: number, height: number, levels: number, camera: string, fault?: string}} Photo */

/** @type {Record<string, Map<string, Row>>} */
let confirmed = {};
export const state = {
  name: "",
  version: "",
  siteFolder: "",
  revision: 0,
  saved: 0,
  /** How much the server had told when it was asked for everything. */
  news: -1,
  notSaved: "",
  /** Changes that wait for an answer before they can be made. */
  asking: 0,
  isConnected: false,
  isLoaded: false,
  /** @type {Photo[]} */ photos: [],
  /** @type {Record<string, Map<string, Row>>} */ tables: {},
  /** @type {{table: string, file: string, line: number, text: string}[]} */ readOnly: [],
  /** @type {{undo: string|null, redo: string|null}} */ history: {undo: null, redo: null},
  /** @type {any[]} */ todo: [],
  /** @type {any} */ adjusted: null,
  /** @type {any} */ light: null,
  /** @type {any} */ building: null,
  /** @type {any} */ film: null,
  /** @type {{file?: string, line?: number, text: string}[]} */ faults: [],
  /** @type {{operation: any, conflicts: any[], error?: string}[]} */ refused: [],
  /** Rows of a colleague's copy that differ. @type {{from: string, table: string, current: Row, after: Row}[]} */
  merge: []
};
/** The live connection. */
export let live = {send: (/** @type {any} */ _message) => {}};

/**
 * @param {string} table
 * @returns {Row[]}
 */
export const rows = table => [...(state.tables[table]?.values() ?? [])];
/**
 * The row with this key.
 * @param {string} table
 * @param {...any} key
 * @returns {Row|undefined}
 */
export const row = (table, ...key) => state.tables[table]?.get(key.map(String).join("\n"));
/**
 * @param {string} photo
 * @param {string} point
 */
export const mark = (photo, point) => row("observations", photo, point);
/**
 * @param {string} name
 * @returns {Photo|undefined}
 */
export const photoOf = name => state.photos.find(photo => photo.name === name);
/** Whether what is known of the light, if anything, is of an earlier adjustment. */
export const isLightAwaited = () =>
  state.adjusted !== null && !(state.light?.revision >= state.adjusted.revision);
/** @param {string} table */
export const isReadOnly = table => state.readOnly.some(one => one.table === table);

/**
 * @param {Record<string, Map<string, Row>>} tables
 * @param {import("./outbox.js").Edit[]} edits
 */
function applyEdits(tables, edits) {
  for (const {table, before, after} of edits) {
    const rowsByKey = (tables[table] ??= new Map());
    const oldKey = before && keyOf(table, before);
    if (after && oldKey === keyOf(table, after)) rowsByKey.set(oldKey, after);
    else {
      if (before) rowsByKey.delete(oldKey);
      if (after) rowsByKey.set(keyOf(table, after), after);
    }
  }
}

/** Tables as confirmed and what waits over them. */
function rebuild() {
  state.tables = Object.fromEntries(
    Object.entries(confirmed).map(([table, all]) => [table, new Map(all)])
  );
  for (const operation of unconfirmed()) applyEdits(state.tables, operation.edits);
  index = null;
  emit("tables");
}

/**
 * The edits of an operation as they came: forwards, or if the rows already are as `after` says and not as
 * `before` does, backwards.
 */
function direction(edits) {
  const stands = (edit, side) => {
    const at = edit.before ?? edit.after;
    return isSame(confirmed[edit.table]?.get(keyOf(edit.table, edit[side] ?? at)) ?? null, edit[side]);
  };
  const isDone =
    edits.every(edit => stands(edit, "after")) && !edits.every(edit => stands(edit, "before"));
  return isDone
    ? edits.map(edit => ({...edit, before: edit.after, after: edit.before})).reverse()
    : edits;
}

const seen = new Set(); // ids of edits that `confirmed` holds

/** @param {any} message */
function takeOperation(message) {
  const {operation, kind, revision} = message;
  const isKnown = kind === "edit" && operation.id && seen.has(operation.id);
  if (!isKnown && revision > base) {
    applyEdits(confirmed, kind === "undo" ? direction(operation.edits) : operation.edits);
    if (kind === "edit") seen.add(operation.id);
  }
  if (message.history) state.history = message.history;
  state.revision = Math.max(state.revision, revision);
  rebuild();
  emit("history");
  emit("todo");
}
let base = 0; // the revision of the tables as they were loaded

/** What the adjustment found, unless it is of an older state than what is shown. */
function takeAdjusted(message) {
  if (message && state.adjusted && message.revision < state.adjusted.revision) return;
  state.adjusted = message;
  index = null;
  emit("adjusted");
}

const takers = {
  // All was loaded before the connection was open: what was told in between did not come.
  hello: message => {
    if (message.news === undefined || message.news !== state.news) load().catch(() => {});
  },
  op: takeOperation,
  todo: message => {
    state.todo = message.todo;
    emit("todo");
  },
  saved: message => {
    state.saved = Math.max(state.saved, message.revision);
    state.notSaved = "";
    emit("saved");
  },
  not_saved: message => {
    state.notSaved = said(message);
    emit("saved");
  },
  adjusted: takeAdjusted,
  light: message => {
    state.light = message;
    emit("light");
  },
  building: message => {
    state.building = message;
    emit("building");
  },
  film: message => {
    state.film = message.photos ? message : null; // without photos: there is no film any more
    emit("film");
  },
  merge: message => {
    state.merge = message.merge;
    emit("merge");
  },
  run: message => emit("run", message),
  fault: message => {
    state.faults = [...state.faults.slice(-20), message];
    emit("faults");
  },
  reload: () => load().catch(() => {}), // a file parses no more, or again
  outside: message => {
    state.faults = [...state.faults.slice(-20), message];
    emit("faults");
  }
};

let loading = 0; // answers with everything that are on their way
/** @type {any[]} told meanwhile: newer than those, or the same once more */
let toldMeanwhile = [];

function take(message) {
  if (loading > 0 && message.type !== "run") toldMeanwhile.push(message);
  else takers[message.type]?.(message);
}

/** Everything from the server, then what it told meanwhile. */
async function load() {
  loading += 1;
  try {
    takeSite(await getJson("/api/site"));
  } finally {
    loading -= 1;
    if (loading === 0) for (const message of toldMeanwhile.splice(0)) take(message);
  }
}

/**
 * The same objects for the same photos, which panes hold.
 * @param {Photo[]} photos
 */
const samePhotos = photos =>
  photos.map(photo => Object.assign(photoOf(photo.name) ?? {}, {fault: undefined}, photo));

/** What waits here stays on top. */
function takeSite(site) {
  confirmed = Object.fromEntries(
    Object.keys(kKeys).map(table => [
      table,
      new Map((site.tables[table] ?? []).map(one => [keyOf(table, one), one]))
    ])
  );
  seen.clear();
  Object.assign(state, {
    name: site.name,
    version: site.version,
    siteFolder: site.site_folder,
    photos: samePhotos(site.photos),
    readOnly: site.read_only ?? [],
    history: site.history,
    saved: site.saved,
    revision: site.revision,
    news: site.news ?? -1,
    todo: site.todo ?? [],
    light: site.light,
    adjusted: site.adjusted,
    building: site.building ?? state.building,
    film: site.film ?? null,
    merge: site.merge ?? [],
    notSaved: said(site, "not_saved"),
    faults: state.isLoaded ? state.faults : (site.found ?? []), // at the server's start
    isLoaded: true
  });
  base = site.revision;
  rebuild();
  for (const signal of ["site", "history", "todo", "adjusted", "light", "saved"]) emit(signal);
}

/** The first load, after which all can be shown. */
export async function start() {
  takeSite(await firstSite);
}

/** Then what an earlier page left, and the live connection, which loads again where it missed something. */
export async function connect() {
  await openOutbox(state.siteFolder, {
    confirmed: (operation, revision) => {
      if (!seen.has(operation.id) && !(revision <= base)) applyEdits(confirmed, operation.edits);
      seen.add(operation.id);
      state.revision = Math.max(state.revision, revision ?? 0);
      rebuild();
      emit("saved");
    },
    refused: (operation, status, body) => {
      state.refused.push({
        operation,
        conflicts: status === 409 ? (body.conflicts ?? []) : [],
        error: said(body, "error")
      });
      for (const {table, before, current} of body.conflicts ?? []) {
        applyEdits(confirmed, [{table, before: before ?? current, after: current}]);
      }
      rebuild();
      emit("refused");
    },
    changed: () => emit("saved")
  });
  rebuild();
  live = connectLive(take, isOpen => {
    state.isConnected = isOpen;
    emit("connection");
  });
}

/**
 * Does something: at once on this page, then at the server.
 * @param {string} label
 * @param {import("./outbox.js").Edit[]} edits
 */
export function edit(label, edits) {
  const changes = edits.filter(one => !isSame(one.before, one.after));
  if (changes.length === 0) return;
  const operation = {
    id: newId(),
    label,
    edits: changes.map(one => ({table: one.table, before: one.before ?? null, after: one.after ?? null}))
  };
  applyEdits(state.tables, operation.edits);
  index = null;
  enqueue(operation);
  emit("tables");
}

// Derived: made when asked for after a change.
/** @type {ReturnType<typeof makeIndex>|null} */
let index = null;
export const indexed = () => (index ??= makeIndex());

/** Marks and statistics by point, roles, who names a point. */
function makeIndex() {
  /** @type {Map<string, {name: string, kind: string, marks: Row[], w: number|null, redundancy: number|null}>} */
  const points = new Map();
  const want = (name, kind) => {
    const known = points.get(name);
    if (!known) points.set(name, {name, kind, marks: [], w: null, redundancy: null});
    else if (kind !== "tie" && known.kind === "tie") known.kind = kind;
    return /** @type {any} */ (points.get(name));
  };
  for (const one of rows("control_points")) want(one.name, one.role === "check" ? "check" : "control");
  for (const {vertices, holes} of rows("polygons"))
    for (const name of [vertices, ...(holes ?? [])].flat()) want(name, "vertex");
  for (const one of rows("sun")) [one.object, one.shadow].forEach(name => want(name, "vertex"));
  for (const one of rows("zenith")) [one.bottom, one.top].forEach(name => want(name, "vertex"));
  for (const one of rows("observations")) want(one.point, "tie").marks.push(one);
  const adjusted = new Map();
  for (const one of state.adjusted?.marks ?? []) {
    adjusted.set(`${one.photo}\n${one.point}`, one);
    const point = points.get(one.point);
    if (!point) continue;
    if (one.w !== null) point.w = Math.max(point.w ?? 0, Math.abs(one.w));
    point.redundancy = Math.min(point.redundancy ?? 1, one.r ?? 0);
  }
  return {points, adjusted};
}

/**
 * What the adjustment says of a mark.
 * @param {string} photo
 * @param {string} point
 */
export const adjustedMark = (photo, point) => indexed().adjusted.get(`${photo}\n${point}`);
/**
 * Where a point should be on a photo.
 * @param {string} photo
 * @param {string} point
 */
export const prediction = (photo, point) => state.adjusted?.points?.[point]?.images?.[photo];
/** @param {string} point */
export const kindOf = point => indexed().points.get(point)?.kind ?? "tie";
/**
 * Marks of a point that count.
 * @param {string} point
 */
export const raysOf = point =>
  (indexed().points.get(point)?.marks ?? []).filter(one => one.state !== "off").length;

/**
 * A name that nothing has: the stem and the next number.
 * @param {string} stem
 */
export function freeName(stem) {
  const taken = stem === "polygon_" ? new Set(rows("polygons").map(one => one.name)) : indexed().points;
  for (let i = 1; ; ++i) if (!taken.has(`${stem}${i}`)) return `${stem}${i}`;
}
/**
 * Why a name cannot be in the files, or "".
 * @param {string} name
 */
export const nameFault = name => (/^$|^\s|\s$|[\n\r\t]/.test(name) ? "badName" : "");
