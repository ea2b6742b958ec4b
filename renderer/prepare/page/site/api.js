// SPDX-License-Identifier: GPL-3.0-or-later
// The server: requests with the token, and the live connection.

/** What the address says behind #: TOKEN or token=TOKEN, window=report. */
function readFragment() {
  const parts = location.hash
    .slice(1)
    .split("&")
    .filter(part => part !== "");
  const named = new Map(
    parts.map(part =>
      part.includes("=")
        ? /** @type {[string, string]} */ (part.split(/=(.*)/s).slice(0, 2))
        : ["token", part]
    )
  );
  const token = named.get("token");
  if (token) {
    sessionStorage.setItem("token", decodeURIComponent(token));
    named.delete("token");
    const rest = [...named].map(([key, value]) => `${key}=${value}`).join("&");
    history.replaceState(null, "", location.pathname + (rest ? `#${rest}` : ""));
  }
  return named;
}
const fragment = readFragment();
// A new token in the address of an open page is the token of a server that was started anew.
addEventListener("hashchange", () => {
  if (/token=|^#[^=]+$/.test(location.hash)) {
    readFragment();
    location.reload();
  }
});

/** @type {(answer: any) => string} */
let errorText = answer => answer?.error ?? "";
/** @param {(answer: any) => string} worded what an answer says is wrong, in the page's language */
export const wordErrors = worded => {
  errorText = worded;
};

export const isReport = fragment.get("window") === "report";
const token = () => sessionStorage.getItem("token") ?? "";

/** The address of the window with the lists alone. */
export const reportAddress = () =>
  `${location.pathname}#token=${encodeURIComponent(token())}&window=report`;

/**
 * @param {string} path
 * @param {RequestInit} [options]
 */
function request(path, options = {}) {
  return fetch(path, {
    ...options,
    cache: "no-store",
    headers: {Authorization: `Bearer ${token()}`, ...options.headers}
  });
}

/**
 * @param {string} path
 * @param {number[]} [answers] of status 400 and above that are no failure
 * @returns {Promise<any>} throws what the server says is wrong
 */
export async function getJson(path, answers = []) {
  const response = await request(path);
  if (!response.ok && !answers.includes(response.status))
    throw new Error(`${response.status}: ${(await response.text()).slice(0, 300)}`);
  return response.json();
}

/**
 * @param {string} path
 * @param {AbortSignal} [signal]
 * @returns {Promise<Blob>} throws what the server says is wrong, with its `status`
 */
export async function getBlob(path, signal) {
  const response = await request(path, {signal});
  if (response.ok) return response.blob();
  const why = errorText(await response.json().catch(() => ({})));
  throw Object.assign(new Error(why || `${response.status} ${path}`), {status: response.status});
}

/**
 * Throws only where no answer came.
 * @param {string} path
 * @param {any} body
 * @returns {Promise<{status: number, body: any}>}
 */
export async function post(path, body) {
  const response = await request(path, {
    method: "POST",
    body: JSON.stringify(body),
    headers: {"Content-Type": "application/json"}
  });
  const text = await response.text();
  try {
    return {status: response.status, body: text ? JSON.parse(text) : {}};
  } catch {
    return {status: response.status, body: {error: text.slice(0, 300)}};
  }
}

/**
 * What a question to the server answers, or the text why there is no answer.
 * @param {string} path
 * @param {any} body
 * @returns {Promise<any>} with `error` where it failed
 */
export async function ask(path, body) {
  try {
    const answer = await post(path, body);
    const found = answer.body;
    if (answer.status === 200 && !found.error) return found;
    return {...found, error: errorText(found) || `${answer.status}`};
  } catch (error) {
    return {error: String(error.message ?? error)};
  }
}

/**
 * Keeps a connection to /api/live.
 * @param {(message: any) => void} received
 * @param {(isOpen: boolean) => void} changed
 * @returns {{send: (message: any) => void}}
 */
export function connectLive(received, changed) {
  /** @type {WebSocket|null} */
  let socket = null;
  let pause = 250;
  if (!("WebSocket" in globalThis)) {
    // then the page looks for news itself
    setInterval(() => {
      changed(true);
      received({type: "hello"});
    }, 1500);
    return {send: () => {}};
  }
  const open = () => {
    socket = new WebSocket(
      `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/live`
    );
    socket.onopen = () => {
      pause = 250;
      socket?.send(JSON.stringify({token: token()}));
      changed(true);
    };
    socket.onmessage = event => received(JSON.parse(event.data));
    socket.onclose = () => {
      changed(false);
      setTimeout(open, pause);
      pause = Math.min(2 * pause, 4000);
    };
  };
  open();
  return {
    send: message => {
      if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
    }
  };
}
