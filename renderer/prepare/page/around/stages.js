// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a site as runs of their programs: begun, followed, stopped.

import {ask} from "../site/api.js";
import {button, byId, dialog, node} from "../words/dom.js";
import {on} from "../site/signals.js";
import {say} from "./notices.js";
import {t} from "../words/words.js";

export const kStages = [
  "calibrate",
  "tie-points",
  "reconstruct",
  "undistort",
  "light",
  "convert",
  "render",
  "montage"
];
const kMostLines = 2000,
  kStopped = [143, 3]; // by SIGTERM; a render that keeps what it has

/** What the newest run has said. */
const run = {
  stage: "",
  status: "",
  progress: /** @type {number|null} */ (null),
  lines: /** @type {string[]} */ ([])
};

/** Asks before a camera is made of little more than nothing. */
function confirmExif() {
  const asked = dialog(
    t("exifCamera"),
    [
      node("p", {class: "narrow", text: t("exifCameraNote")}),
      button(
        t("firstLook"),
        () => {
          asked.close();
          begin("exif-camera");
        },
        {class: "main", id: "exif-confirm"}
      )
    ],
    t("cancel")
  );
}

/** @param {string} stage or what else /api/run does */
export function runStage(stage) {
  if (stage === "exif-camera") confirmExif();
  else begin(stage);
}

/** @param {string} stage */
async function begin(stage) {
  Object.assign(run, {stage, status: t("running"), progress: null, lines: []});
  showStages();
  const answer = await ask("/api/run", {stage, label: t(`stage_${stage}`)});
  if (answer.error) run.status = answer.error;
  else if (answer.run === 0) run.status = t("done"); // no program runs for it
  draw();
}

export function showStages() {
  if (byId("stage-log")) return draw();
  const stop = button(
    t("stop"),
    async () => {
      const answer = await ask("/api/stop", {});
      if (answer.error) say(answer.error);
    },
    {id: "stage-stop"}
  );
  dialog(
    t("stages"),
    [
      node(
        "div",
        {class: "buttons"},
        ...kStages.map(stage =>
          button(t(`stage_${stage}`), () => runStage(stage), {"data-stage": stage})
        ),
        stop
      ),
      node(
        "p",
        {},
        node("output", {id: "stage-status", "aria-live": "polite"}),
        node("progress", {id: "stage-progress", max: "1"})
      ),
      node("pre", {id: "stage-log", tabindex: "0"})
    ],
    t("close")
  );
  draw();
}

function draw() {
  if (!byId("stage-log")) return;
  byId("stage-status").textContent = run.stage ? `${t(`stage_${run.stage}`)}: ${run.status}` : "";
  const bar = byId("stage-progress");
  bar.hidden = run.progress === null;
  if (run.progress !== null) bar.value = run.progress;
  const log = byId("stage-log");
  log.textContent = run.lines.join("\n");
  log.scrollTop = log.scrollHeight;
}

export function followRuns() {
  on("run", message => {
    if (message.stage) run.stage = message.stage;
    if (message.line !== undefined) run.lines = [...run.lines.slice(1 - kMostLines), message.line];
    if (message.progress !== undefined) {
      run.progress = Number(message.progress);
      run.status = `${t("running")}, ${Math.round(100 * run.progress)} %`;
    }
    if (message.status !== undefined) {
      run.status =
        message.status === 0
          ? t("done")
          : kStopped.includes(message.status)
            ? t("stopped")
            : typeof message.status === "number"
              ? t("failed", {status: message.status})
              : String(message.status);
      run.progress = null;
      say(`${t(`stage_${run.stage}`)}: ${run.status}`);
    }
    draw();
  });
}
