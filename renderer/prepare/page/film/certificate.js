// SPDX-License-Identifier: GPL-3.0-or-later
// The calibration certificate of a film camera, typed as it is printed: all in millimetres.

import {certified} from "./certified.js";
import {placeFiducials} from "./fiducials.js";
import {say} from "../around/notices.js";
import {edit, isReadOnly, nameFault, row, rows} from "../site/state.js";
import {button, byId, dialog, labelled, node, select, table} from "../words/dom.js";
import {parseNumber} from "../words/numbers.js";
import {t} from "../words/words.js";

const kMostOfRadius = 0.1; // a distortion above this part of its radius is a slip of columns or units

const film = () => rows("film")[0] ?? null;

/** Says why nothing was taken, at the field. */
function refuse(field, text) {
  field.setAttribute("aria-invalid", "true");
  const told = byId("certificate-says");
  if (told) told.textContent = text;
  say(text);
}

function accept(field) {
  field.setAttribute("aria-invalid", "false");
  const told = byId("certificate-says");
  if (told) told.textContent = "";
  say("");
}

/** @param {Record<string, any>} changes members of film.json */
function change(changes) {
  if (isReadOnly("film")) return say(t("readOnlyTable"));
  const before = film(),
    after = {...before, ...changes};
  for (const [name, value] of Object.entries(changes)) if (value === null) delete after[name];
  edit(t("opCertificate"), [{table: "film", before, after}]);
}

const input = (value, more = {}) =>
  node("input", {type: "text", inputmode: "decimal", autocomplete: "off", value: value ?? "", ...more});

/** The principal distance. */
function focalField() {
  const field = input(film()?.focal_mm, {id: "film-focal"});
  field.addEventListener("change", () => {
    const value = parseNumber(field.value);
    if (value === null || !(value > 0)) return refuse(field, t("badNumber", {text: field.value}));
    accept(field);
    change({focal_mm: value});
  });
  return labelled(t("principalDistance"), field);
}

/** The principal point, one coordinate a field. */
function pointFields() {
  const point = film()?.principal_point_mm ?? ["", ""];
  const fields = ["x", "y"].map((axis, i) => input(point[i], {id: `film-point-${axis}`}));
  const taken = () => {
    const texts = fields.map(field => field.value.trim());
    if (texts.every(text => text === "")) return change({principal_point_mm: null});
    const values = texts.map(text => (text === "" ? 0 : parseNumber(text)));
    const bad = values.indexOf(null);
    if (bad >= 0) return refuse(fields[bad], t("badNumber", {text: texts[bad]}));
    fields.forEach(accept);
    change({principal_point_mm: values});
  };
  return fields.map((field, i) => {
    field.addEventListener("change", taken);
    return labelled(t(i === 0 ? "principalX" : "principalY"), field);
  });
}

const mapSelect = () =>
  labelled(
    t("filmMap"),
    select(
      ["affine", "projective"].map(kind => /** @type {[string, string]} */ ([kind, t(kind)])),
      film()?.transformation ?? "affine",
      transformation => change({transformation}),
      {id: "film-transformation"}
    )
  );

// ---- fiducial marks --------------------------------------------------------------------------

/** Edits that make the certificate list all its marks, where an older one lists none. */
const listedEdits = () =>
  rows("film_marks").length > 0
    ? []
    : [...certified().values()].map(after => ({table: "film_marks", before: null, after}));

/** New marks, or other millimetres of known ones, wherever they stand. */
function takeMarks(marks) {
  if (isReadOnly("film_marks") || isReadOnly("fiducials")) return say(t("readOnlyTable"));
  const isListed = rows("film_marks").length > 0,
    isNew = marks.some(({mark}) => !certified().has(mark));
  const edits = isListed || !isNew ? [] : listedEdits();
  for (const one of marks) {
    const listed = row("film_marks", one.mark) ?? null;
    const made = edits.find(each => each.after.mark === one.mark);
    if (made) made.after = {...made.after, ...one};
    else if (isListed || isNew) edits.push({table: "film_marks", before: listed, after: {...listed, ...one}});
    for (const before of rows("fiducials").filter(each => each.mark === one.mark))
      edits.push({table: "fiducials", before, after: {...before, x_mm: one.x_mm, y_mm: one.y_mm}});
  }
  edit(t("opFiducials", {n: marks.length}), edits);
  drawMarks();
}

function deleteMarkOf(mark) {
  if (isReadOnly("film_marks") || isReadOnly("fiducials")) return say(t("readOnlyTable"));
  const gone = (name, all) => all.map(before => ({table: name, before, after: null}));
  edit(t("opDeleteFiducial", {name: mark}), [
    ...gone("film_marks", rows("film_marks").filter(one => one.mark === mark)),
    ...gone("fiducials", rows("fiducials").filter(one => one.mark === mark))
  ]);
  drawMarks();
}

function markLine(one) {
  const fields = ["x_mm", "y_mm"].map(axis => {
    const field = input(one[axis], {"aria-label": `${one.mark} ${axis}`});
    field.addEventListener("change", () => {
      const value = parseNumber(field.value);
      if (value === null) return refuse(field, t("badNumber", {text: field.value}));
      accept(field);
      takeMarks([{...certified().get(one.mark), [axis]: value}]);
    });
    return field;
  });
  return [one.mark, ...fields, button(t("delete"), () => deleteMarkOf(one.mark), {class: "small"})];
}

