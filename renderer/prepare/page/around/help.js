// SPDX-License-Identifier: GPL-3.0-or-later
// The list of keys, in which they can be changed.

import {button, dialog, node} from "../words/dom.js";
import {actions, changeKey, keyFor, keyText, resetKeys} from "./keys.js";
import {t} from "../words/words.js";

const kFixed = [
  ["←↑→↓", "key_nudge"],
  ["Space", "key_space"],
  ["Tab", "key_tab"],
  ["Backspace", "key_back"],
  ["Esc", "key_escape"],
  [t("wheel"), "key_wheel"]
];

export function showHelp() {
  const message = node("output", {"aria-live": "polite"}),
    body = node("tbody");
  const draw = () =>
    body.replaceChildren(
      ...kFixed.map(([key, text]) =>
        node("tr", {}, node("td", {}, node("kbd", {text: key})), node("td", {text: t(text)}), node("td"))
      ),
      ...actions.map(action => line(action, message, draw))
    );
  draw();
  dialog(
    t("help"),
    [
      node("p", {text: t("helpNote")}),
      node("div", {class: "scroll tall"}, node("table", {class: "keys"}, body)),
      message,
      node(
        "p",
        {class: "buttons"},
        button(t("resetKeys"), () => {
          resetKeys();
          draw();
        })
      )
    ],
    t("close")
  );
}

/** @param {import("./keys.js").Action} action */
function line(action, message, draw) {
  const change = button(
    t("changeKey"),
    () => {
      message.textContent = t("pressKey", {action: t(`key_${action.id}`)});
      const take = event => {
        if (["Shift", "Control", "Alt", "Meta"].includes(event.key)) return;
        event.preventDefault();
        event.stopPropagation();
        removeEventListener("keydown", take, true);
        const fault = event.key === "Escape" ? "" : changeKey(action.id, keyText(event));
        message.textContent = fault ? t(fault, {key: keyText(event)}) : "";
        draw();
      };
      addEventListener("keydown", take, true);
    },
    {class: "small"}
  );
  return node(
    "tr",
    {},
    node("td", {}, node("kbd", {text: keyFor(action.id)})),
    node("td", {text: t(`key_${action.id}`)}),
    node("td", {}, change)
  );
}
