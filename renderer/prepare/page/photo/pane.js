// SPDX-License-Identifier: GPL-3.0-or-later
// A pane: one photograph with its own zoom, painted from tiles, and the crosshair on it.

import {button, keep, keepText, node, svg} from "../words/dom.js";
import {drawFiducials} from "../film/fiducial_drawing.js";
import {drawFigures} from "./figures.js";
import {listenTo} from "./gestures.js";
import {Loupe} from "./loupe.js";
import {drawMarks} from "./marks.js";
import {drawSamples} from "../light/samples.js";
import {photoOf, state} from "../site/state.js";
import {emit, redraw} from "../site/signals.js";
import {relit, stepLight} from "./relit.js";
import {paintTiles} from "./tile_painter.js";
import {fetchTiles} from "./tiles.js";
import {activePane, currentPlace, hands, placeOf, stepLines, ui} from "../site/ui.js";
import {said, t} from "../words/words.js";
import {Zoomed} from "./zoom.js";

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

export class Pane extends Zoomed {
  constructor() {
    super();
    /** @type {import("../site/state.js").Photo|null} */
    this.photo = null;
    /** @type {"photo"|"none"|"sun"} in which light it is shown */
    this.light = "photo";
    /** The crosshair [px], and whether someone has moved it since it was brought to the point. */
    this.cursor = {x: 0, y: 0};
    this.isMoved = false;
    this.paintMs = 0;
    /** @type {any[]|null} what of the photo is on the canvas; null: not all of it */
    this.painted = null;
    this.isDrawn = false;
    /** @type {Map<string, any>} */
    this.markNodes = new Map();
    /** @type {Map<string, any>} */
    this.sampleNodes = new Map();
    /** How often what is drawn has changed, but for its place. */
    this.changes = 0;
    this.drawn = {k: 0, tx: 0, ty: 0};
    /** @type {any} */
    this.context = null;
    this.build();
    this.loupe = new Loupe(this);
    listenTo(this);
    new ResizeObserver(() => this.resize()).observe(this.stage);
  }

  build() {
    this.canvas = node("canvas");
    this.figures = svg("g", {class: "figures"});
    this.markLayer = svg("g", {class: "marks"});
    this.sampleLayer = svg("g", {class: "samples"});
    // Small, and moved as a whole: a layer of the pane's size would be drawn anew in each frame.
    this.crossLines = svg(
      "g",
      {},
      svg("path", {class: "casing", d: kCross}),
      svg("path", {d: kCross})
    );
    this.cross = svg(
      "svg",
      {class: "overlay crosshair", viewBox: "-20 -20 40 40"},
      this.crossLines
    );
    this.fiducialLayer = svg("g", {class: "fiducials"});
    const layers = [this.figures, this.markLayer, this.sampleLayer, this.fiducialLayer];
    this.overlay = svg("svg", {class: "overlay", "aria-hidden": false}, ...layers);
    this.stage = node(
      "div",
      {class: "stage", tabindex: 0, role: "application"},
      this.canvas,
      this.overlay,
      this.cross
    );
    this.chooser = node("select", {tabindex: -1, "aria-label": t("photo")});
    this.chooser.addEventListener("change", () => {
      this.setPhoto(photoOf(this.chooser.value) ?? null);
      emit("selection");
      this.focus();
    });
    this.note = node("span", {class: "note"});
    const next = () => {
      stepLines();
      this.focus();
    };
    this.lines = button("", next, {class: "small lines", tabindex: -1, title: "'"});
    const relight = () => {
      stepLight(this);
      this.focus();
    };
    this.relight = button("", relight, {class: "small relight", tabindex: -1, title: t("key_relight")});
    this.relitNote = node("output", {class: "relit", "aria-live": "polite"});
    this.stage.append(this.relitNote);
    this.root = node(
      "section",
      {class: "pane"},
      node("header", {}, this.chooser, this.note, this.relight, this.lines),
      this.stage
    );
  }

