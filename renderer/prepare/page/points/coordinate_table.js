// SPDX-License-Identifier: GPL-3.0-or-later
// Surveyed coordinates to be typed: a line a row, its numbers changed in place, and one line for a new row.

import {button, node, select, table} from "../words/dom.js";
import {say} from "../around/notices.js";
import {parseNumber} from "../words/numbers.js";
import {edit, isReadOnly, row, rows} from "../site/state.js";
import {t} from "../words/words.js";

const kFields = ["x", "y", "z", "sigma_x", "sigma_y", "sigma_z"];

/**
 * @typedef {object} Coordinates
 * @property {string} table
 * @property {string} key the field of the name
 * @property {string} head over the names
 * @property {string[]} roles the first is that of a new row
 * @property {string} changed text of the operation
 * @property {string} deleted text of the operation
 * @property {string} sigma of a new row [m]
 * @property {() => any} nameField of a new row, an element with a value
 * @property {(field: any) => string} nameFrom its name, "" if it is not to be taken
 */

const isBadFor = (field, value) => value === null || (field.startsWith("sigma") && !(value > 0));

const numberInput = (value, label, more = {}) =>
  node("input", {
    type: "text",
    inputmode: "decimal",
    value: value ?? "",
    "aria-label": label,
    autocomplete: "off",
    ...more
  });

const roleSelect = (what, value, chosen, label, more = {}) =>
  select(
    what.roles.map(role => /** @type {[string, string]} */ ([role, t(role)])),
    value,
    chosen,
    {"aria-label": label, ...more}
  );

/**
 * @param {Coordinates} what
 * @param {string} name
 * @param {Record<string, any>|null} changes null: delete
 */
function change(what, name, changes) {
  if (isReadOnly(what.table)) return say(t("readOnlyTable"));
  const before = row(what.table, name);
  if (!before) return;
  const label = t(changes ? what.changed : what.deleted, {name, point: name});
  edit(label, [{table: what.table, before, after: changes && {...before, ...changes}}]);
}

/** One row's fields; what is typed goes at once. */
function line(what, one, redraw) {
  const name = one[what.key];
  const numbers = kFields.map(field => {
    const input = numberInput(one[field], `${name} ${field}`);
    input.addEventListener("change", () => {
      const value = parseNumber(input.value);
      input.setAttribute("aria-invalid", String(isBadFor(field, value)));
      if (isBadFor(field, value)) say(t("badNumber", {text: input.value}));
      else change(what, name, {[field]: value});
    });
    return input;
  });
  const remove = () => {
    change(what, name, null);
    redraw();
  };
  const role = value => change(what, name, {role: value});
  return [
    name,
    ...numbers,
    roleSelect(what, one.role ?? what.roles[0], role, `${name} ${t("role")}`),
    button(t("delete"), remove, {class: "small"})
  ];
}

/** Fields of a row that is not there yet. */
function newLine(what, redraw) {
  const name = what.nameField();
  const inputs = kFields.map(field =>
    numberInput(field.startsWith("sigma") ? what.sigma : "", field, {
      id: `new-${what.table}-${field}`
    })
  );
  const role = roleSelect(what, what.roles[0], () => {}, t("role"));
  const add = () => {
    if (isReadOnly(what.table)) return say(t("readOnlyTable"));
    const taken = what.nameFrom(name);
    if (taken === "") return;
    const values = inputs.map(input => parseNumber(input.value));
    inputs.forEach((input, i) =>
      input.setAttribute("aria-invalid", String(isBadFor(kFields[i], values[i])))
    );
    const bad = inputs.find((_, i) => isBadFor(kFields[i], values[i]));
    if (bad) return bad.focus();
    const numbers = Object.fromEntries(kFields.map((field, i) => [field, values[i]]));
    const after = {[what.key]: taken, ...numbers, role: role.value};
    edit(t(what.changed, {name: taken, point: taken}), [{table: what.table, before: null, after}]);
    redraw();
  };
  return [name, ...inputs, role, button(t("add"), add, {class: "small", id: `new-${what.table}-add`})];
}

/**
 * Draws the table into an element, and again after rows have come or gone.
 * @param {any} root
 * @param {Coordinates} what
 */
export function drawCoordinates(root, what) {
  if (!root) return;
  const redraw = () => {
    drawCoordinates(root, what);
    root.querySelector("tr:last-child input, tr:last-child select")?.focus();
  };
  const lines = rows(what.table).map(one => line(what, one, redraw));
  root.replaceChildren(
    table(
      [what.head, "x [m]", "y [m]", "z [m]", "σx", "σy", "σz", t("role"), ""],
      [...lines, newLine(what, redraw)],
      "control"
    )
  );
}
