// SPDX-License-Identifier: GPL-3.0-or-later
// What a material is beside what photographs show of it: an entry of the library, or matte; swatches of both.

import {getJson} from "../site/api.js";
import {screenColour} from "../light/light_report.js";
import {emit} from "../site/signals.js";
import {edit, isReadOnly, row, rows, state} from "../site/state.js";
import {byId, labelled, node} from "../words/dom.js";
import {language, said, t} from "../words/words.js";
import {say} from "../around/notices.js";
import {pixelOf} from "./outlines.js";

/** @typedef {{name: string, group: string, title?: string, title_de?: string, rgb: number[], mirrors: boolean, has_table: boolean}} Entry */
/** @type {Entry[]|null} null: not asked for yet */
let entries = null;

/** The library, empty until it is here; then the page is drawn anew. */
export function library() {
  if (entries === null) {
    entries = [];
    getJson("/api/library")
      .then(answer => {
        entries = answer.materials;
        if (answer.error) say(said(answer, "error"));
        emit("view");
      })
      .catch(() => (entries = null));
  }
  return /** @type {Entry[]} */ (entries);
}

/** @param {string|undefined} name */
const entryOf = name => library().find(one => one.name === name);

/** @param {Entry} entry */
const titleOf = entry => (language === "de" && entry.title_de) || entry.title || entry.name;

/** Names with titles, as the options of a field. @param {Entry[]} of */
export const entryOptions = of =>
  of.map(one => node("option", {value: one.name, label: `${one.name}: ${titleOf(one)}`}));

/**
 * What goes with giving a polygon this material: its entry, where the library has one of that name.
 * @param {string} material
 * @returns {import("../site/outbox.js").Edit[]}
 */
export function editsOfNewMaterial(material) {
  if (row("materials", material) || !entryOf(material) || isReadOnly("materials")) return [];
  return [{table: "materials", before: null, after: {name: material, use: material}}];
}

/** The material's surface is that of an entry, or "": matte, as photographed. */
function takeSurface(material, use) {
  if (isReadOnly("materials")) return say(t("readOnlyTable"));
  const before = row("materials", material) ?? null;
  const {use: _, ...rest} = before ?? {name: material};
  const isNothing = use === "" && Object.keys(rest).length === 1;
  const after = isNothing ? null : use === "" ? rest : {...rest, use};
  edit(t("opSurface", {material}), [{table: "materials", before, after}]);
  emit("view");
}

/** The field, and beside it the swatch of what it says. */
export const surfaceRow = () =>
  node(
    "div",
    {class: "row"},
    labelled(t("surface"), node("select", {id: "surface"})),
    node("span", {id: "surface-swatch", class: "swatch large"})
  );

/**
 * Shows what a material is; "": none is chosen.
 * @param {string} material
 */
export function showSurface(material) {
  const use = row("materials", material)?.use ?? "",
    field = byId("surface");
  const names = library().map(one => one.name);
  const known = use === "" || names.includes(use) ? [] : [node("option", {value: use, text: use})];
  field.replaceChildren(
    node("option", {value: "", text: t("surfaceMatte")}),
    ...known,
    ...library().map(one => node("option", {value: one.name, text: `${titleOf(one)} (${one.name})`}))
  );
  field.value = use;
  field.disabled = material === "";
  field.onchange = () => takeSurface(material, field.value);
  const entry = entryOf(use),
    swatch = byId("surface-swatch");
  swatch.style.backgroundColor = entry ? screenColour(entry.rgb) : "";
  swatch.classList.toggle("mirrors", Boolean(entry?.mirrors));
  swatch.title = entry ? `${titleOf(entry)}${entry.mirrors ? `, ${t("mirrors")}` : ""}` : "";
}

/** @type {Map<string, string>} */
const photographed = new Map();

/** The material's colour in an element: what a photograph shows in the middle of a polygon of it. */
export async function showPhotographed(material, swatch) {
  if (!photographed.has(material)) photographed.set(material, await colourOf(material));
  swatch.style.backgroundColor = photographed.get(material) ?? "";
  swatch.title = material;
}

async function colourOf(material) {
  for (const polygon of rows("polygons").filter(one => one.material === material && one.photo)) {
    const at = pixelOf(polygon, polygon.photo);
    if (!at) continue;
    const photo = state.photos.findIndex(one => one.name === polygon.photo);
    try {
      const {encoded} = await getJson(`/api/value?photo=${photo}&x=${at.x}&y=${at.y}`);
      const scale = Math.max(...encoded) <= 1 ? 255 : 1;
      return `rgb(${encoded.map(value => Math.round(scale * value)).join()})`;
    } catch {
      return "";
    }
  }
  return "";
}
