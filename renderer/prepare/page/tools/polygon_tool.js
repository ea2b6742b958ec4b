// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons: drawn, turned by the viewing side, with the photo and the material that colour them.

import {ask} from "../site/api.js";
import {button, labelled, node, select, byId} from "../words/dom.js";
import {addHoleKeys, drawHole, showHoles} from "./holes.js";
import {endDraft, keepDraft, showDrafts} from "./drafts.js";
import {addAction} from "../around/keys.js";
import {edit, freeName, isReadOnly, nameFault, row, rows, state} from "../site/state.js";
import {shown} from "../words/numbers.js";
import {say} from "../around/notices.js";
import {showRename} from "../points/renaming.js";
import {pointTool} from "./pickers.js";
import {editsOfNewMaterial, entryOptions, library, showPhotographed, showSurface, surfaceRow} from "./surfaces.js";
import {emit} from "../site/signals.js";
import {activePane, placeOf, setMode, setTool, stepLines, ui} from "../site/ui.js";
import {said, t} from "../words/words.js";

const current = () => (ui.polygon === null ? undefined : row("polygons", ui.polygon));
const materials = () => [
  ...new Set([...rows("materials").map(one => one.name), ...rows("polygons").map(one => one.material)])
];
let lastMaterial = "";

/**
 * Vertices counter-clockwise as this photo sees them (y is down); as given where too few are seen.
 * @param {string[]} names
 * @param {string|null} photo
 */
export function turned(names, photo) {
  const seen = names.map(name => photo && placeOf(photo, name)).filter(at => at);
  if (seen.length < 3) return names;
  const area = seen.reduce((sum, at, i) => {
    const next = /** @type {any} */ (seen[(i + 1) % seen.length]);
    return sum + /** @type {any} */ (at).x * next.y - next.x * /** @type {any} */ (at).y;
  }, 0);
  return area > 0 ? [names[0], ...names.slice(1).reverse()] : names;
}

/**
 * Takes vertices until Enter; left before, what there is becomes a draft.
 * @param {any} [draft] that is taken up again
 */
export function drawPolygon(draft = null) {
  if (isReadOnly("polygons")) return say(t("readOnlyTable"));
  setMode("polygons");
  const tool = pointTool({
    name: "drawPolygon",
    wanted: ["vertexFirst", "vertexNext", "vertexNext", "vertexOrEnter"],
    begun: draft ? {names: draft.vertices, photo: draft.photo} : undefined,
    done: (names, photo) => finish(names, photo, draft),
    cancelled: (names, photo) => keepDraft(names, photo, draft)
  });
  setTool(tool);
  say(tool.hint());
}
// A window that closes leaves its tool: the outbox sends the draft when the page comes back.
addEventListener("pagehide", () => /^draw/.test(ui.tool?.name ?? "") && setTool(null));

/** Inserts the polygon drawn; its photo is the one it was drawn on until a better one is asked for. */
function finish(names, photo, draft) {
  const name = freeName("polygon_"),
    material = current()?.material ?? (lastMaterial || materials()[0]) ?? "unknown";
  const after = {name, vertices: turned(names, photo), photo, material, mask: null};
  edit(t("opPolygon", {name}), [{table: "polygons", before: null, after}, ...endDraft(draft)]);
  ui.polygon = name;
  say(t("polygonMade", {name}));
}

/**
 * @param {Record<string, any>} changes
 * @param {string} label
 * @param {import("../site/outbox.js").Edit[]} [others] that go with it
 */
function change(changes, label, others = []) {
  const old = current();
  if (!old) return say(t("noPolygon"));
  if (isReadOnly("polygons")) return say(t("readOnlyTable"));
  edit(t(label, {name: old.name}), [
    {table: "polygons", before: old, after: {...old, ...changes}},
    ...others
  ]);
}

/** Asks which photo shows the polygon best and takes it. */
export async function bestPhoto() {
  const old = current();
  if (!old) return say(t("noPolygon"));
  const answer = await ask("/api/best_photo", {vertices: old.vertices});
  const best = answer.photos?.[0];
  if (!best) return say(t("noBestPhoto", {why: answer.error ?? ""}));
  change({photo: best.photo}, "opImage");
  say(
    t("bestPhoto", {photo: best.photo, angle: shown(best.angle_deg, 0), mm: shown(best.mm_per_px, 1)})
  );
}

function deletePolygon() {
  const old = current();
  if (!old) return say(t("noPolygon"));
  if (isReadOnly("polygons")) return say(t("readOnlyTable"));
  edit(t("opDeletePolygon", {name: old.name}), [{table: "polygons", before: old, after: null}]);
  ui.polygon = null;
}

/** Renames it everywhere: samples and constraints name polygons too. */
function rename(name) {
  const old = current(),
    fault = nameFault(name);
  if (!old || name === old.name) return;
  if (fault || row("polygons", name)) return say(t(fault || "taken", {name}));
  /** @type {import("../site/outbox.js").Edit[]} */
  const edits = [{table: "polygons", before: old, after: {...old, name}}];
  for (const table of ["horizon", "haze", "daylight"]) {
    for (const one of rows(table))
      if (one.polygon === old.name) edits.push({table, before: one, after: {...one, polygon: name}});
  }
  for (const one of rows("constraints")) {
    if (!one.polygons?.includes(old.name)) continue;
    edits.push({
      table: "constraints",
      before: one,
      after: {...one, polygons: one.polygons.map(other => (other === old.name ? name : other))}
    });
  }
  edit(t("opRename", {name: old.name, to: name}), edits);
  ui.polygon = name;
}

