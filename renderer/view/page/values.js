// SPDX-License-Identifier: GPL-3.0-or-later
// What both pictures hold under the cursor, in linear light and as encoded.

import {leftPicture, rightPicture, shown} from "./state.js";
import {byId} from "../../prepare/page/words/dom.js";
import {getJson} from "../../prepare/page/site/api.js";
import {on} from "../../prepare/page/site/signals.js";
import {shown as number} from "../../prepare/page/words/numbers.js";
import {t} from "./words/view_words.js";

const kAfterMs = 40; // a moving cursor asks for its place alone

let asked = 0,
  timer = 0;

const codes = values => values.map(value => number(255 * value, 0)).join(" ");

const thingsOf = things =>
  things.map(thing => `${thing.name} ${number(thing.share, 3)}`).join(", ") || "–";

/** One picture's words. */
function textOf(value) {
  if (!value) return "–";
  if (value.unfinished) return t("unfinished");
  if (value.things) return thingsOf(value.things);
  if (value.values) return value.values.map(one => number(one, 4)).join(" ");
  if (value.share !== undefined) return `${t("share")} ${number(value.share, 3)}`;
  const linear = `${t("linear")} ${value.linear.map(one => number(one, 4)).join(" ")}`;
  if (value.codes) return `${linear}  Δ ${value.codes.map(one => number(one, 1)).join(" ")}`;
  const isClipped = value.encoded.some(one => one >= 1);
  return `${linear}  ${t("encoded")} ${codes(value.encoded)}${isClipped ? ` (${t("clipped")})` : ""}`;
}

async function valueOf(picture) {
  if (!picture || picture.fault !== undefined) return null;
  const {x, y} = shown.cursor;
  if (x >= picture.width || y >= picture.height) return null;
  return getJson(`/api/value?photo=${picture.id}&x=${x}&y=${y}`).catch(() => null);
}

async function show() {
  const mine = (asked += 1),
    {x, y} = shown.cursor;
  const [left, right] = await Promise.all([valueOf(leftPicture()), valueOf(rightPicture())]);
  if (mine !== asked) return;
  const where = byId("where");
  where.textContent = `x ${x} y ${y}   ${t("before")}: ${textOf(left)}   ${t("after")}: ${textOf(right)}`;
  where.dataset.values = JSON.stringify({x, y, left, right});
}

export function followCursor() {
  on("cursor photo pictures render", () => {
    clearTimeout(timer);
    timer = window.setTimeout(show, kAfterMs);
  });
}
