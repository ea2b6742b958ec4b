// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints: what is known of edges and planes, each with its sigma, from points and polygons chosen.

import {button, byId, labelled, node, select} from "../words/dom.js";
import {addAction} from "../around/keys.js";
import {say} from "../around/notices.js";
import {parseNumber} from "../words/numbers.js";
import {isSame} from "../site/rows.js";
import {edit, isReadOnly, rows} from "../site/state.js";
import {on} from "../site/signals.js";
import {activePane, setTool} from "../site/ui.js";
import {t} from "../words/words.js";

/** Points or polygons that a kind takes, and whether it has a value. */
const kKinds = {
  distance: {points: 2, polygons: 0, hasValue: true},
  height: {points: 2, polygons: 0, hasValue: true},
  vertical: {points: 2, polygons: 1, hasValue: false},
  horizontal: {points: 2, polygons: 1, hasValue: false},
  parallel: {points: 4, polygons: 2, hasValue: false},
  perpendicular: {points: 4, polygons: 2, hasValue: false}
};
const kUnits = {sigma_m: "m", sigma_deg: "°", sigma_mm_per_m: "mm/m"};

const chosen = {
  kind: "vertical",
  points: /** @type {string[]} */ ([]),
  polygons: /** @type {string[]} */ ([])
};

/** The box stays while points and polygons are chosen on the photos or in the lists. */
export function showConstraints() {
  if (!byId("constraints")) {
    byId("panes").append(build());
    on("tables", drawList);
  }
  begin();
  byId("constraint-kind").focus();
}

function build() {
  const kinds = Object.keys(kKinds).map(
    kind => /** @type {[string, string]} */ ([kind, t(`constraint_${kind}`)])
  );
  const field = id => node("input", {id, type: "text", inputmode: "decimal"});
  return node(
    "section",
    {id: "constraints", class: "floating", "aria-label": t("constraints")},
    node("h2", {text: t("constraints")}),
    node(
      "div",
      {class: "row"},
      labelled(
        t("kind"),
        select(
          kinds,
          chosen.kind,
          kind => {
            chosen.kind = kind;
            begin();
          },
          {id: "constraint-kind"}
        )
      ),
      labelled(t("of"), node("input", {id: "constraint-of", type: "text", onchange: typed}))
    ),
    node(
      "div",
      {class: "row"},
      labelled(t("value"), field("constraint-value")),
      labelled("σ", field("constraint-sigma")),
      labelled(t("unit"), node("select", {id: "constraint-unit"}))
    ),
    node("div", {class: "buttons"}, button(t("add"), add, {class: "main"}), button(t("close"), close)),
    node("ul", {id: "constraint-list"})
  );
}

function close() {
  setTool(null);
  byId("constraints").remove();
  activePane().focus();
}

/** Takes points and polygons anew for the kind. */
function begin() {
  chosen.points = [];
  chosen.polygons = [];
  const isLength = kKinds[chosen.kind].hasValue,
    unit = byId("constraint-unit");
  const units = isLength ? ["sigma_m"] : ["sigma_mm_per_m", "sigma_deg"];
  unit.replaceChildren(...units.map(one => node("option", {value: one, text: kUnits[one]})));
  byId("constraint-value").disabled = !isLength;
  if (byId("constraint-sigma").value === "") byId("constraint-sigma").value = isLength ? "0.005" : "2";
  setTool({
    name: "constraints",
    hint,
    pickPoint: name => {
      chosen.polygons = [];
      chosen.points = [...chosen.points, name].slice(-kKinds[chosen.kind].points);
      show();
    },
    pickPolygon: name => {
      if (kKinds[chosen.kind].polygons === 0) return say(hint());
      chosen.points = [];
      chosen.polygons = [...chosen.polygons.filter(one => one !== name), name].slice(
        -kKinds[chosen.kind].polygons
      );
      show();
    },
    back: () => (chosen.points.pop() ?? chosen.polygons.pop()) !== undefined,
    finish: add
  });
  show();
  drawList();
}

const hint = () =>
  t(kKinds[chosen.kind].polygons ? "chooseEither" : "choosePoints", {
    points: kKinds[chosen.kind].points,
    polygons: kKinds[chosen.kind].polygons
  });
function show() {
  byId("constraint-of").value = [...chosen.points, ...chosen.polygons].join(" ");
  byId("constraint-of").placeholder = hint();
}

/** Names typed instead of chosen. */
function typed() {
  const names = byId("constraint-of")
    .value.trim()
    .split(/[\s;]+/)
    .filter(name => name !== "");
  const isPolygons =
    names.length > 0 && names.every(name => rows("polygons").some(one => one.name === name));
  chosen.points = isPolygons ? [] : names;
  chosen.polygons = isPolygons ? names : [];
}

function add() {
  const kind = kKinds[chosen.kind],
    sigma = parseNumber(byId("constraint-sigma").value);
  const value = kind.hasValue ? parseNumber(byId("constraint-value").value) : 0;
  const isComplete =
    chosen.points.length === kind.points ||
    (kind.polygons > 0 && chosen.polygons.length === kind.polygons);
  if (!isComplete) return say(hint());
  if (sigma === null || sigma <= 0 || value === null)
    return say(t("badNumber", {text: sigma === null || sigma <= 0 ? "σ" : t("value")}));
  if (isReadOnly("constraints")) return say(t("readOnlyTable"));
  const of = chosen.points.length > 0 ? {points: chosen.points} : {polygons: chosen.polygons};
  const after = {
    kind: chosen.kind,
    ...of,
    ...(kind.hasValue ? {value_m: value} : {}),
    [byId("constraint-unit").value]: sigma
  };
  if (rows("constraints").some(one => isSame(one, after)))
    return say(t("taken", {name: t("constraints")}));
  edit(t("opConstraint", {kind: t(`constraint_${chosen.kind}`)}), [
    {table: "constraints", before: null, after}
  ]);
  begin();
}

function textOf(one) {
  const [unit] = Object.keys(kUnits).filter(key => one[key] !== undefined);
  return (
    `${t(`constraint_${one.kind}`)}: ${(one.points ?? one.polygons ?? []).join(" ")}` +
    `${one.value_m !== undefined ? ` = ${one.value_m} m` : ""} ± ${one[unit]} ${kUnits[unit] ?? ""}`
  );
}

function drawList() {
  byId("constraint-list")?.replaceChildren(
    ...rows("constraints").map(one =>
      node(
        "li",
        {},
        node("span", {text: textOf(one)}),
        button(
          t("delete"),
          () => edit(t("opDeleteConstraint"), [{table: "constraints", before: one, after: null}]),
          {class: "small"}
        )
      )
    )
  );
}

export function addConstraintKeys() {
  addAction({id: "constraints", key: "Alt+C", run: showConstraints, isPage: true});
}