  /** @param {import("../site/state.js").Photo|null} photo */
  setPhoto(photo) {
    if (!photo || photo === this.photo) return;
    this.photo = photo;
    this.isDrawn = false;
    for (const layer of [this.markLayer, this.sampleLayer]) layer.replaceChildren();
    this.markNodes = new Map();
    this.sampleNodes = new Map();
    this.cursor = {x: (photo.width - 1) / 2, y: (photo.height - 1) / 2};
    this.isMoved = false;
    this.stage.setAttribute("aria-label", t("paneLabel", {photo: photo.name}));
    this.root.dataset.photo = photo.name;
    this.fit();
    this.toCurrent(false);
  }

  /** Of its photo, as the server counts them. */
  get index() {
    return state.photos.indexOf(/** @type {any} */ (this.photo));
  }

  focus() {
    this.stage.focus({preventScroll: true});
  }

  resize() {
    const box = this.stage.getBoundingClientRect(),
      ratio = devicePixelRatio;
    if (box.width === 0) return;
    const dx = (box.width - (this.width ?? box.width)) / 2,
      dy = (box.height - (this.height ?? box.height)) / 2;
    this.width = box.width;
    this.height = box.height;
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    this.isDrawn = false;
    this.painted = null; // a resized canvas is empty
    // Half a pane more on each side, so that a pan only moves the layer.
    const {width, height} = box;
    this.overlay.setAttribute("viewBox", `${-width / 2} ${-height / 2} ${2 * width} ${2 * height}`);
    if (this.isFitted) this.fit();
    else this.setView(this.k, this.tx + dx, this.ty + dy);
    this.paint(); // at once
  }

  /** Zooms with the crosshair in the middle. */
  zoomAtCursor(k) {
    this.isFitted = false;
    this.k = this.limited(k);
    this.centre(this.cursor.x, this.cursor.y);
  }

  /** The crosshair to a point, if its place is known; the view along, if asked. */
  goTo(point, moves) {
    this.goToPlace(this.photo && placeOf(this.photo.name, point), moves);
  }

  /** The same to what is to be placed. */
  toCurrent(moves) {
    if (!this.photo || (ui.point === null && !hands())) return;
    this.goToPlace(currentPlace(this.photo.name), moves);
  }

  goToPlace(place, moves) {
    this.isMoved = false;
    if (!place) return;
    this.cursor = place;
    if (moves && !this.isFitted) this.centre(place.x, place.y);
    else this.reveal();
    redraw();
  }

  /** The crosshair stays on the point, wherever that is now. */
  stay() {
    const place = this.isMoved || ui.tool || !this.photo ? null : currentPlace(this.photo.name);
    if (place) this.cursor = place;
  }

  /** The crosshair to a pixel, kept on the photo. */
  moveCursor(x, y) {
    if (!this.photo) return;
    this.cursor = {
      x: clamp(x, -0.5, this.photo.width - 0.5),
      y: clamp(y, -0.5, this.photo.height - 0.5)
    };
    this.isMoved = true;
    this.reveal();
    redraw();
  }

  /** Pans if the crosshair is out of sight. */
  reveal() {
    const at = this.toScreen(this.cursor.x, this.cursor.y),
      edge = 24;
    if (
      !this.width ||
      (at.x >= edge && at.y >= edge && at.x <= this.width - edge && at.y <= this.height - edge)
    )
      return;
    if (!this.isFitted) this.centre(this.cursor.x, this.cursor.y);
  }

  draw() {
    this.paint();
    this.drawHeader();
    if (!this.photo) return;
    this.cross.classList.toggle("off", Boolean(this.photo.fault));
    const at = this.toScreen(this.cursor.x, this.cursor.y);
    // Whole CSS px by the layer, or it would be blurred, the rest within.
    const x = Math.floor(at.x),
      y = Math.floor(at.y);
    this.cross.style.transform = `translate(${x - kCrossHalf}px, ${y - kCrossHalf}px)`;
    this.crossLines.setAttribute("transform", `translate(${at.x - x} ${at.y - y})`);
    this.drawOverlay();
    this.loupe.draw();
  }

