// SPDX-License-Identifier: GPL-3.0-or-later
// Sun pairs (object, then its shadow), zenith pairs (bottom, then top), marks on straight edges.

import {button, byId, node} from "../words/dom.js";
import {addAction} from "../around/keys.js";
import {marking} from "../points/marking.js";
import {say} from "../around/notices.js";
import {shown, stored} from "../words/numbers.js";
import {nearestEdge} from "./outlines.js";
import {pointTool} from "./pickers.js";
import {edit, isReadOnly, row, rows, state} from "../site/state.js";
import {activePane, placeOf, setMode, setTool, ui} from "../site/ui.js";
import {t} from "../words/words.js";

/**
 * Begins a pair; when it is made the next one begins.
 * @param {"sun"|"zenith"} kind
 */
export function drawPair(kind) {
  if (isReadOnly(kind)) return say(t("readOnlyTable"));
  setMode("sun");
  const [first, second] = kind === "sun" ? ["object", "shadow"] : ["bottom", "top"];
  setTool(
    pointTool({
      name: `${kind}Pair`,
      wanted: [first, second].map(one => `pick_${one}`),
      count: 2,
      done: names => {
        const after = {[first]: names[0], [second]: names[1]};
        if (row(kind, ...(kind === "sun" ? [names[1], names[0]] : names)))
          return say(t("taken", {name: names.join(" ")}));
        edit(t(`op_${kind}`, {a: names[0], b: names[1]}), [{table: kind, before: null, after}]);
        say(t("pairMade", {a: names[0], b: names[1]}));
        drawPair(kind);
      }
    })
  );
  say(t(`pick_${first}`));
}

/** The edge of the chosen polygon that is nearest to the crosshair, while polygons are worked on. */
function edgeHere() {
  const polygon = ui.mode === "polygons" && ui.polygon !== null && row("polygons", ui.polygon),
    {photo, cursor} = activePane();
  return polygon && photo ? nearestEdge(polygon, photo.name, cursor.x, cursor.y) : null;
}

/** An edge's two points, or the one of the chosen polygon, then places on it until Esc; K again: another one. */
export function drawEdge() {
  if (isReadOnly("edges")) return say(t("readOnlyTable"));
  const ends = ui.tool?.name === "edgeMark" ? null : edgeHere();
  if (ends) {
    const {isMoved} = activePane();
    setTool(edgeTool(...ends));
    activePane().isMoved = isMoved; // the crosshair was brought to it: Enter marks there
    return say(t("edgePlace", {from: ends[0], to: ends[1]}));
  }
  if (ui.mode !== "polygons") setMode("sun");
  setTool(
    pointTool({
      name: "edgeMark",
      wanted: ["pick_from", "pick_to"],
      count: 2,
      onlyKnown: true,
      done: ([from, to]) => setTool(edgeTool(from, to))
    })
  );
  say(t("pick_from"));
}

/** @returns {import("../site/ui.js").Tool} */
function edgeTool(from, to) {
  return {
    name: "edgeMark",
    hint: () => t("edgePlace", {from, to}),
    place: (photo, x, y) =>
      edit(t("opEdge", {from, to, photo}), [
        {
          table: "edges",
          before: null,
          after: {photo, from, to, x: stored(x), y: stored(y), sigma: marking.sigma}
        }
      ]),
    finish: () => setTool(null),
    outline: photo =>
      [placeOf(photo, from), placeOf(photo, to)]
        .filter(at => at)
        .map(
          at => /** @type {[number, number]} */ ([/** @type {any} */ (at).x, /** @type {any} */ (at).y])
        )
  };
}

export function buildDirectionPanel(root) {
  const start = (text, key, action) =>
    button(
      t(text),
      () => {
        action();
        activePane().focus();
      },
      {title: key}
    );
  root.append(
    node(
      "div",
      {class: "buttons"},
      start("sunPair", "S", () => drawPair("sun")),
      start("zenithPair", "V", () => drawPair("zenith")),
      start("edgeMark", "K", drawEdge),
      start("deletePair", "", deletePair)
    ),
    node("dl", {id: "directions"})
  );
  drawn = "";
}

/** Deletes the pairs of the current point in both lists, and its edges' marks on this photo. */
function deletePair() {
  const point = ui.point;
  const found = [
    ...rows("sun")
      .filter(one => one.object === point || one.shadow === point)
      .map(before => ({table: "sun", before, after: null})),
    ...rows("zenith")
      .filter(one => one.bottom === point || one.top === point)
      .map(before => ({table: "zenith", before, after: null})),
    ...rows("edges")
      .filter(one => one.photo === activePane()?.photo?.name && (one.from === point || one.to === point))
      .map(before => ({table: "edges", before, after: null}))
  ];
  if (point === null || found.length === 0) return say(t("noPair"));
  edit(t("opDeletePair", {name: point}), found);
}

let drawn = "";
export function updateDirectionPanel() {
  const {sun, zenith} = state.adjusted ?? {},
    root = byId("directions");
  const signature = JSON.stringify([sun, zenith, rows("sun").length, rows("zenith").length]);
  if (!root || (drawn === signature && root.childElementCount > 0)) return;
  drawn = signature;
  const lines = [
    [
      t("sun"),
      sun
        ? t("sunAbout", {
            azimuth: shown(sun.azimuth_deg, 2),
            elevation: shown(sun.elevation_deg, 2),
            sigma: shown(sun.sigma_deg, 3),
            n: sun.pairs
          })
        : t("unknownPairs", {n: rows("sun").length})
    ]
  ];
  const ephemeris = sun?.ephemeris;
  if (ephemeris) {
    lines.push(
      [
        t("ephemeris"),
        t("ephemerisAbout", {
          azimuth: shown(ephemeris.azimuth_deg, 2),
          elevation: shown(ephemeris.elevation_deg, 2),
          difference: shown(ephemeris.difference_deg, 2)
        })
      ],
      [
        t("clock"),
        t("clockAbout", {
          minutes: shown(ephemeris.clock_minutes, 1),
          rest: shown(ephemeris.clock_difference_deg, 2)
        })
      ]
    );
  }
  lines.push([
    t("zenith"),
    zenith
      ? t("zenithAbout", {
          tilt: shown(zenith.tilt_deg, 3),
          sigma: shown(zenith.sigma_deg, 3),
          n: zenith.pairs
        })
      : t("unknownPairs", {n: rows("zenith").length})
  ]);
  root.replaceChildren(
    ...lines.flatMap(([name, text]) => [node("dt", {text: name}), node("dd", {text})])
  );
}

export function addDirectionKeys() {
  addAction({id: "sunPair", key: "S", run: () => drawPair("sun")});
  addAction({id: "zenithPair", key: "V", run: () => drawPair("zenith")});
  addAction({id: "edgeMark", key: "K", run: drawEdge});
}
