// SPDX-License-Identifier: GPL-3.0-or-later
// Renders, whoever began them: how far they are; those of this page begun, stopped, gone on with.

import {photoOf, shown, showPhoto, state} from "./state.js";
import {button, byId, node, select} from "../../prepare/page/words/dom.js";
import {ask} from "../../prepare/page/site/api.js";
import {emit, on} from "../../prepare/page/site/signals.js";
import {t} from "./words/view_words.js";

const kStopped = 3; // insitu-render's status
let quality = "final";

export function say(text) {
  byId("say").textContent = text;
}

async function run(photo) {
  state.lines = [];
  const frame = photoOf(photo)?.pictures.find(one => one.kind === "montage" && one.name === "")?.frame;
  const answer = await ask("/api/run", {photo, quality, frame: frame ?? "photo"});
  if (answer.error) return say(answer.error);
  state.running = photo;
  emit("render");
}

async function stop() {
  const answer = await ask("/api/stop", {});
  if (answer.error) say(answer.error);
}

/** Begins, goes on or stops, whatever is next for the photograph that is shown. */
export function runOrStop() {
  if (state.isStream) return;
  if (state.running !== "") stop();
  else run(shown.photo);
}

/** What the button that begins a render is called. */
const verb = photo =>
  photo.render.state === "waiting"
    ? "resume"
    : photo.pictures.some(one => one.kind === "montage" && one.name === "")
      ? "again"
      : "render";

function row(photo) {
  const {state: is, done, total} = photo.render;
  const isOurs = state.running === photo.name;
  return node(
    "li",
    {class: photo.name === shown.photo ? "current" : "", data: {photo: photo.name, state: is}},
    button(photo.name, () => showPhoto(photo.name), {class: "name"}),
    state.isStream
      ? null
      : isOurs
      ? button(t("stop"), stop, {class: "small stop"})
      : button(t(verb(photo)), () => run(photo.name), {
          class: "small run",
          disabled: is === "running" || state.running !== ""
        }),
    total === undefined
      ? null
      : node(
          "div",
          {},
          node("progress", {max: String(total), value: done}),
          node("span", {text: `${t(`state_${is}`)}, ${t("tiles", {done, total})}`})
        )
  );
}

function draw() {
  const list = byId("renders");
  if (!list) return;
  const focused = document.activeElement?.closest("#renders li"),
    name = focused instanceof HTMLElement ? focused.dataset.photo : undefined,
    isName = document.activeElement?.classList.contains("name");
  list.replaceChildren(...state.photos.map(row));
  if (name === undefined) return;
  const again = [...list.children].find(one => one.dataset.photo === name);
  again?.querySelector(isName ? "button.name" : "button:not(.name)")?.focus();
}

/** What insitu-render says when it ends. */
function ended(status) {
  const photo = state.running;
  state.running = "";
  const why = state.lines.at(-1) ?? String(status);
  say(
    status === 0
      ? t("runEnded", {photo})
      : status === kStopped
        ? t("runStopped", {photo})
        : t("runFailed", {photo, why})
  );
  document.body.dataset.ended = String(status);
  emit("render");
}

export function buildRenders() {
  byId("side").append(
    node("h2", {text: t("renders")}),
    node("ul", {id: "renders"}),
    node(
      "label",
      {class: "field", hidden: state.isStream},
      node("span", {text: t("quality")}),
      select(
        [
          ["fast", t("quality_fast")],
          ["draft", t("quality_draft")],
          ["final", t("quality_final")]
        ],
        quality,
        chosen => {
          quality = chosen;
        },
        {id: "quality"}
      )
    )
  );
  on("run", message => {
    if (message.line !== undefined) state.lines.push(message.line);
    if (message.status !== undefined) ended(message.status);
  });
  on("draw", draw);
}