  /** Lines and marks: anew after a change, placed anew after a zoom; a pan only moves their layer. */
  drawOverlay() {
    const dx = this.tx - this.drawn.tx,
      dy = this.ty - this.drawn.ty;
    const isFar = Math.abs(dx) > this.width / 2 || Math.abs(dy) > this.height / 2;
    if (!this.isDrawn || this.k !== this.drawn.k || isFar) {
      if (!this.isDrawn) this.changes += 1;
      this.isDrawn = true;
      this.drawn = {k: this.k, tx: this.tx, ty: this.ty};
      drawMarks(this);
      drawSamples(this);
      drawFiducials(this);
    }
    const shift = `translate(${this.tx - this.drawn.tx}px, ${this.ty - this.drawn.ty}px)`;
    if (this.overlay.style.transform !== shift) this.overlay.style.transform = shift;
    drawFigures(this);
  }

  drawHeader() {
    this.root.classList.toggle("active", activePane() === this);
    const names = state.photos.map(photo => photo.name);
    if (this.chooser.childElementCount !== names.length) {
      this.chooser.replaceChildren(...names.map(name => node("option", {value: name, text: name})));
    }
    keep(this.chooser, "value", this.photo?.name ?? "");
    const about = state.adjusted?.photos?.[this.photo?.name ?? ""],
      fault = said(this.photo, "fault");
    keepText(this.lines, t(`lines_${ui.lines}`));
    this.drawRelitNote();
    this.note.classList.toggle("fault", Boolean(fault));
    keep(this.note, "title", fault || said(about, "why"));
    keepText(this.note, fault ? t("photoFault", {why: fault}) : this.photo ? this.noteOf(this.photo.name, about) : "");
  }

  /** @param {string} name */
  noteOf(name, about) {
    const percent = Math.round(100 * this.k * devicePixelRatio);
    return `${orientationOf(name, about)} · ${percent} %${ui.arrows ? ` · v × ${ui.arrows}` : ""}`;
  }

  /** In which light the photo is shown, and what is to be known of it. */
  drawRelitNote() {
    keepText(this.relight, t(`light_${this.light}`));
    const pressed = String(this.light !== "photo");
    if (this.relight.getAttribute("aria-pressed") !== pressed) this.relight.setAttribute("aria-pressed", pressed);
    keep(this.root.dataset, "light", this.light);
    const made = this.light === "photo" || !this.photo ? null : relit(this.index, this.light);
    keep(this.relitNote, "hidden", !made);
    this.relitNote.classList.toggle("fault", Boolean(made?.isFault));
    keepText(this.relitNote, made ? `${t(`light_${this.light}`)}: ${made.text}` : "");
  }

  /** Anew only where something is another: the other panes stand still while a hand pans this one. */
  paint() {
    const {photo, k, tx, ty, width} = this;
    const picture = this.light === "photo" || !photo ? null : relit(this.index, this.light).picture;
    const what = [photo, photo?.fault, picture, k, tx, ty, width, this.canvas.width, this.canvas.height];
    if (this.painted && what.every((value, i) => value === this.painted?.[i])) return;
    const begin = performance.now(),
      ratio = devicePixelRatio;
    const context = (this.context ??= this.canvas.getContext("2d", {alpha: false}));
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = "#15191c";
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    let isWhole = true;
    if (photo && !photo.fault && width)
      isWhole = this.paintPhoto(context, picture, k * ratio, tx * ratio, ty * ratio);
    this.painted = isWhole ? what : null;
    fetchTiles();
    this.paintMs = performance.now() - begin;
  }

  /** All in device pixels; relit as soon as that is made. False: tiles are still to come. */
  paintPhoto(context, picture, k, tx, ty) {
    if (!picture) return paintTiles(context, {index: this.index, .../** @type {any} */ (this.photo)}, k, tx, ty);
    const {width, height} = /** @type {any} */ (this.photo);
    context.imageSmoothingEnabled = true;
    context.drawImage(picture, tx, ty, k * width, k * height);
    return true;
  }
}

const kCrossHalf = 20; // CSS px, of the crosshair's layer
const kCross = "M-16 0H-3M3 0H16M0 -16V-3M0 3V16";

function orientationOf(name, about) {
  if (!about) return "";
  if (!about.oriented) return said(about, "why") || t("notOriented");
  return t("orientedNote", {rms: about.rms_px === undefined ? "–" : about.rms_px.toFixed(2)});
}