/** The current polygon's material, and that of those drawn next. */
function takeMaterial(name) {
  if (name === "") return;
  lastMaterial = name;
  if (current()) change({material: name}, "opMaterial", editsOfNewMaterial(name));
  emit("view");
}

/** Enter takes what was typed and goes back to the photo. */
function enterLeaves(field) {
  field.addEventListener("keydown", event => {
    if (event.key === "Enter" && !event.isComposing) activePane()?.focus();
  });
}

export function buildPolygonPanel(root) {
  const name = node("input", {
    id: "polygon-name",
    type: "text",
    autocomplete: "off",
    spellcheck: "false"
  });
  name.addEventListener("change", () => rename(name.value.trim()));
  enterLeaves(name);
  const material = node("input", {
    id: "material",
    type: "text",
    list: "material-names",
    autocomplete: "off",
    spellcheck: "false"
  });
  material.addEventListener("change", () => takeMaterial(material.value.trim()));
  enterLeaves(material);
  const then = action => async () => {
    await action();
    activePane().focus();
    emit("view");
  };
  root.append(
    node(
      "div",
      {class: "buttons"},
      button(
        t("drawPolygon"),
        then(() => drawPolygon()), {class: "main", title: "B"}
      ),
      button(t("bestImage"), then(bestPhoto), {title: "I"}),
      button(
        t("drawHole"),
        then(() => drawHole()), {title: "Shift+B"}
      ),
      button(
        t("flip"),
        then(() => change({vertices: [...(current()?.vertices ?? [])].reverse()}, "opFlip"))
      ),
      button(t("delete"), then(deletePolygon))
    ),
    node("div", {id: "drafts"}),
    node(
      "div",
      {class: "row"},
      labelled(t("polygon"), name),
      labelled(t("image"), node("span", {id: "polygon-photo"}))
    ),
    node(
      "div",
      {class: "row"},
      labelled(t("material"), material),
      node("datalist", {id: "material-names"}),
      node("span", {id: "swatch", class: "swatch large"})
    ),
    surfaceRow(),
    node("div", {id: "holes"}),
    node("p", {id: "polygon-about", class: "faint"})
  );
  drawn = "";
}

/** Into a field, unless somebody is typing there. */
function showIn(id, text) {
  if (document.activeElement !== byId(id)) byId(id).value = text;
}

let drawn = "";
export function updatePolygonPanel() {
  const goOn = draft => {
    (draft.hole_of ? drawHole : drawPolygon)(draft);
    activePane().focus();
  };
  if (byId("drafts")) showDrafts(byId("drafts"), goOn);
  const polygon = current(),
    about = polygon && state.adjusted?.polygons?.[polygon.name];
  const signature = JSON.stringify([
    polygon,
    about?.planarity_mm,
    about?.area_m2,
    about?.off_vertical_deg,
    materials(),
    rows("materials"),
    library().length
  ]);
  if (drawn === signature || !byId("polygon-photo")) return;
  drawn = signature;
  showIn("polygon-name", polygon?.name ?? "");
  showHoles(byId("holes"));
  byId("polygon-name").disabled = !polygon;
  byId("polygon-photo").replaceChildren(
    select(
      [
        ["", "–"],
        ...state.photos.map(photo => /** @type {[string, string]} */ ([photo.name, photo.name]))
      ],
      polygon?.photo ?? "",
      value => change({photo: value || null}, "opImage"),
      {disabled: !polygon, "aria-label": t("image")}
    )
  );
  showIn("material", polygon?.material ?? lastMaterial);
  byId("material-names").replaceChildren(
    ...materials().map(value => node("option", {value})),
    ...entryOptions(library().filter(one => !materials().includes(one.name)))
  );
  showPhotographed(polygon?.material ?? lastMaterial, byId("swatch"));
  showSurface(polygon?.material ?? lastMaterial);
  const leftOut = (state.adjusted?.left_out ?? []).find(
    one => one.kind === "polygon" && one.name === polygon?.name
  );
  byId("polygon-about").textContent = !polygon
    ? t("noPolygonHint")
    : `${polygon.vertices.join(" ")}\n` +
      (about
        ? t("polygonAbout", {
            flat: shown(about.planarity_mm, 1),
            area: shown(about.area_m2, 2),
            off: shown(about.off_vertical_deg, 2)
          })
        : said(leftOut, "reason"));
}

/** To a field of this panel. */
function toField(id) {
  setMode("polygons");
  byId(id).focus();
  byId(id).select();
}

/** To the name of the current polygon; where points are the matter, to the point's. */
function toName() {
  if (ui.mode !== "polygons") return showRename();
  if (!current()) return say(t("noPolygon"));
  toField("polygon-name");
}

export function addPolygonKeys() {
  addAction({id: "drawPolygon", key: "B", run: () => drawPolygon()});
  addAction({id: "bestImage", key: "I", run: bestPhoto});
  addAction({id: "material", key: "T", run: () => toField("material")});
  addAction({id: "rename", key: "F2", run: toName});
  addHoleKeys();
  addAction({
    id: "wireframe",
    key: "'",
    run: () => {
      stepLines();
      say(t(`lines_${ui.lines}`));
    }
  });
}
