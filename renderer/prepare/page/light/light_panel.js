// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of horizon, haze and daylight, and what the light's measurement says of them.

import {ask} from "../site/api.js";
import {button, byId, node, labelled} from "../words/dom.js";
import {addAction} from "../around/keys.js";
import {drawLightReport} from "./light_report.js";
import {say} from "../around/notices.js";
import {parseNumber} from "../words/numbers.js";
import {sampleAt, sampleKey, samples} from "./samples.js";
import {emit} from "../site/signals.js";
import {edit, isLightAwaited, isReadOnly, row, rows, state} from "../site/state.js";
import {activePane, setMode, setTool, ui} from "../site/ui.js";
import {area, isSeenAt, placed} from "../tools/outlines.js";
import {entryOptions, library} from "../tools/surfaces.js";
import {t} from "../words/words.js";

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
    place: (photo, x, y) => insertInTurn(kind, photo, Math.round(x), Math.round(y))
  });
  say(t("samplePlace"));
}

let inTurn = Promise.resolve();
/** One after the other, as they were placed: the server is asked about each. */
function insertInTurn(kind, photo, x, y) {
  state.asking += 1;
  inTurn = inTurn
    .then(() => insert(kind, photo, x, y))
    .finally(() => {
      state.asking -= 1;
      emit("saved");
    });
}

/** @param {string} kind */
async function insert(kind, photo, x, y) {
  const polygon = kind === "horizon" ? null : await polygonAt(photo, x, y);
  if (row(kind, photo, x, y)) return say(t("taken", {name: `${photo} ${x} ${y}`}));
  if (kind !== "horizon" && polygon === null) return say(t("noPolygonThere"));
  const after = polygon === null ? {photo, x, y} : {photo, polygon, x, y};
  edit(t("opSample", {kind: t(kind), photo}), [{table: kind, before: null, after}]);
  ui.sample = sampleKey(kind, after);
  say(t("sampleMade", {kind: t(kind), polygon: polygon ?? ""}));
}

/** The polygon that the pixel sees first, as the server knows, else by the outlines that are known here. */
async function polygonAt(photo, x, y) {
  const answer = await ask("/api/polygon_at", {photo, x, y});
  return answer.error ? guessedAt(photo, x, y) : (answer.polygon ?? null);
}

/** The current polygon first, then the smallest, which lies before larger ones more often than not. */
function guessedAt(photo, x, y) {
  const holding = rows("polygons")
    .filter(polygon => isSeenAt(polygon, photo, x, y))
    .map(polygon => ({name: polygon.name, area: area(placed(polygon.vertices, photo))}));
  if (holding.some(one => one.name === ui.polygon)) return ui.polygon;
  holding.sort((a, b) => a.area - b.area);
  return holding[0]?.name ?? null;
}

/** Deletes the sample chosen, else that at the crosshair. */
export function deleteSample() {
  const pane = activePane();
  const sample =
    samples().find(one => one.key === ui.sample) ?? sampleAt(pane, pane.cursor.x, pane.cursor.y);
  if (!sample) return say(t("noSample"));
  ui.sample = null;
  edit(t("opDeleteSample", {photo: sample.row.photo}), [
    {table: sample.kind, before: sample.row, after: null}
  ]);
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
    list: "card-names",
    autocomplete: "off",
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
      button(t("deleteSample"), deleteSample, {title: "Del"})
    ),
    labelled(t("reflectance"), card),
    node("datalist", {id: "card-names"}),
    node("div", {id: "light-about"})
  );
  drawn = "";
}

/** Entries of the library whose reflectance is known by wavelength. */
const tables = () => library().filter(one => one.has_table);

/** The reflectance of the daylight samples' material: three numbers, one for grey, or a name of the library. */
function takeCard(field) {
  const text = field.value.trim(),
    old = rows("light")[0] ?? null;
  const {daylight_reflectance_rgb: _, daylight_material: __, ...rest} = old ?? {};
  const take = said => edit(t("opCard"), [{table: "light", before: old, after: {...rest, ...said}}]);
  if (text === "") return take({});
  if (tables().some(one => one.name === text)) return take({daylight_material: text});
  const values = text.split(/[\s;]+/).map(parseNumber);
  const isFine = value => value !== null && value > 0 && value <= 1;
  if (![1, 3].includes(values.length) || !values.every(isFine)) return say(t("badNumber", {text}));
  take({daylight_reflectance_rgb: values.length === 1 ? Array(3).fill(values[0]) : values});
}

const cardText = light => light.daylight_material ?? (light.daylight_reflectance_rgb ?? []).join(" ");

let drawn = "";
export function updateLightPanel() {
  const card = byId("card"),
    about = byId("light-about");
  const signature = JSON.stringify([
    state.light,
    isLightAwaited(),
    rows("light"),
    library().length,
    ...["horizon", "haze", "daylight"].map(kind => rows(kind).length)
  ]);
  if (!about || drawn === signature) return;
  drawn = signature;
  if (document.activeElement !== card)
    card.value = cardText(rows("light")[0] ?? {});
  byId("card-names").replaceChildren(...entryOptions(tables()));
  drawLightReport(about);
}

export function addLightKeys() {
  addAction({id: "horizon", key: "H", run: () => takeSamples("horizon")});
  addAction({id: "haze", key: "J", run: () => takeSamples("haze")});
  addAction({id: "daylight", key: "O", run: () => takeSamples("daylight")});
}
