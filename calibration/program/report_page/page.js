// What every report page of insitu is built from: text, tables, plots. The data is the JSON of the
// element "report"; names in it only ever become text nodes, never markup.
"use strict";
const report = JSON.parse(document.getElementById("report").textContent);
const page = document.body;

const kInk = "#1c2226", kFaint = "#5d6870", kAccent = "#2b5f8a", kFail = "#a4262c";

const isKnown = value => value !== null && value !== undefined;
// Rounded, without a minus before nothing but zeros.
const fixed = (value, digits) =>
  isKnown(value) ? value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1") : "–";
const count = (n, noun) => `${n} ${noun}${n === 1 ? "" : "s"}`;
const norm = vector => Math.hypot(...vector);

function element(parent, name, text, className) {
  const node = parent.appendChild(document.createElement(name));
  if (isKnown(text)) node.textContent = text;
  if (className) node.className = className;
  return node;
}

function section(title, note) {
  const node = element(page, "section");
  element(node, "h2", title);
  if (note) element(node, "p", note, "faint");
  return node;
}

// Folded on the screen, open on paper.
function folded(parent, title) {
  const node = element(parent, "details");
  element(node, "summary", title);
  return node;
}
let openedForPrint = [];
addEventListener("beforeprint", () => {
  openedForPrint = [...document.querySelectorAll("details:not([open])")];
  openedForPrint.forEach(node => node.open = true);
});
addEventListener("afterprint", () => openedForPrint.forEach(node => node.open = false));

// columns: [heading, row => value, format]; format: a number of digits, "text", or "long" for text
// that may wrap. `options`: isFlagged(row); isNarrow: set in columns, as a newspaper is.
function table(parent, rows, columns, options = {}) {
  const node = element(element(parent, "div", null, options.isNarrow ? "columns" : "scroll"), "table",
    null, columns.length > 10 ? "dense" : "");
  const isText = format => format === "text" || format === "long";
  const head = element(element(node, "thead"), "tr");
  for (const [heading, , format] of columns) {
    element(head, "th", heading, isText(format) ? "text" : "");
  }
  const addRow = (part, row) => {
    const line = element(part, "tr", null, options.isFlagged?.(row) ? "flag" : "");
    for (const [, value, format] of columns) {
      const cell = value(row);
      if (isText(format)) element(line, "td", isKnown(cell) ? cell : "–", `text ${format}`);
      else element(line, "td", fixed(cell, format));
    }
  };
  const body = element(node, "tbody");
  rows.forEach(row => addRow(body, row));
  return node;
}

// The first `shown` rows, all of them in a fold when there are more.
function longTable(parent, rows, columns, options = {}, shown = 12) {
  if (rows.length <= shown) return table(parent, rows, columns, options);
  return table(folded(parent, `all ${rows.length}`), rows, columns, options);
}

function plots(parent, isWide = false) {
  return element(parent, "div", null, isWide ? "plots wide" : "plots");
}

// An Observable Plot with a caption above it.
function plot(parent, caption, options) {
  const figure = element(parent, "figure", null, "plot");
  element(figure, "figcaption", caption);
  figure.append(Plot.plot({
    width: 480, style: {fontFamily: "inherit", fontSize: "11px", color: kInk}, ...options,
    figure: false}));
  return figure;
}

// A bar that tells a plot's scale, above the frame's lower left corner. `length` in data units of x.
function scaleBar(x, y, length, label) {
  return [
    Plot.link([0], {x1: x, x2: x + length, y1: y, y2: y, stroke: kInk, strokeWidth: 2}),
    Plot.text([label], {x: x + length, y, dx: 5, textAnchor: "start", fill: kInk, stroke: "white"}),
  ];
}

// {"status": pass | review | fail, "reasons": [{severity, reason, remedy}]}
function showVerdict(verdict) {
  const node = element(page, "section", null, "verdict");
  node.style.setProperty("--tone", `var(--${verdict.status})`);
  element(node, "strong", verdict.status);
  const reasons = element(node, "ul");
  for (const {severity, reason, remedy} of verdict.reasons) {
    const item = element(reasons, "li", reason, severity);
    if (remedy) element(item, "span", remedy, "remedy");
  }
}
