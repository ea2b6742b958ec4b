// SPDX-License-Identifier: GPL-3.0-or-later
// The loupe: eight times, from lossless pixels, with the marks drawn over it.

import {fiducialsOn, gradeOfFiducial} from "../film/certified.js";
import {getBlob} from "../site/api.js";
import {node} from "../words/dom.js";
import {rows} from "../site/state.js";
import {redraw} from "../site/signals.js";
import {activePane, gradeOf, ui} from "../site/ui.js";
import {placed, ringsOf} from "../tools/outlines.js";

const kScale = 8,
  kRadius = 40; // CSS px a pixel, px fetched about the place
const kSides = {large: 208, small: 136},
  kSmallPane = 340; // CSS px
const kColours = {good: "#56B4E9", suspect: "#E69F00", bad: "#D55E00", unknown: "#ffffff"};

export class Loupe {
  /** @param {any} pane */
  constructor(pane) {
    this.pane = pane;
    this.canvas = node("canvas", {class: "loupe", "aria-hidden": "true", hidden: true});
    this.side = 0;
    pane.stage.append(this.canvas);
    /** @type {{key: string, x: number, y: number, image: ImageBitmap|null}|null} */
    this.patch = null;
    this.isHeld = false;
    this.timer = 0;
  }

  draw() {
    const pane = this.pane,
      place = pane.hover ?? pane.cursor;
    const isShown =
      pane.photo &&
      activePane() === pane &&
      (ui.isLoupe || this.isHeld) &&
      pane.isInFrame(place.x, place.y);
    if (this.canvas.hidden === Boolean(isShown)) this.canvas.hidden = !isShown;
    if (!isShown) return;
    this.resize();
    this.putAside(pane.toScreen(place.x, place.y));
    this.need(place);
    this.paint(place);
  }

  /** Small panes have a small one. */
  resize() {
    const side = this.pane.height < kSmallPane ? kSides.small : kSides.large;
    if (side === this.side) return;
    this.side = side;
    this.canvas.width = this.canvas.height = side * devicePixelRatio;
    this.canvas.style.width = this.canvas.style.height = `${side}px`;
  }

  /** In the corner that the place is not in. */
  putAside(at) {
    this.canvas.classList.toggle("left", at.x > this.pane.width / 2 && at.y < this.pane.height / 2 + 40);
  }

  /** Fetches pixels when the place leaves the middle of those that are here. */
  need(place) {
    const x = Math.round(place.x),
      y = Math.round(place.y),
      free = kRadius - Math.ceil(kSides.large / kScale / 2) - 1;
    const has =
      this.patch?.key === this.pane.photo.name &&
      Math.abs(this.patch.x - x) <= free &&
      Math.abs(this.patch.y - y) <= free;
    if (has || this.timer) return;
    const key = this.pane.photo.name,
      index = this.pane.index;
    this.timer = window.setTimeout(async () => {
      try {
        const image = await createImageBitmap(
          await getBlob(`/api/patch?photo=${index}&x=${x}&y=${y}&r=${kRadius}`)
        );
        this.patch?.image?.close();
        this.patch = {key, x, y, image};
      } catch {
        this.patch = {key, x, y, image: null};
      }
      this.timer = 0;
      redraw();
    }, 15);
  }

  paint(place) {
    const context = this.canvas.getContext("2d"),
      ratio = devicePixelRatio;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.imageSmoothingEnabled = false;
    context.fillStyle = "#000";
    context.fillRect(0, 0, this.side, this.side);
    const toX = x => (x - place.x) * kScale + this.side / 2,
      toY = y => (y - place.y) * kScale + this.side / 2;
    if (this.patch?.image && this.patch.key === this.pane.photo.name) {
      const side = (2 * kRadius + 1) * kScale;
      context.drawImage(
        this.patch.image,
        toX(this.patch.x - kRadius - 0.5),
        toY(this.patch.y - kRadius - 0.5),
        side,
        side
      );
    }
    this.paintMarks(context, toX, toY);
    const middle = this.side / 2;
    stroke(context, "#fff", () => {
      for (const [dx, dy] of [
        [1, 0],
        [-1, 0],
        [0, 1],
        [0, -1]
      ]) {
        context.moveTo(middle + 5 * dx, middle + 5 * dy);
        context.lineTo(middle + 40 * dx, middle + 40 * dy);
      }
    });
  }

  paintMarks(context, toX, toY) {
    const photo = this.pane.photo.name;
    const circle = (one, level) => {
      const x = toX(one.x),
        y = toY(one.y);
      if (x < 0 || y < 0 || x > this.side || y > this.side) return;
      stroke(context, kColours[level], () => context.arc(x, y, 6, 0, 2 * Math.PI));
    };
    for (const one of rows("observations"))
      if (one.photo === photo) circle(one, gradeOf(photo, one.point));
    for (const one of ui.mode === "film" ? fiducialsOn(photo) : [])
      circle(one, gradeOfFiducial(photo, one.mark));
    const isMet = corners => {
      const xs = corners.map(([x]) => toX(x)),
        ys = corners.map(([, y]) => toY(y));
      const meets = all => Math.min(...all) < this.side && Math.max(...all) > 0;
      return corners.length > 0 && meets(xs) && meets(ys);
    };
    const rings = ui.lines === "none" ? [] : rows("polygons").flatMap(ringsOf);
    for (const corners of rings.map(names => placed(names, photo))) {
      const draw = () =>
        corners.forEach(([x, y], i) =>
          i === 0 ? context.moveTo(toX(x), toY(y)) : context.lineTo(toX(x), toY(y))
        );
      if (isMet(corners)) stroke(context, "#ffffffb0", draw, true);
    }
  }
}

/** A line with a dark casing. */
function stroke(context, colour, draw, isClosed = false) {
  context.beginPath();
  draw();
  if (isClosed) context.closePath();
  context.strokeStyle = "#000a";
  context.lineWidth = 3;
  context.stroke();
  context.strokeStyle = colour;
  context.lineWidth = 1.2;
  context.stroke();
}
