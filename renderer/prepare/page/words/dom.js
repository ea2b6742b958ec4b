// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page. Text only ever becomes text nodes; looks come from classes or the CSSOM.

const kSvg = "http://www.w3.org/2000/svg";

/**
 * Sets what `attributes` says: `class`, `text`, `data` (an object), `onNAME` (listeners), properties
 * that are no attributes (`value`, `checked`, `disabled`, ...), anything else as an attribute.
 * @param {any} made
 * @param {Record<string, any>} attributes
 */
function equip(made, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name === "class") made.setAttribute("class", value);
    else if (name === "text") made.textContent = String(value);
    else if (name === "data") Object.assign(made.dataset, value);
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (["value", "checked", "disabled", "hidden", "open", "selected"].includes(name))
      made[name] = value;
    else made.setAttribute(name, value === true ? "" : String(value));
  }
}

/**
 * An HTML element with children; strings become text.
 * @param {string} tag
 * @param {Record<string, any>} [attributes]
 * @param {...(Node|string|null)} children
 * @returns {any}
 */
export function node(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  made.append(...children.filter(child => child !== null && child !== undefined));
  equip(made, attributes);
  return made;
}

/**
 * @param {string} tag
 * @param {Record<string, any>} [attributes]
 * @param {...Node} children
 * @returns {any}
 */
export function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(kSvg, tag);
  made.append(...children);
  equip(made, attributes);
  return made;
}

/**
 * Sets a property only where it differs: the browser lays out and paints again for each.
 * @param {any} element
 * @param {string} property
 * @param {any} value
 */
export function keep(element, property, value) {
  if (element[property] !== value) element[property] = value;
}

/**
 * The same with its text, whose node stays, too: a new one is laid out with all that is around it.
 * @param {any} element
 * @param {string} text
 */
export function keepText(element, text) {
  const [only, more] = element.childNodes;
  if (only instanceof Text && !more) keep(only, "data", text);
  else keep(element, "textContent", text);
}

/**
 * The element with this id.
 * @type {(id: string) => any}
 */
export const byId = id => document.getElementById(id);
/**
 * The first element that a selector finds.
 * @type {(selector: string, root?: any) => any}
 */
export const first = (selector, root = document) => root.querySelector(selector);

/**
 * @param {string} text
 * @param {() => void} action
 * @param {Record<string, any>} [attributes]
 */
export const button = (text, action, attributes = {}) =>
  node("button", {type: "button", text, onclick: action, ...attributes});

/**
 * A field with its label.
 * @param {string} text
 * @param {Node} control
 */
export const labelled = (text, control) =>
  node("label", {class: "field"}, node("span", {text}), control);

/**
 * A select of [value, text] pairs.
 * @param {[string, string][]} options
 * @param {string} value
 * @param {(value: string) => void} chosen
 * @param {Record<string, any>} [attributes]
 */
export function select(options, value, chosen, attributes = {}) {
  const made = node("select", attributes);
  for (const [key, text] of options)
    made.append(node("option", {value: key, text, selected: key === value}));
  made.addEventListener("change", () => chosen(made.value));
  return made;
}

/**
 * A modal dialog that is removed when it closes.
 * @param {string} title
 * @param {Node[]} content
 * @param {string} closeText
 * @returns {HTMLDialogElement}
 */
export function dialog(title, content, closeText) {
  const previous = /** @type {any} */ (document.activeElement);
  const made = node(
    "dialog",
    {"aria-label": title},
    node("h2", {text: title}),
    ...content,
    node(
      "p",
      {class: "buttons"},
      button(closeText, () => made.close())
    )
  );
  made.addEventListener("close", () => {
    made.remove();
    previous?.focus?.();
  });
  document.body.append(made);
  made.showModal();
  return made;
}

/**
 * A table of texts.
 * @param {string[]} head
 * @param {(string|Node)[][]} rows
 * @param {string} [className]
 */
export function table(head, rows, className = "") {
  const cells = (row, tag) => node("tr", {}, ...row.map(cell => node(tag, {}, cell)));
  return node(
    "table",
    {class: className},
    node("thead", {}, cells(head, "th")),
    node("tbody", {}, ...rows.map(row => cells(row, "td")))
  );
}
