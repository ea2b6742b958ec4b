// SPDX-License-Identifier: GPL-3.0-or-later
// Two ways to measure on the page: by the keyboard alone, and as people do it with a mouse, who look for a place with
// the wheel and click it. Both take points that are there by their names.

const kClose = 8; // [device px a pixel] at which a click is exact to a tenth of a pixel
const kReach = 10; // [CSS px] within which the page takes a click for a mark that is there
const kNotch = 120; // of the wheel

export class Keyboard {
  constructor(person) {
    this.person = person;
    this.photo = "";
  }
  async show(photo) {
    if (photo !== this.photo) await this.person.photo((this.photo = photo));
  }
  /** A mark of a point. */
  async mark({photo, point, x, y}) {
    await this.show(photo);
    await this.person.point(point);
    await this.person.goTo(x, y);
    await this.person.press("Shift+Enter");
  }
  /** A point for the tool, which is marked in this photo or not. */
  async pick(point) {
    await this.person.point(point);
  }
  async pickBoth(one, other) {
    for (const point of [one, other]) await this.pick(point);
  }
  /** A place for the tool. */
  async place({photo, x, y}) {
    await this.show(photo);
    await this.person.goTo(x, y);
    await this.person.press("Enter");
  }
}

export class Pointer extends Keyboard {
  point = "";
  /** All marks so far, by photo. @type {Map<string, {point: string, x: number, y: number}[]>} */
  marks = new Map();

  /** One click; the mark is then where the page says. */
  async mark({photo, point, x, y}) {
    if (point !== this.point) await this.person.point((this.point = point));
    if (await this.isCrowded(photo, x, y)) {
      await super.mark({photo, point, x, y});
    } else {
      await this.clickAt(photo, x, y, kClose);
    }
    this.marksOf(photo).push({point, x: Number(x), y: Number(y)});
  }
  async pick(point, photo) {
    const mark = photo && this.marksOf(photo).find(one => one.point === point);
    const isAlone = mark && !this.marksOf(photo).some(one => one !== mark && Math.hypot(one.x - mark.x, one.y - mark.y) < 4);
    if (isAlone) await this.clickAt(photo, mark.x, mark.y, 0.5);
    else await super.pick(point);
  }
  /** On a photo that shows them both, if there is one. */
  async pickBoth(one, other) {
    const shows = (photo, point) => this.marksOf(photo).some(mark => mark.point === point);
    const photo = [...this.marks.keys()].find(name => shows(name, one) && shows(name, other));
    for (const point of [one, other]) await this.pick(point, photo);
  }
  async place({photo, x, y}) {
    await this.clickAt(photo, x, y, kClose / 2);
  }

  marksOf(photo) {
    if (!this.marks.has(photo)) this.marks.set(photo, []);
    return this.marks.get(photo);
  }
  /** Whether a click would be taken for another point's mark. */
  async isCrowded(photo, x, y) {
    return this.marksOf(photo).some(one => Math.hypot(one.x - x, one.y - y) < 1.2 * kReach / kClose);
  }

  /** Brings a place into sight at this scale, by the wheel where no prediction has done so, and clicks it. */
  async clickAt(photo, x, y, scale) {
    const {person} = this;
    await person.settled();
    if (!(await this.isShown(photo))) await person.photo(photo);
    for (let i = 0; i < 40; ++i) {
      const {k, box, at} = await this.view(photo, x, y);
      const isSeen = at.x > box.left + 4 && at.x < box.right - 4 && at.y > box.top + 4 && at.y < box.bottom - 4;
      if (isSeen && k >= scale) break;
      const place = isSeen ? at : {x: (box.left + box.right) / 2, y: (box.top + box.bottom) / 2};
      const notches = isSeen ? Math.min(8, Math.ceil(Math.log2(scale / k) * 250 / kNotch + 0.1)) : -4;
      await person.wheel(place, -notches * kNotch);
      await person.drawn();
    }
    const {at} = await this.view(photo, x, y);
    await person.clickPlace(at);
    await person.drawn();
  }
  isShown(photo) {
    return this.person.page.evaluate(name => Boolean(document.querySelector(`.pane[data-photo="${name}"] .stage`)?.clientWidth), photo);
  }
  /** How a photo is shown, and where the centre of a pixel of it is on the screen. */
  view(photo, x, y) {
    return this.person.page.evaluate(([name, u, v]) => {
      const stage = document.querySelector(`.pane[data-photo="${name}"] .stage`);
      const {a, d, e, f} = stage.querySelector(".figures").getScreenCTM();
      const {left, right, top, bottom} = stage.getBoundingClientRect();
      return {k: a, box: {left, right, top, bottom}, at: {x: a * u + e, y: d * v + f}};
    }, [photo, Number(x), Number(y)]);
  }
}
