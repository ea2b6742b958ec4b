// SPDX-License-Identifier: GPL-3.0-or-later
// Lists: points by worst |w|, photos, polygons, pairs, samples; and what is to be done.

import {button, byId, first, node} from "../words/dom.js";
import {showCertificate} from "../film/certificate.js";
import {chooseFiducial} from "../film/fiducials.js";
import {raysOf, rows, state} from "../site/state.js";
import {on} from "../site/signals.js";
import {shown} from "../words/numbers.js";
import {
  activePane,
  choosePoint,
  choosePolygon,
  grade,
  pointsByWorst,
  setMode,
  showPhoto,
  ui
} from "../site/ui.js";
import {chooseSample, offText, samples} from "../light/samples.js";
import {runStage} from "./stages.js";
import {said, t} from "../words/words.js";

const kSigns = {control: "▲", check: "■", vertex: "◆", tie: "●"};
const kNames = ["points", "photos", "polygons", "pairs", "samples"];
let shownList = "points",
  filter = "";

/** @param {string} name */
export function showList(name) {
  shownList = name;
  drawnLists = "";
  draw();
}

export function buildLists() {
  const tabs = node(
    "div",
    {class: "tabs", role: "tablist"},
    ...kNames.map(name => button(t(name), () => showList(name), {role: "tab", "data-list": name}))
  );
  const field = node("input", {type: "search", placeholder: t("filter"), "aria-label": t("filter")});
  field.addEventListener("input", () => {
    filter = field.value.trim().toLowerCase();
    draw();
  });
  byId("lists").replaceChildren(tabs, field, node("div", {id: "list", role: "tabpanel"}));
  on("draw", draw);
  on("mode", () =>
    showList({control: "points", polygons: "polygons", sun: "pairs", light: "samples", film: "photos"}[ui.mode])
  );
}

let drawnTodo = "",
  drawnLists = "";
function draw() {
  drawTodo();
  for (const made of /** @type {any[]} */ ([...byId("lists").firstChild.children])) {
    made.setAttribute("aria-selected", String(made.dataset.list === shownList));
  }
  const {head, lines} = kLists[shownList]();
  const chosen = lines.filter(
    line => filter === "" || line.cells.join(" ").toLowerCase().includes(filter)
  );
  const signature = JSON.stringify([shownList, chosen.map(line => [line.cells, line.class, line.note])]);
  if (signature === drawnLists) return;
  drawnLists = signature;
  const focused = /** @type {any} */ (document.activeElement)?.closest?.("#list tr")?.dataset.key;
  byId("list").replaceChildren(
    node(
      "table",
      {class: chosen.some(line => line.cells[line.cells.length - 1] !== "") ? "" : "bare"}, // no remarks
      node("thead", {}, node("tr", {}, ...head.map(text => node("th", {text})))),
      node("tbody", {}, ...chosen.map(tableLine))
    )
  );
  if (focused) first(`#list tr[data-key="${CSS.escape(focused)}"] button`)?.focus();
}

/** The first cell is the button of its line. */
function tableLine(line) {
  const [first, ...others] = line.cells;
  const name = node("button", {type: "button", text: first, onclick: line.act ?? (() => {})});
  return node(
    "tr",
    {class: line.class ?? "", title: line.note ?? "", data: {key: line.key ?? first}},
    node("td", {}, name),
    ...others.map(text => node("td", {text}))
  );
}

const backToPane = () => activePane()?.focus();
const act = what => () => {
  what();
  backToPane();
};

/** Reasons why something was left out, by what it is. */
function reasons(kind) {
  const all = new Map();
  for (const one of state.adjusted?.left_out ?? []) if (one.kind === kind) all.set(one.name, said(one, "reason"));
  return all;
}

