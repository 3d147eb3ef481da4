// The plane of two actuators, coloured by the number of assembly modes.

import { degrees, html, number } from "./svg.js";

/** @typedef {import("./types.js").ActuatorPlane} ActuatorPlane @typedef {import("./types.js").Actuator} Actuator @typedef {import("./types.js").Point} Point */

/** Colours by count, as red, green, blue; for light and dark. Modes come in pairs, so odd counts stand between. */
const COLOURS = {
  light: [[243, 244, 246], [226, 233, 240], [203, 221, 238], [168, 199, 226], [118, 167, 209], [73, 131, 181], [35, 92, 145]],
  dark: [[27, 32, 38], [34, 46, 58], [38, 62, 86], [42, 84, 122], [52, 112, 163], [84, 152, 205], [150, 204, 244]],
};

export class Plane {
  /** @param {{ pull: (pair: Point, values: Point) => void, drop: () => void }} on */
  constructor(on) {
    this.canvas = html("canvas", { width: 1, height: 1, role: "img", "aria-label": "Number of assembly modes over two actuators" });
    this.here = html("div", { class: "here" });
    this.up = html("div", { class: "ticks up" });
    this.along = html("div", { class: "ticks" });
    this.key = html("div", { class: "key" });
    this.element = html("div", {}, [html("div", { class: "plane-area" }, [this.canvas, this.here, this.up]), this.along, this.key]);
    /** @type {ActuatorPlane | null} */
    this.plane = null;
    /** @type {number | null} The pointer that pulls. */
    let held = null;
    const pull = (/** @type {PointerEvent} */ event) => {
      if (!this.plane) return;
      const box = this.canvas.getBoundingClientRect();
      const part = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height].map((v) => Math.min(1, Math.max(0, v)));
      const { low, high, pair } = this.plane;
      const value = (/** @type {0 | 1} */ k) => Number((low[k] + part[k] * (high[k] - low[k])).toPrecision(6));
      on.pull(pair, [value(0), value(1)]);
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      if (held !== null || event.button !== 0 || !event.isPrimary) return;
      held = event.pointerId;
      this.canvas.setPointerCapture(event.pointerId);
      pull(event);
    });
    this.canvas.addEventListener("pointermove", (event) => event.pointerId === held && pull(event));
    const release = (/** @type {PointerEvent} */ event) => {
      if (event.pointerId !== held) return;
      held = null;
      on.drop();
    };
    this.canvas.addEventListener("pointerup", release);
    this.canvas.addEventListener("pointercancel", release);
  }

  /** @param {ActuatorPlane | null} plane null where there is none @param {Actuator[]} actuators */
  draw(plane, actuators) {
    this.plane = plane;
    this.element.hidden = !plane;
    if (!plane) return;
    const [columns, rows] = plane.size;
    this.canvas.width = columns;
    this.canvas.height = rows;
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const colours = COLOURS[document.documentElement.dataset.theme === "dark" ? "dark" : "light"];
    const image = context.createImageData(columns, rows);
    for (let k = 0; k < plane.counts.length; k++) {
      const [red, green, blue] = colours[Math.min(6, plane.counts.charCodeAt(k) - 48)];
      // Rows are counted from below.
      const place = 4 * ((rows - 1 - Math.floor(k / columns)) * columns + (k % columns));
      image.data.set([red, green, blue, 255], place);
    }
    context.putImageData(image, 0, 0);
    const tick = (/** @type {0 | 1} */ axis, /** @type {number} */ value) => (actuators[plane.pair[axis]]?.angle ? `${number(Math.round(degrees(value)))}°` : number(Number(value.toPrecision(3))));
    this.along.replaceChildren(...[plane.low[0], plane.high[0]].map((v) => html("span", {}, [tick(0, v)])));
    this.along.children[0].after(html("span", {}, [`q${plane.pair[0] + 1}`]));
    this.up.replaceChildren(...[plane.low[1], plane.high[1]].map((v) => html("span", {}, [tick(1, v)])));
    this.up.children[0].after(html("span", {}, [`q${plane.pair[1] + 1}`]));
    const counts = [...new Set(plane.counts)].sort();
    this.key.replaceChildren(...counts.map((count) => {
      const swatch = html("i");
      swatch.style.background = `rgb(${colours[Math.min(6, Number(count))].join(" ")})`;
      return html("span", {}, [swatch, count]);
    }));
  }

  /** @param {number[]} inputs */
  point(inputs) {
    if (!this.plane) return;
    const { low, high, pair } = this.plane;
    const part = (/** @type {0 | 1} */ k) => (inputs[pair[k]] - low[k]) / (high[k] - low[k]);
    const [x, y] = [part(0), part(1)];
    this.here.hidden = !(x >= 0 && x <= 1 && y >= 0 && y <= 1);
    this.here.style.left = `${100 * x}%`;
    this.here.style.top = `${100 * (1 - y)}%`;
  }
}