function newLine() {
  const name = input("", {id: "film-mark", inputmode: "text", placeholder: String(certified().size + 1)});
  const fields = ["x_mm", "y_mm"].map(axis => input("", {id: `film-${axis}`, "aria-label": axis}));
  const add = () => {
    const mark = name.value.trim() || name.placeholder,
      fault = nameFault(mark),
      values = fields.map(field => parseNumber(field.value));
    if (fault || certified().has(mark)) return refuse(name, t(fault || "taken", {name: mark}));
    const bad = values.indexOf(null);
    if (bad >= 0) return refuse(fields[bad], t("badNumber", {text: fields[bad].value}));
    accept(name);
    takeMarks([{mark, x_mm: values[0], y_mm: values[1]}]);
    byId("film-mark")?.focus();
  };
  for (const field of [name, ...fields])
    field.addEventListener("keydown", event => {
      if (event.key === "Enter") add();
    });
  return [name, ...fields, button(t("add"), add, {class: "small", id: "film-mark-add"})];
}

function drawMarks() {
  const root = byId("film-mark-rows");
  root?.replaceChildren(
    table(
      [t("fiducial"), "x [mm]", "y [mm]", ""],
      [...[...certified().values()].map(markLine), newLine()],
      "control"
    )
  );
}

/**
 * Lines of numbers as a certificate or a spreadsheet has them; the first line at fault as a text.
 * @param {string} text
 * @param {number} count cells a line
 * @returns {string[][]|string}
 */
function cellsOf(text, count) {
  const lines = text.split("\n").map(line => line.trim()).filter(line => line !== "");
  const cells = lines.map(line => line.split(/[;\t]\s*|\s+/).filter(cell => cell !== ""));
  const bad = cells.findIndex(line => line.length !== count);
  return bad >= 0 ? lines[bad] : cells;
}

/** Marks pasted: name, x, y a line. */
function pasteField() {
  const field = node("textarea", {
    id: "film-paste",
    rows: "3",
    spellcheck: "false",
    "aria-label": t("pasteFiducials"),
    placeholder: t("pasteFiducials")
  });
  field.addEventListener("change", () => {
    if (field.value.trim() === "") return accept(field);
    const cells = cellsOf(field.value, 3);
    if (typeof cells === "string") return refuse(field, t("badLine", {text: cells}));
    const marks = cells.map(([mark, x, y]) => ({mark, x_mm: parseNumber(x), y_mm: parseNumber(y)}));
    const bad = marks.findIndex(one => nameFault(one.mark) || one.x_mm === null || one.y_mm === null);
    if (bad >= 0) return refuse(field, t("badLine", {text: cells[bad].join(" ")}));
    if (new Set(marks.map(one => one.mark)).size < marks.length) return refuse(field, t("marksTwice"));
    accept(field);
    field.value = "";
    takeMarks(marks);
  });
  return field;
}

// ---- distortion --------------------------------------------------------------------------------

/** One radius and its distortion a line. */
function distortionField() {
  const given = film()?.distortion ?? [];
  const field = node("textarea", {
    id: "film-distortion",
    rows: "5",
    spellcheck: "false",
    "aria-label": t("filmDistortion"),
    value: given.map(pair => pair.join("  ")).join("\n")
  });
  field.addEventListener("change", () => {
    if (field.value.trim() === "") return change({distortion: null});
    const cells = cellsOf(field.value, 2);
    if (typeof cells === "string") return refuse(field, t("badLine", {text: cells}));
    const values = cells.map(line => line.map(parseNumber));
    const fault = distortionFault(values);
    if (fault) return refuse(field, fault);
    accept(field);
    change({distortion: values});
  });
  return field;
}

/** @param {(number|null)[][]} values */
function distortionFault(values) {
  let last = 0;
  for (const [radius, distortion] of values) {
    const text = `${radius ?? "?"} ${distortion ?? "?"}`;
    if (radius === null || distortion === null) return t("badLine", {text});
    if (Math.abs(distortion) > kMostOfRadius * Math.abs(radius)) return t("distortionSlip", {text});
    if (!(radius > last)) return t("radiiRise", {text});
    last = radius;
  }
  return values.length < 2 ? t("twoRadii") : "";
}

export function showCertificate() {
  const made = dialog(
    t("certificate"),
    [
      node("p", {class: "faint narrow", text: t("certificateNote")}),
      node("div", {class: "row"}, focalField(), ...pointFields(), mapSelect()),
      node("p", {id: "certificate-says", class: "fail", "aria-live": "assertive"}),
      node("h3", {text: t("fiducials")}),
      node("div", {id: "film-mark-rows", class: "scroll"}),
      pasteField(),
      node("h3", {text: t("filmDistortion")}),
      node("p", {class: "faint narrow", text: t("distortionNote")}),
      distortionField()
    ],
    t("close")
  );
  made.addEventListener("close", placeFiducials);
  drawMarks();
}
