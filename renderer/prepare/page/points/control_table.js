// SPDX-License-Identifier: GPL-3.0-or-later
// Control and check points and surveyed camera positions as tables: typed, pasted from a spreadsheet, or
// of a file.

import {ask} from "../site/api.js";
import {drawCoordinates} from "./coordinate_table.js";
import {button, byId, dialog, labelled, node, select, table} from "../words/dom.js";
import {edit, freeName, isReadOnly, nameFault, row, rows, state} from "../site/state.js";
import {say} from "../around/notices.js";
import {formatText, said, t} from "../words/words.js";

/** @type {import("./coordinate_table.js").Coordinates} */
const kPoints = {
  table: "control_points",
  key: "name",
  get head() {
    return t("point");
  },
  roles: ["control", "check"],
  changed: "opControl",
  deleted: "opDeleteControl",
  sigma: "0.01",
  nameField: () =>
    node("input", {
      type: "text",
      id: "new-name",
      autocomplete: "off",
      "aria-label": t("point"),
      placeholder: freeName("c")
    }),
  nameFrom: field => {
    const name = field.value.trim() || field.placeholder,
      fault = nameFault(name);
    if (!fault && !row("control_points", name)) return name;
    say(t(fault || "taken", {name}));
    return "";
  }
};

/** @type {import("./coordinate_table.js").Coordinates} */
const kCameras = {
  table: "camera_positions",
  key: "photo",
  get head() {
    return t("photo");
  },
  roles: ["weighted", "fixed", "free"],
  changed: "opCamera",
  deleted: "opDeleteCamera",
  sigma: "0.02",
  nameField: () => {
    const names = state.photos.map(photo => photo.name).filter(name => !row("camera_positions", name));
    return select(
      names.map(name => /** @type {[string, string]} */ ([name, name])),
      names[0] ?? "",
      () => {},
      {"aria-label": t("photo")}
    );
  },
  nameFrom: field => field.value
};

const draw = () => drawCoordinates(byId("control-rows"), kPoints);

export function showControlTable() {
  const pasted = node("textarea", {
    id: "pasted",
    rows: "4",
    "aria-label": t("paste"),
    placeholder: t("paste"),
    spellcheck: "false"
  });
  const found = node("div", {id: "import-found"}),
    cameras = node("div", {id: "camera-rows", class: "scroll"});
  pasted.addEventListener("input", () => read(pasted.value, found));
  /** @param {File|undefined} file */
  const readFile = async file => {
    if (!file) return;
    pasted.value = decoded(new Uint8Array(await file.arrayBuffer()));
    read(pasted.value, found);
  };
  const chooser = node("input", {
    id: "import-file",
    type: "file",
    onchange: event => readFile(event.target.files[0])
  });
  pasted.addEventListener("dragover", event => event.preventDefault());
  pasted.addEventListener("drop", event => {
    if (event.dataTransfer.files.length === 0) return;
    event.preventDefault();
    readFile(event.dataTransfer.files[0]);
  });
  dialog(
    t("controlTable"),
    [
      node("p", {class: "faint", text: t("controlNote")}),
      node("div", {id: "control-rows", class: "scroll"}),
      node("h3", {text: t("paste")}),
      pasted,
      labelled(t("orFile"), chooser),
      found,
      node(
        "details",
        {open: rows("camera_positions").length > 0},
        node("summary", {text: t("cameraPositions")}),
        node("p", {class: "faint", text: t("cameraNote")}),
        cameras
      )
    ],
    t("close")
  );
  draw();
  drawCoordinates(cameras, kCameras);
}

/** A file's text: UTF-8 or UTF-16, else as older programs of Windows write. */
function decoded(bytes) {
  const utf16 = {"255,254": "utf-16le", "254,255": "utf-16be"}[bytes.subarray(0, 2).join()];
  if (utf16) return new TextDecoder(utf16).decode(bytes);
  try {
    return new TextDecoder("utf-8", {fatal: true}).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/** Asks the server's readers what the pasted text says, and offers to take it. */
async function read(text, found) {
  if (text.trim() === "") return found.replaceChildren();
  const answer = await ask("/api/import", {text, apply: false});
  if (byId("pasted")?.value !== text) return;
  if (answer.error) return found.replaceChildren(node("p", {class: "fail", text: answer.error}));
  const taken = answer.rows.filter(one => row("control_points", one.name)).length;
  found.replaceChildren(
    node("p", {text: t("importFound", {n: answer.rows.length, format: formatText(answer.format ?? "")})}),
    taken > 0 ? node("p", {class: "review", text: t("importTaken", {taken})}) : "",
    ...(answer.remarks ?? []).map(remark => node("p", {class: "review", text: said(remark)})),
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