function pointList() {
  const leftOut = reasons("point"),
    found = new Map();
  for (const one of state.adjusted?.diagnoses ?? []) if (one.point) found.set(one.point, said(one));
  for (const one of state.adjusted?.control ?? []) {
    if (one.role === "check")
      found.set(one.name, `Δ ${one.difference.map(d => shown(1000 * d, 0)).join(" ")} mm`);
  }
  const lines = pointsByWorst().map(point => {
    const solved = state.adjusted?.points?.[point.name],
      level = grade(point.w);
    const note = found.get(point.name) ?? leftOut.get(point.name) ?? "";
    const off = point.marks.filter(one => one.state === "off").length;
    const doubts = point.marks.filter(one => one.state === "dubious").length;
    return {
      key: point.name,
      cells: [
        `${kSigns[point.kind]} ${point.name}`,
        point.w === null ? "–" : `${shown(point.w, 1)}${level === "bad" ? " !" : ""}`,
        `${raysOf(point.name)}${off ? ` +${off} ${t("off")}` : ""}${doubts ? ` (${doubts} ?)` : ""}`,
        solved ? shown(1000 * Math.hypot(...solved.sigma), 0) : "–",
        note
      ],
      class: `${level}${point.name === ui.point ? " current" : ""}${note ? " noted" : ""}`,
      note,
      act: act(() => choosePoint(point.name))
    };
  });
  return {head: [t("point"), "|w|", t("raysHead"), "± mm", t("remark")], lines};
}

function photoList() {
  const lines = state.photos.map(photo => {
    const about = state.adjusted?.photos?.[photo.name];
    const marks = rows("observations").filter(
      one => one.photo === photo.name && one.state !== "off"
    ).length;
    return {
      cells: [
        photo.name,
        String(marks),
        about?.oriented ? shown(about.rms_px, 2) : "–",
        about?.oriented ? shown(about.sigma_mm, 0) : "–",
        about && !about.oriented ? said(about, "why") : `${photo.width} × ${photo.height}`
      ],
      class: `${photo === activePane()?.photo ? "current" : ""}${about && !about.oriented ? " noted" : ""}`,
      act: () => showPhoto(photo.name)
    };
  });
  return {head: [t("photo"), t("marks"), "RMS px", "± mm", t("remark")], lines};
}

function polygonList() {
  const leftOut = reasons("polygon");
  const lines = rows("polygons").map(polygon => {
    const about = state.adjusted?.polygons?.[polygon.name],
      note = leftOut.get(polygon.name) ?? "";
    return {
      cells: [
        polygon.name,
        polygon.material,
        polygon.photo ?? "–",
        about ? shown(about.planarity_mm, 1) : "–",
        note
      ],
      class: `${polygon.name === ui.polygon ? "current" : ""}${note ? " noted" : ""}`,
      note,
      act: act(() => choosePolygon(polygon.name))
    };
  });
  return {head: [t("polygon"), t("material"), t("photo"), t("flatMm"), t("remark")], lines};
}

function pairList() {
  const line = (kind, a, b) => ({
    cells: [
      `${a} → ${b}`,
      t(kind),
      said(
        (state.adjusted?.left_out ?? []).find(
          one => one.kind === kind && (one.name === a || one.name === b || one.name === `${a} ${b}`)
        ),
        "reason"
      )
    ],
    act: act(() => choosePoint(a))
  });
  const lines = [
    ...rows("sun").map(one => line("sun", one.object, one.shadow)),
    ...rows("zenith").map(one => line("zenith", one.bottom, one.top)),
    ...rows("edges").map(one => line("edge", one.from, one.to))
  ];
  return {head: [t("pair"), t("kind"), t("remark")], lines};
}

const kSampleSigns = {horizon: "◠", haze: "≋", daylight: "☀"};

/** Worst first, after those left out; those of the horizon, which has nothing to compare, at the end. */
function sampleList() {
  const size = one => (one.isOut ? Infinity : one.residual === null ? -1 : Math.abs(one.residual));
  const lines = [...samples()]
    .sort((a, b) => size(b) - size(a) || 0)
    .map(one => ({
      key: one.key,
      cells: [
        `${kSampleSigns[one.kind]} ${one.row.photo} ${one.row.x} ${one.row.y}`,
        one.row.polygon ?? t(one.kind),
        one.isOut ? t("leftOut") : `${offText(one)}${one.level === "bad" ? " !" : ""}`,
        ""
      ],
      note: t(one.kind),
      class: `${one.isOut ? "suspect" : one.level}${one.key === ui.sample ? " current" : ""}`,
      act: () => {
        showPhoto(one.row.photo);
        activePane()?.moveCursor(one.row.x, one.row.y);
        if (activePane()) activePane().isMoved = false;
        chooseSample(one);
      }
    }));
  return {head: [t("sample"), t("polygon"), t("off100"), t("remark")], lines};
}

