// SPDX-License-Identifier: GPL-3.0-or-later
//
// Strokes on the surface that the line begins with, drawn with the pointer or by keys.

const STEP = 12; // pixels for an arrow key, and with Shift
const FINE = 3;
const MOVES = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const HINT = "Draw on the surface, or move the pen by arrow keys (Shift: finely), Space puts it down and lifts it. A stroke that comes back to its beginning is closed.";

export class Pen {
  strokes = [];
  on = false;
  #stroke = null;
  #place = null; // of the pen that keys move, in pixels

  /** `cross` is the element that shows the pen; `changed()` is called when the strokes are others, `say` with words. */
  constructor(view, cross, { spacing, changed, say, hint }) {
    Object.assign(this, { view, cross, spacing, changed, say, hint });
    const { canvas } = view;
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.on || event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      this.#hideCross();
      this.#begin(at(event));
    });
    canvas.addEventListener("pointermove", (event) => this.#stroke && !this.#place && this.#drawTo(at(event)));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => !this.#place && this.#end());
  }

  setOn(on, byKeys = false) {
    this.#stroke = null;
    this.on = on;
    this.view.canvas.classList.toggle("drawing", on);
    this.view.controls.enabled = !on;
    this.hint(on ? HINT : null);
    this.#hideCross();
    this.show();
    if (on && byKeys) {
      this.view.canvas.focus();
      this.#moveTo([this.view.canvas.clientWidth / 2, this.view.canvas.clientHeight / 2]);
      this.say("Arrow keys move the pen, Space puts it down and lifts it, Backspace forgets the last stroke, Escape ends.");
    }
  }

  forget(number = this.strokes.length) {
    this.#stroke = null;
    this.strokes.splice(this.strokes.length - number, number);
    this.show();
  }

  /** All points, where the strokes begin, and which are closed. */
  seed() {
    return {
      positions: this.strokes.flatMap(({ points }) => points),
      offsets: this.strokes.reduce((ends, { points }) => [...ends, ends[ends.length - 1] + points.length / 3], [0]),
      closed: this.strokes.map(({ closed }) => Number(closed)),
    };
  }

  show() {
    const strokes = [...this.strokes, ...(this.#stroke ? [this.#stroke] : [])];
    const line = { positions: [], normals: [], offsets: [0], closed: [] };
    for (const { points, normals, closed } of strokes) {
      for (const x of points) line.positions.push(x);
      for (const x of normals) line.normals.push(x);
      line.offsets.push(line.positions.length / 3);
      line.closed.push(closed);
    }
    this.view.setStrokes(strokes.length ? line : null);
  }

  /** Takes a key that is pressed in the picture; false: it means nothing here. */
  key(event) {
    if (!this.on) return false;
    if (event.key === " " || event.key === "Enter") this.#lift();
    else if (event.key === "Backspace") this.#back();
    else if (MOVES[event.key]) this.#move(MOVES[event.key], event.shiftKey ? FINE : STEP);
    else return false;
    event.preventDefault();
    return true;
  }

  #lift() {
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    this.#moveTo(this.#place ?? [width / 2, height / 2]);
    if (this.#stroke) this.#end();
    else this.say(this.#begin(this.#place) ? "The pen is down." : "There is no surface below the pen.");
  }

  #back() {
    if (this.#stroke) this.#stroke = null;
    else if (this.strokes.length === 0) return;
    else {
      this.strokes.pop();
      this.changed();
    }
    this.show();
    this.say(`The last stroke is forgotten; ${this.strokes.length} left.`);
  }

  #move([right, down], step) {
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    const [x, y] = this.#place ?? [width / 2, height / 2];
    for (let k = 1; k <= step; k += FINE) { // small ones, so that a stroke follows the surface
      const to = [x + right * Math.min(k + FINE - 1, step), y + down * Math.min(k + FINE - 1, step)];
      this.#moveTo([Math.min(Math.max(to[0], 0), width - 1), Math.min(Math.max(to[1], 0), height - 1)]);
      if (this.#stroke && !this.#drawTo(this.#place)) this.say("There is no surface below the pen.");
    }
  }

  #moveTo(place) {
    this.#place = place;
    this.cross.hidden = false;
    this.cross.style.transform = `translate(${place[0]}px, ${place[1]}px)`;
  }

  #hideCross() {
    this.#place = null;
    this.cross.hidden = true;
  }

  #begin(place) {
    this.#stroke = { points: [], normals: [], closed: false };
    if (this.#drawTo(place) || !this.#place) return true;
    this.#stroke = null;
    return false;
  }

  /** False where no surface is. */
  #drawTo(place) {
    const hit = this.view.placeAt(place);
    if (!hit) return false;
    const { points, normals } = this.#stroke;
    const last = points.slice(-3);
    const far = last.length === 0 || Math.hypot(...hit.point.map((x, k) => x - last[k])) > this.spacing() / 3;
    if (far) {
      points.push(...hit.point);
      normals.push(...hit.normal);
      this.show();
    }
    return true;
  }

  #end() {
    const stroke = this.#stroke;
    if (!stroke) return;
    this.#stroke = null;
    const { points } = stroke;
    const n = points.length / 3;
    if (n < 2) {
      this.say("The stroke is too short.");
      this.show();
      return;
    }
    const gap = Math.hypot(...[0, 1, 2].map((k) => points[k] - points[3 * n - 3 + k]));
    stroke.closed = n >= 6 && gap < 1.5 * this.spacing();
    this.strokes.push(stroke);
    this.show();
    this.changed();
    this.say(`${stroke.closed ? "A closed" : "An open"} stroke of ${n} points.`);
  }
}
