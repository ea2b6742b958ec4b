// SPDX-License-Identifier: GPL-3.0-or-later
// A picture's place in a pane, and its zoom.
// screen = k (p + 1/2) + t in CSS pixels, p a pixel coordinate, (0, 0) being a pixel's centre.

import {redraw} from "../site/signals.js";

const kMostZoom = 64;
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

export class Zoomed {
  constructor() {
    /** @type {{width: number, height: number}|null} [px] */
    this.photo = null;
    this.k = 1;
    this.tx = 0;
    this.ty = 0;
    this.isFitted = true;
    /** @type {number|undefined} of the pane [CSS px] */
    this.width = undefined;
    /** @type {number|undefined} */
    this.height = undefined;
  }

  /** The view: t on whole device pixels, so that at whole k every pixel is a sharp square. */
  setView(k, tx, ty) {
    const ratio = devicePixelRatio,
      snap = value => Math.round(value * ratio) / ratio;
    this.k = this.limited(k);
    this.tx = snap(tx);
    this.ty = snap(ty);
    redraw();
  }

  /** @param {number} k */
  limited(k) {
    return clamp(k, this.fitScale() / 4, kMostZoom);
  }

  fitScale() {
    if (!this.photo || !this.width) return 0.1;
    return Math.min(this.width / this.photo.width, this.height / this.photo.height);
  }

  fit() {
    if (!this.photo || !this.width) return;
    const k = this.fitScale();
    this.isFitted = true;
    this.setView(k, (this.width - k * this.photo.width) / 2, (this.height - k * this.photo.height) / 2);
  }

  /** Zooms so that screen place (x, y) keeps its pixel. */
  zoomAt(k, x, y) {
    const p = this.toPhoto(x, y);
    this.isFitted = false;
    this.k = this.limited(k);
    this.setView(this.k, x - this.k * (p.x + 0.5), y - this.k * (p.y + 0.5));
  }

  /** Pixel (x, y) to the middle of the pane. */
  centre(x, y) {
    this.isFitted = false;
    this.setView(
      this.k,
      (this.width ?? 0) / 2 - this.k * (x + 0.5),
      (this.height ?? 0) / 2 - this.k * (y + 0.5)
    );
  }

  toScreen(x, y) {
    return {x: this.k * (x + 0.5) + this.tx, y: this.k * (y + 0.5) + this.ty};
  }

  toPhoto(x, y) {
    return {x: (x - this.tx) / this.k - 0.5, y: (y - this.ty) / this.k - 0.5};
  }

  isInFrame(x, y) {
    return (
      this.photo !== null &&
      x >= -0.5 &&
      y >= -0.5 &&
      x <= this.photo.width - 0.5 &&
      y <= this.photo.height - 0.5
    );
  }
}
