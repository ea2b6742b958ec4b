// SPDX-License-Identifier: GPL-3.0-or-later
// Control and check points as a table: typed, or pasted from a spreadsheet.

import {ask} from "./api.js";
import {button, byId, dialog, node, select, table} from "./dom.js";
import {edit, freeName, isReadOnly, nameFault, row, rows} from "./state.js";
import {say} from "./notices.js";
import {parseNumber} from "./numbers.js";
import {t} from "./words.js";

const kFields = ["x", "y", "z", "sigma_x", "sigma_y", "sigma_z"];

export function showControlTable() {
  const pasted = node("textarea", {
    id: "pasted",
    rows: "4",
    "aria-label": t("paste"),
    placeholder: t("paste"),
    spellcheck: "false"
  });
  const found = node("div", {id: "import-found"});
  pasted.addEventListener("input", () => read(pasted.value, found));
  dialog(
    t("controlTable"),
    [
      node("p", {class: "faint", text: t("controlNote")}),
      node("div", {id: "control-rows", class: "scroll"}),
      node("h3", {text: t("paste")}),
      pasted,
      found
    ],
    t("close")
  );
  draw();
}

function draw() {
  const body = [...rows("control_points").map(line), newLine()];
  byId("control-rows")?.replaceChildren(
    table([t("point"), "x [m]", "y [m]", "z [m]", "σx", "σy", "σz", t("role"), ""], body, "control")
  );
}

/**
 * @param {any} value
 * @param {string} label
 * @param {(text: string) => void} changed
 */
const cellInput = (value, label, changed) =>
  node("input", {
    type: "text",
    inputmode: label === t("point") ? "text" : "decimal",
    value: value ?? "",
    "aria-label": label,
    autocomplete: "off",
    onchange: event => changed(event.target.value)
  });

/** One point's fields; what is typed goes at once. */
function line(one) {
  const change = changes => {
    if (isReadOnly("control_points")) return say(t("readOnlyTable"));
    const old = row("control_points", one.name);
    if (!old) return;
    edit(t("opControl", {point: one.name}), [
      {table: "control_points", before: old, after: {...old, ...changes}}
    ]);
    if (changes.role) draw();
  };
  const numbers = kFields.map(field => {
    const input = cellInput(row("control_points", one.name)?.[field], `${one.name} ${field}`, text => {
      const value = parseNumber(text),
        isBad = value === null || (field.startsWith("sigma") && !(value > 0));
      input.setAttribute("aria-invalid", String(isBad));
      if (isBad) say(t("badNumber", {text}));
      else change({[field]: value});
    });
    return input;
  });
  const role = select(
    [
      ["control", t("control")],
      ["check", t("check")]
    ],
    one.role ?? "control",
    value => change({role: value}),
    {"aria-label": `${one.name} ${t("role")}`}
  );
  return [
    one.name,
    ...numbers,
    role,
    button(
      t("delete"),
      () => {
        const old = row("control_points", one.name);
        if (old)
          edit(t("opDeleteControl", {point: one.name}), [
            {table: "control_points", before: old, after: null}
          ]);
        draw();
      },
      {class: "small"}
    )
  ];
}

/** Fields of a point that is not there yet. */
function newLine() {
  const fields = ["name", ...kFields].map(field =>
    node("input", {
      type: "text",
      id: `new-${field}`,
      autocomplete: "off",
      inputmode: field === "name" ? "text" : "decimal",
      "aria-label": field === "name" ? t("point") : field,
      value: field.startsWith("sigma") ? "0.01" : "",
      placeholder: field === "name" ? freeName("c") : ""
    })
  );
  const role = select(
    [
      ["control", t("control")],
      ["check", t("check")]
    ],
    "control",
    () => {},
    {id: "new-role", "aria-label": t("role")}
  );
  return [...fields, role, button(t("add"), () => addNew(), {class: "small", id: "new-add"})];
}

function addNew() {
  const name = byId("new-name").value.trim() || byId("new-name").placeholder,
    fault = nameFault(name);
  if (fault || row("control_points", name)) return say(t(fault || "taken", {name}));
  /** @type {Record<string, any>} */
  const after = {name};
  for (const field of kFields) {
    const input = byId(`new-${field}`);
    after[field] = parseNumber(input.value);
    const isBad = after[field] === null || (field.startsWith("sigma") && !(after[field] > 0));
    input.setAttribute("aria-invalid", String(isBad));
    if (isBad) return input.focus();
  }
  after.role = byId("new-role").value;
  edit(t("opControl", {point: name}), [{table: "control_points", before: null, after}]);
  draw();
  byId("new-name").focus();
}

/** Asks the server's readers what the pasted text says, and offers to take it. */
async function read(text, found) {
  if (text.trim() === "") return found.replaceChildren();
  const answer = await ask("/api/import", {text, apply: false});
  if (byId("pasted")?.value !== text) return;
  if (answer.error) return found.replaceChildren(node("p", {class: "fail", text: answer.error}));
  const taken = answer.rows.filter(one => row("control_points", one.name)).length;
  found.replaceChildren(
    node("p", {text: t("importFound", {n: answer.rows.length, format: answer.format ?? "", taken})}),
    ...(answer.remarks ?? []).map(remark => node("p", {class: "review", text: remark.text ?? remark})),
    node(
      "div",
      {class: "scroll short"},
      table(
        [t("point"), "x", "y", "z", t("role")],
        answer.rows.map(one => [
          one.name,
          String(one.x),
          String(one.y),
          String(one.z),
          one.role ?? "control"
        ])
      )
    ),
    button(t("takeOver"), () => takeOver(answer.rows), {class: "main", id: "take-over"})
  );
}

function takeOver(all) {
  if (isReadOnly("control_points")) return say(t("readOnlyTable"));
  edit(
    t("opImport", {n: all.length}),
    all.map(one => {
      const old = row("control_points", one.name) ?? null;
      return {table: "control_points", before: old, after: {...old, ...one}};
    })
  );
  byId("pasted").value = "";
  byId("import-found").replaceChildren(node("p", {class: "pass", text: t("imported", {n: all.length})}));
  draw();
}
