// SPDX-License-Identifier: GPL-3.0-or-later
// What the samples say of the light, as tables: haze, daylight, samples left out, advice.

import {node} from "../words/dom.js";
import {shown, withSigma} from "../words/numbers.js";
import {isLightAwaited, rows, state} from "../site/state.js";
import {nearPlace, said, t} from "../words/words.js";

const kPoorCondition = 100,
  kPoorFit = 3; // in σ

/**
 * A linear colour as the screen shows it, the brightest part at most white.
 * @param {number[]} rgb
 */
export function screenColour(rgb) {
  const scale = Math.max(1, ...rgb);
  const encode = value =>
    Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
  return `rgb(${rgb.map(value => encode(Math.max(0, value) / scale)).join()})`;
}

function swatch(rgb) {
  const made = node("span", {class: "swatch"});
  made.style.background = screenColour(rgb);
  return made;
}

const isColour = rgb => Array.isArray(rgb) && rgb.length === 3;

/**
 * A colour's line: swatch, three numbers; `sigma`: of each of them, "" where it is not known.
 * @param {string} name
 * @param {any} rgb
 * @param {number|string} [sigma]
 */
function colourLine(name, rgb, sigma) {
  if (!isColour(rgb)) return null;
  const digits = Math.max(...rgb) >= 2 ? 2 : 3;
  return node(
    "tr",
    {},
    node("th", {scope: "row"}, swatch(rgb), t(name)),
    ...rgb.map(value => node("td", {text: shown(value, digits)})),
    sigma === undefined ? null : node("td", {text: sigma === "" ? "" : shown(sigma, 3)})
  );
}

const colourTable = (head, ...lines) =>
  node(
    "table",
    {class: "light"},
    node("thead", {}, node("tr", {}, ...head.map(text => node("th", {text})))),
    node("tbody", {}, ...lines)
  );

/** Condition and RMS, coloured where they are poor. */
function quality(about) {
  const parts = [];
  if (typeof about.condition === "number")
    parts.push([
      t("condition", {value: shown(about.condition, about.condition < 10 ? 1 : 0)}),
      about.condition > kPoorCondition
    ]);
  if (typeof about.rms_over_sigma === "number")
    parts.push([t("rmsSigma", {value: shown(about.rms_over_sigma, 1)}), about.rms_over_sigma > kPoorFit]);
  return node(
    "p",
    {class: "quality"},
    ...parts.map(([text, isPoor]) => node("span", {class: isPoor ? "review" : "faint", text}))
  );
}

const heading = (kind, ...rest) =>
  node(
    "h3",
    {},
    t(kind),
    node("span", {class: "faint", text: ` ${t("count", {n: rows(kind).length})}`}),
    ...rest
  );

function hazeOf(haze) {
  const isClear = haze.transmittance_100m_sigma === undefined;
  return [
    colourTable(
      ["", "R", "G", "B", "±"],
      colourLine("horizon", haze.horizon_rgb, ""),
      colourLine("through100", haze.transmittance_100m_rgb, haze.transmittance_100m_sigma ?? "")
    ),
    isClear ? node("p", {class: "faint", text: t("airClear")}) : quality(haze)
  ];
}

/** One weight: its symbol, what it is of, value ± σ; of what the photographs show, no σ. */
function weightLine(letter, name, weight) {
  if (typeof weight?.value !== "number") return null;
  const [value, sigma] = withSigma(weight.value, weight.sigma),
    isAdjusted = weight.sigma > 0;
  return node(
    "tr",
    {title: t(isAdjusted ? "weightNote" : "asPhotographedNote")},
    node("th", {scope: "row"}, "k", node("sub", {text: letter}), ` ${t(name)}`),
    node("td", {text: value}),
    node("td", {text: isAdjusted ? `± ${sigma}` : t("asPhotographed")})
  );
}

function daylightOf(daylight) {
  const isKnown = daylight.reflectance_known;
  return [
    node(
      "table",
      {class: "light weights"},
      node(
        "tbody",
        {},
        weightLine("s", "lightSun", daylight.k_s),
        weightLine("h", "lightSky", daylight.k_h),
        weightLine("u", "lightAmbient", daylight.k_u)
      )
    ),
    colourTable(
      ["", "R", "G", "B"],
      colourLine("sunIrradiance", daylight.sun_irradiance_rgb),
      colourLine("openSky", daylight.open_sky_radiance_rgb)
    ),
    quality(daylight),
    node("p", {
      class: isKnown ? "faint" : "review",
      text: t(isKnown ? "reflectanceKnown" : "reflectanceUnknown")
    })
  ];
}

function textList(title, texts, className) {
  if (texts.length === 0) return [];
  return [
    node("h3", {text: `${t(title)} (${texts.length})`}),
    node("ul", {class: className}, ...texts.map(text => node("li", {text})))
  ];
}

/**
 * All of it into an element.
 * @param {any} root
 */
export function drawLightReport(root) {
  const light = state.light;
  const leftOut = (light?.left_out ?? []).map(one => nearPlace(said(one))),
    advice = (light?.advice ?? []).map(one => said(one));
  root.replaceChildren(
    node("p", {class: "faint soon", hidden: !isLightAwaited(), text: t("lightSoon")}),
    ...(light?.failed ? [node("p", {class: "review", text: nearPlace(said(light, "failed"))})] : []),
    heading("haze"),
    ...(light?.haze ? hazeOf(light.haze) : []),
    heading("daylight"),
    ...(light?.daylight ? daylightOf(light.daylight) : []),
    ...textList("leftOutHead", leftOut, "left-out"),
    ...textList("advice", advice, "advice")
  );
}
