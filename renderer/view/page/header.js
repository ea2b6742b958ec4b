// SPDX-License-Identifier: GPL-3.0-or-later
// What is compared, and how.

import {
  choose,
  photo,
  pictureName,
  rightPicture,
  leftPicture,
  showDifference,
  shown,
  showPhoto,
  state
} from "./state.js";
import {button, byId, dialog, node, select, table} from "../../prepare/page/words/dom.js";
import {emit, on} from "../../prepare/page/site/signals.js";
import {kLanguages, language, setLanguage} from "../../prepare/page/words/language.js";
import {outlineText} from "./outline.js";
import {say} from "./renders.js";
import {setMode} from "./stage.js";
import {shown as number} from "../../prepare/page/words/numbers.js";
import {t} from "./words/view_words.js";

/** @type {("side"|"slider"|"flicker")[]} */
const kModes = ["side", "slider", "flicker"];

export function toggleOutline() {
  shown.isOutline = !shown.isOutline;
  if (!shown.isOutline) say("");
  emit("view");
}

export async function toggleDifference() {
  if (shown.difference) {
    shown.difference = null;
    say("");
    return emit("pictures");
  }
  const fault = await showDifference();
  if (fault) return say(fault);
  const {differing, of, most} = shown.difference?.summary ?? {};
  say(
    t("differs", {n: number(differing, 0), share: number((100 * differing) / of, 2), most: number(most, 1)})
  );
}

/** @param {any[]} actions with `id` and `key` */
export function showHelp(actions) {
  const rows = actions.map(action => [action.key, t(`key_${action.id}`)]);
  rows.splice(-1, 0, ["← → ↑ ↓", t("key_arrows")]);
  dialog(t("help"), [table([t("key"), t("does")], rows, "keys")], t("close"));
}

const optionsOf = side => {
  const pictures = photo()?.pictures ?? [];
  return select(
    pictures.map(one => [String(one.id), pictureName(one)]),
    String(shown[side]),
    id => choose(side, Number(id)),
    {id: `choose-${side}`, "aria-label": t(side)}
  );
};

const toggle = (id, text, isOn, action) =>
  button(text, action, {id, "aria-pressed": String(isOn)});

let drawn = "";

/** Anew only when something in it is another one, so that the focus stays. */
function draw(showKeys) {
  const signature = JSON.stringify([shown.photo, shown.left, shown.right, shown.mode, shown.isAuto,
    shown.isOutline, shown.difference?.id, photo()?.pictures.map(one => [one.id, one.name])]);
  if (signature === drawn) return;
  drawn = signature;
  const focused = document.activeElement?.id;
  byId("top").replaceChildren(
    node("strong", {text: state.name}),
    node(
      "label",
      {},
      `${t("photo")} `,
      select(state.photos.map(one => [one.name, one.name]), shown.photo, showPhoto, {id: "choose-photo"})
    ),
    node("label", {}, `${t("left")} `, optionsOf("left")),
    node("label", {}, `${t("right")} `, optionsOf("right")),
    node(
      "nav",
      {"aria-label": t("compare")},
      ...kModes.map(mode =>
        toggle(`mode-${mode}`, t(`mode_${mode}`), shown.mode === mode, () => setMode(mode))
      )
    ),
    toggle("outline", t("outline"), shown.isOutline, toggleOutline),
    toggle("difference", t("difference"), shown.difference !== null, toggleDifference),
    button(t("help"), showKeys, {id: "help"}),
    select(kLanguages, language, setLanguage, {id: "language", "aria-label": t("language")})
  );
  if (focused) byId(focused)?.focus();
}

/** What is wrong, and what is to be known of the outline. */
function drawNotes() {
  const left = leftPicture(),
    right = rightPicture();
  const isOtherGrid = left && right && (left.width !== right.width || left.height !== right.height || left.frame !== right.frame);
  const texts = [
    state.fault,
    photo()?.fault,
    left?.fault,
    right?.fault,
    state.isConnected ? "" : t("serverGone"),
    isOtherGrid ? t("otherGrid") : ""
  ].filter(Boolean);
  const banners = byId("banners");
  if (banners.textContent !== texts.join(""))
    banners.replaceChildren(...texts.map(text => node("p", {class: "banner", text})));
  if (shown.isOutline && right) say(outlineText(right.frame ?? "photo"));
}

/** @param {() => void} showKeys */
export function buildHeader(showKeys) {
  on("draw", () => {
    draw(showKeys);
    drawNotes();
  });
}
