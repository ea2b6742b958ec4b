// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of horizon, haze and daylight, and what the light's measurement says of them.

import {button, byId, node, labelled} from "./dom.js";
import {addAction} from "./keys.js";
import {say} from "./notices.js";
import {parseNumber, shown} from "./numbers.js";
import {edit, isReadOnly, row, rows, state} from "./state.js";
import {activePane, placeOf, setMode, setTool, ui} from "./ui.js";
import {t} from "./words.js";

/**
 * Takes samples of a kind until Esc.
 * @param {"horizon"|"haze"|"daylight"} kind
 */
export function takeSamples(kind) {
  if (isReadOnly(kind)) return say(t("readOnlyTable"));
  setMode("light");
  setTool({
    name: `sample_${kind}`,
    hint: () => t("samplePlace"),
    finish: () => setTool(null),
    place: (photo, x, y) => insert(kind, photo, Math.round(x), Math.round(y))
  });
  say(t("samplePlace"));
}

/** @param {string} kind */
function insert(kind, photo, x, y) {
  if (row(kind, photo, x, y)) return say(t("taken", {name: `${photo} ${x} ${y}`}));
  const polygon = kind === "horizon" ? null : polygonAt(photo, x, y);
  if (kind !== "horizon" && polygon === null) return say(t("noPolygonThere"));
  edit(t("opSample", {kind: t(kind), photo}), [
    {table: kind, before: null, after: polygon === null ? {photo, x, y} : {photo, polygon, x, y}}
  ]);
  say(t("sampleMade", {kind: t(kind), polygon: polygon ?? ""}));
}

/**
 * The polygon whose outline holds the pixel: the current one first, then the smallest, which lies before
 * larger ones more often than not. The light's measurement names samples that are hidden.
 */
function polygonAt(photo, x, y) {
  const holding = rows("polygons")
    .map(polygon => ({name: polygon.name, outline: outlineOf(polygon, photo)}))
    .filter(one => one.outline.length > 2 && isInside(one.outline, x, y));
  if (holding.some(one => one.name === ui.polygon)) return ui.polygon;
  holding.sort((a, b) => area(a.outline) - area(b.outline));
  return holding[0]?.name ?? null;
}

function outlineOf(polygon, photo) {
  const corners = polygon.vertices.map(name => placeOf(photo, name));
  return corners.every(at => at)
    ? corners.map(at => [at.x, at.y])
    : (state.adjusted?.polygons?.[polygon.name]?.images?.[photo]?.[0] ?? []);
}

function isInside(outline, x, y) {
  let inside = false;
  outline.forEach(([x1, y1], i) => {
    const [x2, y2] = outline[(i + 1) % outline.length];
    if (y1 > y !== y2 > y && x < ((x2 - x1) * (y - y1)) / (y2 - y1) + x1) inside = !inside;
  });
  return inside;
}
const area = outline =>
  Math.abs(
    outline.reduce((sum, [x, y], i) => {
      const [u, v] = outline[(i + 1) % outline.length];
      return sum + x * v - u * y;
    }, 0)
  );

/** Deletes the sample at the crosshair. */
function deleteSample() {
  const pane = activePane(),
    {x, y} = pane.cursor;
  const near = ["horizon", "haze", "daylight"].flatMap(table =>
    rows(table)
      .filter(one => one.photo === pane.photo?.name && Math.hypot(one.x - x, one.y - y) * pane.k <= 12)
      .map(before => ({table, before, after: null}))
  );
  near.sort(
    (a, b) => Math.hypot(a.before.x - x, a.before.y - y) - Math.hypot(b.before.x - x, b.before.y - y)
  );
  if (near.length === 0) return say(t("noSample"));
  edit(t("opDeleteSample", {photo: pane.photo.name}), [near[0]]);
}

export function buildLightPanel(root) {
  const start = (kind, key) =>
    button(
      t(kind),
      () => {
        takeSamples(kind);
        activePane().focus();
      },
      {title: key}
    );
  const card = node("input", {
    id: "card",
    type: "text",
    inputmode: "decimal",
    placeholder: "0.18 0.18 0.18"
  });
  card.addEventListener("change", () => takeCard(card));
  root.append(
    node(
      "div",
      {class: "buttons"},
      start("horizon", "H"),
      start("haze", "J"),
      start("daylight", "O"),
      button(t("deleteSample"), deleteSample)
    ),
    labelled(t("reflectance"), card),
    node("ul", {id: "advice"}),
    node("dl", {id: "light-about"})
  );
  drawn = "";
}

/** The reflectance of the daylight samples' material: three numbers, or one for grey. */
function takeCard(field) {
  const values = field.value
    .trim()
    .split(/[\s;]+/)
    .map(parseNumber);
  const old = rows("light")[0] ?? null;
  if (field.value.trim() === "") {
    const {daylight_reflectance_rgb: _, ...rest} = old ?? {};
    return edit(t("opCard"), [{table: "light", before: old, after: rest}]);
  }
  if (
    ![1, 3].includes(values.length) ||
    values.some(value => value === null || value <= 0 || value > 1)
  ) {
    return say(t("badNumber", {text: field.value}));
  }
  edit(t("opCard"), [
    {
      table: "light",
      before: old,
      after: {
        ...old,
        daylight_reflectance_rgb: values.length === 1 ? [values[0], values[0], values[0]] : values
      }
    }
  ]);
}

let drawn = "";
export function updateLightPanel() {
  const light = state.light,
    card = byId("card");
  const signature = JSON.stringify([
    light,
    rows("light"),
    rows("horizon").length,
    rows("haze").length,
    rows("daylight").length
  ]);
  if (!byId("advice") || drawn === signature) return;
  drawn = signature;
  if (document.activeElement !== card)
    card.value = (rows("light")[0]?.daylight_reflectance_rgb ?? []).join(" ");
  const advice = [...(light?.failed ? [light.failed] : []), ...(light?.advice ?? [])];
  byId("advice").replaceChildren(
    ...advice.map(text => node("li", {text: typeof text === "string" ? text : text.text}))
  );
  const lines = ["horizon", "haze", "daylight"].map(kind => [
    t(kind),
    t("count", {n: rows(kind).length})
  ]);
  for (const [name, value] of Object.entries(light ?? {})) {
    if (["type", "revision", "failed", "samples", "advice"].includes(name)) continue;
    lines.push([name.replace(/_/g, " "), textOf(value)]);
  }
  byId("light-about").replaceChildren(
    ...lines.flatMap(([name, text]) => [node("dt", {text: name}), node("dd", {text})])
  );
}

/**
 * Numbers to four digits, whatever they stand in.
 * @param {any} value
 * @returns {string}
 */
function textOf(value) {
  if (typeof value === "number") return shown(value, Math.abs(value) < 1 ? 4 : 2);
  if (Array.isArray(value)) return value.map(textOf).join("  ");
  if (value && typeof value === "object")
    return Object.entries(value)
      .map(([key, one]) => `${key.replace(/_/g, " ")} ${textOf(one)}`)
      .join(", ");
  return value === null || value === undefined ? "–" : String(value);
}

export function addLightKeys() {
  addAction({id: "horizon", key: "H", run: () => takeSamples("horizon")});
  addAction({id: "haze", key: "J", run: () => takeSamples("haze")});
  addAction({id: "daylight", key: "O", run: () => takeSamples("daylight")});
}