const kLists = {
  points: pointList,
  photos: photoList,
  polygons: polygonList,
  pairs: pairList,
  samples: sampleList
};

function drawTodo() {
  const findings = state.adjusted?.diagnoses ?? [];
  const signature = JSON.stringify([state.todo, findings]);
  if (signature === drawnTodo) return;
  drawnTodo = signature;
  const more = button("", stepTodo, {class: "small more", hidden: true});
  const focused = focusedTodo();
  byId("todo").replaceChildren(
    node("h2", {text: t("todo", {n: state.todo.length})}),
    node(
      "ol",
      {},
      ...state.todo.map(item =>
        node(
          "li",
          {title: said(item, "why")},
          button(said(item), () => goTo(item.where ?? {})),
          item.run
            ? button(t("run"), () => runStage(item.run), {class: "small", "data-run": item.run})
            : null,
          item.why ? node("span", {class: "faint", text: said(item, "why")}) : null
        )
      )
    ),
    ...(findings.length > 0
      ? [
          node("h2", {text: t("findings", {n: findings.length})}),
          node("ul", {}, ...findings.map(finding))
        ]
      : []),
    more
  );
  fitTodo();
  if (focused) focusTodo(focused);
}

/** What tells a button of this list from the others: its thing's text, and which of its buttons it is. */
const todoKey = made =>
  made.matches(".more") ? "more" : `${made.parentElement.firstElementChild.textContent}\n${made.dataset.run ?? ""}`;

/** The key of the button that has the focus. */
function focusedTodo() {
  const made = /** @type {any} */ (document.activeElement)?.closest?.("#todo button");
  return made ? todoKey(made) : null;
}

/** Gives the focus back to it, to the first where it is done or folded away: the list is made anew at any time. */
function focusTodo(key) {
  const all = [...byId("todo").querySelectorAll("button")].filter(one => one.getClientRects().length > 0);
  (all.find(one => todoKey(one) === key) ?? all[0])?.focus();
}

let isTodoOpen = false;
function stepTodo() {
  isTodoOpen = !isTodoOpen;
  fitTodo();
}

/** Shows as many things as there is room for, each whole, and says how many more there are. */
function fitTodo() {
  const root = byId("todo"),
    items = [...root.querySelectorAll("li")],
    more = first("#todo .more");
  if (!more) return;
  const isFull = () => root.scrollHeight > root.clientHeight + 1;
  root.classList.toggle("open", isTodoOpen);
  for (const one of root.querySelectorAll("[hidden]")) one.hidden = false;
  more.hidden = true;
  if (!isTodoOpen && !isFull()) return;
  more.hidden = false;
  more.textContent = t("fewer");
  if (isTodoOpen) return;
  for (let left = items.length - 1; left > 0 && isFull(); --left) {
    items[left].hidden = true;
    const list = items[left].parentElement;
    if (list.firstElementChild === items[left]) list.hidden = list.previousElementSibling.hidden = true;
    more.textContent = t("more", {n: items.length - left});
  }
}
addEventListener("resize", fitTodo);

/** What the diagnosis of the survey found; it leads to its point or photo. */
function finding(one) {
  const place = one.file ? `${one.file}${one.line ? `:${one.line}` : ""}` : "";
  return node(
    "li",
    {class: one.kind === "fault" ? "fail" : "review"},
    button(said(one), () => goTo({point: one.point, photo: one.photo})),
    node("span", {class: "faint", text: place})
  );
}

/** Where something is to be done. */
function goTo(where) {
  if (where.mode) setMode(where.mode);
  if (where.point) choosePoint(where.point);
  if (where.photo) showPhoto(where.photo);
  if (where.fiducial) chooseFiducial(where.fiducial);
  if (where.table === "film") return showCertificate();
  if (where.table === "control_points") first("[data-menu=controlTable]")?.click();
  backToPane();
}
