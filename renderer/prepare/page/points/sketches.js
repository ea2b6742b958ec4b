// SPDX-License-Identifier: GPL-3.0-or-later
// Point sketches to print: of every control point a crop of each photo, its coordinates and a note.

import {getBlob} from "../site/api.js";
import {button, byId, node} from "../words/dom.js";
import {edit, mark, prediction, rows, state} from "../site/state.js";
import {shown} from "../words/numbers.js";
import {activePane} from "../site/ui.js";
import {t} from "../words/words.js";

const kRadius = 60,
  kScale = 3;

export function showSketches() {
  byId("sketches")?.remove();
  const sheet = node(
    "section",
    {id: "sketches", "aria-label": t("sketches")},
    node(
      "p",
      {class: "buttons no-print"},
      button(t("print"), () => print(), {class: "main"}),
      button(t("close"), () => {
        sheet.remove();
        document.body.classList.remove("sketching");
        activePane()?.focus();
      })
    ),
    node("h1", {text: `${state.name}: ${t("sketches")}`}),
    ...rows("control_points").map(sketch)
  );
  document.body.append(sheet);
  document.body.classList.add("sketching");
  sheet.querySelector("button").focus();
}

/** @param {any} point */
function sketch(point) {
  const note = node("input", {
    type: "text",
    value: point.note ?? "",
    "aria-label": `${point.name} ${t("note")}`,
    placeholder: t("note")
  });
  note.addEventListener("change", () => {
    const old = rows("control_points").find(one => one.name === point.name);
    if (old)
      edit(t("opNote", {point: point.name}), [
        {table: "control_points", before: old, after: {...old, note: note.value}}
      ]);
  });
  const crops = state.photos
    .map((photo, index) => ({
      photo,
      index,
      at: mark(photo.name, point.name) ?? prediction(photo.name, point.name)
    }))
    .filter(one => one.at)
    .map(one => crop(one.photo, one.index, one.at, Boolean(mark(one.photo.name, point.name))));
  return node(
    "article",
    {},
    node("h2", {text: `${point.name} (${t(point.role === "check" ? "check" : "control")})`}),
    node("p", {
      text: ["x", "y", "z"]
        .map(axis => `${axis} ${shown(point[axis], 3)} ± ${shown(point[`sigma_${axis}`], 3)} m`)
        .join("   ")
    }),
    note,
    node("div", {class: "crops"}, ...crops)
  );
}

function crop(photo, index, at, isMarked) {
  const side = (2 * kRadius + 1) * kScale,
    canvas = node("canvas", {role: "img", "aria-label": photo.name});
  canvas.width = canvas.height = side;
  paint(canvas, index, at, side);
  return node(
    "figure",
    {},
    canvas,
    node("figcaption", {
      text:
        `${photo.name}  x ${shown(at.x, 2)}  y ${shown(at.y, 2)}` +
        (isMarked ? "" : ` (${t("prediction")})`)
    })
  );
}

async function paint(canvas, index, at, side) {
  const x = Math.round(at.x),
    y = Math.round(at.y),
    context = canvas.getContext("2d");
  try {
    const image = await createImageBitmap(
      await getBlob(`/api/patch?photo=${index}&x=${x}&y=${y}&r=${kRadius}`)
    );
    context.imageSmoothingEnabled = false;
    context.drawImage(image, 0, 0, side, side);
  } catch {
    context.fillText("–", side / 2, side / 2);
  }
  const cx = (at.x - x + kRadius + 0.5) * kScale,
    cy = (at.y - y + kRadius + 0.5) * kScale;
  for (const [colour, width] of [
    ["#000", 5],
    ["#fff", 2]
  ]) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.arc(cx, cy, 18, 0, 2 * Math.PI);
    for (const [dx, dy] of [
      [1, 0],
      [-1, 0],
      [0, 1],
      [0, -1]
    ]) {
      context.moveTo(cx + 6 * dx, cy + 6 * dy);
      context.lineTo(cx + 30 * dx, cy + 30 * dy);
    }
    context.stroke();
  }
}
